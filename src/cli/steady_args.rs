//! Arguments of the steady-speed studies (`poincare`, `lyapunov`, `bifurcation`) and their model settings.

use clap::Args;
use rotordyn::model::Model;

use super::args::StudyArgs;
use super::args::keys::{default, default_words, help as key_help, help_with as key_help_with};
use super::settings::{Settings, SettingsBuilder, toml_array, toml_string, top_speed};

/// Shown with the long help of `poincare`.
pub const POINCARE: &str = "\
Examples:
  rotordyn poincare models/varying_compliance.toml --speed \"900 rpm\"
  rotordyn poincare models/overhung_rig.toml --section ball-pass --bearing B --plane \"disc_x, disc_y\"";

/// Shown with the long help of `lyapunov`.
pub const LYAPUNOV: &str = "\
Examples:
  rotordyn lyapunov models/varying_compliance.toml --speed \"900 rpm\" --periods 2000";

/// Shown with the long help of `bifurcation`.
pub const BIFURCATION: &str = "\
Examples:
  rotordyn bifurcation models/varying_compliance.toml
  rotordyn bifurcation my_machine.toml --parameter speed --from \"500 rpm\" --to \"5000 rpm\" --count 200
  rotordyn bifurcation my_machine.toml --parameter bearing.B.radial_clearance --from \"0 um\" --to \"40 um\" --lyapunov
  rotordyn bifurcation my_machine.toml --parameter bearing.B.balls --from 6 --to 16 --start equilibrium";

/// A run at constant speed.
#[derive(Args, Clone, Debug)]
pub struct SteadyArgs {
    #[command(flatten)]
    pub study: StudyArgs,
    #[arg(long, value_name = "SPEED", help = key_help("study.poincare.speed"))]
    pub speed: Option<String>,
    #[arg(long, value_name = "CLOCK", help = key_help("study.poincare.section"))]
    pub section: Option<String>,
    #[arg(long, value_name = "NAME", help = key_help("study.poincare.bearing"))]
    pub bearing: Option<String>,
    #[arg(long, value_name = "ANGLE", allow_hyphen_values = true, help = key_help("study.poincare.phase"))]
    pub phase: Option<String>,
    /// Periods discarded as transient before recording
    #[arg(long, alias = "settle", value_name = "N")]
    pub transient_periods: Option<usize>,
    #[arg(long, value_name = "N", help = key_help("study.poincare.transient_limit"))]
    pub transient_limit: Option<usize>,
    /// Periods recorded
    #[arg(long, value_name = "N")]
    pub periods: Option<usize>,
    #[arg(long, value_name = "TIME", help = key_help("study.poincare.step"))]
    pub step: Option<String>,
    /// generalised-alpha, newmark, rk4 or dormand-prince
    #[arg(long, value_name = "NAME")]
    pub integrator: Option<String>,
}

/// Arguments of `poincare`.
#[derive(Args, Clone, Debug)]
pub struct PoincareArgs {
    #[command(flatten)]
    pub steady: SteadyArgs,
    #[arg(long, value_name = "PROBES", help = key_help_with("study.poincare.planes", "can be repeated"))]
    pub plane: Vec<String>,
}

/// Arguments of `bifurcation`.
#[derive(Args, Clone, Debug)]
pub struct BifurcationArgs {
    #[command(flatten)]
    pub steady: SteadyArgs,
    #[arg(long, value_name = "PATH", help = key_help_with("study.bifurcation.parameter", "can be repeated"))]
    pub parameter: Vec<String>,
    /// First value with its unit, such as "0 um"
    #[arg(long, value_name = "VALUE", allow_hyphen_values = true)]
    pub from: Option<String>,
    /// Last value with its unit
    #[arg(long, value_name = "VALUE", allow_hyphen_values = true)]
    pub to: Option<String>,
    /// Number of values [default: 200, or every integer between integer ends]
    #[arg(long, value_name = "N")]
    pub count: Option<usize>,
    #[arg(long, value_name = "WAY", help = key_help("study.bifurcation.sweep"))]
    pub sweep: Option<String>,
    #[arg(long, value_name = "START", help = key_help("study.bifurcation.start"))]
    pub start: Option<String>,
    #[arg(long, value_name = "NAMES", value_delimiter = ',', help = key_help_with("study.bifurcation.channels", "separated by commas"))]
    pub channels: Vec<String>,
    #[arg(long, help = key_help("study.bifurcation.lyapunov"))]
    pub lyapunov: bool,
}

