//! Arguments of `signal`.

use std::path::PathBuf;

use clap::Args;

use super::super::args::ShaftArgs;

/// Shown with the long help.
pub const EXAMPLES: &str = "\
Analyses: spectrum, psd, spectrogram, envelope, kurtogram, cepstrum, jerk, orders, average, cyclic.

Examples:
  rotordyn signal 105.mat --rate \"12 kHz\" --bearing 6205-2RS
  rotordyn signal out/cwru_6205 --bearing DE --time \"0.2 s ..\" --against 105.mat --against-rate \"12 kHz\"
  rotordyn signal run_up.csv --channel A_ax --tacho tacho --bearing 6206
  rotordyn signal pump.wav --track 1=\"20 Hz .. 60 Hz\" --rates BPFO=3.585,BPFI=5.415
  rotordyn signal out/dents --bearing A --analyses jerk --beside A_ay";

/// Which record, and what to look for in it.
#[derive(Args, Clone, Debug)]
pub struct SignalArgs {
    /// The record: .mat, .csv, .wav, .uff, .npz, .h5, or a folder with the results.h5 of a run
    pub file: PathBuf,
    /// Channels, separated by commas, or "all" [default: the first that vibrates]
    #[arg(long, value_name = "NAMES", value_delimiter = ',')]
    pub channel: Vec<String>,
    /// Sampling rate, such as "12 kHz", where the file does not state it
    #[arg(long, value_name = "FREQUENCY")]
    pub rate: Option<String>,
    /// Unit of the channels, such as g or "mm/s", where the file does not state it
    #[arg(long, value_name = "UNIT")]
    pub unit: Option<String>,
    /// Part of the record, such as "0.5 s .. 4 s" or "0.5 s .." [default: all of it]
    #[arg(long, value_name = "RANGE", allow_hyphen_values = true)]
    pub time: Option<String>,
    /// What to do, separated by commas, or "all" [default: spectrum, psd, envelope, kurtogram, cepstrum; with the shaft's
    /// angle also orders and average, and spectrogram where the speed changes]
    #[arg(long, value_name = "NAMES", value_delimiter = ',')]
    pub analyses: Vec<String>,

    /// Shaft speed, such as "1797 rpm" [default: as the file states it]
    #[arg(long, value_name = "SPEED", help_heading = "Shaft", conflicts_with_all = ["tacho", "track"])]
    pub speed: Option<String>,
    #[command(flatten)]
    pub shaft: ShaftArgs,
    /// Spacing of the orders
    #[arg(long, value_name = "NUMBER", default_value_t = 0.05, help_heading = "Shaft")]
    pub order_resolution: f64,
    /// Highest order [default: 2.2 BPFI, at least 20, as far as the sampling rate allows]
    #[arg(long, value_name = "NUMBER", help_heading = "Shaft")]
    pub max_order: Option<f64>,

    /// Bearing: a designation of the catalogue, or a ball bearing of the model
    #[arg(long, value_name = "NAME", help_heading = "Bearing")]
    pub bearing: Option<String>,
    /// Model file that the bearing is in [default: the model that a stored run was made from]
    #[arg(long, value_name = "FILE", help_heading = "Bearing", requires = "bearing")]
    pub model: Option<PathBuf>,
    /// The bearing's rates per turn instead, such as FTF=0.398,BPFO=3.585,BPFI=5.415,BSF=2.357
    #[arg(
        long,
        value_name = "RATES",
        value_delimiter = ',',
        help_heading = "Bearing",
        conflicts_with = "bearing"
    )]
    pub rates: Vec<String>,
    /// Band of the envelope: lines (where the bearing's lines stand out most), kurtosis, whole, or
    /// "500 Hz .. 5.5 kHz" [default: lines, without a bearing kurtosis]
    #[arg(long, value_name = "BAND", help_heading = "Bearing")]
    pub band: Option<String>,
    /// Harmonics of each line that are sought
    #[arg(long, value_name = "N", default_value_t = 5, help_heading = "Bearing")]
    pub harmonics: usize,
    /// Most that a line may be off by slip and contact angle, such as "1.5 %"
    #[arg(long, value_name = "SHARE", default_value = "1.5 %", help_heading = "Bearing")]
    pub slip: String,
    /// Race that jumps of the jerk are read for: outer or inner
    #[arg(long, value_name = "RACE", default_value = "outer", help_heading = "Bearing")]
    pub race: String,
    /// Channel a quarter turn on from the first, from x to y, for the angles of defects all round
    #[arg(long, value_name = "CHANNEL", help_heading = "Bearing")]
    pub beside: Option<String>,
    /// Time in the record at which a ball stands at angle 0 of the race and that angle lies along x
    #[arg(
        long,
        value_name = "TIME",
        default_value = "0 s",
        help_heading = "Bearing",
        allow_hyphen_values = true
    )]
    pub datum: String,

    /// Spacing of the density's lines, such as "1 Hz" [default: about fifteen segments]
    #[arg(long, value_name = "FREQUENCY", help_heading = "Figures and files")]
    pub resolution: Option<String>,
    /// Highest frequency of spectrum and spectrogram, such as "1 kHz"
    #[arg(long, value_name = "FREQUENCY", help_heading = "Figures and files")]
    pub max_frequency: Option<String>,
    /// Another record, whose envelope spectrum is laid under the first's: measured and simulated
    #[arg(long, value_name = "FILE", help_heading = "Another record")]
    pub against: Option<PathBuf>,
    /// Its channel [default: the first that vibrates]
    #[arg(long, value_name = "NAME", help_heading = "Another record", requires = "against")]
    pub against_channel: Option<String>,
    /// Its sampling rate, where the file does not state it
    #[arg(long, value_name = "FREQUENCY", help_heading = "Another record", requires = "against")]
    pub against_rate: Option<String>,
    /// Its unit, where the file does not state it
    #[arg(long, value_name = "UNIT", help_heading = "Another record", requires = "against")]
    pub against_unit: Option<String>,
    /// Its shaft speed [default: as its file states it, else that of the first]
    #[arg(long, value_name = "SPEED", help_heading = "Another record", requires = "against")]
    pub against_speed: Option<String>,
    /// Part of it, such as "0.5 s .."
    #[arg(long, value_name = "RANGE", help_heading = "Another record", requires = "against")]
    pub against_time: Option<String>,
    /// Folder for the results [default: out/NAME, or the folder of the stored run]
    #[arg(long, value_name = "DIR", help_heading = "Figures and files")]
    pub out: Option<PathBuf>,
    /// Draw no figures
    #[arg(long, help_heading = "Figures and files")]
    pub no_figures: bool,
}
