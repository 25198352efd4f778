//! `validate`: correlation of the model with measured modes, FRFs and run-ups (mode pairing, MAC, FRAC).

use std::path::{Path, PathBuf};

use rotordyn::error::Error;
use rotordyn::figures::{self, Stage};
use rotordyn::io::hdf5::Store;
use rotordyn::io::measured::test_data::TestData;
use rotordyn::io::results_file;
use rotordyn::model::Loaded;
use rotordyn::names::file_name;
use rotordyn::update::pairing::{Candidate, pair_modes};
use rotordyn::update::state::ModelState;
use rotordyn::update::target::Target;
use rotordyn::warning::Code;
use serde_json::{Value, json};

use super::args::ValidateArgs;
use super::failure::Failure;
use super::machine::ModelSource;
use super::measured::{self, folder, stem};
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
    ehl_films::prepare_machine_films(&mut loaded.model, &folder, terminal)?;
    let paths = &args.measured.measured;
    let mut structures = Vec::new();
    let mut run_ups = Vec::new();
    for (path, target) in paths.iter().zip(measured::read(&args.measured, &loaded.model, terminal)?) {
        let run_up = run_up_correlation::read(path, args, &loaded.model, terminal)?;
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
    std::fs::create_dir_all(&folder).map_err(|e| Failure::environment("create folder", &folder, e))?;
    let mut document = json!({ "command": "validate", "model": loaded.model.name });
    let mut files = Vec::new();
    if !structures.is_empty() {
        let (structure_documents, shifts, written) =
            compare_structures(args, &structures, &loaded, &folder, terminal)?;
        document["measured"] = structure_documents;
        document["force_level_shifts"] = shifts;
        files = written;
    }
    let mut run_up_documents = Vec::new();
    for (path, run_up) in &run_ups {
        let prefix = match run_ups.len() {
            1 => "run_up".to_string(),
            _ => file_name(&format!("run_up_{}", stem(path))),
        };
        let draw = !args.study.no_figures;
        let (mut one, written) =
            run_up_correlation::compare(run_up, &origin, &prefix, &folder, draw, terminal)?;
        one["file"] = json!(path);
        run_up_documents.push(one);
        files.extend(written);
    }
    if !run_up_documents.is_empty() {
        document["run_ups"] = json!(run_up_documents);
    }
    print_written_files(terminal, &folder, &files);
    document["files"] = json!(files);
    Ok(document.into())
}

/// Error for a file without modes, FRFs or a usable run-up.
fn no_measurement_error(path: &Path, why: &str) -> Error {
    Error::Content {
        path: path.into(),
        problem: format!("it contains neither modes nor FRFs, nor a usable run-up: {why}"),
        advice: "`rotordyn identify` computes FRFs from impact-test records".into(),
    }
}

/// Compares modes and FRFs of every file with the model; returns the JSON, the shifts with force level and
/// the files.
fn compare_structures(
    args: &ValidateArgs,
    found: &[(&Path, TestData)],
    loaded: &Loaded,
    folder: &Path,
    terminal: &Terminal,
) -> Result<(Value, Value, Vec<PathBuf>), Failure> {
    let mut documents = Vec::new();
    let mut states: Vec<ModelState> = Vec::new();
    let mut figures_to_draw = Vec::new();
    for (path, read) in found {
        let state = ModelState::new(loaded.model.clone(), &read.target, None)?;
        terminal.print(&format!("{}: {}", path.display(), read.source));
        measured::mode_table(terminal, "Measured and computed modes", &read.target, &state);
        measured::pair_warnings(terminal, &read.target, &state)?;
        let frfs = read.target.frfs.as_ref().map(|m| state.frfs(m)).transpose()?;
        let frac = frfs.as_ref().map(|c| measured::frac_table(terminal, &read.target, &state, c));
        let mut document = measured::to_json(&read.target, &state);
        document["file"] = json!(path);
        document["source"] = json!(read.source);
        document["frac"] = json!(frac);
        document["force"] = json!(read.peak_force);
        documents.push(document);
        let prefix = match found.len() {
            1 => "validation".to_string(),
            _ => format!("validation_{}", stem(path)),
        };
        figures_to_draw.push((prefix, frfs));
        states.push(state);
    }
    let shifts = if found.len() > 1 { force_level_shifts(found, &states, terminal) } else { Value::Null };
    let store_path = folder.join("validation.h5");
    let store = Store::create(&store_path)?;
    for ((prefix, frfs), ((_, read), state)) in figures_to_draw.iter().zip(found.iter().zip(&states)) {
        let group = format!("/{}", file_name(prefix));
        results_file::validation::write(&store, &group, &read.target, state, frfs.as_deref())?;
    }
    store.flush()?;
    let mut files = vec![store_path];
    if !args.study.no_figures {
        for ((prefix, frfs), ((_, read), state)) in figures_to_draw.iter().zip(found.iter().zip(&states)) {
            let stage = Stage { name: "computed", state, frfs: frfs.as_deref() };
            let title = &loaded.model.title;
            files.extend(figures::draw_validation(prefix, title, &read.target, &[stage], folder)?);
        }
    }
    Ok((json!(documents), shifts, files))
}

