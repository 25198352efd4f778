//! Undamped torsional modes of the shaft: (K − ω² M) θ = 0 over the rotations about z.

use crate::assembly::{Assembly, LinearSystem, PhysicsError};
use nalgebra::DMatrix;
use rotordyn_linalg::{SparseMatrix, eigen};
use serde::{Deserialize, Serialize};
use std::f64::consts::TAU;

/// Least shift σ that makes K + σ M definite for a shaft free to turn \[rad²/s²\], and its part of the square of the lowest
/// elastic frequency, about Σ K_ii / Σ M_ii / n²: a smaller one loses digits in small machines, whose frequencies are high.
const LEAST_SHIFT: f64 = 1.0;
const SHIFT: f64 = 1e-3;
/// ω² below which a mode is the rigid rotation \[rad²/s²\], and its part of the shift: above the round-off of the shift.
const RIGID: f64 = 1e-4;
const RIGID_OF_SHIFT: f64 = 1e-11;
/// Coupling with other motions, relative to the stiffness of both, above which the modes are not torsional only.
const COUPLED: f64 = 1e-6;

/// A torsional mode.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct TorsionalMode {
    /// Natural frequency \[Hz\].
    pub frequency_hz: f64,
    /// Rotation about z of every shaft node, the largest 1.
    pub twist: Vec<f64>,
}

/// The torsional modes, lowest first, and what restricts them.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct TorsionalModes {
    pub modes: Vec<TorsionalMode>,
    /// Number of rigid rotations: 1 for a shaft free to turn, 0 for one whose rotation is prescribed at a station.
    pub rigid_rotations: usize,
    /// Whether the rotations are coupled with other motions, such as those of housings; the modes neglect that.
    pub coupled: bool,
}

/// The lowest torsional modes of a linear system.
///
/// # Errors
/// An eigenvalue computation that fails.
pub fn torsional_modes(
    assembly: &Assembly,
    system: &LinearSystem,
    count: usize,
) -> Result<TorsionalModes, PhysicsError> {
    let dofs = &assembly.dofs;
    let own: Vec<usize> =
        (0..dofs.len()).filter(|&k| dofs.free[k] % 6 == 5 && dofs.free[k] / 6 < dofs.shaft_nodes).collect();
    if own.is_empty() {
        return Ok(TorsionalModes { modes: Vec::new(), rigid_rotations: 0, coupled: false });
    }
    let dense = |a: &SparseMatrix| {
        DMatrix::from_fn(own.len(), own.len(), |i, j| 0.5 * (a.get(own[i], own[j]) + a.get(own[j], own[i])))
    };
    let (m, k) = (dense(&system.mass), dense(&system.stiffness));
    let is_own = |i: usize| own.binary_search(&i).is_ok();
    let couples = |a: &SparseMatrix| {
        let size = |i: usize| a.get(i, i).abs().sqrt();
        a.iter().any(|(i, j, v)| is_own(i) != is_own(j) && v.abs() > COUPLED * size(i) * size(j))
    };
    let failed =
        |e: eigen::EigenError| PhysicsError::Eigen { speed_rpm: 0.0, reason: format!("torsion: {e}") };
    let elastic = k.trace() / m.trace() / (own.len() * own.len()) as f64;
    let shift = LEAST_SHIFT.max(SHIFT * elastic);
    let (squares, shapes) = eigen::undamped(&k, &m, shift).map_err(failed)?;
    let rigid = squares.iter().filter(|square| **square < RIGID.max(RIGID_OF_SHIFT * shift)).count();
    let modes = squares.iter().zip(shapes.column_iter()).skip(rigid).take(count).map(|(square, shape)| {
        let mut all = vec![0.0; dofs.len()];
        own.iter().zip(shape.iter()).for_each(|(&i, v)| all[i] = *v);
        let full = dofs.expand(&all);
        let twist: Vec<f64> = (0..dofs.shaft_nodes).map(|node| full[6 * node + 5]).collect();
        let largest = twist.iter().fold(0.0, |most: f64, v| if v.abs() > most.abs() { *v } else { most });
        TorsionalMode {
            frequency_hz: square.sqrt() / TAU,
            twist: twist.iter().map(|v| if largest == 0.0 { 0.0 } else { v / largest }).collect(),
        }
    });
    Ok(TorsionalModes {
        modes: modes.collect(),
        rigid_rotations: rigid,
        coupled: couples(&system.mass) || couples(&system.stiffness),
    })
}
