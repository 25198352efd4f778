//! Shaft mesh: nodes and elements from sections and stations.

use super::material;
use crate::Station;
use crate::file::diagnostic::{Kind, Problem};
use crate::file::key::{
    Declared, Flag, Group, Key, NamedQuantities, Quantity, SubTable, Table, TableList, Text, Words, any,
    flag, keys, named_quantities, not_negative, positive, quantity, sub_table, table_list, text, words,
};
use crate::file::reader::{Reader, missing_table_problem};
use crate::file::tree::{Node, Value};
use rotordyn_core::document::number;
use rotordyn_core::element::{Disc, Material, ShaftElement, ShearCoefficient};
use rotordyn_units::{FORCE, LENGTH, MOMENT, NUMBER, RATE, TIME};
use std::f64::consts::PI;
use std::ops::Range;

keys! {
    /// Tables of this file.
    pub(super) static TOP: TopKeys {
        shaft: SubTable = sub_table(&SHAFT_TABLE);
        station: NamedQuantities = named_quantities(any(LENGTH), "Named axial positions.").optional();
    }
}

static SHAFT_TABLE: Table = Table {
    meaning: "A flexible shaft of sections; an automatic mesh has a node at every section end and station.",
    groups: &[Group::always(ShaftKeys::LIST), Group::always(PropertyKeys::LIST)],
};

keys! {
    /// Of `[shaft]`.
    static SHAFT: ShaftKeys {
        start: Quantity = quantity(any(LENGTH), "Position of its first end.").default("0 m").example("\"-50 mm\"");
        minimum_spacing: Quantity = quantity(positive(LENGTH), "Smallest distance of nodes.").default("100 um");
        section: TableList = table_list(&SECTION_TABLE).required("")
            .example("[{ length = \"625 mm\", outer_diameter = \"25 mm\" }]");
        layer: TableList = table_list(&LAYER_TABLE).optional()
            .example("[{ from = \"100 mm\", length = \"50 mm\", outer_diameter = \"40 mm\", inner_diameter = \"25 mm\" }]");
    }
}

static SECTION_TABLE: Table = Table {
    meaning: "A cylinder or cone, solid or hollow; properties of the shaft may be overridden.",
    groups: &[
        Group::always(PlaceKeys::LIST),
        Group::always(SectionKeys::LIST),
        Group::always(PropertyKeys::LIST),
    ],
};

static LAYER_TABLE: Table = Table {
    meaning: "A sleeve on the shaft's nodes, whose stiffness and inertia are added to those of the sections; nodes are at its ends.",
    groups: &[
        Group::always(LayerKeys::LIST),
        Group::always(SectionKeys::LIST),
        Group::always(PropertyKeys::LIST),
    ],
};

keys! {
    /// Of `[[shaft.section]]` only.
    static PLACE: PlaceKeys {
        from: Quantity = quantity(any(LENGTH), "Position of its first end.").computed("the end of the previous section");
        gap: Flag = flag("Whether there is no shaft, only what connects its ends, such as a coupling; diameters are for drawings.")
            .default("false");
    }
}

keys! {
    /// Of `[[shaft.layer]]` only.
    static LAYER: LayerKeys {
        from: Quantity = quantity(any(LENGTH), "Position of its first end, on the shaft.").example("\"100 mm\"");
    }
}

keys! {
    /// Of sections and layers.
    static SECTION: SectionKeys {
        to: Quantity = quantity(any(LENGTH), "Position of its other end.").required("or length");
        length: Quantity = quantity(positive(LENGTH), "Length.").required("or to").example("\"625 mm\"");
        outer_diameter: Quantity = quantity(positive(LENGTH), "Outer diameter, of a cone at its first end.")
            .example("\"25 mm\"");
        outer_diameter_end: Quantity = quantity(positive(LENGTH), "Outer diameter of a cone at its other end.")
            .computed("outer_diameter");
        inner_diameter: Quantity = quantity(not_negative(LENGTH), "Diameter of the bore.").default("0 mm")
            .example("\"10 mm\"");
        inner_diameter_end: Quantity = quantity(not_negative(LENGTH), "Diameter of the bore at its other end.")
            .computed("inner_diameter").example("\"10 mm\"");
    }
}

