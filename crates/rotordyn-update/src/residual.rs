//! Residuals (weighted differences of model and measurement) with their derivatives.

use super::residual_rows::ResidualRows;

use super::UpdateFailure;
use super::data_kind::DataKind;
use super::frf::{FrfFitting, frf_rows};
use super::least_squares::Evaluation;
use super::state::ModelState;
use super::target::{Target, TargetMode};
use rotordyn_core::analysis::modal::Mode;
use rotordyn_core::analysis::sensitivity::{ModeSensitivity, SystemDerivative};
use rotordyn_core::assembly::PhysicsError;
use rotordyn_identify::mac::dot;
use rotordyn_linalg::{Complex64, SparseRow};

/// Fitted quantities, each with its minimum standard deviation; `None` is not fitted.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fitting {
    /// Of ln f: model error, 1e-3.
    pub frequency: Option<f64>,
    /// Of ln ζ.
    pub damping: Option<f64>,
    /// Of √(1 − MAC): 0.05.
    pub shape: Option<f64>,
    pub frf: Option<FrfFitting>,
}

impl Fitting {
    /// Whether modal data are fitted, which require paired modes.
    pub fn modes(&self) -> bool {
        self.frequency.is_some() || self.damping.is_some() || self.shape.is_some()
    }
}

impl Default for Fitting {
    fn default() -> Self {
        Self { frequency: Some(1e-3), damping: None, shape: Some(0.05), frf: None }
    }
}

/// Weighted residuals and their derivatives, of the measured modes `kept` and of the FRFs.
///
/// Shapes give r = (m − α s)/σ with |m| = 1 and the optimal modal scale factor α: |r|²σ² is 1 − MAC, but r
/// has a nonzero derivative at MAC = 1.
///
/// # Errors
/// A mode of `kept` that is not paired, or without derivative.
pub fn evaluate_residuals(
    state: &ModelState,
    target: &Target,
    fitting: &Fitting,
    fitted_modes: &[usize],
    by: &[SystemDerivative],
) -> Result<Evaluation, UpdateFailure> {
    let by: Vec<&SystemDerivative> = by.iter().collect();
    let mut rows = ResidualRows::default();
    for &k in fitted_modes.iter().filter(|_| fitting.modes()) {
        let measured = &target.modes[k];
        let found = state.pairing.pairs.iter().find(|p| p.measured == k);
        let Some(place) = found.map(|p| p.computed) else {
            let reason = format!("the measured mode at {:.3} Hz is no longer paired", measured.frequency_hz);
            return Err(PhysicsError::NoDerivative { reason }.into());
        };
        mode_rows(state, &state.modes[place], place, measured, fitting, &by, &mut rows)?;
    }
    if let (Some(frf), Some(measured)) = (&fitting.frf, &target.frfs) {
        frf_rows(state, measured, frf, &by, &mut rows)?;
    }
    Ok(rows.evaluation(by.len()))
}

fn mode_rows(
    state: &ModelState,
    mode: &Mode,
    place: usize,
    measured: &TargetMode,
    fitting: &Fitting,
    by: &[&SystemDerivative],
    rows: &mut ResidualRows,
) -> Result<(), UpdateFailure> {
    let value = mode.eigenvalue;
    let system = &state.linearised.system;
    let sensitivity = match state.repeated[place] {
        Some(other) => {
            ModeSensitivity::of_double_eigenvalue(system, value, &mode.shape, &state.modes[other].shape)?
        }
        None => ModeSensitivity::new(system, value, &mode.shape)?,
    };
    let slopes: Vec<Complex64> = by.iter().map(|by| sensitivity.eigenvalue_derivative(by)).collect();
    if let Some(least) = fitting.frequency {
        let deviation = least.max(measured.frequency_error / measured.frequency_hz);
        let residual = (mode.frequency_hz() / measured.frequency_hz).ln() / deviation;
        rows.push(DataKind::Frequency, residual, slopes.iter().map(|s| s.im / value.im / deviation));
        rows.count(DataKind::Frequency, 1.0);
    }
    if let (Some(least), Some(zeta)) = (fitting.damping, measured.damping_ratio.filter(|z| *z > 0.0)) {
        let deviation = least.max(measured.damping_error / zeta);
        let own = mode.zeta().max(1e-9);
        // ζ = −a/|λ|: dζ = −da/|λ| + a Re(λ* dλ)/|λ|³.
        let slope = |s: &Complex64| {
            let size = value.norm();
            (-s.re / size + value.re * (value.conj() * s).re / size.powi(3)) / own / deviation
        };
        rows.push(DataKind::Damping, (own / zeta).ln() / deviation, slopes.iter().map(slope));
        rows.count(DataKind::Damping, 1.0);
    }
    if let Some(least) = fitting.shape
        && measured.shape.len() > 1
    {
        // All points together count as one datum, √(1 − MAC)/σ.
        let changes = sensitivity.shape_derivatives(by)?;
        let deviation = least.max(measured.shape_error);
        shape_rows(&state.sensor_rows, &state.shapes[place], &measured.shape, &changes, deviation, rows);
        rows.count(DataKind::Shape, 1.0);
    }
    Ok(())
}

fn shape_rows(
    sensors: &[SparseRow],
    computed: &[Complex64],
    measured: &[Complex64],
    changes: &[Vec<Complex64>],
    deviation: f64,
    rows: &mut ResidualRows,
) {
    let size = dot(measured, measured).re.sqrt();
    let own = dot(computed, computed).re;
    if size == 0.0 || own == 0.0 {
        return;
    }
    let m: Vec<Complex64> = measured.iter().map(|v| v / size).collect();
    let alpha = dot(computed, &m) / own;
    let slopes: Vec<Vec<Complex64>> = changes
        .iter()
        .map(|change| {
            let s: Vec<Complex64> = sensors.iter().map(|row| row.dot_complex(change)).collect();
            let turned = (dot(&s, &m) - alpha * 2.0 * dot(&s, computed).re) / own;
            computed.iter().zip(&s).map(|(c, s)| -(turned * c + alpha * s)).collect()
        })
        .collect();
    for (i, (m, c)) in m.iter().zip(computed).enumerate() {
        let residual = m - alpha * c;
        rows.push(DataKind::Shape, residual.re / deviation, slopes.iter().map(|s| s[i].re / deviation));
        rows.push(DataKind::Shape, residual.im / deviation, slopes.iter().map(|s| s[i].im / deviation));
    }
}
