//! `trend`: several records of one machine over time, load or another axis.

pub mod args;
mod axis;
mod files;
mod names;
mod record;
mod tables;

use std::path::{Path, PathBuf};
use std::time::Instant;

use rayon::prelude::*;
use rotordyn::figures;
use rotordyn::io::hdf5::Store;
use rotordyn::io::json::trend_to_json;
use rotordyn::io::results_file::{self, SignalMeta, newest_results};
use rotordyn::names::folder_name;
use rotordyn::results::{TrendRecord, TrendResult};
use rotordyn::study::trend::{common_band, complete, differences};
use rotordyn::units::{self, FREQUENCY, SPEED};
use rotordyn::warning::Code;
use serde_json::json;

use super::csv_files::write_csv;
use super::failure::Failure;
use super::folder_lock::FolderLock;
use super::interrupt;
use super::signal::input::{InputProblems, plain_name};
use super::signal::{bearing, settings};
use super::terminal::Terminal;
use super::{Outcome, print_written_files};
use args::TrendArgs;
use axis::Over;
use files::Source;
use names::{MAX_NAMES, few};
use record::{Analysed, Job, analyses};

/// Name of the results file.
const RESULTS: &str = "trend.h5";
/// Most records in memory at a time.
const MAX_AT_ONCE: usize = 8;

pub fn run(args: &TrendArgs, terminal: &Terminal) -> Result<Outcome, Failure> {
    let start = Instant::now();
    let (sources, others) = files::sources(&args.files)?;
    if !others.is_empty() {
        let text = format!("in the folder but no record: {}", few(others.iter().map(String::as_str)));
        terminal.warn_of(Code::LeftOut, text);
    }
    let mut findings = InputProblems::default();
    let over = findings.value_or_problem("", Over::parse(args.over.as_deref())).unwrap_or(Over::Auto);
    let speeds = speeds(args, &sources, &mut findings);
    let rms_bands: Vec<[f64; 2]> = (args.rms_bands.iter())
        .filter_map(|text| findings.range("--rms-bands", text, FREQUENCY, [0.0, f64::INFINITY]))
        .collect();
    // A stored run has the model of its bearings.
    let run =
        sources.first().filter(|source| source.path.is_dir()).map(|source| newest_results(&source.path));
    let rated = bearing::find(&args.diagnosis, run.as_deref(), &mut findings)?;
    let settings = settings::diagnosis(&args.diagnosis, rated.as_ref(), &mut findings);
    if let Over::Given { name, values, .. } = &over
        && values.len() != sources.len()
    {
        findings.problem(format!(
            "--over {name}: {} values for {} records: {}",
            values.len(),
            sources.len(),
            few(sources.iter().map(|source| source.name.as_str()))
        ));
    }
    findings.to_result()?;

    let number = match &over {
        Over::Number(name) => Some(name.clone()),
        _ => None,
    };
    let job = Job {
        args,
        settings: rotordyn::study::signal::SignalSettings { analyses: analyses(rated.as_ref()), ..settings },
        bearing: rated,
        rms_bands,
        number,
    };
    let wanted: Vec<(&Source, Option<f64>)> = sources
        .iter()
        .enumerate()
        .map(|(k, source)| (source, speeds.as_ref().map(|s| s[k.min(s.len() - 1)])))
        .collect();
    let mut found = for_each(&wanted, "records", terminal, |(source, speed)| job.analyse(source, *speed))?;
    if found.iter().all(|r| r.record.state.is_none()) {
        return Err(none_read(found));
    }
    let (axis, places) = axis::positions(&over, &found).map_err(Failure::Input)?;
    found.iter_mut().zip(places).for_each(|(r, place)| r.record.position = place);
    let line_band = line_levels(&job, &wanted, &mut found, terminal)?;
    let mut warnings = std::mem::take(&mut findings.warnings);
    let (records, failures) = take_apart(found, terminal, &mut warnings);
    let result = complete(TrendResult {
        axis,
        unit: String::new(),
        bearing: job.bearing.clone(),
        line_band,
        rms_bands: job.rms_bands.clone(),
        records,
        changes: Vec::new(),
        statements: Vec::new(),
    });
    tables::print(terminal, &result);

    let title = title(args);
    let folder =
        args.out.clone().unwrap_or_else(|| Path::new("out").join(folder_name(&format!("trend_{title}"))));
    let _lock = FolderLock::take(&folder, terminal)?;
    let files = write(args, &result, &title, &folder, terminal)?;
    print_written_files(terminal, &folder, &files);
    findings.coded.into_iter().for_each(|(code, text)| terminal.warn_of(code, text));
    differences(&result.records, plain_name)
        .into_iter()
        .for_each(|text| terminal.warn_of(Code::RecordsDiffer, text));
    warnings.into_iter().for_each(|text| terminal.warn_of(Code::SignalAnalysis, text));

    let mut document = trend_to_json(&result);
    document["command"] = json!("trend");
    document["seconds"] = json!({ "trend": start.elapsed().as_secs_f64() });
    document["files"] = json!(files);
    Ok(Outcome { document, failures })
}

