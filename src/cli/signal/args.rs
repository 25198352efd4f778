//! Arguments of `signal`.

use std::path::PathBuf;

use clap::Args;

use super::super::args::ShaftArgs;
use rotordyn::study::signal::Analysis;

/// Shown with the long help.
pub const EXAMPLES: &str = "\
Examples:
  rotordyn signal 105.mat --rate \"12 kHz\" --bearing 6205-2RS
  rotordyn signal out/cwru_6205 --bearing DE --time \"0.2 s ..\" --compare-with 105.mat --compare-rate \"12 kHz\"
  rotordyn signal run_up.csv --channel A_ax --tacho tacho --bearing 6206
  rotordyn signal pump.wav --track 1=\"20 Hz .. 60 Hz\" --bearing-orders BPFO=3.585,BPFI=5.415
  rotordyn signal out/dents --bearing A --analyses jerk --quadrature-channel A_ay";

fn analyses_help() -> String {
    let known: Vec<&str> = Analysis::ALL.iter().map(|(_, keyword)| *keyword).collect();
    format!(
        "Analyses, separated by commas: {}; or \"all\" [default: spectrum, psd, envelope, kurtogram, cepstrum; with the \
         shaft angle also orders and synchronous-average, and spectrogram if the speed varies]",
        known.join(", ")
    )
}

/// What the file of a record does not state, and the part of it that is used.
#[derive(Args, Clone, Debug)]
pub struct RecordArgs {
    /// Sampling rate, such as "12 kHz", if the file does not state it
    #[arg(long, value_name = "FREQUENCY")]
    pub rate: Option<String>,
    /// Unit of the channels, such as g or "mm/s", if the file does not state it
    #[arg(long, value_name = "UNIT")]
    pub unit: Option<String>,
    /// Time range, such as "0.5 s .. 4 s" or "0.5 s .." [default: all]
    #[arg(long, value_name = "RANGE", allow_hyphen_values = true)]
    pub time: Option<String>,
}

/// The bearing and the search for its damage.
#[derive(Args, Clone, Debug)]
pub struct DiagnosisArgs {
    /// Bearing: a catalogue designation, or a ball bearing of the model
    #[arg(long, value_name = "NAME", help_heading = "Bearing")]
    pub bearing: Option<String>,
    /// Model file with the bearing [default: the model of a stored run]
    #[arg(long, value_name = "FILE", help_heading = "Bearing", requires = "bearing")]
    pub model: Option<PathBuf>,
    /// Bearing defect frequencies per revolution (orders) instead of --bearing, such as
    /// FTF=0.398,BPFO=3.585,BPFI=5.415,BSF=2.357
    #[arg(
        long,
        alias = "rates",
        value_name = "ORDERS",
        value_delimiter = ',',
        help_heading = "Bearing",
        conflicts_with = "bearing"
    )]
    pub bearing_orders: Vec<String>,
    /// Demodulation band of the envelope: lines (most evidence of a damaged part), kurtosis (from
    /// the kurtogram), full, or "500 Hz .. 5.5 kHz" [default: lines; without a bearing, kurtosis]
    #[arg(long, value_name = "BAND", help_heading = "Bearing")]
    pub band: Option<String>,
    /// Number of harmonics of each defect frequency to search
    #[arg(long, value_name = "N", default_value_t = 5, help_heading = "Bearing")]
    pub harmonics: usize,
    /// Search tolerance of the lines for slip and contact angle, such as "1.5 %"
    #[arg(long, value_name = "SHARE", default_value = "2 %", help_heading = "Bearing")]
    pub slip: String,
    /// Range about a stated speed in which the record's own speed (1x to 10x) is searched for the bearing lines,
    /// such as "1 %"; 0 takes the speed as stated
    #[arg(long, value_name = "SHARE", default_value = "2 %", help_heading = "Bearing")]
    pub speed_range: String,
}

/// Arguments of `signal`.
#[derive(Args, Clone, Debug)]
pub struct SignalArgs {
    /// The record: .mat (versions 4 to 7.3), .csv, .txt, .lvm, .wav, .uff, .npz, .h5, or a folder with the results.h5 of a
    /// run. Channels of structures and cells are named by path, such as bearing.gs, runs(2).x, c{3}; rates are found by name
    /// (fs, sr, SampleFrequency, dt, t, X_Value, freq ...)
    pub file: PathBuf,
    /// Channels, separated by commas, or "all" [default: the first vibration channel]
    #[arg(long, value_name = "NAMES", value_delimiter = ',')]
    pub channel: Vec<String>,
    #[command(flatten)]
    pub record: RecordArgs,
    #[arg(long, value_name = "NAMES", value_delimiter = ',', help = analyses_help())]
    pub analyses: Vec<String>,

