//! Elements of a saved rotor, with the numbers of its file (SI units, speeds in rad/s).

use super::tree::{Fields, Tree};
use rotordyn_model::{Kind, ModelErrors};
use std::collections::BTreeMap;

/// A rotor as ROSS saved it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SavedRotor {
    /// Version of ROSS, or nothing.
    pub version: String,
    pub shaft: Vec<ShaftPart>,
    pub couplings: Vec<Coupling>,
    pub discs: Vec<SavedDisc>,
    pub bearings: Vec<SavedBearing>,
    pub masses: Vec<SavedMass>,
    /// Damping of the whole rotor without its bearings, C = α M + β K: α \[1/s\], β \[s\].
    pub proportional: [f64; 2],
    /// Entries that are not read, with why.
    pub unread: Vec<(String, String)>,
}

/// Young's modulus, shear modulus \[Pa\] and density \[kg/m³\].
#[derive(Clone, Debug, PartialEq)]
pub struct SavedMaterial {
    pub name: String,
    pub young: f64,
    pub shear: f64,
    pub density: f64,
}

/// A shaft element.
#[derive(Clone, Debug, PartialEq)]
pub struct ShaftPart {
    pub name: String,
    pub node: usize,
    pub length: f64,
    /// Diameters at the left and right end \[m\].
    pub outer: [f64; 2],
    pub inner: [f64; 2],
    pub material: SavedMaterial,
    pub shear_effects: bool,
    pub rotary_inertia: bool,
    pub gyroscopic: bool,
    /// "cowper" or "hutchinson".
    pub shear_method: String,
    pub axial_force: f64,
    pub torque: f64,
    /// α \[1/s\], β \[s\].
    pub proportional: [f64; 2],
}

/// A coupling between two shaft nodes: inertia at both ends, springs and dampers by axis.
#[derive(Clone, Debug, PartialEq)]
pub struct Coupling {
    pub name: String,
    pub node: usize,
    pub length: f64,
    pub diameter: f64,
    /// Mass, polar and diametral inertia of the left and right half.
    pub ends: [[f64; 3]; 2],
    /// x, y, z, then about x, y, z.
    pub stiffness: [f64; 6],
    pub damping: [f64; 6],
}

/// A disc.
#[derive(Clone, Debug, PartialEq)]
pub struct SavedDisc {
    pub name: String,
    pub node: usize,
    pub mass: f64,
    pub polar: f64,
    pub diametral: f64,
}

/// Names of the coefficients of stiffness, damping and mass, without their first letter.
pub const AXES: [&str; 5] = ["xx", "xy", "yx", "yy", "zz"];

/// A bearing or seal by its coefficients.
#[derive(Clone, Debug, PartialEq)]
pub struct SavedBearing {
    pub name: String,
    pub node: usize,
    /// The node that holds it; ground without.
    pub link: Option<usize>,
    /// Speeds of the tables \[rad/s\].
    pub speed: Option<Vec<f64>>,
    /// Whirl frequencies of the tables \[rad/s\].
    pub whirl: Option<Vec<f64>>,
    /// Values in the order of [`AXES`], each over speed (outer) and whirl frequency (inner).
    pub stiffness: [Vec<f64>; 5],
    pub damping: [Vec<f64>; 5],
    pub mass: [Vec<f64>; 5],
    /// "pchip", "linear", or "spline" of ROSS 2.
    pub interpolation: String,
    /// What the file knows of it beyond the coefficients, in words.
    pub more: Vec<String>,
}

/// A point mass, of a support or on the shaft.
#[derive(Clone, Debug, PartialEq)]
pub struct SavedMass {
    pub name: String,
    pub node: usize,
    /// x, y, z \[kg\].
    pub mass: [f64; 3],
}

/// Keys of a bearing that are no property of it, or are read.
const BEARING_KEYS: [&str; 12] = [
    "n",
    "n_link",
    "tag",
    "color",
    "scale_factor",
    "frequency",
    "speed",
    "interpolation",
    "n_l",
    "n_r",
    "seal_leakage",
    "kwargs",
];
/// Elements of a file; more are no rotor.
const MAX_TABLES: usize = 5000;
/// Points of a table over speed and whirl frequency; more are no measurement.
const MAX_POINTS: usize = 20_000;
/// Classes whose `frequency` is that of the whirl also in ROSS 2.
const WHIRL_CLASSES: [&str; 2] = ["MagneticBearingElement", "SqueezeFilmDamper"];

