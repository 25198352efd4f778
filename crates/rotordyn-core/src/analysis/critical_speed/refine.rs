//! A crossing refined on its own mode: inverse iteration at a speed, secant method over speed.

use crate::analysis::modal::{Eigenpair, mass_normalised};
use crate::analysis::mode::inner;
use crate::assembly::{Assembly, LinearSystem, ModalDamping, PhysicsError};
use rotordyn_linalg::{BandLayout, Complex64};

/// Relative change at which an iteration ends.
const TOLERANCE: f64 = 1e-13;
/// Relative change that is round-off if it does not decrease further.
const ROUND_OFF: f64 = 1e-8;
const MAX_ITERATIONS: usize = 16;
/// Relative changes of shape and λ at which the residual iteration ends, and its shift from λ.
const MAX_SHAPE_CHANGE: f64 = 1e-6;
const MAX_VALUE_CHANGE: f64 = 1e-12;
const RELATIVE_SHIFT: f64 = 1e-4;
/// Relative distance from an eigenvalue that is known, of which others are far.
const KNOWN_SHIFT: f64 = 1e-9;
const MAX_SECANT_STEPS: usize = 20;

/// The eigenpair of P(λ) φ = (λ² M + λ D + S) φ = 0 next to an approximate one; `None` without convergence.
pub(in crate::analysis) fn nearest_eigenpair(system: &LinearSystem, start: &Eigenpair) -> Option<Eigenpair> {
    let (value, mut shape) = start.clone();
    let largest = (0..shape.len()).max_by(|&i, &j| shape[i].norm_sqr().total_cmp(&shape[j].norm_sqr()))?;
    // The mode lies in one group of coupled unknowns.
    let layout = system.layout.restricted_to(&[largest]);
    let mut inside = vec![false; shape.len()];
    layout.groups().flatten().for_each(|&i| inside[i] = true);
    shape.iter_mut().zip(inside).filter(|(_, inside)| !inside).for_each(|(v, _)| *v = Complex64::default());
    match &system.modal {
        None => inverse_iteration(system, &layout, (value, shape)),
        Some(modal) => residual_iteration(system, modal, &layout, (value, shape)),
    }
}

/// The eigenpair of a computed eigenvalue apart from all others, by inverse iteration; `None` with modal damping, which is
/// dense.
pub(super) fn eigenpair_of(system: &LinearSystem, value: Complex64) -> Option<Eigenpair> {
    if system.modal.is_some() {
        return None;
    }
    let [m, d, s] = [&system.mass, &system.damping, &system.stiffness].map(|a| system.layout.scatter(a));
    let mut lu = system.layout.workspace::<Complex64>();
    // At λ itself the matrix may be singular to the last bit.
    let shift = value * (1.0 + KNOWN_SHIFT);
    lu.refactor(|k| shift * shift * m[k] + shift * d[k] + s[k]).ok()?;
    // Inertia forces of a motion of all unknowns, so that every group is excited.
    let start: Vec<f64> = (0..system.layout.size()).map(|i| 1.0 + 0.5 * (i as f64).sin()).collect();
    let mut shape: Vec<Complex64> = system.mass.mul(&start).into_iter().map(Complex64::from).collect();
    for _ in 0..2 {
        lu.solve(&mut shape);
        shape = derivative(system, shift, &mass_normalised(shape, &system.mass));
    }
    lu.solve(&mut shape);
    Some((value, mass_normalised(shape, &system.mass)))
}

/// Newton's method: P(λ) ψ = P'(λ) φ, λ ← λ − (wᴴ φ)/(wᴴ ψ), w = M φ.
fn inverse_iteration(
    system: &LinearSystem,
    layout: &BandLayout,
    (mut value, mut shape): Eigenpair,
) -> Option<Eigenpair> {
    let [m, d, s] = [&system.mass, &system.damping, &system.stiffness].map(|a| layout.scatter(a));
    let mut lu = layout.workspace::<Complex64>();
    let mut last = f64::INFINITY;
    for _ in 0..MAX_ITERATIONS {
        let square = value * value;
        if lu.refactor(|k| square * m[k] + value * d[k] + s[k]).is_err() {
            // λ is an eigenvalue to the last bit.
            return Some((value, shape));
        }
        let mass = system.mass.mul_complex(&shape);
        let mut next = derivative(system, value, &shape);
        lu.solve(&mut next);
        let change = inner(&mass, &shape) / inner(&mass, &next);
        if !(change.re.is_finite() && change.im.is_finite()) {
            return None;
        }
        value -= change;
        shape = mass_normalised(next, &system.mass);
        let size = change.norm() / value.norm();
        if has_converged(size, last) {
            return Some((value, shape));
        }
        last = size;
    }
    None
}

