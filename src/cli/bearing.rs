//! `bearing`: analysis of the ball bearings of a machine, or of a file with bearings only.

use std::time::Instant;

use miette::Severity;
use rotordyn::document::Section;
use rotordyn::figures;
use rotordyn::io::{json, results_file};
use rotordyn::model::{Diagnostic, LoadedBearings};
use rotordyn::results::{BearingResult, Results};
use rotordyn::study::{Machine, single_bearings};
use serde_json::json;

use super::args::BearingArgs;
use super::csv_files::write_csv;
use super::failure::Failure;
use super::machine::ModelSource;
use super::store::{self, ModelText};
use super::terminal::Terminal;
use super::{
    Outcome, bearing_tables, diagnostics, ehl_films, free_ball_tables, print_written_files, renamed, settings,
};

pub fn run(args: &BearingArgs, terminal: &Terminal) -> Result<Outcome, Failure> {
    let origin = ModelSource::read(&args.study.model)?;
    let mut loaded = origin.load_bearings(&settings::bearing(args)?)?;
    let folder = origin.results_folder(args.study.out.as_ref(), &loaded.name);
    match &mut loaded.model {
        Some(model) => ehl_films::prepare_machine_films(model, &folder, terminal)?,
        None => {
            for (name, bearing) in &mut loaded.bearings {
                ehl_films::prepare_bearing_films(name, bearing, &folder, terminal)?;
            }
        }
    }
    let text = ModelText { model: &loaded.text, title: &loaded.title, estimated: String::new() };
    let start = Instant::now();
    let spinner = terminal.spinner("bearing");
    let bearings_or_error = compute(&loaded);
    spinner.finish_and_clear();
    let bearings = bearings_or_error?;
    let seconds = start.elapsed().as_secs_f64();
    for bearing in &bearings {
        bearing_tables::bearing(terminal, bearing);
        if let Some(free) = &bearing.free_balls {
            free_ball_tables::print(terminal, free);
        }
    }
    let mut results = Results { bearings, ..Results::default() };
    results.warnings = loaded.warnings.iter().filter_map(Diagnostic::to_warning).collect();
    results.warnings.extend(results.bearings.iter().flat_map(|b| b.warnings.clone()));

    let store = store::open(&folder, text, &origin, false, terminal)?;
    results_file::write_bearings(&store, &results)?;
    let mut files = vec![store.path().to_path_buf()];
    if args.study.csv {
        let sections: Vec<Section> = results.bearings.iter().map(BearingResult::section).collect();
        files.extend(write_csv(&folder, &sections)?);
    }
    if !args.study.no_figures {
        let spinner = terminal.spinner("figures");
        files.extend(figures::draw_bearings(&results.bearings, &loaded.title, &folder)?);
        spinner.finish_and_clear();
    }
    print_written_files(terminal, &folder, &files);
    if files.len() > 1 {
        terminal.print("  (figures are written as SVG and PNG)");
    }
    renamed::print_hints(&loaded.hints, &loaded.sources, terminal);
    if !loaded.warnings.is_empty() {
        eprint!(
            "{}",
            diagnostics::render(&loaded.warnings, &loaded.sources, Severity::Warning, terminal.colour)
        );
    }
    results.warnings[loaded.warnings.len()..].iter().for_each(|warning| terminal.warn(warning));
    let mut document = json::bearings_to_json(&results, &loaded.name, &loaded.title);
    document["command"] = json!("bearing");
    document["seconds"] = json!({ "bearing": seconds });
    document["files"] = json!(files);
    Ok(document.into())
}

fn compute(loaded: &LoadedBearings) -> Result<Vec<BearingResult>, rotordyn::assembly::PhysicsError> {
    let study = loaded.studies.bearing.clone().unwrap_or_default();
    match &loaded.model {
        Some(model) => Machine::new(model.clone())?.bearings(&study),
        None => single_bearings(&loaded.bearings, &study),
    }
}
