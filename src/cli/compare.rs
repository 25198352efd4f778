//! `compare`: natural frequencies and FRFs of the variants of one machine.

use rotordyn::analysis::Mode;
use rotordyn::figures;
use rotordyn::results::{ModalResult, Results};
use rotordyn::study::Machine;
use serde_json::{Value, json};

use super::args::StudyArgs;
use super::failure::Failure;
use super::machine::ModelSource;
use super::studies::Study;
use super::terminal::{Terminal, rpm};
use super::{Outcome, ehl_films, print_model_warnings, print_written_files, settings};

/// A variant with its modes and FRFs.
struct Variant {
    name: String,
    machine: Machine,
    results: Results,
}

pub fn run(
    args: &StudyArgs,
    names: &[String],
    speed: Option<&String>,
    modes: Option<usize>,
    min_mac: f64,
    terminal: &Terminal,
) -> Result<Outcome, Failure> {
    if !(0.0..=1.0).contains(&min_mac) {
        return Err(Failure::Input(format!("--min-mac {min_mac} is not between 0 and 1")));
    }
    let origin = ModelSource::read(&args.model)?;
    let names: Vec<String> = match names {
        [] => std::iter::once("base".to_string()).chain(origin.variants()).collect(),
        names => names.to_vec(),
    };
    if names.len() < 2 {
        return Err(Failure::Input(
            "compare needs at least two variants, such as --variants base,NAME".into(),
        ));
    }
    let mut variants = Vec::new();
    for name in &names {
        let origin = origin.with_variant(name);
        let base = origin.load(&[])?;
        let mut loaded = origin.load_with(&settings::modal(&base.model, speed, modes))?;
        let folder = origin.results_folder(None, &loaded.model.name);
        ehl_films::prepare_machine_films(&mut loaded.model, &folder, terminal)?;
        let machine = Machine::new(loaded.model.clone())?;
        for study in [Study::Modal, Study::Campbell, Study::Frf] {
            for warning in machine.check_tables(study.name(), &study.speeds(&machine.model))? {
                terminal.warn(&warning.prefixed(name));
            }
        }
        let studies = &machine.model.studies;
        let results = Results {
            modal: studies.modal.as_ref().map(|s| machine.modal(s)).transpose()?.unwrap_or_default(),
            campbell: studies.campbell.as_ref().map(|s| machine.campbell(s)).transpose()?,
            frf: studies.frf.as_ref().map(|s| machine.frf(s)).transpose()?,
            ..Results::default()
        };
        print_model_warnings(terminal, &loaded);
        variants.push(Variant { name: name.clone(), machine, results });
    }
    let speeds = variants[0].results.modal.len();
    let mut tables = Vec::new();
    for k in 0..speeds {
        tables.push(table(terminal, &variants, k, min_mac));
    }
    let model_name = &variants[0].machine.model.name;
    let folder = args.out.clone().unwrap_or_else(|| format!("out/{model_name}_comparison").into());
    let mut files = Vec::new();
    if !args.no_figures {
        let drawn: Vec<(String, &Results)> = variants.iter().map(|v| (v.name.clone(), &v.results)).collect();
        files = figures::draw_comparison(&drawn, &folder)?;
        print_written_files(terminal, &folder, &files);
    }
    Ok(json!({
        "command": "compare",
        "model": model_name,
        "variants": names,
        "min_pair_mac": min_mac,
        "speeds": tables,
        "files": files,
    })
    .into())
}

/// Table row of one mode: the paired modes of all variants.
struct Row<'a> {
    modes: Vec<Option<&'a Mode>>,
    /// Smallest MAC with the reference mode of the row (its first entry); `None` without a pair.
    mac: Option<f64>,
    /// Variants in which the reference mode has no pair.
    unpaired: Vec<Unpaired<'a>>,
}

/// A variant without a pair for a mode.
struct Unpaired<'a> {
    variant: usize,
    /// The mode of that variant with the largest MAC, and that MAC; `None` without modes.
    nearest: Option<(&'a Mode, f64)>,
}

impl Unpaired<'_> {
    fn describe(&self, variants: &[Variant]) -> String {
        let name = &variants[self.variant].name;
        match self.nearest {
            Some((mode, mac)) => {
                format!("{name}: no pair, best MAC {mac:.2} at {:.3} Hz", mode.frequency_hz())
            }
            None => format!("{name}: no modes"),
        }
    }
}

