//! Linear studies of the cases: modes, FRFs, unbalance responses, Campbell diagrams.

use rotordyn::document::{Document, Section};
use rotordyn::figures::{self, LinearComparison};
use rotordyn::io::json;
use rotordyn::model::Loaded;
use rotordyn::results::{
    CampbellResult, FrfComparison, Results, UnbalanceComparison, UnbalanceResult, VariantComparison,
};
use rotordyn::study::{self, FrfCase, Machine, compare_frfs, compare_unbalance, compare_variants};
use rotordyn::warning::Code;
use serde_json::json;
use std::path::Path;

use super::super::args::CompareArgs;
use super::super::csv_files::write_csv;
use super::super::failure::Failure;
use super::super::folder_lock::FolderLock;
use super::super::settings::Settings;
use super::super::studies::Study;
use super::super::terminal::{Terminal, rpm};
use super::super::{Outcome, ehl_films, print_model_warnings, print_written_files, settings};
use super::cases::Case;
use super::output::{folder, note_left_out};
use super::{frf_places, tables};

/// Relative tolerance of the speed of measured and computed FRFs \[rad/s\].
const SAME_SPEED: f64 = 0.1;

/// A case with its results.
struct Computed {
    name: String,
    machine: Machine,
    results: Results,
}

pub fn run(args: &CompareArgs, cases: &[Case], terminal: &Terminal) -> Result<Outcome, Failure> {
    let loaded = cases.iter().map(|case| load(args, case)).collect::<Result<Vec<_>, _>>()?;
    // Before the studies: a file that cannot be read is told at once.
    let models: Vec<_> = loaded.iter().map(|case| &case.model).collect();
    let measured = args.measured.as_ref().map(|path| frf_places::read(path, args, &models, terminal));
    let (measured, measured_speed) = measured.transpose()?.unwrap_or_default();
    let mut computed = Vec::new();
    for (case, loaded) in cases.iter().zip(loaded) {
        computed.push(compute(case, loaded, terminal)?);
    }
    let first = &computed[0];
    let modal: Vec<study::Variant> = computed
        .iter()
        .map(|v| study::Variant { name: &v.name, machine: &v.machine, modal: &v.results.modal })
        .collect();
    let modes = (computed.len() > 1).then(|| compare_variants(&modal, args.min_mac));
    if let (Some(path), Some(speed)) = (&args.measured, measured_speed) {
        warn_of_another_speed(path, speed, first, terminal);
    }
    let with_frfs: Vec<FrfCase> = computed
        .iter()
        .filter_map(|v| Some(FrfCase { name: &v.name, machine: &v.machine, found: v.results.frf.as_ref()? }))
        .collect();
    let frfs = (!with_frfs.is_empty()).then(|| compare_frfs(&with_frfs, &measured)).transpose()?;
    let with_unbalance: Vec<(&str, &UnbalanceResult)> =
        computed.iter().filter_map(|v| Some((v.name.as_str(), v.results.unbalance.as_ref()?))).collect();
    let unbalance = (with_unbalance.len() > 1).then(|| compare_unbalance(&with_unbalance));
    refuse_nothing_in_common(&computed, frfs.as_ref(), unbalance.as_ref())?;
    if let Some(found) = &modes {
        found.speeds.iter().for_each(|at| tables::modes(terminal, found, at));
    }
    if let Some(found) = &frfs {
        tables::frfs(terminal, found);
        note_left_out(&found.left_out, terminal);
    }
    if let Some(found) = &unbalance {
        tables::unbalance(terminal, found);
        note_left_out(&found.left_out, terminal);
    }
    let model = &first.machine.model;
    let folder = folder(args, &model.name);
    let section = section(modes.as_ref(), frfs.as_ref(), unbalance.as_ref());
    let writes = args.study.csv || !args.study.no_figures;
    let _lock = writes.then(|| FolderLock::take(&folder, terminal)).transpose()?;
    let mut files = Vec::new();
    if args.study.csv {
        files.extend(write_csv(&folder, std::slice::from_ref(&section))?);
    }
    if !args.study.no_figures {
        let campbell: Vec<(&str, &CampbellResult)> =
            computed.iter().filter_map(|v| Some((v.name.as_str(), v.results.campbell.as_ref()?))).collect();
        let (frfs, unbalance) = (frfs.as_ref(), unbalance.as_ref());
        // Variants may have titles of their own.
        let same = computed.iter().all(|v| v.machine.model.title == model.title);
        let note = if same { &model.title } else { &model.name };
        let drawn = LinearComparison { note, frfs, unbalance, campbell: &campbell };
        files.extend(figures::draw_comparison(drawn, &folder)?);
    }
    if !files.is_empty() {
        print_written_files(terminal, &folder, &files);
    }
    let mut document = json::document(&section.content);
    document["command"] = json!("compare");
    document["model"] = json!(model.name);
    document["cases"] = json!(computed.iter().map(|v| &v.name).collect::<Vec<_>>());
    document["files"] = json!(files);
    Ok(document.into())
}

