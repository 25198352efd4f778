//! `update`: model updating of free parameters to measured modes and FRFs, with their identifiability.

use std::path::PathBuf;

use rotordyn::document::Section;
use rotordyn::figures::{self, Stage};
use rotordyn::io::hdf5::Store;
use rotordyn::io::measured::test_data;
use rotordyn::io::{atomic_file, json, model_file_edit, results_file};
use rotordyn::model::{self, Model, Options};
use rotordyn::update::correlation::Correlation;
use rotordyn::update::frf::{FrfFitting, rms_difference_db};
use rotordyn::update::parameter::FreeParameter;
use rotordyn::update::residual::Fitting;
use rotordyn::update::{IdentifiabilityClass, Update, UpdateError, UpdateJob, update};
use serde_json::json;

use super::args::{FitResidual, UpdateArgs};
use super::csv_files::write_csv;
use super::failure::Failure;
use super::folder_lock::FolderLock;
use super::machine::ModelSource;
use super::measured::{self, band, folder};
use super::terminal::{Terminal, number};
use super::{
    Outcome, ehl_films, free_parameters, print_model_warnings, print_written_files, update_findings,
};

pub fn run(args: &UpdateArgs, terminal: &Terminal) -> Result<Outcome, Failure> {
    let origin = ModelSource::read(&args.study.model)?;
    let mut loaded = origin.load(&[])?;
    print_model_warnings(terminal, &loaded);
    let parameters = free_parameters::parameters(args, &origin, terminal)?;
    update_findings::check_profiles(&args.profile, &parameters)?;
    let name = match &origin.options.variant {
        Some(variant) => format!("{}_{variant}", loaded.model.name),
        None => loaded.model.name.clone(),
    };
    let folder = folder(args.study.out.as_ref(), &name, "updated");
    let _lock = FolderLock::take(&folder, terminal)?;
    ehl_films::prepare_machine_films(&mut loaded.model, &folder, terminal)?;
    if args.measured.measured.len() > 1 {
        return Err(Failure::Input(
            "update takes a single measured file; merge the FRFs into one file".into(),
        ));
    }
    let read = measured::read(&args.measured, &loaded.model, terminal)?.remove(0);
    let read = read.ok_or_else(|| test_data::no_test_data(&args.measured.measured[0]))?;
    terminal.print(&format!("{}: {}", args.measured.measured[0].display(), read.source));
    let fitting = fitting(args, band(&read.target));
    if fitting.frf.is_some() && read.target.frfs.is_none() {
        return Err(Failure::Input(if read.source.contains("FRF") {
            "--fit frf: the file's FRFs cannot be compared with the model's (see the warning); give the points and \
             directions of responses and forces with --mapping, or leave frf out of --fit"
                .into()
        } else {
            "--fit frf needs FRFs, but the measured file contains none; give FRFs (universal file dataset 58), or fit \
             frequency, damping and mac"
                .into()
        }));
    }
    let load = |set: &[(String, String)]| -> Result<Model, UpdateError> {
        let mut options: Options = origin.options.clone();
        options.set.extend_from_slice(set);
        let changed = |e: &dyn std::fmt::Display| {
            let advice = "set --bounds that keep the free parameters valid";
            UpdateError::new(format!("{}: {e}", args.study.model.model.display()), advice)
        };
        let mut model = model::load(&origin.name, &origin.text, &options).map_err(|e| changed(&e))?.model;
        ehl_films::prepare_machine_films(&mut model, &folder, terminal).map_err(|e| changed(&e.message()))?;
        Ok(model)
    };
    let job = UpdateJob {
        parameters: &parameters,
        target: &read.target,
        fitting: &fitting,
        load: &load,
        max_iterations: args.iterations,
    };
    let bar = terminal.spinner("updating");
    let found = update(&job);
    bar.finish_and_clear();
    let found = found?;

    parameter_table(terminal, &parameters, &found);
    singular_table(terminal, &parameters, &found);
    measured::mode_table(terminal, "Modes before", &read.target, &found.before);
    measured::mode_table(terminal, "Modes after", &read.target, &found.after);
    measured::pair_warnings(terminal, &read.target, &found.after)?;
    let before = Correlation::new(&read.target, &found.before)?;
    let after = Correlation::new(&read.target, &found.after)?;
    let frf_difference_db = |stage: &Correlation| -> Option<f64> {
        let (measured, computed) = stage.measured_and_computed()?;
        Some(rms_difference_db(measured, computed, fitting.frf.as_ref()?))
    };
    let frf_difference_db = frf_difference_db(&before).zip(frf_difference_db(&after));
    if let Some((before, now)) = frf_difference_db {
        measured::frac_table(terminal, &after);
        terminal.print(&format!(
            "\nFRF difference {} dB after the update, {} dB before (RMS over the fitted frequency lines)",
            number(now, 2),
            number(before, 2)
        ));
    }
    update_findings::print_fit(terminal, &found);
    let findings = update_findings::findings(terminal, &job, &found, &origin, &args.profile)?;
    update_findings::print(terminal, &parameters, &found, &findings);
    update_findings::warn(terminal, &parameters, &found, &findings);

    let mut files = vec![write_model(args, &origin, &parameters, &found, &folder)?];
    let path = folder.join("update.h5");
    let store = Store::replace(&path)?;
    let difference = frf_difference_db.map(<[f64; 2]>::from);
    let content = found.document(&parameters, &findings, [&before, &after], difference);
    results_file::write_document(&store, "", &content)?;
    store.commit()?;
    files.push(path);
    if !args.study.no_figures {
        let stages = [
            Stage { name: "before", state: &found.before, frfs: before.frfs.as_deref() },
            Stage { name: "after", state: &found.after, frfs: after.frfs.as_deref() },
        ];
        files.extend(figures::draw_validation(
            "update",
            &loaded.model.title,
            &read.target,
            &stages,
            &folder,
        )?);
        let title = &loaded.model.title;
        files.extend(figures::draw_update_profiles(title, &found, &parameters, &findings.profiles, &folder)?);
    }
    let section = Section::new("update", "update", content);
    if args.study.csv {
        files.extend(write_csv(&folder, std::slice::from_ref(&section))?);
    }
    print_written_files(terminal, &folder, &files);
    let mut document = json::document(&section.content);
    document["command"] = json!("update");
    document["model"] = json!(loaded.model.name);
    document["measured"] = json!(args.measured.measured);
    document["source"] = json!(read.source);
    document["files"] = json!(files);
    Ok(document.into())
}

