//! Products and QR of tall matrices by blocks of rows, in parallel, summed in a fixed order (reproducible).

use nalgebra::{Cholesky, DMatrix};
use rayon::prelude::*;

/// Rows of a block; sums over blocks are in order, so that results do not depend on the number of threads.
const BLOCK: usize = 2048;

fn blocks(rows: usize) -> Vec<(usize, usize)> {
    (0..rows).step_by(BLOCK).map(|start| (start, BLOCK.min(rows - start))).collect()
}

/// Aᵀ B.
pub(super) fn tr_mul(a: &DMatrix<f64>, b: &DMatrix<f64>) -> DMatrix<f64> {
    let part = |(start, count): (usize, usize)| a.rows(start, count).transpose() * b.rows(start, count);
    let parts: Vec<DMatrix<f64>> = blocks(a.nrows()).into_par_iter().map(part).collect();
    parts.into_iter().fold(DMatrix::zeros(a.ncols(), b.ncols()), |sum, part| sum + part)
}

/// A B for a tall A and a small B.
pub(super) fn mul(a: &DMatrix<f64>, b: &DMatrix<f64>) -> DMatrix<f64> {
    let parts: Vec<(usize, DMatrix<f64>)> =
        blocks(a.nrows()).into_par_iter().map(|(start, count)| (start, a.rows(start, count) * b)).collect();
    let mut out = DMatrix::zeros(a.nrows(), b.ncols());
    for (start, part) in parts {
        out.rows_mut(start, part.nrows()).copy_from(&part);
    }
    out
}

/// Thin QR of a matrix with columns scaled to unit length: Q, R and the lengths; A = Q R diag(lengths).
///
/// CholeskyQR2 (Yamamoto et al. 2015): Cholesky factor of AᵀA, twice; as orthogonal as Householder QR up to a
/// condition number of about 1e7, and matrix products only; Householder QR beyond that.
pub(super) fn thin_qr(mut a: DMatrix<f64>) -> (DMatrix<f64>, DMatrix<f64>, Vec<f64>) {
    let sizes: Vec<f64> = a.column_iter().map(|c| c.norm().max(f64::MIN_POSITIVE)).collect();
    for (mut column, size) in a.column_iter_mut().zip(&sizes) {
        column /= *size;
    }
    let half = |a: &DMatrix<f64>| -> Option<(DMatrix<f64>, DMatrix<f64>)> {
        let r = Cholesky::new(tr_mul(a, a))?.unpack().transpose();
        let diagonal = r.diagonal();
        if diagonal.min() < 1e-7 * diagonal.max() {
            return None;
        }
        let inverse = r.solve_upper_triangular(&DMatrix::identity(r.nrows(), r.nrows()))?;
        Some((mul(a, &inverse), r))
    };
    let twice = || {
        let (first, r1) = half(&a)?;
        let (q, r2) = half(&first)?;
        Some((q, r2 * r1))
    };
    let (q, r) = twice().unwrap_or_else(|| {
        let qr = a.clone().qr();
        (qr.q(), qr.r())
    });
    (q, r, sizes)
}

/// Least squares A x = y by the normal equations of columns scaled to unit length: fast, for candidates.
///
/// `None` if two columns are linearly dependent to round-off.
pub(super) fn solve_normal_equations(mut a: DMatrix<f64>, y: &DMatrix<f64>) -> Option<DMatrix<f64>> {
    let sizes: Vec<f64> = a.column_iter().map(|c| c.norm()).collect();
    for (mut column, size) in a.column_iter_mut().zip(&sizes) {
        if *size > 0.0 {
            column /= *size;
        }
    }
    let transposed = a.transpose();
    let mut gram = &transposed * &a;
    for k in 0..gram.nrows() {
        // Diagonal regularisation for columns equal to round-off, as of coincident poles.
        gram[(k, k)] += 1e-13;
    }
    let mut x = Cholesky::new(gram)?.solve(&(&transposed * y));
    for (mut row, size) in x.row_iter_mut().zip(&sizes) {
        row /= size.max(f64::MIN_POSITIVE);
    }
    Some(x)
}

/// Back substitution R⁻¹ z over the lengths of the columns; unknowns determined by round-off alone are zero.
pub(super) fn back_substitute(r: &DMatrix<f64>, sizes: &[f64], mut z: DMatrix<f64>) -> DMatrix<f64> {
    let mut regularised = r.clone();
    for k in 0..regularised.nrows() {
        if regularised[(k, k)].abs() < 1e-14 {
            regularised[(k, k)] = f64::INFINITY;
        }
    }
    for mut column in z.column_iter_mut() {
        for row in (0..regularised.nrows()).rev() {
            let known: f64 = (row + 1..regularised.nrows()).map(|j| regularised[(row, j)] * column[j]).sum();
            column[row] = (column[row] - known) / regularised[(row, row)];
        }
    }
    for (mut row, size) in z.row_iter_mut().zip(sizes) {
        row /= *size;
    }
    z
}
