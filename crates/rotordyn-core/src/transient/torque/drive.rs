//! A torque drive and its unbalances in the run's coordinates.

use crate::assembly::PhysicsError;
use crate::transient::numbers::vector;
use nalgebra::{DMatrix, DVector};
use rotordyn_linalg::{Outside, piecewise};
use serde::{Deserialize, Serialize};

/// Driving torque T(Ω) at one node with viscous drag, and what couples the rotation to the other coordinates.
#[derive(Clone, Debug)]
pub struct TorqueDrive {
    /// (speed \[rad/s\], torque \[N m\]), speeds increasing; linear in between, constant outside.
    pub table: Vec<[f64; 2]>,
    /// Viscous drag to ground at the driven node \[N m s/rad\].
    pub drag: f64,
    /// Coordinates of a unit torque at the driven node.
    pub torque: DVector<f64>,
    /// Coordinates of the unit rigid rotation, x_r = Vᵀ M r; x_rᵀ x_r = J, the total polar inertia.
    pub rigid_rotation: DVector<f64>,
    pub unbalances: Vec<RotatingUnbalance>,
    /// Gravity along x and y \[m/s²\].
    pub gravity: [f64; 2],
    /// Moments of bushings and belts at unit speed of a rigid rotation, Vᵀ C r.
    pub rotation_drag: DVector<f64>,
    /// Sᵀ C_i S of internal damping C_i, S the turn by 90° about z; empty without internal damping.
    pub rotating_damping: DMatrix<f64>,
}

/// An unbalance on a node that rotates with the shaft's unknown rotation.
#[derive(Clone, Debug)]
pub struct RotatingUnbalance {
    pub name: String,
    /// Rows of u_x, u_y and θ_z of the node.
    pub x: DVector<f64>,
    pub y: DVector<f64>,
    pub twist: DVector<f64>,
    /// U = m e \[kg m\].
    pub magnitude: f64,
    /// ϕ \[rad\].
    pub phase: f64,
}

/// What a state has under a torque drive in addition.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct DrivenState {
    /// Load of the coupling at the state (see [`super::coupling`]).
    #[serde(with = "vector")]
    pub load: DVector<f64>,
    /// Rotational acceleration of the integrator, to `spin.acceleration` as the state's `a` to `acceleration`.
    pub rate: f64,
}

impl TorqueDrive {
    /// Net torque of drive and drag at a speed \[N m\].
    pub fn torque_at(&self, speed: f64) -> f64 {
        self.motor_torque(speed) - self.drag * speed
    }

    /// Torque of the drive alone at a speed \[N m\].
    pub fn motor_torque(&self, speed: f64) -> f64 {
        piecewise(&self.table, speed, Outside::Constant)[1]
    }

    /// J \[kg m²\].
    pub fn inertia(&self) -> f64 {
        self.rigid_rotation.norm_squared()
    }

    /// Rigid rotation in coordinates y, x_rᵀ y / J.
    pub fn rigid_part(&self, y: &DVector<f64>) -> f64 {
        self.rigid_rotation.dot(y) / self.inertia()
    }

    /// Whether the inertia matrix with the unbalances is positive definite at every angle.
    ///
    /// U couples the mass m and the polar inertia J of the rotor at the unbalance, m J > U².
    ///
    /// # Errors
    /// The unbalance with the largest U/√(m J), if the sum over all is 1 or more.
    pub fn check_inertia(&self) -> Result<(), PhysicsError> {
        let mass = |u: &RotatingUnbalance| 1.0 / u.x.norm_squared().max(u.y.norm_squared());
        let inertia = |u: &RotatingUnbalance| 1.0 / u.twist.norm_squared();
        let share = |u: &RotatingUnbalance| u.magnitude / (mass(u) * inertia(u)).sqrt();
        let worst = self.unbalances.iter().max_by(|a, b| share(a).total_cmp(&share(b)));
        match worst {
            Some(u) if self.unbalances.iter().map(share).sum::<f64>() >= 1.0 => {
                Err(PhysicsError::UnbalanceAboveInertia {
                    unbalance: u.name.clone(),
                    magnitude: u.magnitude,
                    mass: mass(u),
                    inertia: inertia(u),
                })
            }
            _ => Ok(()),
        }
    }
}