/// Frequency shift of every mode relative to the first file: with impact tests at different force levels it
/// shows the nonlinearity of clearances and contacts.
fn force_level_shifts(found: &[(&Path, TestData)], states: &[ModelState], terminal: &Terminal) -> Value {
    fn candidates(target: &Target) -> Vec<Candidate<'_>> {
        target
            .modes
            .iter()
            .map(|m| Candidate { frequency_hz: m.frequency_hz, shape: m.shape.as_slice() })
            .collect()
    }
    let first = &found[0].1.target;
    let same_sensors = found.iter().all(|(_, f)| f.target.sensors.len() == first.sensors.len());
    if !same_sensors {
        terminal.warn_of(
            Code::MeasuredData,
            "the files have different measurement points: no frequency shift is computed",
        );
        return Value::Null;
    }
    let pairings: Vec<_> =
        found[1..].iter().map(|(_, f)| pair_modes(&candidates(first), &candidates(&f.target))).collect();
    let name = |k: usize| match found[k].1.peak_force {
        Some(force) => format!("{} N", number(force, 3)),
        None => stem(found[k].0),
    };
    let mut header = vec!["mode".to_string(), format!("{} Hz", name(0))];
    for k in 1..found.len() {
        header.extend([format!("{} Hz", name(k)), "shift %".into(), "zeta %".into(), "MAC".into()]);
    }
    let mut rows = Vec::new();
    let mut documents = Vec::new();
    for (m, mode) in first.modes.iter().enumerate() {
        let label = states[0].paired_mode(m).map_or("-".to_string(), |p| p.0.label.clone());
        let mut row = vec![label.clone(), format!("{:.3}", mode.frequency_hz)];
        let mut shifts = Vec::new();
        for (k, pairing) in pairings.iter().enumerate() {
            // Largest relative frequency shift of the same mode; beyond it the pair is rejected.
            const MAX_FREQUENCY_SHIFT: f64 = 0.2;
            let near = |c: usize| {
                (found[k + 1].1.target.modes[c].frequency_hz / mode.frequency_hz - 1.0).abs()
                    < MAX_FREQUENCY_SHIFT
            };
            match pairing.pairs.iter().find(|p| p.measured == m && near(p.computed)) {
                Some(pair) => {
                    let other = &found[k + 1].1.target.modes[pair.computed];
                    let shift = other.frequency_hz / mode.frequency_hz - 1.0;
                    let zeta = other.damping_ratio.map_or("-".into(), |z| format!("{:.3}", 100.0 * z));
                    row.extend([
                        format!("{:.3}", other.frequency_hz),
                        format!("{:+.3}", 100.0 * shift),
                        zeta,
                        format!("{:.3}", pair.mac),
                    ]);
                    shifts.push(json!({ "hz": other.frequency_hz, "shift": shift, "mac": pair.mac }));
                }
                None => {
                    row.extend(["-".to_string(), "-".into(), "-".into(), "-".into()]);
                    shifts.push(Value::Null);
                }
            }
        }
        rows.push(row);
        documents.push(json!({ "label": label, "hz": mode.frequency_hz, "shifts": shifts }));
    }
    let header: Vec<&str> = header.iter().map(String::as_str).collect();
    terminal.table("Frequency shift of the measured modes relative to the first file", &header, &rows);
    json!({ "forces": found.iter().map(|(_, f)| f.peak_force).collect::<Vec<_>>(), "modes": documents })
}
