//! The varying-compliance machine against its two equations integrated apart (varying_compliance.py).

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

fn seen(machine: &Machine, change: impl Fn(&mut PoincareStudy)) -> PoincareResult {
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

/// Farthest that a point of the reference is from the section, as a share of the orbit.
fn off(found: &PoincareResult, reference: &[[f64; 2]]) -> f64 {
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
fn sections_are_those_of_the_two_equations() {
    for (rpm, settle, period) in [("1600", 600, 1), ("1800", 700, 1), ("3300", 1200, 2), ("3500", 1200, 2)] {
        let machine = machine(rpm);
        let points = reference(rpm);
        // The same method with the same steps: what is left is round-off and a settling not quite done.
        let exact = seen(&machine, |study| {
            let passage = 60.0 / (rpm.parse::<f64>().unwrap() * 8.0 * 0.385_577);
            study.steady.integrator = Integrator::RungeKutta4;
            (study.steady.step, study.steady.transient_periods, study.steady.periods) =
                (passage / 200.0, settle, 32);
        });
        // As the file has it: Newmark's period error (ωh)²/12 at 20 us and motions of 400 Hz is 2e-4, more where a
        // resonance leans on it.
        let plain = seen(&machine, |study| {
            (study.steady.transient_periods, study.steady.periods) = (settle, 32);
        });
        let errors = [off(&exact, &points), off(&plain, &points)];
        println!(
            "{rpm} rpm: {:?}, off {:.1e} by RK4, {:.1e} by Newmark",
            exact.motion.motion, errors[0], errors[1]
        );
        assert_eq!([exact.motion.motion, plain.motion.motion], [Motion::Periodic(period); 2]);
        assert_eq!(exact.groups, period);
        assert!(errors[0] < 1e-9 && errors[1] < 1e-3, "{rpm}: {errors:?}");
    }
}

/// Chaos has no points to compare: the attractor's extent does, and the sign of the exponent.
#[test]
fn chaos_and_period_two_by_their_exponents() {
    let machine_2300 = machine("2300");
    let found = seen(&machine_2300, |study| study.steady.periods = 600);
    assert_eq!(found.motion.motion, Motion::Chaotic, "{:?}", found.motion);
    let points = reference("2300");
    for k in 0..2 {
        let expected = span(&points.iter().map(|p| p[k]).collect::<Vec<_>>());
        let extent = span(&found.planes[0].section[k]);
        println!("extent {extent:.3e}, reference {expected:.3e}");
        // Of 300 points the outermost are rare.
        assert!((extent / expected - 1.0).abs() < 0.25);
    }
    let exponent = |machine: &Machine| {
        let study = LyapunovStudy { ..machine.model.studies.lyapunov.clone().unwrap() };
        machine.lyapunov(&study, &mut |_| ControlFlow::Continue(())).unwrap().unwrap().exponent
    };
    let (wild, tame) = (exponent(&machine_2300), exponent(&machine("3500")));
    println!(
        "2300 rpm {:.2} ± {:.2}, 3500 rpm {:.2} ± {:.2}",
        wild.value, wild.standard_error, tame.value, tame.standard_error
    );
    assert!(wild.value > 5.0 * wild.standard_error);
    assert!(tame.value < -5.0 * tame.standard_error);
    // The four exponents add up to the trace −2 c/m = −20 1/s: the largest is a quarter of it or more.
    // Its two multipliers are a complex pair, and so are the other two, of one size: a quarter it is.
    assert!((tame.value / -5.0 - 1.0).abs() < 0.01, "{}", tame.value);
}