keys! {
    /// Properties of the whole shaft, which a section may override.
    static PROPERTY: PropertyKeys {
        element_length: Quantity = quantity(positive(LENGTH), "Greatest length of an element.")
            .required("in [shaft]");
        material: Text = text("name of a material", "Material.").computed("the only material of the file")
            .example("\"steel\"");
        shear: Words<ShearCoefficient> = words(SHEAR, "Shear coefficient of a Timoshenko beam; none: rigid in shear.")
            .default("cowper");
        shear_coefficient: Quantity = quantity(positive(NUMBER), "Shear coefficient, as a number.").named("shear")
            .optional().example("0.9");
        rotary_inertia: Flag = flag("Whether the cross sections have moments of inertia.").default("true");
        axial_force: Quantity = quantity(any(FORCE), "Tension of the shaft; negative: compression.").default("0 N");
        torque: Quantity = quantity(any(MOMENT), "Torque that the shaft transmits.").default("0 N m");
        mass_damping: Quantity = quantity(not_negative(RATE), "Rayleigh damping, factor of the mass matrix.")
            .default("0 1/s");
        stiffness_damping: Quantity = quantity(not_negative(TIME), "Rayleigh damping, factor of the stiffness matrix.")
            .default("0 s").example("\"1e-5 s\"");
        internal_damping: Quantity = quantity(not_negative(TIME),
            "Internal (rotating) damping, factor of the stiffness matrix in the rotating frame.")
            .default("0 s").example("\"1e-5 s\"");
    }
}

const SHEAR: &[(&str, ShearCoefficient)] = &[
    ("cowper", ShearCoefficient::Cowper),
    ("hutchinson", ShearCoefficient::Hutchinson),
    ("none", ShearCoefficient::Rigid),
];

/// The meshed shaft.
#[derive(Default)]
pub(super) struct MeshedShaft {
    pub node_z: Vec<f64>,
    pub elements: Vec<ShaftElement>,
    pub stations: Vec<Station>,
    /// Rigid rotor in place of the elements.
    pub rigid_rotor: Option<Disc>,
}

impl MeshedShaft {
    /// Mass of the shaft \[kg\] (exact for conical frusta), or of the rigid rotor.
    pub fn mass(&self) -> f64 {
        let square = |[a, b]: [f64; 2]| (a * a + a * b + b * b) / 3.0;
        let mass = |e: &ShaftElement| {
            e.material.density * PI / 4.0 * e.length * (square(e.outer_diameter) - square(e.inner_diameter))
        };
        self.elements.iter().flat_map(ShaftElement::with_layers).map(mass).sum::<f64>()
            + self.rigid_rotor.as_ref().map_or(0.0, |rotor| rotor.mass)
    }
}

/// Properties of the whole shaft that a section may override.
#[derive(Clone)]
struct Properties {
    material: Option<Material>,
    element_length: f64,
    shear: ShearCoefficient,
    rotary_inertia: bool,
    axial_force: f64,
    torque: f64,
    proportional: [f64; 2],
    internal_viscous: f64,
}

struct Section {
    z: [f64; 2],
    /// The key that states its length or end, and where.
    extent: (String, Range<usize>),
    outer: [f64; 2],
    inner: [f64; 2],
    properties: Properties,
    gap: bool,
}

impl Section {
    /// Diameter at z, linear between the section's ends.
    fn diameter_at(&self, ends: [f64; 2], z: f64) -> f64 {
        let part = ((z - self.z[0]) / (self.z[1] - self.z[0])).clamp(0.0, 1.0);
        ends[0] + (ends[1] - ends[0]) * part
    }
}

/// Positions closer than this fraction of the shaft's length are equal.
const RELATIVE_POSITION_TOLERANCE: f64 = 1e-9;
/// More elements than this are treated as an error in a length.
const MAX_ELEMENTS: f64 = 5000.0;

pub(super) fn read(top: &Reader, materials: &[Material]) -> MeshedShaft {
    if !top.has(&TOP.shaft) {
        let problem = missing_table_problem(TOP.shaft.about.name);
        top.log.error(
            problem
                .hint("add [shaft] with material, element_length and [[shaft.section]], or a rigid [rotor]"),
        );
        // what refers to the stations is right
        let stations = stations(top, None, 0.0);
        return MeshedShaft { stations, ..MeshedShaft::default() };
    }
    let r = top.table_or_empty(&TOP.shaft);
    let start = r.value(&SHAFT.start);
    let spacing = r.value(&SHAFT.minimum_spacing);
    let common = properties(&r, None, materials);
    let sections = sections(&r, start, &common, materials);
    let layers = layers(&r, &sections, &common, materials);
    let before = r.log.error_count();
    let sound = r.has_no_errors();
    r.finish();
    let ends = sections.first().zip(sections.last()).map(|(first, last)| [first.z[0], last.z[1]]);
    let stations = stations(top, ends, spacing);
    if !sound || sections.is_empty() || top.log.error_count() > before {
        // keep the stations so that references to them still resolve
        return MeshedShaft { stations, ..MeshedShaft::default() };
    }
    mesh(top, [&sections, &layers], stations, spacing)
}

