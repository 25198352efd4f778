//! Torque drive: the rotation θ(t) is an unknown that follows from the torques on the rotor.
//!
//! The coordinates x contain the rigid rotation x_r; θ is the motion of their frame. With the unbalance at the angle
//! φ = θ + θ_z + ϕ of its node, all terms with a rotation come from one Lagrangian,
//!
//! L = ½ ẋᵀ ẋ + Ω ẋᵀ x_r + ½ J (Ω + s)² + Σ U φ̇ (u̇_y cos φ − u̇_x sin φ) + Σ U (g_x cos φ + g_y sin φ) − V,
//! s = ẋᵀ K_s x / J:
//!
//! its terms in x are the unbalance force and (Ω + s) G ẋ + (Ω̇ + ṡ) K_s x (K_s = ½ G + K_T), its terms in θ and θ_z the
//! reactions on the rotation ([`coupling`]). s is the mean spin of the sections about their tangents by bending alone. U = m e alone is known of an unbalance: its own inertia m e² about the axis is
//! neglected, and its mass m is that of the disc. Drive torque and drag depend on Ω, not on the local twist rate.

pub mod coupling;
mod energy;

use nalgebra::{DMatrix, DVector};

use super::system::{State, System};
use crate::assembly::PhysicsError;
use crate::linalg::{Outside, piecewise};
pub use energy::DriveEnergy;

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
#[derive(Clone, Debug, Default)]
pub struct DrivenState {
    /// Load of the coupling at the state (see [`coupling`]).
    pub load: DVector<f64>,
    /// ẍ of the equations of motion at the state's time (the integrator's own acceleration may be shifted in time).
    pub acceleration: DVector<f64>,
    /// Rotational acceleration of the integrator, to `spin.acceleration` as `a` to `acceleration`.
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

    /// Transfers the rigid rotation in the coordinates to the frame.
    pub fn recentre(&self, state: &mut State) {
        let r = &self.rigid_rotation;
        let [angle, speed, rate] = [&state.x, &state.v, &state.a].map(|y| self.rigid_part(y));
        let true_rate = self.rigid_part(&state.driven.acceleration);
        state.x.axpy(-angle, r, 1.0);
        state.v.axpy(-speed, r, 1.0);
        state.a.axpy(-rate, r, 1.0);
        state.driven.acceleration.axpy(-true_rate, r, 1.0);
        state.driven.rate += rate;
        state.spin.angle += angle;
        state.spin.speed += speed;
        state.spin.acceleration += true_rate;
    }

    /// Sets the accelerations of a state from the sum of its other loads `others` = p − (C+ΩG) ẋ − (K+…) x + Wᵀ f, and
    /// transfers the rigid rotation to the frame.
    pub fn start(&self, system: &System, state: &mut State, others: DVector<f64>) {
        let mut work = coupling::Workspace::new(self, system.size());
        let mut acceleration = others;
        self.solve_acceleration(system, state, &mut acceleration, &mut work);
        state.driven.load = DVector::zeros(system.size());
        state.driven.rate = state.spin.acceleration;
        state.a.copy_from(&acceleration);
        state.driven.acceleration = acceleration;
        self.recentre(state);
        let at = coupling::Motion {
            spin: &state.spin,
            x: &state.x,
            v: &state.v,
            acceleration: &state.driven.acceleration,
        };
        let mut load = std::mem::take(&mut state.driven.load);
        self.add_coupling(system, &at, &state.reactions, &mut work, &mut load);
        state.driven.load = load;
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

    /// ẍ from the sum of the other loads in `acceleration`, at the state's motion.
    fn solve_acceleration(
        &self,
        system: &System,
        state: &State,
        acceleration: &mut DVector<f64>,
        work: &mut coupling::Workspace,
    ) {
        let zero = DVector::zeros(system.size());
        let at = coupling::Motion { spin: &state.spin, x: &state.x, v: &state.v, acceleration: &zero };
        self.add_coupling(system, &at, &state.reactions, work, acceleration);
        self.solve_inertia(work, acceleration);
    }
}
