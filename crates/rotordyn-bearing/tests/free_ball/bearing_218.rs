//! 218 angular contact bearing under 17.8 kN of thrust, with one ball, which stands for all.

use crate::bearings::{ball_bearing, free, rings};
use rotordyn_bearing::free_ball::{FreeBalls, RingState, SlipModel};
use rotordyn_bearing::kinematics::ball_motions;
use rotordyn_bearing::{BallBearing, BallElement, BallGeometry, BallInertia, Rotation};

/// 16 balls of 22.23 mm on a pitch of 125.26 mm, 40 deg, f = 0.5232; computed with one ball, which stands for all.
fn geometry_218() -> BallGeometry {
    let ball_diameter = 22.23e-3;
    BallGeometry {
        balls: 1,
        ball_diameter,
        pitch_diameter: 125.26e-3,
        inner_groove_radius: 0.5232 * ball_diameter,
        outer_groove_radius: 0.5232 * ball_diameter,
        radial_clearance: 0.0,
        contact_angle: 40_f64.to_radians(),
        thrust_direction: 1.0,
        moment_arm: None,
        bore: 90e-3,
        outside_diameter: 160e-3,
        width: 30e-3,
    }
}

const THRUST: f64 = 17_800.0 / 16.0;

/// Axial force of the quasi-static bearing at an axial displacement.
fn axial_force(element: &BallElement, speed: f64, z: f64) -> f64 {
    let rotation = Rotation { shaft_speed: speed, ..Rotation::default() };
    -element.reaction(&[0.0, 0.0, z, 0.0, 0.0, 0.0], &[0.0; 6], &rotation).force[2]
}

/// Axial displacement of the quasi-static bearing under the thrust \[m\].
fn under_thrust(element: &BallElement, speed: f64) -> f64 {
    let (mut low, mut high) = (0.0, 2e-4);
    for _ in 0..60 {
        let z = 0.5 * (low + high);
        if axial_force(element, speed, z) < THRUST { low = z } else { high = z }
    }
    low
}

/// Contact angles \[deg\], loads \[N\], cage over shaft speed and pitch angle \[deg\] once they are steady, with a friction
/// coefficient and a time step \[s\].
pub fn settled_with(friction: f64, speed: f64, slip: SlipModel, slip_speed: f64, step: f64) -> [f64; 6] {
    let ball = ball_bearing(geometry_218());
    let element = BallElement::new(&ball);
    let start = under_thrust(&element, speed);
    let thrust = |z: f64| axial_force(&element, speed, z);
    let stiffness = (thrust(start + 1e-7) - thrust(start - 1e-7)) / 2e-7;
    let mut bearing = free(ball, friction, slip_speed, slip);
    bearing.damping = 1.0;
    let balls = FreeBalls::new(bearing, speed).unwrap();
    let ring = |z: f64, t: f64| {
        let [inner, outer] = rings(speed, t);
        [RingState { position: [0.0, 0.0, z], ..inner }, outer]
    };
    let (mut z, interval) = (start, 5e-3);
    let mut state = balls.initial_state(&ring(z, 0.0)).unwrap();
    let mut next = z;
    let mut last = [0.0; 6];
    for k in 0..1000 {
        let t = k as f64 * interval;
        let run =
            balls.advance(&mut state, [&ring(z, t), &ring(next, t + interval)], interval, step).unwrap();
        z = next;
        next = z + 0.2 * (THRUST + run.rings[0][2]) / stiffness;
        let report = &balls.report(&state, &ring(z, t + interval))[0];
        let [inner, outer] = report.races.map(|contact| contact.unwrap());
        let now = [
            inner.angle.to_degrees(),
            outer.angle.to_degrees(),
            inner.load,
            outer.load,
            report.orbital_speed / speed,
            report.pitch_angle().to_degrees(),
        ];
        // Angles against 10 deg at least: a pitch angle may decay to zero.
        let least = [10.0, 10.0, 0.0, 0.0, 0.0, 10.0];
        let relative = |i: usize| (now[i] - last[i]).abs() / f64::max(now[i].abs(), least[i]);
        let change = (0..6).map(relative).fold(0.0, f64::max);
        last = now;
        if change < 1e-6 && (run.rings[0][2] / THRUST + 1.0).abs() < 1e-5 {
            return last;
        }
    }
    panic!("not steady after {:.3} s: {last:.5?}", state.time)
}

/// Hypothesis of race control: outer load \[N\], cage over shaft speed and pitch angle \[deg\].
pub fn hypothesis(inertia: BallInertia, speed: f64) -> [f64; 3] {
    let ball = BallBearing { inertia, ..ball_bearing(geometry_218()) };
    let element = BallElement::new(&ball);
    let d = [0.0, 0.0, under_thrust(&element, speed), 0.0, 0.0, 0.0];
    let rotation = Rotation { shaft_speed: speed, ..Rotation::default() };
    let loads = element.ball_loads(&d, &rotation);
    let motion = ball_motions(&ball, &loads, speed)[0];
    [loads[0].outer_load, motion.orbital_speed / speed, motion.pitch_angle.to_degrees()]
}
