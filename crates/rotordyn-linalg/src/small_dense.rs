//! Allocation-free dense solver for small linear systems inside a time step.

use super::dot;
use pulp::Arch;
use std::ops::Range;

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
///
/// Compiled for the widest vectors of the processor, with the same rounding on every one.
#[derive(Clone, Debug)]
pub struct PaddedMatrix {
    size: usize,
    vectors: usize,
    data: Vec<Lanes>,
    /// Of the factors: rows exchanged, multipliers of the elimination (row-major), inverses of the pivots.
    pivots: Vec<usize>,
    multipliers: Vec<f64>,
    inverses: Vec<f64>,
    arch: Arch,
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
            arch: Arch::new(),
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

    /// Sets the matrix to I + Y T with the row-major Y and a T of diagonal blocks, at the rows and columns `blocks`.
    pub fn set_to_identity_plus_product(&mut self, y: &[f64], t: &Self, blocks: &[Range<usize>]) {
        self.arch.dispatch(
            #[inline(always)]
            || match self.vectors {
                1 => self.identity_plus_product::<1>(y, t, blocks),
                2 => self.identity_plus_product::<2>(y, t, blocks),
                3 => self.identity_plus_product::<3>(y, t, blocks),
                4 => self.identity_plus_product::<4>(y, t, blocks),
                _ => self.identity_plus_long_product(y, t, blocks),
            },
        );
    }

    /// With rows of V vectors, which stay in registers.
    #[inline(always)]
    fn identity_plus_product<const V: usize>(&mut self, y: &[f64], t: &Self, blocks: &[Range<usize>]) {
        let (lines, _) = self.data.as_chunks_mut::<V>();
        let (from, _) = t.data.as_chunks::<V>();
        for (row, (line, y)) in lines.iter_mut().zip(y.chunks_exact(self.size)).enumerate() {
            let mut sum = [[0.0; LANES]; V];
            sum[row / LANES][row % LANES] = 1.0;
            for block in blocks {
                for (factor, from) in y[block.clone()].iter().zip(&from[block.clone()]) {
                    for v in 0..V {
                        for k in 0..LANES {
                            sum[v][k] += factor * from[v][k];
                        }
                    }
                }
            }
            *line = sum;
        }
    }

    #[inline(always)]
    fn identity_plus_long_product(&mut self, y: &[f64], t: &Self, blocks: &[Range<usize>]) {
        let lines = self.data.chunks_exact_mut(self.vectors).zip(y.chunks_exact(self.size));
        for (row, (line, y)) in lines.enumerate() {
            line.fill([0.0; LANES]);
            line[row / LANES][row % LANES] = 1.0;
            for block in blocks {
                // Whole vectors that hold the columns of the block: outside of them its rows are zero.
                let vectors = block.start / LANES..block.end.div_ceil(LANES);
                let to = &mut line[vectors.clone()];
                let from = t.data.chunks_exact(t.vectors).skip(block.start);
                for (factor, from) in y[block.clone()].iter().zip(from) {
                    for (to, from) in to.iter_mut().zip(&from[vectors.clone()]) {
                        for k in 0..LANES {
                            to[k] += factor * from[k];
                        }
                    }
                }
            }
        }
    }

    /// Factors the matrix in place by Gaussian elimination with partial pivoting, for [`Self::solve`].
    ///
    /// Returns false for a zero or non-finite pivot.
    pub fn factor(&mut self) -> bool {
        let vectors = self.vectors;
        self.arch.dispatch(
            #[inline(always)]
            || match vectors {
                1 => self.eliminate(subtract::<1>),
                2 => self.eliminate(subtract::<2>),
                3 => self.eliminate(subtract::<3>),
                4 => self.eliminate(subtract::<4>),
                _ => self.eliminate(subtract_long),
            },
        )
    }

    /// `subtract`: line − factor · pivot row, for whole rows.
    #[inline(always)]
    fn eliminate(&mut self, subtract: impl Fn(&mut [Lanes], &[Lanes], f64)) -> bool {
        let (n, vectors) = (self.size, self.vectors);
        let stride = vectors * LANES;
        for k in 0..n {
            let flat = self.data.as_flattened_mut();
            let (mut pivot, mut largest) = (k, flat[k * stride + k].abs());
            for row in k + 1..n {
                let size = flat[row * stride + k].abs();
                if size > largest {
                    (pivot, largest) = (row, size);
                }
            }
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
            let inverse = 1.0 / value;
            self.inverses[k] = inverse;
            // What whole rows change left of the diagonal is not read again.
            let (top, below) = self.data.split_at_mut((k + 1) * vectors);
            let pivot_row = &top[k * vectors..];
            let multipliers = self.multipliers[(k + 1) * n..].chunks_exact_mut(n);
            for (line, multipliers) in below.chunks_exact_mut(vectors).zip(multipliers) {
                let factor = line.as_flattened()[k] * inverse;
                multipliers[k] = factor;
                subtract(line, pivot_row, factor);
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

/// line − factor · row, of V vectors.
#[inline(always)]
fn subtract<const V: usize>(line: &mut [Lanes], row: &[Lanes], factor: f64) {
    if let (Some(line), Some(row)) = (line.first_chunk_mut::<V>(), row.first_chunk::<V>()) {
        for v in 0..V {
            for k in 0..LANES {
                line[v][k] -= factor * row[v][k];
            }
        }
    }
}

/// The same, of any number of vectors.
#[inline(always)]
fn subtract_long(line: &mut [Lanes], row: &[Lanes], factor: f64) {
    for (to, from) in line.iter_mut().zip(row) {
        for k in 0..LANES {
            to[k] -= factor * from[k];
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn padded_matrices_of_any_size_give_the_same() {
        for n in 1..22 {
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
    fn identity_plus_product_of_blocks() {
        let (mut t, blocks) = (PaddedMatrix::new(7), [0..3, 3..7]);
        for block in &blocks {
            for i in block.clone() {
                for j in block.clone() {
                    t.row_mut(i)[j] = (10 * i + j) as f64;
                }
            }
        }
        let y: Vec<f64> = (0..49).map(|k| (k % 5) as f64 - 2.0).collect();
        let mut sum = PaddedMatrix::new(7);
        sum.set_to_identity_plus_product(&y, &t, &blocks);
        for i in 0..7 {
            for j in 0..7 {
                let product: f64 = (0..7).map(|k| y[7 * i + k] * t.row(k)[j]).sum();
                assert_eq!(sum.row(i)[j], product + if i == j { 1.0 } else { 0.0 });
            }
            assert_eq!(sum.row(i)[7], 0.0);
        }
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