impl SavedRotor {
    pub(super) fn read(tree: &Tree) -> Result<Self, ModelErrors> {
        if tree.root.len() > MAX_TABLES {
            let message = format!("the file has {} tables", tree.root.len());
            tree.problem(["", ""], Kind::OutOfRange, message, &format!("at most {MAX_TABLES} elements"), "");
            return Err(tree.errors());
        }
        let mut rotor = Self { version: version(tree), ..Self::default() };
        // by class and number: "Bearing 2" before "Bearing 10"
        let mut names: Vec<&String> = tree.root.keys().collect();
        names.sort_by_cached_key(|name| natural(name));
        for name in names {
            if name.starts_with('_') || name == "ross_version" {
                continue;
            }
            let Some(fields) = tree.element(name) else {
                let message = format!("{name} is no table of an element");
                tree.problem(
                    [name, ""],
                    Kind::WrongType,
                    message,
                    "a table such as [\"DiskElement_Disk 0\"]",
                    "",
                );
                continue;
            };
            if name == "parameters" {
                rotor.parameters(&fields);
            } else {
                rotor.element(&fields);
            }
        }
        if rotor.shaft.is_empty() && !tree.has_problems() {
            let message = "the file has no shaft element of ROSS".to_string();
            let expected = "tables such as [\"ShaftElement_Shaft Element 0\"]";
            let hint =
                "import reads what Rotor.save wrote, not a single element nor a model file of this program";
            tree.problem(["", ""], Kind::MissingKey, message, expected, hint);
        }
        rotor.check(tree);
        if tree.has_problems() { Err(tree.errors()) } else { Ok(rotor) }
    }

    /// Number of all elements.
    pub fn element_count(&self) -> usize {
        self.shaft.len() + self.couplings.len() + self.discs.len() + self.bearings.len() + self.masses.len()
    }

    /// Whether the file is of ROSS 2 or before, where a table over `frequency` is one over speed.
    pub fn is_before_3(&self) -> bool {
        is_before_3(&self.version)
    }

    fn parameters(&mut self, fields: &Fields) {
        self.proportional = ["alpha", "beta"].map(|key| fields.optional(key).unwrap_or(0.0));
        if fields.value("modal_damping_ratio").is_some() {
            let why = "damping ratios by mode number: give [damping.modal] over frequency";
            self.unread.push(("parameters.modal_damping_ratio".into(), why.into()));
        }
        let known =
            ["alpha", "beta", "modal_damping_ratio", "default_damping_ratio", "min_w", "max_w", "rated_w"];
        for key in fields.keys().filter(|key| !known.contains(key) && fields.value(key).is_some()) {
            self.unread.push((format!("parameters.{key}"), "no meaning known".into()));
        }
        if ["min_w", "max_w", "rated_w"].iter().any(|key| fields.value(key).is_some()) {
            let why = "operating speeds: give [speed] and study.unbalance.operating_speeds";
            self.unread.push(("parameters.min_w, max_w, rated_w".into(), why.into()));
        }
    }

    fn element(&mut self, fields: &Fields) {
        let class = fields.name.split('_').next().unwrap_or_default();
        match class {
            "ShaftElement" | "ShaftElement6DoF" | "ShaftTaperedElement" => {
                self.shaft.push(shaft_part(fields))
            }
            "CouplingElement" => self.couplings.push(coupling(fields)),
            "DiskElement" | "DiskElement6DoF" | "GearElement" | "GearElementTVMS" => {
                if class.starts_with("Gear") {
                    let why = "teeth and mesh; its mass and inertia are carried over as a disc";
                    self.unread.push((fields.name.into(), why.into()));
                }
                self.discs.push(SavedDisc {
                    name: fields.name.into(),
                    node: fields.need_node("n"),
                    mass: fields.number("m"),
                    polar: fields.number("Ip"),
                    diametral: fields.number("Id"),
                });
            }
            "PointMass" => self.masses.push(point_mass(fields)),
            _ if fields.value("kxx").is_some() && fields.value("cxx").is_some() => {
                let bearing = bearing(fields, class, is_before_3(&self.version));
                self.bearings.push(bearing);
            }
            _ => {
                let why = format!("elements of the class {class} have no counterpart");
                self.unread.push((fields.name.into(), why));
            }
        }
    }

