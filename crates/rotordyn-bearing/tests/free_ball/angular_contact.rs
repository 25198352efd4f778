//! 218 angular contact bearing under 17.8 kN of thrust: contact angles, loads, cage speed, spin axis.

use crate::bearings::{ball_bearing, free, rings, rpm};
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

/// Contact angles \[deg\], loads \[N\], cage over shaft speed and pitch angle \[deg\] once they are steady.
fn settled(speed: f64, slip: SlipModel, slip_speed: f64) -> [f64; 6] {
    settled_with(0.06, speed, slip, slip_speed, 2e-6)
}

/// The same with a friction coefficient and a time step \[s\].
fn settled_with(friction: f64, speed: f64, slip: SlipModel, slip_speed: f64, step: f64) -> [f64; 6] {
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
            println!("steady after {:.3} s", state.time);
            return last;
        }
    }
    panic!("not steady after {:.3} s: {last:.5?}", state.time)
}

/// Figures of a second engine: contact angles, loads, cage speed, spin axis; slip integrated over the ellipse.
const FIGURES: [(f64, [f64; 6]); 3] = [
    (500.0, [41.514, 41.481, 1678.2, 1679.3, 0.43374, 42.4]),
    (2000.0, [41.761, 41.227, 1666.5, 1684.0, 0.43357, 42.0]),
    (10_000.0, [48.89, 32.81, 1441.4, 1890.0, 0.44589, 31.06]),
];

/// Loads within 0.5 %, angles 0.2 deg, cage speed 0.1 %, spin axis 0.5 deg of the figures.
#[test]
fn bearing_218_settles_between_the_control_hypotheses() {
    for (speed, figures) in FIGURES {
        let found = settled(rpm(speed), SlipModel::default(), 1e-2);
        println!("{speed} rpm: {found:.5?}\n   figures {figures:.5?}");
        let allowed = [0.2, 0.2, 5e-3 * figures[2], 5e-3 * figures[3], 1e-3 * figures[4], 0.5];
        for k in 0..6 {
            assert!((found[k] - figures[k]).abs() < allowed[k], "{k}: {} {}", found[k], figures[k]);
        }
    }
}

/// Twice the points of the quadrature in each direction change spin axis and cage speed by less than 0.1 deg and 1e-4.
#[test]
fn quadrature_over_the_ellipse_has_converged() {
    for speed in [2000.0, 10_000.0] {
        let coarse = settled(rpm(speed), SlipModel::default(), 1e-2);
        let fine = settled(rpm(speed), SlipModel::Ellipse { along: 8, across: 24 }, 1e-2);
        println!("{speed} rpm: {coarse:.5?} {fine:.5?}");
        assert!((coarse[5] - fine[5]).abs() < 0.1 && (coarse[4] / fine[4] - 1.0).abs() < 1e-4);
    }
}

/// Slip at the contact's centre has no pivot moment: the gyroscopic moment alone turns the spin axis, to that of the
/// bearing, and the orbit is 11 % off.
#[test]
fn slip_at_the_centre_gives_a_wrong_attitude() {
    let found = settled(rpm(10_000.0), SlipModel::Centre, 0.3);
    let figures = FIGURES[2].1;
    println!("slip at the centre: {found:.5?}, over the ellipse {figures:.5?}");
    assert!(found[5].abs() < 1.0 && (found[4] / figures[4] - 1.0).abs() > 0.1);
}

/// Hypothesis of race control: outer load \[N\], cage over shaft speed and pitch angle \[deg\].
fn hypothesis(inertia: BallInertia, speed: f64) -> [f64; 3] {
    let ball = BallBearing { inertia, ..ball_bearing(geometry_218()) };
    let element = BallElement::new(&ball);
    let d = [0.0, 0.0, under_thrust(&element, speed), 0.0, 0.0, 0.0];
    let rotation = Rotation { shaft_speed: speed, ..Rotation::default() };
    let loads = element.ball_loads(&d, &rotation);
    let motion = ball_motions(&ball, &loads, speed)[0];
    [loads[0].outer_load, motion.orbital_speed / speed, motion.pitch_angle.to_degrees()]
}

/// How far the hypotheses of race control are off, over speed and friction: cage over shaft speed and pitch angle of the
/// spin axis \[deg\].
///
/// | speed \[rpm\] | outer control | inner control | free, μ = 0.02 | 0.06 | 0.12 |
/// |---|---|---|---|---|---|
/// | 500 | 0.43357, 35.6 | 0.43353, 49.2 | 0.43368, 42.3 | 0.43368, 42.3 | 0.43368, 42.3 |
/// | 2000 | 0.43394, 35.3 | 0.43341, 49.4 | 0.43362, 42.2 | 0.43362, 42.3 | 0.43362, 42.3 |
/// | 5000 | 0.43664, 33.5 | 0.43262, 50.1 | 0.43425, 39.3 | 0.43486, 37.9 | 0.43497, 37.6 |
/// | 10000 | 0.45503, 26.7 | 0.42889, 52.4 | 0.48305, 5.0 | 0.44615, 30.9 | 0.44859, 30.1 |
///
/// Slow balls spin alike on both races, half way between the hypotheses, whatever the friction. At 10000 rpm the
/// gyroscopic moment turns the axis towards outer control; with μ = 0.02 friction cannot hold it any more.
#[test]
fn control_hypotheses_are_off_by_speed_and_friction() {
    let [outer_load, orbit, axis] = hypothesis(BallInertia::OuterRaceControl, rpm(10_000.0));
    println!("outer race control at 10000 rpm: {outer_load:.1} N, {orbit:.5}, {axis:.2} deg");
    // Jones' outer control of the second engine.
    for (found, figure) in [(outer_load, 1922.0), (orbit, 0.45490), (axis, 26.7)] {
        assert!((found / figure - 1.0).abs() < 5e-3);
    }
    let table =
        [(500.0, [35.6, 49.2], [42.3, 42.3, 42.3], 0.1), (10_000.0, [26.7, 52.4], [5.0, 30.9, 30.1], 0.2)];
    for (speed, controls, axes, tolerance) in table {
        for (inertia, figure) in
            [BallInertia::OuterRaceControl, BallInertia::InnerRaceControl].into_iter().zip(controls)
        {
            assert!((hypothesis(inertia, rpm(speed))[2] - figure).abs() < 0.1);
        }
        for (friction, figure) in [0.02, 0.06, 0.12].into_iter().zip(axes) {
            let found = settled_with(friction, rpm(speed), SlipModel::default(), 1e-2, 1e-6);
            println!("{speed} rpm, friction {friction}: {found:.5?}");
            assert!((found[5] - figure).abs() < tolerance, "{}", found[5]);
        }
    }
}
