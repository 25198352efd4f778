//! `identify`: modes from measured FRFs, or from the time records of a hammer test.

use std::cell::RefCell;
use std::path::{Path, PathBuf};
use std::time::Instant;

use rotordyn::edge::hdf5::Store;
use rotordyn::edge::measured::mapping::{self, Mapping};
use rotordyn::edge::{exchange, figures, identified, measured};
use rotordyn::error::Error;
use rotordyn::identify::single::{circle_fit, peak_fit};
use rotordyn::identify::{Identified, Settings, identify, quantity_of};
use rotordyn::model::Quantity;
use rotordyn::signal::hammer::{self, HammerTest};
use rotordyn::signal::record::{FrfMatrix, Kind, Measured};
use rotordyn::units::{self, parse};
use serde_json::json;

use super::args::IdentifyArgs;
use super::failure::Failure;
use super::machine::Origin;
use super::store::FILE;
use super::terminal::{Terminal, number};
use super::{Outcome, written};

pub fn run(args: &IdentifyArgs, terminal: &Terminal) -> Result<Outcome, Failure> {
    let settings = settings(args)?;
    let test = HammerTest {
        force: args.force.clone(),
        block: value("--block", args.block.as_ref(), units::TIME)?,
        time_constant: value("--window", args.window.as_ref(), units::TIME)?,
    };
    let start = Instant::now();
    let spinner = terminal.spinner("identify");
    let mut warnings = Vec::new();
    let all = read(args, &test, &mut warnings)?;
    let frfs = all.frf_matrix().map_err(Error::from)?;
    doubts(&frfs, args, &mut warnings);
    let outcome = identify(&frfs, &settings).map_err(Error::from);
    spinner.finish_and_clear();
    let found = match outcome {
        Ok(found) => found,
        Err(error) => {
            warnings.iter().for_each(|warning| terminal.complain("warning", warning));
            return Err(error.into());
        }
    };
    let seconds = start.elapsed().as_secs_f64();
    tables(terminal, &found, &frfs);

    let name = args.files[0].file_stem().unwrap_or_default().to_string_lossy();
    let folder = args.out.clone().unwrap_or_else(|| Path::new("out").join(format!("identify_{name}")));
    let title = if all.title.is_empty() { name.to_string() } else { all.title.clone() };
    let files = write(args, terminal, &found, &frfs, &all, &title, &folder)?;
    written(terminal, &folder, &files);
    for warning in &warnings {
        terminal.complain("warning", warning);
    }
    let mut document = identified::to_json(&found);
    document["command"] = json!("identify");
    document["warnings"] = json!(warnings);
    document["seconds"] = json!({ "identify": seconds });
    document["files"] = json!(files);
    Ok(document.into())
}

fn write(
    args: &IdentifyArgs,
    terminal: &Terminal,
    found: &Identified,
    frfs: &FrfMatrix,
    all: &Measured,
    title: &str,
    folder: &Path,
) -> Result<Vec<PathBuf>, Failure> {
    let path = folder.join(FILE);
    let store = Store::create(&path)?;
    store.set_attribute("/meta", "program", "rotordyn")?;
    store.set_attribute("/meta", "version", env!("CARGO_PKG_VERSION"))?;
    store.set_attribute("/meta", "title", title)?;
    identified::write_hdf5(&store, found)?;
    let shapes = folder.join("modes.uff");
    measured::write(&shapes, &identified::shapes(found, &all.geometry))?;
    let mut files = vec![path, shapes];
    if !args.no_figures {
        let spinner = terminal.spinner("figures");
        files.extend(figures::identified::draw(found, frfs, &all.geometry, title, folder)?);
        spinner.finish_and_clear();
    }
    Ok(files)
}

/// A setting with its unit.
fn value(name: &str, text: Option<&String>, dimension: units::Dimension) -> Result<Option<f64>, Failure> {
    let Some(text) = text else { return Ok(None) };
    match parse(text, dimension) {
        Ok(value) if value > 0.0 => Ok(Some(value)),
        Ok(_) => Err(Failure::Input(format!("{name} \"{text}\" is not positive"))),
        Err(error) => Err(Failure::Input(format!("{name}: {error}"))),
    }
}

