//! Modes of measured FRFs and records: the command `identify`, of files or of arrays.

use numpy::{PyReadonlyArray1, PyReadonlyArray3};
use pyo3::prelude::*;
use rotordyn::io::machine_records;
use rotordyn::io::measured::mapping::direction;
use rotordyn::io::measured::unit_label;
use rotordyn::linalg::Complex64;
use rotordyn::model::Model;
use rotordyn::signal::record::{Axis, AxisQuantity, Dof, Kind, MeasuredData, Record, Values};
use rotordyn::units::{self, SPEED};
use rotordyn::warning::{Code, Warning};

use crate::analysis::{Analysis, Found};
use crate::cli::args::Command;
use crate::cli::failure::Failure;
use crate::cli::identify::{InMemory, compute};
use crate::failure::{Stop, interruptible, to_python};
use crate::reading::use_default_limits;
use crate::results::StudyResults;
use crate::source::Source;
use crate::study::{parsed, silent};

/// FRFs in memory.
#[pyclass(frozen, module = "rotordyn._native")]
pub struct Measured {
    pub data: MeasuredData,
}

/// Points by their names: numbers stand for themselves, names are those of the model or numbered in order.
struct Points<'m> {
    model: Option<&'m Model>,
    named: Vec<String>,
}

impl Points<'_> {
    /// Point and direction of "disc x", "B -y", "12 theta_x".
    fn dof(&mut self, text: &str) -> Result<Dof, String> {
        let shape = || {
            format!(
                "{text:?} is no point with a direction, such as \"disc x\", \"B -y\" or \"12 theta_x\" \
                 (directions: x, y, z, theta_x, theta_y, theta_z)"
            )
        };
        let (place, along) = text.trim().rsplit_once([' ', ':']).ok_or_else(shape)?;
        let (place, along) = (place.trim(), direction(along).ok_or_else(shape)?);
        let number = match (place.parse::<i64>(), self.model) {
            (Ok(number), _) if number > 0 => number,
            (_, Some(model)) => machine_records::point_number(model, place)
                .ok_or_else(|| format!("{text:?}: the model {} has no place {place:?}", model.name))?,
            (..) => {
                let known = self.named.iter().position(|name| name == place);
                let at = known.unwrap_or_else(|| {
                    self.named.push(place.to_string());
                    self.named.len() - 1
                });
                at as i64 + 1
            }
        };
        Ok(Dof::new(number, along))
    }
}

#[pymethods]
impl Measured {
    /// FRFs \[unit\] over frequencies \[Hz\], (responses, references, frequencies), with coherence.
    #[staticmethod]
    #[allow(clippy::too_many_arguments)]
    fn frfs(
        py: Python<'_>,
        frequency: PyReadonlyArray1<'_, f64>,
        values: PyReadonlyArray3<'_, Complex64>,
        responses: Vec<String>,
        references: Vec<String>,
        unit: String,
        coherence: Option<PyReadonlyArray3<'_, f64>>,
        speed: Option<String>,
        source: Option<&Source>,
    ) -> PyResult<Self> {
        let frequencies = frequency.as_array().to_vec();
        let values = values.as_array();
        let coherence = coherence.as_ref().map(|given| given.as_array());
        let read = || -> Result<MeasuredData, String> {
            let mut points = Points { model: source.map(|source| &source.loaded.model), named: Vec::new() };
            let mut dofs = |names: &[String]| {
                names.iter().map(|name| points.dof(name)).collect::<Result<Vec<_>, String>>()
            };
            let (of_responses, of_references) = (dofs(&responses)?, dofs(&references)?);
            let speed = speed.as_deref().map(|text| units::parse(text, SPEED)).transpose();
            let speed_rpm = speed
                .map_err(|error| format!("speed: {error}"))?
                .map(|speed| speed * 30.0 / std::f64::consts::PI);
            let known = match unit.trim() {
                "" => None,
                label => Some(unit_label::si(label).ok_or_else(|| {
                    format!("unit {label:?} is not known; such as \"(m/s^2)/N\", \"g/N\" or \"m/N\"")
                })?),
            };
            let axis = Axis::from_points(AxisQuantity::Frequency, frequencies);
            let mut records = Vec::new();
            for (r, response) in of_responses.iter().enumerate() {
                for (e, reference) in of_references.iter().enumerate() {
                    let name = format!("{}/{}", responses[r], references[e]);
                    let record = |name: &str, kind, values, unit: &str| Record {
                        response: *response,
                        reference: *reference,
                        speed_rpm,
                        ..Record::new(name, kind, axis.clone(), values, unit)
                    };
                    let line = |k: usize| values[[r, e, k]];
                    let own = (0..values.shape()[2]).map(line).collect();
                    let mut frf = record(&name, Kind::Frf, Values::Complex(own), "");
                    if let Some(known) = &known {
                        frf.values.scale(known.numerator, known.divisor);
                        (frf.unit, frf.file_unit) = (known.name.clone(), unit.clone());
                    }
                    records.push(frf);
                    if let Some(given) = &coherence {
                        let own = (0..given.shape()[2]).map(|k| given[[r, e, k]]).collect();
                        records.push(record(
                            &format!("coherence {name}"),
                            Kind::Coherence,
                            Values::Real(own),
                            "1",
                        ));
                    }
                }
            }
            let geometry = source.map(|source| machine_records::geometry(&source.loaded.model));
            Ok(MeasuredData { records, geometry: geometry.unwrap_or_default(), ..MeasuredData::default() })
        };
        match read() {
            Ok(data) => Ok(Self { data }),
            Err(problem) => Err(to_python(py, Failure::Input(problem).into())),
        }
    }

