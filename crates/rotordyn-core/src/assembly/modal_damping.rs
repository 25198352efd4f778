//! Modal damping: a damping ratio for every undamped mode at standstill.

use rotordyn_linalg::{GroupDense, Outside, SparseMatrix, piecewise};
use std::f64::consts::TAU;

/// Modal damping C = M Φ diag(2 ζ ω) Φᵀ M of the undamped modes at standstill: (½ (K + Kᵀ) − ω² M) φ = 0, Φᵀ M Φ = 1.
///
/// K is the stiffness of structure, belts and bearings at standstill (Ω = 0, cage-averaged). Its skew-symmetric
/// part (cross-coupling k_xy = −k_yx) stores no energy and belongs to no mode: it is left out of C and kept in
/// the equations of motion. The same C holds at all speeds and in all studies, transient ones included: at speed
/// the damping ratio of a mode differs from the table where gyroscopic effect or speed-dependent bearings change
/// the mode. ζ is linear between the rows of the table and constant beyond them; rigid-body modes and modes of
/// negative stiffness (ω² ≤ 0) are not damped.
#[derive(Clone, Debug)]
pub struct ModalDamping {
    /// Damping table: (frequency \[Hz\], ζ).
    pub table: Vec<[f64; 2]>,
    /// ½ (K + Kᵀ) at standstill.
    pub stiffness: SparseMatrix,
    /// C: dense within the groups of unknowns coupled by M and K.
    pub matrix: GroupDense,
}

impl ModalDamping {
    /// ζ at a frequency \[rad/s\].
    pub fn ratio(&self, omega: f64) -> f64 {
        ratio(&self.table, omega)
    }
}

pub(super) fn ratio(table: &[[f64; 2]], omega: f64) -> f64 {
    piecewise(table, omega / TAU, Outside::Constant)[1]
}