/// P'(λ) φ = (2 λ M + D) φ.
fn derivative(system: &LinearSystem, value: Complex64, shape: &[Complex64]) -> Vec<Complex64> {
    let mass = system.mass.mul_complex(shape);
    mass.iter().zip(system.damp(shape)).map(|(m, d)| 2.0 * value * m + d).collect()
}

/// With modal damping, which is dense: residual inverse iteration φ ← φ − P̃⁻¹ P(λ) φ, φᴴ P(λ) φ = 0. P̃ is the band
/// matrix next to λ with proportional damping of the same ratio there.
/// Source: Neumaier 1985.
fn residual_iteration(
    system: &LinearSystem,
    modal: &ModalDamping,
    layout: &BandLayout,
    (mut value, mut shape): Eigenpair,
) -> Option<Eigenpair> {
    let [m, d, s, k] =
        [&system.mass, &system.damping, &system.stiffness, &modal.stiffness].map(|a| layout.scatter(a));
    let mut lu = layout.workspace::<Complex64>();
    for _ in 0..MAX_ITERATIONS {
        let (mass, damping) = (system.mass.mul_complex(&shape), system.damp(&shape));
        let stiffness = system.stiffness.mul_complex(&shape);
        let [a, b, c] = [&mass, &damping, &stiffness].map(|v| inner(&shape, v));
        let before = value;
        for _ in 0..3 {
            value -= (a * value * value + b * value + c) / (2.0 * a * value + b);
        }
        // At λ itself P̃ would return φ.
        let shift = value * (1.0 + RELATIVE_SHIFT);
        let omega = shift.norm();
        let factor = shift * (modal.ratio(omega) / omega);
        let square = shift * shift;
        lu.refactor(|i| square * m[i] + shift * d[i] + s[i] + factor * (omega * omega * m[i] + k[i])).ok()?;
        let mut rest: Vec<Complex64> =
            (0..shape.len()).map(|i| value * value * mass[i] + value * damping[i] + stiffness[i]).collect();
        lu.solve(&mut rest);
        let [moved, largest] = [&rest, &shape].map(|v| v.iter().map(|v| v.norm()).fold(0.0, f64::max));
        shape.iter_mut().zip(&rest).for_each(|(v, r)| *v -= r);
        shape = mass_normalised(shape, &system.mass);
        let size = (value - before).norm() / value.norm();
        if !size.is_finite() {
            return None;
        }
        // The error of λ is of second order in that of φ.
        // It converges linearly, so that no size can be told from round-off.
        if moved < MAX_SHAPE_CHANGE * largest && size < MAX_VALUE_CHANGE {
            return Some((value, shape));
        }
    }
    None
}

/// Whether a relative change is small enough, or is round-off.
fn has_converged(change: f64, last: f64) -> bool {
    change <= TOLERANCE || change < ROUND_OFF && change > 0.25 * last
}

/// The speed between `from` and `to` where the mode that starts as `start` at a speed has ω_d = n Ω, and its eigenpair there, by
/// the secant method from there and from `trial`; `None` if it leaves the range.
///
/// # Errors
/// Errors of the linearised system.
pub(super) fn crossing(
    (assembly, tangents): (&Assembly, &impl super::Tangents),
    order: f64,
    (start_speed, start): (f64, &Eigenpair),
    trial: f64,
    (from, to): (f64, f64),
) -> Result<Option<(f64, Eigenpair)>, PhysicsError> {
    let gap = |pair: &Eigenpair, speed: f64| pair.0.im - order * speed;
    let mut last = (start_speed, gap(start, start_speed));
    let mut pair = start.clone();
    let mut speed = trial.clamp(from, to);
    let margin = 0.1 * (to - from);
    let mut last_change = f64::INFINITY;
    for _ in 0..MAX_SECANT_STEPS {
        let system = LinearSystem::new(assembly, &tangents(speed)?, speed)?;
        let Some(next) = nearest_eigenpair(&system, &pair) else { return Ok(None) };
        pair = next;
        let now = (speed, gap(&pair, speed));
        // At the start again: as if the frequency did not change with speed.
        let slope = if now.0 == last.0 { -order } else { (now.1 - last.1) / (now.0 - last.0) };
        let step = -now.1 / slope;
        let change = step.abs() / speed;
        if now.1 == 0.0 || has_converged(change, last_change) {
            let inside = speed > from - 1e-9 * to && speed <= to * (1.0 + 1e-9);
            return Ok(inside.then_some((speed, pair)));
        }
        (last, last_change) = (now, change);
        speed += step;
        if !(speed > from - margin && speed < to + margin && speed > 0.0) {
            return Ok(None);
        }
    }
    Ok(None)
}
