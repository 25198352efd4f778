//! Arguments of the steady-speed studies (`poincare`, `lyapunov`, `bifurcation`).

use clap::Args;

use super::keys::{help as key_help, help_with as key_help_with};
use super::{CheckpointArgs, StudyArgs};

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
    #[command(flatten)]
    pub checkpoints: CheckpointArgs,
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