    /// Computed FRFs at the points of their machine, as `export` writes them.
    #[staticmethod]
    fn of_frf(py: Python<'_>, results: &StudyResults) -> PyResult<Self> {
        match &results.results.frf {
            Some(found) => Ok(Self { data: machine_records::frf_records(found, &results.machine) }),
            None => Err(to_python(py, Failure::Input("these results have no FRFs".into()).into())),
        }
    }

    /// Identified modes as shapes at points, as modes.uff has them.
    #[staticmethod]
    fn of_modes(py: Python<'_>, modes: &Analysis) -> PyResult<Self> {
        match modes.identified().and_then(|found| found.shapes()) {
            Some(data) => Ok(Self { data }),
            None => Err(to_python(py, Failure::Input("no mode was identified".into()).into())),
        }
    }
}

/// Modes of the files in `words`, the arguments of the command `identify`, or of `measured` in place of the only file;
/// `source` defines the stations.
#[pyfunction]
pub fn identify(
    py: Python<'_>,
    words: Vec<String>,
    measured: Option<&Measured>,
    source: Option<&Source>,
) -> PyResult<Analysis> {
    use_default_limits();
    let mut data = measured.map(|measured| measured.data.clone());
    let model = source.map(|source| source.loaded.model.clone());
    interruptible(py, move |stop| {
        let words: Vec<String> = std::iter::once("identify".into()).chain(words).collect();
        let Command::Identify(mut args) = parsed(&words)? else {
            return Err(Stop::from(Failure::Input("this command identifies no modes".into())));
        };
        // The first file is the place of the model in the words of other commands.
        if args.files.len() > 1 {
            args.files.remove(0);
        }
        let terminal = silent(stop);
        if let Some(data) = &mut data {
            let zero = without_zero_responses(data);
            if !zero.is_empty() {
                let text = format!("responses that are zero at all frequencies: {}", zero.join(", "));
                terminal.warn_of(Code::LeftOut, text);
            }
        }
        let in_memory = InMemory { measured: data, model };
        let found = compute(&args, &in_memory, &terminal)?;
        let mut warnings = terminal.warnings();
        let of_modes = found.warnings.iter();
        warnings.extend(of_modes.map(|text| Warning::new(Code::Identification, "", text.clone())));
        Ok(Analysis::new(Found::Modes(Box::new(found)), &warnings, 0))
    })
}

/// Leaves out responses whose FRFs are all zero, such as those across the force in a symmetric machine; returns their names.
fn without_zero_responses(data: &mut MeasuredData) -> Vec<String> {
    let is_zero = |record: &Record| match &record.values {
        Values::Complex(values) => values.iter().all(|value| value.norm_sqr() == 0.0),
        Values::Real(_) => true,
    };
    let moving: Vec<Dof> =
        data.records.iter().filter(|record| !is_zero(record)).map(|record| record.response).collect();
    let left_out = |record: &Record| !moving.contains(&record.response);
    let names = data.records.iter().filter(|record| record.kind == Kind::Frf && left_out(record));
    let names: Vec<String> = names.map(|record| record.name.clone()).collect();
    // Without any motion the message about it is that of the identification.
    if moving.is_empty() {
        return Vec::new();
    }
    data.records.retain(|record| moving.contains(&record.response));
    names
}