    /// Shaft speed, such as "1797 rpm" [default: as stated in the file]
    #[arg(long, value_name = "SPEED", help_heading = "Shaft", conflicts_with_all = ["tacho", "track"])]
    pub speed: Option<String>,
    #[command(flatten)]
    pub shaft: ShaftArgs,
    /// Order resolution
    #[arg(long, value_name = "NUMBER", default_value_t = 0.05, help_heading = "Shaft")]
    pub order_resolution: f64,
    /// Highest order [default: 2.2 BPFI, at least 20, limited by the sampling rate]
    #[arg(long, value_name = "NUMBER", help_heading = "Shaft")]
    pub max_order: Option<f64>,
    /// Orders of the order cuts, marked in the order spectrum, such as 1,7,BPFO,"2 BPFO" [default: 1, 2 and those of the
    /// bearing]
    #[arg(long, value_name = "ORDERS", value_delimiter = ',', help_heading = "Shaft")]
    pub orders: Vec<String>,
    /// Also track amplitude and phase of these orders by the Vold-Kalman filter, with this -3 dB bandwidth in orders,
    /// such as 0.2
    #[arg(long, value_name = "ORDERS", help_heading = "Shaft")]
    pub bandwidth: Option<f64>,

    #[command(flatten)]
    pub diagnosis: DiagnosisArgs,
    /// Race to which the jumps of the jerk are assigned: outer or inner
    #[arg(long, value_name = "RACE", default_value = "outer", help_heading = "Bearing")]
    pub race: String,
    /// Channel 90 deg from the first, from x to y, to locate defects over the full circumference
    #[arg(long, alias = "beside", value_name = "CHANNEL", help_heading = "Bearing")]
    pub quadrature_channel: Option<String>,
    /// Reference time at which a ball is at angle 0 of the race and that angle points along x
    #[arg(
        long,
        alias = "datum",
        value_name = "TIME",
        default_value = "0 s",
        help_heading = "Bearing",
        allow_hyphen_values = true
    )]
    pub reference_time: String,

    /// Frequency resolution of the PSD, such as "1 Hz" [default: about fifteen segments]
    #[arg(long, value_name = "FREQUENCY", help_heading = "Figures and files")]
    pub resolution: Option<String>,
    /// Highest frequency of spectrum and spectrogram, such as "1 kHz"
    #[arg(long, value_name = "FREQUENCY", help_heading = "Figures and files")]
    pub max_frequency: Option<String>,
    /// Second record whose envelope spectrum is compared with the first, such as measured and simulated
    #[arg(long, alias = "against", value_name = "FILE", help_heading = "Comparison with a second record")]
    pub compare_with: Option<PathBuf>,
    /// Channel of the second record [default: the first vibration channel]
    #[arg(
        long,
        alias = "against-channel",
        value_name = "NAME",
        help_heading = "Comparison with a second record",
        requires = "compare_with"
    )]
    pub compare_channel: Option<String>,
    /// Sampling rate of the second record, if its file does not state it
    #[arg(
        long,
        alias = "against-rate",
        value_name = "FREQUENCY",
        help_heading = "Comparison with a second record",
        requires = "compare_with"
    )]
    pub compare_rate: Option<String>,
    /// Unit of the second record, if its file does not state it
    #[arg(
        long,
        alias = "against-unit",
        value_name = "UNIT",
        help_heading = "Comparison with a second record",
        requires = "compare_with"
    )]
    pub compare_unit: Option<String>,
    /// Shaft speed of the second record [default: as stated in its file, else that of the first]
    #[arg(
        long,
        alias = "against-speed",
        value_name = "SPEED",
        help_heading = "Comparison with a second record",
        requires = "compare_with"
    )]
    pub compare_speed: Option<String>,
    /// Time range of the second record, such as "0.5 s .."
    #[arg(
        long,
        alias = "against-time",
        value_name = "RANGE",
        help_heading = "Comparison with a second record",
        requires = "compare_with"
    )]
    pub compare_time: Option<String>,
    /// Results folder [default: out/NAME, or the folder of the stored run]
    #[arg(long, value_name = "DIR", help_heading = "Figures and files")]
    pub out: Option<PathBuf>,
    /// Draw no figures
    #[arg(long, help_heading = "Figures and files")]
    pub no_figures: bool,
    /// Also write the tables of the results as CSV files, to csv/ in the results folder
    #[arg(long, help_heading = "Figures and files")]
    pub csv: bool,
}