fn fitting(args: &UpdateArgs, band: [f64; 2]) -> Fitting {
    let is_fitted = |word: FitResidual| args.fit.contains(&word);
    let standard = Fitting::default();
    let frf = |complex| FrfFitting { deviation: 0.01 * args.frf_accuracy, ..FrfFitting::new(complex, band) };
    Fitting {
        frequency: is_fitted(FitResidual::Frequency).then_some(0.01 * args.frequency_accuracy),
        damping: is_fitted(FitResidual::Damping).then_some(0.1),
        shape: is_fitted(FitResidual::Mac).then_some(standard.shape.unwrap_or(0.05)),
        frf: if is_fitted(FitResidual::FrfComplex) {
            Some(frf(true))
        } else {
            is_fitted(FitResidual::Frf).then(|| frf(false))
        },
    }
}

fn value(parameter: &FreeParameter, x: f64) -> String {
    format!("{} {}", number(parameter.value(x), 5), parameter.unit()).trim_end().to_string()
}

/// Standard error of a parameter in per cent of its value.
fn error_per_cent(parameter: &FreeParameter, x: f64, error: f64) -> f64 {
    100.0 * (error * parameter.derivative(x) / parameter.value(x)).abs()
}

fn parameter_table(terminal: &Terminal, parameters: &[FreeParameter], found: &Update) {
    let rows: Vec<Vec<String>> = parameters
        .iter()
        .zip(&found.outcomes)
        .map(|(p, o)| {
            vec![
                p.name.clone(),
                value(p, 0.0),
                value(p, o.x),
                format!("{:+.1}", 100.0 * (p.value(o.x) / p.value(0.0) - 1.0)),
                number(error_per_cent(p, o.fitted, o.error), 2),
                number(100.0 * o.prior_share, 2),
                o.class.label().into(),
            ]
        })
        .collect();
    let header = [
        "parameter",
        "start",
        "updated",
        "change %",
        "standard error %",
        "prior variance left %",
        "identifiability",
    ];
    terminal.table("Free parameters", &header, &rows);
    terminal.print(
        "  prior variance left = posterior variance / prior variance. Identifiable: at most 10 % left and a standard\n  \
         error of at most 10 %; poorly identifiable: at most 50 % left; otherwise not identifiable, start value kept",
    );
    if found.goodness.is_rejected() {
        terminal.print(
            "  poor fit: the model does not explain the data, so that no parameter is identified; the standard errors do not\n  \
             cover that error",
        );
    }
}

fn singular_table(terminal: &Terminal, parameters: &[FreeParameter], found: &Update) {
    let identifiability = &found.identifiability;
    let rows: Vec<Vec<String>> = identifiability
        .singular_values
        .iter()
        .zip(&identifiability.directions)
        .map(|(sigma, direction)| {
            let mut parts: Vec<(f64, &str)> =
                direction.iter().zip(parameters).map(|(v, p)| (*v, p.name.as_str())).collect();
            parts.sort_by(|a, b| b.0.abs().total_cmp(&a.0.abs()));
            let turn = if parts.first().is_some_and(|p| p.0 < 0.0) { -1.0 } else { 1.0 };
            let words: Vec<String> = parts
                .iter()
                .filter(|p| p.0.abs() > 0.15)
                .map(|(v, name)| format!("{:+.2} {name}", turn * v))
                .collect();
            vec![number(*sigma, 3), words.join(" ")]
        })
        .collect();
    let header = ["sigma", "direction"];
    terminal.table(
        "Singular values of the scaled sensitivity matrix (below 1: the prior dominates the data)",
        &header,
        &rows,
    );
}

/// Writes the model file with the updated values; the rest of its text is unchanged.
fn write_model(
    args: &UpdateArgs,
    origin: &ModelSource,
    parameters: &[FreeParameter],
    found: &Update,
    folder: &std::path::Path,
) -> Result<PathBuf, Failure> {
    let path = args.write.clone().unwrap_or_else(|| {
        let stem = args.study.model.model.file_stem().unwrap_or_default().to_string_lossy();
        folder.join(format!("{stem}_updated.toml"))
    });
    let mut changes = Vec::new();
    for (parameter, outcome) in parameters.iter().zip(&found.outcomes) {
        if outcome.class == IdentifiabilityClass::NotIdentifiable {
            continue;
        }
        for place in &parameter.numbers {
            let value = parameter.value_of(place, outcome.x);
            let error = if parameter.logarithmic { outcome.error * value.abs() } else { outcome.error };
            changes.push(model_file_edit::Change { path: place.path.clone(), value, error });
        }
    }
    let text = String::from_utf8_lossy(&origin.text);
    let new = model_file_edit::rewrite(&text, origin.options.variant.as_deref(), &changes)
        .map_err(|e| Failure::Input(format!("{}: {e}", origin.name)))?;
    atomic_file::write(&path, new.as_bytes())
        .map_err(|e| Failure::environment("write the model file", &path, e))?;
    Ok(path)
}
