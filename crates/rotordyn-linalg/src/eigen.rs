//! Dense eigenvalue problems.

pub use super::eigen_error::EigenError;
use super::{BandLayout, Complex64, SparseMatrix, hessenberg};
use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::evd::{self, ComputeEigenvectors, EvdParams, SelfAdjointEvdParams};
use faer::linalg::triangular_solve::{solve_lower_triangular_in_place, solve_upper_triangular_in_place};
use faer::{Auto, Par, Spec};
use nalgebra::{Cholesky, DMatrix, DVector};

/// Eigenvalues and right eigenvectors (columns) of a general real matrix, in no given order.
///
/// By faer; where its iteration does not converge, as in clusters of eigenvalues far from normal that damping β K makes at
/// −1/β, by `HessenbergForm`; so are vectors that do not satisfy their equation, as faer's of nearly equal pairs.
///
/// # Errors
/// No convergence, or entries that are not finite.
pub fn general(a: &DMatrix<f64>) -> Result<(Vec<Complex64>, DMatrix<Complex64>), EigenError> {
    if a.iter().any(|v| !v.is_finite()) {
        return Err(EigenError::NotFinite);
    }
    let n = a.nrows();
    let source = faer::Mat::from_fn(n, n, |i, j| a[(i, j)]);
    let params: Spec<EvdParams, f64> = Spec::default();
    let (mut re, mut im) = (faer::diag::Diag::<f64>::zeros(n), faer::diag::Diag::<f64>::zeros(n));
    let mut u = faer::Mat::<f64>::zeros(n, n);
    let (no, yes) = (ComputeEigenvectors::No, ComputeEigenvectors::Yes);
    let scratch = evd::evd_scratch::<f64>(n, no, yes, Par::Seq, params);
    // Sequential: faer's threads spin while waiting, which is very slow when all cores are busy.
    let solved = evd::evd_real(
        source.as_ref(),
        re.as_mut(),
        im.as_mut(),
        None,
        Some(u.as_mut()),
        Par::Seq,
        MemStack::new(&mut MemBuffer::new(scratch)),
        params,
    );
    if solved.is_err() {
        return HessenbergForm::new(a).eigenpairs();
    }
    let values: Vec<Complex64> = (0..n).map(|j| Complex64::new(re[j], im[j])).collect();
    // Columns j, j + 1 contain the real and the imaginary part of the first vector of a conjugate pair.
    let mut vectors = DMatrix::zeros(n, n);
    let mut j = 0;
    while j < n {
        let paired = im[j] != 0.0 && j + 1 < n;
        for i in 0..n {
            if paired {
                vectors[(i, j)] = Complex64::new(u[(i, j)], u[(i, j + 1)]);
                vectors[(i, j + 1)] = Complex64::new(u[(i, j)], -u[(i, j + 1)]);
            } else {
                vectors[(i, j)] = u[(i, j)].into();
            }
        }
        j += if paired { 2 } else { 1 };
    }
    replace_wrong_vectors(a, &values, &mut vectors);
    Ok((values, vectors))
}

/// A = Q H Qᵀ with an upper Hessenberg matrix H.
struct HessenbergForm {
    q: DMatrix<f64>,
    h: DMatrix<f64>,
}

impl HessenbergForm {
    fn new(a: &DMatrix<f64>) -> Self {
        let (q, h) = nalgebra::Hessenberg::new(a.clone()).unpack();
        Self { q, h }
    }

    /// As [`general`]: eigenvalues of H by QR steps, each eigenvector by inverse iteration.
    ///
    /// Slower than a Schur form, and the vectors of an eigenvalue that occurs several times are alike.
    fn eigenpairs(&self) -> Result<(Vec<Complex64>, DMatrix<Complex64>), EigenError> {
        let values = hessenberg::eigenvalues(&self.h)?;
        let mut vectors = DMatrix::zeros(self.h.nrows(), values.len());
        for (value, mut vector) in values.iter().zip(vectors.column_iter_mut()) {
            vector.copy_from_slice(&self.eigenvector(*value));
        }
        Ok((values, vectors))
    }

    fn eigenvector(&self, value: Complex64) -> Vec<Complex64> {
        multiply(&self.q, &hessenberg::nearest_eigenvector(&self.h, value))
    }
}

