//! `signal`: signal analysis of a measured or simulated record and bearing diagnosis.

pub mod args;
pub mod bearing;
pub mod channel;
mod compare_records;
pub mod input;
pub mod line_tables;
pub mod orders;
pub mod record_speed;
pub mod settings;
pub mod shaft_source;
mod shared_rate;
mod tables;
mod tacho_marks;

use channel::analyse_channel;
use std::f64::consts::TAU;
use std::path::{Path, PathBuf};
use std::time::Instant;

use rotordyn::document::Section;
use rotordyn::figures;
use rotordyn::io::hdf5::Store;
use rotordyn::io::json::signal_to_json;
use rotordyn::io::results_file::{self, SignalMeta};
use rotordyn::names::folder_name;
use rotordyn::results::SignalResult;
use rotordyn::units::SPEED;
use rotordyn::warning::Code;
use serde_json::json;

use super::csv_files::write_csv;
use super::failure::Failure;
use super::folder_lock::FolderLock;
use super::terminal::Terminal;
use super::{Outcome, print_written_files};
use args::SignalArgs;
use input::{ChannelSelection, File, InputProblems};
use shaft_source::ShaftSource;

/// Name of the results file.
const RESULTS: &str = "signal.h5";

pub fn run(args: &SignalArgs, terminal: &Terminal) -> Result<Outcome, Failure> {
    let start = Instant::now();
    let file = File::read(&args.file, args.record.rate.as_deref())?;
    if let Some(left_out) = file.measured.left_out_text() {
        terminal.warn_of(Code::LeftOut, left_out);
    }
    let mut findings = InputProblems::default();
    let without: Vec<&str> =
        args.shaft.tacho.as_deref().into_iter().chain(args.quadrature_channel.as_deref()).collect();
    let choice = ChannelSelection {
        names: &args.channel,
        excluded: &without,
        quadrature: args.quadrature_channel.as_deref(),
        rate: args.record.rate.as_deref(),
        unit: args.record.unit.as_deref(),
        time: args.record.time.as_deref(),
        flag_prefix: "--",
    };
    let channels = input::channels(&file, &choice, &mut findings);
    let shaft = match &args.speed {
        Some(text) => findings
            .positive("--speed", text, SPEED)
            .map_or(ShaftSource::Unknown, |speed| ShaftSource::Steady(speed / TAU, "as given".into())),
        None => ShaftSource::of(&args.shaft, args.record.rate.as_deref(), &file, &mut findings),
    };
    let rated = bearing::find(&args.diagnosis, file.run(), &mut findings)?;
    let settings = settings::from_flags(args, rated.as_ref(), &mut findings);
    if rated.is_some() && !shaft.is_known() && findings.problems.is_empty() {
        findings.problem(
            "bearing defect frequencies need the shaft speed, which the file does not state; give --speed \"1797 rpm\", \
             --tacho CHANNEL or --track 1=\"5 Hz .. 50 Hz\"",
        );
    }
    findings.to_result()?;

    let spinner = terminal.spinner("signal");
    let results: Result<Vec<SignalResult>, Failure> =
        channels.iter().map(|channel| analyse_channel(channel, &shaft, rated.as_ref(), &settings)).collect();
    let results = results?;
    let other = match results.first() {
        Some(first) => compare_records::second_record(args, first, &settings, &mut findings)?,
        None => None,
    };
    spinner.finish_and_clear();
    let names: Vec<&str> = channels.iter().map(|c| c.name.as_str()).collect();
    tables::channels(terminal, &file, &names);
    if let Some(first) = results.first() {
        tables::shaft_and_bearing(terminal, first);
    }
    tables::statistics(terminal, &results);
    results.iter().for_each(|result| tables::channel(terminal, result));
    if let Some((other, title)) = &other {
        terminal.heading(&format!("Second record: {title}"));
        tables::shaft_and_bearing(terminal, other);
        tables::channel(terminal, other);
    }

    let folder = folder(args, &file);
    let _lock = FolderLock::take(&folder, terminal)?;
    let files = write(args, &file, &results, other.as_ref(), &folder, terminal)?;
    let seconds = start.elapsed().as_secs_f64();
    print_written_files(terminal, &folder, &files);
    if files.len() > 1 {
        terminal.print("  (figures are written as SVG and PNG)");
    }
    let mut warnings = file.measured.notes.clone();
    // A rate given by a flag is no longer missing.
    warnings.retain(|note| args.record.rate.is_none() || !note.starts_with("no sampling rate"));
    warnings.extend(findings.warnings);
    warnings.extend(results.iter().flat_map(|r| r.warnings.clone()));
    warnings.extend(bearing::variable_compliance(file.run(), &results)?);
    warnings.into_iter().for_each(|text| terminal.warn_of(Code::SignalAnalysis, text));
    let clipped = channels.iter().filter_map(input::clipping_text);
    clipped.for_each(|text| terminal.warn_of(Code::ClippedRecord, text));
    // What is computed has no sensors.
    let measured = channels.iter().filter(|_| !file.stored_run);
    measured.flat_map(input::dropout_texts).for_each(|(code, text)| terminal.warn_of(code, text));
    findings.coded.into_iter().for_each(|(code, text)| terminal.warn_of(code, text));
    let speeds = results.iter().filter_map(|result| record_speed::warning(result, settings.speed_range));
    speeds.for_each(|text| terminal.warn_of(Code::ShaftSpeedNotFound, text));

    let smeared = results.iter().flat_map(orders::smear_warnings);
    smeared.for_each(|text| terminal.warn_of(Code::OrderSmear, text));
    let shared = results.iter().flat_map(orders::one_band_warnings);
    shared.for_each(|text| terminal.warn_of(Code::OrdersInOneBand, text));
    let jitter = results.iter().flat_map(orders::jitter_warnings);
    jitter.for_each(|text| terminal.warn_of(Code::TachoJitter, text));

    let mut document = signal_to_json(&results, other.as_ref().map(|(other, _)| other));
    document["command"] = json!("signal");
    document["file"] = json!(file.path);
    document["contents"] = input::contents(&file);
    document["seconds"] = json!({ "signal": seconds });
    document["files"] = json!(files);
    Ok(document.into())
}

