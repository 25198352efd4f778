//! Run-ups of the cases, beside a measured one.

use std::path::Path;

use rotordyn::document::Section;
use rotordyn::figures;
use rotordyn::io::json;
use rotordyn::names::file_names;
use rotordyn::results::{CampbellResult, OrderResult, SpectrogramResult};
use rotordyn::study::{MEASURED, Machine, Run, compare_run_ups};
use serde_json::json;

use super::super::args::{CompareArgs, OrdersArgs, OutputFiles, SpectrogramArgs};
use super::super::csv_files::write_csv;
use super::super::failure::Failure;
use super::super::folder_lock::FolderLock;
use super::super::outcome::collect_warnings;
use super::super::run_up_correlation::{self, MeasuredRunUp, RunUpReading};
use super::super::store::{self, ModelText};
use super::super::studies::{Job, Study};
use super::super::terminal::{Terminal, number};
use super::super::{Outcome, ehl_films, print_model_warnings, print_written_files, settings};
use super::cases::Case;
use super::output::{folder, note_left_out};
use super::tables;

/// Run of one case.
struct Computed<'a> {
    name: &'a str,
    job: Job<'a>,
    campbell: Option<CampbellResult>,
    spectrograms: Vec<SpectrogramResult>,
    orders: Vec<OrderResult>,
}

pub fn run(args: &CompareArgs, cases: &[Case], terminal: &Terminal) -> Result<Outcome, Failure> {
    let first = cases[0].origin.load_with(&cases[0].settings)?.model;
    let folder = folder(args, &first.name);
    let _lock = FolderLock::take(&folder, terminal)?;
    let folders = file_names(cases.iter().map(|case| case.name.as_str()));
    // The tables of every run would hide those of the comparison.
    let quiet = terminal.without_tables();
    let mut computed = Vec::new();
    let mut measured: Option<MeasuredRunUp> = None;
    for (case, name) in cases.iter().zip(&folders) {
        let own = measured_of(args, case, terminal, computed.is_empty())?;
        terminal.note(&format!("run-up of {}", case.name));
        computed.push(simulate(case, own.as_ref(), &folder.join(name), &quiet, terminal)?);
        if measured.is_none() {
            measured = own;
        }
    }
    let of_measured = match &measured {
        Some(found) => Some((found, computed[0].job.machine.spectra_of_run(&found.run.history)?)),
        None => None,
    };
    let mut runs = Vec::new();
    if let Some((found, (spectrograms, orders))) = &of_measured {
        runs.push(Run { name: MEASURED, history: &found.run.history, spectrograms, orders });
    }
    for case in &computed {
        let Some(run) = &case.job.results.run_up else { continue };
        let (spectrograms, orders) = (&case.spectrograms, &case.orders);
        runs.push(Run { name: case.name, history: &run.history, spectrograms, orders });
    }
    let found = compare_run_ups(&runs)?;
    if found.channels.is_empty() {
        return Err(Failure::Input(format!(
            "the run-ups have no channel in common, of the same unit and direction:\n  {}",
            found.left_out.join("\n  ")
        )));
    }
    tables::run_ups(terminal, &found);
    note_left_out(&found.left_out, terminal);
    let section = Section::new("comparison", "comparison", found.document());
    let mut files: Vec<_> = computed.iter().flat_map(|case| case.job.files.clone()).collect();
    if args.study.csv {
        files.extend(write_csv(&folder, std::slice::from_ref(&section))?);
    }
    if !args.study.no_figures {
        let spinner = terminal.spinner("figures");
        let own = computed.iter().map(|case| case.campbell.as_ref());
        let with_measured = of_measured.iter().map(|_| computed[0].campbell.as_ref());
        let campbell: Vec<Option<&CampbellResult>> = with_measured.chain(own).collect();
        let machine = &computed[0].job.machine;
        files.extend(figures::draw_run_up_comparison(&found, &campbell, machine, &folder)?);
        spinner.finish_and_clear();
    }
    print_written_files(terminal, &folder, &files);
    let mut document = json::document(&section.content);
    document["command"] = json!("compare");
    document["model"] = json!(first.name);
    document["speed_source"] = json!(measured.as_ref().map(|found| &found.source));
    document["files"] = json!(files);
    Ok(document.into())
}

