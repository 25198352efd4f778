//! Rigid-body modes (unconstrained motions) of a singular system, described in words.

use super::dofs::DOF_NAMES;
use super::{Assembly, LinearSystem, PhysicsError};
use crate::model::{Drive, Model};
use rotordyn_linalg::{BandLayout, SparseMatrix, Triplets, dot, eigen};

/// Natural frequency \[rad/s\] below which a mode counts as rigid-body mode: one cycle in ten minutes.
const RIGID_BODY_MAX_FREQUENCY: f64 = 0.01;

/// Fails on a rigid-body mode of the stiffness, naming it; `ignore_spin` permits rotation of the shaft about
/// z.
///
/// # Errors
/// [`PhysicsError::Singular`] with the rigid-body mode, such as "axial motion of the shaft (u_z)".
pub fn check_constrained(
    assembly: &Assembly,
    stiffness: &SparseMatrix,
    ignore_spin: bool,
) -> Result<(), PhysicsError> {
    match rigid_body_modes(assembly, stiffness)?.into_iter().find(|m| !(ignore_spin && m == SPIN)) {
        Some(motion) => Err(PhysicsError::Singular { motion }),
        None => Ok(()),
    }
}

/// All rigid-body modes of a linear system in words; empty if fully constrained.
///
/// # Errors
/// No convergence of the undamped modes.
pub fn rigid_body_modes_of(assembly: &Assembly, system: &LinearSystem) -> Result<Vec<String>, PhysicsError> {
    rigid_body_modes(assembly, &system.stiffness)
}

/// All rigid-body modes of structure and bearings at standstill, all contacts of bearings taken as closed;
/// rotation about z is reported only with a prescribed drive station, which should constrain it.
///
/// # Errors
/// No convergence of the undamped modes.
pub fn rigid_body_modes_of_machine(model: &Model, assembly: &Assembly) -> Result<Vec<String>, PhysicsError> {
    let n = assembly.dofs.len();
    let mut bearings = Triplets::new(n, n);
    for (site, place) in model.bearings.iter().zip(&assembly.sites) {
        bearings.add_between_rows(&place.rows, &site.bearing.nominal_stiffness());
    }
    let stiffness = SparseMatrix::sum(&[
        (1.0, &assembly.stiffness),
        (1.0, &assembly.belt_stiffness),
        (1.0, &bearings.build()),
    ]);
    let mut motions = if may_have_rigid_body_mode(assembly, &stiffness) {
        rigid_body_modes(assembly, &stiffness)?
    } else {
        Vec::new()
    };
    let constrained_by_drive = matches!(model.drive, Drive::Prescribed { node: Some(_) });
    motions.retain(|motion| constrained_by_drive || motion != SPIN);
    Ok(motions)
}

/// Whether the lowest mode may be a rigid-body mode, by a few steps of inverse iteration on (K + M) x = M x.
fn may_have_rigid_body_mode(assembly: &Assembly, stiffness: &SparseMatrix) -> bool {
    const STEPS: usize = 8;
    let mass = &assembly.mass;
    let layout = BandLayout::new(&[mass, stiffness]);
    let values = layout.scatter(stiffness).iter().zip(layout.scatter(mass)).map(|(k, m)| k + m).collect();
    let Ok(factors) = layout.factor::<f64>(values) else { return true };
    // Start vector with a component in every mode.
    let mut x: Vec<f64> = (0..assembly.dofs.len()).map(|k| (1.0 + k as f64).sin()).collect();
    let mut lowest_mode = 0.0;
    for _ in 0..STEPS {
        let momentum = mass.mul(&x);
        let size = dot(&x, &momentum).sqrt();
        x = momentum.iter().map(|p| p / size).collect();
        factors.solve(&mut x);
        let response = mass.mul(&x);
        // Converges from below to 1/(ω² + 1) of the lowest mode.
        lowest_mode = dot(&x, &response).sqrt();
    }
    // Threshold between a rigid-body mode (1) and the lowest elastic mode (near 0).
    lowest_mode.is_nan() || lowest_mode > 0.5
}

const SPIN: &str = "rotation of the shaft about z (θ_z)";

fn rigid_body_modes(assembly: &Assembly, stiffness: &SparseMatrix) -> Result<Vec<String>, PhysicsError> {
    let (squares, shapes) = eigen::undamped(&stiffness.to_dense(), &assembly.mass.to_dense(), 1.0)
        .map_err(|e| PhysicsError::Eigen { speed_rpm: 0.0, reason: e.to_string() })?;
    let mut names: Vec<String> = Vec::new();
    for (square, shape) in squares.iter().zip(shapes.column_iter()) {
        if *square < RIGID_BODY_MAX_FREQUENCY * RIGID_BODY_MAX_FREQUENCY {
            let name = describe(assembly, shape.as_slice());
            if !names.contains(&name) {
                names.push(name);
            }
        }
    }
    Ok(names)
}

/// Describes a rigid-body mode by the body and direction with most of its kinetic energy.
fn describe(assembly: &Assembly, shape: &[f64]) -> String {
    let dofs = &assembly.dofs;
    let full = dofs.expand(shape);
    let momentum = assembly.full_mass.mul(&full);
    // Shaft as one body, then every other body, six directions each.
    let bodies = dofs.node_names.len() - dofs.shaft_nodes;
    let mut energy = vec![[0.0; 6]; 1 + bodies];
    for (i, (q, p)) in full.iter().zip(&momentum).enumerate() {
        let node = i / 6;
        let owner = if node < dofs.shaft_nodes { 0 } else { node - dofs.shaft_nodes + 1 };
        energy[owner][i % 6] += q * p;
    }
    let (owner, dof) = (0..energy.len())
        .flat_map(|b| (0..6).map(move |d| (b, d)))
        .max_by(|a, b| energy[a.0][a.1].total_cmp(&energy[b.0][b.1]))
        .unwrap_or((0, 0));
    match (owner, dof) {
        (0, 2) => "axial motion of the shaft (u_z)".into(),
        (0, 5) => SPIN.into(),
        (0, 0 | 1) => format!("lateral motion of the shaft ({})", DOF_NAMES[dof]),
        (0, _) => format!("tilting of the shaft ({})", DOF_NAMES[dof]),
        (b, d) => format!("body `{}` ({})", dofs.node_names[dofs.shaft_nodes + b - 1], DOF_NAMES[d]),
    }
}
