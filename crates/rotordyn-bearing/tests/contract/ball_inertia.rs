//! Ball inertia (centrifugal force, gyroscopic moment): independent force balance, contact angles, loss of
//! inner contact.

use crate::ball_bearing::Random;
use crate::ball_combinations::{angular, film};
use crate::bearing::rig_6205;
use rotordyn_bearing::contact::ContactLaw;
use rotordyn_bearing::{BallBearing, BallElement, BallInertia, BallLoad, Cage, Preload, Rotation};

const CAGE: f64 = 0.4;

const CONTROLS: [BallInertia; 6] = [
    BallInertia::OuterRaceControl,
    BallInertia::InnerRaceControl,
    BallInertia::HarrisInnerRaceControl,
    BallInertia::Shared,
    BallInertia::Centrifugal,
    BallInertia::CentrifugalForce(60.0),
];

fn at_speed(speed: f64) -> Rotation {
    Rotation { cage_angle: 0.3, cage_speed: Some(CAGE * speed), shaft_speed: speed, ..Rotation::default() }
}

/// Residual force of a ball \[N\], with Harris' attitude angle β and gyroscopic moment J ω_R ω_m sin β.
fn force_residual(bearing: &BallBearing, ball: &BallLoad, shaft: f64) -> f64 {
    let (d, pitch) = (bearing.geometry.ball_diameter, bearing.geometry.pitch_diameter);
    let mass = bearing.ball_material.density * std::f64::consts::PI / 6.0 * d.powi(3);
    let (gamma, orbit) = (d / pitch, CAGE * shaft);
    let centrifugal = match bearing.inertia {
        BallInertia::CentrifugalForce(given) => given,
        _ => 0.5 * mass * pitch * orbit * orbit,
    };
    let (ai, ao) = (ball.contact_angle, ball.outer_contact_angle);
    // Spin relative to the cage from rolling on one race, about an axis at β without pivoting on that race.
    let moment = |beta: f64, spin: f64| 0.1 * mass * d * d * spin * orbit * beta.sin();
    let outer = {
        let beta = (ao.sin() / (ao.cos() + gamma)).atan();
        moment(beta, orbit * (1.0 + gamma * ao.cos()) / (gamma * (beta - ao).cos()))
    };
    let inner = {
        let beta = (ai.sin() / (ai.cos() - gamma)).atan();
        moment(beta, (shaft - orbit) * (1.0 - gamma * ai.cos()) / (gamma * (beta - ai).cos()))
    };
    // Share of the inner race in the rolling that sets the moment, λ_i M/D and λ_o M/D its friction.
    let share = match bearing.inertia {
        BallInertia::InnerRaceControl | BallInertia::HarrisInnerRaceControl => {
            let x = (ball.load / centrifugal).min(1.0);
            x * x * (3.0 - 2.0 * x)
        }
        BallInertia::Shared => ball.load / (ball.load + ball.outer_load),
        _ => 0.0,
    };
    let moment = match bearing.inertia {
        BallInertia::Centrifugal | BallInertia::CentrifugalForce(_) => 0.0,
        _ => share * inner + (1.0 - share) * outer,
    };
    let lambda = match bearing.inertia {
        BallInertia::HarrisInnerRaceControl => [share, 2.0 - share],
        _ => [2.0 * share, 2.0 * (1.0 - share)],
    };
    let [fi, fo] = lambda.map(|lambda| lambda * moment / d);
    let radial =
        ball.load * ai.cos() - ball.outer_load * ao.cos() - fi * ai.sin() + fo * ao.sin() + centrifugal;
    let axial = ball.load * ai.sin() - ball.outer_load * ao.sin() + fi * ai.cos() - fo * ao.cos();
    radial.hypot(axial)
}

#[test]
fn ball_force_balance() {
    let mut random = Random(17);
    let (mut loaded, mut unloaded) = (0, 0);
    for inertia in CONTROLS {
        for law in [ContactLaw::Hertz, film()] {
            for base in [rig_6205(), angular()] {
                let bearing = BallBearing { inertia, contact: law.clone(), ..base };
                let element = BallElement::new(&bearing);
                for _ in 0..400 {
                    let speed = 10f64.powf(1.0 + 2.6 * (0.5 + 0.5 * random.next()));
                    let d = random.scaled([20e-6, 20e-6, 80e-6, 1e-3, 1e-3, 0.0]);
                    for ball in element.ball_loads(&d, &at_speed(speed)) {
                        let left = force_residual(&bearing, &ball, speed);
                        // Plus round-off of the angles (atan2), relative to the load.
                        let bound = 1e-9 + 1e-14 * ball.outer_load;
                        assert!(left < bound, "{inertia:?} at {speed}: residual {left} N, {ball:?}");
                        assert!(ball.outer_load > 0.0, "a ball always loads the outer race");
                        if ball.load > 0.0 { loaded += 1 } else { unloaded += 1 }
                    }
                }
            }
        }
    }
    assert!(loaded > 3000 && unloaded > 3000, "{loaded} loaded, {unloaded} unloaded");
}

