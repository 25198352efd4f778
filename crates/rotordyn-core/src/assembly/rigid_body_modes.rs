//! Rigid-body modes (unconstrained motions) of a singular system, described in words.

use super::dofs::DOF_NAMES;
use super::{Assembly, LinearSystem, PhysicsError};
use crate::model::{Drive, Model};
use nalgebra::DMatrix;
use rotordyn_linalg::{BandLayout, SparseMatrix, Triplets, dot, eigen};
use std::f64::consts::TAU;

/// Natural frequency \[rad/s\] below which a mode counts as rigid-body mode: one cycle in a minute.
const RIGID_BODY_MAX_FREQUENCY: f64 = 0.1;

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
    let mut motions = rigid_body_modes(assembly, &stiffness_of_machine(model, assembly))?;
    leave_out_spin(model, &mut motions);
    Ok(motions)
}

/// Motions among [`rigid_body_modes_of_machine`] that stiffness holds all the same, with their natural frequencies \[Hz\]: of
/// an inertia so large that they count as rigid-body modes.
///
/// # Errors
/// No convergence of the undamped modes.
pub fn held_motions_of_machine(
    model: &Model,
    assembly: &Assembly,
) -> Result<Vec<(String, f64)>, PhysicsError> {
    /// xᵀ K x over Σ |xᵢ K_ij xⱼ| above which a shape deforms the structure: of a rigid-body mode it is round-off, of a disc on a
    /// shaft of N elements that twists or bends about 1/N² to 1/N⁴.
    const DEFORMS: f64 = 1e-9;
    let stiffness = stiffness_of_machine(model, assembly);
    let failed = |reason: String| PhysicsError::Eigen { speed_rpm: 0.0, reason };
    let shapes = zero_frequency_shapes(&assembly.mass, &stiffness).map_err(failed)?;
    let mut held = Vec::new();
    for x in shapes {
        let energy = dot(&x, &stiffness.mul(&x));
        let terms: f64 = stiffness.iter().map(|(i, j, v)| (x[i] * v * x[j]).abs()).sum();
        let square = energy / dot(&x, &assembly.mass.mul(&x));
        if energy > DEFORMS * terms {
            let names = describe(assembly, std::slice::from_ref(&x));
            held.extend(names.into_iter().map(|name| (name, square.sqrt() / TAU)));
        }
    }
    Ok(held)
}

/// Stiffness of structure, belts and bearings at standstill, all contacts of bearings taken as closed.
fn stiffness_of_machine(model: &Model, assembly: &Assembly) -> SparseMatrix {
    let n = assembly.dofs.len();
    let mut bearings = Triplets::new(n, n);
    for (site, place) in model.bearings.iter().zip(&assembly.sites) {
        bearings.add_between_rows(&place.rows, &site.bearing.nominal_stiffness());
    }
    SparseMatrix::sum(&[
        (1.0, &assembly.stiffness),
        (1.0, &assembly.belt_stiffness),
        (1.0, &bearings.build()),
    ])
}

/// Leaves out the rotation of the shaft about z, unless a prescribed drive station should constrain it.
pub fn leave_out_spin(model: &Model, motions: &mut Vec<String>) {
    let constrained_by_drive = matches!(model.drive, Drive::Prescribed { node: Some(_) });
    motions.retain(|motion| constrained_by_drive || motion != SPIN);
}

/// Axial motion of the whole shaft.
pub const AXIAL: &str = "axial motion of the shaft (u_z)";

const SPIN: &str = "rotation of the shaft about z (θ_z)";

fn rigid_body_modes(assembly: &Assembly, stiffness: &SparseMatrix) -> Result<Vec<String>, PhysicsError> {
    let failed = |reason: String| PhysicsError::Eigen { speed_rpm: 0.0, reason };
    let shapes = zero_frequency_shapes(&assembly.mass, stiffness).map_err(failed)?;
    Ok(describe(assembly, &shapes))
}

