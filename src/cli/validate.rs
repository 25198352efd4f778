//! `validate`: correlation of the model with measured modes, FRFs and run-ups (mode pairing, MAC, FRAC).

use std::path::{Path, PathBuf};

use rotordyn::document::{Document, Section, in_json};
use rotordyn::error::Error;
use rotordyn::figures::{self, Stage};
use rotordyn::io::hdf5::Store;
use rotordyn::io::measured::test_data::TestData;
use rotordyn::io::{json, results_file};
use rotordyn::model::Loaded;
use rotordyn::names::file_name;
use rotordyn::update::correlation::Correlation;
use rotordyn::update::force_levels::{ForceLevelShifts, ShiftedMode};
use rotordyn::update::state::ModelState;
use rotordyn::warning::Code;
use serde_json::{Map, Value, json};

use super::args::ValidateArgs;
use super::csv_files::write_csv;
use super::failure::Failure;
use super::folder_lock::FolderLock;
use super::machine::ModelSource;
use super::measured::{self, folder, stem};
use super::run_up_correlation::RunUpReading;
use super::terminal::{Terminal, number};
use super::{Outcome, ehl_films, print_model_warnings, print_written_files, run_up_correlation};

pub fn run(args: &ValidateArgs, terminal: &Terminal) -> Result<Outcome, Failure> {
    let origin = ModelSource::read(&args.study.model)?;
    let mut loaded = origin.load(&[])?;
    print_model_warnings(terminal, &loaded);
    let name = match &origin.options.variant {
        Some(variant) => format!("{}_{variant}", loaded.model.name),
        None => loaded.model.name.clone(),
    };
    let folder = folder(args.study.out.as_ref(), &name, "validation");
    let _lock = FolderLock::take(&folder, terminal)?;
    ehl_films::prepare_machine_films(&mut loaded.model, &folder, terminal)?;
    let paths = &args.measured.measured;
    let mut structures = Vec::new();
    let mut run_ups = Vec::new();
    for (path, target) in paths.iter().zip(measured::read(&args.measured, &loaded.model, terminal)?) {
        let reading = RunUpReading {
            mapping: args.measured.mapping.as_deref(),
            time: args.time.as_deref(),
            shaft: &args.shaft,
        };
        let run_up = run_up_correlation::read(path, &reading, &loaded.model, terminal)?;
        match (&target, &run_up) {
            (None, Err(why)) => return Err(no_measurement_error(path, why).into()),
            (_, Ok(run_up)) => terminal.print(&format!(
                "{}: a run-up from {:.0} to {:.0} rpm in {} s, speed by {}",
                path.display(),
                run_up.rpm[0],
                run_up.rpm[1],
                number(run_up.run.profile.duration(), 4),
                run_up.source
            )),
            _ => {}
        }
        structures.extend(target.map(|target| (path.as_path(), target)));
        run_ups.extend(run_up.ok().map(|run_up| (path.as_path(), run_up)));
    }
    let mut document = Map::new();
    let mut files = Vec::new();
    if !structures.is_empty() {
        files = compare_structures(args, &structures, &loaded, &folder, &mut document, terminal)?;
    }
    let mut compared = Vec::new();
    for (path, run_up) in &run_ups {
        let prefix = match run_ups.len() {
            1 => "run_up".to_string(),
            _ => file_name(&format!("run_up_{}", stem(path))),
        };
        let draw = !args.study.no_figures;
        let (one, written) = run_up_correlation::compare(run_up, &origin, &prefix, &folder, draw, terminal)?;
        compared.push((path.display().to_string(), one));
        files.extend(written);
    }
    let sections: Vec<Section> =
        compared.iter().map(|(path, one)| run_up_correlation::section(path, one.as_ref())).collect();
    json::add_sections(&mut document, &sections);
    if args.study.csv {
        files.extend(write_csv(&folder, &sections)?);
    }
    print_written_files(terminal, &folder, &files);
    document.insert("command".into(), json!("validate"));
    document.insert("model".into(), json!(loaded.model.name));
    document.insert("files".into(), json!(files));
    Ok(Value::Object(document).into())
}

/// Error for a file without modes, FRFs or a usable run-up.
fn no_measurement_error(path: &Path, why: &str) -> Error {
    Error::Content {
        path: path.into(),
        problem: format!("it contains neither modes nor FRFs, nor a usable run-up: {why}"),
        advice: "`rotordyn identify` computes FRFs from impact-test records".into(),
    }
}

