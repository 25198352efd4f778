//! Statics of balls with inertia: the cage speed belongs to the loads, and the tangent contains its change.

use crate::ball_bearing::Random;
use crate::ball_combinations::{angular, film, for_each_combination, lever};
use rotordyn_bearing::{BallBearing, BallElement, BallInertia, Cage, Preload, Reaction, Rotation};

fn at_speed(speed: f64, cage_angle: f64) -> Rotation {
    Rotation { cage_angle, shaft_speed: speed, ..Rotation::default() }
}

/// Displacement that loads all balls, with tilt.
fn loaded(random: &mut Random) -> [f64; 6] {
    let mut d = random.scaled([3e-6, 3e-6, 4e-6, 1e-4, 1e-4, 0.0]);
    d[2] += 8e-6;
    d
}

/// Whether a contact opens, or the share of the inner race begins to fade (Q_i = F_c), near a displacement:
/// kinks within a difference.
fn is_near_a_kink(bearing: &BallBearing, d: &[f64; 6], rotation: &Rotation) -> bool {
    let element = BallElement::new(bearing);
    let ratio = element.cage_ratio(element.reaction(d, &[0.0; 6], rotation).mean_cos);
    let (g, density) = (&bearing.geometry, bearing.ball_material.density);
    let mass = density * std::f64::consts::PI / 6.0 * g.ball_diameter.powi(3);
    let centrifugal = 0.5 * mass * g.pitch_diameter * (ratio * rotation.shaft_speed).powi(2);
    let loads = element.ball_loads(d, rotation);
    let most = loads.iter().map(|b| b.load).fold(0.0, f64::max);
    loads.iter().any(|b| b.load < 0.02 * most || (b.load / centrifugal - 1.0).abs() < 0.2)
}

#[test]
fn static_cage_speed_is_that_of_rolling_under_the_loads() {
    let mut random = Random(3);
    let (mut compared, mut moved) = (0, 0.0f64);
    for_each_combination(|name, bearing| {
        if bearing.inertia == BallInertia::None {
            return;
        }
        let bearing = &BallBearing { cage: Cage::Rolling, ..bearing.clone() };
        let element = BallElement::new(bearing);
        let (d, still) = (loaded(&mut random), at_speed(2500.0, 0.3));
        let statics = element.reaction(&d, &[0.0; 6], &still);
        let ratio = element.cage_ratio(statics.mean_cos);
        // A steady run at this ring position, damping without rate apart: balls at the same cage speed.
        let moving = Rotation { cage_speed: Some(ratio * 2500.0), ..still };
        for (a, b) in element.ball_loads(&d, &still).iter().zip(element.ball_loads(&d, &moving)) {
            assert!((a.load - b.load).abs() <= 1e-9 * (1.0 + b.outer_load), "{name}: {a:?} {b:?}");
        }
        moved = moved.max((ratio / element.cage_ratio(element.nominal_cos()) - 1.0).abs());
        compared += 1;
    });
    assert!(compared > 300 && moved > 0.01, "{compared} {moved}");
}

/// −∂f/∂d by Richardson's extrapolation of central differences.
fn differences(force: impl Fn(&[f64; 6]) -> [f64; 6], d: &[f64; 6]) -> [[f64; 6]; 6] {
    let mut out = [[0.0; 6]; 6];
    for column in 0..5 {
        let by = |step: f64| -> [f64; 6] {
            let h = step / lever(column);
            let [plus, minus] = [h, -h].map(|h| {
                let mut at = *d;
                at[column] += h;
                force(&at)
            });
            std::array::from_fn(|row| (minus[row] - plus[row]) / (2.0 * h))
        };
        let (coarse, fine) = (by(4e-8), by(2e-8));
        for row in 0..6 {
            out[row][column] = (4.0 * fine[row] - coarse[row]) / 3.0;
        }
    }
    out
}

fn largest_difference(found: &Reaction, by_difference: &[[f64; 6]; 6]) -> f64 {
    let scale = |a: usize, b: usize| 1.0 / (lever(a) * lever(b));
    let (mut off, mut size) = (0.0f64, 0.0f64);
    for (a, row) in by_difference.iter().enumerate().take(5) {
        for (b, difference) in row.iter().enumerate().take(5) {
            off = off.max((found.stiffness[a][b] - difference).abs() * scale(a, b));
            size = size.max(difference.abs() * scale(a, b));
        }
    }
    off / size
}

#[test]
fn static_tangent_contains_the_cage_speed() {
    let mut random = Random(8);
    let (mut compared, mut worst) = (0, 0.0f64);
    for_each_combination(|name, bearing| {
        if bearing.inertia == BallInertia::None
            || matches!(bearing.contact, rotordyn_bearing::contact::ContactLaw::Ehl(_))
        {
            return;
        }
        let mut bearing = BallBearing { cage: Cage::Rolling, ..bearing.clone() };
        bearing.imperfections = Default::default();
        let element = BallElement::new(&bearing);
        let (d, still) = (loaded(&mut random), at_speed(2500.0, random.next()));
        if is_near_a_kink(&bearing, &d, &still) {
            return;
        }
        let force = |d: &[f64; 6]| element.reaction(d, &[0.0; 6], &still).force;
        let off = largest_difference(&element.reaction(&d, &[0.0; 6], &still), &differences(force, &d));
        assert!(off < 1e-6, "{name}: {off}");
        worst = worst.max(off);
        compared += 1;
        if compared % 16 == 0 {
            let force = |d: &[f64; 6]| element.cage_average(d, &still, 4).force;
            let off = largest_difference(&element.cage_average(&d, &still, 4), &differences(force, &d));
            assert!(off < 1e-6, "{name} averaged: {off}");
        }
    });
    assert!(compared > 100, "{compared} compared, worst {worst}");
}

#[test]
fn preload_by_force_is_set_at_the_cage_speed_of_the_centred_bearing() {
    for inertia in [BallInertia::OuterRaceControl, BallInertia::InnerRaceControl, BallInertia::Shared] {
        for contact in [rotordyn_bearing::contact::ContactLaw::Hertz, film()] {
            let bearing = BallBearing {
                inertia,
                contact,
                cage: Cage::Rolling,
                preload: Preload::Force(250.0),
                ..angular()
            };
            let element = BallElement::new(&bearing);
            for speed in [0.0, 800.0, 3000.0, 6000.0] {
                let still = at_speed(speed, 0.1);
                let centred = element.reaction(&[0.0; 6], &[0.0; 6], &still);
                assert!((centred.force[2] + 250.0).abs() < 1e-9 * 250.0, "{inertia:?} {:?}", centred.force);
                assert!((element.preload_state(speed).axial_force - 250.0).abs() < 1e-9 * 250.0);
            }
        }
    }
}
