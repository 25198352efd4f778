//! Natural frequencies, damping and mode shapes at one speed.

pub use super::mode::Mode;
use super::mode::inner;
use super::mode_kind;
use crate::assembly::{Assembly, LinearSystem, PhysicsError};
use rotordyn_linalg::inertia::negative_eigenvalues;
use rotordyn_linalg::{Complex64, SparseMatrix, krylov};
use std::f64::consts::TAU;

/// Spectral shift of the eigenvalue solver \[rad/s\], below any natural frequency of interest.
pub const SHIFT: f64 = 30.0;

/// The lowest `count` oscillatory modes, by natural frequency; rigid-body and overdamped modes are omitted.
///
/// Labels number the modes below the one labelled, so that they depend neither on `count` nor on other speeds.
///
/// # Errors
/// An eigenvalue computation that fails.
pub fn modes(assembly: &Assembly, system: &LinearSystem, count: usize) -> Result<Vec<Mode>, PhysicsError> {
    let mut modes = modes_of(assembly, system, eigenpairs(assembly, system, count)?);
    modes.truncate(count);
    Ok(modes)
}

/// Modes of the lowest eigenpairs, by natural frequency, with kinds and labels.
pub(super) fn modes_of(assembly: &Assembly, system: &LinearSystem, mut pairs: Vec<Eigenpair>) -> Vec<Mode> {
    align_double_modes(assembly, system, &mut pairs);
    let mut modes: Vec<Mode> =
        pairs.into_iter().map(|(value, shape)| mode_kind::characterise(assembly, value, shape)).collect();
    if system.speed == 0.0 && system.stiffness.is_symmetric(SYMMETRIC) {
        modes.iter_mut().for_each(mode_kind::name_by_plane);
    }
    mode_kind::label(assembly, &mut modes);
    modes
}

/// Largest difference of two opposite entries of a symmetric stiffness, over those of the diagonal.
const SYMMETRIC: f64 = 1e-6;

/// Eigenvalue λ and shape φ over the free DOFs, φᴴ M φ = 1.
pub(super) type Eigenpair = (Complex64, Vec<Complex64>);

/// The eigenpairs of the lowest `count` oscillatory modes, by natural frequency, and one more.
///
/// The additional one keeps the two modes of a double eigenvalue at the end together.
///
/// # Errors
/// As [`modes`].
pub(super) fn eigenpairs(
    assembly: &Assembly,
    system: &LinearSystem,
    count: usize,
) -> Result<Vec<Eigenpair>, PhysicsError> {
    let failed = |reason: String| PhysicsError::Eigen { speed_rpm: system.speed * 60.0 / TAU, reason };
    let [m, d, s] = [&system.mass, &system.damping, &system.stiffness];
    let dense = system.modal.as_ref().map(|modal| &modal.matrix);
    let mut pairs = krylov::lowest_eigenpairs_with([m, d, s], dense, &system.layout, count, SHIFT)
        .map_err(|e| failed(e.to_string()))?;
    pairs.truncate(count + 1);
    Ok(pairs.into_iter().map(|p| (p.value, mass_normalised(p.vector, &assembly.mass))).collect())
}

/// Number of undamped modes with frequencies below ω \[rad/s\], rigid-body modes counted, by Sylvester's law of inertia: that of
/// the negative eigenvalues of K − ω² M + jω Ω G. Damping and the skew-symmetric part of S are left out.
pub(super) fn undamped_modes_below(system: &LinearSystem, omega: f64) -> usize {
    let real = SparseMatrix::sum(&[(1.0, &system.stiffness), (-omega * omega, &system.mass)]);
    negative_eigenvalues(&real, &SparseMatrix::sum(&[(omega, &system.damping)]))
}

/// The lowest eigenpairs, at least `count`, raised until the last lies at |λ| = `reach` of those found or beyond.
///
/// # Errors
/// As [`modes`].
pub(super) fn eigenpairs_up_to(
    assembly: &Assembly,
    system: &LinearSystem,
    mut count: usize,
    reach: impl Fn(&[Eigenpair]) -> f64,
) -> Result<Vec<Eigenpair>, PhysicsError> {
    loop {
        let pairs = eigenpairs(assembly, system, count)?;
        let reach = reach(&pairs);
        if pairs.get(count - 1).is_none_or(|last| last.0.norm() >= reach) {
            return Ok(pairs);
        }
        count += 4 + count / 2;
    }
}

/// The undamped modes of a system: C and the circulatory part dropped, gyroscopic effect kept.
///
/// # Errors
/// As [`modes`].
pub fn undamped_modes(
    assembly: &Assembly,
    system: &LinearSystem,
    count: usize,
) -> Result<Vec<Mode>, PhysicsError> {
    modes(assembly, &undamped(assembly, system), count)
}

/// The system without damping: D = Ω G, S = K.
pub fn undamped(assembly: &Assembly, system: &LinearSystem) -> LinearSystem {
    let damping = SparseMatrix::sum(&[(system.speed, &assembly.gyroscopic)]);
    let stiffness = SparseMatrix::sum(&[(1.0, &system.stiffness), (-system.speed, &assembly.circulatory)]);
    LinearSystem::with_matrices(assembly, system.speed, [damping, stiffness], None)
}