/// Warns of FRFs measured at another speed \[rad/s\] than that of the study.
fn warn_of_another_speed(path: &Path, measured: f64, computed: &Computed, terminal: &Terminal) {
    let own = computed.results.frf.as_ref().map_or(0.0, |found| found.speed);
    if (measured - own).abs() > SAME_SPEED {
        let (file, measured, own) = (path.display(), rpm(measured), rpm(own));
        terminal.warn_of(
            Code::MeasuredData,
            format!(
                "{file}: measured at {measured:.0} rpm, computed at {own:.0} rpm: --set study.frf.speed=\"{measured:.0} rpm\""
            ),
        );
    }
}

/// The model of one case with the studies that are compared.
fn load(args: &CompareArgs, case: &Case) -> Result<Loaded, Failure> {
    let base = case.origin.load_with(&case.settings)?;
    let mut own = case.settings.clone();
    let mut add = |more: Settings| {
        own.set.extend(more.set);
        own.flags.extend(more.flags);
    };
    add(settings::modal(&base.model, args.speed.as_ref(), args.modes));
    if args.measured.is_some() {
        add(settings::frf(&base.model, None, None, None));
    }
    case.origin.load_with(&own)
}

/// The studies of one case.
fn compute(case: &Case, mut loaded: Loaded, terminal: &Terminal) -> Result<Computed, Failure> {
    let folder = case.origin.results_folder(None, &loaded.model.name);
    ehl_films::prepare_machine_films(&mut loaded.model, &folder, terminal)?;
    let machine = Machine::new(loaded.model.clone())?;
    let studies = &machine.model.studies;
    let spinner = terminal.spinner(&case.name);
    let results = Results {
        modal: studies.modal.as_ref().map(|s| machine.modal(s)).transpose()?.unwrap_or_default(),
        campbell: studies.campbell.as_ref().map(|s| machine.campbell(s)).transpose()?,
        frf: studies.frf.as_ref().map(|s| machine.frf(s)).transpose()?,
        unbalance: studies.unbalance.as_ref().map(|s| machine.unbalance(s)).transpose()?,
        ..Results::default()
    };
    spinner.finish_and_clear();
    let compared = [Study::Modal, Study::Campbell, Study::Frf, Study::Unbalance];
    let speeds: Vec<f64> = compared.iter().flat_map(|study| study.speeds(&machine.model)).collect();
    for warning in machine.warnings(&results, &speeds) {
        terminal.warn(&warning.prefixed(&case.name));
    }
    print_model_warnings(terminal, &loaded);
    Ok(Computed { name: case.name.clone(), machine, results })
}

/// Refuses cases that have FRFs or unbalance responses, but none in common.
fn refuse_nothing_in_common(
    computed: &[Computed],
    frfs: Option<&FrfComparison>,
    unbalance: Option<&UnbalanceComparison>,
) -> Result<(), Failure> {
    let is_empty = frfs.is_some_and(|found| found.pairs.is_empty());
    let compared = frfs.is_some_and(|found| !found.pairs.is_empty())
        || unbalance.is_some_and(|found| !found.probes.is_empty());
    if !is_empty || compared {
        return Ok(());
    }
    let of = |v: &Computed| {
        let found = v.results.frf.as_ref();
        let responses = found.map_or(String::new(), |found| found.responses.join(", "));
        let excitations = found.map_or(String::new(), |found| found.excitations.join(", "));
        format!("{}: probes {responses}; excitations {excitations}", v.name)
    };
    let listed: Vec<String> = computed.iter().map(of).collect();
    Err(Failure::Input(format!(
        "the cases have no probe with an excitation in common, of the same point, direction and unit:\n  {}",
        listed.join("\n  ")
    )))
}

/// What is written to files.
fn section<'a>(
    modes: Option<&'a VariantComparison>,
    frfs: Option<&'a FrfComparison>,
    unbalance: Option<&'a UnbalanceComparison>,
) -> Section<'a> {
    let content = modes.map_or_else(Document::new, |found| found.section().content);
    let content = content
        .and_if(frfs, |out, found| out.group("frf", found.document()))
        .and_if(unbalance, |out, found| out.group("unbalance", found.document()));
    Section::new("comparison", "comparison", content)
}
