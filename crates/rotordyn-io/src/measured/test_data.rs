//! Test data for model validation and updating, from a file: identified modes, FRFs, or a simulated impact
//! test.

use std::f64::consts::TAU;
use std::path::Path;

use super::mapping;
use super::mapping::Mapping;
use crate::budget::{Budget, Limits};
use crate::error::Error;
use crate::hdf5::open_reader;
use crate::machine_records;
use crate::measured;
use rotordyn_core::model::Model;
use rotordyn_identify::{self as identify, ModalIdentification};
use rotordyn_linalg::{Complex64, StopRequest};
use rotordyn_signal::record::{Analysis, Dof, FrfMatrix, Kind, MeasuredData, Shape};
use rotordyn_update::UpdateError;
use rotordyn_update::target::{Sensor, Target, TargetFrfs, TargetMode, modes_of, sensors};

/// Settings for reading a measured file.
#[derive(Clone, Copy, Debug, Default)]
pub struct ReadSettings<'a> {
    pub mapping: Option<&'a Path>,
    /// Frequency band \[Hz\]; all if `None`.
    pub band: Option<[f64; 2]>,
    /// Speed Ω \[rad/s\] of the measurement, if the file does not state it.
    pub speed: Option<f64>,
    /// Decay rate \[1/s\] that an exponential window added to all modes of the FRFs; 0 without a window.
    pub added_decay: f64,
    /// Limits for reading the file; the usual ones if `None`.
    pub limits: Option<&'a Limits>,
    /// Ends the identification of FRFs from another thread.
    pub stop: Option<&'a StopRequest>,
}

/// Test data of a file, and warnings.
#[derive(Clone, Debug)]
pub struct TestData {
    pub target: Target,
    pub warnings: Vec<String>,
    /// What of the file was not read; `None` if nothing.
    pub left_out: Option<String>,
    /// "9 modes identified from 12 FRFs", "9 modes of the file".
    pub source: String,
    /// Peak force of a simulated impact \[N\].
    pub peak_force: Option<f64>,
}

/// Reads a file and assigns its modes or FRFs to points of the model.
///
/// Modes of a universal file (55, 2414) or of a results file are taken as they are; modes of FRFs are
/// identified; the run of an impact test, stored by `run-up` with a load over time, is first converted to
/// FRFs. `None` if it contains neither modes nor FRFs.
///
/// # Errors
/// A file that cannot be read, a mapping or points that do not fit the model, no mode in the band.
pub fn read(path: &Path, reading: &ReadSettings, model: &Model) -> Result<Option<TestData>, Error> {
    let usual = Limits::default();
    let limits = reading.limits.unwrap_or(&usual);
    let measured = match from_results_file(path, limits)? {
        Some(measured) => measured,
        None => measured::read_within(path, limits)?,
    };
    of_measured(measured, reading, model)
}

/// Assigns modes or FRFs to points of the model; `None` without any.
///
/// # Errors
/// A mapping or points that do not fit the model, no mode in the band.
pub fn of_measured(
    mut measured: MeasuredData,
    reading: &ReadSettings,
    model: &Model,
) -> Result<Option<TestData>, Error> {
    let has_modes = measured.shapes.iter().any(is_mode);
    if !has_modes && !measured.records.iter().any(|r| r.kind == Kind::Frf) {
        return Ok(None);
    }
    let mut warnings = std::mem::take(&mut measured.notes);
    if let Some(file) = reading.mapping {
        let mapping = mapping::read(file)?;
        warnings.extend(apply_mapping(&mapping, &mut measured, model, file)?);
    }
    let mut out = match measured.shapes.iter().any(is_mode) {
        true => of_shapes(&measured, reading, model)?,
        false => of_frfs(&measured, reading, model)?,
    };
    if let Some([from, to]) = reading.band {
        let all = out.target.modes.len();
        out.target.modes.retain(|m| (from..=to).contains(&m.frequency_hz));
        if out.target.modes.is_empty() {
            return Err(UpdateError::new(
                format!("none of the {all} measured modes lies in {from} .. {to} Hz"),
                "choose another --band",
            )
            .into());
        }
    }
    out.warnings.splice(0..0, warnings);
    out.left_out = measured.left_out_text();
    if out.target.sensors.len() < 3 {
        let n = out.target.sensors.len();
        out.warnings.push(format!(
            "{n} measured point{} cannot distinguish mode shapes: modes are paired by frequency",
            if n == 1 { "" } else { "s" }
        ));
    }
    Ok(Some(out))
}

