//! FRF residuals of a model update: selection of lines and their weights.

use rayon::prelude::*;

use super::UpdateFailure;
use super::data_kind::DataKind;
use super::residual_rows::ResidualRows;
use super::state::ModelState;
use super::target::{Sensor, TargetFrfs};
use rotordyn_core::analysis::sensitivity::{FrfSensitivity, SystemDerivative, frf_sensitivity};
use rotordyn_linalg::{Complex64, SparseRow};

/// Settings of the FRF fit.
///
/// Residual of a line: ln|H_computed/H_measured|, and with `complex` also the phase difference \[rad\]; for
/// small errors the two are the complex difference over |H|. Logarithmic residuals weight resonances and
/// antiresonances equally and grow steadily with their distance, so that the fit converges from e.g. housings
/// twice too stiff. A floor a of 2 % of the largest response to the same force is added to both |H| in
/// squares: cross-axis sensitivity and misaligned hits limit the accuracy of measured antiresonances and of
/// the plane perpendicular to the force.
///
/// A line's variance is n σ² + (1 − γ²)/(2 γ²). The first term is the model error: it is correlated over
/// neighbouring lines and all FRFs at the same resonance, so that the n numbers within a fifth of a frequency
/// count as one, however fine the lines. The second is the random error of a single average by the coherence
/// γ²: an upper bound, as the number of averages is unknown.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FrfFitting {
    pub complex: bool,
    /// σ of ln|H| and of the phase.
    pub deviation: f64,
    /// Band \[Hz\].
    pub band: [f64; 2],
}

/// Default σ, about 1 dB: the error at a resonance from a damping known to 10 %.
pub const DEFAULT_DEVIATION: f64 = 0.1;

impl FrfFitting {
    /// Settings for a band with the default σ.
    pub fn new(complex: bool, band: [f64; 2]) -> Self {
        Self { complex, deviation: DEFAULT_DEVIATION, band }
    }
}

/// Minimum coherence of a fitted line; below it the noise floor dominates the FRF.
const MIN_COHERENCE: f64 = 0.5;
/// Cross-axis floor of all responses, relative to the largest one.
const CROSS_AXIS_FLOOR: f64 = 0.02;
/// Relative bandwidth over which the model error is correlated.
const MODEL_ERROR_BANDWIDTH: f64 = 0.2;
/// Maximum number of fitted lines.
const MAX_LINES: usize = 300;

/// FRF residuals with their derivatives.
///
/// # Errors
/// A singular dynamic stiffness.
pub(super) fn frf_rows(
    state: &ModelState,
    measured: &TargetFrfs,
    fitting: &FrfFitting,
    by: &[&SystemDerivative],
    rows: &mut ResidualRows,
) -> Result<(), UpdateFailure> {
    let lines = selected_lines(measured, fitting.band);
    let found = computed(state, measured, &lines, by)?;
    let shared = correlated_counts(measured, &lines, fitting.complex);
    for (r, e) in frf_indices(measured) {
        for (k, &line) in lines.iter().enumerate().filter(|(_, line)| is_usable_line(measured, r, e, **line))
        {
            let seen = LineResidual::new(found.values[r][e][k], measured.values[r][e][line], {
                CROSS_AXIS_FLOOR * largest_response(measured, r, e, line)
            });
            let model = fitting.deviation.powi(2);
            let noise = random_error_variance(measured, r, e, line) * seen.share;
            let variance = shared[k] * model + noise;
            let size = variance.sqrt();
            let data = (model + noise) / variance * if fitting.complex { 2.0 } else { 1.0 };
            rows.count(DataKind::Frf, data);
            let slopes = || found.derivatives.iter().map(|s| s[r][e][k]);
            rows.push(
                DataKind::Frf,
                seen.magnitude() / size,
                slopes().map(|s| seen.magnitude_derivative(s) / size),
            );
            if fitting.complex {
                let (apart, slope) = (seen.phase_residual() / size, |s| seen.phase_derivative(s) / size);
                rows.push(DataKind::Frf, apart.re, slopes().map(|s| slope(s).re));
                rows.push(DataKind::Frf, apart.im, slopes().map(|s| slope(s).im));
            }
        }
    }
    Ok(())
}

