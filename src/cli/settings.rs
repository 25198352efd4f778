//! Study settings from flags and from defaults for missing sections.
//!
//! Every setting is the path of a declared key and its value as text, as in `--set`: the reader of the file then
//! checks units and ranges of flags, `--set` and file in one place, with the location in the message, and a stored
//! run keeps its settings as text beside the text of its model.

use rotordyn::model::study::SweepVariable;
use rotordyn::model::{Drive, Model, SpeedProfile, Station, keys};

use super::args::keys::{default, default_words};
use super::args::{BearingArgs, CriticalMapArgs, OrdersArgs, SpectrogramArgs, TorsionalArgs};
use super::failure::Failure;

/// Settings of one study, and a note to the user.
#[derive(Clone, Debug, Default)]
pub struct Settings {
    pub set: Vec<(String, String)>,
    /// Paths that a flag sets, with the flag and its value as written.
    pub flags: Vec<(String, String)>,
    /// Defaults used because the file has no section of the study.
    pub note: Option<String>,
}

/// Collects the settings of `study.<name>`.
pub struct SettingsBuilder {
    name: &'static str,
    settings: Settings,
}

impl SettingsBuilder {
    pub fn new(name: &'static str) -> Self {
        Self { name, settings: Settings::default() }
    }

    /// Adds the value of the flag that is named like its key, if given.
    pub fn set_flag(&mut self, key: &str, value: Option<String>) {
        let written = value.as_ref().map(|value| format!("--{} {value}", key.replace('_', "-")));
        self.set_as_written(key, value, written);
    }

    /// Adds a value that a flag of another name gives: the flag, its value as written, and what that means.
    pub fn set_from(&mut self, flag: &str, given: Option<&String>, key: &str, value: fn(&str) -> String) {
        let written = given.map(|given| format!("{flag} {}", toml_string(given)));
        self.set_as_written(key, given.map(|given| value(given)), written);
    }

    /// Adds a value and the text of the command line that gives it.
    pub fn set_as_written(&mut self, key: &str, value: Option<String>, written: Option<String>) {
        let path = format!("study.{}.{key}", self.name);
        debug_assert!(keys::find(&path).is_ok(), "{path} is not declared");
        self.settings.flags.extend(written.map(|written| (path.clone(), written)));
        self.settings.set.extend(value.map(|value| (path, value)));
    }

    /// Adds the default values if the file has no section of the study; flags take precedence.
    pub fn defaults(mut self, missing: bool, description: &str, values: &[(&str, String)]) -> Settings {
        if missing {
            let path = |key: &str| format!("study.{}.{key}", self.name);
            let given = |key: &str| self.settings.set.iter().any(|(p, _)| *p == path(key));
            let mut set: Vec<(String, String)> =
                values.iter().filter(|(key, _)| !given(key)).map(|(key, v)| (path(key), v.clone())).collect();
            set.append(&mut self.settings.set);
            self.settings.set = set;
            self.settings.note =
                Some(format!("the file has no [study.{}]; default: {description}", self.name));
        }
        self.settings
    }
}

pub fn equilibrium(model: &Model, speed: Option<&String>, fixed_cage: bool) -> Settings {
    let mut draft = SettingsBuilder::new("static");
    draft.set_flag("speed", speed.map(|text| toml_string(text)));
    let given = fixed_cage.then(|| "--fixed-cage-angle".to_string());
    draft.set_as_written("cage_average", given.as_ref().map(|_| "false".into()), given);
    let missing = model.studies.equilibrium.is_none();
    draft.defaults(missing, "averaged over the cage angle", &[("cage_average", "true".into())])
}

