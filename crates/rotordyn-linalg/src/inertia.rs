//! Number of negative eigenvalues of a banded Hermitian matrix (Sturm sequence count).

use super::{BandLayout, Complex64, SparseMatrix};

/// Pivots below this fraction of the largest entry are replaced by it: an eigenvalue at zero counts as positive.
const SMALLEST_PIVOT: f64 = 1e-15;

/// Number of negative eigenvalues of A + j B, A = Aᵀ, B = −Bᵀ: the negative pivots of L D Lᴴ, without row exchanges
/// (Sylvester's law of inertia).
///
/// Only the symmetric part of `real` and the skew-symmetric part of `imaginary` are used. Round-off may miscount
/// eigenvalues of about 1e-12 of the largest.
pub fn negative_eigenvalues(real: &SparseMatrix, imaginary: &SparseMatrix) -> usize {
    let layout = BandLayout::new(&[real, imaginary]);
    let mut place = vec![usize::MAX; layout.size()];
    layout.groups().map(|group| group_count(real, imaginary, group, &mut place)).sum()
}

fn group_count(real: &SparseMatrix, imaginary: &SparseMatrix, group: &[usize], place: &mut [usize]) -> usize {
    for (p, &i) in group.iter().enumerate() {
        place[i] = p;
    }
    let mut entries: Vec<(usize, usize, Complex64)> = Vec::new();
    for (q, &j) in group.iter().enumerate() {
        for (i, v) in real.column(j) {
            entries.push((place[i], q, Complex64::new(0.5 * v, 0.0)));
            entries.push((q, place[i], Complex64::new(0.5 * v, 0.0)));
        }
        for (i, v) in imaginary.column(j) {
            entries.push((place[i], q, Complex64::new(0.0, 0.5 * v)));
            entries.push((q, place[i], Complex64::new(0.0, -0.5 * v)));
        }
    }
    let half = entries.iter().map(|(i, j, _)| i.abs_diff(*j)).max().unwrap_or(0);
    // Lower triangle: entry (i, j) at row i, column j + half − i.
    let width = half + 1;
    let mut lower = vec![Complex64::default(); group.len() * width];
    for (i, j, v) in entries {
        if i >= j {
            lower[i * width + j + half - i] += v;
        }
    }
    let floor = SMALLEST_PIVOT * lower.iter().map(|v| v.norm()).fold(0.0, f64::max);
    let mut count = 0;
    for k in 0..group.len() {
        let pivot = lower[k * width + half].re;
        let pivot = if pivot.abs() < floor { floor } else { pivot };
        count += usize::from(pivot < 0.0);
        let end = (k + half + 1).min(group.len());
        let column: Vec<Complex64> = (k + 1..end).map(|i| lower[i * width + k + half - i]).collect();
        for (p, left) in column.iter().enumerate() {
            let (i, factor) = (k + 1 + p, left / pivot);
            for (q, right) in column[..=p].iter().enumerate() {
                lower[i * width + k + 1 + q + half - i] -= factor * right.conj();
            }
        }
    }
    count
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Triplets, eigen};
    use nalgebra::DMatrix;

    #[test]
    fn count_agrees_with_the_eigenvalues() {
        let n = 9;
        let mut state = 7_u64;
        let mut random = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 40) as f64 / f64::from(1 << 24) - 0.5
        };
        for _ in 0..40 {
            let (mut a, mut b) = (DMatrix::zeros(n, n), DMatrix::zeros(n, n));
            for i in 0..n {
                for j in 0..=i {
                    if i - j <= 3 {
                        a[(i, j)] = random();
                        a[(j, i)] = a[(i, j)];
                        if i != j {
                            b[(i, j)] = random();
                            b[(j, i)] = -b[(i, j)];
                        }
                    }
                }
            }
            let sparse = |m: &DMatrix<f64>| {
                let mut out = Triplets::new(n, n);
                for i in 0..n {
                    for j in 0..n {
                        out.add(i, j, m[(i, j)]);
                    }
                }
                out.build()
            };
            let (values, _) = eigen::hermitian(&a, &b).unwrap();
            let negative = values.iter().filter(|v| **v < 0.0).count();
            assert_eq!(negative_eigenvalues(&sparse(&a), &sparse(&b)), negative);
        }
    }
}