/// Largest residual of an eigenpair of n rows, relative to n, round-off, and the lengths of matrix and vector.
const MAX_RESIDUAL: f64 = 1e3;

/// Replaces the eigenvectors that do not satisfy A x = θ x.
fn replace_wrong_vectors(a: &DMatrix<f64>, values: &[Complex64], vectors: &mut DMatrix<Complex64>) {
    let largest = MAX_RESIDUAL * a.nrows() as f64 * f64::EPSILON * a.norm();
    let [re, im] = [a * vectors.map(|v| v.re), a * vectors.map(|v| v.im)];
    let mut form = None;
    for (j, value) in values.iter().enumerate() {
        let mut x = vectors.column_mut(j);
        let rest = x
            .iter()
            .enumerate()
            .map(|(i, x)| (Complex64::new(re[(i, j)], im[(i, j)]) - value * x).norm_sqr());
        if rest.sum::<f64>().sqrt() > largest * x.norm() {
            x.copy_from_slice(&form.get_or_insert_with(|| HessenbergForm::new(a)).eigenvector(*value));
        }
    }
}

/// Steps for each row before the iteration of the Schur form gives up; three are usual.
const SCHUR_STEPS: usize = 20;

/// Eigenpairs of a small real matrix with Im θ ≥ 0 (one of each conjugate pair), in no given order.
///
/// By the real Schur form A = Q T Qᵀ of nalgebra, several times faster than faer below a hundred rows; by [`general`] where its
/// iteration does not converge, as in clusters of eigenvalues far from normal.
///
/// # Errors
/// No convergence, or entries that are not finite.
pub fn general_small(a: &DMatrix<f64>) -> Result<Vec<(Complex64, Vec<Complex64>)>, EigenError> {
    if a.iter().any(|v| !v.is_finite()) {
        return Err(EigenError::NotFinite);
    }
    let n = a.nrows();
    let Some(schur) = nalgebra::Schur::try_new(a.clone(), f64::EPSILON, SCHUR_STEPS * n) else {
        let (values, vectors) = general(a)?;
        let pairs = values.into_iter().zip(vectors.column_iter()).filter(|(theta, _)| theta.im >= 0.0);
        return Ok(pairs.map(|(theta, vector)| (theta, vector.iter().copied().collect())).collect());
    };
    let (q, t) = schur.unpack();
    let mut pairs = Vec::with_capacity(n);
    let mut k = 0;
    while k < n {
        let paired = k + 1 < n && t[(k + 1, k)] != 0.0;
        let mut y = vec![Complex64::default(); n];
        let value;
        if paired {
            // [a b; c d] has θ = m ± √(m² − ad + bc), m = (a + d)/2, and the eigenvector (b, θ − a).
            let (a, b, c, d) = (t[(k, k)], t[(k, k + 1)], t[(k + 1, k)], t[(k + 1, k + 1)]);
            let root = Complex64::new(0.25 * (a - d) * (a - d) + b * c, 0.0).sqrt();
            value = 0.5 * (a + d) + root;
            (y[k], y[k + 1]) = if b != 0.0 { (b.into(), value - a) } else { (value - d, c.into()) };
            if root.im == 0.0 {
                // A block with two real eigenvalues: add the other one here.
                let other = 0.5 * (a + d) - root;
                let mut z = vec![Complex64::default(); n];
                (z[k], z[k + 1]) = if b != 0.0 { (b.into(), other - a) } else { (other - d, c.into()) };
                back_substitute(&t, other, k, &mut z);
                pairs.push((other, multiply(&q, &z)));
            }
        } else {
            value = t[(k, k)].into();
            y[k] = 1.0.into();
        }
        back_substitute(&t, value, k, &mut y);
        pairs.push((value, multiply(&q, &y)));
        k += if paired { 2 } else { 1 };
    }
    Ok(pairs)
}

