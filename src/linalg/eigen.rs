//! Dense eigenvalue problems.

use super::Complex64;
use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::evd::{self, ComputeEigenvectors, SelfAdjointEvdParams};
use faer::{Auto, Par, Spec};
use nalgebra::{Cholesky, DMatrix, DVector};

/// Why an eigenvalue computation failed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum EigenError {
    #[error("the iteration did not converge")]
    NoConvergence,
    #[error("the mass matrix is not positive definite")]
    NotDefinite,
    #[error("a matrix holds a value that is not finite")]
    NotFinite,
    #[error("the shifted matrix is singular")]
    SingularShift,
}

/// Eigenvalues and right eigenvectors (columns) of a general real matrix, in no given order.
///
/// # Errors
/// No convergence, or entries that are not finite.
pub fn general(a: &DMatrix<f64>) -> Result<(Vec<Complex64>, DMatrix<Complex64>), EigenError> {
    if a.iter().any(|v| !v.is_finite()) {
        return Err(EigenError::NotFinite);
    }
    let n = a.nrows();
    let source = faer::Mat::from_fn(n, n, |i, j| a[(i, j)]);
    let pairs = faer::linalg::solvers::Eigen::new_from_real(source.as_ref())
        .map_err(|_| EigenError::NoConvergence)?;
    let values = (0..n).map(|i| Complex64::new(pairs.S()[i].re, pairs.S()[i].im)).collect();
    let vectors = DMatrix::from_fn(n, n, |i, j| Complex64::new(pairs.U()[(i, j)].re, pairs.U()[(i, j)].im));
    Ok((values, vectors))
}

/// Eigenvalues (ascending) and orthonormal eigenvectors (columns) of a real symmetric matrix.
///
/// # Errors
/// No convergence, or entries that are not finite.
pub fn symmetric(a: &DMatrix<f64>) -> Result<(DVector<f64>, DMatrix<f64>), EigenError> {
    if a.iter().any(|v| !v.is_finite()) {
        return Err(EigenError::NotFinite);
    }
    let n = a.nrows();
    let source = faer::Mat::from_fn(n, n, |i, j| 0.5 * (a[(i, j)] + a[(j, i)]));
    // The divide-and-conquer path of faer 0.24 loses eigenvectors of graded spectra with double
    // eigenvalues (residual 1.7e-4 at n = 248), which is every axisymmetric rotor: force the QR path.
    let mut params: SelfAdjointEvdParams = Auto::<f64>::auto();
    params.recursion_threshold = usize::MAX;
    let params: Spec<SelfAdjointEvdParams, f64> = params.into();
    let mut values = faer::diag::Diag::<f64>::zeros(n);
    let mut vectors = faer::Mat::<f64>::zeros(n, n);
    let scratch = evd::self_adjoint_evd_scratch::<f64>(n, ComputeEigenvectors::Yes, Par::Seq, params);
    evd::self_adjoint_evd(
        source.as_ref(),
        values.as_mut(),
        Some(vectors.as_mut()),
        Par::Seq,
        MemStack::new(&mut MemBuffer::new(scratch)),
        params,
    )
    .map_err(|_| EigenError::NoConvergence)?;
    Ok((DVector::from_fn(n, |i, _| values[i]), DMatrix::from_fn(n, n, |i, j| vectors[(i, j)])))
}

/// Undamped modes K φ = ω² M φ: ω² ascending and φ with φᵀ M φ = 1.
///
/// Solved as M φ = μ (K + σ M) φ, ω² = 1/μ − σ, which keeps the low modes accurate whatever the
/// stiffest element; σ \[rad²/s²\] must make K + σ M positive definite (1 will do for any
/// structure held or free).
///
/// # Errors
/// A matrix that is not positive definite, no convergence, or entries that are not finite.
pub fn undamped(
    k: &DMatrix<f64>,
    m: &DMatrix<f64>,
    sigma: f64,
) -> Result<(Vec<f64>, DMatrix<f64>), EigenError> {
    let n = k.nrows();
    let lower = Cholesky::new(k + m * sigma).ok_or(EigenError::NotDefinite)?.unpack();
    let half = lower.solve_lower_triangular(m).ok_or(EigenError::NotDefinite)?;
    let inverse = lower.solve_lower_triangular(&half.transpose()).ok_or(EigenError::NotDefinite)?;
    let (mu, vectors) = symmetric(&inverse)?;
    let mut shapes = lower.transpose().solve_upper_triangular(&vectors).ok_or(EigenError::NotDefinite)?;
    let order: Vec<usize> = (0..n).rev().collect();
    if mu.iter().any(|&m| m <= 0.0) {
        return Err(EigenError::NotDefinite);
    }
    for (j, mut column) in shapes.column_iter_mut().enumerate() {
        // zᵀ z = 1 gives φᵀ M φ = μ.
        column /= mu[j].sqrt();
    }
    Ok((order.iter().map(|&i| 1.0 / mu[i] - sigma).collect(), shapes.select_columns(&order)))
}