/// Results folder; default: folder of the stored run, else `out/NAME`.
fn folder(args: &SignalArgs, file: &File) -> PathBuf {
    match (&args.out, file.stored_run) {
        (Some(out), _) => out.clone(),
        (None, true) => file.path.parent().map(PathBuf::from).unwrap_or_default(),
        (None, false) => Path::new("out").join(folder_name(&file.stem)),
    }
}

/// Writes results and figures; returns their paths.
fn write(
    args: &SignalArgs,
    file: &File,
    results: &[SignalResult],
    other: Option<&(SignalResult, String)>,
    folder: &Path,
    terminal: &Terminal,
) -> Result<Vec<PathBuf>, Failure> {
    let store = Store::replace(folder.join(RESULTS))?;
    let command: Vec<String> = std::env::args().skip(1).collect();
    let meta = SignalMeta { file: &file.path.display().to_string(), command: &command.join(" ") };
    results_file::write_signal(&store, &meta, results, other.map(|(other, _)| other))?;
    let mut files = vec![store.path().to_path_buf()];
    store.commit()?;
    if args.csv {
        let sections: Vec<Section> = results.iter().map(SignalResult::section).collect();
        files.extend(write_csv(folder, &sections)?);
    }
    if !args.no_figures {
        let spinner = terminal.spinner("figures");
        files.extend(figures::draw_signal(results, &file.stem, folder)?);
        if let (Some(first), Some((other, other_title))) = (results.first(), other) {
            files.extend(figures::draw_envelope_comparison(
                [(first, &file.stem), (other, other_title)],
                folder,
            )?);
        }
        spinner.finish_and_clear();
    }
    Ok(files)
}
