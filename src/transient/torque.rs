//! Torque drive: the shaft speed follows from the torque balance instead of a speed profile.

use nalgebra::DVector;

use super::system::State;
use crate::linalg::{Outside, piecewise};

/// Driving torque T(Ω) at one node, accelerating the polar inertia of all rotating parts, with viscous drag.
///
/// The equations are written in a frame that rotates with θ(t). Under a torque drive the rigid rotation r is
/// a rigid-body mode of the coordinates, so the motion of the frame is arbitrary; after every step the rigid
/// part of x, ẋ and ẍ is transferred to θ, Ω and Ω̇ ([`TorqueDrive::recentre`]), exactly.
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
}

impl TorqueDrive {
    /// Net torque of drive and drag at a speed \[N m\].
    pub fn torque_at(&self, speed: f64) -> f64 {
        piecewise(&self.table, speed, Outside::Constant)[1] - self.drag * speed
    }

    /// Transfers the rigid rotation in the coordinates to the frame.
    pub fn recentre(&self, state: &mut State) {
        let r = &self.rigid_rotation;
        let inertia = r.norm_squared();
        let (angle, speed, rate) =
            (r.dot(&state.x) / inertia, r.dot(&state.v) / inertia, r.dot(&state.a) / inertia);
        state.x.axpy(-angle, r, 1.0);
        state.v.axpy(-speed, r, 1.0);
        state.a.axpy(-rate, r, 1.0);
        state.spin.angle += angle;
        state.spin.speed += speed;
        state.spin.acceleration += rate;
    }
}
