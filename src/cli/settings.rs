//! Study settings from flags and from defaults for missing sections; every setting is a path and a value, as
//! in `--set`.

use rotordyn::model::Model;
use rotordyn::model::study::SweepVariable;

use super::args::{BearingArgs, StoredArgs};
use super::failure::Failure;

/// Settings of one study, and a note to the user.
#[derive(Clone, Debug, Default)]
pub struct Settings {
    pub set: Vec<(String, String)>,
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

    /// Adds the value of a flag, if given.
    pub fn set_flag(&mut self, key: &str, value: Option<String>) {
        self.settings.set.extend(value.map(|value| (format!("study.{}.{key}", self.name), value)));
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
    draft.set_flag("speed", speed.map(toml_string));
    draft.set_flag("cage_average", fixed_cage.then(|| "false".into()));
    let missing = model.studies.equilibrium.is_none();
    draft.defaults(missing, "averaged over the cage angle", &[("cage_average", "true".into())])
}

pub fn modal(model: &Model, speed: Option<&String>, modes: Option<usize>) -> Settings {
    let mut draft = SettingsBuilder::new("modal");
    draft.set_flag("speeds", speed.map(toml_string));
    draft.set_flag("modes", modes.map(|n| n.to_string()));
    let (speeds, words) = match top_speed(model) {
        Some(top) => (format!("\"0, {top} rpm\""), format!("12 modes at 0 and {top} rpm")),
        None => ("\"0 rpm\"".to_string(), "12 modes at standstill".to_string()),
    };
    draft.defaults(model.studies.modal.is_none(), &words, &[("speeds", speeds)])
}

pub fn campbell(model: &Model, max_speed: Option<&String>, modes: Option<usize>) -> Settings {
    let mut draft = SettingsBuilder::new("campbell");
    draft.set_flag("speeds", max_speed.map(|top| sweep("0 rpm", top, 25)));
    draft.set_flag("modes", modes.map(|n| n.to_string()));
    let top = rpm_or(top_speed(model), 3000.0);
    let words = format!("25 speeds up to {top}, 12 modes");
    draft.defaults(model.studies.campbell.is_none(), &words, &[("speeds", sweep("0 rpm", &top, 25))])
}

pub fn critical(model: &Model, max_speed: Option<&String>, orders: &[String]) -> Settings {
    let mut draft = SettingsBuilder::new("critical");
    draft.set_flag("max_speed", max_speed.map(toml_string));
    draft.set_flag("orders", toml_array(orders));
    let top = rpm_or(top_speed(model).map(|top| 3.0 * top), 6000.0);
    let words = format!("up to {top}");
    draft.defaults(model.studies.critical.is_none(), &words, &[("max_speed", toml_string(&top))])
}

pub fn frf(
    model: &Model,
    speed: Option<&String>,
    max_frequency: Option<&String>,
    quantity: Option<&String>,
) -> Settings {
    let sweep = |top: &str| format!("{{ from = \"1 Hz\", to = {}, step = \"0.25 Hz\" }}", toml_string(top));
    let mut draft = SettingsBuilder::new("frf");
    draft.set_flag("speed", speed.map(toml_string));
    draft.set_flag("frequencies", max_frequency.map(|top| sweep(top)));
    draft.set_flag("quantity", quantity.map(toml_string));
    let place = match (model.discs.first(), &model.rigid_rotor, model.stations.first()) {
        (Some(disc), ..) => format!("disc.{}", disc.name),
        (None, Some(_), _) => "rotor".to_string(),
        (None, None, Some(station)) => format!("station.{}", station.name),
        (None, None, None) => "ground".to_string(),
    };
    let force = |axis: &str| format!("{{ at = {}, direction = \"{axis}\" }}", toml_string(&place));
    let words = format!("unit forces along x and y at {place}, 1 to 500 Hz");
    let values =
        [("frequencies", sweep("500 Hz")), ("excitation.x", force("x")), ("excitation.y", force("y"))];
    draft.defaults(model.studies.frf.is_none(), &words, &values)
}

pub fn unbalance(model: &Model, max_speed: Option<&String>) -> Settings {
    let mut draft = SettingsBuilder::new("unbalance");
    draft.set_flag("speeds", max_speed.map(|top| sweep("1 rpm", top, 200)));
    let top = rpm_or(top_speed(model).map(|top| 1.5 * top), 6000.0);
    let words = format!("200 speeds up to {top}");
    draft.defaults(model.studies.unbalance.is_none(), &words, &[("speeds", sweep("1 rpm", &top, 200))])
}

pub fn run_up(
    model: &Model,
    step: Option<&String>,
    integrator: Option<&String>,
    sample_rate: Option<&String>,
    cage_phases: Option<usize>,
) -> Settings {
    let mut draft = SettingsBuilder::new("run_up");
    draft.set_flag("step", step.map(toml_string));
    draft.set_flag("integrator", integrator.map(toml_string));
    draft.set_flag("sample_rate", sample_rate.map(toml_string));
    draft.set_flag("cage_phases", cage_phases.map(|n| n.to_string()));
    let words = "generalised-alpha, time step 100 us, sampling rate 2 kHz";
    draft.defaults(model.studies.run_up.is_none(), words, &[("step", toml_string("100 us"))])
}

/// Number of points of a sweep given by a flag.
const DEFAULT_SWEEP_POINTS: usize = 41;

/// Settings of `study.bearing`; files without it use the defaults of the study.
///
/// # Errors
/// `--sweep` that is neither a name nor a name with a range.
pub fn bearing(args: &BearingArgs) -> Result<Settings, Failure> {
    let mut draft = SettingsBuilder::new("bearing");
    draft.set_flag("bearings", toml_array(&args.bearing));
    draft.set_flag("load", args.load.as_ref().map(toml_string));
    draft.set_flag("moment", args.moment.as_ref().map(toml_string));
    draft.set_flag("speed", args.speed.as_ref().map(toml_string));
    draft.set_flag("constrain", toml_array(&args.constrain));
    draft.set_flag("along", args.along.as_ref().map(toml_string));
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
        draft.set_flag(key, Some(sweep(from.trim(), to.trim(), DEFAULT_SWEEP_POINTS)));
    }
    draft.set_flag("sweep", toml_array(&plain));
    Ok(draft.settings)
}