fn settings(args: &IdentifyArgs) -> Result<Settings, Failure> {
    let band = match &args.band {
        None => None,
        Some(text) => {
            let ends: Vec<&str> = text.split(',').map(str::trim).collect();
            let [from, to] = ends[..] else {
                return Err(Failure::Input(format!(
                    "--band \"{text}\" has not two ends; write \"10 Hz, 200 Hz\""
                )));
            };
            // "10, 200 Hz" has its unit at the end.
            let unit = to.trim_start_matches(|c: char| c.is_ascii_digit() || ".eE+-".contains(c));
            let from =
                if from.parse::<f64>().is_ok() { format!("{from} {}", unit.trim()) } else { from.into() };
            let hz = |text: &str| {
                parse(text, units::FREQUENCY).map_err(|error| Failure::Input(format!("--band: {error}")))
            };
            let (from, to) = (hz(&from)?, hz(to)?);
            if from >= to {
                return Err(Failure::Input(format!("--band \"{text}\" ends before it begins")));
            }
            Some([from, to])
        }
    };
    let quantity = match args.quantity.as_deref() {
        None => None,
        Some("receptance") => Some(Quantity::Displacement),
        Some("mobility") => Some(Quantity::Velocity),
        Some("accelerance") => Some(Quantity::Acceleration),
        Some(other) => {
            return Err(Failure::Input(format!(
                "--quantity {other}: expected receptance, mobility or accelerance"
            )));
        }
    };
    let window = value("--window", args.window.as_ref(), units::TIME)?;
    Ok(Settings {
        band,
        max_order: args.max_order,
        quantity,
        added_decay: window.map_or(0.0, |tau| 1.0 / tau),
        ..Settings::default()
    })
}

/// Everything in the files, time records turned into FRFs.
fn read(args: &IdentifyArgs, test: &HammerTest, warnings: &mut Vec<String>) -> Result<Measured, Failure> {
    let mapping = args.mapping.as_ref().map(|path| mapping::read(path)).transpose()?;
    let model = match &args.model {
        Some(path) => {
            let args = super::args::ModelArgs { model: path.clone(), variant: None, set: Vec::new() };
            Some(Origin::read(&args)?.load(&[])?.model)
        }
        None => None,
    };
    let names = RefCell::new(Vec::new());
    // Without a model stations are numbered as they come.
    let place = |name: &str| match (&model, name.parse::<i64>()) {
        (Some(model), _) => exchange::point(model, name),
        (None, Ok(number)) => Some(number),
        (None, Err(_)) => {
            let mut names = names.borrow_mut();
            let known = names.iter().position(|n| n == name);
            Some(
                known.unwrap_or_else(|| {
                    names.push(name.to_string());
                    names.len() - 1
                }) as i64
                    + 1,
            )
        }
    };
    let mut all = Measured::default();
    for path in &args.files {
        let mut file = measured::read(path)?;
        warnings.append(&mut file.notes);
        if let (Some(mapping), Some(of)) = (&mapping, &args.mapping) {
            warnings.extend(Mapping::apply(mapping, &mut file, &place, of)?);
        }
        let has_frf = file.records.iter().any(|r| r.kind == Kind::Frf);
        let has_time = file.records.iter().any(|r| r.kind == Kind::Time);
        if !has_frf && has_time {
            let (records, doubts) = hammer::frfs(&file, test)?;
            warnings.extend(doubts);
            file.records = records;
        }
        if all.title.is_empty() {
            all.title = file.title;
        }
        if all.geometry.nodes.is_empty() {
            all.geometry = file.geometry;
        }
        all.records.extend(file.records);
    }
    for (k, name) in names.into_inner().iter().enumerate() {
        warnings.push(format!("point {} is {name}", k + 1));
    }
    Ok(all)
}

fn doubts(frfs: &FrfMatrix, args: &IdentifyArgs, warnings: &mut Vec<String>) {
    if frfs.coherence.is_none() {
        warnings.push(
            "there is no coherence beside the FRFs: where noise spoils them cannot be shown; export it with them"
                .into(),
        );
    }
    let unknown = frfs.units.iter().flatten().filter(|unit| quantity_of(unit).is_none()).count();
    if unknown > 0 && args.quantity.is_none() {
        warnings.push(format!(
            "{unknown} FRFs do not tell their unit and are taken as accelerances; state it in a mapping, or give \
             --quantity"
        ));
    }
    if frfs.responses.len() * frfs.references.len() == 1 {
        warnings.push(
            "there is one FRF only: poles come of it, but no shapes, and close modes may be taken for one; \
             measure at more points"
                .into(),
        );
    }
}

