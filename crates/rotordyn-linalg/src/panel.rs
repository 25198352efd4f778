//! Dense matrix-vector products for the inner loop of a time step.

use nalgebra::DMatrix;
use pulp::{Arch, Simd, WithSimd};

/// Block row of matrices, \[A₁ A₂ …\], for y += A₁ x₁ + A₂ x₂ + …, with the widest SIMD vectors.
///
/// Each element of y is summed in the same order on every processor, so results are bitwise identical.
#[derive(Clone, Debug)]
pub struct Panel {
    rows: usize,
    columns: usize,
    /// Rows in blocks of [`BLOCK`] vectors, each block column-major; the last one is padded with zero rows to whole
    /// vectors.
    data: Vec<f64>,
    /// Elements of a vector.
    lanes: usize,
    arch: Arch,
}

/// Vectors of a block of rows: their sums stay in registers over all columns.
const BLOCK: usize = 12;
/// Largest number of rows for which even and odd columns have sums of their own: one sum of a few vectors waits for
/// itself at every column.
const MAX_NARROW: usize = 16;

impl Panel {
    /// Panel of matrices with the same number of rows.
    pub fn new(blocks: &[&DMatrix<f64>]) -> Self {
        let arch = Arch::new();
        Self::with_lanes(blocks, arch, vector_length(arch))
    }

    fn with_lanes(blocks: &[&DMatrix<f64>], arch: Arch, lanes: usize) -> Self {
        let rows = blocks.first().map_or(0, |b| b.nrows());
        let columns = blocks.iter().map(|b| b.ncols()).sum::<usize>();
        let mut data = vec![0.0; rows.next_multiple_of(lanes) * columns];
        let mut rest = data.as_mut_slice();
        for first in (0..rows).step_by(BLOCK * lanes) {
            let count = (rows - first).min(BLOCK * lanes);
            let stride = count.next_multiple_of(lanes);
            let (own, after) = rest.split_at_mut(stride * columns);
            let from = blocks.iter().flat_map(|block| block.column_iter());
            for (to, column) in own.chunks_exact_mut(stride).zip(from) {
                to[..count].copy_from_slice(&column.as_slice()[first..first + count]);
            }
            rest = after;
        }
        Self { rows, columns, data, lanes, arch }
    }

    /// Sets a column; `values`: one per row.
    pub fn set_column(&mut self, column: usize, values: &[f64]) {
        let block = BLOCK * self.lanes;
        let mut start = 0;
        for values in values[..self.rows].chunks(block) {
            let stride = values.len().next_multiple_of(self.lanes);
            self.data[start + column * stride..][..values.len()].copy_from_slice(values);
            start += stride * self.columns;
        }
    }

    /// Number of columns of all blocks together.
    pub fn columns(&self) -> usize {
        self.columns
    }

    /// y ← y + \[A₁ A₂ …\] x; `x` is the concatenation of x₁, x₂, …, `y` has one element per row.
    pub fn mul_add(&self, x: &[f64], y: &mut [f64]) {
        debug_assert!(x.len() == self.columns && y.len() == self.rows);
        self.arch.dispatch(Product { panel: self, x, y });
    }

    /// Sets this matrix to base + Σ factor · term, all of the same size.
    pub fn set_to_sum(&mut self, base: &Panel, [(by_first, first), (by_second, second)]: [(f64, &Panel); 2]) {
        debug_assert!([base, first, second].iter().all(|panel| panel.data.len() == self.data.len()));
        let terms = base.data.iter().zip(&first.data).zip(&second.data);
        for (sum, ((base, first), second)) in self.data.iter_mut().zip(terms) {
            *sum = base + by_first * first + by_second * second;
        }
    }

    /// Adds factor · term to this matrix.
    pub fn add(&mut self, factor: f64, term: &Panel) {
        debug_assert!(term.data.len() == self.data.len());
        for (sum, a) in self.data.iter_mut().zip(&term.data) {
            *sum += factor * a;
        }
    }
}

/// Number of elements of a vector of this processor.
pub fn vector_length(arch: Arch) -> usize {
    arch.dispatch(Lanes)
}

struct Lanes;

impl WithSimd for Lanes {
    type Output = usize;

    fn with_simd<S: Simd>(self, _: S) -> usize {
        S::F64_LANES
    }
}

/// A product compiled for every instruction set.
struct Product<'a> {
    panel: &'a Panel,
    x: &'a [f64],
    y: &'a mut [f64],
}

impl WithSimd for Product<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let Panel { columns, lanes, .. } = *self.panel;
        debug_assert!(lanes == S::F64_LANES);
        let narrow = self.panel.rows <= MAX_NARROW;
        let mut rest = self.panel.data.as_slice();
        for y in self.y.chunks_mut(BLOCK * lanes) {
            let vectors = y.len().div_ceil(lanes);
            let (own, after) = rest.split_at(vectors * lanes * columns);
            let (own, x) = (S::as_simd_f64s(own).0, self.x);
            match vectors {
                1 => block::<S, 1>(simd, own, x, y, narrow),
                2 => block::<S, 2>(simd, own, x, y, narrow),
                3 => block::<S, 3>(simd, own, x, y, narrow),
                4 => block::<S, 4>(simd, own, x, y, narrow),
                5 => block::<S, 5>(simd, own, x, y, narrow),
                6 => block::<S, 6>(simd, own, x, y, narrow),
                7 => block::<S, 7>(simd, own, x, y, narrow),
                8 => block::<S, 8>(simd, own, x, y, narrow),
                9 => block::<S, 9>(simd, own, x, y, narrow),
                10 => block::<S, 10>(simd, own, x, y, narrow),
                11 => block::<S, 11>(simd, own, x, y, narrow),
                _ => block::<S, BLOCK>(simd, own, x, y, narrow),
            }
            rest = after;
        }
    }
}

