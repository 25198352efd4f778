//! Arguments of `identify`, of noisy FRFs and of the shaft speed of a record.

use std::path::PathBuf;

use clap::Args;

/// Simulated measurement noise of `frf --noise`.
#[derive(Args, Clone, Debug)]
pub struct NoiseArgs {
    /// Signal-to-noise ratio of force and responses, such as "40 dB": writes frf_noisy.uff, as an impact test
    /// would measure it
    #[arg(long, value_name = "LEVEL", allow_hyphen_values = true)]
    pub noise: Option<String>,
    /// Number of averages (hits)
    #[arg(long, value_name = "N", default_value_t = 10)]
    pub averages: usize,
    /// Random seed of the noise
    #[arg(long, value_name = "N", default_value_t = 1)]
    pub seed: u64,
}

/// Shaft angle and speed of a record: tachometer or tracked order line.
#[derive(Args, Clone, Debug)]
pub struct ShaftArgs {
    /// Shaft angle from tachometer pulses: a channel, or a file with one channel or with pulse times
    #[arg(long, value_name = "CHANNEL|FILE", help_heading = "Shaft", conflicts_with = "track")]
    pub tacho: Option<String>,
    /// Tachometer pulses per revolution
    #[arg(long, alias = "pulses-per-turn", value_name = "N", default_value_t = 1, help_heading = "Shaft")]
    pub pulses_per_rev: usize,
    /// Remove the jitter of the tachometer pulses (always on in validate)
    #[arg(long, help_heading = "Shaft")]
    pub smooth_tacho: bool,
    /// Shaft angle from an order line of the record (tacholess order tracking): its order and frequency
    /// range, such as 1="5 Hz .. 50 Hz"
    #[arg(long, value_name = "ORDER=RANGE", help_heading = "Shaft")]
    pub track: Option<String>,
}

/// FRF estimator for impact tests.
#[derive(clap::ValueEnum, Clone, Copy, Debug, PartialEq, Eq)]
pub enum EstimatorName {
    H1,
    H2,
    Hv,
}

/// Residual terms of the fit of FRFs.
#[derive(clap::ValueEnum, Clone, Copy, Debug, PartialEq, Eq)]
pub enum ResidualTermsName {
    Both,
    Upper,
    Lower,
    None,
}

/// Arguments of `identify`.
#[derive(Args, Clone, Debug)]
pub struct IdentifyArgs {
    /// Files with FRFs or time records of an impact (hammer) test; also results.h5; or one record of responses without a
    /// force channel: modes of the machine in operation
    #[arg(required = true, value_name = "FILE")]
    pub files: Vec<PathBuf>,
    /// Mapping file (TOML): station and direction of every channel; units and rates missing in the files
    #[arg(long, value_name = "FILE")]
    pub mapping: Option<PathBuf>,
    /// Model file that defines the stations of the mapping
    #[arg(long, value_name = "FILE")]
    pub model: Option<PathBuf>,
    /// Frequency band, such as "10 .. 200 Hz" [default: all]
    #[arg(long, value_name = "BAND")]
    pub band: Option<String>,
    /// Highest model order of the stabilisation diagram [default: 60, or fewer if there are few spectral
    /// lines]
    #[arg(long, value_name = "N")]
    pub max_order: Option<usize>,
    /// receptance, mobility or accelerance, for FRFs without a unit
    #[arg(long, value_name = "NAME")]
    pub quantity: Option<String>,
    /// What modes outside the band contribute inside it: both, upper (stiffness of the modes above), lower (mass of the
    /// modes below, and of a free machine's rigid-body motion) or none
    #[arg(long, value_name = "NAME", default_value = "both")]
    pub residual_terms: ResidualTermsName,
    /// Time constant of an exponential window e^(-t/TIME), such as "0.5 s", whose added damping is subtracted from every mode.
    /// Time records: rotordyn applies the window to force and responses of every block, so the records must be without one,
    /// unless --already-windowed is given. FRFs: the window with which they were measured
    #[arg(long, alias = "window", value_name = "TIME")]
    pub exponential_window: Option<String>,
    /// The time records have been recorded with the exponential window on force and responses from each hit on: it is not applied
    /// again, and its damping is subtracted
    #[arg(long, requires = "exponential_window")]
    pub already_windowed: bool,
    /// Channel of the force in time records [default: the one in N]
    #[arg(long, value_name = "NAME")]
    pub force: Option<String>,
    /// Block length after each hit in time records, such as "2 s" [default: up to the next hit]
    #[arg(long, value_name = "TIME")]
    pub block: Option<String>,
    /// FRF estimator: h1 assumes noise on the responses, h2 on the force, hv on both
    #[arg(long, value_name = "NAME", default_value = "h1")]
    pub estimator: EstimatorName,
    /// Sampling rate of time records whose file does not state it, such as "12 kHz"
    #[arg(long, value_name = "RATE")]
    pub rate: Option<String>,
    /// Shaft speed of a record in operation, such as "1797 rpm": its harmonics are subtracted [default: as stated in the file;
    /// else harmonics are recognised by their amplitude distribution]
    #[arg(long, value_name = "SPEED", help_heading = "Shaft", conflicts_with_all = ["tacho", "track"])]
    pub speed: Option<String>,
    /// Channels of the responses of a machine in operation, such as A_x,A_y [default: all vibrations of the file]
    #[arg(long, value_name = "LIST", value_delimiter = ',')]
    pub channels: Vec<String>,
    /// Orders of sines beside the multiples of the speed, such as the ball-pass order: 3.57,5.43 [default: for a run of this
    /// program the ball-pass orders of its bearings]
    #[arg(long, value_name = "LIST", help_heading = "Shaft", value_delimiter = ',')]
    pub orders: Vec<String>,
    #[command(flatten)]
    pub shaft: ShaftArgs,
    /// Folder for the results [default: out/identify_NAME]
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Draw no figures
    #[arg(long)]
    pub no_figures: bool,
    /// Also write the tables of the results as CSV files, to csv/ in the results folder
    #[arg(long)]
    pub csv: bool,
}
