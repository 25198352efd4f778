//! Fitted order of every time integrator on the rig's nonlinear equations.

use std::f64::consts::TAU;
use std::ops::ControlFlow;

use crate::rig::variant;
use rotordyn::bearing::{Bearing, Cage};
use rotordyn::model::SpeedProfile;
use rotordyn::model::study::Integrator;
use rotordyn::study::Machine;
use rotordyn::transient::reduction::Reduction;
use rotordyn::transient::run::{End, Settings, run};

const DURATION: f64 = 0.01;

/// The rig at 900 rpm with interference (negative clearance), so that every ball stays in contact and the
/// force law is smooth, as the nominal orders require, and with a constant cage speed ratio.
fn machine() -> (Machine, Reduction) {
    let mut model =
        variant(None, &[("bearing.A.radial_clearance", "-20 um"), ("bearing.B.radial_clearance", "-20 um")]);
    for site in &mut model.bearings {
        if let Bearing::Ball(ball) = &mut site.bearing {
            ball.cage = Cage::Ratio(0.4);
        }
    }
    model.profile = SpeedProfile::Constant { speed: 94.2, duration: DURATION };
    let machine = Machine::new(model).unwrap();
    let mut study = machine.model.studies.run_up.clone().unwrap();
    study.cutoff = 400.0;
    let reduction = machine.reduce(&study).unwrap();
    (machine, reduction)
}

/// Final coordinates, started at equilibrium with an initial velocity of the first two coordinates.
fn end(reduction: &Reduction, integrator: Integrator, steps: usize) -> nalgebra::DVector<f64> {
    let system = &reduction.system;
    let mut v = &reduction.equilibrium * 0.0;
    v[0] = 0.02;
    v[1] = -0.01;
    let settings = Settings {
        integrator,
        step: DURATION / steps as f64,
        sample_rate: 1.0 / DURATION,
        duration: DURATION,
    };
    let mut last = v.clone();
    let report =
        run(system, system.initial_state(reduction.equilibrium.clone(), v).unwrap(), &settings, |sample| {
            last.copy_from(&sample.state.x);
            ControlFlow::Continue(())
        });
    assert_eq!(report.end, End::Complete);
    last
}

fn order(coarse: f64, fine: f64) -> f64 {
    (coarse / fine).log2()
}

#[test]
fn fixed_step_convergence_orders() {
    let (_machine, reduction) = machine();
    // Reference: classical Runge-Kutta at a step far finer than any below.
    let reference = end(&reduction, Integrator::RungeKutta4, 8192);
    for (integrator, expected, steps) in [
        (Integrator::Newmark, 2.0, [512, 1024, 2048, 4096]),
        (Integrator::FittedNewmark, 2.0, [512, 1024, 2048, 4096]),
        (Integrator::GeneralisedAlpha { rho_infinity: 0.8 }, 2.0, [512, 1024, 2048, 4096]),
        (Integrator::GeneralisedAlpha { rho_infinity: 0.0 }, 2.0, [512, 1024, 2048, 4096]),
        (Integrator::RungeKutta4, 4.0, [1024, 1536, 2048, 3072]),
    ] {
        let errors: Vec<f64> =
            steps.iter().map(|&n| (end(&reduction, integrator, n) - &reference).amax()).collect();
        let fitted = order(errors[1], errors[3]) / order(steps[3] as f64, steps[1] as f64);
        println!("{integrator:?}: errors {errors:?}, order {fitted:.2}");
        assert!((fitted - expected).abs() < 0.15, "{integrator:?}: order {fitted}");
    }
}

/// Every mode of an undamped linear machine at rest, started with a velocity v, keeps its frequency over a hundred periods of the
/// lowest at steps up to a third of its own period: x = v/ω θ/tan θ sin(ω t) with θ = ω h/2. Newmark's is late by (ω h)²/12 of ω t.
#[test]
fn fitted_inertias_keep_the_exact_frequencies() {
    let mut model = variant(Some("spherical"), &[("shaft.stiffness_damping", "0 s")]);
    // Its springs are zero.
    model.bushings.clear();
    model.profile = SpeedProfile::Constant { speed: 0.0, duration: 1.0 };
    model.unbalances.clear();
    let machine = Machine::new(model).unwrap();
    let study = machine.model.studies.run_up.clone().unwrap();
    let reduction = machine.reduce(&study).unwrap();
    let system = &reduction.system;
    assert_eq!(system.damping.amax(), 0.0);
    let frequencies: Vec<f64> = system.natural_frequencies.iter().copied().filter(|w| *w > 0.0).collect();
    assert!(frequencies.len() >= 6, "{frequencies:?}");
    let highest = frequencies.iter().copied().fold(0.0, f64::max);
    let duration = 100.0 * TAU / frequencies[0];
    let steps = (0.5 * duration * highest).ceil();
    let step = duration / steps;
    let mut v = &reduction.equilibrium * 0.0;
    frequencies.iter().enumerate().for_each(|(k, w)| v[k] = 1e-6 * w);
    let largest_error = |integrator| {
        let mut worst = 0.0f64;
        let settings = Settings { integrator, step, sample_rate: 1.0 / step, duration };
        let start = system.initial_state(reduction.equilibrium.clone(), v.clone()).unwrap();
        let report = run(system, start, &settings, |sample| {
            for (k, w) in frequencies.iter().enumerate() {
                let half = 0.5 * w * step;
                let expected = 1e-6 * half / half.tan() * (w * sample.state.time).sin();
                worst = worst.max((sample.state.x[k] - reduction.equilibrium[k] - expected).abs());
            }
            ControlFlow::Continue(())
        });
        assert_eq!(report.end, End::Complete);
        1e6 * worst
    };
    let [fitted, plain] = [Integrator::FittedNewmark, Integrator::Newmark].map(largest_error);
    println!("{} modes, {steps} steps: error {fitted:.1e}, of Newmark {plain:.2}", frequencies.len());
    assert!(fitted < 1e-6 && plain > 0.5, "{fitted:.1e} {plain:.1e}");
}

#[test]
fn adaptive_step_error_within_tolerance() {
    let (_machine, reduction) = machine();
    let reference = end(&reduction, Integrator::RungeKutta4, 8192);
    let size = reference.amax();
    for tolerance in [1e-6, 1e-8, 1e-10] {
        let integrator =
            Integrator::DormandPrince { relative_tolerance: tolerance, absolute_tolerance: 1e-16 };
        let error = (end(&reduction, integrator, 1000) - &reference).amax() / size;
        println!("tolerance {tolerance:.0e}: error {error:.1e}");
        // Local errors accumulate over a few hundred steps.
        assert!(error < 300.0 * tolerance, "{error} at {tolerance}");
    }
}
