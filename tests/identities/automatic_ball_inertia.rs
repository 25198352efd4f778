//! Ball inertia decided by itself: on where the centrifugal force matters, at all speeds of a study or at none.

use crate::speed_dependent_bearings::spindle;
use rotordyn::analysis::bearing_stiffness::{BearingSolver, Condition};
use rotordyn::analysis::equilibrium::CageTreatment;
use rotordyn::bearing::ball_inertia::INERTIA_LIMIT;
use rotordyn::bearing::{BallBearing, BallInertia, Bearing};
use rotordyn::model::study::{BearingStudy, CampbellStudy, EquilibriumStudy, ModalStudy};
use rotordyn::study::{Machine, single_bearings};
use std::f64::consts::TAU;

fn rpm(speed: f64) -> f64 {
    speed * TAU / 60.0
}

fn machine(inertia: &str) -> Machine {
    let extra = if inertia.is_empty() { String::new() } else { format!("ball_inertia = \"{inertia}\"") };
    Machine::new(spindle(&extra)).unwrap()
}

fn frequencies(machine: &Machine, speed: f64) -> Vec<f64> {
    let found = machine.modal(&ModalStudy { speeds: vec![rpm(speed)], modes: 4 }).unwrap();
    found[0].modes.iter().map(|mode| mode.frequency_hz()).collect()
}

#[test]
fn on_at_high_speed_and_off_at_low() {
    let (auto, on, off) = (machine(""), machine("outer_race_control"), machine("none"));
    assert_eq!(frequencies(&auto, 20_000.0), frequencies(&on, 20_000.0));
    assert_eq!(frequencies(&auto, 300.0), frequencies(&off, 300.0));
    let softer = frequencies(&on, 20_000.0)[0] / frequencies(&off, 20_000.0)[0];
    assert!((softer - 1.0).abs() > 0.01, "{softer}");
    let study = |speed| EquilibriumStudy { speed: rpm(speed), cage_average: true };
    assert_eq!(
        auto.equilibrium(&study(20_000.0)).unwrap().bearings,
        on.equilibrium(&study(20_000.0)).unwrap().bearings
    );
    let used = auto.ball_inertia(&[rpm(300.0), -rpm(20_000.0)]);
    assert_eq!(used.len(), 2);
    for used in used {
        assert!(used.inertia.is_on() && used.compared.ratio() > INERTIA_LIMIT, "{used:?}");
        assert!(used.warning().is_none() && used.sentence().contains("outer_race_control (auto)"));
    }
    for used in auto.ball_inertia(&[rpm(300.0)]) {
        assert!(!used.inertia.is_on() && used.compared.ratio() < INERTIA_LIMIT, "{used:?}");
        assert!(used.warning().is_none());
    }
}

#[test]
fn never_switched_within_a_study() {
    // Speeds from well below to well above the limit: every one as with ball inertia, the slow ones included.
    let speeds = vec![0.0, rpm(900.0), rpm(20_000.0)];
    let study = CampbellStudy { speeds, modes: 4, orders: vec![1.0], speed_dependent_bearings: true };
    let at = |inertia: &str, speed: usize| -> Vec<Option<f64>> {
        let found = machine(inertia).campbell(&study).unwrap();
        found.diagram.branches.iter().map(|branch| branch.omega(speed)).collect()
    };
    for speed in [1, 2] {
        assert_eq!(at("", speed), at("outer_race_control", speed));
        assert!(at("", speed) != at("none", speed));
    }
}

#[test]
fn massless_balls_are_reported_where_inertia_matters() {
    for used in machine("none").ball_inertia(&[rpm(20_000.0)]) {
        let warning = used.warning().expect("a warning");
        let ratio = format!("{:.2} %", 100.0 * used.compared.ratio());
        assert!(
            warning.to_string().contains(&ratio) && warning.to_string().contains("20000 rpm"),
            "{warning}"
        );
    }
    assert!(machine("none").ball_inertia(&[rpm(300.0)]).iter().all(|used| used.warning().is_none()));
    assert!(machine("shared").ball_inertia(&[rpm(20_000.0)]).iter().all(|used| used.warning().is_none()));
    // A fitted power law has no separate contacts.
    let law = "contact = \"power_law\"\npower_law = { stiffness = \"1e10 N/m^1.5\", exponent = 1.5, range = \"1, 5000 N\" }";
    let fitted = Machine::new(spindle(law)).unwrap();
    for used in fitted.ball_inertia(&[rpm(20_000.0)]) {
        assert!(!used.inertia.is_on());
        assert!(used.warning().is_some_and(|w| w.to_string().contains("power law")), "{used:?}");
    }
    fitted.equilibrium(&EquilibriumStudy { speed: rpm(20_000.0), cage_average: true }).unwrap();
}

