//! The quadratic eigenvalue problem of one group of coupled unknowns.

use super::eigen::EigenError;
use super::{BandLayout, BandLu, DenseLu, GroupDense, SparseMatrix};

/// M, C, K of a group of coupled unknowns, in the elimination order of their band layout.
pub(super) struct CoupledGroup {
    pub m: SparseMatrix,
    pub c: SparseMatrix,
    pub k: SparseMatrix,
    /// Further part of C, dense within groups.
    pub dense: Option<GroupDense>,
    /// C + σ M without the dense part.
    pub damp: SparseMatrix,
    /// K + σ C + σ² M without the dense part.
    pub shifted: SparseMatrix,
    layout: BandLayout,
    /// σ \[1/s\].
    pub shift: f64,
}

impl CoupledGroup {
    pub fn new(
        matrices: [&SparseMatrix; 3],
        dense: Option<&GroupDense>,
        unknowns: &[usize],
        shift: f64,
    ) -> Self {
        let mut place = vec![None; matrices[0].rows()];
        for (p, &i) in unknowns.iter().enumerate() {
            place[i] = Some(p);
        }
        let [m, c, k] = matrices.map(|a| a.submatrix(unknowns, &place));
        let damp = SparseMatrix::sum(&[(1.0, &c), (shift, &m)]);
        let shifted = SparseMatrix::sum(&[(1.0, &k), (shift, &damp)]);
        let layout = BandLayout::in_order(&shifted);
        let dense = dense.map(|dense| dense.submatrix(unknowns));
        Self { m, c, k, dense, damp, shifted, layout, shift }
    }

    pub fn order(&self) -> usize {
        self.m.rows()
    }

    /// Whether C is unsymmetric, as gyroscopic effect makes it.
    pub fn is_gyroscopic(&self) -> bool {
        let largest = self.c.max_abs();
        self.c.iter().any(|(i, j, v)| (v - self.c.get(j, i)).abs() > 1e-9 * largest)
    }
}

/// Factors of K + σ C + σ² M: banded, or dense if C has a dense part.
pub(super) enum Factors<'a> {
    Band(BandLu<'a, f64>),
    Dense(DenseLu),
}

impl<'a> Factors<'a> {
    pub fn new(group: &'a CoupledGroup) -> Result<Self, EigenError> {
        let factors = match &group.dense {
            None => group.layout.factor(group.layout.scatter(&group.shifted)).ok().map(Self::Band),
            Some(dense) => {
                let mut matrix = group.shifted.to_dense();
                dense.add_to(group.shift, &mut matrix);
                DenseLu::new(&matrix).map(Self::Dense)
            }
        };
        factors.ok_or(EigenError::SingularShift)
    }

    pub fn solve(&self, b: &mut [f64]) {
        match self {
            Self::Band(lu) => lu.solve(b),
            Self::Dense(lu) => lu.solve(b),
        }
    }
}
