//! Free motions: what a singular system leaves without restraint, in words.

use super::dofs::DOF_NAMES;
use super::{Assembly, DofMap, LinearSystem};
use crate::error::{Error, PhysicsError};
use crate::linalg::{SparseMatrix, eigen};

/// Slower than this \[rad/s\], a motion counts as free: one turn in ten minutes.
const FREE_BELOW: f64 = 0.01;

/// Fails when the stiffness leaves a motion free, naming it; `ignore_spin` lets the shaft turn about z.
///
/// # Errors
/// The free motion, such as "axial motion of the shaft (u_z)".
pub fn check_restrained(
    assembly: &Assembly,
    stiffness: &SparseMatrix,
    ignore_spin: bool,
) -> Result<(), Error> {
    match free_motions(assembly, stiffness)?.into_iter().find(|m| !(ignore_spin && m == SPIN)) {
        Some(motion) => Err(PhysicsError::Singular { motion }.into()),
        None => Ok(()),
    }
}

/// Every free motion of a linear system in words; empty when all is held.
///
/// # Errors
/// No convergence of the undamped modes.
pub fn free_motions_of(assembly: &Assembly, system: &LinearSystem) -> Result<Vec<String>, Error> {
    free_motions(assembly, &system.stiffness)
}

const SPIN: &str = "rotation of the shaft about z (θ_z)";

fn free_motions(assembly: &Assembly, stiffness: &SparseMatrix) -> Result<Vec<String>, Error> {
    let (squares, shapes) = eigen::undamped(&stiffness.to_dense(), &assembly.mass.to_dense(), 1.0)
        .map_err(|e| PhysicsError::Eigen { speed_rpm: 0.0, reason: e.to_string() })?;
    let mut names: Vec<String> = Vec::new();
    for (square, shape) in squares.iter().zip(shapes.column_iter()) {
        if *square < FREE_BELOW * FREE_BELOW {
            let name = describe(assembly, shape.as_slice());
            if !names.contains(&name) {
                names.push(name);
            }
        }
    }
    Ok(names)
}

/// A free motion by the body and direction that hold most of its kinetic energy.
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

/// Every free DOF must carry inertia.
pub(super) fn check_mass(assembly: &Assembly) -> Result<(), Error> {
    let dofs: &DofMap = &assembly.dofs;
    match (0..dofs.len()).find(|&k| assembly.mass.get(k, k) <= 0.0) {
        Some(k) => Err(PhysicsError::Singular { motion: format!("{} (no inertia)", dofs.name(k)) }.into()),
        None => Ok(()),
    }
}