    /// Nodes within each other's range, and a shaft without gaps.
    fn check(&self, tree: &Tree) {
        let mut lengths: BTreeMap<usize, (f64, &str)> = BTreeMap::new();
        let parts = self.shaft.iter().map(|part| (part.node, part.length, &part.name));
        for (node, length, name) in parts.chain(self.couplings.iter().map(|c| (c.node, c.length, &c.name))) {
            let (first, other) = *lengths.entry(node).or_insert((length, name));
            if (first - length).abs() > 1e-9 * first {
                let message = format!(
                    "{name}: its length of {length} m differs from the {first} m of {other} at the same node"
                );
                tree.problem(
                    [name, "L"],
                    Kind::Geometry,
                    message,
                    "elements of one length between the same nodes",
                    "",
                );
            }
        }
        for (k, (node, (_, name))) in lengths.iter().enumerate() {
            if *node != k {
                let message = format!("{name}: it starts at node {node}, but no element at node {k}");
                let hint = "two shafts in one file (coaxial rotors) are not read";
                tree.problem(
                    [name, "n"],
                    Kind::Disconnected,
                    message,
                    "one shaft, element after element",
                    hint,
                );
                return;
            }
        }
        let last = lengths.len();
        let discs = self.discs.iter().map(|disc| (&disc.name, disc.node));
        for (name, node) in discs.filter(|(_, node)| *node > last) {
            let message = format!("{name}: node {node} is not on the shaft");
            tree.problem([name, "n"], Kind::UnknownName, message, &format!("a node from 0 to {last}"), "");
        }
        let is_known = |node: usize| node <= last || self.masses.iter().any(|mass| mass.node == node);
        for bearing in &self.bearings {
            for (key, node) in [("n", Some(bearing.node)), ("n_link", bearing.link)] {
                if let Some(node) = node.filter(|node| !is_known(*node)) {
                    let message = format!("{}: there is no node {node}", bearing.name);
                    let expected = format!("a node from 0 to {last}, or the node of a PointMass");
                    tree.problem([&bearing.name, key], Kind::UnknownName, message, &expected, "");
                }
            }
        }
    }
}

/// A name as letters and numbers, for sorting.
fn natural(name: &str) -> Vec<(String, u64)> {
    let mut parts = Vec::new();
    let mut rest = name;
    while !rest.is_empty() {
        let letters = rest.find(|c: char| c.is_ascii_digit()).unwrap_or(rest.len());
        let digits = rest[letters..].find(|c: char| !c.is_ascii_digit()).map_or(rest.len(), |k| letters + k);
        parts.push((rest[..letters].to_string(), rest[letters..digits].parse().unwrap_or(0)));
        rest = &rest[digits..];
    }
    parts
}

fn version(tree: &Tree) -> String {
    tree.root.get("ross_version").and_then(|v| v.as_str()).unwrap_or_default().chars().take(20).collect()
}

fn is_before_3(version: &str) -> bool {
    version.split('.').next().and_then(|major| major.parse::<u32>().ok()).is_none_or(|major| major < 3)
}

fn shaft_part(fields: &Fields) -> ShaftPart {
    let end = |key: &str, other: f64| fields.optional(key).unwrap_or(other);
    let [outer, inner] = [fields.positive("odl"), fields.number("idl")];
    let [outer, inner] = [[outer, end("odr", outer)], [inner, end("idr", inner)]];
    if (0..2).any(|k| !(0.0..outer[k]).contains(&inner[k])) {
        let message = format!("inner diameters {inner:?} m, outer {outer:?} m");
        fields.refuse("idl", message, "inner diameters of 0 m or more, less than the outer ones");
    }
    let material = fields.table("material");
    let modulus = |key: &str| material.as_ref().map_or(1.0, |m| m.positive(key));
    ShaftPart {
        name: fields.name.into(),
        node: fields.need_node("n"),
        length: fields.positive("L"),
        outer,
        inner,
        material: SavedMaterial {
            name: material.as_ref().and_then(|m| m.text("name")).unwrap_or("material").into(),
            young: modulus("E"),
            shear: modulus("G_s"),
            density: material.as_ref().map_or(1.0, |m| m.number("rho")),
        },
        shear_effects: fields.flag("shear_effects", true),
        rotary_inertia: fields.flag("rotary_inertia", true),
        gyroscopic: fields.flag("gyroscopic", true),
        shear_method: fields.text("shear_method_calc").unwrap_or("cowper").into(),
        axial_force: end("axial_force", 0.0),
        torque: end("torque", 0.0),
        proportional: [end("alpha", 0.0), end("beta", 0.0)],
    }
}

