//! LU factorisation of dense real matrices.

use faer::linalg::solvers::{PartialPivLu, Solve};
use nalgebra::DMatrix;

/// LU factors of a dense matrix, with partial pivoting.
pub struct DenseLu {
    factors: PartialPivLu<f64>,
}

impl DenseLu {
    /// Factorises a square matrix; `None` if it is singular or not finite.
    pub fn new(a: &DMatrix<f64>) -> Option<Self> {
        let matrix = faer::Mat::from_fn(a.nrows(), a.ncols(), |i, j| a[(i, j)]);
        let factors = matrix.partial_piv_lu();
        let pivots = factors.U();
        let usable = |i: usize| pivots[(i, i)] != 0.0 && pivots[(i, i)].is_finite();
        (0..a.nrows()).all(usable).then_some(Self { factors })
    }

    /// Solves A x = b in place.
    pub fn solve(&self, b: &mut [f64]) {
        let n = b.len();
        self.factors.solve_in_place(faer::MatMut::from_column_major_slice_mut(b, n, 1));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn solves_and_rejects_singular_matrices() {
        let n = 60;
        // A zero diagonal, so that rows must be exchanged.
        let a = DMatrix::from_fn(n, n, |i, j| {
            if i == j { 0.0 } else { ((3 * i + 7 * j) % 11) as f64 - 4.5 + 1.0 / (i + j) as f64 }
        });
        let x = nalgebra::DVector::from_fn(n, |i, _| (i as f64).cos());
        let mut b: Vec<f64> = (&a * &x).iter().copied().collect();
        DenseLu::new(&a).unwrap().solve(&mut b);
        assert!(b.iter().zip(x.iter()).all(|(u, v)| (u - v).abs() < 1e-9));
        assert!(DenseLu::new(&DMatrix::zeros(3, 3)).is_none());
        assert!(DenseLu::new(&DMatrix::from_element(2, 2, f64::NAN)).is_none());
    }
}
