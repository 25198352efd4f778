//! Assembly of the element matrices over all DOFs (six per node), before elimination of constraints.

use super::dofs::full_rows;
use crate::element::shaft_matrices::{ConeRule, Matrix12};
use crate::element::{Belt, Bushing};
use crate::model::Model;
use rotordyn_linalg::{SparseMatrix, SparseRow, Triplets};

/// Matrices over all DOFs.
pub(super) struct FullMatrices {
    pub mass: SparseMatrix,
    pub stiffness: SparseMatrix,
    pub belt_stiffness: SparseMatrix,
    pub damping: SparseMatrix,
    pub gyroscopic: SparseMatrix,
    pub circulatory: SparseMatrix,
}

pub(super) fn assemble(model: &Model, rule: ConeRule) -> FullMatrices {
    let n = 6 * model.node_count();
    let [mut m, mut k, mut kb, mut c, mut g, mut kc] = std::array::from_fn(|_| Triplets::new(n, n));
    for (e, element) in model.shaft.iter().enumerate() {
        let mass = element.mass_matrix(rule);
        let elastic = element.elastic_stiffness(rule);
        let geometric = element.geometric_stiffness();
        add12(&mut m, e, &mass, 1.0);
        add12(&mut k, e, &elastic, 1.0);
        add12(&mut k, e, &geometric, 1.0);
        add12(&mut c, e, &mass, element.proportional_damping[0]);
        add12(&mut c, e, &elastic, element.proportional_damping[1] + element.internal_viscous);
        add12(&mut c, e, &geometric, element.proportional_damping[1]);
        add12(&mut g, e, &element.gyroscopic_matrix(), 1.0);
        if element.internal_viscous != 0.0 {
            add12(&mut kc, e, &element.circulatory_stiffness(), 1.0);
        }
    }
    for disc in model.rotating_inertias() {
        let at = 6 * disc.node;
        let (mass, id, ip) = (disc.mass, disc.diametral_inertia, disc.polar_inertia);
        for (i, v) in [mass, mass, mass, id, id, ip].into_iter().enumerate() {
            m.add(at + i, at + i, v);
        }
        g.add(at + 3, at + 4, ip);
        g.add(at + 4, at + 3, -ip);
    }
    for (b, body) in model.bodies.iter().enumerate() {
        let at = 6 * (model.node_z.len() + b);
        for i in 0..3 {
            m.add(at + i, at + i, body.mass);
            for j in 0..3 {
                m.add(at + 3 + i, at + 3 + j, body.inertia[i][j]);
            }
        }
    }
    for point in &model.masses {
        let [x, y, z, ..] = full_rows(&point.anchor);
        for row in [x, y, z] {
            m.add_between_rows(&[row], &[[point.mass]]);
        }
    }
    for site in &model.bearings {
        let added = site.bearing.added_housing_mass();
        if added != 0.0 {
            let [x, y, ..] = full_rows(&site.housing);
            for row in [x, y] {
                m.add_between_rows(&[row], &[[added]]);
            }
        }
    }
    for bushing in &model.bushings {
        let rows = bushing_rows(bushing);
        k.add_between_rows(&rows, &bushing.stiffness);
        c.add_between_rows(&rows, &bushing.damping);
    }
    for belt in &model.belts {
        for (dof, stiffness, damping) in belt_terms(belt) {
            if belt.constant_pull { &mut kb } else { &mut k }.add(dof, dof, stiffness);
            c.add(dof, dof, damping);
        }
    }
    let [mass, stiffness, mut damping] = [m.build(), k.build(), c.build()];
    let [alpha, beta] = model.damping.proportional;
    if alpha != 0.0 || beta != 0.0 {
        damping = SparseMatrix::sum(&[(1.0, &damping), (alpha, &mass), (beta, &stiffness)]);
    }
    FullMatrices {
        mass,
        stiffness,
        belt_stiffness: kb.build(),
        damping,
        gyroscopic: g.build(),
        circulatory: kc.build(),
    }
}

/// Damping of bushings and belts over all DOFs.
pub(super) fn support_damping(model: &Model) -> SparseMatrix {
    let n = 6 * model.node_count();
    let mut c = Triplets::new(n, n);
    for bushing in &model.bushings {
        c.add_between_rows(&bushing_rows(bushing), &bushing.damping);
    }
    for belt in &model.belts {
        for (dof, _, damping) in belt_terms(belt) {
            c.add(dof, dof, damping);
        }
    }
    c.build()
}

/// Displacement of a bushing's end a relative to b over all DOFs.
fn bushing_rows(bushing: &Bushing) -> [SparseRow; 6] {
    let (mut rows, other) = (full_rows(&bushing.a), full_rows(&bushing.b));
    for (row, b) in rows.iter_mut().zip(&other) {
        row.add_scaled(-1.0, b);
    }
    rows
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

/// (full DOF, stiffness, damping) of a belt.
fn belt_terms(belt: &Belt) -> [(usize, f64, f64); 3] {
    let at = 6 * belt.node;
    let (k, c) = (belt.stiffness, belt.damping);
    [(at, k[0], c[0]), (at + 1, k[1], c[1]), (at + 5, k[2], c[2])]
}

/// Adds factor × the matrix of shaft element `e`, whose nodes are e and e + 1.
pub(super) fn add12(to: &mut Triplets, e: usize, matrix: &Matrix12, factor: f64) {
    if factor == 0.0 {
        return;
    }
    for (i, row) in matrix.iter().enumerate() {
        for (j, &v) in row.iter().enumerate() {
            if v != 0.0 {
                to.add(6 * e + i, 6 * e + j, factor * v);
            }
        }
    }
}

/// Gravity on every mass, and constant loads with the belts' static pull, over all DOFs.
pub(super) fn loads(model: &Model, mass: &SparseMatrix) -> (Vec<f64>, Vec<f64>) {
    let n = 6 * model.node_count();
    let acceleration: Vec<f64> = (0..n).map(|i| if i % 6 < 3 { model.gravity[i % 6] } else { 0.0 }).collect();
    let mut static_load = vec![0.0; n];
    for load in model.loads.iter().filter(|load| load.history.is_empty()) {
        add_force(&full_rows(&load.at), &load.force, &mut static_load);
    }
    for belt in &model.belts {
        static_load[6 * belt.node] += belt.pull[0];
        static_load[6 * belt.node + 1] += belt.pull[1];
    }
    (mass.mul(&acceleration), static_load)
}

/// Adds force and moment at the point of `rows`.
pub(super) fn add_force(rows: &[SparseRow; 6], force: &[f64; 6], to: &mut [f64]) {
    for (row, &f) in rows.iter().zip(force) {
        row.add_to(f, to);
    }
}
