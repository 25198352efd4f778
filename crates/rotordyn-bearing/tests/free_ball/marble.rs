//! A ball that rolls in a horizontal circle on the flank of a groove about a vertical axis.

use crate::bearings::{ball_bearing, free, geometry_6205, off};
use rotordyn_bearing::contact::Race;
use rotordyn_bearing::free_ball::{BallBody, FreeBallState, FreeBalls, RingState, SlipModel};

type V = nalgebra::Vector3<f64>;

const G: f64 = 9.80665;

/// tan a (g − 2/5 R ω ω_n) = 7/5 ω² r to 1e-4, ω_n the ball's rotation about the contact normal; without pivot spin
/// tan a = 7/5 ω² r/g.
///
/// The normal turns with the ball, so that ω_n has a gyroscopic moment; slip at the centre leaves ω_n free.
#[test]
fn marble_rolls_in_a_circle_on_the_flank() {
    for pivot in [0.0, 40.0, -40.0] {
        // A wide groove, and clearance enough to keep the ball off the inner race.
        let mut g = geometry_6205(1, 8e-3);
        g.outer_groove_radius = g.ball_diameter;
        let slope: f64 = 0.6;
        let mut ball = ball_bearing(g.clone());
        // Shoulders high enough for the flank.
        let bottom = g.groove_bottom_diameter(Race::Outer);
        ball.service.shoulder_diameters[1] = Some(bottom - 1.8 * g.outer_groove_radius);
        let mut bearing = free(ball, 0.5, 1e-5, SlipModel::Centre);
        // The groove's flank on the side of −z carries the ball.
        bearing.gravity = [0.0, 0.0, -G];
        let hertz = bearing.ball.hertz();
        let balls = FreeBalls::new(bearing, 0.0).unwrap();
        let [mass, inertia] = balls.ball_inertia(0);
        let ball_radius = 0.5 * g.ball_diameter;
        // The race presses the ball inwards and up: n = −sin a e_r + cos a e_z.
        let normal = V::new(-slope.sin(), 0.0, slope.cos());
        let centre_radius =
            0.5 * g.pitch_diameter - (g.outer_groove_radius - ball_radius) + 0.25 * g.radial_clearance;
        let gap = g.outer_groove_radius - ball_radius;
        let (mut radius, mut orbit, mut depth) = (0.0, 0.0, 0.0);
        // The load, and so the depth, follows from the orbit.
        for _ in 0..50 {
            radius = centre_radius + (gap + depth) * slope.sin();
            let rolling = ball_radius - 0.5 * depth;
            let share = inertia / (mass * rolling * rolling);
            // (1 + s) r ω² + s R tan a ω_n ω − tan a g = 0, s = I/(m R²).
            let (a, b, c) = ((1.0 + share) * radius, share * rolling * slope.tan() * pivot, -slope.tan() * G);
            orbit = (-b + f64::sqrt(b * b - 4.0 * a * c)) / (2.0 * a);
            let load = mass * (G * slope.cos() + radius * orbit * orbit * slope.sin());
            depth = (load / hertz.outer.stiffness).powf(2.0 / 3.0);
        }
        let position = V::new(radius, 0.0, -(gap + depth) * slope.cos());
        let velocity = V::new(0.0, radius * orbit, 0.0);
        let rolling = ball_radius - 0.5 * depth;
        // No slip at the contact, v − R ω × n = 0: ω = n × v/R + ω_n n.
        let rotation = normal.cross(&velocity) / rolling + pivot * normal;
        let body = BallBody { position, velocity, rotation };
        let mut state = FreeBallState::new(&[body], None);
        let still = [RingState::default(); 2];
        // Means of slope, radius, orbital speed and pivot spin.
        let (mut sums, intervals) = ([0.0; 4], 200);
        for _ in 0..intervals {
            balls.advance(&mut state, [&still; 2], 1e-3, 1e-6).unwrap();
            let ball = state.ball(0);
            let distance = ball.position.xy().norm();
            let outward = V::new(ball.position.x, ball.position.y, 0.0) / distance;
            let tilt = ((distance - centre_radius) / -ball.position.z).atan();
            let normal = V::new(0.0, 0.0, tilt.cos()) - tilt.sin() * outward;
            let around = outward.x * ball.velocity.y - outward.y * ball.velocity.x;
            for (sum, value) in
                sums.iter_mut().zip([tilt, distance, around / distance, ball.rotation.dot(&normal)])
            {
                *sum += value / intervals as f64;
            }
        }
        let [tilt, radius, orbit, spin] = sums;
        let left = tilt.tan() * (G - 0.4 * ball_radius * orbit * spin);
        let right = 1.4 * orbit * orbit * radius;
        println!(
            "pivot spin {spin:.3} rad/s, slope {tilt:.6} (started at {slope}), sides differ by {:.2e}; without the spin \
             term by {:.2e}",
            left / right - 1.0,
            tilt.tan() * G / right - 1.0
        );
        assert!(off(left, right) < 1e-4);
    }
}