/// The measured run-up at the points of a case.
fn measured_of(
    args: &CompareArgs,
    case: &Case,
    terminal: &Terminal,
    is_first: bool,
) -> Result<Option<MeasuredRunUp>, Failure> {
    let Some(path) = &args.measured else { return Ok(None) };
    let model = case.origin.load_with(&case.settings)?.model;
    let reading =
        RunUpReading { mapping: args.mapping.as_deref(), time: args.time.as_deref(), shaft: &args.shaft };
    // What is wrong with the file is said once.
    let quiet = terminal.without_warnings();
    let shown = if is_first { terminal } else { &quiet };
    let found = run_up_correlation::read(path, &reading, &model, shown)?;
    let found = found.map_err(|why| Failure::Input(format!("{}: no run-up: {why}", path.display())))?;
    if is_first {
        terminal.print(&format!(
            "{}: a run-up from {:.0} to {:.0} rpm in {} s, speed by {}",
            path.display(),
            found.rpm[0],
            found.rpm[1],
            number(found.run.profile.duration(), 4),
            found.source
        ));
    }
    Ok(Some(found))
}

/// Runs one case, driven by a measured speed if there is one; its results are written to `folder`.
fn simulate<'a>(
    case: &'a Case,
    measured: Option<&MeasuredRunUp>,
    folder: &Path,
    quiet: &'a Terminal,
    terminal: &Terminal,
) -> Result<Computed<'a>, Failure> {
    let model = case.origin.load_with(&case.settings)?.model;
    let top = measured.map(|found| format!("{} rpm", found.rpm[1]));
    let mut own = case.settings.clone();
    for more in [
        settings::run_up(&model, None, None, None, None, None),
        settings::spectrogram(&model, &SpectrogramArgs::default()),
        settings::orders(&model, &OrdersArgs::default()),
        settings::campbell(&model, top.as_ref(), None),
    ] {
        own.set.extend(more.set);
    }
    let mut loaded = case.origin.load_with(&own)?;
    let _lock = FolderLock::take(folder, terminal)?;
    ehl_films::prepare_machine_films(&mut loaded.model, folder, terminal)?;
    let machine = match measured {
        Some(found) => Machine::new(found.run.driven_model(&loaded.model))?,
        None => Machine::new(loaded.model.clone())?,
    };
    let studies = &machine.model.studies;
    let campbell = studies.campbell.as_ref().map(|study| machine.campbell(study)).transpose()?;
    let text = ModelText { measured_speed: measured.map(|found| found.source.clone()), ..(&loaded).into() };
    // The results file keeps the values of the case beside the text of the model.
    let mut origin = case.origin.clone();
    origin.options.set.extend_from_slice(&own.set);
    let output = store::open(folder, text, &origin, true, terminal)?;
    let mut job = Job::new(quiet, machine, folder.to_path_buf(), output);
    let wanted = [Study::RunUp, Study::Spectrogram, Study::Orders];
    job.perform(if measured.is_some() { &wanted[..1] } else { &wanted });
    collect_warnings(&mut job, &wanted[..1]);
    // Partial results are written even if the run failed.
    job.write(OutputFiles { figures: false, csv: false, page: false })?;
    for warning in &job.results.warnings {
        terminal.warn(&warning.clone().prefixed(&case.name));
    }
    print_model_warnings(terminal, &loaded);
    if let Some((_, failure)) = job.failures.pop() {
        return Err(failure);
    }
    let (spectrograms, orders) = match (&job.results.run_up, measured) {
        (Some(run), Some(_)) => job.machine.spectra_of_run(&run.history)?,
        _ => (std::mem::take(&mut job.results.spectrograms), std::mem::take(&mut job.results.orders)),
    };
    Ok(Computed { name: &case.name, job, campbell, spectrograms, orders })
}
