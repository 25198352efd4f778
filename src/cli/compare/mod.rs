//! `compare`: natural frequencies and FRFs of the variants of one machine.

use rotordyn::figures;
use rotordyn::io::json;
use rotordyn::results::{PairedMode, PairedModes, Results, UnpairedVariant, VariantComparison};
use rotordyn::study::{self, Machine, compare_variants};
use serde_json::json;

use super::args::StudyArgs;
use super::csv_files::write_csv;
use super::failure::Failure;
use super::folder_lock::FolderLock;
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
        return Err(Failure::Input(too_few(&origin)));
    }
    let mut variants = Vec::new();
    for name in &names {
        let origin = origin.with_variant(name);
        let base = origin.load(&[])?;
        let mut loaded = origin.load_with(&settings::modal(&base.model, speed, modes))?;
        let folder = origin.results_folder(None, &loaded.model.name);
        ehl_films::prepare_machine_films(&mut loaded.model, &folder, terminal)?;
        let machine = Machine::new(loaded.model.clone())?;
        let studies = &machine.model.studies;
        let results = Results {
            modal: studies.modal.as_ref().map(|s| machine.modal(s)).transpose()?.unwrap_or_default(),
            campbell: studies.campbell.as_ref().map(|s| machine.campbell(s)).transpose()?,
            frf: studies.frf.as_ref().map(|s| machine.frf(s)).transpose()?,
            ..Results::default()
        };
        let compared = [Study::Modal, Study::Campbell, Study::Frf];
        let speeds: Vec<f64> = compared.iter().flat_map(|study| study.speeds(&machine.model)).collect();
        for warning in machine.warnings(&results, &speeds) {
            terminal.warn(&warning.prefixed(name));
        }
        print_model_warnings(terminal, &loaded);
        variants.push(Variant { name: name.clone(), machine, results });
    }
    let compared: Vec<study::Variant> = variants
        .iter()
        .map(|v| study::Variant { name: &v.name, machine: &v.machine, modal: &v.results.modal })
        .collect();
    let found = compare_variants(&compared, min_mac);
    found.speeds.iter().for_each(|at| table(terminal, &found, at));
    let model_name = &variants[0].machine.model.name;
    let folder = args.out.clone().unwrap_or_else(|| format!("out/{model_name}_comparison").into());
    let section = found.section();
    let writes = args.csv || !args.no_figures;
    let _lock = writes.then(|| FolderLock::take(&folder, terminal)).transpose()?;
    let mut files = Vec::new();
    if args.csv {
        files.extend(write_csv(&folder, std::slice::from_ref(&section))?);
    }
    if !args.no_figures {
        let drawn: Vec<(String, &Results)> = variants.iter().map(|v| (v.name.clone(), &v.results)).collect();
        files.extend(figures::draw_comparison(&drawn, &folder)?);
    }
    if !files.is_empty() {
        print_written_files(terminal, &folder, &files);
    }
    let mut document = json::document(&section.content);
    document["command"] = json!("compare");
    document["model"] = json!(model_name);
    document["files"] = json!(files);
    Ok(document.into())
}

/// What to do with a single variant.
fn too_few(origin: &ModelSource) -> String {
    let known = origin.variants();
    let file = &origin.name;
    if known.is_empty() {
        return format!(
            "{file} has no variants to compare; add one with the values that differ, for example\n\n[variant.loose]\n\
             bearing.A.clearance = \"C4\"\n\nor compute another value of the file: rotordyn modal {file} --set \
             bearing.A.clearance=C4"
        );
    }
    format!(
        "compare needs two variants or more, such as --variants base,{}; the file has: {}",
        known[0],
        known.join(", ")
    )
}

/// Prints the frequencies at one speed.
fn table(terminal: &Terminal, found: &VariantComparison, at: &PairedModes) {
    let mut header = vec!["mode"];
    let titles: Vec<String> = found.variants.iter().map(|name| format!("{name} Hz")).collect();
    header.extend(titles.iter().map(String::as_str));
    header.push("min MAC");
    let any_unpaired = at.modes.iter().any(|row| !row.unpaired.is_empty());
    if any_unpaired {
        header.push("without a pair");
    }
    let line = |row: &PairedMode| {
        let mut line = vec![row.label().to_string()];
        line.extend(
            row.modes.iter().map(|m| m.as_ref().map_or("-".into(), |m| format!("{:.3}", m.frequency_hz))),
        );
        line.push(row.mac.map_or("-".into(), |mac| format!("{mac:.3}")));
        if any_unpaired {
            line.push(row.unpaired.iter().map(describe).collect::<Vec<_>>().join("; "));
        }
        line
    };
    let rows: Vec<Vec<String>> = at.modes.iter().map(line).collect();
    terminal.table(&format!("Natural frequencies at {:.0} rpm", rpm(at.speed)), &header, &rows);
    if any_unpaired {
        terminal.print(&format!("  modes are paired from a MAC of {} on (--min-mac)", found.min_mac));
    }
}

fn describe(unpaired: &UnpairedVariant) -> String {
    let name = &unpaired.variant;
    match &unpaired.nearest {
        Some((mode, mac)) => format!("{name}: no pair, best MAC {mac:.2} at {:.3} Hz", mode.frequency_hz),
        None => format!("{name}: no modes"),
    }
}