#[test]
fn outer_contact_angle_falls_and_inner_rises_with_speed() {
    for inertia in &CONTROLS[..5] {
        let inertia = *inertia;
        let element = BallElement::new(&BallBearing { inertia, ..angular() });
        let mut before: Option<BallLoad> = None;
        for k in 0..60 {
            // At a fixed axial displacement.
            let ball =
                element.ball_loads(&[0.0, 0.0, 20e-6, 0.0, 0.0, 0.0], &at_speed(40.0 * f64::from(k)))[0];
            if let Some(before) = before {
                assert!(ball.outer_contact_angle < before.outer_contact_angle, "{inertia:?} at step {k}");
                assert!(ball.contact_angle > before.contact_angle, "{inertia:?} at step {k}");
                assert!(ball.outer_load > before.outer_load);
            }
            before = Some(ball);
        }
    }
}

#[test]
fn force_is_continuous_at_loss_of_inner_contact() {
    // Radial displacement of the inner ring at speed, from no inner contact to load.
    for inertia in &CONTROLS[..5] {
        let inertia = *inertia;
        let element = BallElement::new(&BallBearing { inertia, ..rig_6205() });
        let force =
            |x: f64| element.reaction(&[x, 0.0, 0.0, 0.0, 0.0, 0.0], &[0.0; 6], &at_speed(2000.0)).force[0];
        assert!(force(2e-6) == 0.0 && force(20e-6) < -100.0, "{} {}", force(2e-6), force(20e-6));
        let (mut low, mut high) = (2e-6, 20e-6);
        for _ in 0..50 {
            let middle = 0.5 * (low + high);
            if force(middle) < 0.0 { high = middle } else { low = middle }
        }
        // Hertz: 1e-12 m beyond first contact gives 1e10 (1e-12)^1.5 N.
        assert!(force(high + 1e-12).abs() < 1e-7, "{inertia:?}: {}", force(high + 1e-12));
    }
}

#[test]
fn cage_speed_ratio_of_outer_race_control() {
    // With a rolling cage the ratio is that of a ball with different inner and outer contact angles.
    let bearing = BallBearing {
        inertia: BallInertia::OuterRaceControl,
        cage: Cage::Rolling,
        preload: Preload::Interference(15e-6),
        ..angular()
    };
    let element = BallElement::new(&bearing);
    let rotation = at_speed(2000.0);
    let ball = element.ball_loads(&[0.0; 6], &rotation)[0];
    let gamma = bearing.geometry.ball_diameter / bearing.geometry.pitch_diameter;
    let expected = (1.0 - gamma * ball.contact_angle.cos())
        / (1.0 + (ball.contact_angle - ball.outer_contact_angle).cos());
    let ratio = element.cage_ratio(element.reaction(&[0.0; 6], &[0.0; 6], &rotation).mean_cos);
    assert!((ratio - expected).abs() < 1e-12, "{ratio} {expected}");
}

#[test]
fn speed_dependence_is_reported() {
    assert!(!BallElement::new(&angular()).depends_on_speed());
    for bearing in [
        BallBearing { contact: film(), ..angular() },
        BallBearing { inertia: BallInertia::Shared, ..angular() },
    ] {
        let element = BallElement::new(&bearing);
        let energy = |speed| element.reaction(&[0.0, 0.0, 20e-6, 0.0, 0.0, 0.0], &[0.0; 6], &at_speed(speed));
        assert!(element.depends_on_speed());
        assert!(energy(500.0).elastic_energy != energy(1500.0).elastic_energy);
    }
}

#[test]
fn given_centrifugal_force_is_that_of_its_speed() {
    // F_c = ½ m D_pw ω_c² given as a number: the same balls as with centrifugal force alone at that speed, and at
    // any other speed.
    let base = angular();
    let g = &base.geometry;
    let mass = base.ball_material.density * std::f64::consts::PI / 6.0 * g.ball_diameter.powi(3);
    let force = 0.5 * mass * g.pitch_diameter * (CAGE * 2000.0f64).powi(2);
    let with = |inertia| BallElement::new(&BallBearing { inertia, ..angular() });
    let (given, own) = (with(BallInertia::CentrifugalForce(force)), with(BallInertia::Centrifugal));
    let d = [3e-6, -2e-6, 15e-6, 1e-4, -1e-4, 0.0];
    let expected = own.reaction(&d, &[0.0; 6], &at_speed(2000.0));
    for speed in [0.0, 300.0, 2000.0] {
        let still = Rotation { cage_angle: 0.3, shaft_speed: speed, ..Rotation::default() };
        let found = given.reaction(&d, &[0.0; 6], &still);
        for (a, b) in found.force.iter().zip(expected.force) {
            // The moving contacts of the other have damping by the turning cage.
            let elastic = own.ball_loads(&d, &at_speed(2000.0)).iter().map(|b| b.load).sum::<f64>();
            assert!((a - b).abs() < 0.02 * elastic, "{a} {b}");
        }
        for (a, b) in given.ball_loads(&d, &still).iter().zip(own.ball_loads(&d, &at_speed(2000.0))) {
            assert!((a.load - b.load).abs() < 1e-9 * (1.0 + b.load), "{a:?} {b:?}");
            assert!((a.outer_load - b.outer_load).abs() < 1e-9 * (1.0 + b.outer_load));
        }
    }
    assert!(!given.depends_on_speed() && own.depends_on_speed());
}