/// Prints the frequencies at the k-th speed and returns them as JSON.
fn table(terminal: &Terminal, variants: &[Variant], k: usize, min_mac: f64) -> Value {
    let found: Vec<Option<&ModalResult>> = variants.iter().map(|v| v.results.modal.get(k)).collect();
    let speed = found[0].map_or(0.0, |at| rpm(at.speed));
    let rows = pair(variants, &found, min_mac);
    let label = |row: &Row| row.modes.iter().flatten().next().map_or(String::new(), |m| m.label.clone());
    let mut header = vec!["mode"];
    let titles: Vec<String> = variants.iter().map(|v| format!("{} Hz", v.name)).collect();
    header.extend(titles.iter().map(String::as_str));
    header.push("min MAC");
    let any_unpaired = rows.iter().any(|row| !row.unpaired.is_empty());
    if any_unpaired {
        header.push("without a pair");
    }
    let text: Vec<Vec<String>> = rows
        .iter()
        .map(|row| {
            let hz = |m: &Option<&Mode>| m.map_or("-".into(), |m| format!("{:.3}", m.frequency_hz()));
            let mut line = vec![label(row)];
            line.extend(row.modes.iter().map(hz));
            line.push(row.mac.map_or("-".into(), |mac| format!("{mac:.3}")));
            if any_unpaired {
                let notes: Vec<String> = row.unpaired.iter().map(|u| u.describe(variants)).collect();
                line.push(notes.join("; "));
            }
            line
        })
        .collect();
    terminal.table(&format!("Natural frequencies at {speed:.0} rpm"), &header, &text);
    if any_unpaired {
        terminal.print(&format!("  modes are paired from a MAC of {min_mac} on (--min-mac)"));
    }
    let rows: Vec<Value> = rows
        .iter()
        .map(|row| {
            let of = |value: fn(&Mode) -> f64| -> Vec<Option<f64>> {
                row.modes.iter().map(|m| m.map(value)).collect()
            };
            let unpaired = |u: &Unpaired| {
                json!({
                    "variant": variants[u.variant].name,
                    "best_mac": u.nearest.map(|(_, mac)| mac),
                    "best_label": u.nearest.map(|(mode, _)| mode.label.clone()),
                    "best_frequency_hz": u.nearest.map(|(mode, _)| mode.frequency_hz()),
                })
            };
            json!({
                "label": label(row),
                "frequency_hz": of(Mode::frequency_hz),
                "zeta": of(Mode::zeta),
                "labels": row.modes.iter().map(|m| m.map(|m| m.label.clone())).collect::<Vec<_>>(),
                "min_mac": row.mac,
                "unpaired": row.unpaired.iter().map(unpaired).collect::<Vec<_>>(),
            })
        })
        .collect();
    json!({ "rpm": speed, "modes": rows })
}

/// Pairs the modes of every variant with the existing rows, greedily by decreasing MAC down to `min_mac`.
fn pair<'a>(variants: &'a [Variant], found: &[Option<&'a ModalResult>], min_mac: f64) -> Vec<Row<'a>> {
    let mut rows: Vec<Row> = Vec::new();
    for (v, at) in found.iter().enumerate() {
        let modes = at.map(|at| at.modes.as_slice()).unwrap_or_default();
        let mut pairs: Vec<(f64, usize, usize)> = Vec::new();
        for (r, row) in rows.iter().enumerate() {
            let Some((reference_variant, mode)) =
                row.modes.iter().enumerate().find_map(|(v, m)| Some((v, (*m)?)))
            else {
                continue;
            };
            let mac_with = |m: &Mode| mac(&variants[reference_variant].machine, mode, m);
            pairs.extend(modes.iter().enumerate().map(|(m, other)| (mac_with(other), r, m)));
        }
        pairs.sort_by(|a, b| b.0.total_cmp(&a.0).then((a.1, a.2).cmp(&(b.1, b.2))));
        rows.iter_mut().for_each(|row| row.modes.push(None));
        let mut taken = vec![false; modes.len()];
        for (mac, r, m) in pairs.into_iter().filter(|pair| pair.0 >= min_mac) {
            if rows[r].modes[v].is_none() && !taken[m] {
                rows[r].modes[v] = Some(&modes[m]);
                rows[r].mac = Some(rows[r].mac.map_or(mac, |least| least.min(mac)));
                taken[m] = true;
            }
        }
        for (m, _) in taken.iter().enumerate().filter(|(_, taken)| !**taken) {
            let mut modes_of_row = vec![None; v];
            modes_of_row.push(Some(&modes[m]));
            rows.push(Row { modes: modes_of_row, mac: None, unpaired: Vec::new() });
        }
    }
    for row in &mut rows {
        let reference = row.modes.iter().enumerate().find_map(|(v, mode)| Some((v, (*mode)?)));
        let Some((reference_variant, mode)) = reference else { continue };
        let missing = (0..found.len()).filter(|&v| row.modes[v].is_none());
        row.unpaired = missing
            .map(|v| {
                let others = found[v].map(|at| at.modes.as_slice()).unwrap_or_default();
                let with_mac = others.iter().map(|m| (m, mac(&variants[reference_variant].machine, mode, m)));
                Unpaired { variant: v, nearest: with_mac.max_by(|a, b| a.1.total_cmp(&b.1)) }
            })
            .collect();
    }
    let lowest =
        |row: &Row| row.modes.iter().flatten().map(|m| m.frequency_hz()).fold(f64::INFINITY, f64::min);
    rows.sort_by(|a, b| lowest(a).total_cmp(&lowest(b)));
    rows
}

/// Mass-weighted MAC |aᴴ M b|² / (aᴴ M a · bᴴ M b) over the shaft DOFs common to the variants; 0 if shafts
/// differ.
fn mac(machine: &Machine, a: &Mode, b: &Mode) -> f64 {
    let shaft = 6 * machine.assembly.dofs.shaft_nodes;
    let full = machine.assembly.dofs.full_len();
    if b.full_shape.len() < shaft || b.whirl.len() != a.whirl.len() {
        return 0.0;
    }
    let on_shaft = |mode: &Mode| {
        let mut shape = mode.full_shape.clone();
        shape.resize(full, Default::default());
        shape[shaft..].fill(Default::default());
        shape
    };
    let (a, b) = (on_shaft(a), on_shaft(b));
    let mass = &machine.assembly.full_mass;
    let (ma, mb) = (mass.mul_complex(&a), mass.mul_complex(&b));
    let product = |x: &[rotordyn::linalg::Complex64], y: &[rotordyn::linalg::Complex64]| {
        x.iter().zip(y).map(|(x, y)| x.conj() * y).sum::<rotordyn::linalg::Complex64>()
    };
    let size = product(&a, &ma).re * product(&b, &mb).re;
    if size > 0.0 { product(&a, &mb).norm_sqr() / size } else { 0.0 }
}
