//! Results that are of no study of a machine: identified modes, updated models, bearings.

use std::path::{Path, PathBuf};

use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList};
use rotordyn::document::{Document, Section};
use rotordyn::figures::{self, Named};
use rotordyn::io::hdf5::COMPLETE;
use rotordyn::io::model_file_edit::{Change, format_like};
use rotordyn::io::results_file::{self, Provenance, ResultsWriter};
use rotordyn::io::{json, measured};
use rotordyn::results::{BearingResult, Results};
use rotordyn::update::Findings;
use rotordyn::update::parameter::ModelNumber;
use rotordyn::warning::Warning;
use serde_json::Value;

use crate::cli::failure::Failure;
use crate::cli::identified_file::Identified;
use crate::cli::machine::ModelSource;
use crate::cli::update_fit::Fit;
use crate::failure::{Stop, detached, to_python};
use crate::source::{Source, WarningTexts, warning_texts};
use crate::tree;

/// What an analysis found.
pub enum Found {
    Modes(Box<Identified>),
    Update(Box<(Fit, Findings)>),
    /// Bearings of a file, with its title.
    Bearings {
        file: Box<ModelSource>,
        name: String,
        title: String,
        results: Box<Results>,
        complete: bool,
    },
}

/// What an analysis found, with its warnings.
#[pyclass(frozen, module = "rotordyn._native")]
pub struct Analysis {
    found: Found,
    warnings: Vec<WarningTexts>,
    /// Number of warnings of the model file, the first ones.
    known_warnings: usize,
}

impl Analysis {
    pub fn new(found: Found, warnings: &[Warning], known_warnings: usize) -> Self {
        Self { found, warnings: warnings.iter().map(warning_texts).collect(), known_warnings }
    }

    /// Modes as shapes at points; `None` for other results.
    pub fn identified(&self) -> Option<&Identified> {
        match &self.found {
            Found::Modes(found) => Some(found),
            _ => None,
        }
    }

    fn document(&self) -> Document<'_> {
        match &self.found {
            Found::Modes(found) => found.section().content,
            Found::Update(found) => found.0.document(&found.1),
            Found::Bearings { .. } => Document::new(),
        }
    }

    fn to_json(&self) -> Value {
        match &self.found {
            Found::Update(found) => {
                let mut document = json::document(&self.document());
                document["model"] = found.0.found.after.linearised.model.name.clone().into();
                document["source"] = found.0.read.source.clone().into();
                document
            }
            Found::Bearings { name, title, results, .. } => json::bearings_to_json(results, name, title),
            Found::Modes(_) => json::document(&self.document()),
        }
    }

    fn drawn(&self) -> Vec<(Named, Vec<Warning>)> {
        let plain = |all: Vec<Named>| all.into_iter().map(|named| (named, Vec::new())).collect();
        match &self.found {
            Found::Modes(found) => plain(found.figures()),
            Found::Update(found) => plain(found.0.figures(&found.1)),
            Found::Bearings { title, results, .. } => figures::of_bearings(&results.bearings, title),
        }
    }

    fn write(&self, path: &Path) -> Result<(), Failure> {
        match &self.found {
            Found::Modes(found) => found.write_results(path),
            Found::Update(found) => found.0.write_results(&found.1, path),
            Found::Bearings { file, title, results, complete, .. } => {
                let options = &file.options;
                let provenance = Provenance {
                    model: String::from_utf8_lossy(&file.text).into_owned(),
                    title: title.clone(),
                    variant: options.variant.clone().unwrap_or_default(),
                    settings: options.set.iter().map(|(path, value)| format!("{path} = {value}")).collect(),
                    files: file.side_files(options),
                    ..Provenance::default()
                };
                let state = if *complete { COMPLETE } else { "stopped: by the user" };
                let mut writer = ResultsWriter::create(path, provenance, false);
                writer.finish(state, &[], &[], |store| results_file::write_bearings(store, results))?;
                Ok(())
            }
        }
    }
}

#[pymethods]
impl Analysis {
    /// All warnings, and the number of them that are of the model file.
    #[getter]
    fn warnings(&self) -> (Vec<WarningTexts>, usize) {
        (self.warnings.clone(), self.known_warnings)
    }

    /// Fields of the result, see `tree.rs`.
    fn fields<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyList>> {
        tree::document(py, &self.document())
    }

    /// Fields of every bearing.
    fn sections<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let sections: Vec<Section> = match &self.found {
            Found::Bearings { results, .. } => results.bearings.iter().map(BearingResult::section).collect(),
            _ => Vec::new(),
        };
        tree::sections(py, &sections)
    }

    /// The document of the command's `--json` without what is of the command.
    fn json(&self, py: Python<'_>) -> PyResult<String> {
        detached(py, || Ok(self.to_json().to_string()))
    }

    /// Names and SVG documents of the figures, as the command draws them.
    fn figures(&self, py: Python<'_>) -> PyResult<Vec<(String, String)>> {
        detached(py, || {
            let drawn = self.drawn();
            let svg = drawn.into_iter().map(|((name, figure), warnings)| {
                Ok((name, figure.svg_with_warnings(&warnings).map_err(Failure::from)?))
            });
            svg.collect::<Result<_, Stop>>()
        })
    }

    /// Writes the results file (HDF5) of the command.
    fn save(&self, py: Python<'_>, path: PathBuf) -> PyResult<()> {
        detached(py, || Ok(self.write(&path)?))
    }

    /// Writes identified modes as a universal file.
    fn save_shapes(&self, py: Python<'_>, path: PathBuf) -> PyResult<()> {
        detached(py, || match self.identified().and_then(Identified::shapes) {
            Some(shapes) => Ok(measured::write(&path, &shapes).map_err(Failure::from)?),
            None => Err(Failure::Input("there is no mode to be saved".into()).into()),
        })
    }

    /// Updated values of a model: path, number with its unit, whether it is a text in the file.
    fn changes(&self, py: Python<'_>) -> PyResult<Vec<(String, String, bool)>> {
        match &self.found {
            Found::Update(found) => Ok(written(&found.0)),
            _ => Err(to_python(py, no_update().into())),
        }
    }

    /// Text of the model file of `source` with the updated values.
    fn updated_text(&self, py: Python<'_>, source: &Source) -> PyResult<String> {
        detached(py, || match &self.found {
            Found::Update(found) => Ok(found.0.model_text(&source.file)?),
            _ => Err(no_update().into()),
        })
    }
}

fn no_update() -> Failure {
    Failure::Input("this is no update".into())
}

/// Updated values with their digits, as they stand in a file.
fn written(fit: &Fit) -> Vec<(String, String, bool)> {
    let text = |(place, change): (&ModelNumber, Change)| {
        let number = format_like(&format!("{}", place.value), change.value, change.error);
        let unit = if place.unit.is_empty() { String::new() } else { format!(" {}", place.unit) };
        (change.path, format!("{number}{unit}"), place.quoted)
    };
    fit.changes().into_iter().map(text).collect()
}
