//! Motion, sliding, friction torque and shoulder distance of balls against closed forms and brute force.

use crate::agree;
use crate::bearing::rig_6205;
use rotordyn_bearing::contact::{ContactPatch, Race};
use rotordyn_bearing::friction::{Lubrication, SLIDING_FRICTION, load_torque, spin_torque, viscous_torque};
use rotordyn_bearing::kinematics::{
    ball_advance, ball_motions, control_ratio, deformed_radius, largest_pressure_velocity, mounted_geometry,
    pitch_angle, rolling_speeds,
};
use rotordyn_bearing::shoulder::{margin, shoulder_angle, shoulder_height};
use rotordyn_bearing::{BallBearing, BallInertia, BallLoad, BallMotion, shoulder_margin};
use std::f64::consts::{PI, TAU};

/// 7210-like angular contact bearing: 14 balls of 12.7 mm on 70 mm at 40 deg.
fn angular() -> BallBearing {
    let mut bearing = rig_6205();
    let g = &mut bearing.geometry;
    (g.balls, g.ball_diameter, g.pitch_diameter) = (14, 12.7e-3, 70e-3);
    (g.inner_groove_radius, g.outer_groove_radius) = (0.52 * 12.7e-3, 0.53 * 12.7e-3);
    (g.radial_clearance, g.contact_angle) = (0.0, 40f64.to_radians());
    bearing
}

