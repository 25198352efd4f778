//! Shaft mesh: nodes and elements from sections and stations.

use super::material;
use crate::Station;
use crate::file::diagnostic::{Kind, Problem};
use crate::file::reader::{Reader, any, not_negative, positive};
use rotordyn_core::element::{Disc, Material, ShaftElement, ShearCoefficient};
use rotordyn_units::{FORCE, LENGTH, MOMENT, NUMBER, RATE, TIME};
use std::f64::consts::PI;

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
        self.elements.iter().map(mass).sum::<f64>()
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
    outer: [f64; 2],
    inner: [f64; 2],
    properties: Properties,
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
/// More nodes than this are treated as an error in `element_length`.
const MAX_NODES: f64 = 5000.0;

pub(super) fn read(top: &Reader, materials: &[Material]) -> MeshedShaft {
    if !top.has("shaft") {
        let problem = Problem::new(Kind::MissingKey, &(0..0), "the file has no [shaft] table");
        top.log.error(
            problem
                .hint("add [shaft] with material, element_length and [[shaft.section]], or a rigid [rotor]"),
        );
        top.table("station").inspect(|r| _ = r.entries());
        return MeshedShaft::default();
    }
    let r = top.table_or_empty("shaft");
    let start = r.or("start", any(LENGTH), 0.0);
    let spacing = r.or("minimum_spacing", positive(LENGTH), 1e-4);
    let common = properties(&r, None, materials);
    let sections = sections(&r, start, &common, materials);
    let before = r.log.error_count();
    let sound = r.has_no_errors();
    r.finish();
    let ends = sections.first().zip(sections.last()).map(|(first, last)| [first.z[0], last.z[1]]);
    let stations = stations(top, ends, spacing);
    if !sound || sections.is_empty() || top.log.error_count() > before {
        // keep the stations so that references to them still resolve
        return MeshedShaft { stations, ..MeshedShaft::default() };
    }
    mesh(top, &sections, stations, spacing)
}

fn properties(r: &Reader, common: Option<&Properties>, materials: &[Material]) -> Properties {
    let material = match common {
        Some(c) if !r.has("material") => c.material.clone(),
        _ => material(r, "material", materials),
    };
    let shear = match r.entry("shear").map(|e| &e.node.value) {
        Some(crate::file::tree::Value::Text(_)) => {
            let words = [
                ("cowper", ShearCoefficient::Cowper),
                ("hutchinson", ShearCoefficient::Hutchinson),
                ("none", ShearCoefficient::Rigid),
            ];
            r.choice("shear", &words)
        }
        Some(_) => r.get("shear", positive(NUMBER)).map(ShearCoefficient::Value),
        None => None,
    };
    let element_length = match common {
        None => r.need("element_length", positive(LENGTH)),
        Some(c) => r.or("element_length", positive(LENGTH), c.element_length),
    };
    let base = |pick: fn(&Properties) -> f64| common.map_or(0.0, pick);
    Properties {
        material,
        element_length,
        shear: shear.unwrap_or(common.map_or(ShearCoefficient::Cowper, |c| c.shear)),
        rotary_inertia: r.flag("rotary_inertia", common.is_none_or(|c| c.rotary_inertia)),
        axial_force: r.or("axial_force", any(FORCE), base(|c| c.axial_force)),
        torque: r.or("torque", any(MOMENT), base(|c| c.torque)),
        proportional: [
            r.or("mass_damping", not_negative(RATE), base(|c| c.proportional[0])),
            r.or("stiffness_damping", not_negative(TIME), base(|c| c.proportional[1])),
        ],
        internal_viscous: r.or("internal_damping", not_negative(TIME), base(|c| c.internal_viscous)),
    }
}

fn sections(r: &Reader, start: f64, common: &Properties, materials: &[Material]) -> Vec<Section> {
    if !r.has("section") {
        r.missing("section", "[{ length = \"625 mm\", outer_diameter = \"25 mm\" }]");
    }
    let mut sections: Vec<Section> = Vec::new();
    let mut end = start;
    for s in r.tables("section") {
        let from = s.or("from", any(LENGTH), end);
        if (from - end).abs() > RELATIVE_POSITION_TOLERANCE * (from.abs() + end.abs()) && s.has_no_errors() {
            let word = if from > end { "leaves a gap after" } else { "overlaps" };
            let other = if sections.is_empty() { "the shaft's start" } else { "the previous section" };
            s.error(
                Kind::Geometry,
                "from",
                format!("{} {word} {other}, which ends at {end} m", s.name("from")),
            );
        }
        let to = match s.one_of(&["length", "to"]) {
            Some("to") => s.need("to", any(LENGTH)),
            _ => from + s.need("length", positive(LENGTH)),
        };
        if to <= from && s.has_no_errors() {
            s.error(
                Kind::Geometry,
                "to",
                format!("{} lies before the section's start, {from} m", s.name("to")),
            );
        }
        let outer = s.need("outer_diameter", positive(LENGTH));
        let inner = s.or("inner_diameter", not_negative(LENGTH), 0.0);
        let outer = [outer, s.or("outer_diameter_end", positive(LENGTH), outer)];
        let inner = [inner, s.or("inner_diameter_end", not_negative(LENGTH), inner)];
        if (0..2).any(|k| inner[k] >= outer[k]) && s.has_no_errors() {
            s.error(
                Kind::Geometry,
                "inner_diameter",
                format!("{} is not less than the outer diameter", s.name("inner_diameter")),
            );
        }
        let properties = properties(&s, Some(common), materials);
        s.finish();
        sections.push(Section { z: [from, to], outer, inner, properties });
        end = to;
    }
    sections
}

