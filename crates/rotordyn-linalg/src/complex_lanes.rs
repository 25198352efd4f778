//! Complex numbers of several matrices side by side.

use crate::{Complex64, SparseRow};

/// Matrices side by side.
pub const LANES: usize = 8;

/// A complex number of each matrix.
#[derive(Clone, Copy, Debug, Default)]
pub struct ComplexLanes {
    pub re: [f64; LANES],
    pub im: [f64; LANES],
}

impl ComplexLanes {
    /// The number of one matrix.
    pub fn lane(&self, lane: usize) -> Complex64 {
        Complex64::new(self.re[lane], self.im[lane])
    }

    /// Sets the number of one matrix.
    pub fn set_lane(&mut self, lane: usize, z: Complex64) {
        (self.re[lane], self.im[lane]) = (z.re, z.im);
    }

    /// Adds `factor` z.
    pub fn add_scaled(&mut self, factor: f64, z: &Self) {
        for k in 0..LANES {
            self.re[k] += factor * z.re[k];
            self.im[k] += factor * z.im[k];
        }
    }

    #[inline(always)]
    pub(super) fn subtract_product(&mut self, a: &Self, b: &Self) {
        for k in 0..LANES {
            self.re[k] = self.re[k] - a.re[k] * b.re[k] + a.im[k] * b.im[k];
            self.im[k] = self.im[k] - a.re[k] * b.im[k] - a.im[k] * b.re[k];
        }
    }

    #[inline(always)]
    pub(super) fn product(&self, by: &Self) -> Self {
        let mut out = Self::default();
        for k in 0..LANES {
            out.re[k] = self.re[k] * by.re[k] - self.im[k] * by.im[k];
            out.im[k] = self.re[k] * by.im[k] + self.im[k] * by.re[k];
        }
        out
    }

    #[inline(always)]
    pub(super) fn inverse(&self) -> Self {
        let mut out = Self::default();
        for k in 0..LANES {
            let square = self.re[k] * self.re[k] + self.im[k] * self.im[k];
            out.re[k] = self.re[k] / square;
            out.im[k] = -self.im[k] / square;
        }
        out
    }

    #[inline(always)]
    pub(super) fn is_zero(&self) -> bool {
        self.re == [0.0; LANES] && self.im == [0.0; LANES]
    }

    #[inline(always)]
    pub(super) fn norm1(&self) -> [f64; LANES] {
        std::array::from_fn(
            #[inline(always)]
            |k| self.re[k].abs() + self.im[k].abs(),
        )
    }
}

/// Product of a sparse row with the vectors of all matrices.
pub fn dot_lanes(row: &SparseRow, x: &[ComplexLanes]) -> ComplexLanes {
    let mut sum = ComplexLanes::default();
    row.0.iter().for_each(|&(i, v)| sum.add_scaled(v, &x[i]));
    sum
}