/// Fills y above row k so that (T − θ) y = 0, T quasi upper triangular (2×2 diagonal blocks).
fn back_substitute(t: &DMatrix<f64>, value: Complex64, k: usize, y: &mut [Complex64]) {
    let n = t.nrows();
    let smallest = f64::EPSILON * t.amax();
    // A multiple eigenvalue would divide by zero; perturbed as in LAPACK.
    let safe = |v: Complex64| if v.norm() < smallest { smallest.into() } else { v };
    let mut i = k;
    while i > 0 {
        i -= 1;
        let load = |row: usize, from: usize| (from..n).map(|j| y[j] * t[(row, j)]).sum::<Complex64>();
        if i > 0 && t[(i, i - 1)] != 0.0 {
            let rows = [
                [t[(i - 1, i - 1)] - value, t[(i - 1, i)].into(), -load(i - 1, i + 1)],
                [t[(i, i - 1)].into(), t[(i, i)] - value, -load(i, i + 1)],
            ];
            [y[i - 1], y[i]] = solve_two(rows, safe);
            i -= 1;
        } else {
            y[i] = -load(i, i + 1) / safe(t[(i, i)] - value);
        }
    }
}

/// Solution of two equations [a, b, right side], by elimination with complete pivoting.
///
/// If the block has the same eigenvalue, both rows are linearly dependent; Cramer's rule would give 0/0.
fn solve_two(mut rows: [[Complex64; 3]; 2], safe: impl Fn(Complex64) -> Complex64) -> [Complex64; 2] {
    let places = [(0, 0), (0, 1), (1, 0), (1, 1)];
    let (row, column) = places
        .into_iter()
        .fold((0, 0), |a, b| if rows[b.0][b.1].norm() > rows[a.0][a.1].norm() { b } else { a });
    rows.swap(0, row);
    let (p, q) = (column, 1 - column);
    let pivot = safe(rows[0][p]);
    let factor = rows[1][p] / pivot;
    let mut x = [Complex64::default(); 2];
    x[q] = (rows[1][2] - factor * rows[0][2]) / safe(rows[1][q] - factor * rows[0][q]);
    x[p] = (rows[0][2] - rows[0][q] * x[q]) / pivot;
    x
}

/// Q y.
fn multiply(q: &DMatrix<f64>, y: &[Complex64]) -> Vec<Complex64> {
    let mut out = vec![Complex64::default(); q.nrows()];
    for (column, y) in q.column_iter().zip(y) {
        for (o, q) in out.iter_mut().zip(column.iter()) {
            *o += y * *q;
        }
    }
    out
}

/// Eigenvalues (ascending) and orthonormal eigenvectors (columns) of a real symmetric matrix.
///
/// # Errors
/// No convergence, or entries that are not finite.
pub fn symmetric(a: &DMatrix<f64>) -> Result<(DVector<f64>, DMatrix<f64>), EigenError> {
    if a.iter().any(|v| !v.is_finite()) {
        return Err(EigenError::NotFinite);
    }
    let (values, vectors) = symmetric_of(&faer::Mat::from_fn(a.nrows(), a.nrows(), |i, j| a[(i, j)]))?;
    let n = values.len();
    Ok((DVector::from_vec(values), DMatrix::from_fn(n, n, |i, j| vectors[(i, j)])))
}

/// As [`symmetric`]; the entries must be finite.
fn symmetric_of(a: &faer::Mat<f64>) -> Result<(Vec<f64>, faer::Mat<f64>), EigenError> {
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
    Ok(((0..n).map(|i| values[i]).collect(), vectors))
}

/// Undamped modes K φ = ω² M φ: ω² ascending and φ with φᵀ M φ = 1.
///
/// Solved as M φ = μ (K + σ M) φ, ω² = 1/μ − σ, which keeps the low modes accurate whatever the
/// stiffest element; σ \[rad²/s²\] must make K + σ M positive definite (1 suffices for any
/// constrained or free structure).
///
/// # Errors
/// A matrix that is not positive definite, no convergence, or entries that are not finite.
pub fn undamped(
    k: &DMatrix<f64>,
    m: &DMatrix<f64>,
    sigma: f64,
) -> Result<(Vec<f64>, DMatrix<f64>), EigenError> {
    let n = k.nrows();
    let mut modes: Vec<(f64, Vec<f64>)> = Vec::with_capacity(n);
    let layout = BandLayout::new(&[&SparseMatrix::from_dense(k), &SparseMatrix::from_dense(m)]);
    for group in layout.groups() {
        let mut unknowns = group.to_vec();
        unknowns.sort_unstable();
        let part = |a: &DMatrix<f64>| {
            faer::Mat::from_fn(unknowns.len(), unknowns.len(), |i, j| a[(unknowns[i], unknowns[j])])
        };
        let (squares, shapes) = undamped_group(&part(k), &part(m), sigma)?;
        for (square, shape) in squares.into_iter().zip(shapes.col_iter()) {
            let mut all = vec![0.0; n];
            unknowns.iter().zip(shape.iter()).for_each(|(&i, v)| all[i] = *v);
            modes.push((square, all));
        }
    }
    modes.sort_by(|a, b| a.0.total_cmp(&b.0));
    let shapes = DMatrix::from_fn(n, n, |i, j| modes[j].1[i]);
    Ok((modes.into_iter().map(|(square, _)| square).collect(), shapes))
}

