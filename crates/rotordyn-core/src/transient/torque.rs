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
mod drive;
mod energy;

pub use drive::{DrivenState, RotatingUnbalance, TorqueDrive};
use nalgebra::DVector;

use super::system::{State, System};
pub use energy::DriveEnergy;

impl TorqueDrive {
    /// Transfers the rigid rotation in the coordinates to the frame.
    pub fn recentre(&self, state: &mut State) {
        let r = &self.rigid_rotation;
        let [angle, speed, rate] = [&state.x, &state.v, &state.a].map(|y| self.rigid_part(y));
        let true_rate = self.rigid_part(&state.acceleration);
        state.x.axpy(-angle, r, 1.0);
        state.v.axpy(-speed, r, 1.0);
        state.a.axpy(-rate, r, 1.0);
        state.acceleration.axpy(-true_rate, r, 1.0);
        state.driven.rate += rate;
        state.spin.angle += angle;
        state.spin.speed += speed;
        state.spin.acceleration += true_rate;
    }

    /// Completes the accelerations of a state from the sum of its other loads p − (C+ΩG) ẋ − (K+…) x + Wᵀ f in
    /// `acceleration`, and transfers the rigid rotation to the frame.
    pub fn start(&self, system: &System, state: &mut State) {
        let mut work = coupling::Workspace::new(self, system.size());
        let mut acceleration = std::mem::take(&mut state.acceleration);
        self.solve_acceleration(system, state, &mut acceleration, &mut work);
        state.driven.load = DVector::zeros(system.size());
        state.driven.rate = state.spin.acceleration;
        state.a.copy_from(&acceleration);
        state.acceleration = acceleration;
        self.recentre(state);
        let at = coupling::Motion {
            spin: &state.spin,
            x: &state.x,
            v: &state.v,
            acceleration: &state.acceleration,
        };
        let mut load = std::mem::take(&mut state.driven.load);
        self.add_coupling(system, &at, &state.reactions, &mut work, &mut load);
        state.driven.load = load;
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
