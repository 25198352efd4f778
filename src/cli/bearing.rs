//! `bearing`: analysis of the ball bearings of a machine, or of a file with bearings only.

use std::time::Instant;

use miette::Severity;
use rotordyn::document::Section;
use rotordyn::figures::{self, FigureFolder};
use rotordyn::io::hdf5::COMPLETE;
use rotordyn::io::{document_tables, json, results_file};
use rotordyn::model::{Diagnostic, LoadedBearings};
use rotordyn::results::{BearingResult, Results};
use rotordyn::study::{Machine, single_bearings};
use serde_json::json;

use super::args::BearingArgs;
use super::csv_files::write_csv;
use super::failure::Failure;
use super::folder_lock::FolderLock;
use super::machine::ModelSource;
use super::store::{self, ModelText};
use super::terminal::Terminal;
use super::{
    Outcome, bearing_motion, diagnostics, ehl_films, free_ball_runs, print_written_files, renamed, settings,
};

pub fn run(args: &BearingArgs, terminal: &Terminal) -> Result<Outcome, Failure> {
    let origin = ModelSource::read(&args.study.model)?;
    let mut loaded = origin.load_bearings(&settings::bearing(args)?)?;
    let folder = origin.results_folder(args.study.out.as_ref(), &loaded.name);
    let _lock = FolderLock::take(&folder, terminal)?;
    match &mut loaded.model {
        Some(model) => ehl_films::prepare_machine_films(model, &folder, terminal)?,
        None => {
            for (name, bearing) in &mut loaded.bearings {
                ehl_films::prepare_bearing_films(name, bearing, &folder, terminal)?;
            }
        }
    }
    let text = ModelText { title: &loaded.title, estimated: String::new(), measured_speed: None };
    let start = Instant::now();
    let (bearings, complete) = compute(&loaded, terminal)?;
    let seconds = start.elapsed().as_secs_f64();
    free_ball_runs::print(terminal, &bearings);
    let mut results = Results { bearings, ..Results::default() };
    results.warnings = loaded.warnings.iter().filter_map(Diagnostic::to_warning).collect();
    results.warnings.extend(results.bearings.iter().flat_map(|b| b.warnings.clone()));

    let mut output = store::open(&folder, text, &origin, false, terminal)?;
    let drawn = match args.study.no_figures {
        true => Vec::new(),
        false => figures::of_bearings(&results.bearings, &loaded.title),
    };
    let sections: Vec<Section> = results.bearings.iter().map(BearingResult::section).collect();
    let mut listed = figures::file_names(&drawn);
    if args.study.csv {
        let tables = document_tables::tables(&sections);
        listed.extend(document_tables::csv_names(&tables).iter().map(|name| format!("csv/{name}")));
    }
    let state =
        if complete { COMPLETE.to_string() } else { format!("stopped: {}", Failure::Interrupted.message()) };
    let file = output
        .writer
        .finish(&state, &listed, &[], |store| results_file::write_bearings(store, &results))
        .map_err(|error| Failure::from(error).with_consequence("not stored: bearing"))?;
    output.earlier.move_aside(&folder, &listed, terminal)?;
    let mut files = vec![file];
    if args.study.csv {
        files.extend(write_csv(&folder, &sections)?);
    }
    if !args.study.no_figures {
        let spinner = terminal.spinner("figures");
        let identity = output.writer.identity();
        let place = FigureFolder::new(&folder).with_identity(&identity);
        files.extend(figures::write_all(&drawn, place)?);
        spinner.finish_and_clear();
    }
    if let Some(turns) = args.motion {
        files.extend(bearing_motion::export(
            &results.bearings,
            loaded.model.as_ref(),
            turns,
            &folder,
            terminal,
        )?);
    }
    print_written_files(terminal, &folder, &files);
    if files.len() > 1 {
        terminal.print("  (figures are written as SVG and PNG)");
    }
    renamed::print_hints(&loaded.hints, &loaded.sources, terminal);
    if !loaded.warnings.is_empty() {
        let text = diagnostics::render(&loaded.warnings, &loaded.sources, Severity::Warning, terminal.colour);
        terminal.diagnostics(&text);
    }
    results.warnings[loaded.warnings.len()..].iter().for_each(|warning| terminal.warn(warning));
    let mut document = json::bearings_to_json(&results, &loaded.name, &loaded.title);
    document["command"] = json!("bearing");
    document["seconds"] = json!({ "bearing": seconds });
    document["files"] = json!(files);
    let mut outcome = Outcome::from(document);
    if !complete {
        outcome.failures.push(("bearing", Failure::Interrupted));
    }
    Ok(outcome)
}

/// All results, and whether none is missing because of Ctrl-C.
pub fn compute(loaded: &LoadedBearings, terminal: &Terminal) -> Result<(Vec<BearingResult>, bool), Failure> {
    let study = loaded.studies.bearing.clone().unwrap_or_default();
    let is_analysed =
        |name: &String| study.bearings.is_empty() || study.bearings.iter().any(|other| other == name);
    if study.skidding.is_some() && !loaded.free_balls.iter().any(|(name, _)| is_analysed(name)) {
        let names: Vec<&str> = loaded
            .bearings
            .iter()
            .map(|(name, _)| name.as_str())
            .filter(|n| is_analysed(&(*n).into()))
            .collect();
        return Err(Failure::Input(format!(
            "a skidding map needs free balls: give bearing {} model = \"free_ball\", beside its keys of geometry",
            names.join(", ")
        )));
    }
    let spinner = terminal.spinner("bearing");
    let found = match &loaded.model {
        Some(model) => Machine::new(model.clone()).and_then(|machine| {
            let found = machine.static_bearings(&study)?;
            Ok((found, machine.free_balls()))
        }),
        None => single_bearings(&loaded.bearings, &study).map(|found| (found, loaded.free_balls.clone())),
    };
    spinner.finish_and_clear();
    let (mut found, free) = found?;
    let complete = free_ball_runs::run(&mut found, &free, &study, terminal);
    Ok((found, complete))
}