/// The coefficient κ of the shear stiffness κ G A; some programs take its inverse.
fn shear_coefficient(r: &Reader) -> Option<f64> {
    let value = r.get(&PROPERTY.shear_coefficient)?;
    if value > 1.0 {
        let key = &PROPERTY.shear_coefficient;
        let problem = Problem::new(Kind::OutOfRange, &r.span_of(key), format!("{} is above 1", r.name(key)))
            .expected("above 0, at most 1; 0.9 for a solid shaft, 0.5 for a thin tube");
        let inverse = number(1.0 / value, 4);
        r.log.error(problem.hint(format!(
            "the shear stiffness of a section is coefficient x G A; of a program that divides by it, take the inverse, {inverse}"
        )));
        return None;
    }
    Some(value)
}

/// Whether `[shaft]` leaves a key to its sections and layers, each of which has its own.
fn every_part_has(shaft: &Reader, key: &dyn Declared) -> bool {
    let has = |node: &Node| matches!(&node.value, Value::Table(part) if part.get(key.name()).is_some());
    let all_have = |list: &Key<TableList>| match shaft.entry(list).map(|entry| &entry.node) {
        Some(Node { value: Value::List(parts), .. }) => parts.iter().all(has),
        Some(node) => has(node),
        None => true,
    };
    !shaft.has(key) && shaft.has(&SHAFT.section) && all_have(&SHAFT.section) && all_have(&SHAFT.layer)
}

fn properties(r: &Reader, common: Option<&Properties>, materials: &[Material]) -> Properties {
    let material = match common {
        Some(c) if !r.has(&PROPERTY.material) => c.material.clone(),
        None if every_part_has(r, &PROPERTY.material) => None,
        _ => material(r, &PROPERTY.material, materials),
    };
    let shear = match r.entry(&PROPERTY.shear).map(|e| &e.node.value) {
        Some(Value::Text(_)) => r.choice(&PROPERTY.shear),
        Some(_) => shear_coefficient(r).map(ShearCoefficient::Value),
        None => None,
    };
    let element_length = match common {
        None if every_part_has(r, &PROPERTY.element_length) => f64::INFINITY,
        None => r.value(&PROPERTY.element_length),
        Some(c) => r.or(&PROPERTY.element_length, c.element_length),
    };
    let inherited = |key: &Key<Quantity>, pick: fn(&Properties) -> f64| match common {
        None => r.value(key),
        Some(c) => r.or(key, pick(c)),
    };
    Properties {
        material,
        element_length,
        shear: shear.unwrap_or_else(|| common.map_or_else(|| PROPERTY.shear.default_word(), |c| c.shear)),
        rotary_inertia: common.map_or_else(
            || r.flag(&PROPERTY.rotary_inertia),
            |c| r.flag_or(&PROPERTY.rotary_inertia, c.rotary_inertia),
        ),
        axial_force: inherited(&PROPERTY.axial_force, |c| c.axial_force),
        torque: inherited(&PROPERTY.torque, |c| c.torque),
        proportional: [
            inherited(&PROPERTY.mass_damping, |c| c.proportional[0]),
            inherited(&PROPERTY.stiffness_damping, |c| c.proportional[1]),
        ],
        internal_viscous: inherited(&PROPERTY.internal_damping, |c| c.internal_viscous),
    }
}

