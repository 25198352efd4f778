//! `validate`: which measured mode is which of the model, and how far apart they are.

use std::path::{Path, PathBuf};

use rotordyn::edge::figures::{self, Stage};
use rotordyn::edge::hdf5::Store;
use rotordyn::edge::measured::target::ReadTarget;
use rotordyn::edge::results_file;
use rotordyn::error::Error;
use rotordyn::model::Loaded;
use rotordyn::update::pairing::{Candidate, pair};
use rotordyn::update::state::State;
use rotordyn::update::target::Target;
use serde_json::{Value, json};

use super::args::ValidateArgs;
use super::failure::Failure;
use super::machine::Origin;
use super::measured::{self, folder, stem};
use super::terminal::{Terminal, number};
use super::{Outcome, films, run_up_pair, warn, written};

pub fn run(args: &ValidateArgs, terminal: &Terminal) -> Result<Outcome, Failure> {
    let origin = Origin::read(&args.study.model)?;
    let mut loaded = origin.load(&[])?;
    warn(terminal, &loaded);
    let name = match &origin.options.variant {
        Some(variant) => format!("{}_{variant}", loaded.model.name),
        None => loaded.model.name.clone(),
    };
    let folder = folder(args.study.out.as_ref(), &name, "validation");
    films::of_machine(&mut loaded.model, &folder, terminal)?;
    let paths = &args.measured.measured;
    let mut structures = Vec::new();
    let mut run_ups = Vec::new();
    for (path, target) in paths.iter().zip(measured::read(&args.measured, &loaded.model, terminal)?) {
        let run_up = run_up_pair::read(path, args, &loaded.model, terminal)?;
        match (&target, &run_up) {
            (None, Err(why)) => return Err(nothing(path, why).into()),
            (_, Ok(run_up)) => terminal.say(&format!(
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
        let (told, levels, written) = compare_structures(args, &structures, &loaded, &folder, terminal)?;
        document["measured"] = told;
        document["levels"] = levels;
        files = written;
    }
    let mut told = Vec::new();
    for (path, run_up) in &run_ups {
        let prefix = match run_ups.len() {
            1 => "run_up".to_string(),
            _ => figures::file_name(&format!("run_up_{}", stem(path))),
        };
        let draw = !args.study.no_figures;
        let (mut one, written) = run_up_pair::compare(run_up, &origin, &prefix, &folder, draw, terminal)?;
        one["file"] = json!(path);
        told.push(one);
        files.extend(written);
    }
    if !told.is_empty() {
        document["run_ups"] = json!(told);
    }
    written(terminal, &folder, &files);
    document["files"] = json!(files);
    Ok(document.into())
}

/// That a file holds nothing to hold a model against, and why it is no run-up.
fn nothing(path: &Path, why: &str) -> Error {
    Error::Content {
        path: path.into(),
        problem: format!("it holds neither modes nor FRFs, and no run-up: {why}"),
        advice: "`rotordyn identify` makes FRFs from an impact test".into(),
    }
}

/// Modes and FRFs of every file against the model: what is told to machines, shifts with level, files written.
fn compare_structures(
    args: &ValidateArgs,
    found: &[(&Path, ReadTarget)],
    loaded: &Loaded,
    folder: &Path,
    terminal: &Terminal,
) -> Result<(Value, Value, Vec<PathBuf>), Failure> {
    let mut documents = Vec::new();
    let mut states: Vec<State> = Vec::new();
    let mut drawn = Vec::new();
    for (path, read) in found {
        let state = State::new(loaded.model.clone(), &read.target, None)?;
        terminal.say(&format!("{}: {}", path.display(), read.source));
        measured::mode_table(terminal, "Measured and computed modes", &read.target, &state);
        measured::far_pairs(terminal, &read.target, &state);
        let frfs = read.target.frfs.as_ref().map(|m| state.frfs(m)).transpose()?;
        let frac = frfs.as_ref().map(|c| measured::frac_table(terminal, &read.target, &state, c));
        let mut document = measured::to_json(&read.target, &state);
        document["file"] = json!(path);
        document["source"] = json!(read.source);
        document["frac"] = json!(frac);
        document["force"] = json!(read.force);
        documents.push(document);
        let prefix = match found.len() {
            1 => "validation".to_string(),
            _ => format!("validation_{}", stem(path)),
        };
        drawn.push((prefix, frfs));
        states.push(state);
    }
    let levels = if found.len() > 1 { levels(found, &states, terminal) } else { Value::Null };
    let store_path = folder.join("validation.h5");
    let store = Store::create(&store_path)?;
    for ((prefix, frfs), ((_, read), state)) in drawn.iter().zip(found.iter().zip(&states)) {
        let group = format!("/{}", figures::file_name(prefix));
        results_file::validation::write(&store, &group, &read.target, state, frfs.as_deref())?;
    }
    store.flush()?;
    let mut files = vec![store_path];
    if !args.study.no_figures {
        for ((prefix, frfs), ((_, read), state)) in drawn.iter().zip(found.iter().zip(&states)) {
            let stage = Stage { name: "computed", state, frfs: frfs.as_deref() };
            let title = &loaded.model.title;
            files.extend(figures::draw_validation(prefix, title, &read.target, &[stage], folder)?);
        }
    }
    Ok((json!(documents), levels, files))
}

/// Modes of every file beside those of the first: with hits of different force the shift is what the machine's
/// clearances and contacts make of it.
fn levels(found: &[(&Path, ReadTarget)], states: &[State], terminal: &Terminal) -> Value {
    fn candidates(target: &Target) -> Vec<Candidate<'_>> {
        target
            .modes
            .iter()
            .map(|m| Candidate { frequency_hz: m.frequency_hz, shape: m.shape.as_slice() })
            .collect()
    }
    let first = &found[0].1.target;
    let alike = found.iter().all(|(_, f)| f.target.sensors.len() == first.sensors.len());
    if !alike {
        terminal
            .complain("warning", "the files were measured at different points: no shift with level is shown");
        return Value::Null;
    }
    let pairings: Vec<_> =
        found[1..].iter().map(|(_, f)| pair(&candidates(first), &candidates(&f.target))).collect();
    let name = |k: usize| match found[k].1.force {
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
        let label = states[0].partner(m).map_or("-".to_string(), |p| p.0.label.clone());
        let mut row = vec![label.clone(), format!("{:.3}", mode.frequency_hz)];
        let mut others = Vec::new();
        for (k, pairing) in pairings.iter().enumerate() {
            // A mode that has moved further than this is another one.
            const FARTHEST: f64 = 0.2;
            let near = |c: usize| {
                (found[k + 1].1.target.modes[c].frequency_hz / mode.frequency_hz - 1.0).abs() < FARTHEST
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
                    others.push(json!({ "hz": other.frequency_hz, "shift": shift, "mac": pair.mac }));
                }
                None => {
                    row.extend(["-".to_string(), "-".into(), "-".into(), "-".into()]);
                    others.push(Value::Null);
                }
            }
        }
        rows.push(row);
        documents.push(json!({ "label": label, "hz": mode.frequency_hz, "others": others }));
    }
    let header: Vec<&str> = header.iter().map(String::as_str).collect();
    terminal.table("Shift of the measured modes from the first file", &header, &rows);
    json!({ "forces": found.iter().map(|(_, f)| f.force).collect::<Vec<_>>(), "modes": documents })
}