/// All eigenpairs of (λ² M + λ C + K) φ = 0: λ and φ, in no given order.
///
/// The state matrix is balanced by measuring time in units of T, since faer does not balance:
/// \[0, I; −M⁻¹K T², −M⁻¹C T\] has eigenvalues λ T.
///
/// # Errors
/// As [`general`], and a mass matrix that is not positive definite.
pub fn quadratic(
    m: &DMatrix<f64>,
    c: &DMatrix<f64>,
    k: &DMatrix<f64>,
) -> Result<Vec<(Complex64, Vec<Complex64>)>, EigenError> {
    let n = m.nrows();
    let mass = Cholesky::new(m.clone()).ok_or(EigenError::NotDefinite)?;
    let (stiff, damp) = (mass.solve(k), mass.solve(c));
    // The highest frequency is about the root of the largest row sum.
    let fastest = stiff.row_iter().map(|r| r.iter().map(|v| v.abs()).sum::<f64>()).fold(0.0, f64::max);
    let t = if fastest > 0.0 { 1.0 / fastest.sqrt() } else { 1.0 };
    let mut state = DMatrix::zeros(2 * n, 2 * n);
    state.view_mut((0, n), (n, n)).fill_with_identity();
    state.view_mut((n, 0), (n, n)).copy_from(&(stiff * (-t * t)));
    state.view_mut((n, n), (n, n)).copy_from(&(damp * -t));
    let (values, vectors) = general(&state)?;
    Ok(values
        .iter()
        .enumerate()
        .map(|(j, &v)| (v / t, vectors.column(j).iter().take(n).copied().collect()))
        .collect())
}

/// Eigenvalues (ascending) and orthonormal eigenvectors (columns) of the Hermitian matrix A + j B.
///
/// Solved as the real symmetric \[A, −B; B, A\], which has every eigenvalue twice.
///
/// # Errors
/// As [`symmetric`].
pub fn hermitian(a: &DMatrix<f64>, b: &DMatrix<f64>) -> Result<(Vec<f64>, DMatrix<Complex64>), EigenError> {
    let n = a.nrows();
    let mut real = DMatrix::zeros(2 * n, 2 * n);
    real.view_mut((0, 0), (n, n)).copy_from(a);
    real.view_mut((n, n), (n, n)).copy_from(a);
    real.view_mut((0, n), (n, n)).copy_from(&-b);
    real.view_mut((n, 0), (n, n)).copy_from(b);
    let (values, vectors) = symmetric(&real)?;
    // (x, y) and (−y, x) stand for v = x + j y and j v; of vectors with one value keep those that are
    // independent over the complex numbers.
    let mut kept: Vec<(f64, nalgebra::DVector<Complex64>)> = Vec::with_capacity(n);
    for (value, column) in values.iter().zip(vectors.column_iter()) {
        let mut v = nalgebra::DVector::from_fn(n, |i, _| Complex64::new(column[i], column[n + i]));
        for (_, other) in kept.iter().rev().take(4) {
            let part = other.dotc(&v);
            v.axpy(-part, other, Complex64::new(1.0, 0.0));
        }
        let length = v.norm();
        if length > 0.5 && kept.len() < n {
            kept.push((*value, v.unscale(length)));
        }
    }
    if kept.len() < n {
        return Err(EigenError::NoConvergence);
    }
    let vectors = DMatrix::from_fn(n, n, |i, j| kept[j].1[i]);
    Ok((kept.iter().map(|k| k.0).collect(), vectors))
}
