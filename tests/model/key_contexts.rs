//! A valid machine around any declared key: the table that holds it, with what its condition asks for.

use rotordyn::model::keys::{self, KeyDescription, KindName};
use rotordyn::model::{ExternalColumn, ExternalFile, Loaded, ModelErrors, Options, load_with};
use toml::{Table, Value};

/// Machine with one item of every kind, each called `T`.
const MACHINE: &str = r#"
    model = { name = "machine" }
    material.steel = { young = "207 GPa", poisson = 0.3, density = "7850 kg/m^3" }
    lubricant.oil = { viscosity = "0.04 Pa s", pressure_viscosity = "2.2e-8 1/Pa" }
    station = { A = "30 mm", B = "380 mm", C = "480 mm" }
    shaft = { element_length = "50 mm", section = [{ length = "500 mm", outer_diameter = "25 mm" }] }
    bearing.support = { model = "linear", station = "B", k_xx = "1e7 N/m", k_yy = "1e7 N/m", k_zz = "1e7 N/m" }
    bearing.other = { model = "ball", station = "A", designation = "6205" }
    bearing.B = { model = "ball", station = "B", designation = "6205" }
    body.T = { position = "0, -230, 270 mm", mass = "20 kg", inertia = "0.2 kg m^2" }
    bushing.hold = { between = ["body.T", "ground"], k_x = "1e6 N/m", k_y = "1e6 N/m", k_z = "1e6 N/m" }
    unbalance.own = { station = "C", magnitude = "10 g mm" }
    probe.disc_x = { at = "station.C", direction = "x" }
    probe.disc_y = { at = "station.C", direction = "y" }
    speed = { profile = "ramp", to = "2000 rpm", ramp = "10 s" }
    study.run_up = {}
    study.orders = {}
"#;