fn sections(r: &Reader, start: f64, common: &Properties, materials: &[Material]) -> Vec<Section> {
    if !r.has(&SHAFT.section) {
        r.missing(&SHAFT.section);
    }
    let mut sections: Vec<Section> = Vec::new();
    let mut end = start;
    for s in r.tables(&SHAFT.section) {
        let from = s.or(&PLACE.from, end);
        let section = Section { gap: s.flag(&PLACE.gap), ..section(&s, from, common, materials) };
        if (from - end).abs() > RELATIVE_POSITION_TOLERANCE * (from.abs() + end.abs()) && s.has_no_errors() {
            let word = if from > end { "leaves a gap after" } else { "overlaps" };
            let other = if sections.is_empty() { "the shaft's start" } else { "the previous section" };
            let message = format!("{} {word} {other}, which ends at {end} m", s.name(&PLACE.from));
            s.error(Kind::Geometry, &PLACE.from, message);
        }
        s.finish();
        end = section.z[1];
        sections.push(section);
    }
    sections
}

/// `[[shaft.layer]]`, each within the sections.
fn layers(r: &Reader, sections: &[Section], common: &Properties, materials: &[Material]) -> Vec<Section> {
    let ends = sections.first().zip(sections.last()).map(|(first, last)| [first.z[0], last.z[1]]);
    let read = |s: Reader| {
        let layer = section(&s, s.value(&LAYER.from), common, materials);
        if let Some([start, end]) = ends
            && s.has_no_errors()
        {
            let slack = RELATIVE_POSITION_TOLERANCE * (end - start);
            if layer.z[0] < start - slack || layer.z[1] > end + slack {
                let problem =
                    Problem::new(Kind::Geometry, &layer.extent.1, format!("{} is not on the shaft", s.path));
                s.log.error(problem.expected(format!("from {start} m to {end} m")));
            }
        }
        s.finish();
        layer
    };
    r.tables(&SHAFT.layer).into_iter().map(read).collect()
}

/// A section or layer that begins at `from`.
fn section(s: &Reader, from: f64, common: &Properties, materials: &[Material]) -> Section {
    let (to, extent) = match s.one_of(&[&SECTION.length, &SECTION.to]) {
        Some(given) if given.is(&SECTION.to) => (s.value(&SECTION.to), &SECTION.to),
        _ => (from + s.value(&SECTION.length), &SECTION.length),
    };
    let extent = (s.name(extent), s.span_of(extent));
    if to <= from && s.has_no_errors() {
        let message = format!("{} lies before the section's start, {from} m", s.name(&SECTION.to));
        s.error(Kind::Geometry, &SECTION.to, message);
    }
    let outer = s.value(&SECTION.outer_diameter);
    let inner = s.value(&SECTION.inner_diameter);
    let outer = [outer, s.or(&SECTION.outer_diameter_end, outer)];
    let inner = [inner, s.or(&SECTION.inner_diameter_end, inner)];
    if (0..2).any(|k| inner[k] >= outer[k]) && s.has_no_errors() {
        let message = format!("{} is not less than the outer diameter", s.name(&SECTION.inner_diameter));
        s.error(Kind::Geometry, &SECTION.inner_diameter, message);
    }
    let properties = properties(s, Some(common), materials);
    Section { z: [from, to], extent, outer, inner, properties, gap: false }
}

/// Stations in file order, within the shaft ends if known; their nodes are assigned later.
pub(super) fn stations(top: &Reader, ends: Option<[f64; 2]>, spacing: f64) -> Vec<Station> {
    let mut stations: Vec<Station> = Vec::new();
    for (entry, z) in top.named_quantities(&TOP.station) {
        if let Some(z) = z {
            if let Some([start, end]) = ends {
                let slack = RELATIVE_POSITION_TOLERANCE * (end - start);
                if z < start - slack || z > end + slack {
                    let message = format!("station `{}` at {z} m is not on the shaft", entry.key);
                    let problem = Problem::new(Kind::Geometry, &entry.node.span, message);
                    top.log.error(problem.expected(format!("from {start} m to {end} m")));
                }
            }
            if let Some(other) = stations.iter().find(|s| (s.z - z).abs() < spacing) {
                let message = format!("stations `{}` and `{}` overlap", other.name, entry.key);
                let problem = Problem::new(Kind::Geometry, &entry.node.span, message);
                let problem =
                    problem.expected(format!("at least {} mm from `{}`", spacing * 1e3, other.name));
                top.log.error(problem.hint("use one station for both, or set shaft.minimum_spacing"));
            }
        }
        stations.push(Station { name: entry.key.clone(), node: 0, z: z.unwrap_or(1.0) });
    }
    stations
}

