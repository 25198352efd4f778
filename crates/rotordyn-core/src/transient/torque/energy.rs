//! Energies of a rotation that is an unknown: kinetic energy, work of the drive, losses.

use nalgebra::DVector;
use serde::{Deserialize, Serialize};

use super::TorqueDrive;
use super::coupling::cage_power;
use crate::transient::system::{State, System};

/// What the energy balance needs of the rotation at the last state.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct DriveEnergy {
    angle: f64,
    speed: f64,
    /// Drive torque \[N m\], gravity's potential at the unbalances \[J\], loss in internal damping \[W\].
    torque: f64,
    potential: f64,
    internal_loss: f64,
}

/// Change of the energy account over a step \[J\].
#[derive(Clone, Copy, Debug, Default)]
pub struct DriveWork {
    pub drive: f64,
    pub gravity: f64,
    pub loss: f64,
}

impl DriveEnergy {
    pub fn new(drive: &TorqueDrive, system: &System, state: &State) -> Self {
        Self {
            angle: state.spin.angle,
            speed: state.spin.speed,
            torque: drive.motor_torque(state.spin.speed),
            potential: drive.gravity_potential(state),
            internal_loss: drive.internal_loss(system, state),
        }
    }

    /// Angle turned since the last state \[rad\].
    pub fn turned(&self, state: &State) -> f64 {
        state.spin.angle - self.angle
    }

    /// Work and losses of the step along `moved`, the displacement with the rigid rotation of the frame.
    pub fn step(
        &mut self,
        drive: &TorqueDrive,
        system: &System,
        state: &State,
        moved: &DVector<f64>,
        length: f64,
    ) -> DriveWork {
        let now = Self::new(drive, system, state);
        let turned = drive.torque.dot(moved);
        let mean_speed = 0.5 * (self.speed + now.speed);
        let out = DriveWork {
            drive: 0.5 * (self.torque + now.torque) * turned,
            gravity: self.potential - now.potential,
            loss: mean_speed * (drive.drag * turned + drive.rotation_drag.dot(moved))
                + 0.5 * length * (self.internal_loss + now.internal_loss),
        };
        *self = now;
        out
    }
}

impl TorqueDrive {
    /// Kinetic energy of the rotation and of its products with the other velocities \[J\]:
    /// ½ J (Ω + s)² + Ω ẋᵀ x_r − Σ U φ̇ (u̇_x sin φ − u̇_y cos φ), J s = ẋᵀ K_s x.
    pub fn kinetic_energy(&self, system: &System, state: &State) -> f64 {
        let speed = state.spin.speed;
        let n = system.structure();
        let spin_up = &system.spin_up * state.x.rows(0, n);
        let spin = speed + state.v.rows(0, n).dot(&spin_up) / self.inertia();
        let mut out = 0.5 * self.inertia() * spin * spin + speed * state.v.dot(&self.rigid_rotation);
        for u in &self.unbalances {
            let (sin, cos) = (state.spin.angle + u.twist.dot(&state.x) + u.phase).sin_cos();
            let rate = speed + u.twist.dot(&state.v);
            out -= u.magnitude * rate * (u.x.dot(&state.v) * sin - u.y.dot(&state.v) * cos);
        }
        out
    }

    /// Potential of gravity at the unbalances, −Σ U (g_x cos φ + g_y sin φ) \[J\].
    fn gravity_potential(&self, state: &State) -> f64 {
        let of = |u: &super::RotatingUnbalance| {
            let (sin, cos) = (state.spin.angle + u.twist.dot(&state.x) + u.phase).sin_cos();
            -u.magnitude * (self.gravity[0] * cos + self.gravity[1] * sin)
        };
        self.unbalances.iter().map(of).sum()
    }

    /// Loss in internal damping by the rotation \[W\], Ω (2 ẋᵀ K_c x + Ω xᵀ Sᵀ C_i S x).
    fn internal_loss(&self, system: &System, state: &State) -> f64 {
        let n = system.structure();
        if self.rotating_damping.nrows() != n {
            return 0.0;
        }
        let (x, v, speed) = (state.x.rows(0, n), state.v.rows(0, n), state.spin.speed);
        speed * (2.0 * v.dot(&(&system.circulatory * x)) + speed * x.dot(&(&self.rotating_damping * x)))
    }

    /// Parametric power of all bearings but that of the cages, which the rotation supplies \[W\].
    pub fn remaining_parametric_power(&self, system: &System, state: &State) -> f64 {
        let all: f64 = state.reactions.iter().map(|r| r.parametric_power).sum();
        all - cage_power(system, &state.reactions)
    }
}