/// The modes of one set of coupled unknowns.
fn undamped_group(
    k: &faer::Mat<f64>,
    m: &faer::Mat<f64>,
    sigma: f64,
) -> Result<(Vec<f64>, faer::Mat<f64>), EigenError> {
    let n = k.nrows();
    let shifted = faer::Mat::from_fn(n, n, |i, j| k[(i, j)] + sigma * m[(i, j)]);
    if shifted.as_ref().col_iter().any(|column| column.iter().any(|v| !v.is_finite())) {
        return Err(EigenError::NotFinite);
    }
    let factor = shifted.llt(faer::Side::Lower).map_err(|_| EigenError::NotDefinite)?;
    let lower = factor.L();
    // L⁻¹ M L⁻ᵀ.
    let mut half = m.clone();
    solve_lower_triangular_in_place(lower, half.as_mut(), Par::Seq);
    let mut inverse = half.transpose().to_owned();
    solve_lower_triangular_in_place(lower, inverse.as_mut(), Par::Seq);
    let (mu, mut shapes) = symmetric_of(&inverse)?;
    if mu.iter().any(|&mu| mu <= 0.0) {
        return Err(EigenError::NotDefinite);
    }
    solve_upper_triangular_in_place(lower.transpose(), shapes.as_mut(), Par::Seq);
    for (shape, mu) in shapes.as_mut().col_iter_mut().zip(&mu) {
        // zᵀ z = 1 gives φᵀ M φ = μ.
        shape.iter_mut().for_each(|v| *v /= mu.sqrt());
    }
    Ok((mu.iter().map(|mu| 1.0 / mu - sigma).collect(), shapes))
}

/// All eigenpairs of (λ² M + λ C + K) φ = 0: λ and φ, in no given order.
///
/// The state matrix is balanced by scaling time with T, since faer does not balance:
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
    // The highest frequency is about the square root of the largest row sum.
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
    // (x, y) and (−y, x) represent v = x + j y and j v; of vectors with the same eigenvalue keep those that
    // are linearly independent over the complex numbers.
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

#[cfg(test)]
mod tests {
    use super::*;

    /// The eigenvalues of both ways agree, and every vector satisfies its equation.
    #[test]
    fn the_hessenberg_form_has_the_eigenpairs_of_the_matrix() {
        let mut seed = 7_u64;
        let graded = DMatrix::from_fn(40, 40, |i, j| {
            seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            ((seed >> 11) as f64 / (1u64 << 52) as f64 - 1.0) * 0.8_f64.powi((i + j) as i32 / 2)
        });
        let (mut expected, _) = general(&graded).unwrap();
        let (values, vectors) = HessenbergForm::new(&graded).eigenpairs().unwrap();
        for (value, vector) in values.iter().zip(vectors.column_iter()) {
            let distance = |k: &usize| (expected[*k] - value).norm();
            let nearest = (0..expected.len()).min_by(|a, b| distance(a).total_cmp(&distance(b))).unwrap();
            assert!(distance(&nearest) < 1e-11 * graded.norm(), "{value}");
            expected.swap_remove(nearest);
            let rest = graded.map(Complex64::from) * vector - vector * *value;
            assert!(rest.norm() < 1e-12 * graded.norm() * vector.norm(), "{value}: {:e}", rest.norm());
        }
    }
}