/// Shapes of the modes below [`RIGID_BODY_MAX_FREQUENCY`], by subspace iteration with (K + M)⁻¹ M, whose eigenvalues are
/// 1/(ω² + 1): near 1 for a rigid-body mode, near 0 for an elastic one.
fn zero_frequency_shapes(mass: &SparseMatrix, stiffness: &SparseMatrix) -> Result<Vec<Vec<f64>>, String> {
    /// After these an elastic mode of 10 rad/s is reduced by 1e-6, and by 1e-16; the Ritz values separate slower ones.
    const STEPS: [usize; 2] = [3, 5];
    /// The first ones are enough if the squares of all frequencies are this much smaller or larger than the limit.
    const CLEAR: f64 = 1e4;
    /// Multiples of M where K + M is singular to round-off \[rad²/s²\].
    const SHIFTS: [f64; 3] = [1e3, 1e6, 1e9];
    /// xᵀ K x over Σ |xᵢ K_ij xⱼ| that is round-off.
    const ROUND_OFF: f64 = 4e-15;
    let limit = RIGID_BODY_MAX_FREQUENCY * RIGID_BODY_MAX_FREQUENCY;
    let is_clear = |square: &f64| square.abs() < limit / CLEAR || *square > limit * CLEAR;
    let size = mass.rows();
    let layout = BandLayout::new(&[mass, stiffness]);
    let [k, m] = [stiffness, mass].map(|matrix| layout.scatter(matrix));
    let shifted = |shift: f64| layout.factor::<f64>(k.iter().zip(&m).map(|(k, m)| k + shift * m).collect());
    // In small machines, whose natural frequencies are high, M may be below the round-off of K.
    let factors = shifted(1.0).or_else(|pivot| {
        let larger = SHIFTS.iter().find_map(|shift| shifted(*shift).ok());
        larger.ok_or_else(|| format!("K + M is singular: {pivot:?}"))
    })?;
    // Most machines have none, or the rotation about z.
    let mut width = 4.min(size);
    loop {
        // Start vectors with a component in every mode.
        let start = |j: usize| (0..size).map(move |k| ((1.0 + k as f64) * (1.0 + 0.37 * j as f64)).sin());
        let mut basis: Vec<Vec<f64>> = (0..width).map(|j| start(j).collect()).collect();
        let mut iterate = |steps: usize| {
            for _ in 0..steps {
                for x in &mut basis {
                    *x = mass.mul(x);
                    factors.solve(x);
                }
                orthonormalise(mass, &mut basis);
            }
            let images: Vec<Vec<f64>> = basis.iter().map(|x| stiffness.mul(x)).collect();
            let projected = DMatrix::from_fn(basis.len(), basis.len(), |i, j| dot(&basis[i], &images[j]));
            eigen::symmetric(&projected).map_err(|e| e.to_string())
        };
        let (mut squares, mut turns) = iterate(STEPS[0])?;
        if !squares.iter().all(is_clear) {
            (squares, turns) = iterate(STEPS[1])?;
        }
        let shape = |k: usize| {
            let mut out = vec![0.0; size];
            for (i, x) in basis.iter().enumerate() {
                out.iter_mut().zip(x).for_each(|(out, x)| *out += turns[(i, k)] * x);
            }
            out
        };
        let is_rigid = |k: &usize| {
            squares[*k].abs() < limit || {
                let x = shape(*k);
                let forces: f64 = stiffness.iter().map(|(i, j, v)| (x[i] * v * x[j]).abs()).sum();
                squares[*k].abs() < ROUND_OFF * forces
            }
        };
        let rigid: Vec<usize> = (0..squares.len()).filter(is_rigid).collect();
        if rigid.len() < width || width == size {
            return Ok(rigid.into_iter().map(shape).collect());
        }
        width = (2 * width).min(size);
    }
}

/// Modified Gram-Schmidt with xᵀ M x = 1; vectors that depend on the others are left out.
fn orthonormalise(mass: &SparseMatrix, basis: &mut Vec<Vec<f64>>) {
    let mut done: Vec<(Vec<f64>, Vec<f64>)> = Vec::new();
    for mut x in std::mem::take(basis) {
        let before = dot(&x, &mass.mul(&x));
        // Twice, for orthogonality to round-off.
        for _ in 0..2 {
            for (other, momentum) in &done {
                let part = dot(&x, momentum);
                x.iter_mut().zip(other).for_each(|(x, other)| *x -= part * other);
            }
        }
        let square = dot(&x, &mass.mul(&x));
        if square > 1e-24 * before {
            let size = square.sqrt();
            x.iter_mut().for_each(|x| *x /= size);
            let momentum = mass.mul(&x);
            done.push((x, momentum));
        }
    }
    *basis = done.into_iter().map(|(x, _)| x).collect();
}

