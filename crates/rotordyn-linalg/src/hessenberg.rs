//! Eigenvalues and single eigenvectors of an upper Hessenberg matrix, as the Arnoldi iteration makes it.
//!
//! Cheaper than a whole decomposition where few of the eigenvectors are wanted.

use super::{Complex64, eigen_error::EigenError};
use nalgebra::DMatrix;

/// Steps for each row of the matrix, all together, before the iteration gives up: three are usual, but two close pairs far
/// from normal may take a hundred. After every tenth for one eigenvalue the shifts are unusual ones.
const MAX_STEPS: usize = 60;
const UNUSUAL: usize = 10;
/// Steps for one eigenvalue after which subdiagonal elements are neglected that are round-off of the whole matrix, not of their
/// neighbours alone: a cluster far from normal may keep them at that.
const PATIENCE: usize = 40;
/// Solutions of the inverse iteration: the first is close already, since the eigenvalue is exact but for round-off.
const SOLUTIONS: usize = 2;
/// Largest residual of the recurrence, relative to the eigenvalue and the length of the vector.
const MAX_RESIDUAL: f64 = 1e-12;

/// Eigenvalues of an upper Hessenberg matrix, by the implicit double-shift QR iteration on the active block.
///
/// Source: Francis 1961; Golub & Van Loan, Matrix Computations, section 7.5.
///
/// # Errors
/// No convergence, or entries that are not finite.
pub fn eigenvalues(h: &DMatrix<f64>) -> Result<Vec<Complex64>, EigenError> {
    if h.iter().any(|v| !v.is_finite()) {
        return Err(EigenError::NotFinite);
    }
    let mut h = h.clone();
    let (smallest, whole) = (f64::EPSILON * h.amax(), h.norm());
    let mut values = Vec::with_capacity(h.nrows());
    let mut end = h.nrows();
    let (mut steps, mut all) = (0, 0);
    while end > 0 {
        let least_size = if steps < PATIENCE { smallest } else { whole };
        let start = start_of_active_block(&mut h, end, least_size);
        match end - start {
            1 => values.push(h[(start, start)].into()),
            2 => values.extend(eigenvalues_of_two(&h, start)),
            _ if all == MAX_STEPS * h.nrows() => return Err(EigenError::NoConvergence),
            _ => {
                (steps, all) = (steps + 1, all + 1);
                let shifts = shifts(&h, &(start..end), steps);
                double_shift_step(&mut h, start..end, shifts);
                continue;
            }
        }
        (end, steps) = (start, 0);
    }
    Ok(values)
}

/// Sets negligible subdiagonal elements to zero; the first row of the last block without one.
///
/// Negligible is what round-off is of the elements next to it: of those on the diagonal, which a pair without real part does
/// not have, and of the neighbours on the subdiagonal.
fn start_of_active_block(h: &mut DMatrix<f64>, end: usize, smallest: f64) -> usize {
    for row in (1..end).rev() {
        let before = if row > 1 { h[(row - 1, row - 2)].abs() } else { 0.0 };
        let after = if row + 1 < end { h[(row + 1, row)].abs() } else { 0.0 };
        let size = h[(row - 1, row - 1)].abs() + h[(row, row)].abs() + before + after;
        if h[(row, row - 1)].abs() <= f64::EPSILON * size.max(smallest) {
            h[(row, row - 1)] = 0.0;
            return row;
        }
    }
    0
}

/// Eigenvalues of the 2×2 block that begins at a row.
fn eigenvalues_of_two(h: &DMatrix<f64>, k: usize) -> [Complex64; 2] {
    let (a, b, c, d) = (h[(k, k)], h[(k, k + 1)], h[(k + 1, k)], h[(k + 1, k + 1)]);
    let (mean, half) = (0.5 * (a + d), 0.5 * (a - d));
    let square = half * half + b * c;
    if square < 0.0 {
        let im = (-square).sqrt();
        return [Complex64::new(mean, im), Complex64::new(mean, -im)];
    }
    // The larger one first, the other without cancellation.
    let large = mean + square.sqrt().copysign(mean);
    let small = if large == 0.0 { 0.0 } else { (a * d - b * c) / large };
    [large.into(), small.into()]
}