/// Shaft speeds \[rad/s\]: one, or one per record.
fn speeds(args: &TrendArgs, sources: &[Source], findings: &mut InputProblems) -> Option<Vec<f64>> {
    let text = args.speed.as_ref()?;
    let parsed =
        units::parse_list(text, SPEED).map_err(|e| format!("--speed: {e}; such as \"1797, 1772 rpm\""));
    let found = findings.value_or_problem("", parsed)?;
    if found.iter().any(|speed| !(*speed > 0.0 && speed.is_finite())) {
        findings.problem(format!("--speed {text}: positive speeds are expected"));
        return None;
    }
    if found.len() != 1 && found.len() != sources.len() {
        findings.problem(format!(
            "--speed has {} speeds for {} records: give one, or one per record in the order {}",
            found.len(),
            sources.len(),
            few(sources.iter().map(|source| source.name.as_str()))
        ));
        return None;
    }
    Some(found)
}

/// Applies a function to all records in parallel, a few at a time: each holds one record in memory, and a thread that
/// waits within one would otherwise begin with another.
fn for_each<T: Sync, R: Send>(
    records: &[T],
    what: &str,
    terminal: &Terminal,
    of: impl Fn(&T) -> R + Sync,
) -> Result<Vec<R>, Failure> {
    let bar = terminal.count_bar();
    bar.set_length(records.len() as u64);
    bar.set_message(what.to_string());
    let mut out = Vec::with_capacity(records.len());
    for some in records.chunks(rayon::current_num_threads().clamp(1, MAX_AT_ONCE)) {
        if interrupt::requested() {
            bar.finish_and_clear();
            return Err(Failure::Interrupted);
        }
        out.extend(some.par_iter().map(&of).collect::<Vec<R>>());
        bar.inc(some.len() as u64);
    }
    bar.finish_and_clear();
    Ok(out)
}

/// Gives every record the levels of its lines in one band, which is returned.
///
/// A record's own band, which shows its own lines best, is not that of the others: an amplitude in it is no trend.
fn line_levels(
    job: &Job,
    wanted: &[(&Source, Option<f64>)],
    found: &mut [Analysed],
    terminal: &Terminal,
) -> Result<Option<(f64, f64)>, Failure> {
    let judged = |r: &Analysed| {
        r.record.state.as_ref().and_then(|s| s.diagnosis.as_ref()).map(|d| (d.band, d.lines.is_some()))
    };
    let Some((band, has_lines)) = found.iter().find_map(judged) else { return Ok(None) };
    if has_lines {
        return Ok(Some(band));
    }
    let states: Vec<TrendRecord> = found.iter().map(|r| r.record.clone()).collect();
    let Some(band) = common_band(&states) else { return Ok(None) };
    let open: Vec<usize> = (0..found.len()).filter(|&k| judged(&found[k]).is_some()).collect();
    let levels =
        for_each(&open, "bearing lines", terminal, |&k| job.line_levels(wanted[k].0, wanted[k].1, band))?;
    for (k, level) in open.into_iter().zip(levels) {
        if level.is_none() {
            found[k].warnings.push(format!(
                "the record does not contain the band {} to {} Hz, in which line amplitudes are compared; choose another with --band",
                band.0, band.1
            ));
        }
        if let Some(diagnosis) = found[k].record.state.as_mut().and_then(|s| s.diagnosis.as_mut()) {
            diagnosis.lines = level;
        }
    }
    Ok(Some(band))
}

