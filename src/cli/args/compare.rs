//! Arguments of `compare`.

use std::path::PathBuf;

use clap::Args;

use super::{ShaftArgs, StudyArgs, assignment};

pub const COMPARE: &str = "\
Cases are the variants of --variants, the values of a path that --set gives more than once, or those of --case; both \
together: every value in every variant. Several paths given more than once go together: the second value of one with \
the second of the others. A --set given once holds in every case. `base` is the file without a variant.

Linear cases: natural frequencies paired by the mass-weighted MAC of their shaft deflection, FRFs of [study.frf], the \
response of [study.unbalance] and the Campbell diagrams of [study.campbell], where the file has them. With --run-up: \
run-ups with [study.spectrogram] and [study.orders]: levels, peaks of every order, maps side by side on one colour scale, \
order cuts on common axes; the results of each case go to a folder of its own.

Measured FRFs are at the points of their file (or of --mapping), or named `response/excitation` as `frf` exports them; \
--pair names others. A measured run-up drives the model of every case with its own speed.

Examples:
  rotordyn compare models/overhung_rig.toml --variants spherical,cylindrical,base
  rotordyn compare models/overhung_rig.toml --variants spherical,cylindrical,base --measured hammer.uff
  rotordyn compare models/overhung_rig.toml --set unbalance.residual.magnitude=\"0.56 kg mm\" \\
      --set unbalance.residual.magnitude=\"5 kg mm\"
  rotordyn compare models/overhung_rig.toml --case \"tight: bearing.A.radial_clearance=5 um; \
bearing.B.radial_clearance=5 um\" --case \"loose: bearing.A.radial_clearance=33 um; bearing.B.radial_clearance=33 um\"
  rotordyn compare models/overhung_rig.toml --run-up --variants base,wavy
  rotordyn compare models/overhung_rig.toml --run-up --variants base,wavy --measured run_up.mat --tacho tacho";

#[derive(Args, Clone, Debug)]
pub struct CompareArgs {
    #[command(flatten)]
    pub study: StudyArgs,
    /// Variants, separated by commas [default: base and every variant of the file, unless --set, --case or --measured
    /// make the cases]
    #[arg(long, value_name = "NAMES", value_delimiter = ',', conflicts_with = "variant")]
    pub variants: Vec<String>,
    /// A case with its name: "tight: bearing.A.radial_clearance=5 um; bearing.B.radial_clearance=5 um"; can be repeated
    #[arg(long, value_name = "NAME: PATH=VALUE; ...")]
    pub case: Vec<String>,
    /// Compare run-ups instead of modes, FRFs and unbalance responses
    #[arg(long, conflicts_with_all = ["speed", "modes", "min_mac", "pair", "band"])]
    pub run_up: bool,
    /// Measured FRFs or, with --run-up, a recorded run-up: universal file, results.h5, MATLAB, NumPy, CSV
    #[arg(long, value_name = "FILE")]
    pub measured: Option<PathBuf>,
    /// Mapping file (TOML): station and direction of every measured point or channel
    #[arg(long, value_name = "FILE", requires = "measured")]
    pub mapping: Option<PathBuf>,
    /// Which measured FRF is which of the model, such as 3="disc_x/rim" or "H1 disc"="disc_x/rim"; can be repeated
    #[arg(long, value_name = "RECORD=RESPONSE/EXCITATION", value_parser = assignment, requires = "measured")]
    pub pair: Vec<(String, String)>,
    /// Frequency band of the measured FRFs, such as "10 .. 300 Hz" [default: all]
    #[arg(long, value_name = "RANGE", requires = "measured")]
    pub band: Option<String>,
    /// Speeds, such as "0, 1200 rpm" [default: those of [study.modal]]
    #[arg(long, value_name = "SPEEDS")]
    pub speed: Option<String>,
    /// Number of modes
    #[arg(long, value_name = "N")]
    pub modes: Option<usize>,
    /// Smallest MAC of a mode pair; modes below it stay without a pair
    #[arg(long, value_name = "MAC", default_value_t = 0.5)]
    pub min_mac: f64,
    /// Time range of a measured run-up, such as "0.5 s .. 14 s" or "0.5 s .." [default: all]
    #[arg(
        long,
        value_name = "RANGE",
        allow_hyphen_values = true,
        requires = "measured",
        help_heading = "Shaft"
    )]
    pub time: Option<String>,
    #[command(flatten)]
    pub shaft: ShaftArgs,
}