/// Content of a table without which it is not valid, by its path and the condition of the key.
fn skeleton(path: &str, condition: &str) -> &'static str {
    match path {
        "material" => "young = \"207 GPa\"\npoisson = 0.3\ndensity = \"7850 kg/m^3\"",
        "lubricant" if condition.contains("grade") => "temperature = \"40 degC\"",
        "lubricant" => "viscosity = \"0.04 Pa s\"\npressure_viscosity = \"2.2e-8 1/Pa\"",
        "rotor" => "centre = \"0.25 m\"\nmass = \"5 kg\"\nlength = \"0.6 m\"\nouter_diameter = \"40 mm\"",
        "disc" => "station = \"C\"\nouter_diameter = \"250 mm\"\nthickness = \"15 mm\"\nmaterial = \"steel\"",
        "housing" => {
            "station = \"B\"\nmass = \"5 kg\"\ninertia = \"0.02 kg m^2\"\nk_x = \"1e7 N/m\"\nk_y = \"1e7 N/m\"\n\
             k_z = \"1e7 N/m\"\nk_tilt = \"1e5 N m/rad\"\nk_spin = \"1e5 N m/rad\""
        }
        "shaft.layer" => {
            "from = \"50 mm\"\nlength = \"100 mm\"\nouter_diameter = \"30 mm\"\ninner_diameter = \"25 mm\""
        }
        "sensor" => "at = \"station.C\"\nmass = \"0.01 kg\"",
        "bushing" => "between = [\"station.C\", \"ground\"]\nk_y = \"1e6 N/m\"",
        "joint" if condition.contains("kind") => "between = [\"station.C\", \"ground\"]",
        "joint" => "between = [\"station.C\", \"ground\"]\nkind = \"spherical\"",
        "belt" => "station = \"C\"",
        "bearing" if condition.contains("\"linear\"") && condition.contains("speed") => {
            "station = \"A\"\nspeed = \"0, 3000 rpm\"\nk_xx = \"1e7 N/m\"\nk_yy = \"1e7 N/m\""
        }
        "bearing" if condition.contains("\"linear\"") => {
            "station = \"A\"\nk_xx = \"1e7 N/m\"\nk_yy = \"1e7 N/m\""
        }
        "bearing" if condition.contains("radial_ball") => {
            "station = \"A\"\ndesignation = \"6205\"\nstiffness_damping = \"1e-4 s\""
        }
        "bearing" if condition.contains("free_ball") => {
            "station = \"A\"\nmodel = \"free_ball\"\ndesignation = \"6205\""
        }
        "bearing" if condition.contains("friction_law = \"film\"") => {
            "station = \"A\"\nmodel = \"free_ball\"\ndesignation = \"6205\""
        }
        "bearing.traction_curve" => "limit = 0.05\ndecay = \"50 s/m\"",
        "bearing" if condition.contains("power_law") => {
            "station = \"A\"\nmodel = \"ball\"\ndesignation = \"6205\"\nball_inertia = \"none\""
        }
        "bearing" if condition.contains("force") => {
            "station = \"A\"\nmodel = \"ball\"\ndesignation = \"6205\"\nball_inertia = \"none\""
        }
        "bearing" => "station = \"A\"\nmodel = \"ball\"\ndesignation = \"6205\"",
        "bearing.preload" => "force = \"150 N\"",
        "bearing.power_law" => "stiffness = \"1e10 N/m^1.5\"\nexponent = 1.5\nrange = \"600, 2000 N\"",
        "bearing.ball_inertia" => "centrifugal_force = \"120 N\"",
        "bearing.lubrication" => "f_0 = 1.5",
        "bearing.contact_stiffness" => "inner = \"1e10 N/m^1.5\"\nouter = \"1e10 N/m^1.5\"",
        "bearing.stiffness_damping" => "inner = \"1e-4 s\"\nouter = \"1e-4 s\"",
        "bearing.defect" if condition.contains("dent") => {
            "on = \"outer\"\nwidth = \"0.17 mm\"\nangle = \"12 deg\""
        }
        "bearing.defect" if condition.contains("bump") => {
            "on = \"outer\"\nwidth = \"0.17 mm\"\nangle = \"12 deg\"\nheight = \"0.25 um\""
        }
        "bearing.defect" if condition.contains("spall") => {
            "on = \"outer\"\nwidth = \"0.17 mm\"\nangle = \"12 deg\"\ndepth = \"1 um\""
        }
        "bearing.defect" if condition.contains("on = ") => {
            "kind = \"dent\"\nwidth = \"0.17 mm\"\nangle = \"12 deg\"\ndepth = \"1 um\""
        }
        "bearing.defect" => {
            "kind = \"dent\"\non = \"outer\"\nwidth = \"0.17 mm\"\nangle = \"12 deg\"\ndepth = \"1 um\""
        }
        "bearing.inner_waviness" | "bearing.outer_waviness" | "bearing.ball_waviness" => {
            "order = 2\namplitude = \"1 um\""
        }
        "bearing.off_size" => "ball = 0\ndiameter_difference = \"0.2 um\"",
        "bearing.inner_eccentricity" | "bearing.outer_eccentricity" => "amount = \"1 um\"",
        "unbalance" if condition.contains("grade") => "station = \"C\"\nspeed = \"3000 rpm\"",
        "unbalance" if condition.contains("mass") => "station = \"C\"\nradius = \"30 mm\"",
        "unbalance" => "station = \"C\"\nmagnitude = \"560 g mm\"",
        "load" => "at = \"station.C\"\nforce = \"0, -100, 0 N\"",
        "probe" | "study.frf.excitation" => "at = \"station.C\"\ndirection = \"x\"",
        "damping.modal" => "frequency = \"0, 200 Hz\"\nratio = [0.005, 0.01]",
        "drive" if condition.contains("torque") => {
            "station = \"A\"\nspeed = \"0, 3000 rpm\"\ntorque = \"5, 0 N m\""
        }
        "drive" => "kind = \"prescribed\"",
        "speed" if condition.contains("constant") => "speed = \"600 rpm\"\nduration = \"1 s\"",
        "speed" if condition.contains("table") => "time = \"0, 10 s\"\nspeed = \"0, 1200 rpm\"",
        "speed" if condition.contains("coast") => {
            "from = \"600 rpm\"\ntime_constant = \"1 s\"\nduration = \"3 s\""
        }
        "speed" if condition.contains("tacho") => "",
        "speed" if condition.contains("measured") => "pulses = \"0, 0.1, 0.2, 0.29, 0.38 s\"",
        "speed" => "profile = \"ramp\"\nto = \"3000 rpm\"\nramp = \"10 s\"",
        "study.campbell" | "study.unbalance" => "speeds = \"0, 600 rpm\"",
        "study.critical" | "study.critical_map" | "study.torsional" => "max_speed = \"6000 rpm\"",
        "study.frf" => "frequencies = \"1, 2 Hz\"\nexcitation.x = { at = \"station.C\", direction = \"x\" }",
        "study.bifurcation" => "parameter = \"speed\"\nvalues = [\"1000 rpm\", \"2000 rpm\", \"3000 rpm\"]",
        "study.bifurcation.values" => "from = \"1000 rpm\"\nto = \"5000 rpm\"",
        "study.frf.frequencies" => "from = \"1 Hz\"\nto = \"400 Hz\"\ncount = 5",
        "study.bearing.loads" => "from = \"0 N\"\nto = \"400 N\"\ncount = 5",
        "study.bearing.displacements" => "from = \"0 um\"\nto = \"20 um\"\ncount = 5",
        "study.bearing.skidding_loads" => "from = \"10 N\"\nto = \"400 N\"\ncount = 5",
        "study.bearing.skidding_speeds" => "from = \"1000 rpm\"\nto = \"9000 rpm\"\ncount = 5",
        "study.bearing.cage_angles" => "from = \"0 deg\"\nto = \"20 deg\"\ncount = 5",
        path if path.ends_with(".operating_speeds") => "from = \"900 rpm\"\nto = \"1200 rpm\"\ncount = 2",
        path if path.ends_with(".speeds") => "from = \"0 rpm\"\nto = \"1200 rpm\"\ncount = 5",
        _ => "",
    }
}

