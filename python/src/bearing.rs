//! Ball bearings of a machine or of a file with bearings only: the command `bearing`.

use std::path::PathBuf;

use pyo3::prelude::*;
use rotordyn::model::{Diagnostic, Options};
use rotordyn::results::Results;
use rotordyn::warning::Warning;

use crate::analysis::{Analysis, Found};
use crate::cli::args::Command;
use crate::cli::bearing::compute;
use crate::cli::ehl_films;
use crate::cli::failure::Failure;
use crate::cli::machine::ModelSource;
use crate::cli::settings;
use crate::failure::{Stop, interruptible};
use crate::reading::use_default_limits;
use crate::study::{parsed, silent};

/// Parts of a model, as `Source.parts`.
type Parts = (Vec<u8>, String, PathBuf, Option<String>, Vec<(String, String)>);

/// The bearings of a model; `words` are the flags of the command `bearing`.
#[pyfunction]
pub fn bearings(py: Python<'_>, parts: Parts, words: Vec<String>) -> PyResult<Analysis> {
    use_default_limits();
    interruptible(py, move |stop| {
        let words: Vec<String> = std::iter::once("bearing".into()).chain(words).collect();
        let Command::Bearing(args) = parsed(&words)? else {
            return Err(Stop::from(Failure::Input("this command analyses no bearing".into())));
        };
        let (text, name, folder, variant, set) = parts;
        let mut file = ModelSource { name, text, options: Options { variant, set }, folder, files: None };
        let settings = settings::bearing(&args)?;
        let mut loaded = file.load_bearings(&settings)?;
        let (terminal, place) = (silent(stop), std::env::temp_dir());
        match &mut loaded.model {
            Some(model) => ehl_films::prepare_machine_films(model, &place, &terminal)?,
            None => {
                for (name, bearing) in &mut loaded.bearings {
                    ehl_films::prepare_bearing_films(name, bearing, &place, &terminal)?;
                }
            }
        }
        let (bearings, complete) = compute(&loaded, &terminal)?;
        let mut results = Results { bearings, ..Results::default() };
        let of_file: Vec<Warning> = loaded.warnings.iter().filter_map(Diagnostic::to_warning).collect();
        let known = of_file.len();
        results.warnings = of_file;
        results.warnings.extend(results.bearings.iter().flat_map(|found| found.warnings.clone()));
        let warnings = results.warnings.clone();
        file.options = file.options_with(&settings);
        let (name, title) = (loaded.name.clone(), loaded.title.clone());
        let found =
            Found::Bearings { file: Box::new(file), name, title, results: Box::new(results), complete };
        Ok(Analysis::new(found, &warnings, known))
    })
}