pub fn spectrogram(model: &Model, args: &StoredArgs) -> Settings {
    let mut draft = SettingsBuilder::new("spectrogram");
    draft.set_flag("channels", toml_array(&args.channels));
    draft.set_flag("window", args.window.as_ref().map(toml_string));
    draft.set_flag("length", args.length.as_ref().map(toml_string));
    draft.set_flag("overlap", args.overlap.clone());
    draft.set_flag("max_frequency", args.max_frequency.as_ref().map(toml_string));
    draft.set_flag("orders", toml_array(&args.orders));
    let words = "Hann window of 1 s";
    let settings =
        draft.defaults(model.studies.spectrogram.is_none(), words, &[("window", toml_string("hann"))]);
    with_run_up(model, settings)
}

pub fn orders(model: &Model, args: &StoredArgs) -> Settings {
    let mut draft = SettingsBuilder::new("orders");
    draft.set_flag("channels", toml_array(&args.channels));
    draft.set_flag("window", args.window.as_ref().map(toml_string));
    draft.set_flag("resolution", args.resolution.clone());
    draft.set_flag("overlap", args.overlap.clone());
    draft.set_flag("max_order", args.max_order.clone());
    draft.set_flag("cuts", toml_array(&args.orders));
    let words = "order resolution 0.05 up to order 20";
    let settings = draft.defaults(model.studies.orders.is_none(), words, &[("window", toml_string("hann"))]);
    with_run_up(model, settings)
}

/// Adds the run-up section that the analyses need, missing in the file if the run-up used defaults.
fn with_run_up(model: &Model, mut settings: Settings) -> Settings {
    if model.studies.run_up.is_none() {
        settings.set.insert(0, ("study.run_up.step".into(), toml_string("100 us")));
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
pub fn toml_string(text: impl AsRef<str>) -> String {
    toml::Value::String(text.as_ref().into()).to_string()
}

fn sweep(from: &str, to: &str, count: usize) -> String {
    format!("{{ from = {}, to = {}, count = {count} }}", toml_string(from), toml_string(to))
}

/// A TOML array: numbers unquoted, everything else as strings; `None` if empty.
pub fn toml_array(items: &[String]) -> Option<String> {
    let item = |text: &String| if text.parse::<f64>().is_ok() { text.clone() } else { toml_string(text) };
    (!items.is_empty()).then(|| format!("[{}]", items.iter().map(item).collect::<Vec<_>>().join(", ")))
}