/// The two shifts, both real or a conjugate pair: the eigenvalues of the last 2×2 block, or twice the one nearest to the last element if
/// both are real.
///
/// Unusual ones are of the size of the subdiagonal about the last element of the diagonal and the first one by turns.
/// Source: LAPACK, dlahqr.
fn shifts(h: &DMatrix<f64>, block: &std::ops::Range<usize>, step: usize) -> [Complex64; 2] {
    let (p, q) = (block.end - 2, block.end - 1);
    if step.is_multiple_of(UNUSUAL) {
        let (about, size) = if (step / UNUSUAL).is_multiple_of(2) {
            let first = block.start;
            (h[(first, first)], h[(first + 1, first)].abs() + h[(first + 2, first + 1)].abs())
        } else {
            (h[(q, q)], h[(q, p)].abs() + h[(p, p - 1)].abs())
        };
        // Eigenvalues of [m, −0.4375 size; size, m] with m = about + 0.75 size.
        let pair = Complex64::new(about + 0.75 * size, 0.4375_f64.sqrt() * size);
        return [pair, pair.conj()];
    }
    let [one, other] = eigenvalues_of_two(h, p);
    if one.im == 0.0 {
        let last = h[(q, q)];
        return [if (one.re - last).abs() <= (other.re - last).abs() { one } else { other }; 2];
    }
    [one, other]
}

/// H ← Qᵀ H Q on the active block, the first column of Q being that of (H − s₁)(H − s₂), formed from differences: in a
/// cluster they are all that is left.
fn double_shift_step(h: &mut DMatrix<f64>, block: std::ops::Range<usize>, [s1, s2]: [Complex64; 2]) {
    let (first, end) = (block.start, block.end);
    let [a, b, c, d] = [(0, 0), (0, 1), (1, 0), (1, 1)].map(|(i, j)| h[(first + i, first + j)]);
    let (to_one, to_other) = (a - s1.re, a - s2.re);
    let mut x = [
        to_one * to_other - s1.im * s2.im + b * c,
        c * (to_one + (d - s2.re)),
        c * h[(first + 2, first + 1)],
    ];
    for k in first..end - 1 {
        let rows = (end - k).min(3);
        let (v, factor) = reflector(x, rows);
        if factor != 0.0 {
            let from = if k > first { k - 1 } else { k };
            for j in from..end {
                let column = &mut h.column_mut(j).data.into_slice_mut()[k..k + rows];
                let part = factor * column.iter().zip(&v).map(|(h, v)| h * v).sum::<f64>();
                column.iter_mut().zip(&v).for_each(|(h, v)| *h -= part * v);
            }
            reflect_columns(h, first..(k + 4).min(end), k, &v[..rows], factor);
        }
        if k > first {
            // Exactly zero below the subdiagonal.
            (1..rows).for_each(|i| h[(k + i, k - 1)] = 0.0);
        }
        x = std::array::from_fn(|i| if k + 1 + i < end { h[(k + 1 + i, k)] } else { 0.0 });
    }
}

/// v and β of I − β v vᵀ, which turns the first `rows` elements of x to (∓‖x‖, 0, 0).
fn reflector(x: [f64; 3], rows: usize) -> ([f64; 3], f64) {
    let scale = x[..rows].iter().fold(0.0_f64, |m, v| m.max(v.abs()));
    if scale == 0.0 {
        return ([0.0; 3], 0.0);
    }
    let mut v = x.map(|x| x / scale);
    v[rows..].fill(0.0);
    let length = v.iter().map(|v| v * v).sum::<f64>().sqrt();
    v[0] += length.copysign(v[0]);
    (v, 2.0 / v.iter().map(|v| v * v).sum::<f64>())
}

/// Columns k, k + 1 … of some rows times I − β v vᵀ.
fn reflect_columns(h: &mut DMatrix<f64>, rows: std::ops::Range<usize>, k: usize, v: &[f64], factor: f64) {
    let n = h.nrows();
    let columns = &mut h.as_mut_slice()[k * n..(k + v.len()) * n];
    let (one, rest) = columns.split_at_mut(n);
    let (two, three) = rest.split_at_mut(n);
    let (one, two) = (&mut one[rows.clone()], &mut two[rows.clone()]);
    if let [v0, v1, v2] = *v {
        for ((a, b), c) in one.iter_mut().zip(two).zip(&mut three[rows]) {
            let part = factor * (*a * v0 + *b * v1 + *c * v2);
            (*a, *b, *c) = (*a - part * v0, *b - part * v1, *c - part * v2);
        }
    } else {
        for (a, b) in one.iter_mut().zip(two) {
            let part = factor * (*a * v[0] + *b * v[1]);
            (*a, *b) = (*a - part * v[0], *b - part * v[1]);
        }
    }
}

/// The eigenvector of an upper Hessenberg matrix that belongs to a computed eigenvalue θ, of length 1.
///
/// By recurrence through the rows, from the last one up; where the first row is not satisfied then, by inverse iteration.
pub fn eigenvector(h: &DMatrix<f64>, theta: Complex64) -> Vec<Complex64> {
    recurrence(h, theta).unwrap_or_else(|| nearest_eigenvector(h, theta))
}