fn bearing_of(machine: &Machine) -> BallBearing {
    match &machine.model.bearings[0].bearing {
        Bearing::Ball(ball) => ball.clone(),
        _ => panic!("a ball bearing"),
    }
}

#[test]
fn single_bearing_and_its_speed_sweep() {
    let ball = bearing_of(&machine(""));
    let study = BearingStudy {
        speed: Some(rpm(15_000.0)),
        force: Some([0.0, -300.0, -300.0]),
        ..BearingStudy::default()
    };
    let run = |inertia| {
        let ball = BallBearing { inertia, ..ball.clone() };
        single_bearings(&[("a".into(), ball)], &study).unwrap().remove(0)
    };
    let (auto, on) = (run(BallInertia::Auto(None)), run(BallInertia::OuterRaceControl));
    assert_eq!(auto.point.state, on.point.state);
    assert!(auto.ball_inertia.inertia.is_on());
    // The sweep over speed has inertia at every speed.
    let sweep = |found: &rotordyn::results::BearingResult| -> Vec<[f64; 5]> {
        let of_speed = |s: &&rotordyn::results::BearingSweepResult| s.unit == "rad/s";
        let sweep = found.sweeps.iter().find(of_speed).expect("a sweep over speed");
        sweep.points.iter().map(|point| point.state.displacement).collect()
    };
    assert_eq!(sweep(&auto), sweep(&on));
    let off = run(BallInertia::None);
    assert!(off.warnings.iter().any(|w| w.to_string().contains("massless")), "{:?}", off.warnings);
    assert!(!on.warnings.iter().any(|w| w.to_string().contains("massless")));
}

/// What the limit neglects, as documented there.
#[test]
fn effect_at_the_limit() {
    let mut worst = [0.0f64; 2];
    for (angle, radial) in [(0.0, 1.0), (15.0, 0.3), (15.0, 0.0), (25.0, 0.5), (40.0, 0.0), (40.0, 0.5)] {
        let mut ball = bearing_of(&machine(""));
        ball.preload = Default::default();
        ball.geometry.contact_angle = f64::to_radians(angle);
        ball.geometry.thrust_direction = 1.0;
        let thrust = if angle > 0.0 { 800.0 } else { 0.0 };
        let solve = |inertia, speed: f64| {
            let solver = BearingSolver::new("b", &BallBearing { inertia, ..ball.clone() });
            let condition = Condition {
                load: [0.0, -800.0 * radial, thrust, 0.0, 0.0],
                prescribed: [None, None, (angle == 0.0).then_some(0.0), Some(0.0), Some(0.0)],
                speed,
                cage: CageTreatment::Averaged,
                cage_angle: 0.0,
            };
            let found = solver.solve(&condition, None).unwrap();
            let most = solver.ball_loads(&found).iter().map(|b| b.load).fold(0.0, f64::max);
            (found, most)
        };
        let (still, largest) = solve(BallInertia::None, 0.0);
        let unit = ball.centrifugal_force(1.0);
        let (spinning, _) = solve(BallInertia::OuterRaceControl, (INERTIA_LIMIT * largest / unit).sqrt());
        let size = still.displacement.iter().fold(0.0f64, |m, v| m.max(v.abs()));
        for k in 0..3 {
            worst[0] = worst[0].max((spinning.displacement[k] - still.displacement[k]).abs() / size);
            if still.condition.prescribed[k].is_none() {
                worst[1] = worst[1].max((spinning.stiffness[k][k] / still.stiffness[k][k] - 1.0).abs());
            }
        }
        println!("{angle} deg, radial {radial}: {worst:?}");
        if angle < 40.0 {
            assert!(worst[0] < 2e-3 && worst[1] < 2e-3, "{angle} deg, radial {radial}: {worst:?}");
        }
    }
    assert!(worst[0] < 0.012 && worst[1] < 0.012, "{worst:?}");
}