/// Computed h and measured m at a line, with the cross-axis floor a.
struct LineResidual {
    h: Complex64,
    /// √(|h|² + a²).
    size: f64,
    /// m/√(|m|² + a²).
    measured: Complex64,
    /// √(|m|² + a²).
    measured_size: f64,
    /// |m|²/(|m|² + a²).
    share: f64,
}

impl LineResidual {
    fn new(h: Complex64, m: Complex64, a: f64) -> Self {
        let [size, measured_size] = [h, m].map(|v| v.norm().hypot(a));
        let measured = m / measured_size;
        Self { h, size, measured, measured_size, share: measured.norm_sqr() }
    }

    /// ln √(|h|² + a²)/√(|m|² + a²).
    fn magnitude(&self) -> f64 {
        (self.size / self.measured_size).ln()
    }

    fn magnitude_derivative(&self, slope: Complex64) -> f64 {
        (self.h.conj() * slope).re / self.size.powi(2)
    }

    /// Phase residual h/√(|h|² + a²) − m/√(|m|² + a²), relative to arg m; 2 sin Δφ/2 if both exceed a.
    fn phase_residual(&self) -> Complex64 {
        (self.h / self.size - self.measured) * self.phase_reference()
    }

    fn phase_derivative(&self, slope: Complex64) -> Complex64 {
        (slope - self.h * self.magnitude_derivative(slope)) / self.size * self.phase_reference()
    }

    fn phase_reference(&self) -> Complex64 {
        self.measured.conj() / self.measured.norm()
    }
}

/// Number of FRF data in the fit.
pub(super) fn data_count(measured: &TargetFrfs, fitting: &FrfFitting) -> usize {
    let lines = selected_lines(measured, fitting.band);
    let of = |k: &usize| frf_indices(measured).filter(|&(r, e)| is_usable_line(measured, r, e, *k)).count();
    lines.iter().map(of).sum::<usize>() * if fitting.complex { 2 } else { 1 }
}

/// RMS of 20 log(|H_computed|/|H_measured|) \[dB\] over the fitted lines; `computed` contains all lines. FRFs that are zero
/// in the model, of directions that it does not couple, have no level and are left out.
pub fn rms_difference_db(
    measured: &TargetFrfs,
    computed: &[Vec<Vec<Complex64>>],
    fitting: &FrfFitting,
) -> f64 {
    let lines = selected_lines(measured, fitting.band);
    let (mut sum, mut count) = (0.0, 0);
    let coupled = frf_indices(measured).filter(|&(r, e)| is_coupled(computed, r, e));
    for (r, e, &line) in coupled.flat_map(|(r, e)| lines.iter().map(move |line| (r, e, line))) {
        if is_usable_line(measured, r, e, line) {
            let a = CROSS_AXIS_FLOOR * largest_response(measured, r, e, line);
            let apart = LineResidual::new(computed[r][e][line], measured.values[r][e][line], a).magnitude();
            sum += (20.0 * std::f64::consts::LOG10_E * apart).powi(2);
            count += 1;
        }
    }
    (sum / f64::from(count.max(1))).sqrt()
}

/// Whether a computed FRF is more than round-off of the largest one under the same force.
pub(super) fn is_coupled(computed: &[Vec<Vec<Complex64>>], r: usize, e: usize) -> bool {
    const ROUND_OFF: f64 = 1e-9;
    let largest = |r: usize| computed[r][e].iter().map(|h| h.norm()).fold(0.0, f64::max);
    largest(r) > ROUND_OFF * (0..computed.len()).map(largest).fold(0.0, f64::max)
}

/// Every response with every reference.
pub(super) fn frf_indices(measured: &TargetFrfs) -> impl Iterator<Item = (usize, usize)> + use<> {
    let references = measured.references.len();
    (0..measured.responses.len()).flat_map(move |r| (0..references).map(move |e| (r, e)))
}

