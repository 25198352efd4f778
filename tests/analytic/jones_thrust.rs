//! Angular contact bearings under pure thrust at high speed: the equations of Jones and Harris for one ball,
//! solved here by nested bisection in the two contact angles, cage speed included.

use crate::agree;
use crate::bearing::rig_6205;
use rotordyn::analysis::bearing_stiffness::{BearingSolver, Condition};
use rotordyn::analysis::equilibrium::CageTreatment;
use rotordyn::bearing::{BallBearing, BallElement, BallInertia, Cage, Rotation};
use std::f64::consts::{FRAC_PI_2, PI};

/// 218 angular contact bearing: 16 balls of 22.23 mm on 125.26 mm, 40 deg, both grooves 0.5232.
fn bearing_218() -> BallBearing {
    angular(16, 22.23e-3, 125.26e-3, 40.0, [0.5232, 0.5232])
}

fn angular(balls: usize, d: f64, pitch: f64, angle_deg: f64, osculation: [f64; 2]) -> BallBearing {
    let mut bearing = rig_6205();
    let g = &mut bearing.geometry;
    (g.balls, g.ball_diameter, g.pitch_diameter) = (balls, d, pitch);
    (g.inner_groove_radius, g.outer_groove_radius) = (osculation[0] * d, osculation[1] * d);
    (g.contact_angle, g.radial_clearance) = (angle_deg.to_radians(), 0.0);
    bearing.inertia = BallInertia::OuterRaceControl;
    bearing.cage = Cage::Rolling;
    bearing
}

/// Root of an increasing function.
fn bisect(mut low: f64, mut high: f64, f: impl Fn(f64) -> f64) -> f64 {
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        if f(middle) > 0.0 { high = middle } else { low = middle }
    }
    0.5 * (low + high)
}

struct Ball {
    angles: [f64; 2],
    displacement: f64,
    cage_ratio: f64,
}

/// One ball under a thrust per ball, outer race control.
fn ball_under_thrust(bearing: &BallBearing, thrust: f64, speed: f64) -> Ball {
    let g = &bearing.geometry;
    let (d, gamma) = (g.ball_diameter, g.ball_diameter / g.pitch_diameter);
    let mass = bearing.ball_material.density * PI * d.powi(3) / 6.0;
    let hertz = bearing.hertz();
    let free = [g.inner_groove_radius - 0.5 * d, g.outer_groove_radius - 0.5 * d];
    let centres = free[0] + free[1];
    let radial = centres * g.contact_angle.cos();
    let cage_ratio = |ai: f64, ao: f64| (1.0 - gamma * ai.cos()) / (1.0 + (ai - ao).cos());
    let centrifugal = |ai: f64, ao: f64| 0.5 * mass * g.pitch_diameter * (cage_ratio(ai, ao) * speed).powi(2);
    // 2 M/D with M = J ω_R ω_m sin β, β and ω_R of rolling without spin on the outer race.
    let friction = |ai: f64, ao: f64| {
        let orbit = cage_ratio(ai, ao) * speed;
        let beta = (ao.sin() / (ao.cos() + gamma)).atan();
        let spin = orbit * (1.0 + gamma * ao.cos()) / (gamma * (beta - ao).cos());
        0.2 * mass * d * spin * orbit * beta.sin()
    };
    let inner_load = |ai: f64| thrust / ai.sin();
    let outer_load = |ai: f64, ao: f64| (thrust - friction(ai, ao) * ao.cos()) / ao.sin();
    let length = |free: f64, load: f64, stiffness: f64| free + (load.max(0.0) / stiffness).powf(2.0 / 3.0);
    let inner_length = |ai: f64| length(free[0], inner_load(ai), hertz.inner.stiffness);
    let outer_length = |ai: f64, ao: f64| length(free[1], outer_load(ai, ao), hertz.outer.stiffness);
    // The smaller the outer angle, the larger load and radial extent of the outer contact.
    let outer_angle = |ai: f64| {
        let rest = radial - inner_length(ai) * ai.cos();
        bisect(1e-6, FRAC_PI_2, |ao| rest - outer_length(ai, ao) * ao.cos())
    };
    let radial_force = |ai: f64| {
        let ao = outer_angle(ai);
        inner_load(ai) * ai.cos() - outer_load(ai, ao) * ao.cos()
            + friction(ai, ao) * ao.sin()
            + centrifugal(ai, ao)
    };
    let ai = bisect(1e-3, FRAC_PI_2 - 1e-3, |ai| -radial_force(ai));
    let ao = outer_angle(ai);
    agree::curve("radial balance of a ball", radial_force(ai).abs(), thrust + centrifugal(ai, ao), 1e-6);
    let axial = inner_length(ai) * ai.sin() + outer_length(ai, ao) * ao.sin();
    Ball {
        angles: [ai, ao],
        displacement: axial - centres * g.contact_angle.sin(),
        cage_ratio: cage_ratio(ai, ao),
    }
}

