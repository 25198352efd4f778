//! Allocation-free dense solver for small linear systems inside a time step.

use super::dot;

/// Solves A x = b in place by Gaussian elimination with partial pivoting; `b` becomes x.
///
/// `a`: row-major n × n, destroyed; `b`: n. Returns false for a zero or non-finite pivot.
pub fn solve_in_place(a: &mut [f64], b: &mut [f64]) -> bool {
    let n = b.len();
    debug_assert_eq!(a.len(), n * n);
    for k in 0..n {
        let mut pivot = k;
        for row in k + 1..n {
            if a[row * n + k].abs() > a[pivot * n + k].abs() {
                pivot = row;
            }
        }
        let value = a[pivot * n + k];
        if value == 0.0 || !value.is_finite() {
            return false;
        }
        if pivot != k {
            for column in k..n {
                a.swap(k * n + column, pivot * n + column);
            }
            b.swap(k, pivot);
        }
        let (top, below) = a.split_at_mut((k + 1) * n);
        let pivot_row = &top[k * n..];
        let inverse = 1.0 / value;
        for (offset, row) in below.chunks_exact_mut(n).enumerate() {
            let factor = row[k] * inverse;
            if factor != 0.0 {
                for column in k + 1..n {
                    row[column] -= factor * pivot_row[column];
                }
                b[k + 1 + offset] -= factor * b[k];
            }
        }
    }
    for k in (0..n).rev() {
        let sum: f64 = (k + 1..n).map(|c| a[k * n + c] * b[c]).sum();
        b[k] = (b[k] - sum) / a[k * n + k];
    }
    true
}

/// A row of a [`PaddedMatrix`] in vectors of this many entries.
pub const LANES: usize = 4;
type Lanes = [f64; LANES];

/// A small square matrix in row-major order, each row padded with zeros to whole vectors.
#[derive(Clone, Debug, Default)]
pub struct PaddedMatrix {
    size: usize,
    vectors: usize,
    data: Vec<Lanes>,
    /// Of the factors: rows exchanged, multipliers of the elimination (row-major), inverses of the pivots.
    pivots: Vec<usize>,
    multipliers: Vec<f64>,
    inverses: Vec<f64>,
}

impl PaddedMatrix {
    pub fn new(size: usize) -> Self {
        let vectors = size.div_ceil(LANES);
        Self {
            size,
            vectors,
            data: vec![[0.0; LANES]; size * vectors],
            pivots: vec![0; size],
            multipliers: vec![0.0; size * size],
            inverses: vec![0.0; size],
        }
    }

    /// A row with its padding.
    pub fn row_mut(&mut self, row: usize) -> &mut [f64] {
        self.data[row * self.vectors..(row + 1) * self.vectors].as_flattened_mut()
    }

    /// A row with its padding.
    pub fn row(&self, row: usize) -> &[f64] {
        self.data[row * self.vectors..(row + 1) * self.vectors].as_flattened()
    }

    /// Adds Σ_b factors_b source_{first+b} to a row, over the vectors that hold the columns `columns`, outside of which the rows
    /// of `source` are zero.
    #[inline]
    pub fn add_rows(
        &mut self,
        row: usize,
        factors: &[f64],
        source: &Self,
        first: usize,
        columns: std::ops::Range<usize>,
    ) {
        let vectors = columns.start / LANES..columns.end.div_ceil(LANES);
        let to = &mut self.data[row * self.vectors..][vectors.clone()];
        for (factor, from) in factors.iter().zip(source.data.chunks_exact(source.vectors).skip(first)) {
            for (to, from) in to.iter_mut().zip(&from[vectors.clone()]) {
                for k in 0..LANES {
                    to[k] += factor * from[k];
                }
            }
        }
    }