/// Solution of rows n − 1 to 1 of (H − θ) y = 0 with yₙ = 1; `None` unless row 0 is satisfied too.
///
/// Source: Hyman's method; Wilkinson, The Algebraic Eigenvalue Problem, 1965, section 7.11.
fn recurrence(h: &DMatrix<f64>, theta: Complex64) -> Option<Vec<Complex64>> {
    let n = h.nrows();
    let mut y = vec![Complex64::default(); n];
    // Parts of H y, of which columns are added as their elements become known.
    let [mut re, mut im] = [vec![0.0; n], vec![0.0; n]];
    let mut next = Complex64::new(1.0, 0.0);
    for j in (0..n).rev() {
        y[j] = next;
        let column = &h.as_slice()[j * n..j * n + j + 1];
        for ((re, im), h) in re.iter_mut().zip(&mut im).zip(column) {
            *re += h * next.re;
            *im += h * next.im;
        }
        next = theta * next - Complex64::new(re[j], im[j]);
        if j > 0 {
            next /= h[(j, j - 1)];
        }
    }
    let length = y.iter().map(Complex64::norm_sqr).sum::<f64>().sqrt();
    let satisfied = length.is_finite() && next.norm() <= MAX_RESIDUAL * theta.norm() * length;
    satisfied.then(|| y.into_iter().map(|v| v / length).collect())
}

/// The eigenvector next to θ, by inverse iteration.
pub fn nearest_eigenvector(h: &DMatrix<f64>, theta: Complex64) -> Vec<Complex64> {
    let lu = ShiftedLu::new(h, theta);
    // As if the left factor had turned the start to equal elements.
    let mut y = vec![Complex64::new(1.0, 0.0); h.nrows()];
    lu.solve_upper(&mut y);
    for solution in 0..SOLUTIONS {
        if solution > 0 {
            lu.solve_lower(&mut y);
            lu.solve_upper(&mut y);
        }
        // Scaled by the largest element first: the solution is close to overflow.
        let largest = y.iter().map(|v| v.re.abs().max(v.im.abs())).fold(0.0, f64::max);
        y.iter_mut().for_each(|v| *v /= largest);
        let length = y.iter().map(Complex64::norm_sqr).sum::<f64>().sqrt();
        y.iter_mut().for_each(|v| *v /= length);
    }
    y
}

/// H y.
pub fn image(h: &DMatrix<f64>, y: &[Complex64]) -> Vec<Complex64> {
    let mut out = vec![Complex64::default(); h.nrows()];
    for (j, (column, y)) in h.column_iter().zip(y).enumerate() {
        let rows = (j + 2).min(h.nrows());
        out.iter_mut().zip(column.iter()).take(rows).for_each(|(o, h)| *o += y * *h);
    }
    out
}

/// LU factors of H − θ with row exchanges.
struct ShiftedLu {
    /// Rows of U from the diagonal on, one after another.
    upper: Vec<Complex64>,
    /// Multiplier of every elimination, and whether both rows were exchanged.
    steps: Vec<(Complex64, bool)>,
}

impl ShiftedLu {
    fn new(h: &DMatrix<f64>, theta: Complex64) -> Self {
        let n = h.nrows();
        let smallest = f64::EPSILON * h.amax().max(f64::MIN_POSITIVE);
        let floor = |v: Complex64| if v.norm_sqr() < smallest * smallest { smallest.into() } else { v };
        let mut upper: Vec<Complex64> = Vec::with_capacity(n * (n + 1) / 2);
        let mut steps = Vec::with_capacity(n);
        let mut next: Vec<Complex64> = Vec::with_capacity(n);
        upper.extend((0..n).map(|j| Complex64::from(h[(0, j)]) - if j == 0 { theta } else { 0.0.into() }));
        for k in 0..n {
            // The last row of U so far is changed into its final one, the next row of H into the one after it.
            let start = upper.len() - (n - k);
            let row = &mut upper[start..];
            if k + 1 == n {
                row[0] = floor(row[0]);
                break;
            }
            next.clear();
            next.extend((k..n).map(|j| Complex64::from(h[(k + 1, j)])));
            next[1] -= theta;
            let exchanged = next[0].norm_sqr() > row[0].norm_sqr();
            if exchanged {
                row.swap_with_slice(&mut next);
            }
            row[0] = floor(row[0]);
            let factor = next[0] / row[0];
            next.iter_mut().zip(&*row).skip(1).for_each(|(v, r)| *v -= factor * r);
            upper.extend_from_slice(&next[1..]);
            steps.push((factor, exchanged));
        }
        Self { upper, steps }
    }

    fn solve_lower(&self, y: &mut [Complex64]) {
        for (k, &(factor, exchanged)) in self.steps.iter().enumerate() {
            if exchanged {
                y.swap(k, k + 1);
            }
            let above = y[k];
            y[k + 1] -= factor * above;
        }
    }