/// The model's FRFs at some of the measured lines, chunk by chunk.
fn computed(
    state: &ModelState,
    measured: &TargetFrfs,
    lines: &[usize],
    by: &[&SystemDerivative],
) -> Result<FrfSensitivity, UpdateFailure> {
    const CHUNK: usize = 32;
    let of = |sensors: &[Sensor]| -> Vec<SparseRow> {
        sensors.iter().map(|s| s.row(&state.linearised.assembly)).collect()
    };
    let (responses, references) = (of(&measured.responses), of(&measured.references));
    let frequencies: Vec<f64> = lines.iter().map(|&k| measured.frequencies[k]).collect();
    let parts: Vec<FrfSensitivity> = frequencies
        .par_chunks(CHUNK)
        .map(|f| frf_sensitivity(&state.linearised, f, &references, &responses, &measured.quantities, by))
        .collect::<Result<_, _>>()?;
    let joined = |of: &dyn Fn(&FrfSensitivity, usize, usize) -> Vec<Complex64>| -> Vec<Vec<Vec<Complex64>>> {
        let one = |r: usize, e: usize| parts.iter().flat_map(|p| of(p, r, e)).collect();
        (0..responses.len()).map(|r| (0..references.len()).map(|e| one(r, e)).collect()).collect()
    };
    Ok(FrfSensitivity {
        values: joined(&|p, r, e| p.values[r][e].clone()),
        derivatives: (0..by.len()).map(|k| joined(&|p, r, e| p.derivatives[k][r][e].clone())).collect(),
    })
}

/// Whether a line of an FRF is usable: nonzero and of sufficient coherence.
pub(super) fn is_usable_line(measured: &TargetFrfs, r: usize, e: usize, line: usize) -> bool {
    let clear = measured.coherence.as_ref().is_none_or(|c| c[r][e][line] >= MIN_COHERENCE);
    clear && measured.values[r][e][line].norm_sqr() > 0.0
}

/// Largest |H| at a line for the same reference, over responses of the same kind.
fn largest_response(measured: &TargetFrfs, r: usize, e: usize, line: usize) -> f64 {
    let turns = |r: usize| measured.responses[r].direction[3..].iter().any(|d| *d != 0.0);
    let kind = |r: usize| (measured.quantities[r], turns(r));
    let same_kind = (0..measured.responses.len()).filter(|&other| kind(other) == kind(r));
    same_kind.map(|other| measured.values[other][e][line].norm()).fold(0.0, f64::max)
}

/// Random error variance of ln|H| and of the phase by the coherence, for one average; 0 without coherence.
fn random_error_variance(measured: &TargetFrfs, r: usize, e: usize, line: usize) -> f64 {
    measured.coherence.as_ref().map_or(0.0, |c| {
        let coherence = c[r][e][line].clamp(MIN_COHERENCE, 1.0);
        (1.0 - coherence) / (2.0 * coherence)
    })
}

/// Number of data within a fifth of every line's frequency (correlated model error).
fn correlated_counts(measured: &TargetFrfs, lines: &[usize], complex: bool) -> Vec<f64> {
    let at = |line: usize| {
        frf_indices(measured).filter(|&(r, e)| is_usable_line(measured, r, e, line)).count() as f64
            * if complex { 2.0 } else { 1.0 }
    };
    let counts: Vec<f64> = lines.iter().map(|&line| at(line)).collect();
    let log: Vec<f64> = lines.iter().map(|&line| measured.frequencies[line].ln()).collect();
    log.iter()
        .map(|centre| {
            let near = |other: &f64| (other - centre).abs() <= 0.5 * MODEL_ERROR_BANDWIDTH;
            let sum: f64 = log.iter().zip(&counts).filter(|(l, _)| near(l)).map(|(_, n)| n).sum();
            sum.max(1.0)
        })
        .collect()
}