fn common(draft: &mut SettingsBuilder, args: &SteadyArgs) {
    draft.set_flag("speed", args.speed.as_ref().map(toml_string));
    draft.set_flag("section", args.section.as_ref().map(toml_string));
    draft.set_flag("bearing", args.bearing.as_ref().map(toml_string));
    draft.set_flag("phase", args.phase.as_ref().map(toml_string));
    draft.set_flag("transient_periods", args.transient_periods.map(|n| n.to_string()));
    draft.set_flag("transient_limit", args.transient_limit.map(|n| n.to_string()));
    draft.set_flag("periods", args.periods.map(|n| n.to_string()));
    draft.set_flag("step", args.step.as_ref().map(toml_string));
    draft.set_flag("integrator", args.integrator.as_ref().map(toml_string));
}

/// Note on the defaults used if the file lacks the study.
fn default_note(model: &Model, study: &str) -> String {
    let [transient_periods, periods] =
        ["transient_periods", "periods"].map(|key| default_words(&format!("study.{study}.{key}")));
    let speed = match top_speed(model) {
        Some(top) => format!("{top} rpm, "),
        None => String::new(),
    };
    format!("{speed}{transient_periods} shaft revolutions discarded, {periods} recorded")
}

pub fn poincare(model: &Model, args: &PoincareArgs) -> Settings {
    let mut draft = SettingsBuilder::new("poincare");
    common(&mut draft, &args.steady);
    draft.set_flag("planes", toml_array(&args.plane));
    let missing = model.studies.poincare.is_none();
    draft.defaults(
        missing,
        &default_note(model, "poincare"),
        &[("section", default("study.poincare.section"))],
    )
}

pub fn lyapunov(model: &Model, args: &SteadyArgs) -> Settings {
    let mut draft = SettingsBuilder::new("lyapunov");
    common(&mut draft, args);
    let missing = model.studies.lyapunov.is_none();
    draft.defaults(
        missing,
        &default_note(model, "lyapunov"),
        &[("section", default("study.lyapunov.section"))],
    )
}

pub fn bifurcation(model: &Model, args: &BifurcationArgs) -> Settings {
    let missing = model.studies.bifurcation.is_none();
    let mut draft = SettingsBuilder::new("bifurcation");
    common(&mut draft, &args.steady);
    draft.set_flag("parameter", toml_array(&args.parameter));
    let ends = [("from", args.from.as_ref().map(toml_string)), ("to", args.to.as_ref().map(toml_string))];
    let values = ends.into_iter().chain([("count", args.count.map(|n| n.to_string()))]);
    let given: Vec<(&str, String)> = values.filter_map(|(key, value)| Some((key, value?))).collect();
    // A different parameter replaces all values; otherwise a flag replaces a single entry of the file.
    if missing || !args.parameter.is_empty() {
        let table: Vec<String> = given.iter().map(|(key, value)| format!("{key} = {value}")).collect();
        draft.set_flag("values", (!given.is_empty()).then(|| format!("{{ {} }}", table.join(", "))));
    } else {
        for (key, value) in given {
            draft.set_flag(&format!("values.{key}"), Some(value));
        }
    }
    draft.set_flag("sweep", args.sweep.as_ref().map(toml_string));
    draft.set_flag("start", args.start.as_ref().map(toml_string));
    draft.set_flag("channels", toml_array(&args.channels));
    draft.set_flag("lyapunov", args.lyapunov.then(|| "true".into()));
    draft.defaults(
        missing,
        &default_note(model, "bifurcation"),
        &[("section", default("study.bifurcation.section"))],
    )
}
