//! `validate`: which measured mode is which of the model, and how far apart they are.

use rotordyn::edge::figures::{self, Stage};
use rotordyn::edge::hdf5::Store;
use rotordyn::edge::results_file;
use rotordyn::error::Error;
use rotordyn::update::pairing::{Candidate, pair};
use rotordyn::update::state::State;
use rotordyn::update::target::Target;
use serde_json::{Value, json};

use super::args::ValidateArgs;
use super::failure::Failure;
use super::machine::Origin;
use super::measured::{self, folder, stem};
use super::terminal::{Terminal, number};
use super::{Outcome, films, warn, written};

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
    let found = measured::read(&args.measured, &loaded.model, terminal)?;
    let mut documents = Vec::new();
    let mut states: Vec<State> = Vec::new();
    let mut drawn = Vec::new();
    for (path, read) in args.measured.measured.iter().zip(&found) {
        let state = State::new(loaded.model.clone(), &read.target, None)?;
        let file = path.display();
        terminal.say(&format!("{file}: {}", read.source));
        measured::mode_table(terminal, "Measured and computed modes", &read.target, &state);
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
    let levels = if found.len() > 1 { levels(args, &found, &states, terminal) } else { Value::Null };
    std::fs::create_dir_all(&folder).map_err(|e| Failure::environment("create folder", &folder, e))?;
    let store_path = folder.join("validation.h5");
    let store = Store::create(&store_path)?;
    for ((prefix, frfs), (read, state)) in drawn.iter().zip(found.iter().zip(&states)) {
        let group = format!("/{}", figures::file_name(prefix));
        results_file::validation::write(&store, &group, &read.target, state, frfs.as_deref())?;
    }
    store.flush()?;
    let mut files = vec![store_path];
    if !args.study.no_figures {
        for ((prefix, frfs), (read, state)) in drawn.iter().zip(found.iter().zip(&states)) {
            let stage = Stage { name: "computed", state, frfs: frfs.as_deref() };
            files.extend(draw(prefix, &loaded.model.title, &read.target, &[stage], &folder)?);
        }
    }
    written(terminal, &folder, &files);
    Ok(json!({
        "command": "validate",
        "model": loaded.model.name,
        "measured": documents,
        "levels": levels,
        "files": files,
    })
    .into())
}

fn draw(
    prefix: &str,
    title: &str,
    target: &Target,
    stages: &[Stage],
    folder: &std::path::Path,
) -> Result<Vec<std::path::PathBuf>, Error> {
    figures::draw_validation(prefix, title, target, stages, folder)
}

/// Modes of every file beside those of the first: with blows of different force the shift is what the machine's
/// clearances and contacts make of it.
fn levels(
    args: &ValidateArgs,
    found: &[rotordyn::edge::measured::target::ReadTarget],
    states: &[State],
    terminal: &Terminal,
) -> Value {
    fn candidates(target: &Target) -> Vec<Candidate<'_>> {
        target
            .modes
            .iter()
            .map(|m| Candidate { frequency_hz: m.frequency_hz, shape: m.shape.as_slice() })
            .collect()
    }
    let first = &found[0].target;
    let alike = found.iter().all(|f| f.target.sensors.len() == first.sensors.len());
    if !alike {
        terminal
            .complain("warning", "the files were measured at different points: no shift with level is shown");
        return Value::Null;
    }
    let pairings: Vec<_> =
        found[1..].iter().map(|f| pair(&candidates(first), &candidates(&f.target))).collect();
    let name = |k: usize| match found[k].force {
        Some(force) => format!("{} N", number(force, 3)),
        None => stem(&args.measured.measured[k]),
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
                (found[k + 1].target.modes[c].frequency_hz / mode.frequency_hz - 1.0).abs() < FARTHEST
            };
            match pairing.pairs.iter().find(|p| p.measured == m && near(p.computed)) {
                Some(pair) => {
                    let other = &found[k + 1].target.modes[pair.computed];
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
    json!({ "forces": found.iter().map(|f| f.force).collect::<Vec<_>>(), "modes": documents })
}
