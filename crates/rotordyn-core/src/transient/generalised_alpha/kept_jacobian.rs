//! A Jacobian of the interface problem that serves many steps, and how fast Newton's iteration converges with it.

use std::ops::Range;

use nalgebra::DMatrix;
use rotordyn_bearing::internal::NewmarkGain;
use rotordyn_linalg::panel::Panel;
use rotordyn_linalg::small_dense::PaddedMatrix;
use serde::{Deserialize, Serialize};

/// Contraction per solution before any was measured.
const UNKNOWN_DRIFT: f64 = 1.0;

/// I + Y T with T = b K + c C block by block, factored.
pub(super) struct KeptJacobian {
    /// T.
    pub tangent: PaddedMatrix,
    factors: PaddedMatrix,
    /// If it is kept.
    inverse: Panel,
    column: Vec<f64>,
    kept: Kept,
}

/// What later solutions take from the Jacobian; the factors follow from it.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct Kept {
    /// b and c for which it holds; empty before the first one and for bearings that need their own in every iteration.
    gain: Option<[f64; 2]>,
    /// Y and T, row by row.
    compliance: Vec<f64>,
    tangent: Vec<f64>,
    /// Solutions found with it.
    solutions: u32,
    /// Measured contraction, over the number of solutions before.
    drift: Option<f64>,
}

impl Kept {
    /// Whether it is one of a system with this many interface rows.
    pub fn fits(&self, rows: usize) -> bool {
        let matrices = [&self.compliance, &self.tangent];
        match self.gain {
            None => matrices.iter().all(|matrix| matrix.len() <= rows * rows),
            Some(_) => rows > 0 && matrices.iter().all(|matrix| matrix.len() == rows * rows),
        }
    }
}

impl KeptJacobian {
    pub fn new(rows: usize) -> Self {
        Self {
            tangent: PaddedMatrix::new(rows),
            factors: PaddedMatrix::new(rows),
            inverse: Panel::new(&[&DMatrix::zeros(rows, rows)]),
            column: vec![0.0; rows],
            kept: Kept::default(),
        }
    }

    /// What the next solution needs of it.
    pub fn memory(&self) -> Kept {
        self.kept.clone()
    }

    /// The Jacobian that left `memory`, with the same bits; `blocks`: as in [`Self::factor`].
    pub fn after(memory: &Kept, rows: usize, blocks: &[Range<usize>]) -> Self {
        let mut out = Self { kept: memory.clone(), ..Self::new(rows) };
        if memory.gain.is_some() {
            for (row, line) in memory.tangent.chunks_exact(rows).enumerate() {
                out.tangent.row_mut(row)[..rows].copy_from_slice(line);
            }
            out.factors.set_to_identity_plus_product(&memory.compliance, &out.tangent, blocks);
            // It had factors when it was stored.
            out.factors.factor();
            out.invert();
        }
        out
    }

    /// Whether there is one for these gains.
    pub fn is_for(&self, gain: &NewmarkGain) -> bool {
        self.kept.gain == Some([gain.position, gain.velocity])
    }

    /// Forms the Jacobian from `tangent`, whose blocks are at the rows and columns `blocks`; false if it is singular.
    ///
    /// `is_kept`: whether later solutions may use it.
    pub fn factor(
        &mut self,
        gain: &NewmarkGain,
        compliance: &[f64],
        blocks: &[Range<usize>],
        is_kept: bool,
    ) -> bool {
        self.factors.set_to_identity_plus_product(compliance, &self.tangent, blocks);
        self.kept.gain = None;
        self.kept.solutions = 0;
        if !self.factors.factor() {
            return false;
        }
        if is_kept {
            let rows = blocks.last().map_or(0, |block| block.end);
            self.invert();
            self.kept.gain = Some([gain.position, gain.velocity]);
            self.kept.compliance.clear();
            self.kept.compliance.extend_from_slice(compliance);
            self.kept.tangent.clear();
            self.kept.tangent.extend((0..rows).flat_map(|row| &self.tangent.row(row)[..rows]));
        }
        true
    }

    /// One product costs less than two triangular solutions, which wait for every row.
    fn invert(&mut self) {
        for k in 0..self.column.len() {
            self.column.fill(0.0);
            self.column[k] = 1.0;
            self.factors.solve(&mut self.column);
            self.inverse.set_column(k, &self.column);
        }
    }

    /// Solves for the correction of a residual.
    pub fn solve(&self, residual: &[f64], correction: &mut [f64]) {
        if self.kept.gain.is_some() {
            correction.fill(0.0);
            self.inverse.mul_add(residual, correction);
        } else {
            correction.copy_from_slice(residual);
            self.factors.solve(correction);
        }
    }

    /// Whether it was formed for an earlier solution.
    pub fn is_old(&self) -> bool {
        self.kept.solutions > 0
    }

    /// The part of a change that the next iteration has to make up for: none with a new Jacobian, whose error is of second order.
    pub fn contraction(&self) -> f64 {
        match self.kept.solutions {
            0 => 0.0,
            solutions => self.kept.drift.unwrap_or(UNKNOWN_DRIFT) * f64::from(solutions),
        }
    }

    /// Notes the change of an iteration and that of the one before with the same old Jacobian.
    pub fn observe(&mut self, change: f64, before: f64) {
        let drift = change / before / f64::from(self.kept.solutions);
        // A change that is small by chance says little.
        let least = 0.5 * self.kept.drift.unwrap_or(0.0);
        self.kept.drift = Some(drift.max(least));
    }

    /// Notes a solution.
    pub fn solved(&mut self) {
        self.kept.solutions += 1;
    }
}
