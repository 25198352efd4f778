//! Assembly of the elements over all DOFs (six per node), before elimination of constraints.

use crate::element::ElementMatrices;
use crate::element::shaft_matrices::ConeRule;
use crate::model::Model;
use rotordyn_linalg::{SparseMatrix, SparseRow, Triplets};

/// Matrices over all DOFs.
pub(super) struct FullMatrices {
    pub mass: SparseMatrix,
    pub stiffness: SparseMatrix,
    /// Of belts with constant pull.
    pub belt_stiffness: SparseMatrix,
    pub damping: SparseMatrix,
    /// The part of the damping between shaft and supports.
    pub support_damping: SparseMatrix,
    pub gyroscopic: SparseMatrix,
    pub circulatory: SparseMatrix,
}

pub(super) fn assemble(model: &Model, rule: ConeRule) -> FullMatrices {
    let mut all = ElementMatrices::new(6 * model.node_count(), rule);
    for (node, element) in model.elements() {
        element.add_matrices(node, &mut all);
    }
    for site in &model.bearings {
        let added = site.bearing.added_housing_mass();
        if added != 0.0 {
            let [x, y, ..] = site.housing.rows();
            for row in [x, y] {
                all.mass.add_between_rows(&[row], &[[added]]);
            }
        }
    }
    let [mass, stiffness, mut damping] = [all.mass.build(), all.stiffness.build(), all.damping.build()];
    let [alpha, beta] = model.damping.proportional;
    if alpha != 0.0 || beta != 0.0 {
        damping = SparseMatrix::sum(&[(1.0, &damping), (alpha, &mass), (beta, &stiffness)]);
    }
    FullMatrices {
        mass,
        stiffness,
        belt_stiffness: all.deviation_stiffness.build(),
        damping,
        support_damping: all.support_damping.build(),
        gyroscopic: all.gyroscopic.build(),
        circulatory: all.circulatory.build(),
    }
}

/// Sᵀ C_i S from K_c = −C_i S over all DOFs, S the turn by 90° about z: −Sᵀ K_c, with Sᵀ (x, y) = (y, −x).
pub(super) fn rotating_damping(circulatory: &SparseMatrix, n: usize) -> SparseMatrix {
    let mut out = Triplets::new(n, n);
    for (row, column, value) in circulatory.iter() {
        match row % 3 {
            0 => out.add(row + 1, column, value),
            1 => out.add(row - 1, column, -value),
            _ => {}
        }
    }
    out.build()
}

/// Gravity on every mass, and constant loads with those of elements, over all DOFs.
pub(super) fn loads(model: &Model, mass: &SparseMatrix) -> (Vec<f64>, Vec<f64>) {
    let n = 6 * model.node_count();
    let acceleration: Vec<f64> = (0..n).map(|i| if i % 6 < 3 { model.gravity[i % 6] } else { 0.0 }).collect();
    let mut static_load = vec![0.0; n];
    for load in model.loads.iter().filter(|load| load.factor.is_constant()) {
        add_force(&load.at.rows(), &load.force, &mut static_load);
    }
    for (_, element) in model.elements() {
        element.add_load(&mut static_load);
    }
    (mass.mul(&acceleration), static_load)
}

/// Adds force and moment at the point of `rows`.
pub(super) fn add_force(rows: &[SparseRow; 6], force: &[f64; 6], to: &mut [f64]) {
    for (row, &f) in rows.iter().zip(force) {
        row.add_to(f, to);
    }
}