/// Compares modes and FRFs of every file with the model, adds them to the JSON document; returns the files.
fn compare_structures(
    args: &ValidateArgs,
    found: &[(&Path, TestData)],
    loaded: &Loaded,
    folder: &Path,
    document: &mut Map<String, Value>,
    terminal: &Terminal,
) -> Result<Vec<PathBuf>, Failure> {
    let states: Vec<ModelState> = found
        .iter()
        .map(|(_, read)| ModelState::new(loaded.model.clone(), &read.target, None))
        .collect::<Result<_, _>>()?;
    let mut sections = Vec::new();
    let mut drawn = Vec::new();
    for ((path, read), state) in found.iter().zip(&states) {
        terminal.print(&format!("{}: {}", path.display(), read.source));
        measured::mode_table(terminal, "Measured and computed modes", &read.target, state);
        measured::pair_warnings(terminal, &read.target, state)?;
        let correlation = Correlation::new(&read.target, state)?;
        measured::standstill_warning(terminal, &correlation);
        measured::compare_frfs(terminal, &correlation);
        let prefix = match found.len() {
            1 => "validation".to_string(),
            _ => format!("validation_{}", stem(path)),
        };
        let content = Document::new()
            .text(in_json("file"), path.display().to_string())
            .text("source", &read.source)
            .optional("force", "N", read.peak_force)
            .and(correlation.document());
        sections.push(Section::listed("measured", file_name(&prefix), content));
        drawn.push((prefix, correlation));
    }
    let shifts = force_level_shifts(found, &states[0], terminal);
    match &shifts {
        Some(shifts) => sections.push(shifts.section()),
        None => _ = document.insert("force_level_shifts".into(), Value::Null),
    }
    let path = folder.join("validation.h5");
    let store = Store::replace(&path)?;
    sections.iter().try_for_each(|section| results_file::write_section(&store, "", section))?;
    store.commit()?;
    let mut files = vec![path];
    json::add_sections(document, &sections);
    if args.study.csv {
        files.extend(write_csv(folder, &sections)?);
    }
    if !args.study.no_figures {
        for (prefix, correlation) in &drawn {
            let stage =
                Stage { name: "computed", state: correlation.state, frfs: correlation.frfs.as_deref() };
            let title = &loaded.model.title;
            files.extend(figures::draw_validation(prefix, title, correlation.target, &[stage], folder)?);
        }
    }
    Ok(files)
}

/// Frequency shift of every mode relative to the first file: with impact tests at different force levels it
/// shows the nonlinearity of clearances and contacts.
fn force_level_shifts(
    found: &[(&Path, TestData)],
    first: &ModelState,
    terminal: &Terminal,
) -> Option<ForceLevelShifts> {
    if found.len() < 2 {
        return None;
    }
    let measured: Vec<_> = found.iter().map(|(_, read)| (&read.target, read.peak_force)).collect();
    let Some(shifts) = ForceLevelShifts::new(&measured, first) else {
        terminal.warn_of(
            Code::MeasuredData,
            "the files have different measurement points: no frequency shift is computed",
        );
        return None;
    };
    let name = |k: usize| match found[k].1.peak_force {
        Some(force) => format!("{} N", number(force, 3)),
        None => stem(found[k].0),
    };
    let mut header = vec!["mode".to_string(), format!("{} Hz", name(0))];
    for k in 1..found.len() {
        header.extend([format!("{} Hz", name(k)), "shift %".into(), "zeta %".into(), "MAC".into()]);
    }
    let row = |mode: &ShiftedMode| {
        let label = mode.label.clone().unwrap_or_else(|| "-".into());
        let mut row = vec![label, format!("{:.3}", mode.frequency_hz)];
        for shift in &mode.shifts {
            row.extend(match shift {
                Some(shift) => [
                    format!("{:.3}", shift.frequency_hz),
                    format!("{:+.3}", 100.0 * shift.shift),
                    shift.damping_ratio.map_or("-".into(), |z| format!("{:.3}", 100.0 * z)),
                    format!("{:.3}", shift.mac),
                ],
                None => ["-"; 4].map(String::from),
            });
        }
        row
    };
    let rows: Vec<Vec<String>> = shifts.modes.iter().map(row).collect();
    let header: Vec<&str> = header.iter().map(String::as_str).collect();
    terminal.table("Frequency shift of the measured modes relative to the first file", &header, &rows);
    Some(shifts)
}