/// Error for a file without modes and FRFs.
pub fn no_test_data(path: &Path) -> Error {
    Error::Content {
        path: path.into(),
        problem: "it contains neither modes nor FRFs".into(),
        advice: "give FRFs (universal file 58), modes (55, 2414), or the results of `rotordyn modal`".into(),
    }
}

fn is_mode(shape: &Shape) -> bool {
    matches!(shape.analysis, Analysis::NormalMode { .. } | Analysis::ComplexMode { .. })
}

/// Applies a mapping to records and shapes.
fn apply_mapping(
    mapping: &Mapping,
    measured: &mut MeasuredData,
    model: &Model,
    file: &Path,
) -> Result<Vec<String>, Error> {
    let place = |name: &str| machine_records::point_number(model, name);
    let mut warnings = Vec::new();
    if !measured.records.is_empty() {
        warnings = mapping.apply(measured, &place, file)?;
    }
    if measured.shapes.iter().any(is_mode) {
        mapping.apply_to_shapes(measured, &place, file)?;
    }
    Ok(warnings)
}

fn of_shapes(measured: &MeasuredData, reading: &ReadSettings, model: &Model) -> Result<TestData, Error> {
    let found = modes_of(measured, reading.speed.map(|s| s * 60.0 / TAU));
    let Some((dofs, modes, rpm)) = found.filter(|(_, modes, _)| !modes.is_empty()) else {
        return Err(UpdateError::new(
            "the file's shapes are not oscillatory modes",
            "export complex or normal modes",
        )
        .into());
    };
    let sensors = sensors(&dofs, &measured.geometry, model)?;
    let modes = scaled_by_sensor_weight(modes, &sensors);
    let speed = rpm.map(|rpm| rpm * TAU / 60.0).or(reading.speed).unwrap_or(0.0);
    let source = format!("{} modes of the file", modes.len());
    let target = Target { speed, sensors, modes, frfs: None };
    let mut warnings = Vec::new();
    if reading.added_decay > 0.0 {
        warnings.push("the damping of an exponential window is not taken off the modes of a file".into());
    }
    Ok(TestData { target, warnings, left_out: None, source, peak_force: None })
}

