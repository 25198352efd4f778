//! Dense matrix-vector products for the inner loop of a time step.

use nalgebra::DMatrix;
use pulp::{Arch, NullaryFnOnce};

/// Block row of matrices, \[A₁ A₂ …\], for y += A₁ x₁ + A₂ x₂ + …, with the widest SIMD vectors.
///
/// Each element of y is summed in column order on every processor, so results are bitwise identical.
#[derive(Clone, Debug)]
pub struct Panel {
    rows: usize,
    /// Column-major, padded with zero columns to a multiple of [`COLUMNS`]; columns of `stride`.
    data: Vec<f64>,
    columns: usize,
    /// Column stride: `rows`, rounded up to a multiple of [`LANES`] if at most [`SMALL`] (zero padding).
    stride: usize,
    arch: Arch,
}

/// Columns processed together: y is loaded and stored once for all of them.
const COLUMN_BLOCK: usize = 4;
/// Largest number of rows for which y stays in registers over all columns.
const MAX_REGISTER_ROWS: usize = 2 * LANES;
const LANES: usize = 4;

impl Panel {
    /// Panel of matrices with the same number of rows.
    pub fn new(blocks: &[&DMatrix<f64>]) -> Self {
        let rows = blocks.first().map_or(0, |b| b.nrows());
        let columns = blocks.iter().map(|b| b.ncols()).sum::<usize>();
        let stride = if rows <= MAX_REGISTER_ROWS { rows.next_multiple_of(LANES) } else { rows };
        let mut data = Vec::with_capacity(stride * columns.next_multiple_of(COLUMN_BLOCK));
        for column in blocks.iter().flat_map(|block| block.column_iter()) {
            data.extend(column.iter());
            data.resize(data.len().next_multiple_of(stride.max(1)), 0.0);
        }
        data.resize(stride * columns.next_multiple_of(COLUMN_BLOCK), 0.0);
        Self { rows, data, columns, stride, arch: Arch::new() }
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
}

/// A product compiled for every instruction set (closures are not inlined into dispatched code).
struct Product<'a> {
    panel: &'a Panel,
    x: &'a [f64],
    y: &'a mut [f64],
}

impl NullaryFnOnce for Product<'_> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        let Panel { rows, data, stride, .. } = self.panel;
        match *stride {
            LANES => in_registers::<LANES>(*rows, data, self.x, self.y),
            MAX_REGISTER_ROWS => in_registers::<MAX_REGISTER_ROWS>(*rows, data, self.x, self.y),
            _ => column_by_column(*rows, data, self.x, self.y),
        }
    }
}

#[inline(always)]
fn in_registers<const R: usize>(rows: usize, data: &[f64], x: &[f64], y: &mut [f64]) {
    let mut sums = [0.0; R];
    sums[..rows].copy_from_slice(y);
    for (column, factor) in data.chunks_exact(R).zip(x) {
        for i in 0..R {
            sums[i] += factor * column[i];
        }
    }
    y.copy_from_slice(&sums[..rows]);
}

#[inline(always)]
fn column_by_column(rows: usize, data: &[f64], x: &[f64], y: &mut [f64]) {
    if rows == 0 {
        return;
    }
    for (k, columns) in data.chunks_exact(COLUMN_BLOCK * rows).enumerate() {
        let factor = |c: usize| x.get(COLUMN_BLOCK * k + c).copied().unwrap_or(0.0);
        let f: [f64; COLUMN_BLOCK] = [factor(0), factor(1), factor(2), factor(3)];
        let (a, rest) = columns.split_at(rows);
        let (b, rest) = rest.split_at(rows);
        let (c, d) = rest.split_at(rows);
        // Equal lengths visible to the compiler: no bounds checks, full vectorisation.
        let d = &d[..rows];
        let y = &mut y[..rows];
        for i in 0..rows {
            y[i] = (((y[i] + f[0] * a[i]) + f[1] * b[i]) + f[2] * c[i]) + f[3] * d[i];
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equals_the_plain_product() {
        for (rows, first, second) in [(1, 1, 1), (3, 4, 5), (6, 6, 7), (41, 41, 10), (8, 2, 0), (9, 9, 1)] {
            let a = DMatrix::from_fn(rows, first, |i, j| (i * 7 + j * 3) as f64 * 0.1 - 1.0);
            let b = DMatrix::from_fn(rows, second, |i, j| (i * 5 + j * 11) as f64 * 0.2 - 2.0);
            let panel = Panel::new(&[&a, &b]);
            assert_eq!(panel.columns(), first + second);
            let x: Vec<f64> = (0..first + second).map(|k| 1.0 - 0.3 * k as f64).collect();
            let mut y = vec![0.5; rows];
            panel.mul_add(&x, &mut y);
            for (i, value) in y.iter().enumerate() {
                let mut exact = 0.5;
                for (k, factor) in x.iter().enumerate() {
                    exact += factor * if k < first { a[(i, k)] } else { b[(i, k - first)] };
                }
                assert_eq!(*value, exact, "row {i}");
            }
        }
    }
}
