//! The modal damping matrix, from the undamped modes at standstill.

use super::dense_limit::check_dense;
use super::modal_damping::ratio;
use super::{Assembly, ModalDamping, PhysicsError};
use nalgebra::DMatrix;
use rotordyn_bearing::SiteTangent;
use rotordyn_linalg::{BandLayout, GroupDense, SparseMatrix, Triplets, eigen};
use std::sync::Arc;

/// Shifts σ \[rad²/s²\] of K + σ M, tried in turn: 1 for a rigid-body mode, more for a negative stiffness.
const MASS_SHIFTS: [f64; 5] = [1.0, 1e2, 1e4, 1e6, 1e8];
/// Dense matrices in memory for the block of a group: M, K, factor, congruent K, modes, momenta, weighted ones.
const BLOCK_MATRICES: usize = 7;

impl ModalDamping {
    /// Modal damping with one tangent at standstill per bearing site; `None` without a damping table.
    ///
    /// # Errors
    /// Undamped modes that do not converge, matrices that are not finite, or too large.
    pub fn new(assembly: &Assembly, standstill: &[SiteTangent]) -> Result<Option<Self>, PhysicsError> {
        let table = assembly.modal_damping.clone();
        if table.is_empty() {
            return Ok(None);
        }
        let stiffness = symmetric_stiffness(assembly, standstill);
        let layout = BandLayout::new(&[&assembly.mass, &stiffness]);
        let largest = layout.groups().map(<[usize]>::len).max().unwrap_or(0);
        check_dense("modal damping", largest, BLOCK_MATRICES, &assembly.extent)?;
        let blocks = layout
            .groups()
            .map(|group| Ok((group.to_vec(), block(&assembly.mass, &stiffness, group, &table)?)))
            .collect::<Result<_, eigen::EigenError>>()
            .map_err(|e| PhysicsError::Eigen { speed_rpm: 0.0, reason: format!("modal damping: {e}") })?;
        let matrix = GroupDense::new(assembly.dofs.len(), blocks);
        Ok(Some(Self { table, stiffness, matrix }))
    }
}

impl Assembly {
    /// Computes the modal damping from one tangent at standstill per bearing site, for all speeds and studies.
    ///
    /// # Errors
    /// As [`ModalDamping::new`].
    pub fn set_standstill(&mut self, tangents: &[SiteTangent]) -> Result<(), PhysicsError> {
        self.modal = ModalDamping::new(self, tangents)?.map(Arc::new);
        Ok(())
    }
}

/// ½ (K + Kᵀ) of structure, belts and bearings.
fn symmetric_stiffness(assembly: &Assembly, tangents: &[SiteTangent]) -> SparseMatrix {
    let n = assembly.dofs.len();
    let mut bearings = Triplets::new(n, n);
    for (site, tangent) in assembly.sites.iter().zip(tangents) {
        let k = &tangent.stiffness;
        let symmetric = std::array::from_fn(|a| std::array::from_fn(|b| 0.5 * (k[a][b] + k[b][a])));
        bearings.add_between_rows(&site.rows, &symmetric);
    }
    SparseMatrix::sum(&[
        (1.0, &assembly.stiffness),
        (1.0, &assembly.belt_stiffness),
        (1.0, &bearings.build()),
    ])
}

/// C of one group of coupled unknowns.
fn block(
    mass: &SparseMatrix,
    stiffness: &SparseMatrix,
    group: &[usize],
    table: &[[f64; 2]],
) -> Result<DMatrix<f64>, eigen::EigenError> {
    let n = group.len();
    let dense = |a: &SparseMatrix| {
        DMatrix::from_fn(n, n, |i, j| 0.5 * (a.get(group[i], group[j]) + a.get(group[j], group[i])))
    };
    let (m, k) = (dense(mass), dense(stiffness));
    let mut found = eigen::undamped(&k, &m, MASS_SHIFTS[0]);
    for shift in &MASS_SHIFTS[1..] {
        if found != Err(eigen::EigenError::NotDefinite) {
            break;
        }
        found = eigen::undamped(&k, &m, *shift);
    }
    let (squares, shapes) = found?;
    let momentum = &m * shapes;
    let mut weighted = momentum.clone();
    for (mut column, square) in weighted.column_iter_mut().zip(&squares) {
        let omega = square.max(0.0).sqrt();
        column *= 2.0 * omega * ratio(table, omega);
    }
    Ok(weighted * momentum.transpose())
}
