//! Rings as rigid bodies with given motion.

use nalgebra::Vector3;

pub(super) type V = Vector3<f64>;

/// Position and motion of a ring at one instant.
///
/// The ring is turned by `angle` about its axis, then tilted by the rotation vector (θ_x, θ_y, 0).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct RingState {
    /// Centre \[m\] and its velocity \[m/s\].
    pub position: [f64; 3],
    pub velocity: [f64; 3],
    /// Tilt θ_x, θ_y \[rad\] and its rate \[rad/s\].
    pub tilt: [f64; 2],
    pub tilt_rate: [f64; 2],
    /// Angle of rotation \[rad\] and speed \[rad/s\] about the ring's axis.
    pub angle: f64,
    pub speed: f64,
}

impl RingState {
    /// Centred ring that rotates: `speed` \[rad/s\] and the `angle` \[rad\] reached.
    pub fn rotating(speed: f64, angle: f64) -> Self {
        Self { speed, angle, ..Self::default() }
    }

    /// Motion between two states `duration` \[s\] apart at `share` (0 to 1) of it.
    ///
    /// Cubic Hermite interpolation of position, tilt and angle; the velocities are its derivatives, so that
    /// work of the forces equals work at the moving ring.
    pub fn between(start: &Self, end: &Self, duration: f64, share: f64) -> Self {
        let hermite = |from: f64, to: f64, rates: [f64; 2]| hermite(from, to, rates, duration, share);
        let mut out = *start;
        for k in 0..3 {
            let rates = [start.velocity[k], end.velocity[k]];
            [out.position[k], out.velocity[k]] = hermite(start.position[k], end.position[k], rates);
        }
        for k in 0..2 {
            let rates = [start.tilt_rate[k], end.tilt_rate[k]];
            [out.tilt[k], out.tilt_rate[k]] = hermite(start.tilt[k], end.tilt[k], rates);
        }
        [out.angle, out.speed] = hermite(start.angle, end.angle, [start.speed, end.speed]);
        out
    }

    pub(super) fn frame(&self) -> RingFrame {
        let tilt = V::new(self.tilt[0], self.tilt[1], 0.0);
        let rate = V::new(self.tilt_rate[0], self.tilt_rate[1], 0.0);
        let angle = tilt.norm();
        // sin θ/θ and (1 − cos θ)/θ², (θ − sin θ)/θ³ of rotation vectors; series where they cancel.
        let [sinc, versine, cubic] = if angle > 1e-2 {
            let (sin, cos) = angle.sin_cos();
            [sin / angle, (1.0 - cos) / (angle * angle), (angle - sin) / angle.powi(3)]
        } else {
            let q = angle * angle;
            [
                1.0 - q / 6.0 * (1.0 - q / 20.0),
                0.5 - q / 24.0 * (1.0 - q / 30.0),
                1.0 / 6.0 - q / 120.0 * (1.0 - q / 42.0),
            ]
        };
        let turn = |v: V| v + sinc * tilt.cross(&v) + versine * tilt.cross(&tilt.cross(&v));
        let axis = turn(V::z());
        let tilting = rate + versine * tilt.cross(&rate) + cubic * tilt.cross(&tilt.cross(&rate));
        RingFrame {
            centre: V::from(self.position),
            velocity: V::from(self.velocity),
            axis,
            across: turn(V::x()),
            angle: self.angle,
            rotation: tilting + self.speed * axis,
        }
    }
}

/// Value and rate of the cubic through two values with given rates.
fn hermite(from: f64, to: f64, [start, end]: [f64; 2], duration: f64, s: f64) -> [f64; 2] {
    let chord = to - from;
    let (a, b) = (start * duration - chord, chord - end * duration);
    let value = from + s * (chord + (1.0 - s) * ((1.0 - s) * a + s * b));
    let slope = chord + (1.0 - 2.0 * s) * ((1.0 - s) * a + s * b) + s * (1.0 - s) * (b - a);
    [value, slope / duration]
}

/// A ring's axis, centre and velocities as vectors.
#[derive(Clone, Copy, Debug)]
pub(super) struct RingFrame {
    pub centre: V,
    pub velocity: V,
    pub axis: V,
    /// The ring's tilted x axis, not turned by its rotation.
    pub across: V,
    pub angle: f64,
    /// Angular velocity.
    pub rotation: V,
}

impl RingFrame {
    /// Velocity of the ring's material at the place `from_centre` its centre.
    #[inline(always)]
    pub fn velocity_at(&self, from_centre: &V) -> V {
        self.velocity + self.rotation.cross(from_centre)
    }
}

/// Force and moment about a body's centre.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Wrench {
    /// \[N\].
    pub force: V,
    /// \[N m\].
    pub moment: V,
}

impl Wrench {
    /// Adds a force that acts `from_centre` \[m\] the body's centre.
    #[inline(always)]
    pub fn add(&mut self, force: &V, from_centre: &V) {
        self.force += force;
        self.moment += from_centre.cross(force);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Centre, axis and x axis of the ring move with its velocity and angular velocity, through the series and beyond.
    #[test]
    fn frame_moves_with_its_velocities() {
        for size in [1e-4, 9e-3, 1.1e-2, 0.8] {
            let start = RingState {
                position: [1e-3, -2e-3, 5e-4],
                velocity: [0.1, 0.3, -0.2],
                tilt: [size, -0.6 * size],
                tilt_rate: [0.4, 0.7],
                angle: 0.3,
                speed: 20.0,
            };
            let end = RingState {
                position: [2e-3, 1e-3, 0.0],
                tilt: [0.9 * size, 0.2 * size],
                angle: 0.9,
                ..start
            };
            let at = |share: f64| RingState::between(&start, &end, 0.01, share);
            let (share, step) = (0.37, 1e-5);
            let (frame, ahead, behind) =
                (at(share).frame(), at(share + step).frame(), at(share - step).frame());
            let rate = |a: V, b: V| (a - b) / (2.0 * step * 0.01);
            let spin = frame.rotation - at(share).speed * frame.axis;
            let scale = frame.rotation.norm();
            assert!((rate(ahead.centre, behind.centre) - frame.velocity).norm() < 1e-8);
            assert!(
                (rate(ahead.axis, behind.axis) - frame.rotation.cross(&frame.axis)).norm() < 1e-7 * scale
            );
            // The x axis is tilted, not turned about the ring's axis.
            assert!((rate(ahead.across, behind.across) - spin.cross(&frame.across)).norm() < 1e-7 * scale);
            let speed = (ahead.angle - behind.angle) / (2.0 * step * 0.01);
            assert!((speed - at(share).speed).abs() < 1e-6 * scale);
        }
    }

    #[test]
    fn interpolation_ends_at_both_states() {
        let start = RingState::rotating(30.0, 0.1);
        let end = RingState {
            velocity: [0.1, 0.0, 0.2],
            position: [1e-4, 0.0, 2e-4],
            ..RingState::rotating(50.0, 0.5)
        };
        assert_eq!(RingState::between(&start, &end, 0.01, 0.0), start);
        let reached = RingState::between(&start, &end, 0.01, 1.0);
        assert!((reached.position[2] - 2e-4).abs() < 1e-18 && (reached.speed - 50.0).abs() < 1e-12);
    }
}
