//! `bearing`: analysis of the ball bearings of a machine, or of a file with bearings only.

use std::time::Instant;

use miette::Severity;
use rotordyn::edge::{figures, json, results_file};
use rotordyn::model::LoadedBearings;
use rotordyn::results::Results;
use rotordyn::study::{Machine, bearings_alone};
use serde_json::json;

use super::args::BearingArgs;
use super::failure::Failure;
use super::machine::Origin;
use super::store::{self, Text};
use super::terminal::Terminal;
use super::{Outcome, bearing_tables, diagnostics, films, settings, written};

pub fn run(args: &BearingArgs, terminal: &Terminal) -> Result<Outcome, Failure> {
    let origin = Origin::read(&args.study.model)?;
    let mut loaded = origin.load_bearings(&settings::bearing(args)?.set)?;
    let folder = origin.folder(args.study.out.as_ref(), &loaded.name);
    match &mut loaded.model {
        Some(model) => films::of_machine(model, &folder, terminal)?,
        None => {
            for (name, bearing) in &mut loaded.bearings {
                films::of_bearing(name, bearing, &folder, terminal)?;
            }
        }
    }
    let text = Text { model: &loaded.text, title: &loaded.title };
    let start = Instant::now();
    let spinner = terminal.spinner("bearing");
    let found = compute(&loaded);
    spinner.finish_and_clear();
    let bearings = found?;
    let seconds = start.elapsed().as_secs_f64();
    for bearing in &bearings {
        bearing_tables::bearing(terminal, bearing);
    }
    let mut results = Results { bearings, ..Results::default() };
    results.warnings = loaded.warnings.iter().map(|w| w.message.clone()).collect();
    results.warnings.extend(results.bearings.iter().flat_map(|b| b.warnings.clone()));

    let store = store::open(&folder, text, &origin, false, terminal)?;
    results_file::write_bearings(&store, &results)?;
    let mut files = vec![store.path().to_path_buf()];
    if !args.study.no_figures {
        let spinner = terminal.spinner("figures");
        files.extend(figures::draw_bearings(&results.bearings, &loaded.title, &folder)?);
        spinner.finish_and_clear();
    }
    written(terminal, &folder, &files);
    if files.len() > 1 {
        terminal.say("  (figures are written as SVG and PNG)");
    }
    if !loaded.warnings.is_empty() {
        eprint!(
            "{}",
            diagnostics::render(&loaded.warnings, &loaded.sources, Severity::Warning, terminal.colour)
        );
    }
    for warning in &results.warnings[loaded.warnings.len()..] {
        terminal.complain("warning", warning);
    }
    let mut document = json::bearings_to_json(&results, &loaded.name, &loaded.title);
    document["command"] = json!("bearing");
    document["seconds"] = json!({ "bearing": seconds });
    document["files"] = json!(files);
    Ok(document.into())
}

fn compute(loaded: &LoadedBearings) -> Result<Vec<rotordyn::results::BearingResult>, rotordyn::error::Error> {
    let study = loaded.studies.bearing.clone().unwrap_or_default();
    match &loaded.model {
        Some(model) => Machine::new(model.clone())?.bearings(&study),
        None => bearings_alone(&loaded.bearings, &study),
    }
}
