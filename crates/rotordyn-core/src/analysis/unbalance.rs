//! Steady-state unbalance response (synchronous, 1x) over speed.

use super::campbell::Tangents;
use super::frf::derivative_factor;
use super::harmonic::HarmonicSystem;
use super::mode_kind::whirl_index;
use crate::assembly::rigid_body_modes::unconstrained_motion;
use crate::assembly::{Assembly, LinearSystem, PhysicsError, Site};
use crate::model::Quantity;
use rayon::prelude::*;
use rotordyn_bearing::SiteTangent;
use rotordyn_linalg::{Complex64, SparseRow};

/// Complex amplitudes q(t) = Re(Q e^{jΩt}) at one speed.
#[derive(Clone, Debug, PartialEq)]
pub struct UnbalanceMotion {
    /// Ω \[rad/s\].
    pub speed: f64,
    /// Q over the free DOFs.
    pub amplitude: Vec<Complex64>,
    /// Forces and moments of every bearing on the shaft, F_x F_y F_z M_x M_y M_z \[N, N m\].
    pub bearing_forces: Vec<[Complex64; 6]>,
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

impl UnbalanceMotion {
    /// Complex amplitude of a row (a probe's direction).
    pub fn amplitude_of(&self, row: &SparseRow, quantity: Quantity) -> Complex64 {
        derivative_factor(quantity, self.speed) * row.dot_complex(&self.amplitude)
    }
}

/// Q = (S − Ω² M + jΩ D)⁻¹ F with F_x = U Ω² e^{jϕ}, F_y = −j F_x at every speed \[rad/s\]; of each motion only what
/// `observe` takes from it is kept.
///
/// # Errors
/// A speed at which the dynamic stiffness is singular, or errors of the tangents.
pub fn response<T: Send>(
    assembly: &Assembly,
    speeds: &[f64],
    tangents: &impl Tangents,
    observe: impl Fn(UnbalanceMotion) -> T + Sync,
) -> Result<Vec<T>, PhysicsError> {
    let motion = |&speed: &f64| motion(assembly, speed, &tangents(speed)?).map(&observe);
    speeds.par_iter().map(motion).collect()
}

fn motion(
    assembly: &Assembly,
    speed: f64,
    tangents: &[SiteTangent],
) -> Result<UnbalanceMotion, PhysicsError> {
    let system = LinearSystem::new(assembly, tangents, speed)?;
    let mut amplitude = assembly.unbalance_amplitude(speed);
    let reached: Vec<usize> =
        (0..amplitude.len()).filter(|&i| amplitude[i] != Complex64::default()).collect();
    let harmonic = HarmonicSystem::new(&system, Some(&reached));
    let mut solver = harmonic.solver();
    solver.factor(speed).map_err(|pivot| PhysicsError::Singular {
        motion: unconstrained_motion(assembly, &system, pivot.unknown),
    })?;
    solver.solve(&mut amplitude);
    let sites = assembly.sites.iter().zip(tangents);
    let bearing_forces = sites.map(|(site, t)| bearing_force(site, t, &amplitude, speed)).collect();
    Ok(UnbalanceMotion { speed, amplitude, bearing_forces })
}

/// Force of a bearing on the shaft, F = −(K + jΩ C) d with its relative displacement d.
fn bearing_force(site: &Site, tangent: &SiteTangent, q: &[Complex64], speed: f64) -> [Complex64; 6] {
    let d: [Complex64; 6] = std::array::from_fn(|i| site.rows[i].dot_complex(q));
    std::array::from_fn(|i| {
        let (k, c) = (&tangent.stiffness[i], &tangent.damping[i]);
        -(0..6).map(|j| Complex64::new(k[j], speed * c[j]) * d[j]).sum::<Complex64>()
    })
}