fn coupling(fields: &Fields) -> Coupling {
    let side = |side: char| {
        let of = |key: &str| fields.number(&format!("{key}_{side}"));
        let polar = of("Ip");
        let diametral = fields.optional(&format!("Id_{side}")).filter(|v| *v != 0.0);
        [of("m"), polar, diametral.unwrap_or(0.5 * polar)]
    };
    let axes = |letter: char| {
        let at = |kind: char, axis: char| fields.optional(&format!("{letter}{kind}_{axis}")).unwrap_or(0.0);
        [at('t', 'x'), at('t', 'y'), at('t', 'z'), at('r', 'x'), at('r', 'y'), at('r', 'z')]
    };
    Coupling {
        name: fields.name.into(),
        node: fields.need_node("n"),
        length: fields.optional("L").filter(|l| *l > 0.0).unwrap_or(0.2),
        diameter: fields.optional("o_d").filter(|d| *d > 0.0).unwrap_or(0.2),
        ends: [side('l'), side('r')],
        stiffness: axes('k'),
        damping: axes('c'),
    }
}

fn point_mass(fields: &Fields) -> SavedMass {
    let all = fields.optional("m");
    let axis = |key: &str| fields.optional(key);
    let by_axis = ["mx", "my", "mz"].map(axis);
    let mass = match (by_axis, all) {
        ([None, None, None], Some(all)) => [all; 3],
        ([None, None, None], None) => [fields.number("m"); 3],
        (some, _) => some.map(|mass| mass.unwrap_or(0.0)),
    };
    SavedMass { name: fields.name.into(), node: fields.need_node("n"), mass }
}

fn bearing(fields: &Fields, class: &str, before_3: bool) -> SavedBearing {
    let axis = |key: &str| {
        let list = fields.list(key)?;
        if list.len() < 2 {
            return None;
        }
        if list.windows(2).any(|w| w[1] <= w[0]) {
            fields.refuse(key, format!("{key} does not increase"), "increasing values in rad/s");
        }
        Some(list)
    };
    let (mut speed, mut whirl) = (axis("speed"), axis("frequency"));
    if before_3 && speed.is_none() && !WHIRL_CLASSES.contains(&class) {
        (speed, whirl) = (whirl, None);
    }
    let columns = whirl.as_ref().map_or(1, Vec::len);
    if columns.saturating_mul(speed.as_ref().map_or(1, Vec::len)) > MAX_POINTS {
        let message = format!("{} speeds times {columns} frequencies", speed.as_ref().map_or(1, Vec::len));
        fields.refuse("speed", message, &format!("at most {MAX_POINTS} of both"));
        (speed, whirl) = (None, None);
    }
    let columns = whirl.as_ref().map_or(1, Vec::len);
    let count = speed.as_ref().map_or(1, Vec::len) * columns;
    let values = |name: String| -> Vec<f64> {
        if fields.value(&name).is_none() {
            // as in files of ROSS 1, without axial and mass coefficients
            return vec![0.0; count];
        }
        let found = match fields.rows(&name) {
            Some(rows)
                if speed.is_some() && whirl.is_some() && rows.iter().all(|row| row.len() == columns) =>
            {
                rows.concat()
            }
            _ => fields.list(&name).unwrap_or_default(),
        };
        match found.len() {
            1 => vec![found[0]; count],
            n if n == count => found,
            0 => vec![0.0; count],
            n => {
                let expected = format!("{count} values, as its speeds and frequencies have, or one");
                fields.refuse(&name, format!("{name} has {n} values"), &expected);
                vec![0.0; count]
            }
        }
    };
    let table = |letter: char| AXES.map(|axes| values(format!("{letter}{axes}")));
    let [stiffness, damping, mass] = ['k', 'c', 'm'].map(table);
    let is_coefficient =
        |key: &str| key.len() == 3 && key.starts_with(['k', 'c', 'm']) && AXES.contains(&&key[1..]);
    let more = fields.keys().filter(|key| !BEARING_KEYS.contains(key) && !is_coefficient(key));
    let given = |key: &&str| fields.value(key).is_some();
    SavedBearing {
        name: fields.name.into(),
        node: fields.need_node("n"),
        link: fields.node("n_link"),
        speed,
        whirl,
        stiffness,
        damping,
        mass,
        interpolation: fields
            .text("interpolation")
            .unwrap_or(if before_3 { "spline" } else { "pchip" })
            .into(),
        more: more.filter(given).map(str::to_string).collect(),
    }
}
