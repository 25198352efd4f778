//! Arguments of what has to do with measured FRFs.

use std::path::PathBuf;

use clap::Args;

/// A test with noise.
#[derive(Args, Clone, Debug)]
pub struct NoiseArgs {
    /// Signal to noise of force and responses, such as "40 dB": writes frf_noisy.uff, as a test would measure it
    #[arg(long, value_name = "LEVEL", allow_hyphen_values = true)]
    pub noise: Option<String>,
    /// Hits averaged
    #[arg(long, value_name = "N", default_value_t = 10)]
    pub averages: usize,
    /// Seed of the noise
    #[arg(long, value_name = "N", default_value_t = 1)]
    pub seed: u64,
}

/// How the shaft turned during a record.
#[derive(Args, Clone, Debug)]
pub struct ShaftArgs {
    /// Shaft angle from the pulses of a tacho: a channel, or a file of one channel or of pulse times
    #[arg(long, value_name = "CHANNEL|FILE", help_heading = "Shaft", conflicts_with = "track")]
    pub tacho: Option<String>,
    /// Pulses of the tacho in a turn
    #[arg(long, value_name = "N", default_value_t = 1, help_heading = "Shaft")]
    pub pulses_per_turn: usize,
    /// Take the jitter of the tacho's pulses away (validate always does)
    #[arg(long, help_heading = "Shaft")]
    pub smooth_tacho: bool,
    /// Shaft angle from a line of the record itself: its order and the frequencies between which it stays, such as
    /// 1="5 Hz .. 50 Hz"
    #[arg(long, value_name = "ORDER=RANGE", help_heading = "Shaft")]
    pub track: Option<String>,
}

/// An estimate of FRFs from hits.
#[derive(clap::ValueEnum, Clone, Copy, Debug, PartialEq, Eq)]
pub enum EstimatorName {
    H1,
    H2,
    Hv,
}

/// Which FRFs, and how.
#[derive(Args, Clone, Debug)]
pub struct IdentifyArgs {
    /// Files with FRFs, or with the time records of an impact test; results.h5 too
    #[arg(required = true, value_name = "FILE")]
    pub files: Vec<PathBuf>,
    /// Mapping file (TOML): which channel is which station and direction, units and rates that files do not tell
    #[arg(long, value_name = "FILE")]
    pub mapping: Option<PathBuf>,
    /// Model whose stations the mapping names
    #[arg(long, value_name = "FILE")]
    pub model: Option<PathBuf>,
    /// Frequencies, such as "10 .. 200 Hz" [default: all]
    #[arg(long, value_name = "BAND")]
    pub band: Option<String>,
    /// Highest order of the model [default: 60, or what the lines allow]
    #[arg(long, value_name = "N")]
    pub max_order: Option<usize>,
    /// receptance, mobility or accelerance, where the unit does not tell
    #[arg(long, value_name = "NAME")]
    pub quantity: Option<String>,
    /// Time constant of the exponential window of the test, such as "0.5 s": applied to time records, and its share
    /// taken from every damping
    #[arg(long, value_name = "TIME")]
    pub window: Option<String>,
    /// Channel of the force in time records [default: the one in N]
    #[arg(long, value_name = "NAME")]
    pub force: Option<String>,
    /// Length of a hit's block in time records, such as "2 s" [default: up to the next hit]
    #[arg(long, value_name = "TIME")]
    pub block: Option<String>,
    /// How hits are averaged: h1 bears noise of the responses, h2 noise of the force, hv noise of both
    #[arg(long, value_name = "NAME", default_value = "h1")]
    pub estimator: EstimatorName,
    /// Sampling rate of time records whose file does not tell, such as "12 kHz"
    #[arg(long, value_name = "RATE")]
    pub rate: Option<String>,
    /// Folder for the results [default: out/identify_NAME]
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Draw no figures
    #[arg(long)]
    pub no_figures: bool,
}
