//! Initial state from the kinematic solution: balls where the quasi-static bearing has them, rolling without slip.

use super::forces::Parts;
use super::ring::{RingState, V};
use super::state::{BallBody, CageBody, FreeBallState};
use crate::kinematics::{ball_motions, rolling_speeds};
use crate::{BallBearing, BallElement, BallInertia, BallLoad, Rotation};

impl Parts {
    /// Balls at the positions of the quasi-static bearing under the displacement of its rings, on rolling orbits; cage at
    /// the centre of the outer ring, in the plane of the balls, with their mean speed.
    ///
    /// A ball without load at the outer race lies there under its centrifugal force alone.
    pub fn kinematic_state(&self, bearing: &BallBearing, rings: &[RingState; 2]) -> FreeBallState {
        let [inner, outer] = rings;
        let [x, y, z] = [0, 1, 2].map(|k| inner.position[k] - outer.position[k]);
        let tilt = [0, 1].map(|k| inner.tilt[k] - outer.tilt[k]);
        let d = [x, y, z, tilt[0], tilt[1], 0.0];
        let speed = inner.speed - outer.speed;
        let rotation = Rotation {
            cage_angle: bearing.cage_angle,
            cage_speed: None,
            shaft_angle: inner.angle - outer.angle,
            shaft_speed: speed,
        };
        let mut inertial = bearing.clone();
        if !inertial.inertia.is_on() {
            inertial.inertia = BallInertia::OuterRaceControl;
        }
        let loads = BallElement::new(&inertial).ball_loads(&d, &rotation);
        let motions = ball_motions(&inertial, &loads, speed);
        let g = &bearing.geometry;
        let gamma = g.ball_diameter / g.pitch_diameter;
        let mut orbit_sum = 0.0;
        let balls: Vec<BallBody> = loads
            .iter()
            .zip(&motions)
            .enumerate()
            .map(|(j, (load, motion))| {
                let velocity = match motion.control {
                    Some(_) => motion.ball_velocity,
                    None => {
                        let races = [speed, 0.0];
                        let [_, ball] = rolling_speeds(gamma, [g.contact_angle; 2], g.contact_angle, races);
                        [-ball * g.contact_angle.cos(), ball * g.contact_angle.sin()]
                    }
                };
                let orbit = outer.speed + motion.orbital_speed;
                orbit_sum += orbit;
                self.ball_on_orbit(j, load, outer, orbit, velocity)
            })
            .collect();
        let cage = self.cage.as_ref().map(|contacts| {
            let mean = orbit_sum / balls.len() as f64;
            let [ring, velocity] = [outer.position, outer.velocity].map(V::from);
            let axis = outer.frame().axis;
            let heights = balls.iter().map(|ball| (ball.position - ring).dot(&axis));
            let centre = ring + heights.sum::<f64>() / balls.len() as f64 * axis;
            CageBody::rotating(centre, velocity, bearing.cage_angle, mean, contacts.cage.polar_inertia)
        });
        FreeBallState::new(&balls, cage.as_ref())
    }

    /// Ball in the outer groove at its contact angle; `velocity`: angular velocity along the axis and radially, in the
    /// orbiting frame \[rad/s\].
    fn ball_on_orbit(
        &self,
        number: usize,
        load: &BallLoad,
        outer: &RingState,
        orbit: f64,
        velocity: [f64; 2],
    ) -> BallBody {
        let (groove, [radius, mass, _]) = (&self.grooves[1], self.balls[number]);
        let frame = outer.frame();
        let centrifugal = mass * groove.torus.centre_radius * orbit * orbit;
        let pressed = if load.outer_load > 0.0 { load.outer_load } else { centrifugal };
        let (sin, cos) = load.outer_contact_angle.sin_cos();
        let (sin_place, cos_place) = load.position.sin_cos();
        let second = frame.axis.cross(&frame.across);
        let outward = cos_place * frame.across + sin_place * second;
        let [height, _] = groove.surface_height(&frame, &outward, &frame.axis.cross(&outward));
        let distance = groove.torus.radius - radius - height + (pressed / groove.stiffness).powf(2.0 / 3.0);
        let from_ring = (groove.torus.centre_radius + distance * cos) * outward
            + (groove.torus.axial + distance * sin) * frame.axis;
        BallBody {
            position: frame.centre + from_ring,
            velocity: frame.velocity + orbit * frame.axis.cross(&from_ring),
            rotation: (orbit + velocity[0]) * frame.axis + velocity[1] * outward,
        }
    }
}