pub fn modal(model: &Model, speed: Option<&String>, modes: Option<usize>) -> Settings {
    let mut draft = SettingsBuilder::new("modal");
    draft.set_from("--speed", speed, "speeds", toml_string);
    draft.set_flag("modes", modes.map(|n| n.to_string()));
    let modes = default("study.modal.modes");
    let (speeds, words) = match top_speed(model) {
        Some(top) => (format!("\"0, {top} rpm\""), format!("{modes} modes at 0 and {top} rpm")),
        None => (default("study.modal.speeds"), format!("{modes} modes at standstill")),
    };
    draft.defaults(model.studies.modal.is_none(), &words, &[("speeds", speeds)])
}

pub fn campbell(model: &Model, max_speed: Option<&String>, modes: Option<usize>) -> Settings {
    let mut draft = SettingsBuilder::new("campbell");
    draft.set_from("--max-speed", max_speed, "speeds", |top| sweep("0 rpm", top, 25));
    draft.set_flag("modes", modes.map(|n| n.to_string()));
    let top = rpm_or(top_speed(model), 3000.0);
    let words = format!("25 speeds up to {top}, {} modes", default("study.campbell.modes"));
    draft.defaults(model.studies.campbell.is_none(), &words, &[("speeds", sweep("0 rpm", &top, 25))])
}

pub fn critical(model: &Model, max_speed: Option<&String>, orders: &[String]) -> Settings {
    let mut draft = SettingsBuilder::new("critical");
    draft.set_flag("max_speed", max_speed.map(|text| toml_string(text)));
    draft.set_flag("orders", toml_array(orders));
    let top = rpm_or(top_speed(model).map(|top| 3.0 * top), 6000.0);
    let words = format!("up to {top}");
    draft.defaults(model.studies.critical.is_none(), &words, &[("max_speed", toml_string(&top))])
}

pub fn critical_map(model: &Model, args: &CriticalMapArgs) -> Settings {
    let mut draft = SettingsBuilder::new("critical_map");
    draft.set_flag("max_speed", args.max_speed.as_ref().map(|text| toml_string(text)));
    draft.set_flag("lowest_stiffness", args.lowest_stiffness.as_ref().map(|text| toml_string(text)));
    draft.set_flag("highest_stiffness", args.highest_stiffness.as_ref().map(|text| toml_string(text)));
    let top = rpm_or(top_speed(model).map(|top| 3.0 * top), 6000.0);
    let words = format!("up to {top}");
    draft.defaults(model.studies.critical_map.is_none(), &words, &[("max_speed", toml_string(&top))])
}

pub fn torsional(model: &Model, args: &TorsionalArgs) -> Settings {
    let mut draft = SettingsBuilder::new("torsional");
    draft.set_flag("max_speed", args.max_speed.as_ref().map(|text| toml_string(text)));
    draft.set_flag("orders", toml_array(&args.orders));
    draft.set_flag("modes", args.modes.map(|n| n.to_string()));
    draft.set_from("--speed-range", args.speed_range.as_ref(), "operating_speeds", toml_string);
    let top = rpm_or(top_speed(model).map(|top| 1.5 * top), 6000.0);
    let words = format!("orders 1 and 2 up to {top}");
    draft.defaults(model.studies.torsional.is_none(), &words, &[("max_speed", toml_string(&top))])
}

pub fn frf(
    model: &Model,
    speed: Option<&String>,
    max_frequency: Option<&String>,
    quantity: Option<&String>,
) -> Settings {
    let sweep = |top: &str| format!("{{ from = \"1 Hz\", to = {}, step = \"0.25 Hz\" }}", toml_string(top));
    let mut draft = SettingsBuilder::new("frf");
    draft.set_flag("speed", speed.map(|text| toml_string(text)));
    draft.set_from("--max-frequency", max_frequency, "frequencies", sweep);
    draft.set_flag("quantity", quantity.map(|text| toml_string(text)));
    let place = match (model.discs.first(), &model.rigid_rotor, model.stations.first()) {
        (Some(disc), ..) => format!("disc.{}", disc.name),
        (None, Some(_), _) => "rotor".to_string(),
        (None, None, Some(station)) => format!("station.{}", station.name),
        (None, None, None) => "ground".to_string(),
    };
    let words = format!("unit forces along x and y at {place}, 1 to 500 Hz");
    draft.defaults(model.studies.frf.is_none(), &words, &[("frequencies", sweep("500 Hz"))])
}