/// Lines within the band: all, or if too many, half of them uniformly and half where magnitudes change most,
/// near resonances and antiresonances.
fn selected_lines(measured: &TargetFrfs, [from, to]: [f64; 2]) -> Vec<usize> {
    let all: Vec<usize> = (0..measured.frequencies.len())
        .filter(|&k| (from..=to).contains(&measured.frequencies[k]) && measured.frequencies[k] > 0.0)
        .collect();
    if all.len() <= MAX_LINES {
        return all;
    }
    let change = |pair: &[usize]| {
        let mut sum = 0.0;
        for (r, e) in
            frf_indices(measured).filter(|&(r, e)| pair.iter().all(|&k| is_usable_line(measured, r, e, k)))
        {
            let [a, b] = [pair[0], pair[1]].map(|k| measured.values[r][e][k].norm());
            sum += (b / a).ln().abs();
        }
        sum
    };
    let changes: Vec<f64> = all.windows(2).map(change).collect();
    let total = changes.iter().sum::<f64>().max(f64::MIN_POSITIVE);
    let even = 1.0 / changes.len() as f64;
    let mut out = vec![all[0]];
    let (mut passed, mut next) = (0.0, 1.0);
    for (change, &line) in changes.iter().zip(&all[1..]) {
        passed += 0.5 * (even + change / total) * (MAX_LINES - 1) as f64;
        if passed >= next - 1e-9 {
            out.push(line);
            next = passed.floor() + 1.0;
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn derivatives_match_differences_also_at_a_zero() {
        let c = Complex64::new;
        for h in [c(3.0, -2.0), c(1e-3, 2e-3), c(0.0, 0.0)] {
            let (m, a, slope, step) = (c(-0.2, 0.5), 0.1, c(0.7, -0.4), 1e-6);
            let [low, here, high] = [-step, 0.0, step].map(|x| LineResidual::new(h + slope * x, m, a));
            let magnitude = (high.magnitude() - low.magnitude()) / (2.0 * step);
            assert!((here.magnitude_derivative(slope) - magnitude).abs() < 1e-7);
            let apart = (high.phase_residual() - low.phase_residual()) / (2.0 * step);
            assert!((here.phase_derivative(slope) - apart).norm() < 1e-7);
        }
        let (seen, turned) =
            (LineResidual::new(c(0.0, 2.0), c(2.0, 0.0), 1e-9), 2.0 * (0.25 * std::f64::consts::PI).sin());
        assert!((seen.phase_residual().norm() - turned).abs() < 1e-12 && seen.magnitude().abs() < 1e-12);
    }

    #[test]
    fn line_selection_concentrates_at_resonances() {
        let frequencies: Vec<f64> = (0..4000).map(|k| 0.1 * f64::from(k)).collect();
        let h = |f: f64| 1.0 / Complex64::new(2500.0 - f * f, 2.0 * 0.005 * 50.0 * f);
        let point = |direction| Sensor {
            dof: rotordyn_signal::record::Dof::new(1, direction),
            anchor: rotordyn_core::element::Anchor::node(0),
            direction: [1.0, 0.0, 0.0, 0.0, 0.0, 0.0],
        };
        let measured = TargetFrfs {
            responses: vec![point(1)],
            references: vec![point(1)],
            quantities: vec![rotordyn_signal::Quantity::Displacement],
            values: vec![vec![frequencies.iter().map(|f| h(*f)).collect()]],
            coherence: None,
            frequencies,
        };
        let chosen = selected_lines(&measured, [5.0, 300.0]);
        assert!((250..=MAX_LINES).contains(&chosen.len()), "{}", chosen.len());
        let within = |low: f64, high: f64| {
            chosen.iter().filter(|&&k| (low..=high).contains(&measured.frequencies[k])).count()
        };
        // The upper half of the peak has a sixth of the total variation of ln|H|; 1 Hz elsewhere half a line.
        assert!(within(49.5, 50.5) >= 10 && within(200.0, 210.0) >= 5, "{chosen:?}");
        let few = TargetFrfs { frequencies: measured.frequencies[..200].to_vec(), ..measured.clone() };
        assert_eq!(selected_lines(&few, [5.0, 300.0]).len(), 150);
    }
}
