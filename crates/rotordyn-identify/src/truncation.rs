//! Truncation error: what the modes outside the band do near its ends that no residual term does.
//!
//! U + V/s² are the first terms of the series of the modes outside; near the end of the band, with a mode just beyond, the next
//! ones are as large. They are fitted with free residues of poles at two distances outside each end, which stand for any smooth
//! course there: the change of the poles and shapes inside, by a Gauss-Newton step, is their truncation error.

use std::f64::consts::TAU;

use super::alternative_mode::{AlternativeMode, measured_shape};
use super::mac::mac;
use super::refine::{FitPoint, Problem};
use rotordyn_linalg::Complex64;

/// Distances of the poles from the end of the band: in the usual decay rate, in widths of the band at least; and in widths.
const NEAR: f64 = 3.0;
const LEAST_NEAR: f64 = 0.02;
const FAR: f64 = 0.15;
/// F statistic of the poles outside from which they are no noise.
const MIN_SIGNIFICANCE: f64 = 4.0;

/// Error of every mode by the modes outside the band.
pub(super) fn truncation_errors(problem: &Problem, at: &FitPoint) -> Vec<AlternativeMode> {
    let none = vec![AlternativeMode::default(); at.poles.len()];
    let outside = poles_outside(problem, at);
    if outside.is_empty() || at.poles.iter().all(|pole| pole.held) {
        return none;
    }
    let Some((with, poles)) = problem.with_outside(at, &outside) else { return none };
    let unknowns = (2 * outside.len() * problem.data().inputs() * problem.data().outputs()) as f64;
    let gain = (at.cost - with.cost) / unknowns;
    if gain.is_nan() || gain < MIN_SIGNIFICANCE * with.residual_variance() {
        return none;
    }
    let error = |m: usize| {
        let (value, moved) = (at.poles[m].value, poles[m].value);
        // Beyond its decay rate a step says no more than that the pole is undetermined.
        let far = (moved - value).norm() > value.re.abs();
        let moved =
            if far { value + (moved - value) * (value.re.abs() / (moved - value).norm()) } else { moved };
        let correlation = mac(&measured_shape(problem, at, m), &measured_shape(problem, &with, m));
        AlternativeMode::new(value, moved, 1.0 - correlation)
    };
    (0..at.poles.len()).map(error).collect()
}

/// Poles outside both ends of the band, where the fit has residual terms.
fn poles_outside(problem: &Problem, at: &FitPoint) -> Vec<Complex64> {
    let data = problem.data();
    let [low, high] = data.band().map(|hz| TAU * hz);
    let mut decays: Vec<f64> = at.poles.iter().map(|pole| pole.value.re.abs()).collect();
    decays.sort_by(f64::total_cmp);
    let Some(&decay) = decays.get(decays.len() / 2) else { return Vec::new() };
    let width = high - low;
    let distances = [(NEAR * decay).max(LEAST_NEAR * width), FAR * width];
    let terms = data.residual_terms;
    let above = distances.iter().filter(|_| terms.has_upper()).map(|by| high + by);
    let below = distances.iter().filter(|by| terms.has_lower() && low > 2.0 * **by).map(|by| low - by);
    above.chain(below).map(|omega| Complex64::new(-decay, omega)).collect()
}