pub fn unbalance(model: &Model, max_speed: Option<&String>, speed_range: Option<&String>) -> Settings {
    let mut draft = SettingsBuilder::new("unbalance");
    draft.set_from("--speed-range", speed_range, "operating_speeds", toml_string);
    draft.set_from("--max-speed", max_speed, "speeds", |top| sweep("1 rpm", top, 200));
    let top = rpm_or(top_speed(model).map(|top| 1.5 * top), 6000.0);
    let words = format!("200 speeds up to {top}");
    let missing = model.studies.unbalance.is_none();
    let mut settings = draft.defaults(missing, &words, &[("speeds", sweep("1 rpm", &top, 200))]);
    if missing && let Some((unbalance, words)) = default_unbalance(model) {
        settings.set.push(("unbalance".into(), unbalance));
        settings.note = settings.note.map(|note| format!("{note}; {words}"));
    }
    settings
}

/// Unbalance of a file that has none: of grade G 6.3 at the heaviest disc, else in the middle of the shaft.
fn default_unbalance(model: &Model) -> Option<(String, String)> {
    if !model.unbalances.is_empty() {
        return None;
    }
    let heaviest = model.discs.iter().max_by(|a, b| a.mass.total_cmp(&b.mass));
    let node = heaviest.map_or(model.node_z.len() / 2, |disc| disc.node);
    let distance = |station: &Station| station.node.abs_diff(node);
    let station = &model.stations.iter().min_by_key(|station| distance(station))?.name;
    let speed = rpm_or(top_speed(model), 3000.0);
    let words = format!("no [unbalance.X]: grade G6.3 at {speed} at station {station}");
    let keys = [("station", station.as_str()), ("grade", "G6.3"), ("speed", speed.as_str())];
    let table: Vec<String> =
        keys.iter().map(|(key, text)| format!("{key} = {}", toml_string(text))).collect();
    Some((format!("{{ residual = {{ {} }} }}", table.join(", ")), words))
}

pub fn run_up(
    model: &Model,
    step: Option<&String>,
    integrator: Option<&String>,
    sample_rate: Option<&String>,
    motion_rate: Option<&String>,
    cage_phases: Option<usize>,
) -> Settings {
    let mut draft = SettingsBuilder::new("run_up");
    draft.set_flag("motion_rate", motion_rate.map(|text| toml_string(text)));
    draft.set_flag("step", step.map(|text| toml_string(text)));
    draft.set_flag("integrator", integrator.map(|text| toml_string(text)));
    draft.set_flag("sample_rate", sample_rate.map(|text| toml_string(text)));
    draft.set_flag("cage_phases", cage_phases.map(|n| n.to_string()));
    let [integrator, rate] =
        ["integrator", "sample_rate"].map(|key| default_words(&format!("study.run_up.{key}")));
    let words = format!("{integrator}, time step by speed and bearings, sampling rate {rate}");
    let missing = model.studies.run_up.is_none();
    let mut settings =
        draft.defaults(missing, &words, &[("sample_rate", default("study.run_up.sample_rate"))]);
    if missing && stands_still(model) {
        let ramp = "{ profile = \"ramp\", to = \"3000 rpm\", ramp = \"5 s\" }";
        settings.set.push(("speed".into(), ramp.into()));
        settings.note = settings.note.map(|note| format!("{note}; no [speed]: ramp to 3000 rpm in 5 s"));
    }
    settings
}

/// Whether nothing moves the machine in a run-up: no [speed] and no load over time.
fn stands_still(model: &Model) -> bool {
    let standstill = SpeedProfile::Constant { speed: 0.0, duration: 1.0 };
    let prescribed = matches!(model.drive, Drive::Prescribed { .. });
    prescribed && model.profile == standstill && model.loads.iter().all(|load| load.factor.is_constant())
}

