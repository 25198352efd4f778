//! Arguments of `trend`.

use std::path::PathBuf;

use clap::Args;

use super::super::args::ShaftArgs;
use super::super::signal::args::{DiagnosisArgs, RecordArgs};

/// Shown with the long help.
pub const EXAMPLES: &str = "\
Axes (--over): the dates that all files or all names state, else a number that differs between the names, else the \
number of the record.

Examples:
  rotordyn trend pump_7/ --rate \"20 kHz\" --bearing 6205-2RS --speed \"1480 rpm\"
  rotordyn trend 105.mat 106.mat 107.mat 108.mat --rate \"12 kHz\" --bearing 6205-2RS --over \"load=0,1,2,3 hp\"
  rotordyn trend rec_*.csv --channel A_ax --rms-bands \"10 Hz .. 1 kHz,1 kHz .. 5 kHz\"
  rotordyn trend mfpt/*.mat --bearing-orders BPFO=3.245,BPFI=4.755 --speed \"25 Hz\" --over load";

/// Arguments of `trend`.
#[derive(Args, Clone, Debug)]
pub struct TrendArgs {
    /// Records of one machine: files as for signal, folders of them, or folders of stored runs; a folder is read in the
    /// natural order of its names (rec2 before rec10)
    #[arg(required = true, value_name = "FILE|FOLDER")]
    pub files: Vec<PathBuf>,
    /// Axis of the trend: one value per record, such as "load=0,1,2,3 hp"; time (of the files or names), name (the number
    /// in the names), speed, index; or a number that every file states, such as load [default: time, else name, else index]
    #[arg(long, value_name = "NAME[=VALUES]")]
    pub over: Option<String>,
    /// Channel, also without the number of the record: DE_time for X105_DE_time [default: the first vibration channel]
    #[arg(long, value_name = "NAME")]
    pub channel: Option<String>,
    #[command(flatten)]
    pub record: RecordArgs,
    /// Frequency bands for additional RMS values, such as "10 Hz .. 1 kHz,1 kHz .. 5 kHz"
    #[arg(long, value_name = "BANDS", value_delimiter = ',')]
    pub rms_bands: Vec<String>,

    /// Shaft speed, such as "1797 rpm", or one per record, such as "1797, 1772, 1750, 1730 rpm" [default: as stated in
    /// the files]
    #[arg(long, value_name = "SPEEDS", help_heading = "Shaft", conflicts_with_all = ["tacho", "track"])]
    pub speed: Option<String>,
    #[command(flatten)]
    pub shaft: ShaftArgs,
    #[command(flatten)]
    pub diagnosis: DiagnosisArgs,

    /// Results folder [default: out/trend_NAME]
    #[arg(long, value_name = "DIR", help_heading = "Figures and files")]
    pub out: Option<PathBuf>,
    /// Draw no figure
    #[arg(long, help_heading = "Figures and files")]
    pub no_figures: bool,
    /// Also write the tables of the results as CSV files, to csv/ in the results folder
    #[arg(long, help_heading = "Figures and files")]
    pub csv: bool,
}