/// Stations in file order, within the shaft ends if known; their nodes are assigned later.
pub(super) fn stations(top: &Reader, ends: Option<[f64; 2]>, spacing: f64) -> Vec<Station> {
    let Some(r) = top.table("station") else { return Vec::new() };
    let mut stations: Vec<Station> = Vec::new();
    for entry in r.entries() {
        let before = r.log.error_count();
        let z = r.need(&entry.key, any(LENGTH));
        if r.log.error_count() == before {
            if let Some([start, end]) = ends {
                let slack = RELATIVE_POSITION_TOLERANCE * (end - start);
                if z < start - slack || z > end + slack {
                    let message = format!("station `{}` at {z} m is not on the shaft", entry.key);
                    let problem = Problem::new(Kind::Geometry, &entry.node.span, message);
                    r.log.error(problem.expected(format!("from {start} m to {end} m")));
                }
            }
            if let Some(other) = stations.iter().find(|s| (s.z - z).abs() < spacing) {
                let message = format!("stations `{}` and `{}` overlap", other.name, entry.key);
                let problem = Problem::new(Kind::Geometry, &entry.node.span, message);
                let problem =
                    problem.expected(format!("at least {} mm from `{}`", spacing * 1e3, other.name));
                r.log.error(problem.hint("use one station for both, or set shaft.minimum_spacing"));
            }
        }
        stations.push(Station { name: entry.key.clone(), node: 0, z });
    }
    r.finish();
    stations
}

/// Mesh with nodes at every section end and station, subdivided so that no element exceeds `element_length`.
fn mesh(top: &Reader, sections: &[Section], mut stations: Vec<Station>, spacing: f64) -> MeshedShaft {
    let mut line = MeshedShaft::default();
    let total = sections[sections.len() - 1].z[1] - sections[0].z[0];
    let nodes: f64 = sections.iter().map(|s| (s.z[1] - s.z[0]) / s.properties.element_length).sum();
    if nodes > MAX_NODES {
        let message = format!("the shaft would have {nodes:.0} elements");
        let span = top.table("shaft").map_or(0..0, |r| r.span_of("element_length"));
        let problem = Problem::new(Kind::OutOfRange, &span, message);
        top.log.error(
            problem.hint(format!("at most {MAX_NODES} are allowed; check the unit of element_length")),
        );
        return MeshedShaft { stations, ..line };
    }
    line.node_z.push(sections[0].z[0]);
    for section in sections {
        let [start, end] = section.z;
        let mut breaks: Vec<f64> = stations
            .iter()
            .map(|s| s.z)
            .filter(|&z| {
                z > start + RELATIVE_POSITION_TOLERANCE * total
                    && z < end - RELATIVE_POSITION_TOLERANCE * total
            })
            .collect();
        breaks.sort_by(f64::total_cmp);
        breaks.push(end);
        let mut from = start;
        for to in breaks {
            if to - from < spacing {
                let station = stations.iter().find(|s| s.z == from || s.z == to);
                let name = station.map_or("", |s| &s.name);
                let span = top.table("station").map_or(0..0, |r| r.span_of(name));
                let message = format!("station `{name}` is {:.3e} m from the end of a section", to - from);
                let problem = Problem::new(Kind::Geometry, &span, message);
                top.log.error(problem.hint("put it at the section's end, or set shaft.minimum_spacing"));
            }
            let count = ((to - from) / section.properties.element_length - 1e-9).ceil().max(1.0) as usize;
            for k in 1..=count {
                let left = line.node_z[line.node_z.len() - 1];
                let right = if k == count { to } else { from + (to - from) * (k as f64 / count as f64) };
                line.node_z.push(right);
                line.elements.extend(element(section, left, right));
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
    Some(ShaftElement {
        length: right - left,
        outer_diameter: ends(section.outer),
        inner_diameter: ends(section.inner),
        material: p.material.clone()?,
        shear: p.shear,
        rotary_inertia: p.rotary_inertia,
        axial_force: p.axial_force,
        torque: p.torque,
        proportional_damping: p.proportional,
        internal_viscous: p.internal_viscous,
    })
}