fn load(position: f64, [inner, outer]: [f64; 2], [inner_deg, outer_deg]: [f64; 2]) -> BallLoad {
    BallLoad {
        row: 0,
        position,
        load: inner,
        contact_angle: inner_deg.to_radians(),
        deflection: 1e-6,
        outer_load: outer,
        outer_contact_angle: outer_deg.to_radians(),
        film: [0.0; 2],
    }
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// Without contact angle a ball rolls and does not spin.
#[test]
fn radial_ball_rolls_without_spinning() {
    let bearing = rig_6205();
    let speed = 314.0;
    let [motion] = ball_motions(&bearing, &[load(0.3, [100.0; 2], [0.0; 2])], speed)[..] else { panic!() };
    let gamma = 7.938 / 38.5;
    agree::relative("orbital speed [rad/s]", motion.orbital_speed, 0.5 * (1.0 - gamma) * speed, 1e-14);
    agree::relative(
        "ball speed [rad/s]",
        motion.ball_speed,
        0.5 * (1.0 - gamma * gamma) / gamma * speed,
        1e-14,
    );
    assert_eq!((motion.spin, motion.pitch_angle), ([0.0; 2], 0.0));
    assert!(motion.ball_velocity[0] < 0.0, "the ball turns against the shaft");
    // The curvature of the groove alone slides: largest at a quarter to a half of the ellipse.
    assert!(motion.pressure_velocity.iter().all(|pv| *pv > 0.0));
    assert_eq!(spin_torque(&[motion], SLIDING_FRICTION, speed), 0.0);
}

/// Velocities of ball and races at both contact centres in space: no sliding, and the relative rotation about the
/// normal is the spin; in Harris's closed forms too.
#[test]
fn contact_centres_do_not_slide() {
    for (inertia, control) in
        [(BallInertia::OuterRaceControl, Race::Outer), (BallInertia::InnerRaceControl, Race::Inner)]
    {
        for (angles, position, speed) in
            [([40.0, 40.0], 0.0, 1000.0), ([43.0, 36.0], 1.1, 800.0), ([-30.0, -25.0], 4.0, -500.0)]
        {
            let bearing = BallBearing { inertia, ..angular() };
            let g = &bearing.geometry;
            let ball = load(position, [200.0, 230.0], angles);
            let [motion] = ball_motions(&bearing, &[ball], speed)[..] else { panic!() };
            assert_eq!(motion.control, Some(control));
            let radial = [position.cos(), position.sin(), 0.0];
            let centre = radial.map(|r| 0.5 * g.pitch_diameter * r);
            let axis = [0.0, 0.0, 1.0];
            // The ball in space: it orbits, and turns about its own axis in the orbiting frame.
            let spinning: [f64; 3] = std::array::from_fn(|k| {
                motion.orbital_speed * axis[k]
                    + motion.ball_velocity[0] * axis[k]
                    + motion.ball_velocity[1] * radial[k]
            });
            for (k, side) in [-1.0, 1.0].into_iter().enumerate() {
                let (sin, cos) = angles[k].to_radians().sin_cos();
                let normal: [f64; 3] = std::array::from_fn(|n| side * (cos * radial[n] + sin * axis[n]));
                let arm = normal.map(|n| 0.5 * g.ball_diameter * n);
                let point: [f64; 3] = std::array::from_fn(|n| centre[n] + arm[n]);
                let race = axis.map(|a| if k == 0 { speed * a } else { 0.0 });
                let orbit = cross(axis.map(|a| motion.orbital_speed * a), centre);
                let turned = cross(spinning, arm);
                let of_race = cross(race, point);
                let sliding: [f64; 3] = std::array::from_fn(|n| orbit[n] + turned[n] - of_race[n]);
                agree::curve("sliding at the contact", dot(sliding, sliding).sqrt(), speed.abs(), 1e-12);
                let relative: [f64; 3] = std::array::from_fn(|n| spinning[n] - race[n]);
                let spin = dot(relative, normal);
                agree::absolute(
                    format_args!("spin, contact {k} [rad/s]"),
                    spin,
                    motion.spin[k],
                    1e-10 * speed.abs(),
                );
                let rolling = (dot(relative, relative) - spin * spin).sqrt();
                agree::relative(
                    format_args!("rolling, contact {k} [rad/s]"),
                    rolling,
                    motion.rolling[k].abs(),
                    1e-10,
                );
            }
            let free = if control == Race::Outer { 1 } else { 0 };
            agree::curve("spin at the controlling race", motion.spin[free].abs(), speed.abs(), 1e-10);
            // Harris, Rolling Bearing Analysis, ch. 8: spin-to-roll ratio at the inner race.
            let gamma = g.ball_diameter / g.pitch_diameter;
            let [inner, pitch] = [angles[0].to_radians(), motion.pitch_angle];
            let published = (1.0 - gamma * inner.cos()) * (inner - pitch).tan() + gamma * inner.sin();
            agree::absolute("spin-to-roll ratio", motion.spin_to_roll()[0], published.abs(), 1e-10);
        }
    }
}

/// Under equal loads and angles the criterion is a_o E_o/(a_i E_i); with the centrifugal force of high speed the outer
/// race controls.
#[test]
fn race_control_follows_the_criterion() {
    let bearing = angular();
    let hertz = bearing.hertz();
    let equal = load(0.0, [300.0; 2], [40.0; 2]);
    let [inner, outer] = equal.patches(&hertz);
    let expected =
        outer.semi_major * hertz.outer.integrals[1] / (inner.semi_major * hertz.inner.integrals[1]);
    agree::relative("ratio of race control", control_ratio(&hertz, &equal), expected, 1e-13);
    let heavy = load(0.0, [300.0, 900.0], [50.0, 20.0]);
    let light = load(0.0, [900.0, 300.0], [40.0; 2]);
    let controls = ball_motions(&bearing, &[heavy, light], 100.0);
    assert_eq!(
        controls.iter().map(|m| m.control).collect::<Vec<_>>(),
        [Some(Race::Outer), Some(Race::Inner)]
    );
    let power = (900.0f64 / 300.0).powf(4.0 / 3.0);
    let ratio = control_ratio(&hertz, &heavy) / control_ratio(&hertz, &equal);
    agree::relative(
        "ratio of race control over contact angle",
        ratio,
        power * 30f64.to_radians().cos(),
        1e-12,
    );
    // Both races turning together carry the ball along.
    let turned = rolling_speeds(0.2, [0.7, 0.6], pitch_angle(Race::Outer, 0.2, [0.7, 0.6]), [50.0; 2]);
    agree::absolute("speed with both races turning [rad/s]", turned[0], 50.0, 1e-12);
    agree::absolute("ball speed with both races turning [rad/s]", turned[1], 0.0, 1e-12);
    // No load: the ball goes along with the cage of the nominal contact angle.
    let [idle] = ball_motions(&bearing, &[load(0.0, [0.0, 5.0], [40.0; 2])], 100.0)[..] else { panic!() };
    let gamma = 12.7 / 70.0 * 40f64.to_radians().cos();
    agree::absolute("orbital speed of an idle ball [rad/s]", idle.orbital_speed, 50.0 * (1.0 - gamma), 1e-9);
    assert!(idle.control.is_none());
}

/// M_s = ∫ μ p r dA over the ellipse, by summation.
#[test]
fn spin_moment_is_the_integral_of_friction() {
    let bearing = angular();
    let ball = load(0.0, [300.0, 350.0], [41.0, 38.0]);
    let [motion] = ball_motions(&bearing, &[ball], 500.0)[..] else { panic!() };
    for (k, patch) in ball.patches(&bearing.hertz()).iter().enumerate() {
        let (a, b) = (patch.semi_major, patch.semi_minor);
        let n = 1500;
        let mut sum = 0.0;
        for i in 0..n {
            for j in 0..n {
                let [u, v] = [i, j].map(|k| (2.0 * k as f64 + 1.0) / n as f64 - 1.0);
                let inside = 1.0 - u * u - v * v;
                if inside > 0.0 {
                    sum += inside.sqrt() * (b * u).hypot(a * v);
                }
            }
        }
        let moment = patch.maximum_pressure * sum * a * b * (2.0 / n as f64).powi(2);
        agree::relative(
            format_args!("moment of spin friction, contact {k} [N m]"),
            motion.spin_moment[k],
            moment,
            1e-4,
        );
    }
    // The torque on the shaft supplies the power.
    let torque = spin_torque(&[motion; 3], 0.085, 500.0);
    let power: f64 = (0..2).map(|k| 0.085 * motion.spin_moment[k] * motion.spin[k].abs()).sum();
    agree::relative("friction power [W]", torque * 500.0, 3.0 * power, 1e-12);
    assert!(power > 0.0);
}

#[test]
fn largest_pressure_times_sliding_speed() {
    let circle = ContactPatch { semi_major: 1e-4, semi_minor: 1e-4, maximum_pressure: 1e9, deflection: 1e-6 };
    // p₀ √(1 − s²) ω a s is largest at s = 1/√2, which the rings miss by 1e-3 at most.
    let spinning = largest_pressure_velocity(&circle, 4e-3, 100.0, 0.0);
    agree::relative("power of spin [W]", spinning, 0.5 * 1e9 * 100.0 * 1e-4, 1e-3);
    // Long ellipse, sliding by the curvature alone: along y the largest of √(1 − s²) |c² − s²|, steep between two rings.
    let long = ContactPatch { semi_major: 1e-3, semi_minor: 1e-4, ..circle };
    let rolling = largest_pressure_velocity(&long, 4e-3, 0.0, 1000.0);
    let c = 0.347_296_355_333_860_7f64;
    // Lines of pure rolling: the load within them is half of the load.
    agree::absolute(
        "lines of pure rolling: balance of Heathcote slip",
        1.5 * (c - c.powi(3) / 3.0),
        0.5,
        1e-12,
    );
    let s2 = (2.0 + c * c) / 3.0;
    let expected = 1e9 * 1000.0 * 1e-6 / (2.0 * 4e-3) * (1.0 - s2).sqrt() * (s2 - c * c);
    agree::relative("rolling power by Heathcote slip [W]", rolling, expected, 4e-3);
    agree::absolute("deformed radius of a groove of the ball [m]", deformed_radius(6e-3, 12e-3), 6e-3, 1e-15);
}

/// Orbital speeds 1 + e cos ψ: the ball leads by e sin ψ.
#[test]
fn ball_advance_integrates_the_orbital_speed() {
    let n = 72;
    let at = |k: usize| TAU * ((k * 5) % n) as f64 / n as f64 - PI;
    let loads: Vec<BallLoad> = (0..n).map(|k| load(at(k), [1.0; 2], [0.0; 2])).collect();
    let motions: Vec<BallMotion> = loads
        .iter()
        .map(|l| BallMotion {
            orbital_speed: 40.0 * (1.0 + 0.02 * l.position.cos()),
            ..BallMotion::default()
        })
        .collect();
    for (ball, advance) in loads.iter().zip(ball_advance(&loads, &motions)) {
        agree::absolute("advance of a ball [rad]", advance, 0.02 * ball.position.sin(), 2e-5);
    }
    let alike = vec![BallMotion { orbital_speed: 40.0, ..BallMotion::default() }; n];
    for advance in ball_advance(&loads, &alike) {
        agree::absolute("advance of a ball among equal ones [rad]", advance, 0.0, 1e-12);
    }
}

#[test]
fn friction_torque_after_palmgren() {
    let g = rig_6205().geometry;
    // 1e-7 · 2 · (20 · 3000)^(2/3) · 38.5³ N mm, and 160e-7 · 2 · 38.5³ below ν n = 2000.
    let fast = viscous_torque(&g, 2.0, 20e-6, 3000.0 * TAU / 60.0);
    agree::relative(
        "Palmgren moment, fast [N mm]",
        fast,
        2e-10 * 60000f64.powf(2.0 / 3.0) * 38.5f64.powi(3),
        1e-12,
    );
    agree::relative("Palmgren moment, fast, printed [N mm]", fast, 17.49e-3, 1e-3);
    let slow = viscous_torque(&g, 2.0, 20e-6, 50.0 * TAU / 60.0);
    agree::relative("Palmgren moment, slow", slow, 320e-10 * 38.5f64.powi(3), 1e-12);
    assert_eq!(viscous_torque(&g, 2.0, 20e-6, 0.0), 0.0);
    // Radial load: f_1 F_r d_m; thrust: F_β = 3 F_a.
    let [radial, factor] = load_torque(&g, 7800.0, 780.0, 0.0);
    agree::relative("Palmgren factor of load", factor, 5e-4 * 0.1f64.powf(0.55), 1e-12);
    agree::relative("load moment, radial [N m]", radial, 5e-4 * 0.1f64.powf(0.55) * 780.0 * 38.5e-3, 1e-12);
    let [thrust, _] = load_torque(&g, 7800.0, 0.0, -780.0);
    agree::relative(
        "load moment, thrust [N m]",
        thrust,
        5e-4 * 0.05f64.powf(0.55) * 3.0 * 780.0 * 38.5e-3,
        1e-12,
    );
    let g = angular().geometry;
    let [thrust, _] = load_torque(&g, 30e3, 0.0, 3000.0);
    let expected = 1e-3 * (0.26f64 * 0.1).powf(0.33) * 0.9 * 3000.0 / 40f64.to_radians().tan() * 70e-3;
    agree::relative("load moment [N m]", thrust, expected, 1e-9);
    assert_eq!(load_torque(&g, 30e3, 0.0, 0.0), [0.0; 2]);
    // Table 14.3 of Harris: deep groove and angular contact.
    for (method, factors) in [
        (Lubrication::OilMist, [1.0, 1.7]),
        (Lubrication::OilBath, [2.0, 3.3]),
        (Lubrication::OilJet, [4.0, 6.6]),
        (Lubrication::Grease, [1.35, 2.0]),
        (Lubrication::Factor(0.4), [0.4, 0.4]),
    ] {
        assert_eq!([rig_6205().geometry, angular().geometry].map(|g| method.viscous_factor(&g)), factors);
    }
}

#[test]
fn mounted_geometry_follows_clearance_and_fit() {
    let mut bearing = rig_6205();
    let distance: f64 = (0.515 + 0.525 - 1.0) * 7.938e-3;
    let free = mounted_geometry(&bearing, 0.0);
    agree::absolute(
        "free contact angle [rad]",
        free.free_contact_angle,
        (1.0 - 10e-6 / (2.0 * distance)).acos(),
        1e-12,
    );
    // Axial clearance from the triangle of the groove centres.
    let axial = 2.0 * (distance.powi(2) - (distance - 5e-6).powi(2)).sqrt();
    agree::relative("axial clearance [m]", free.axial_clearance, axial, 1e-9);
    bearing.fit.shaft_interference = 8e-6;
    let fitted = mounted_geometry(&bearing, 0.0);
    agree::absolute(
        "clearance as mounted [m]",
        fitted.radial_clearance,
        10e-6 + bearing.clearance_change(0.0),
        1e-15,
    );
    assert!(fitted.free_contact_angle < free.free_contact_angle);
    bearing.fit.shaft_interference = 40e-6;
    let tight = mounted_geometry(&bearing, 0.0);
    assert!(tight.radial_clearance < 0.0);
    assert_eq!((tight.free_contact_angle, tight.axial_clearance), (0.0, 0.0));
    let nominal = mounted_geometry(&angular(), 0.0);
    agree::absolute("nominal contact angle [rad]", nominal.free_contact_angle, 40f64.to_radians(), 1e-12);
}

/// Distance of the ellipse from the shoulder against points along the groove.
#[test]
fn shoulder_margin_against_points_of_the_groove() {
    let (radius, shoulder) = (6.6e-3, 50f64.to_radians());
    for (angle, semi_axis) in
        [(0.0, 1e-3), (0.7, 1e-3), (-0.8, 1.2e-3), (0.85, 0.6e-3), (1.2, 1e-3), (0.1, 8e-3)]
    {
        let found = margin(radius, shoulder, angle, semi_axis);
        let points = 20_000;
        let beyond = (0..points)
            .filter(|k| {
                let along = 2.0 * (*k as f64 + 0.5) / f64::from(points) - 1.0;
                (angle + along * semi_axis / radius).abs() > shoulder
            })
            .count();
        let share = beyond as f64 / f64::from(points);
        agree::absolute("share of the ellipse beyond the shoulder", found.fraction_beyond, share, 2e-4);
        let edge = f64::abs(angle) + semi_axis / radius;
        agree::absolute("arc to the shoulder [m]", found.arc, radius * (shoulder - edge), 1e-15);
        assert_eq!(found.arc < 0.0, found.fraction_beyond > 0.0);
    }
}

#[test]
fn shoulders_by_diameter_and_by_rule() {
    let mut bearing = rig_6205();
    let g = bearing.geometry.clone();
    // Grooves of 38.5 ∓ 7.938 mm, opened by half of the clearance of 10 µm each.
    let [inner, outer] = [Race::Inner, Race::Outer].map(|race| g.groove_bottom_diameter(race));
    agree::absolute("diameter of the inner race [m]", inner, 38.5e-3 - 7.938e-3 - 5e-6, 1e-9);
    agree::absolute("diameter of the outer race [m]", outer, 38.5e-3 + 7.938e-3 + 5e-6, 1e-9);
    agree::absolute(
        "shoulder height of a deep groove [m]",
        shoulder_height(&bearing, Race::Inner),
        0.2 * 7.938e-3,
        1e-15,
    );
    bearing.service.shoulder_diameters = [Some(33.5e-3), Some(43.9e-3)];
    for (race, height) in [(Race::Inner, 0.5 * (33.5e-3 - inner)), (Race::Outer, 0.5 * (outer - 43.9e-3))] {
        agree::absolute("shoulder height [m]", shoulder_height(&bearing, race), height, 1e-15);
        let angle = shoulder_angle(&bearing, race);
        agree::absolute(
            "height at the shoulder angle [m]",
            g.groove_radius(race) * (1.0 - angle.cos()),
            height,
            1e-12,
        );
    }
    // The ellipse of a radial load lies in the middle; a thrust of 20 kN on a 6205 climbs onto the shoulder.
    let radial = shoulder_margin(&bearing, &load(0.0, [1500.0; 2], [0.0; 2]));
    assert!(radial.iter().all(|m| m.arc > 1e-3 && m.fraction_beyond == 0.0), "{radial:?}");
    let thrust = shoulder_margin(&bearing, &load(0.0, [2400.0; 2], [67.5; 2]));
    assert!(thrust.iter().all(|m| m.arc < 0.0 && m.fraction_beyond > 0.7), "{thrust:?}");
    // An angular contact bearing reaches beyond its contact angle.
    assert!(shoulder_angle(&angular(), Race::Inner) >= 65f64.to_radians() - 1e-12);
}