fn solve(bearing: &BallBearing, thrust: f64, rpm: f64) -> ([f64; 5], [[f64; 5]; 5], f64) {
    let solver = BearingSolver::new("thrust", bearing);
    let condition = Condition {
        load: [0.0, 0.0, thrust, 0.0, 0.0],
        prescribed: [Some(0.0), Some(0.0), None, Some(0.0), Some(0.0)],
        speed: rpm * PI / 30.0,
        cage: CageTreatment::FixedAngle,
        cage_angle: 0.0,
    };
    let found = solver.solve(&condition, None).unwrap();
    (found.displacement, found.stiffness, found.mean_cos)
}

#[test]
fn thrust_at_speed_agrees_with_jones_and_harris() {
    for (bearing, thrust, speeds) in [
        (bearing_218(), 17.8e3, [3000.0, 10000.0, 15000.0]),
        (angular(19, 11.112e-3, 90.0e-3, 25.0, [0.52, 0.53]), 900.0, [5000.0, 12000.0, 18000.0]),
        (angular(11, 7.144e-3, 38.5e-3, 15.0, [0.515, 0.525]), 120.0, [8000.0, 20000.0, 40000.0]),
    ] {
        for rpm in speeds {
            let (balls, speed) = (bearing.geometry.balls as f64, rpm * PI / 30.0);
            let at = |thrust: f64| ball_under_thrust(&bearing, thrust / balls, speed);
            let (d, k, mean_cos) = solve(&bearing, thrust, rpm);
            let ours = BallElement::new(&bearing);
            let ball = at(thrust);
            // Bisection of the angles to round-off.
            agree::absolute(
                format_args!("{rpm} rpm: axial displacement [m]"),
                d[2],
                ball.displacement,
                1e-13,
            );
            let rotation = Rotation { shaft_speed: speed, ..Rotation::default() };
            for load in ours.ball_loads(&[0.0, 0.0, d[2], 0.0, 0.0, 0.0], &rotation) {
                agree::absolute(
                    format_args!("{rpm} rpm: inner contact angle [rad]"),
                    load.contact_angle,
                    ball.angles[0],
                    1e-9,
                );
                agree::absolute(
                    format_args!("{rpm} rpm: outer contact angle [rad]"),
                    load.outer_contact_angle,
                    ball.angles[1],
                    1e-9,
                );
            }
            agree::absolute(
                format_args!("{rpm} rpm: cage speed ratio"),
                ours.cage_ratio(mean_cos),
                ball.cage_ratio,
                1e-10,
            );
            let h = 1e-4 * thrust;
            let slope = 2.0 * h / (at(thrust + h).displacement - at(thrust - h).displacement);
            // Differences of displacements of 1e-15 m round-off over 10 nm, and h².
            agree::relative(format_args!("{rpm} rpm: axial stiffness [N/m]"), k[2][2], slope, 1e-5);
        }
    }
}

#[test]
fn bearing_218_at_the_ends_of_its_run_up() {
    let (slow, ..) = solve(&bearing_218(), 17.8e3, 10000.0);
    let (fast, k, _) = solve(&bearing_218(), 17.8e3, 15000.0);
    // End of a run-up of the same bearing, to its printed digits.
    agree::absolute("axial displacement at low speed [m]", slow[2], 14.57e-6, 0.005e-6);
    agree::absolute("axial displacement at high speed [m]", fast[2], -48.6e-6, 0.05e-6);
    // Balls that keep one cage speed under radial displacement; 6.06e7 N/m with an orbital speed of its own for
    // every ball, which is the change of Q_i cos α_i when the clearance brings all balls nearer.
    let radial = |extent: f64| {
        let mut bearing = bearing_218();
        bearing.geometry.radial_clearance = -2.0 * extent;
        let rotation = Rotation { shaft_speed: 15000.0 * PI / 30.0, ..Rotation::default() };
        let ball = BallElement::new(&bearing).ball_loads(&[0.0, 0.0, fast[2], 0.0, 0.0, 0.0], &rotation)[0];
        ball.load * ball.contact_angle.cos()
    };
    let own_orbits = 8.0 * (radial(1e-8) - radial(-1e-8)) / 2e-8;
    agree::relative("axial stiffness, each ball on its own orbit [N/m]", own_orbits, 6.06e7, 1e-3);
    agree::relative("radial stiffness [N/m]", k[0][0], 7.674e7, 1e-3);
}
