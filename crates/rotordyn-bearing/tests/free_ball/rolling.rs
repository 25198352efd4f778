//! Balls that roll between two races or on one, against closed forms.

use crate::bearings::{ball_bearing, free, geometry_6205, off, rings, rpm};
use rotordyn_bearing::free_ball::{FreeBalls, SlipModel};

/// Orbit and spin of a ball between two races are those of the epicyclic gear with the true rolling radii: to 1e-6.
#[test]
fn two_races_drive_a_ball_at_the_epicyclic_speed() {
    let ball = ball_bearing(geometry_6205(9, -4e-6));
    let kinematic = ball.geometry.characteristic_orders(0.0).ftf;
    let balls = FreeBalls::new(free(ball, 0.1, 1e-2, SlipModel::Centre), 0.0).unwrap();
    let speed = rpm(1200.0);
    let mut state = balls.initial_state(&rings(speed, 0.0)).unwrap();
    for k in 0..20 {
        let t = 1e-3 * k as f64;
        balls.advance(&mut state, [&rings(speed, t), &rings(speed, t + 1e-3)], 1e-3, 1e-6).unwrap();
    }
    let end = rings(speed, 20e-3);
    let ball = &balls.report(&state, &end)[0];
    let (orbit, spin) = (ball.orbital_speed / speed, ball.rotation[0] / speed);
    println!("orbit {:.4e} above kinematics, spin/shaft {spin:.6}", orbit / kinematic - 1.0);
    println!("{ball:?}");
    assert!(off(orbit, kinematic * (1.0 + 2.681e-5)) < 1e-6);
    assert!((spin + 1.925352).abs() < 2e-6);
}

/// Over the ellipse the contact rolls where its friction adds up to zero, at ±c a beside the centre: c² = 1/5 where slip is
/// well below v₀ (mean of y² under the pressure), c − c³/3 = 1/3 where it is well above (equal pressure on both sides).
///
/// The rolling radii are D_w/2 − δ/2 − (c a)²/(2 R); the orbit follows from them to 2e-5 of its speed; the two limits are
/// 2.5e-4 apart. Source of the second: Harris, Rolling Bearing Analysis, ch. 8.
#[test]
fn rolling_lines_of_the_ellipse_set_the_orbit() {
    let coulomb = 0.347_296_355_333_860_7_f64.powi(2);
    for (slip_speed, share, step) in [(1.0, 0.2, 1e-6), (2e-5, coulomb, 5e-8)] {
        let ball = ball_bearing(geometry_6205(1, -4e-6));
        let (hertz, g) = (ball.hertz(), ball.geometry.clone());
        let slip = SlipModel::Ellipse { along: 4, across: 48 };
        // Much friction in the linear regime, so that the ball settles in milliseconds.
        let friction = if slip_speed > 0.1 { 5.0 } else { 0.1 };
        let balls = FreeBalls::new(free(ball, friction, slip_speed, slip), 0.0).unwrap();
        let speed = rpm(1200.0);
        let mut state = balls.initial_state(&rings(speed, 0.0)).unwrap();
        for k in 0..8 {
            let t = 1e-3 * k as f64;
            balls.advance(&mut state, [&rings(speed, t), &rings(speed, t + 1e-3)], 1e-3, step).unwrap();
        }
        let report = &balls.report(&state, &rings(speed, 8e-3))[0];
        let radius = state.ball(0).position.norm();
        let [inner, outer] = [(0, &hertz.inner, 0.515), (1, &hertz.outer, 0.525)].map(|(k, contact, f)| {
            let patch = contact.patch(report.races[k].unwrap().load);
            // 1/R = 1/D_w + 1/(2 r) of bodies of one elasticity.
            let curvature = (1.0 + 0.5 / f) / g.ball_diameter;
            let rise = 0.5 * curvature * share * patch.semi_major.powi(2);
            0.5 * g.ball_diameter - 0.5 * patch.deflection - rise
        });
        let expected = (radius - inner) / (radius * (1.0 + inner / outer));
        let found = report.orbital_speed / speed;
        println!(
            "c² = {share:.4}: orbit {:.4e} above kinematics, closed form {:.4e}",
            found / g.characteristic_orders(0.0).ftf - 1.0,
            expected / g.characteristic_orders(0.0).ftf - 1.0
        );
        assert!(off(found, expected) < 2e-5);
        // ω_k r − a_i ω_b = Ω (r − a_i) at the inner race.
        let spin = (expected * radius - (radius - inner)) / inner;
        println!("   spin {:.6}, closed form {spin:.6}", report.rotation[0] / speed);
        assert!(off(report.rotation[0] / speed, spin) < 5e-5);
    }
}
