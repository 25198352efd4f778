//! Static instability (divergence, buckling): motions that grow without oscillation.

use super::critical_speed::nearest_eigenpair;
use super::modal::mass_normalised;
use super::mode::inner;
use crate::assembly::{Assembly, LinearSystem};
use rotordyn_linalg::inertia::negative_eigenvalues;
use rotordyn_linalg::{Complex64, SparseMatrix};

/// A motion that grows without oscillation, q ∝ e^{λt}, λ > 0.
#[derive(Clone, Debug, PartialEq)]
pub struct Divergence {
    /// λ \[1/s\].
    pub rate: f64,
    /// The translation (if none, the rotation) that moves the most, such as "u_x of A".
    pub motion: String,
}

/// Slowest growth that is looked for \[1/s\].
const SLOWEST: f64 = 0.1;
/// Doublings of a growth rate up to its bound, and halvings of the range below the bound.
const DOUBLINGS: usize = 60;
const HALVINGS: usize = 40;
/// |λ|² φᴴMφ over Σ |φᵢ||S_ij||φⱼ| below which λ is round-off.
const ROUND_OFF: f64 = 1e-12;
/// Largest |Im λ|/|λ| of a motion that does not oscillate.
const LEAST_IMAGINARY: f64 = 1e-6;

/// The fastest motion of a system that grows without oscillation; `None` if there is none.
///
/// (λ² M + λ D + S) φ = 0 has no real λ above the one from which on the symmetric part of λ² M + λ D + S has no negative
/// eigenvalue (Sylvester's law of inertia): with symmetric D and S that is the fastest λ, else inverse iteration begins there.
/// A growing oscillation, and motions that gyroscopic moments hold, are none.
pub fn divergence(assembly: &Assembly, system: &LinearSystem) -> Option<Divergence> {
    let none = SparseMatrix::sum(&[(0.0, &system.mass)]);
    let dynamic_stiffness = |rate: f64| {
        SparseMatrix::sum(&[(rate * rate, &system.mass), (rate, &system.damping), (1.0, &system.stiffness)])
    };
    let is_indefinite = |rate: f64| negative_eigenvalues(&dynamic_stiffness(rate), &none) > 0;
    if !is_indefinite(SLOWEST) {
        return None;
    }
    let mut bound =
        (1..DOUBLINGS).map(|k| SLOWEST * f64::from(k as u32).exp2()).find(|rate| !is_indefinite(*rate))?;
    let mut below = 0.5 * bound;
    for _ in 0..HALVINGS {
        let middle = 0.5 * (below + bound);
        if is_indefinite(middle) { below = middle } else { bound = middle }
    }
    let start = slowest_shape(system, &dynamic_stiffness(bound))?;
    let (value, shape) = nearest_eigenpair(system, &(Complex64::from(bound), start))?;
    let forces: f64 =
        system.stiffness.iter().map(|(i, j, v)| shape[i].norm() * v.abs() * shape[j].norm()).sum();
    let inertia = value.norm_sqr() * inner(&shape, &system.mass.mul_complex(&shape)).re;
    let grows = value.re > SLOWEST
        && value.im.abs() <= LEAST_IMAGINARY * value.norm()
        && inertia > ROUND_OFF * forces;
    grows.then(|| Divergence { rate: value.re, motion: largest_motion(assembly, &shape) })
}

/// The shape that a nearly singular matrix resists the least, by inverse iteration.
fn slowest_shape(system: &LinearSystem, matrix: &SparseMatrix) -> Option<Vec<Complex64>> {
    const STEPS: usize = 4;
    let layout = &system.layout;
    let lu = layout.factor::<f64>(layout.scatter(matrix)).ok()?;
    let start: Vec<f64> = (0..layout.size()).map(|i| 1.0 + 0.5 * (i as f64).sin()).collect();
    let mut shape = system.mass.mul(&start);
    for _ in 0..STEPS {
        lu.solve(&mut shape);
        let size = shape.iter().fold(f64::MIN_POSITIVE, |size: f64, v| size.max(v.abs()));
        shape.iter_mut().for_each(|v| *v /= size);
        shape = system.mass.mul(&shape);
    }
    lu.solve(&mut shape);
    Some(mass_normalised(shape.into_iter().map(Complex64::from).collect(), &system.mass))
}

fn largest_motion(assembly: &Assembly, shape: &[Complex64]) -> String {
    let largest = |translation: bool| {
        let own = (0..shape.len()).filter(|&k| (assembly.dofs.free[k] % 6 < 3) == translation);
        own.max_by(|&i, &j| shape[i].norm_sqr().total_cmp(&shape[j].norm_sqr()))
    };
    let size = |k: usize| shape[k].norm();
    let (translation, rotation) = (largest(true), largest(false));
    let moves = translation.filter(|&k| rotation.is_none_or(|other| size(k) > 1e-6 * size(other)));
    moves.or(rotation).map_or_else(String::new, |k| assembly.dofs.name(k))
}
