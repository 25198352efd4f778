//! Arguments of `validate` and `update`.

use std::path::PathBuf;

use clap::Args;

use super::{ShaftArgs, StudyArgs, assignment};

pub const VALIDATE: &str = "\
A measured point k + 1 is node k of the model, as `export` writes it; a mapping file says otherwise:

  [point.12]
  station = \"disc\"

  [channel.hammer_1]
  station = \"B\"
  direction = \"x\"
  reference = { station = \"disc\", offset = \"150, 0, 0 mm\", direction = \"y\" }

A record of a run-up is held against one that the model makes with the measured speed, by the settings of the file's
[study.run_up], [study.spectrogram] and [study.orders]; the speed is that of a channel of the file, or of a tacho.

A run-up at 0 rpm under one [load.X] with a history is an impact test: its results.h5 can be held against the model.

Examples:
  rotordyn validate models/overhung_rig.toml --measured hammer.uff --mapping points.toml
  rotordyn validate models/overhung_rig.toml --measured modes.uff --band \"10 .. 300 Hz\"
  rotordyn validate models/overhung_rig.toml --measured run_up.mat --mapping channels.toml --tacho tacho
  rotordyn validate my_machine.toml --measured out/soft/results.h5 --measured out/hard/results.h5";

pub const UPDATE: &str = "\
Any number of the file can be free. Positive ones are varied by factors. Those that the data do not tell (more than half \
of the prior's variance left) stay at their start.

Examples:
  rotordyn update models/overhung_rig.toml --measured hammer.uff --free housing.B.k_x,housing.B.k_y
  rotordyn update my_machine.toml --measured modes.uff --free housing.*.k_x,belt.drive.k_x --fit frequency,mac,damping
  rotordyn update my_machine.toml --measured modes.uff --free housing.A.k_x+housing.B.k_x \\
      --bounds housing.A.k_x+housing.B.k_x=\"1e6 .. 1e8 N/m\" --write my_machine_updated.toml";

/// What was measured, and where.
#[derive(Args, Clone, Debug)]
pub struct MeasuredArgs {
    /// Measured modes, FRFs or run-ups: universal file (58, 55, 2414), results.h5, MATLAB, NumPy, CSV; can be repeated
    #[arg(long, value_name = "FILE", required = true)]
    pub measured: Vec<PathBuf>,
    /// Which measured point or channel is which station and direction (TOML)
    #[arg(long, value_name = "FILE")]
    pub mapping: Option<PathBuf>,
    /// Frequencies to look at, such as "10 .. 300 Hz" [default: all that were measured]
    #[arg(long, value_name = "RANGE")]
    pub band: Option<String>,
    /// Speed of the measurement, such as "1200 rpm" [default: as the file tells, else 0]
    #[arg(long, value_name = "SPEED")]
    pub speed: Option<String>,
}

/// What to hold against what.
#[derive(Args, Clone, Debug)]
pub struct ValidateArgs {
    #[command(flatten)]
    pub study: StudyArgs,
    #[command(flatten)]
    pub measured: MeasuredArgs,
    /// Part of a run-up's record, such as "0.5 s .. 14 s" or "0.5 s .." [default: all of it]
    #[arg(long, value_name = "RANGE", allow_hyphen_values = true, help_heading = "Shaft")]
    pub time: Option<String>,
    #[command(flatten)]
    pub shaft: ShaftArgs,
}

/// What to change until it agrees.
#[derive(Args, Clone, Debug)]
pub struct UpdateArgs {
    #[command(flatten)]
    pub study: StudyArgs,
    #[command(flatten)]
    pub measured: MeasuredArgs,
    /// Numbers of the file that may change, separated by commas, such as housing.B.k_x,belt.drive.k_x; several move
    /// together as housing.*.k_x, housing.A.k_x+housing.B.k_x or damping.modal.ratio.*
    #[arg(long, value_name = "PATHS", value_delimiter = ',', required = true)]
    pub free: Vec<String>,
    /// Bounds of one, such as housing.B.k_x="1e6 .. 1e8 N/m"; can be repeated
    #[arg(long, value_name = "PATH=RANGE", value_parser = assignment)]
    pub bounds: Vec<(String, String)>,
    /// What is known of one beforehand, such as housing.B.k_x="+- 30 %" or "6e6 +- 2e6 N/m"; can be repeated
    /// [default: a factor of two either way]
    #[arg(long, value_name = "PATH=PRIOR", value_parser = assignment)]
    pub prior: Vec<(String, String)>,
    /// What is fitted, separated by commas
    #[arg(long, value_name = "WHAT", value_delimiter = ',', default_values = ["frequency", "mac"])]
    pub fit: Vec<FitWord>,
    /// Deviation of frequencies that even a good model leaves \[%\]
    #[arg(long, value_name = "PERCENT", default_value_t = 0.1, value_parser = positive)]
    pub frequency_accuracy: f64,
    /// Deviation of FRFs that even a good model leaves, of their size \[%\]: 10 is about 1 dB
    #[arg(long, value_name = "PERCENT", default_value_t = 10.0, value_parser = positive)]
    pub frf_accuracy: f64,
    /// Most steps
    #[arg(long, value_name = "N", default_value_t = 40)]
    pub iterations: usize,
    /// Where the updated model file goes [default: NAME_updated.toml in the results folder]
    #[arg(long, value_name = "FILE")]
    pub write: Option<PathBuf>,
}

/// What an update fits.
#[derive(clap::ValueEnum, Clone, Copy, Debug, PartialEq, Eq)]
pub enum FitWord {
    /// Frequencies
    Frequency,
    /// Damping ratios
    Damping,
    /// Shapes, by their MAC
    Mac,
    /// Magnitudes of the FRFs, logarithmic
    Frf,
    /// FRFs by magnitude and phase
    FrfComplex,
}

/// A positive number.
fn positive(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(value) if value > 0.0 && value.is_finite() => Ok(value),
        _ => Err("expected a positive number".into()),
    }
}
