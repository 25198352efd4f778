//! The varying-compliance machine compared with independently integrated equations (varying_compliance.py).

use std::ops::ControlFlow;

use rotordyn::model::study::{Integrator, LyapunovStudy, PoincareStudy};
use rotordyn::model::{Model, Options, load};
use rotordyn::results::PoincareResult;
use rotordyn::signal::motion_classification::Motion;
use rotordyn::study::Machine;

fn machine(rpm: &str) -> Machine {
    let options = Options { set: vec![("speed.speed".into(), format!("{rpm} rpm"))], ..Options::default() };
    let text = include_str!("../../models/varying_compliance.toml");
    let model: Model = load("varying_compliance.toml", text, &options).unwrap().model;
    Machine::new(model).unwrap()
}

fn poincare_result(machine: &Machine, change: impl Fn(&mut PoincareStudy)) -> PoincareResult {
    let mut study = machine.model.studies.poincare.clone().unwrap();
    study.planes.truncate(1);
    change(&mut study);
    machine.poincare(&study, &mut |_| ControlFlow::Continue(())).unwrap().unwrap()
}

/// Section points (x, y) of the script at a speed.
fn reference(rpm: &str) -> Vec<[f64; 2]> {
    let all: serde_json::Value = serde_json::from_str(include_str!("varying_compliance.json")).unwrap();
    serde_json::from_value(all["sections"][rpm].clone()).unwrap()
}

/// Largest distance of a reference point from the section, relative to the size of the orbit.
fn section_error(found: &PoincareResult, reference: &[[f64; 2]]) -> f64 {
    let [x, y] = &found.planes[0].section;
    let size = found.planes[0].orbit.iter().map(|v| span(v)).fold(0.0, f64::max);
    let nearest = |p: &[f64; 2]| {
        x.iter().zip(y).map(|(x, y)| (x - p[0]).abs().max((y - p[1]).abs())).fold(f64::INFINITY, f64::min)
    };
    reference.iter().map(nearest).fold(0.0, f64::max) / size
}

fn span(v: &[f64]) -> f64 {
    v.iter().copied().fold(f64::MIN, f64::max) - v.iter().copied().fold(f64::MAX, f64::min)
}

#[test]
fn sections_match_the_reference_equations() {
    for (rpm, settle, period) in [("1600", 600, 1), ("1800", 700, 1), ("3300", 1200, 2), ("3500", 1200, 2)] {
        let machine = machine(rpm);
        let points = reference(rpm);
        // The same method with the same steps: round-off and a residual transient remain.
        let exact = poincare_result(&machine, |study| {
            let passage = 60.0 / (rpm.parse::<f64>().unwrap() * 8.0 * 0.385_577);
            study.steady.integrator = Integrator::RungeKutta4;
            (study.steady.step, study.steady.transient_periods, study.steady.periods) =
                (passage / 200.0, settle, 32);
        });
        // Settings of the file: Newmark's period error (ωh)²/12 at 20 us and motions of 400 Hz is 2e-4, more near a
        // resonance.
        let plain = poincare_result(&machine, |study| {
            (study.steady.transient_periods, study.steady.periods) = (settle, 32);
        });
        let errors = [section_error(&exact, &points), section_error(&plain, &points)];
        println!(
            "{rpm} rpm: {:?}, off {:.1e} by RK4, {:.1e} by Newmark",
            exact.motion.motion, errors[0], errors[1]
        );
        assert_eq!([exact.motion.motion, plain.motion.motion], [Motion::Periodic(period); 2]);
        assert_eq!(exact.groups, period);
        assert!(errors[0] < 1e-9 && errors[1] < 1e-3, "{rpm}: {errors:?}");
    }
}

/// Chaotic motions cannot be compared point by point, only by the attractor's extent and the exponent's sign.
#[test]
fn lyapunov_exponents_of_chaos_and_period_two() {
    let machine_2300 = machine("2300");
    let found = poincare_result(&machine_2300, |study| study.steady.periods = 600);
    assert_eq!(found.motion.motion, Motion::Chaotic, "{:?}", found.motion);
    let points = reference("2300");
    for k in 0..2 {
        let expected = span(&points.iter().map(|p| p[k]).collect::<Vec<_>>());
        let extent = span(&found.planes[0].section[k]);
        println!("extent {extent:.3e}, reference {expected:.3e}");
        // The outermost of 300 points are poorly sampled.
        assert!((extent / expected - 1.0).abs() < 0.25);
    }
    let exponent = |machine: &Machine| {
        let study = LyapunovStudy { ..machine.model.studies.lyapunov.clone().unwrap() };
        machine.lyapunov(&study, &mut |_| ControlFlow::Continue(())).unwrap().unwrap().exponent
    };
    let (chaotic, periodic) = (exponent(&machine_2300), exponent(&machine("3500")));
    println!(
        "2300 rpm {:.2} ± {:.2}, 3500 rpm {:.2} ± {:.2}",
        chaotic.value, chaotic.standard_error, periodic.value, periodic.standard_error
    );
    assert!(chaotic.value > 5.0 * chaotic.standard_error);
    assert!(periodic.value < -5.0 * periodic.standard_error);
    // The four exponents add up to the trace −2 c/m = −20 1/s: the largest is a quarter of it or more.
    // Its two multipliers are a complex pair, and so are the other two, of equal size: exactly a quarter.
    assert!((periodic.value / -5.0 - 1.0).abs() < 0.01, "{}", periodic.value);
}