    fn solve_upper(&self, y: &mut [Complex64]) {
        let (n, mut end) = (y.len(), self.upper.len());
        for k in (0..n).rev() {
            let row = &self.upper[end - (n - k)..end];
            let known: Complex64 = row[1..].iter().zip(&y[k + 1..]).map(|(u, y)| u * y).sum();
            y[k] = (y[k] - known) / row[0];
            end -= n - k;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn random_hessenberg(n: usize, mut seed: u64) -> DMatrix<f64> {
        DMatrix::from_fn(n, n, |i, j| {
            seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            let v = (seed >> 11) as f64 / (1u64 << 52) as f64 - 1.0;
            // Graded, as shift-and-invert makes it.
            if i > j + 1 { 0.0 } else { v * 0.8_f64.powi((i + j) as i32 / 2) }
        })
    }

    #[test]
    fn every_eigenpair_satisfies_its_equation() {
        for n in [1, 2, 3, 4, 7, 20, 61] {
            let h = random_hessenberg(n, n as u64);
            let values = eigenvalues(&h).unwrap();
            assert_eq!(values.len(), n);
            let trace: Complex64 = values.iter().sum();
            assert!((trace - h.trace()).norm() < 1e-12 * h.norm(), "{n}: {trace}");
            for theta in &values {
                let y = eigenvector(&h, *theta);
                let rest = (0..n).map(|i| {
                    let image: Complex64 = (0..n).map(|j| y[j] * h[(i, j)]).sum();
                    (image - theta * y[i]).norm_sqr()
                });
                let rest = rest.sum::<f64>().sqrt();
                assert!(rest < 1e-13 * h.norm() * n as f64, "{n}: {rest:e} at {theta}");
            }
        }
    }

    #[test]
    fn pairs_without_real_parts_converge() {
        // Uncoupled blocks of imaginary pairs over many decades, coupled in the upper part, turned by reflections.
        for n in [6, 20, 60] {
            let mut a =
                DMatrix::from_fn(
                    n,
                    n,
                    |i, j| if j > i + 1 { 1e-6 * ((3 * i + 7 * j) % 11) as f64 } else { 0.0 },
                );
            let omega: Vec<f64> = (0..n / 2).map(|k| 0.7_f64.powi(k as i32)).collect();
            for (k, w) in omega.iter().enumerate() {
                a[(2 * k, 2 * k + 1)] = w * 10.0;
                a[(2 * k + 1, 2 * k)] = -w / 10.0;
            }
            let h = nalgebra::Hessenberg::new(reflected(&a, n)).unpack_h();
            let mut found: Vec<f64> =
                eigenvalues(&h).unwrap().iter().map(|v| v.im).filter(|im| *im > 0.0).collect();
            found.sort_by(|a, b| b.total_cmp(a));
            assert_eq!(found.len(), n / 2);
            for (found, w) in found.iter().zip(&omega) {
                assert!((found - w).abs() < 1e-10, "{n}: {found} {w}");
            }
        }
    }

    /// Q A Q of a reflection Q.
    fn reflected(a: &DMatrix<f64>, n: usize) -> DMatrix<f64> {
        let v = nalgebra::DVector::from_fn(n, |i, _| 1.0 + ((i * 5) % 7) as f64);
        let q = DMatrix::identity(n, n) - &v * v.transpose() * (2.0 / v.norm_squared());
        &q * a * &q
    }

    #[test]
    fn special_matrices() {
        // A companion matrix: the roots of x³ − 6 x² + 11 x − 6; a cycle, for which ordinary shifts fail; zeros.
        let companion_matrix =
            DMatrix::from_row_slice(3, 3, &[6.0, -11.0, 6.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0]);
        let mut roots: Vec<f64> = eigenvalues(&companion_matrix).unwrap().iter().map(|v| v.re).collect();
        roots.sort_by(f64::total_cmp);
        assert!(roots.iter().zip([1.0, 2.0, 3.0]).all(|(a, b)| (a - b).abs() < 1e-13), "{roots:?}");
        let cycle = DMatrix::from_fn(6, 6, |i, j| f64::from(u8::from(i == (j + 1) % 6)));
        assert!(eigenvalues(&cycle).unwrap().iter().all(|v| (v.norm() - 1.0).abs() < 1e-13));
        assert_eq!(eigenvalues(&DMatrix::zeros(5, 5)).unwrap(), vec![Complex64::default(); 5]);
        assert_eq!(eigenvalues(&DMatrix::zeros(0, 0)).unwrap(), Vec::new());
        let infinite = DMatrix::from_element(2, 2, f64::INFINITY);
        assert_eq!(eigenvalues(&infinite).unwrap_err(), EigenError::NotFinite);
    }
}