fn of_frfs(measured: &MeasuredData, reading: &ReadSettings, model: &Model) -> Result<TestData, Error> {
    let mut matrix = measured.frf_matrix()?;
    let zero_response_warnings = drop_zero_responses(&mut matrix);
    let stop = reading.stop.cloned().unwrap_or_default();
    let added_decay = reading.added_decay;
    let settings =
        identify::Settings { band: reading.band, added_decay, stop, ..identify::Settings::default() };
    let repaired = identify::without_single_lines(&matrix);
    let replaced = repaired.map(|(repaired, at)| {
        matrix = repaired;
        identify::single_lines_text(&at)
    });
    let found = identify::identify(&matrix, &settings)?;
    let speeds: Vec<f64> = measured.records.iter().filter_map(|r| r.speed_rpm).collect();
    let speed = reading.speed.or(speeds.first().map(|rpm| rpm * TAU / 60.0)).unwrap_or(0.0);
    let mut warnings: Vec<String> = found.dropped.iter().map(ToString::to_string).collect();
    warnings.extend(zero_response_warnings);
    warnings.extend(replaced);
    warnings.extend(identify::low_coherence(&matrix, &found));
    if let Some(text) = identify::frfs_without_unit(&matrix) {
        warnings.push(format!("{text}; give the unit in the file or in a mapping"));
    }
    if added_decay > 0.0 {
        warnings.push(
            "the damping of the exponential window is taken off the modes; the FRFs themselves have it, and are not compared"
                .into(),
        );
        let too_much = found.modes.iter().filter(|m| m.damping_ratio() <= 0.0).map(|m| {
            format!(
                "without the damping of the exponential window the mode at {:.3} Hz is not damped: it was measured with another \
                 window",
                m.frequency_hz()
            )
        });
        warnings.extend(too_much);
    }
    if speeds.iter().any(|s| (s - speeds[0]).abs() > 1.0) {
        warnings.push("the FRFs were measured at different speeds; the first is taken for all".into());
    }
    let responses = sensors(&matrix.responses, &measured.geometry, model)?;
    // An impact without a single point and direction still gives mode shapes, but no FRF to compare.
    let at = |dof: &Dof| sensors(std::slice::from_ref(dof), &measured.geometry, model).ok()?.pop();
    let references: Vec<Option<Sensor>> = matrix.references.iter().map(at).collect();
    let placed: Vec<usize> = (0..references.len()).filter(|&e| references[e].is_some()).collect();
    let (dofs, modes) = modes_of_identified(&found);
    let points = sensors(&dofs, &measured.geometry, model)?;
    let modes = scaled_by_sensor_weight(modes, &points);
    let quantity = |r: usize| {
        let unit = matrix.units[r].first().map(String::as_str).unwrap_or_default();
        identify::quantity_of(unit).unwrap_or(found.quantity)
    };
    let of_placed = |row: &Vec<Vec<Complex64>>| placed.iter().map(|&e| row[e].clone()).collect();
    let frfs = (!placed.is_empty() && added_decay == 0.0).then(|| TargetFrfs {
        frequencies: matrix.frequencies.clone(),
        quantities: (0..responses.len()).map(quantity).collect(),
        responses: unit_directions(&responses),
        references: unit_directions(&references.iter().flatten().cloned().collect::<Vec<_>>()),
        values: matrix.values.iter().map(of_placed).collect(),
        coherence: matrix
            .coherence
            .as_ref()
            .map(|all| all.iter().map(|row| placed.iter().map(|&e| row[e].clone()).collect()).collect()),
    });
    for (_, dof) in references.iter().zip(&matrix.references).filter(|(at, _)| at.is_none()) {
        warnings.push(format!(
            "FRFs under the force {dof} are not compared: its point and direction in the model are not known"
        ));
    }
    let count = matrix.responses.len() * matrix.references.len();
    let source = format!("{} modes identified from {count} FRFs", modes.len());
    let target = Target { speed, sensors: points, modes, frfs };
    let force = measured.scalars.iter().find(|(name, _)| name == super::impact_run::PEAK_FORCE).map(|s| s.1);
    Ok(TestData { target, warnings, left_out: None, source, peak_force: force })
}

/// Removes responses whose FRFs are all zero; returns a warning for each.
fn drop_zero_responses(matrix: &mut FrfMatrix) -> Vec<String> {
    let is_zero = |row: &[Vec<Complex64>]| row.iter().all(|frf| frf.iter().all(|h| h.norm_sqr() == 0.0));
    let dropped: Vec<usize> = (0..matrix.responses.len()).filter(|&r| is_zero(&matrix.values[r])).collect();
    if dropped.len() == matrix.responses.len() {
        return Vec::new();
    }
    for &r in dropped.iter().rev() {
        matrix.values.remove(r);
        matrix.units.remove(r);
        if let Some(coherence) = &mut matrix.coherence {
            coherence.remove(r);
        }
    }
    let name = |&r: &usize| format!("response {} is left out: all its FRFs are zero", matrix.responses[r]);
    let warnings = dropped.iter().map(name).collect();
    let mut place = 0..;
    matrix.responses.retain(|_| place.next().is_none_or(|r| !dropped.contains(&r)));
    warnings
}