/// Adds factor · column to the sums.
#[inline(always)]
fn add<S: Simd, const V: usize>(simd: S, sums: &mut [S::f64s; V], column: &[S::f64s; V], factor: f64) {
    let factor = simd.splat_f64s(factor);
    for (sum, a) in sums.iter_mut().zip(column) {
        *sum = simd.add_f64s(*sum, simd.mul_f64s(factor, *a));
    }
}

/// Adds the product of a block of V vectors a column to `y`; inlined, as everything in code for one processor must be.
#[inline(always)]
fn block<S: Simd, const V: usize>(simd: S, data: &[S::f64s], x: &[f64], y: &mut [f64], narrow: bool) {
    let zero = simd.splat_f64s(0.0);
    let mut sums = [zero; V];
    for (sum, y) in sums.iter_mut().zip(y.chunks(S::F64_LANES)) {
        *sum = simd.partial_load_f64s(y);
    }
    let (columns, _) = data.as_chunks::<V>();
    if narrow {
        let mut odd = [zero; V];
        let ((pairs, last), (factors, last_factor)) = (columns.as_chunks::<2>(), x.as_chunks::<2>());
        for (pair, factors) in pairs.iter().zip(factors) {
            add(simd, &mut sums, &pair[0], factors[0]);
            add(simd, &mut odd, &pair[1], factors[1]);
        }
        for (column, factor) in last.iter().zip(last_factor) {
            add(simd, &mut sums, column, *factor);
        }
        for (sum, odd) in sums.iter_mut().zip(odd) {
            *sum = simd.add_f64s(*sum, odd);
        }
    } else {
        for (column, factor) in columns.iter().zip(x) {
            add(simd, &mut sums, column, *factor);
        }
    }
    for (sum, y) in sums.iter().zip(y.chunks_mut(S::F64_LANES)) {
        simd.partial_store_f64s(y, *sum);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use pulp::{Scalar, Scalar128b, Scalar256b, Scalar512b};

    /// y + A x in the order of the module.
    fn plain(a: &DMatrix<f64>, x: &[f64], y: f64, row: usize) -> f64 {
        let mut sums = [y, 0.0];
        for (k, factor) in x.iter().enumerate() {
            sums[if a.nrows() <= MAX_NARROW { k % 2 } else { 0 }] += factor * a[(row, k)];
        }
        sums[0] + sums[1]
    }

    fn with<S: Simd>(simd: S, blocks: &[&DMatrix<f64>], x: &[f64], y: &mut [f64]) {
        let panel = Panel::with_lanes(blocks, Arch::new(), S::F64_LANES);
        Product { panel: &panel, x, y }.with_simd(simd);
    }

    #[test]
    fn equals_the_plain_product_with_vectors_of_any_length() {
        for (rows, first, second) in [
            (1, 1, 1),
            (3, 4, 5),
            (6, 6, 7),
            (41, 41, 10),
            (8, 2, 0),
            (9, 9, 1),
            (16, 3, 2),
            (17, 5, 0),
            (48, 48, 1),
            (49, 7, 4),
            (130, 130, 3),
        ] {
            let a = DMatrix::from_fn(rows, first, |i, j| (i * 7 + j * 3) as f64 * 0.1 - 1.0);
            let b = DMatrix::from_fn(rows, second, |i, j| (i * 5 + j * 11) as f64 * 0.2 - 2.0);
            let both =
                DMatrix::from_fn(
                    rows,
                    first + second,
                    |i, j| {
                        if j < first { a[(i, j)] } else { b[(i, j - first)] }
                    },
                );
            let panel = Panel::new(&[&a, &b]);
            assert_eq!(panel.columns(), first + second);
            let mut by_columns = Panel::new(&[&DMatrix::zeros(rows, first + second)]);
            both.column_iter().enumerate().for_each(|(k, c)| by_columns.set_column(k, c.as_slice()));
            assert_eq!(by_columns.data, panel.data, "{rows}");
            let x: Vec<f64> = (0..first + second).map(|k| 1.0 - 0.3 * k as f64).collect();
            let mut found: [Vec<f64>; 5] = std::array::from_fn(|_| vec![0.5; rows]);
            panel.mul_add(&x, &mut found[0]);
            with(Scalar, &[&a, &b], &x, &mut found[1]);
            with(Scalar128b, &[&a, &b], &x, &mut found[2]);
            with(Scalar256b, &[&a, &b], &x, &mut found[3]);
            with(Scalar512b, &[&a, &b], &x, &mut found[4]);
            for found in found {
                for (i, value) in found.iter().enumerate() {
                    assert_eq!(*value, plain(&both, &x, 0.5, i), "row {i} of {rows}");
                }
            }
            let mut sum = panel.clone();
            sum.set_to_sum(&panel, [(3.0, &panel), (-1.0, &panel)]);
            sum.add(-1.0, &panel);
            let mut y = vec![0.0; rows];
            sum.mul_add(&x, &mut y);
            for (i, value) in y.iter().enumerate() {
                let exact = 2.0 * plain(&both, &x, 0.0, i);
                assert!((value - exact).abs() <= 1e-12 * exact.abs().max(1.0), "row {i} of {rows}");
            }
        }
    }
}
