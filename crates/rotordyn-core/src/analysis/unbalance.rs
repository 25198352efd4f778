//! Steady-state unbalance response (synchronous, 1x) over speed.

use super::campbell::Tangents;
use super::frf::derivative_factor;
use super::harmonic::HarmonicSystem;
use super::mode_kind::whirl_index;
use crate::assembly::rigid_body_modes::unconstrained_motion;
use crate::assembly::{Assembly, LinearSystem, PhysicsError};
use crate::model::Quantity;
use rayon::prelude::*;
use rotordyn_linalg::{Complex64, SparseRow};
use serde::{Deserialize, Serialize};

/// Complex amplitudes q(t) = Re(Q e^{jΩt}) over speed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct UnbalanceResponse {
    /// Speeds Ω \[rad/s\].
    pub speeds: Vec<f64>,
    /// Q over the free DOFs at every speed.
    pub amplitudes: Vec<Vec<Complex64>>,
}

/// Elliptic orbit x = Re(X e^{jΩt}), y = Re(Y e^{jΩt}).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Orbit {
    /// Semi-major axis \[m\].
    pub major: f64,
    /// Semi-minor axis \[m\], positive for forward whirl, negative for backward whirl.
    pub minor: f64,
    /// Angle of the major axis from +x towards +y \[rad\].
    pub inclination: f64,
    /// Whirl index from −1 (backward circle) to 1 (forward circle).
    pub whirl: f64,
}

impl Orbit {
    /// Orbit of two complex amplitudes.
    pub fn new(x: Complex64, y: Complex64) -> Self {
        // x + j y = F e^{jΩt} + B* e^{−jΩt}.
        let turn = Complex64::new(0.0, 1.0);
        let (forward, backward) = (0.5 * (x + turn * y), (0.5 * (x - turn * y)).conj());
        Self {
            major: forward.norm() + backward.norm(),
            minor: forward.norm() - backward.norm(),
            inclination: 0.5 * (forward * backward).arg(),
            whirl: whirl_index(x, y),
        }
    }
}

impl UnbalanceResponse {
    /// Complex amplitude of a row (a probe's direction) over speed.
    pub fn amplitude_of(&self, row: &SparseRow, quantity: Quantity) -> Vec<Complex64> {
        let one =
            |(speed, q): (&f64, &Vec<Complex64>)| derivative_factor(quantity, *speed) * row.dot_complex(q);
        self.speeds.iter().zip(&self.amplitudes).map(one).collect()
    }

    /// Orbit of a point, given by its u_x and u_y rows, over speed.
    pub fn orbits(&self, x: &SparseRow, y: &SparseRow) -> Vec<Orbit> {
        self.amplitudes.iter().map(|q| Orbit::new(x.dot_complex(q), y.dot_complex(q))).collect()
    }
}

/// Q = (S − Ω² M + jΩ D)⁻¹ F with F_x = U Ω² e^{jϕ}, F_y = −j F_x at every speed \[rad/s\].
///
/// # Errors
/// A speed at which the dynamic stiffness is singular, or errors of the tangents.
pub fn response(
    assembly: &Assembly,
    speeds: &[f64],
    tangents: &impl Tangents,
) -> Result<UnbalanceResponse, PhysicsError> {
    let amplitudes = speeds
        .par_iter()
        .map(|&speed| {
            let system = LinearSystem::new(assembly, &tangents(speed)?, speed)?;
            let mut q = assembly.unbalance_amplitude(speed);
            let reached: Vec<usize> = (0..q.len()).filter(|&i| q[i] != Complex64::default()).collect();
            let harmonic = HarmonicSystem::new(&system, Some(&reached));
            let mut solver = harmonic.solver();
            solver.factor(speed).map_err(|pivot| PhysicsError::Singular {
                motion: unconstrained_motion(assembly, &system, pivot.unknown),
            })?;
            solver.solve(&mut q);
            Ok(q)
        })
        .collect::<Result<_, PhysicsError>>()?;
    Ok(UnbalanceResponse { speeds: speeds.to_vec(), amplitudes })
}