/// φ scaled to φᴴ M φ = 1.
pub(super) fn mass_normalised(mut shape: Vec<Complex64>, mass: &SparseMatrix) -> Vec<Complex64> {
    let size = inner(&shape, &mass.mul_complex(&shape)).re.sqrt();
    if size > 0.0 {
        shape.iter_mut().for_each(|v| *v /= size);
    }
    shape
}

/// Eigenvalues closer than this relative distance may be a repeated (double) eigenvalue split by round-off.
const MAX_DOUBLE_SPLIT: f64 = 1e-5;
/// They are if combined shapes solve (λ² M + λ D + S) φ = 0 with one common λ to this fraction of λ² M φ.
const MAX_DOUBLE_RESIDUAL: f64 = 1e-7;

/// Rotates the modes of a double eigenvalue into one with the most and one with the least energy along x.
///
/// An axisymmetric rotor at rest has such pairs; an eigenvalue solver returns arbitrary linear combinations.
fn align_double_modes(assembly: &Assembly, system: &LinearSystem, pairs: &mut [(Complex64, Vec<Complex64>)]) {
    let mut k = 0;
    while k + 1 < pairs.len() {
        let (a, b) = (pairs[k].0, pairs[k + 1].0);
        if (a - b).norm() > MAX_DOUBLE_SPLIT * a.norm() {
            k += 1;
            continue;
        }
        let mass = &assembly.mass;
        let first = pairs[k].1.clone();
        let overlap = inner(&mass.mul_complex(&first), &pairs[k + 1].1);
        let rest = pairs[k + 1].1.iter().zip(&first).map(|(v, f)| v - f * overlap).collect();
        let second = mass_normalised(rest, mass);
        // Hermitian 2×2 of the energy along x: turn by its eigenvectors.
        let along_x = |v: &[Complex64]| {
            let mut full = assembly.dofs.expand_complex(v);
            for (i, v) in full.iter_mut().enumerate() {
                if i % 6 != 0 && i % 6 != 4 {
                    *v = Complex64::default();
                }
            }
            full
        };
        let (p, q) = (along_x(&first), along_x(&second));
        let (mp, mq) = (assembly.full_mass.mul_complex(&p), assembly.full_mass.mul_complex(&q));
        let (e11, e22, e12) = (inner(&p, &mp).re, inner(&q, &mq).re, inner(&p, &mq));
        let turn = 0.5 * (2.0 * e12.norm()).atan2(e11 - e22);
        let phase = if e12.norm() > 0.0 { e12.conj() / e12.norm() } else { Complex64::new(1.0, 0.0) };
        let (sin, cos) = turn.sin_cos();
        let x: Vec<Complex64> = first.iter().zip(&second).map(|(f, s)| f * cos + s * phase * sin).collect();
        let y: Vec<Complex64> = first.iter().zip(&second).map(|(f, s)| s * phase * cos - f * sin).collect();
        if projected_residual(system, 0.5 * (a + b), [&x, &y]) > MAX_DOUBLE_RESIDUAL {
            k += 1;
            continue;
        }
        (pairs[k].1, pairs[k + 1].1) = (x, y);
        k += 2;
    }
}

/// Index of the other mode of each mode's double eigenvalue, if any; modes sorted by natural frequency.
pub fn double_eigenvalue_partners(system: &LinearSystem, modes: &[Mode]) -> Vec<Option<usize>> {
    let mut out = vec![None; modes.len()];
    for k in 1..modes.len() {
        let [a, b] = [&modes[k - 1], &modes[k]];
        let near = (a.eigenvalue - b.eigenvalue).norm() <= MAX_DOUBLE_SPLIT * a.natural_omega();
        let value = 0.5 * (a.eigenvalue + b.eigenvalue);
        if near
            && out[k - 1].is_none()
            && projected_residual(system, value, [&a.shape, &b.shape]) <= MAX_DOUBLE_RESIDUAL
        {
            (out[k - 1], out[k]) = (Some(k), Some(k - 1));
        }
    }
    out
}

/// The mode with another shape of its double eigenvalue; kind and label are kept.
pub fn with_shape(assembly: &Assembly, mode: &Mode, shape: Vec<Complex64>) -> Mode {
    let described = mode_kind::characterise(assembly, mode.eigenvalue, shape);
    Mode { kind: mode.kind, label: mode.label.clone(), ..described }
}

/// Largest |φᵢᴴ (λ² M + λ D + S) φⱼ| / |λ|² of shapes with φᴴ M φ = 1.
///
/// The projection is insensitive to round-off in the stiffest components of the shapes.
fn projected_residual(system: &LinearSystem, value: Complex64, shapes: [&[Complex64]; 2]) -> f64 {
    let mut largest: f64 = 0.0;
    for right in shapes {
        let [m, s] = [&system.mass, &system.stiffness].map(|matrix| matrix.mul_complex(right));
        let d = system.damp(right);
        for left in shapes {
            let rest = value * value * inner(left, &m) + value * inner(left, &d) + inner(left, &s);
            largest = largest.max(rest.norm() / value.norm_sqr());
        }
    }
    largest
}
