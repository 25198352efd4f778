//! Loads over time on one mass: what holds beyond the points, and corners within a step.

use std::ops::ControlFlow;

use rotordyn::model::study::{Integrator, RunUpStudy};
use rotordyn::model::{Options, load};
use rotordyn::study::Machine;
use rotordyn::transient::run::End;

const STIFFNESS: f64 = 2e6;
const MASS: f64 = 4.8;
const INTEGRATORS: [Integrator; 4] = [
    Integrator::Newmark,
    Integrator::FittedNewmark,
    Integrator::RungeKutta4,
    Integrator::DormandPrince { relative_tolerance: 1e-8, absolute_tolerance: 1e-14 },
];

/// Time and displacement of a mass between springs under 100 N times a history.
fn displacement(history: &str, integrator: Integrator) -> Vec<[f64; 2]> {
    let text = format!(
        r#"
        [model]
        name = "mass"
        gravity = "0 m/s^2"
        [rotor]
        length = "0.55 m"
        outer_diameter = "40 mm"
        mass = "4.8 kg"
        centre = "0 m"
        [station]
        A = "-0.2 m"
        C = "0 m"
        B = "0.2 m"
        [bearing.A]
        model = "linear"
        station = "A"
        k_xx = "1e6 N/m"
        k_yy = "1e6 N/m"
        k_zz = "1e6 N/m"
        [bearing.B]
        model = "linear"
        station = "B"
        k_xx = "1e6 N/m"
        k_yy = "1e6 N/m"
        [speed]
        profile = "constant"
        speed = "0 rad/s"
        duration = "0.05 s"
        [load.step]
        at = "C"
        force = "100, 0, 0 N"
        {history}
        [probe.x]
        at = "C"
        direction = "x"
        [study.run_up]
        step = "20 us"
        sample_rate = "5 kHz"
        "#
    );
    let model = load("mass.toml", &text, &Options::default()).unwrap_or_else(|e| panic!("{e:?}")).model;
    let machine = Machine::new(model).unwrap();
    let study = RunUpStudy { integrator, ..machine.model.studies.run_up.clone().unwrap() };
    let reduction = machine.reduce(&study).unwrap();
    let mut found = Vec::new();
    let report = machine.run_up(&study, &reduction, |sample| {
        found.push([sample.state.time, sample.channels[0]]);
        ControlFlow::Continue(())
    });
    assert_eq!(report.end, End::Complete);
    let e = report.energy;
    assert!(e.residual().abs() < 1e-3 * e.exchanged(), "{integrator:?} {e:?}");
    found
}

fn agree(found: &[[f64; 2]], expected: impl Fn(f64) -> f64, tolerance: f64, of: Integrator) {
    let largest = found.iter().map(|[t, _]| expected(*t).abs()).fold(0.0, f64::max);
    for [t, x] in found {
        let off = (x - expected(*t)).abs() / largest;
        assert!(off < tolerance, "{of:?} at {t} s: {x} instead of {}", expected(*t));
    }
}

/// A ramp from t₁ to t₂: x = F/(k (t₂ − t₁)) (g(t − t₁) − g(t − t₂)), g(s) = s − sin ωs/ω; then the load stays.
#[test]
fn last_factor_holds() {
    let omega = f64::sqrt(STIFFNESS / MASS);
    let [from, to] = [5.013e-3, 13.017e-3];
    let g = |s: f64| if s > 0.0 { s - (omega * s).sin() / omega } else { 0.0 };
    let expected = |t: f64| 100.0 / STIFFNESS / (to - from) * (g(t - from) - g(t - to));
    for integrator in INTEGRATORS {
        let found = displacement("time = \"5.013, 13.017 ms\"\nfactor = [0, 1]", integrator);
        // Phase error of Newmark ωt (ωh)²/12 = 4.5e-4.
        agree(&found, expected, 1e-3, integrator);
    }
}

/// The first factor holds before: both are loads that set in at t = 0, x = F/k (1 − cos ωt).
#[test]
fn first_factor_holds_before_and_one_value_is_constant() {
    let omega = f64::sqrt(STIFFNESS / MASS);
    let expected = |t: f64| 100.0 / STIFFNESS * (1.0 - (omega * t).cos());
    for history in ["time = \"20, 30 ms\"\nfactor = [1, 1]", "time = \"20 ms\"\nfactor = [1]"] {
        agree(&displacement(history, Integrator::RungeKutta4), expected, 1e-6, Integrator::RungeKutta4);
    }
}

/// A triangle of 4 µs between two steps of 20 µs gives the impulse F 2 µs: x = I/(m ω) sin ω(t − t₀).
#[test]
fn pulse_within_a_step_gives_its_impulse() {
    let omega = f64::sqrt(STIFFNESS / MASS);
    let impulse = 100.0 * 2e-6;
    let at = 5.010e-3;
    let expected = |t: f64| if t > at { impulse / (MASS * omega) * (omega * (t - at)).sin() } else { 0.0 };
    for integrator in INTEGRATORS {
        let history = "time = \"5.008, 5.010, 5.012 ms\"\nfactor = [0, 1, 0]";
        agree(&displacement(history, integrator), expected, 1e-3, integrator);
    }
}