    /// Factors the matrix in place by Gaussian elimination with partial pivoting, for [`Self::solve`].
    ///
    /// Returns false for a zero or non-finite pivot.
    pub fn factor(&mut self) -> bool {
        let (n, vectors) = (self.size, self.vectors);
        let stride = vectors * LANES;
        for k in 0..n {
            let flat = self.data.as_flattened_mut();
            let column = |row: usize| flat[row * stride + k].abs();
            let pivot = (k + 1..n).fold(k, |best, row| if column(row) > column(best) { row } else { best });
            let value = flat[pivot * stride + k];
            if value == 0.0 || !value.is_finite() {
                return false;
            }
            self.pivots[k] = pivot;
            if pivot != k {
                for column in 0..stride {
                    flat.swap(k * stride + column, pivot * stride + column);
                }
                for column in 0..k {
                    self.multipliers.swap(k * n + column, pivot * n + column);
                }
            }
            // Whole vectors from that of the pivot on: what they change left of the diagonal is not read again.
            let first = k / LANES;
            let (top, below) = self.data.split_at_mut((k + 1) * vectors);
            let pivot_row = &top[k * vectors + first..];
            let inverse = 1.0 / value;
            self.inverses[k] = inverse;
            for (row, line) in (k + 1..).zip(below.chunks_exact_mut(vectors)) {
                let factor = line.as_flattened()[k] * inverse;
                self.multipliers[row * n + k] = factor;
                for (to, from) in line[first..].iter_mut().zip(pivot_row) {
                    for lane in 0..LANES {
                        to[lane] -= factor * from[lane];
                    }
                }
            }
        }
        true
    }

    /// Solves A x = b in place with the factors; `b` becomes x.
    pub fn solve(&self, b: &mut [f64]) {
        let (n, stride) = (self.size, self.vectors * LANES);
        for (k, pivot) in self.pivots.iter().enumerate() {
            b.swap(k, *pivot);
        }
        for k in 1..n {
            b[k] -= dot(&self.multipliers[k * n..k * n + k], &b[..k]);
        }
        let flat = self.data.as_flattened();
        for k in (0..n).rev() {
            let row = &flat[k * stride..k * stride + n];
            b[k] = (b[k] - dot(&row[k + 1..], &b[k + 1..])) * self.inverses[k];
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn padded_matrices_of_any_size_give_the_same() {
        for n in 1..14 {
            let entry =
                |i: usize, j: usize| (3.7 * i as f64 + 1.3 * (j * j) as f64 + (i * j) as f64 + 0.5).sin();
            let plain: Vec<f64> = (0..n * n).map(|k| entry(k / n, k % n)).collect();
            let mut padded = PaddedMatrix::new(n);
            for i in 0..n {
                padded.row_mut(i)[..n].copy_from_slice(&plain[i * n..(i + 1) * n]);
            }
            let right: Vec<f64> = (0..n).map(|k| 1.0 + k as f64).collect();
            let (mut x, mut y) = (right.clone(), right);
            assert!(solve_in_place(&mut plain.clone(), &mut x) && padded.factor(), "{n}");
            padded.solve(&mut y);
            assert!(x.iter().zip(&y).all(|(x, y)| (x - y).abs() <= 1e-10 * x.abs().max(1.0)), "{n}");
        }
        assert!(!PaddedMatrix::new(3).factor());
    }

    #[test]
    fn adds_rows_of_a_block() {
        let mut block = PaddedMatrix::new(7);
        for i in 3..6 {
            for j in 3..6 {
                block.row_mut(i)[j] = (10 * i + j) as f64;
            }
        }
        let mut sum = PaddedMatrix::new(7);
        sum.add_rows(1, &[2.0, -1.0, 0.5], &block, 3, 3..6);
        for j in 0..7 {
            let inside = (3..6).contains(&j);
            let exact =
                if inside { 2.0 * (30 + j) as f64 - (40 + j) as f64 + 0.5 * (50 + j) as f64 } else { 0.0 };
            assert_eq!(sum.row_mut(1)[j], exact);
        }
        assert_eq!(sum.row_mut(0), [0.0; 8]);
    }

    #[test]
    fn solves_and_rejects_singular_matrices() {
        // Needs a row exchange at the first pivot.
        let a = [0.0, 2.0, 1.0, 1.0, -1.0, 3.0, 4.0, 0.5, -2.0];
        let x = [1.5, -2.0, 0.25];
        let mut b = [0.0; 3];
        for i in 0..3 {
            b[i] = (0..3).map(|j| a[3 * i + j] * x[j]).sum();
        }
        assert!(solve_in_place(&mut a.clone(), &mut b));
        assert!(b.iter().zip(&x).all(|(p, q)| (p - q).abs() < 1e-14));
        assert!(!solve_in_place(&mut [1.0, 2.0, 2.0, 4.0], &mut [1.0, 1.0]));
        assert!(!solve_in_place(&mut [f64::NAN], &mut [1.0]));
    }
}