/// A machine with the table that holds a key.
#[derive(Clone)]
pub struct Context {
    document: Table,
    /// Steps from the root to the table.
    steps: Vec<Step>,
}

#[derive(Clone)]
enum Step {
    Key(String),
    /// First item of a list.
    First,
}

impl Context {
    /// The document with or without a key in the table.
    pub fn with(&self, key: &str, value: Option<Value>) -> String {
        let mut document = self.document.clone();
        let table = at(&mut document, &self.steps);
        match value {
            Some(value) => _ = table.insert(key.into(), value),
            None => _ = table.remove(key),
        }
        toml::to_string(&document).unwrap()
    }

    /// Remove a key of the table.
    pub fn remove(&mut self, key: &str) {
        at(&mut self.document, &self.steps).remove(key);
    }
}

fn at<'t>(document: &'t mut Table, steps: &[Step]) -> &'t mut Table {
    let mut table = document;
    let mut rest = steps.iter().peekable();
    while let Some(step) = rest.next() {
        let Step::Key(name) = step else { panic!("a list without a key") };
        if matches!(rest.peek(), Some(Step::First)) {
            rest.next();
            let list = table.entry(name.clone()).or_insert_with(|| Value::Array(vec![Table::new().into()]));
            if !list.is_array() {
                *list = Value::Array(vec![Table::new().into()]);
            }
            table = list.as_array_mut().unwrap()[0].as_table_mut().unwrap();
        } else {
            let inner = table.entry(name.clone()).or_insert_with(|| Table::new().into());
            if !inner.is_table() {
                *inner = Table::new().into();
            }
            table = inner.as_table_mut().unwrap();
        }
    }
    table
}