/// Mesh with nodes at every section end and station, subdivided so that no element exceeds `element_length`.
fn mesh(
    top: &Reader,
    [sections, layers]: [&[Section]; 2],
    mut stations: Vec<Station>,
    spacing: f64,
) -> MeshedShaft {
    let mut line = MeshedShaft::default();
    let total = sections[sections.len() - 1].z[1] - sections[0].z[0];
    // Nothing in a gap would hold nodes between its ends.
    let longest = |s: &Section| if s.gap { f64::INFINITY } else { s.properties.element_length };
    let elements_of = |s: &Section| ((s.z[1] - s.z[0]) / longest(s)).ceil().max(1.0);
    let elements: f64 = sections.iter().map(elements_of).sum();
    let most = sections.iter().max_by(|a, b| elements_of(a).total_cmp(&elements_of(b)));
    if let Some(most) = most.filter(|_| elements > MAX_ELEMENTS) {
        let (key, span) = &most.extent;
        let message = format!(
            "the shaft would have {elements:.0} elements, {:.0} of them in one section: `{key}` gives it {} m, its \
             element_length is {} mm",
            elements_of(most),
            number(most.z[1] - most.z[0], 5),
            number(1e3 * most.properties.element_length, 5),
        );
        let hint = format!("at most {MAX_ELEMENTS} are allowed; check the units of both lengths");
        top.log.error(Problem::new(Kind::OutOfRange, span, message).hint(hint));
        return MeshedShaft { stations, ..line };
    }
    line.node_z.push(sections[0].z[0]);
    for section in sections {
        let [start, end] = section.z;
        let mut breaks: Vec<f64> = stations
            .iter()
            .map(|s| s.z)
            .chain(layers.iter().flat_map(|layer| layer.z))
            .filter(|&z| {
                z > start + RELATIVE_POSITION_TOLERANCE * total
                    && z < end - RELATIVE_POSITION_TOLERANCE * total
            })
            .collect();
        breaks.sort_by(f64::total_cmp);
        breaks.dedup_by(|b, a| *b - *a <= RELATIVE_POSITION_TOLERANCE * total);
        breaks.push(end);
        let mut from = start;
        for to in breaks {
            if to - from < spacing {
                let station = stations.iter().find(|s| s.z == from || s.z == to);
                let name = station.map_or("", |s| &s.name);
                let span = top.named_span(&TOP.station, name);
                let message = format!("station `{name}` is {:.3e} m from the end of a section", to - from);
                let problem = Problem::new(Kind::Geometry, &span, message);
                top.log.error(problem.hint("put it at the section's end, or set shaft.minimum_spacing"));
            }
            let count = ((to - from) / longest(section) - 1e-9).ceil().max(1.0) as usize;
            for k in 1..=count {
                let left = line.node_z[line.node_z.len() - 1];
                let right = if k == count { to } else { from + (to - from) * (k as f64 / count as f64) };
                line.node_z.push(right);
                let middle = 0.5 * (left + right);
                let here = layers.iter().filter(|layer| layer.z[0] < middle && middle < layer.z[1]);
                line.elements.extend(element(section, left, right).map(|own| ShaftElement {
                    layers: here.filter_map(|layer| element(layer, left, right)).collect(),
                    ..own
                }));
            }
            from = to;
        }
    }
    for station in &mut stations {
        let distance = |k: &usize| (line.node_z[*k] - station.z).abs();
        let nearest = (0..line.node_z.len()).min_by(|a, b| distance(a).total_cmp(&distance(b)));
        station.node = nearest.unwrap_or(0);
    }
    MeshedShaft { stations, ..line }
}

/// Element between two positions; `None` if the section's material is unknown (already reported).
fn element(section: &Section, left: f64, right: f64) -> Option<ShaftElement> {
    let p = &section.properties;
    let ends = |diameters| [section.diameter_at(diameters, left), section.diameter_at(diameters, right)];
    let nothing = |material: Material| Material { young: 0.0, shear: 0.0, density: 0.0, ..material };
    let material = p.material.clone()?;
    Some(ShaftElement {
        length: right - left,
        outer_diameter: ends(section.outer),
        inner_diameter: ends(section.inner),
        material: if section.gap { nothing(material) } else { material },
        shear: if section.gap { ShearCoefficient::Rigid } else { p.shear },
        rotary_inertia: p.rotary_inertia,
        axial_force: if section.gap { 0.0 } else { p.axial_force },
        torque: if section.gap { 0.0 } else { p.torque },
        proportional_damping: p.proportional,
        internal_viscous: p.internal_viscous,
        layers: Vec::new(),
    })
}
