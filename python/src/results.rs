//! What a study found, with the machine it is of.

use std::path::PathBuf;
use std::sync::Arc;

use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict};
use rotordyn::figures;
use rotordyn::io::hdf5::COMPLETE;
use rotordyn::io::results_file::{Provenance, ResultsWriter, write_labels};
use rotordyn::io::{json, saved_results};
use rotordyn::results::Results;
use rotordyn::study::Machine;

use crate::cli::failure::Failure;
use crate::cli::machine::ModelSource;
use crate::cli::store::estimated_lines;
use crate::cli::studies::Study;
use crate::failure::{Stop, detached, to_python};
use crate::source::{Source, WarningTexts, warning_texts};
use crate::tree;

/// Results of one study.
#[pyclass(frozen, module = "rotordyn._native")]
pub struct StudyResults {
    pub study: Study,
    pub results: Results,
    pub machine: Arc<Machine>,
    /// The model with all settings of the study.
    pub file: ModelSource,
    /// Number of warnings of the model file, the first ones.
    pub known_warnings: usize,
    /// Whether the study was stopped before its end.
    pub stopped: bool,
}

#[pymethods]
impl StudyResults {
    /// Name of the study's command.
    #[getter]
    fn study(&self) -> &'static str {
        self.study.name()
    }

    #[getter]
    fn complete(&self) -> bool {
        !self.stopped
    }

    /// Name and title of the model.
    #[getter]
    fn model(&self) -> (String, String) {
        (self.machine.model.name.clone(), self.machine.model.title.clone())
    }

    /// All warnings, and the number of them that are of the model file.
    #[getter]
    fn warnings(&self) -> (Vec<WarningTexts>, usize) {
        (self.results.warnings.iter().map(warning_texts).collect(), self.known_warnings)
    }

    /// Sections of the results as fields, see `tree.rs`.
    fn tree<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        tree::sections(py, &self.results.sections(&self.machine.assembly.dofs))
    }

    /// The document of the command's `--json` without what is of the command.
    fn json(&self, py: Python<'_>) -> PyResult<String> {
        detached(py, || Ok(json::to_json(&self.results, &self.machine).to_string()))
    }

    /// Names and SVG documents of the figures, as the command draws them.
    fn figures(&self, py: Python<'_>) -> PyResult<Vec<(String, String)>> {
        detached(py, || {
            let all = figures::all_with_warnings(&self.results, &self.machine).map_err(Failure::from)?;
            // The first one is the machine.
            let drawn = all.iter().map(|((name, figure), warnings)| {
                let svg = figure.svg_with_warnings(warnings).map_err(Failure::from)?;
                Ok((name.clone(), svg))
            });
            drawn.collect::<Result<_, Failure>>().map_err(Stop::from)
        })
    }

    /// Writes a results file (HDF5) like that of the command.
    fn save(&self, py: Python<'_>, path: PathBuf) -> PyResult<()> {
        detached(py, || {
            let model = &self.machine.model;
            let options = &self.file.options;
            let provenance = Provenance {
                model: String::from_utf8_lossy(&self.file.text).into_owned(),
                title: model.title.clone(),
                variant: options.variant.clone().unwrap_or_default(),
                settings: options.set.iter().map(|(path, value)| format!("{path} = {value}")).collect(),
                estimated_geometry: estimated_lines(model.estimated_geometries()),
                measured_speed: None,
                files: self.file.side_files(options),
            };
            let sections = self.results.sections(&self.machine.assembly.dofs);
            let mut writer = ResultsWriter::create(&path, provenance, false);
            let state = if self.stopped { "stopped: by the user" } else { COMPLETE };
            writer.finish(state, &[], &sections, |store| write_labels(store, &self.machine))?;
            Ok(())
        })
    }

    /// What `results_of_bytes` makes the same results of, beside the model.
    fn bytes<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyBytes>> {
        let bytes = detached(py, || Ok(saved_results::to_bytes(&self.results).map_err(Failure::Input)?))?;
        Ok(PyBytes::new(py, &bytes))
    }

    /// The model with the settings of the study, as `Source.parts`.
    #[getter]
    #[allow(clippy::type_complexity)]
    fn parts(&self) -> (Vec<u8>, String, PathBuf, Option<String>, Vec<(String, String)>) {
        let ModelSource { text, name, folder, options, .. } = &self.file;
        (text.clone(), name.clone(), folder.clone(), options.variant.clone(), options.set.clone())
    }

    /// Channels of a run-up: name, unit, quantity, station, direction.
    fn channels(&self) -> Vec<(String, String, String, String, String)> {
        let history = self.results.run_up.iter().flat_map(|run| &run.history.channels);
        history
            .map(|c| {
                let [name, unit, quantity] = [&c.name, &c.unit, &c.quantity].map(Clone::clone);
                (name, unit, quantity, c.station.clone(), c.direction.clone())
            })
            .collect()
    }

    /// Samples of a run-up: of a channel, or `time` \[s\], `angle` \[rad\], `speed` \[rad/s\].
    fn samples<'py>(
        &self,
        py: Python<'py>,
        name: &str,
    ) -> PyResult<Option<Bound<'py, numpy::PyArray1<f64>>>> {
        let Some(run) = &self.results.run_up else { return Ok(None) };
        let history = &run.history;
        let series = match (name, history.channel(name)) {
            (_, Some(channel)) => &channel.values,
            ("time", None) => &history.time,
            ("angle", None) => &history.angle,
            ("speed", None) => &history.speed,
            _ => return Ok(None),
        };
        let values = series.all().map_err(|error| to_python(py, Failure::from(error).into()))?;
        Ok(Some(numpy::PyArray1::from_slice(py, &values)))
    }
}

/// The results of `StudyResults.bytes` of a model.
#[pyfunction]
pub fn results_of_bytes(
    py: Python<'_>,
    source: &Source,
    study: &str,
    bytes: &[u8],
    known_warnings: usize,
    complete: bool,
) -> PyResult<StudyResults> {
    let wrong = |text: String| Stop::from(Failure::Input(text));
    detached(py, || {
        let Some(study) = Study::ALL.into_iter().find(|known| known.name() == study) else {
            return Err(wrong(format!("there is no study {study}")));
        };
        let results: Results = saved_results::from_bytes(bytes).map_err(wrong)?;
        let machine = Arc::new(Machine::new(source.loaded.model.clone())?);
        let file = source.file.clone();
        Ok(StudyResults { study, results, machine, file, known_warnings, stopped: !complete })
    })
}