/// Names as many motions as there are shapes: body and direction by their kinetic energy in all shapes together, which no
/// combination of modes of the same frequency changes. Of the shaft's lateral energy only that of its centre of mass is
/// translation, the rest is tilting.
fn describe(assembly: &Assembly, shapes: &[Vec<f64>]) -> Vec<String> {
    /// Share of the energy in a direction from which on the shaft takes part, and its bodies with it.
    const SHAFT_MOVES: f64 = 1e-3;
    let dofs = &assembly.dofs;
    // Shaft as one body, then every other body, six directions each.
    let bodies = dofs.node_names.len() - dofs.shaft_nodes;
    let mut energy = vec![[0.0; 6]; 1 + bodies];
    let shaft = |direction: usize| (0..dofs.shaft_nodes).map(move |node| 6 * node + direction);
    let mut translation = vec![0.0; 6 * dofs.node_names.len()];
    shaft(0).for_each(|i| translation[i] = 1.0);
    let momentum = assembly.full_mass.mul(&translation);
    let shaft_mass: f64 = shaft(0).map(|i| momentum[i]).sum();
    for shape in shapes {
        let full = dofs.expand(shape);
        let momentum = assembly.full_mass.mul(&full);
        for (i, (q, p)) in full.iter().zip(&momentum).enumerate() {
            let node = i / 6;
            let owner = if node < dofs.shaft_nodes { 0 } else { node - dofs.shaft_nodes + 1 };
            energy[owner][i % 6] += q * p;
        }
        for (lateral, tilt) in [(0, 4), (1, 3)] {
            let total: f64 = shaft(lateral).map(|i| full[i] * momentum[i]).sum();
            let along: f64 = shaft(lateral).map(|i| momentum[i]).sum();
            let of_centre = if shaft_mass > 0.0 { along * along / shaft_mass } else { total };
            energy[0][lateral] -= total - of_centre;
            energy[0][tilt] += total - of_centre;
        }
    }
    let mut motions: Vec<(f64, usize, usize)> = Vec::new();
    for direction in 0..6 {
        let total: f64 = energy.iter().map(|of| of[direction]).sum();
        if energy[0][direction] > SHAFT_MOVES * total {
            motions.push((total, 0, direction));
        } else {
            motions
                .extend(energy.iter().enumerate().skip(1).map(|(body, of)| (of[direction], body, direction)));
        }
    }
    motions.sort_by(|a, b| b.0.total_cmp(&a.0));
    motions.truncate(shapes.len());
    motions.into_iter().map(|(_, owner, direction)| name_of(assembly, owner, direction)).collect()
}

/// The motion of the body that a DOF moves most, such as the DOF at which a factorisation fails.
pub fn motion_of(assembly: &Assembly, unknown: usize) -> String {
    let dofs = &assembly.dofs;
    let mut shape = vec![0.0; dofs.len()];
    shape[unknown] = 1.0;
    let full = dofs.expand(&shape);
    let most = (0..full.len()).max_by(|&a, &b| full[a].abs().total_cmp(&full[b].abs()).then(b.cmp(&a)));
    let moved = most.unwrap_or(0);
    name_of(assembly, (moved / 6 + 1).saturating_sub(dofs.shaft_nodes), moved % 6)
}

/// What a system that cannot be solved leaves free: its rigid-body modes, else the motion of the unknown at which its
/// factorisation fails.
pub fn unconstrained_motion(assembly: &Assembly, system: &LinearSystem, unknown: usize) -> String {
    let motions = rigid_body_modes_of(assembly, system).unwrap_or_default();
    if motions.is_empty() { motion_of(assembly, unknown) } else { motions.join(", ") }
}

/// Name of a motion; `owner`: 0 for the shaft, else the number of a body from 1.
fn name_of(assembly: &Assembly, owner: usize, direction: usize) -> String {
    let dofs = &assembly.dofs;
    match (owner, direction) {
        (0, 2) => AXIAL.into(),
        (0, 5) => SPIN.into(),
        (0, 0 | 1) => format!("lateral motion of the shaft ({})", DOF_NAMES[direction]),
        (0, _) => format!("tilting of the shaft ({})", DOF_NAMES[direction]),
        (body, _) => {
            format!("body `{}` ({})", dofs.node_names[dofs.shaft_nodes + body - 1], DOF_NAMES[direction])
        }
    }
}