/// Number of points of a sweep given by a flag.
const DEFAULT_SWEEP_POINTS: usize = 41;

/// Settings of `study.bearing`; files without it use the defaults of the study.
///
/// # Errors
/// `--sweep` that is neither a name nor a name with a range.
pub fn bearing(args: &BearingArgs) -> Result<Settings, Failure> {
    let mut draft = SettingsBuilder::new("bearing");
    draft.set_as_written("bearings", toml_array(&args.bearing), written("--bearing", &args.bearing));
    draft.set_flag("load", args.load.as_ref().map(|text| toml_string(text)));
    draft.set_flag("moment", args.moment.as_ref().map(|text| toml_string(text)));
    draft.set_flag("speed", args.speed.as_ref().map(|text| toml_string(text)));
    draft.set_flag("constrain", toml_array(&args.constrain));
    draft.set_flag("along", args.along.as_ref().map(|text| toml_string(text)));
    draft.set_flag("cage_average", args.cage_average.then(|| "true".into()));
    let mut plain = Vec::new();
    for text in &args.sweep {
        let Some((name, range)) = text.split_once('=') else {
            plain.push(text.clone());
            continue;
        };
        let known = SweepVariable::ALL.iter().find(|(of, _)| of.name() == name.trim());
        let (Some((_, key)), Some((from, to))) = (known, range.split_once("..")) else {
            let message = format!(
                "--sweep {text}: expected load, displacement, speed or cage_angle with a range, such as \
                 load=\"0 N .. 2 kN\""
            );
            return Err(Failure::Input(message));
        };
        let values = sweep(from.trim(), to.trim(), DEFAULT_SWEEP_POINTS);
        draft.set_as_written(key, Some(values), Some(format!("--sweep {text}")));
    }
    draft.set_flag("sweep", toml_array(&plain));
    draft.set_flag("skidding", args.skidding.then(|| "true".into()));
    draft.set_flag("skidding_loads", args.skidding_loads.as_deref().map(toml_string));
    draft.set_flag("skidding_speeds", args.skidding_speeds.as_deref().map(toml_string));
    Ok(draft.settings)
}

pub fn spectrogram(model: &Model, args: &SpectrogramArgs) -> Settings {
    let SpectrogramArgs { stored, length, max_frequency } = args;
    let mut draft = SettingsBuilder::new("spectrogram");
    draft.set_flag("channels", toml_array(&stored.channels));
    draft.set_flag("window", stored.window.as_ref().map(|text| toml_string(text)));
    draft.set_flag("length", length.as_ref().map(|text| toml_string(text)));
    draft.set_flag("overlap", stored.overlap.clone());
    draft.set_flag("max_frequency", max_frequency.as_ref().map(|text| toml_string(text)));
    draft.set_flag("orders", toml_array(&stored.orders));
    let [window, length] = ["window", "length"].map(|key| default_words(&format!("study.spectrogram.{key}")));
    let words = format!("{window} window of {length}");
    let values = [("window", default("study.spectrogram.window"))];
    let settings = draft.defaults(model.studies.spectrogram.is_none(), &words, &values);
    with_run_up(model, settings)
}

pub fn orders(model: &Model, args: &OrdersArgs) -> Settings {
    let stored = &args.stored;
    let mut draft = SettingsBuilder::new("orders");
    draft.set_flag("channels", toml_array(&stored.channels));
    draft.set_flag("window", stored.window.as_ref().map(|text| toml_string(text)));
    draft.set_flag("resolution", args.resolution.clone());
    draft.set_flag("overlap", stored.overlap.clone());
    draft.set_flag("max_order", args.max_order.clone());
    draft.set_flag("bandwidth", args.bandwidth.clone());
    draft.set_as_written("cuts", toml_array(&stored.orders), written("--orders", &stored.orders));
    let [resolution, top] =
        ["resolution", "max_order"].map(|key| default_words(&format!("study.orders.{key}")));
    let words = format!("order resolution {resolution} up to order {top}");
    let values = [("window", default("study.orders.window"))];
    let settings = draft.defaults(model.studies.orders.is_none(), &words, &values);
    with_run_up(model, settings)
}

