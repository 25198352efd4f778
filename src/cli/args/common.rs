//! Arguments shared by commands: model, results folder, output, stored runs.

use super::super::limits;
use super::keys::help as key_help;
use clap::Args;
use rotordyn::units;
use std::path::PathBuf;
use std::time::Duration;

/// Output options common to all commands.
#[derive(Args, Clone, Debug)]
#[command(next_help_heading = "Output")]
pub struct Output {
    /// Print one JSON document to standard output instead of tables
    #[arg(long, global = true)]
    pub json: bool,
    /// Print no tables and no progress, only errors and warnings
    #[arg(long, short, global = true)]
    pub quiet: bool,
    /// End with exit code 5 if there is any warning; what was computed is written as without it
    #[arg(long, global = true)]
    pub strict: bool,
    /// Number of threads; results do not depend on it [default: all cores]
    #[arg(long, global = true, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    pub threads: Option<u16>,
    /// Memory for the contents of one file that is read, such as 16GB [default: by its size, 64 MB and 32 times
    /// the file, at most 8 GB]
    #[arg(long, global = true, value_name = "SIZE", value_parser = limits::size)]
    pub read_limit: Option<u64>,
}

/// Model file, variant and overrides.
#[derive(Args, Clone, Debug)]
pub struct ModelArgs {
    /// The model file (TOML)
    pub model: PathBuf,
    /// Apply [variant.NAME] of the file
    #[arg(long, value_name = "NAME")]
    pub variant: Option<String>,
    /// Override any value of the model, such as bearing.B.radial_clearance="20 um"; can be repeated
    #[arg(long, value_name = "PATH=VALUE", value_parser = assignment)]
    pub set: Vec<(String, String)>,
}

/// Model and results folder.
#[derive(Args, Clone, Debug)]
pub struct StudyArgs {
    #[command(flatten)]
    pub model: ModelArgs,
    /// Folder for the results [default: out/NAME or out/NAME_VARIANT]
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Draw no figures
    #[arg(long)]
    pub no_figures: bool,
    /// Also write the tables of the results as CSV files, to csv/ in the results folder
    #[arg(long)]
    pub csv: bool,
}

/// Checkpoints of long studies.
#[derive(Args, Clone, Debug, Default)]
pub struct CheckpointArgs {
    /// Go on from the checkpoint of a run that was stopped or killed, to the same results bit for bit; afresh
    /// without one
    #[arg(long)]
    pub resume: bool,
    /// Time between checkpoints, such as "10 s", or off [default: 30 s, longer where they would take 1 % of the
    /// time]
    #[arg(long, value_name = "TIME", value_parser = interval)]
    pub checkpoint: Option<Interval>,
}

/// Interval of checkpoints.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Interval {
    Off,
    /// As given, whatever they take.
    Given(Duration),
    /// The default one, by their cost.
    Default,
}

/// Parse a time or "off".
fn interval(text: &str) -> Result<Interval, String> {
    if text.trim() == "off" {
        return Ok(Interval::Off);
    }
    let seconds = units::parse(text, units::TIME).map_err(|error| format!("{error}; or off"))?;
    let duration = Duration::try_from_secs_f64(seconds).map_err(|_| "give a time of zero or more, or off")?;
    Ok(Interval::Given(duration))
}

/// What is written beside the results file.
#[derive(Clone, Copy, Debug)]
pub struct OutputFiles {
    pub figures: bool,
    /// The tables as CSV files.
    pub csv: bool,
    /// The page of the run.
    pub page: bool,
}

impl From<&StudyArgs> for OutputFiles {
    fn from(args: &StudyArgs) -> Self {
        Self { figures: !args.no_figures, csv: args.csv, page: false }
    }
}

impl From<&StoredArgs> for OutputFiles {
    fn from(args: &StoredArgs) -> Self {
        Self { figures: !args.no_figures, csv: args.csv, page: false }
    }
}

/// Results whose page is written (`report`).
#[derive(Args, Clone, Debug, Default)]
pub struct ReportArgs {
    /// results.h5 of a run, or its folder
    pub file: PathBuf,
    /// File to write [default: report.html beside results.h5]
    #[arg(short, long, value_name = "FILE")]
    pub out: Option<PathBuf>,
}

/// Stored run-up and settings of its analyses (`spectrogram`, `orders`).
#[derive(Args, Clone, Debug, Default)]
pub struct StoredArgs {
    /// results.h5 of a run-up, or its folder
    pub file: PathBuf,
    /// Channels, separated by commas [default: those of the model file, else all vibration channels]
    #[arg(long, value_name = "NAMES", value_delimiter = ',')]
    pub channels: Vec<String>,
    /// Order lines to draw or to extract (order cuts), such as 1,2,BPFO,"2 BPFO"
    #[arg(long, value_name = "ORDERS", value_delimiter = ',')]
    pub orders: Vec<String>,
    #[arg(long, value_name = "NUMBER", help = key_help("study.orders.overlap"))]
    pub overlap: Option<String>,
    #[arg(long, value_name = "NAME", help = key_help("study.orders.window"))]
    pub window: Option<String>,
    /// Draw no figures
    #[arg(long)]
    pub no_figures: bool,
    /// Also write the tables of the results as CSV files, to csv/ in the results folder
    #[arg(long)]
    pub csv: bool,
}

/// Arguments of `spectrogram`.
#[derive(Args, Clone, Debug, Default)]
pub struct SpectrogramArgs {
    #[command(flatten)]
    pub stored: StoredArgs,
    #[arg(long, value_name = "TIME", help = key_help("study.spectrogram.length"))]
    pub length: Option<String>,
    #[arg(long, value_name = "FREQUENCY", help = key_help("study.spectrogram.max_frequency"))]
    pub max_frequency: Option<String>,
}

/// Arguments of `orders`.
#[derive(Args, Clone, Debug, Default)]
pub struct OrdersArgs {
    #[command(flatten)]
    pub stored: StoredArgs,
    #[arg(long, value_name = "NUMBER", help = key_help("study.orders.resolution"))]
    pub resolution: Option<String>,
    #[arg(long, value_name = "NUMBER", help = key_help("study.orders.max_order"))]
    pub max_order: Option<String>,
    #[arg(long, value_name = "ORDERS", help = key_help("study.orders.bandwidth"))]
    pub bandwidth: Option<String>,
}

/// Parse PATH=VALUE.
pub(super) fn assignment(text: &str) -> Result<(String, String), String> {
    match text.split_once('=') {
        Some((path, value)) if !path.trim().is_empty() => Ok((path.trim().into(), value.trim().into())),
        _ => Err("expected PATH=VALUE, such as bearing.B.radial_clearance=\"20 um\"".into()),
    }
}
