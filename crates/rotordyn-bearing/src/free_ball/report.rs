//! Motion and contacts of every ball, for results and pictures.

use super::cage::CageFrame;
use super::forces::Parts;
use super::race::RaceForce;
use super::ring::{RingFrame, V};
use super::state::cage_at;
use super::surfaces::ClosedForms;
use std::f64::consts::TAU;

/// One ball in a state.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct BallReport {
    /// Angular position about the outer ring's axis, from its x axis \[rad\], and orbital speed \[rad/s\].
    pub position: f64,
    pub orbital_speed: f64,
    /// Angular velocity along the axis, radially and along the orbit \[rad/s\], inertial.
    pub rotation: [f64; 3],
    /// Contact with inner and outer race; `None` where they do not touch.
    pub races: [Option<RaceContactReport>; 2],
    /// Force of the pocket on the ball along the orbit \[N\], positive where it drives along +z rotation; 0 without contact.
    pub pocket: f64,
}

/// Contact of a ball with a race.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct RaceContactReport {
    /// Normal load \[N\] and contact angle \[rad\].
    pub load: f64,
    pub angle: f64,
    /// Friction force on the ball \[N\].
    pub friction: V,
    /// Slip at the centre along and across rolling \[m/s\].
    pub slip: [f64; 2],
    /// Rotation against the race about the normal and about the transverse axis \[rad/s\].
    pub spin: f64,
    pub rolling: f64,
    /// Semi-axes along and across rolling \[m\].
    pub semi_axes: [f64; 2],
    /// Power lost by traction \[W\].
    pub traction_power: f64,
}

impl BallReport {
    /// Pitch angle of the spin axis from the bearing's axis \[rad\], atan(ω_r/(ω_m − ω_z)) of the ball relative to its orbit.
    pub fn pitch_angle(&self) -> f64 {
        self.rotation[1].atan2(self.orbital_speed - self.rotation[0])
    }
}

impl From<&RaceForce> for RaceContactReport {
    fn from(force: &RaceForce) -> Self {
        let RaceForce {
            load,
            angle: [cos, sin],
            friction,
            slip,
            spin,
            rolling,
            semi_axes,
            traction_power,
            ..
        } = *force;
        Self { load, angle: sin.atan2(cos), friction, slip, spin, rolling, semi_axes, traction_power }
    }
}

impl Parts {
    /// Motion and contacts of every ball.
    pub fn report(&self, values: &[f64], rings: &[RingFrame; 2]) -> Vec<BallReport> {
        let outer = &rings[1];
        let second = outer.axis.cross(&outer.across);
        let cage = self
            .cage
            .as_ref()
            .map(|contacts| (contacts, CageFrame::new(cage_at(values, self.balls.len()), &contacts.cage)));
        let one = |j: usize| {
            let ball = self.motion(values, j);
            let from_ring = ball.position - outer.centre;
            let radial = from_ring - from_ring.dot(&outer.axis) * outer.axis;
            let distance = radial.norm();
            let outward = radial / distance;
            let along = outer.axis.cross(&outward);
            let mut pocket = 0.0;
            if let Some((contacts, frame)) = &cage {
                contacts.pocket(&ClosedForms, frame, &ball, j, |contact| {
                    pocket += contact.contact.force.dot(&along);
                });
            }
            let race = |k: usize| self.grooves[k].react(&ClosedForms, &rings[k], &ball);
            BallReport {
                position: outward.dot(&second).atan2(outward.dot(&outer.across)),
                orbital_speed: (ball.velocity - outer.velocity).dot(&along) / distance,
                rotation: [outer.axis, outward, along].map(|axis| ball.rotation.dot(&axis)),
                races: [0, 1].map(|k| race(k).as_ref().map(RaceContactReport::from)),
                pocket,
            }
        };
        (0..self.balls.len()).map(one).collect()
    }

    /// Angle of the cage about z, or without cage that of the balls; −π to π \[rad\].
    pub fn cage_angle(&self, values: &[f64]) -> f64 {
        if self.cage.is_none() {
            return self.ball_angle(values);
        }
        let [across, ..] = cage_at(values, self.balls.len()).axes();
        across.y.atan2(across.x)
    }

    /// Mean angle of the balls about z less their spacing; −π to π \[rad\].
    pub fn ball_angle(&self, values: &[f64]) -> f64 {
        let balls = self.balls.len();
        let mean = (0..balls).fold([0.0; 2], |[x, y], j| {
            let place = self.motion(values, j).position;
            let (sin, cos) = (place.y.atan2(place.x) - TAU * j as f64 / balls as f64).sin_cos();
            [x + cos, y + sin]
        });
        mean[1].atan2(mean[0])
    }
}