/// Adds the run-up section that the analyses need, missing in the file if the run-up used defaults.
fn with_run_up(model: &Model, mut settings: Settings) -> Settings {
    if model.studies.run_up.is_none() {
        let key = "study.run_up.sample_rate";
        settings.set.insert(0, (key.into(), default(key)));
    }
    settings
}

/// Highest speed of the profile \[rpm\]; `None` at standstill.
pub fn top_speed(model: &Model) -> Option<f64> {
    let top = super::terminal::rpm(model.profile.top_speed());
    (top > 0.0).then(|| (top * 1e6).round() / 1e6)
}

fn rpm_or(speed: Option<f64>, other: f64) -> String {
    format!("{} rpm", speed.unwrap_or(other))
}

/// A quoted TOML string.
pub fn toml_string(text: &str) -> String {
    toml::Value::String(text.into()).to_string()
}

fn sweep(from: &str, to: &str, count: usize) -> String {
    format!("{{ from = {}, to = {}, count = {count} }}", toml_string(from), toml_string(to))
}

/// A flag with several values as written on the command line.
pub fn written(flag: &str, items: &[String]) -> Option<String> {
    (!items.is_empty()).then(|| format!("{flag} {}", items.join(",")))
}

/// A TOML array: numbers unquoted, everything else as strings; `None` if empty.
pub fn toml_array(items: &[String]) -> Option<String> {
    let item = |text: &String| if text.parse::<f64>().is_ok() { text.clone() } else { toml_string(text) };
    (!items.is_empty()).then(|| format!("[{}]", items.iter().map(item).collect::<Vec<_>>().join(", ")))
}

#[cfg(test)]
mod tests {
    use super::*;
    use rotordyn::model::{Options, load};

    const MACHINE: &str = r#"
        model = { name = "machine" }
        material.steel = { young = "207 GPa", poisson = 0.3, density = "7850 kg/m^3" }
        station = { A = "30 mm", B = "380 mm" }
        shaft = { element_length = "50 mm", section = [{ length = "500 mm", outer_diameter = "25 mm" }] }
        bearing.A = { model = "linear", station = "A", k_xx = "1e7 N/m", k_yy = "1e7 N/m" }
        unbalance.B = { station = "B", magnitude = "10 g mm" }
        probe.x = { at = "station.B", direction = "x" }
        speed = { profile = "ramp", to = "3000 rpm", ramp = "10 s" }
    "#;

    /// Settings of every study of a machine without studies, from the defaults of the command.
    #[test]
    fn defaults_of_commands_are_declared_and_valid() {
        let model = load("machine.toml", MACHINE, &Options::default()).unwrap().model;
        let settings = [
            equilibrium(&model, None, false),
            modal(&model, None, None),
            campbell(&model, None, None),
            critical(&model, None, &[]),
            frf(&model, None, None, None),
            unbalance(&model, None, None),
            run_up(&model, None, None, None, None, None),
            spectrogram(&model, &SpectrogramArgs::default()),
            orders(&model, &OrdersArgs::default()),
        ];
        for Settings { set, note, .. } in settings {
            assert!(!set.is_empty() && note.is_some());
            for (path, _) in &set {
                assert!(keys::find(path).is_ok() || path.starts_with("study.frf.excitation."), "{path}");
            }
            let options = Options { set, ..Options::default() };
            load("machine.toml", MACHINE, &options).unwrap_or_else(|errors| panic!("{note:?}: {errors}"));
        }
    }
}
