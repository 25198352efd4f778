//! Rows of weighted residuals and their derivatives.

use nalgebra::{DMatrix, DVector};

use super::data_kind::DataKind;
use super::least_squares::Evaluation;

/// Residual rows and their derivatives by every parameter, under construction.
#[derive(Default)]
pub(super) struct ResidualRows {
    residual: Vec<f64>,
    slopes: Vec<Vec<f64>>,
    kinds: Vec<DataKind>,
    data: [f64; DataKind::COUNT],
}

impl ResidualRows {
    /// One row of a kind.
    pub fn push(&mut self, kind: DataKind, residual: f64, slopes: impl Iterator<Item = f64>) {
        self.kinds.push(kind);
        self.residual.push(residual);
        self.slopes.push(slopes.collect());
    }

    /// Counts the rows pushed as so many data.
    pub fn count(&mut self, kind: DataKind, data: f64) {
        self.data[kind as usize] += data;
    }

    /// All rows, with derivatives by so many parameters.
    pub fn evaluation(self, parameters: usize) -> Evaluation {
        Evaluation {
            jacobian: DMatrix::from_fn(self.slopes.len(), parameters, |i, j| self.slopes[i][j]),
            residual: DVector::from_vec(self.residual),
            kinds: self.kinds,
            data: self.data,
        }
    }
}
