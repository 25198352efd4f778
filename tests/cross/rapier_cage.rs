//! Free balls in rapier compared with the kinematic cage: speed ratio ½ (1 − D_w/D_pw) and even spacing.

use crate::agree;
use std::f64::consts::{PI, TAU};

use rotordyn::bearing::{BallBearing, BallElement};
use rotordyn::contact::Traction;
use rotordyn::geometry::rapier::{FreeBallBearing, FreeBallSettings};

use crate::bearing::rig_6205;

/// 1200 rpm as on the rig.
const SPEED: f64 = 1200.0 * TAU / 60.0;

fn settings(cage: bool, displacement: [f64; 3]) -> FreeBallSettings {
    FreeBallSettings {
        // Ball of 2 g between contacts of some 5e7 N/m: ω dt = 0.4, and traction relaxes at a rate of
        // 2 (1 + 5/2) μQ/(m v₀), 4e5 1/s at 75 N: 0.8 a step. Both well below the limit of 2.
        step: 2e-6,
        speed: SPEED,
        displacement,
        gravity: [0.0, -9.80665, 0.0],
        traction: Traction { friction: 0.08, slip_speed: 0.05 },
        cage,
        pocket: [2e6, 20.0],
        race_damping: 30.0,
    }
}

fn bearing(radial_clearance: f64) -> BallBearing {
    let mut bearing = rig_6205();
    bearing.geometry.radial_clearance = radial_clearance;
    bearing
}

/// Angle by which a ball leads its nominal position \[rad\], in (−π, π].
fn ahead(free: &FreeBallBearing, ball: usize, first: f64) -> f64 {
    let centre = free.ball_centre(ball);
    let angle = centre.y.atan2(centre.x) - first - TAU * ball as f64 / 9.0;
    (angle + PI).rem_euclid(TAU) - PI
}

/// Light interference keeps every ball loaded; gravity is the only disturbance: its creep v₀ m g/(2 μ Q) is
/// about 3e-4 m/s of 0.95 m/s at Q = 9 N, with opposite sign on opposite sides of the ring. Interference
/// moves centres and contacts by P_d/4 = 1 um of 19 mm, 5e-5.
#[test]
fn balls_without_cage_roll_at_kinematic_speed() {
    let bearing = bearing(-4e-6);
    let expected = BallElement::new(&bearing).cage_ratio(1.0) * SPEED;
    let mut free = FreeBallBearing::new(&bearing, settings(false, [0.0; 3]));
    free.run(5000);
    let ratios: Vec<f64> = (0..9).map(|j| free.orbital_speed(j) / expected).collect();
    println!("{ratios:?}");
    for ratio in &ratios {
        agree::absolute("cage speed of rigid bodies over the kinematic one", *ratio, 1.0, 5e-4);
    }
    let mean = ratios.iter().sum::<f64>() / 9.0;
    agree::absolute("cage speed of rigid bodies, mean", mean, 1.0, 1e-4);
    // Spaced by rolling alone: deviations are within the clearance that cage pockets would have.
    let first = free.ball_centre(0);
    let first = first.y.atan2(first.x);
    for j in 0..9 {
        let off = ahead(&free, j, first) * 19.25e-3;
        agree::absolute("ball ahead of its place by rolling alone [m]", off, 0.0, 81e-6);
    }
}

/// Under radial load with clearance some balls are unloaded; the cage drives them. Each ball may be anywhere
/// in its pocket, so over an angle φ the cage's mean speed is known to two pocket clearances over R φ.
#[test]
fn free_cage_has_kinematic_speed_and_spacing() {
    let bearing = bearing(10e-6);
    let expected = BallElement::new(&bearing).cage_ratio(1.0) * SPEED;
    let mut free = FreeBallBearing::new(&bearing, settings(true, [0.0, -9e-6, 0.0]));
    let clearance = 0.5 * (bearing.cage_pocket_diameter - bearing.geometry.ball_diameter);
    let radius = 0.5 * bearing.geometry.pitch_diameter;
    free.run(5000);
    let (mut travelled, mut last) = (0.0, free.cage().unwrap()[0]);
    let (mut farthest, mut loaded): (f64, Vec<f64>) = (0.0, vec![]);
    for _ in 0..100 {
        free.run(200);
        let [angle, _] = free.cage().unwrap();
        travelled += (angle - last).rem_euclid(TAU);
        last = angle;
        for j in 0..9 {
            farthest = farthest.max(radius * ahead(&free, j, angle).abs());
            // Within 20 degrees of the load direction.
            let centre = free.ball_centre(j);
            if centre.y < -radius * 20f64.to_radians().cos() {
                loaded.push(free.orbital_speed(j) / expected);
            }
        }
    }
    let time = 100.0 * 200.0 * 2e-6;
    let ratio = travelled / time / expected;
    let loaded_mean = loaded.iter().sum::<f64>() / loaded.len() as f64;
    println!("cage {ratio}, loaded balls {loaded_mean}, farthest {farthest:e} of {clearance:e} m");
    agree::absolute("cage travel over the kinematic one", ratio, 1.0, 2.0 * clearance / (radius * travelled));
    // Clearance and load move ball centres out by P_d/4 + δ_o = 4.6 um of 19.3 mm and inner contacts in by
    // P_d/4 + δ_i/2 = 3.5 um of 15.3 mm: 4.7e-4 slower; creep that drives the unloaded balls: 3e-4.
    agree::absolute("cage speed under load, mean", loaded_mean, 1.0 - 4.7e-4, 3e-4);
    // The pocket wall deflects by a few micrometres under a driven ball.
    assert!(farthest < clearance + 5e-6, "{farthest:e}");
}