/// Why no record can be read.
fn none_read(found: Vec<Analysed>) -> Failure {
    let count = found.len();
    let mut failures: Vec<Failure> = found.into_iter().filter_map(|r| r.failure).collect();
    if failures.len() == 1 && count == 1 {
        return failures.remove(0);
    }
    let shown: Vec<String> = failures.iter().take(MAX_NAMES).map(Failure::message).collect();
    let more =
        if count > shown.len() { format!("\n  - and {} more", count - shown.len()) } else { String::new() };
    Failure::Input(format!("none of {count} records can be read:\n  - {}{more}", shown.join("\n  - ")))
}

/// The records, and the failures of those that were not read or judged; warnings of several records are merged.
fn take_apart(
    found: Vec<Analysed>,
    terminal: &Terminal,
    warnings: &mut Vec<String>,
) -> (Vec<TrendRecord>, Vec<(&'static str, Failure)>) {
    let mut merged: Vec<(Code, String, Vec<String>)> = Vec::new();
    let mut add = |code: Code, text: String, name: &str| match merged
        .iter_mut()
        .find(|(c, t, _)| *c == code && *t == text)
    {
        Some((.., names)) => names.push(name.into()),
        None => merged.push((code, text, vec![name.into()])),
    };
    let (mut records, mut failures) = (Vec::new(), Vec::new());
    for r in found {
        let name = &r.record.name;
        r.left_out.into_iter().for_each(|text| add(Code::LeftOut, text, name));
        r.warnings.into_iter().for_each(|text| add(Code::SignalAnalysis, text, name));
        r.dropouts.into_iter().for_each(|(code, text)| add(code, text, name));
        if r.speed_not_found {
            let text = "no family of shaft harmonics near the stated speed: speed and sampling rate are not confirmed";
            add(Code::ShaftSpeedNotFound, text.into(), name);
        }
        failures.extend(r.failure.map(|failure| ("", failure)));
        records.push(r.record);
    }
    for (code, text, names) in merged {
        let text = format!("{}: {text}", few(names.iter().map(String::as_str)));
        match code {
            Code::SignalAnalysis => warnings.push(text),
            _ => terminal.warn_of(code, text),
        }
    }
    (records, failures)
}

/// Name of the trend: that of the first folder, or of the first file.
fn title(args: &TrendArgs) -> String {
    let first = args.files.first().map_or(Path::new("records"), PathBuf::as_path);
    let absolute = first.canonicalize().unwrap_or_else(|_| first.to_path_buf());
    let name = if first.is_dir() { absolute.file_name() } else { first.file_stem() };
    name.map_or_else(|| "records".into(), |name| name.to_string_lossy().into_owned())
}

/// Writes results and the figure; returns their paths.
fn write(
    args: &TrendArgs,
    result: &TrendResult,
    title: &str,
    folder: &Path,
    terminal: &Terminal,
) -> Result<Vec<PathBuf>, Failure> {
    let store = Store::replace(folder.join(RESULTS))?;
    let command: Vec<String> = std::env::args().skip(1).collect();
    let read: Vec<String> = args.files.iter().map(|path| path.display().to_string()).collect();
    let meta = SignalMeta { file: &read.join(", "), command: &command.join(" ") };
    results_file::write_trend(&store, &meta, result)?;
    let mut files = vec![store.path().to_path_buf()];
    store.commit()?;
    if args.csv {
        files.extend(write_csv(folder, &[result.section()])?);
    }
    if !args.no_figures {
        let spinner = terminal.spinner("figure");
        files.extend(figures::draw_trend(result, title, folder)?);
        spinner.finish_and_clear();
    }
    Ok(files)
}