fn tables(terminal: &Terminal, found: &Identified, frfs: &FrfMatrix) {
    let rows: Vec<Vec<String>> = found
        .modes
        .iter()
        .enumerate()
        .map(|(k, m)| {
            let strongest = |values: &[rotordyn::signal::Complex<f64>]| {
                (0..values.len()).fold(0, |b, k| if values[k].norm() > values[b].norm() { k } else { b })
            };
            let whirl = match m.whirl {
                Some(w) if w > 0.1 => format!("forward {w:.2}"),
                Some(w) if w < -0.1 => format!("backward {:.2}", -w),
                Some(_) => "straight".into(),
                None => "-".into(),
            };
            vec![
                (k + 1).to_string(),
                format!("{:.4}", m.frequency_hz()),
                number(m.frequency_error, 2),
                format!("{:.4}", 100.0 * m.damping_ratio()),
                number(100.0 * m.damping_error, 2),
                format!("{:.3}", m.collinearity),
                found.responses[strongest(&m.shape)].to_string(),
                found.references[strongest(&m.participation)].to_string(),
                whirl,
            ]
        })
        .collect();
    let count = found.responses.len() * found.references.len();
    let title = format!(
        "Modes from {count} FRFs, {:.3} to {:.3} Hz, order {}",
        found.frequencies[0],
        found.frequencies[found.frequencies.len() - 1],
        found.orders.last().unwrap_or(&0)
    );
    let header = ["", "Hz", "+-", "zeta %", "+-", "MPC", "response", "reference", "whirl"];
    terminal.table(&title, &header, &rows);
    let worst = found.errors.iter().flatten().copied().fold(0.0, f64::max);
    terminal.say(&format!(
        "  +- is one standard error; MPC is 1 for a real mode. Fit error {:.2} % of all FRFs, {:.2} % of the worst.",
        100.0 * found.total_error,
        100.0 * worst
    ));
    if !found.dropped.is_empty() {
        terminal.say("\n  Stable at first, then dropped:");
        found.dropped.iter().for_each(|reason| terminal.say(&format!("    {reason}")));
    }
    quick_look(terminal, found, frfs);
}

/// Peak and circle fit of the FRF that shows each mode best.
fn quick_look(terminal: &Terminal, found: &Identified, frfs: &FrfMatrix) {
    let rows: Vec<Vec<String>> = found
        .modes
        .iter()
        .enumerate()
        .map(|(k, m)| {
            let mut best = (0, 0);
            for r in 0..m.shape.len() {
                for e in 0..m.participation.len() {
                    let size = |(r, e): (usize, usize)| (m.shape[r] * m.participation[e]).norm();
                    if size((r, e)) > size(best) {
                        best = (r, e);
                    }
                }
            }
            let frf = &frfs.values[best.0][best.1];
            let quantity = quantity_of(&frfs.units[best.0][best.1]).unwrap_or(found.quantity);
            let (hz, zeta) = (m.frequency_hz(), m.damping_ratio());
            let step = found.frequencies[1] - found.frequencies[0];
            let around = |widths: f64| (widths * zeta * hz).max(3.0 * step);
            let band = |half: f64| [hz - half, hz + half];
            let fits = [
                peak_fit(&frfs.frequencies, frf, band(around(4.0))),
                circle_fit(&frfs.frequencies, frf, band(around(1.5)), quantity),
            ];
            let mut row = vec![
                (k + 1).to_string(),
                format!("{}/{}", found.responses[best.0], found.references[best.1]),
                format!("{hz:.3}"),
                format!("{:.3}", 100.0 * zeta),
            ];
            for fit in fits {
                row.push(fit.map_or("-".into(), |f| format!("{:.3}", f.frequency_hz)));
                row.push(fit.map_or("-".into(), |f| format!("{:.3}", 100.0 * f.damping_ratio)));
            }
            row
        })
        .collect();
    let header = ["", "FRF", "Hz", "zeta %", "peak Hz", "zeta %", "circle Hz", "zeta %"];
    terminal.table("Quick look: the FRF that shows each mode best, by peak and circle fit", &header, &rows);
}