/// One context for each condition under which a key applies.
pub fn contexts_of(key: &KeyDescription) -> Vec<Context> {
    key.conditions().iter().map(|condition| context(key, condition)).collect()
}

fn context(key: &KeyDescription, condition: &str) -> Context {
    let mut document: Table = MACHINE.parse().unwrap();
    let all = keys::all();
    let parts: Vec<&str> = key.path.split('.').collect();
    let mut steps = Vec::new();
    // what the key's own table excludes or replaces
    let others: &[&str] = match parts[0] {
        "rotor" => &["shaft"],
        "housing" => &["body", "bushing"],
        "speed" => &["speed"],
        _ => &[],
    };
    others.iter().for_each(|other| _ = document.remove(*other));
    for k in 1..parts.len() {
        let path = parts[..k].join(".");
        // of a table with several forms the one that has the next key
        let member = parts[..=k].join(".");
        let forms: Vec<&KeyDescription> = all.iter().filter(|key| key.path == path).collect();
        let table = forms.iter().find(|form| {
            let own = keys::find(&path).unwrap();
            own.members.iter().any(|m| m.path == member)
                && form.members > 0
                && of_form(form, key, k + 1 == parts.len())
        });
        let table = table.unwrap_or_else(|| panic!("no table {path} with {member}"));
        steps.push(Step::Key(parts[k - 1].into()));
        match table.kind {
            KindName::NamedTables => steps.push(Step::Key("T".into())),
            KindName::TableList => steps.push(Step::First),
            _ => {}
        }
        let own = if k + 1 == parts.len() {
            condition.to_string()
        } else {
            let next = all.iter().find(|key| key.path == member && key.members > 0).unwrap();
            next.conditions().first().cloned().unwrap_or_default()
        };
        let content = if is_spectrum(&path, table) { "amplitude = \"1 um\"" } else { skeleton(&path, &own) };
        let inner = at(&mut document, &steps);
        for text in [content.to_string(), assignments(&own)] {
            inner.extend(text.parse::<Table>().unwrap_or_else(|error| panic!("{text}: {error}")));
        }
        if inner.contains_key("station") {
            inner.remove("position");
        }
    }
    Context { document, steps }
}

fn is_spectrum(path: &str, table: &KeyDescription) -> bool {
    path.ends_with("waviness") && table.kind == KindName::Table
}

/// Whether a table of several forms is the one with the key: waviness as a list has orders, as a spectrum a range.
fn of_form(form: &KeyDescription, key: &KeyDescription, is_parent: bool) -> bool {
    if !is_parent || !form.path.ends_with("waviness") {
        return true;
    }
    let of_list = matches!(key.name, "order" | "phase" | "ball");
    match form.kind {
        KindName::TableList => of_list || key.name == "amplitude",
        _ => !of_list,
    }
}

/// Conditions, "a = 1, b = 2", as lines of TOML.
fn assignments(condition: &str) -> String {
    let mut lines = String::new();
    for part in condition.split(", ") {
        let starts = part
            .split_once(" = ")
            .is_some_and(|(name, _)| name.chars().all(|c| c.is_alphanumeric() || c == '_'));
        lines.push_str(if lines.is_empty() {
            ""
        } else if starts {
            "\n"
        } else {
            ", "
        });
        lines.push_str(part);
    }
    lines
}

pub fn load(text: &str) -> Result<Loaded, ModelErrors> {
    let column = |name: &str, unit: &str, values: Vec<f64>| ExternalColumn {
        name: name.into(),
        unit: unit.into(),
        values,
    };
    let columns = vec![column("pulse", "s", (0..40).map(|k| 0.1 * f64::from(k)).collect())];
    let file = ExternalFile { path: "tacho.csv".into(), content: Ok(columns) };
    load_with("machine.toml", text, &Options::default(), &[file])
}