/// Measured rotations scaled by the radius that the sensors have for the model's rotations.
fn scaled_by_sensor_weight(mut modes: Vec<TargetMode>, sensors: &[Sensor]) -> Vec<TargetMode> {
    let weight = |s: &Sensor| s.direction.iter().map(|d| d.abs()).fold(0.0, f64::max);
    for mode in &mut modes {
        mode.shape.iter_mut().zip(sensors).for_each(|(value, sensor)| *value *= weight(sensor));
    }
    modes
}

/// Sensors with unit weights: FRFs of rotations are in rad, not scaled by a radius.
fn unit_directions(sensors: &[Sensor]) -> Vec<Sensor> {
    let one = |s: &Sensor| Sensor {
        direction: s.direction.map(|d| if d == 0.0 { 0.0 } else { d.signum() }),
        ..s.clone()
    };
    sensors.iter().map(one).collect()
}

fn modes_of_identified(found: &ModalIdentification) -> (Vec<Dof>, Vec<TargetMode>) {
    let mut dofs = Vec::new();
    let mut modes = Vec::new();
    for mode in &found.modes {
        let (points, shape) = found.larger_side_shape(mode);
        dofs = points.to_vec();
        modes.push(TargetMode {
            frequency_hz: mode.frequency_hz(),
            damping_ratio: Some(mode.damping_ratio()),
            frequency_error: mode.frequency_error,
            damping_error: mode.damping_error,
            shape: shape.to_vec(),
            shape_error: mode.shape_error,
            quality_warnings: mode.quality_warnings.clone(),
        });
    }
    (dofs, modes)
}

/// Modes of a results file of this program as shapes, at every speed; `None` for any other file.
fn from_results_file(path: &Path, limits: &Limits) -> Result<Option<MeasuredData>, Error> {
    let is_hdf5 = matches!(measured::Format::of_extension(path), Some(measured::Format::Hdf5));
    if !is_hdf5 || !path.exists() {
        return Ok(None);
    }
    let store = open_reader(path, limits)?;
    if let Some(frfs) = super::impact_run::impact_frfs(&*store)? {
        return Ok(Some(frfs));
    }
    if !store.contains("/modes/eigenvalue")? || !store.contains("/modes/shapes")? {
        return Ok(None);
    }
    let rpm = store.read("/modes/rpm")?.data;
    let values = store.read_complex("/modes/eigenvalue")?;
    let shapes = store.read_complex("/modes/shapes")?;
    let (speeds, modes, nodes) = match (&values.shape[..], &shapes.shape[..]) {
        (&[speeds, modes], &[of_speeds, of_modes, nodes, 6])
            if speeds == rpm.len() && of_speeds == speeds && of_modes == modes =>
        {
            (speeds, modes, nodes)
        }
        _ => {
            let (values, shapes) = (&values.shape, &shapes.shape);
            let problem = format!(
                "/modes/shapes of shape {shapes:?} does not belong to /modes/eigenvalue of shape {values:?} at {} speeds",
                rpm.len()
            );
            let advice = "compute it again with `rotordyn modal`".into();
            return Err(Error::Content { path: path.into(), problem, advice });
        }
    };
    // Every shape has its own list of points.
    let budget = Budget::of_memory(store.memory());
    let points = speeds.saturating_mul(modes).saturating_mul(nodes);
    budget.take_values::<i64>(|| "the mode shapes".into(), points).map_err(|e| e.of_file(path))?;
    let mut out = MeasuredData::default();
    for (s, rpm) in rpm.iter().enumerate() {
        for k in 0..modes {
            let at = s * modes + k;
            if !values.data[at].im.is_finite() {
                continue;
            }
            out.shapes.push(Shape {
                name: format!("{rpm:.0} rpm mode {}", k + 1),
                analysis: Analysis::ComplexMode {
                    eigenvalue: values.data[at],
                    modal_a: 0.0.into(),
                    modal_b: 0.0.into(),
                },
                number: k as i64 + 1,
                components: 6,
                nodes: (1..=nodes as i64).collect(),
                values: shapes.data[at * nodes * 6..(at + 1) * nodes * 6].to_vec(),
                complex: true,
                unit: "m".into(),
            });
        }
    }
    Ok(Some(out))
}
