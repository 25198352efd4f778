//! Arguments of `validate` and `update`.

use std::path::PathBuf;

use clap::Args;

use super::{ShaftArgs, StudyArgs, assignment};

pub const VALIDATE: &str = "\
By default measured point k + 1 is node k of the model, as `export` writes it; a mapping file assigns points and \
channels:

  [point.12]
  station = \"disc\"

  [channel.hammer_1]
  station = \"B\"
  direction = \"x\"
  reference = { station = \"disc\", offset = \"150, 0, 0 mm\", direction = \"y\" }

A measured run-up is compared with a simulation driven by the measured speed, with the settings of [study.run_up],
[study.spectrogram] and [study.orders] of the model file; the speed comes from a channel of the record or a tachometer.

A run-up at 0 rpm with one [load.X] history is a simulated impact test: its results.h5 can be compared with the model.

Examples:
  rotordyn validate models/overhung_rig.toml --measured hammer.uff --mapping points.toml
  rotordyn validate models/overhung_rig.toml --measured modes.uff --band \"10 .. 300 Hz\"
  rotordyn validate models/overhung_rig.toml --measured run_up.mat --mapping channels.toml --tacho tacho
  rotordyn validate my_machine.toml --measured out/soft_hit/results.h5 --measured out/hard_hit/results.h5";

pub const UPDATE: &str = "\
Any number of the file can be a free parameter. Positive ones are varied on a logarithmic scale. Parameters that are \
not identifiable (posterior variance above half the prior variance) keep their start value.

The probability of chi^2 decides whether the model explains the data. Below 1 % it does not: no parameter is called \
identifiable, and every number of the machine that is not free is tried once; those that would explain the misfit are \
named with their gain in chi^2 and the value they would take. Parameters that the data cannot separate are named as a \
group, with the combination that is determined and the one that is not.

Examples:
  rotordyn update models/overhung_rig.toml --measured hammer.uff --free housing.B.k_x,housing.B.k_y
  rotordyn update my_machine.toml --measured modes.uff --free housing.*.k_x,belt.drive.k_x --fit frequency,mac,damping
  rotordyn update my_machine.toml --measured modes.uff --free housing.A.k_x+housing.B.k_x \\
      --bounds housing.A.k_x+housing.B.k_x=\"1e6 .. 1e8 N/m\" --write my_machine_updated.toml
  rotordyn update my_machine.toml --measured modes.uff --free housing.B.k_x,housing.B.k_y --profile housing.B.k_x";

/// Measured files, mapping, band and speed.
#[derive(Args, Clone, Debug)]
pub struct MeasuredArgs {
    /// Measured modes, FRFs or run-ups: universal file (58, 55, 2414), results.h5, MATLAB, NumPy, CSV; can be
    /// repeated
    #[arg(long, value_name = "FILE", required = true)]
    pub measured: Vec<PathBuf>,
    /// Mapping file (TOML): station and direction of every measured point or channel
    #[arg(long, value_name = "FILE")]
    pub mapping: Option<PathBuf>,
    /// Frequency band, such as "10 .. 300 Hz" [default: all measured]
    #[arg(long, value_name = "RANGE")]
    pub band: Option<String>,
    /// Time constant of the exponential window with which FRFs were measured, such as "0.5 s": its damping is subtracted from
    /// every mode
    #[arg(long, value_name = "TIME")]
    pub exponential_window: Option<String>,
    /// Shaft speed of the measurement, such as "1200 rpm" [default: as stated in the file, else 0]
    #[arg(long, value_name = "SPEED")]
    pub speed: Option<String>,
}

/// Arguments of `validate`.
#[derive(Args, Clone, Debug)]
pub struct ValidateArgs {
    #[command(flatten)]
    pub study: StudyArgs,
    #[command(flatten)]
    pub measured: MeasuredArgs,
    /// Time range of a run-up record, such as "0.5 s .. 14 s" or "0.5 s .." [default: all]
    #[arg(long, value_name = "RANGE", allow_hyphen_values = true, help_heading = "Shaft")]
    pub time: Option<String>,
    #[command(flatten)]
    pub shaft: ShaftArgs,
}

/// Arguments of `update` (model updating).
#[derive(Args, Clone, Debug)]
pub struct UpdateArgs {
    #[command(flatten)]
    pub study: StudyArgs,
    #[command(flatten)]
    pub measured: MeasuredArgs,
    /// Free parameters, separated by commas, such as housing.B.k_x,belt.drive.k_x; linked with a common
    /// factor as housing.*.k_x, housing.A.k_x+housing.B.k_x or damping.modal.ratio.*
    #[arg(long, value_name = "PATHS", value_delimiter = ',', required = true)]
    pub free: Vec<String>,
    /// Bounds of a parameter, such as housing.B.k_x="1e6 .. 1e8 N/m"; can be repeated
    #[arg(long, value_name = "PATH=RANGE", value_parser = assignment)]
    pub bounds: Vec<(String, String)>,
    /// Prior of a parameter (standard deviation), such as housing.B.k_x="+- 30 %" or "6e6 +- 2e6 N/m"; can be
    /// repeated [default: a factor of two]
    #[arg(long, value_name = "PATH=PRIOR", value_parser = assignment)]
    pub prior: Vec<(String, String)>,
    /// Residuals to fit, separated by commas [default: frequency,mac]
    #[arg(long, value_name = "WHAT", value_delimiter = ',', default_values = ["frequency", "mac"],
          hide_default_value = true)]
    pub fit: Vec<FitResidual>,
    /// Standard deviation of frequencies (model error) in %
    #[arg(long, value_name = "PERCENT", default_value_t = 0.1, value_parser = positive)]
    pub frequency_accuracy: f64,
    /// Standard deviation of FRFs (model error), in % of their magnitude: 10 is about 1 dB
    #[arg(long, value_name = "PERCENT", default_value_t = 10.0, value_parser = positive)]
    pub frf_accuracy: f64,
    /// Parameters of --free, separated by commas, whose profile likelihood is computed: chi^2 over the parameter with all
    /// others fitted again, its 68 % and 95 % intervals, and a figure
    #[arg(long, value_name = "PATHS", value_delimiter = ',')]
    pub profile: Vec<String>,
    /// Maximum number of iterations
    #[arg(long, value_name = "N", default_value_t = 40)]
    pub iterations: usize,
    /// Path of the updated model file [default: NAME_updated.toml in the results folder]
    #[arg(long, value_name = "FILE")]
    pub write: Option<PathBuf>,
}

/// Residual of a model update.
#[derive(clap::ValueEnum, Clone, Copy, Debug, PartialEq, Eq)]
pub enum FitResidual {
    /// Natural frequencies
    Frequency,
    /// Damping ratios
    Damping,
    /// Mode shapes, by MAC
    Mac,
    /// FRF magnitudes, logarithmic
    Frf,
    /// Complex FRFs (magnitude and phase)
    FrfComplex,
}

/// Parse a positive number.
fn positive(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(value) if value > 0.0 && value.is_finite() => Ok(value),
        _ => Err("expected a positive number".into()),
    }
}
