//! Fitted order of every time integrator on the rig's nonlinear equations.

use std::f64::consts::{PI, TAU};
use std::ops::ControlFlow;

use crate::machine::jeffcott;
use crate::rig::variant;
use nalgebra::{DMatrix, DVector};
use rotordyn::bearing::{Bearing, Cage};
use rotordyn::element::Anchor;
use rotordyn::model::study::{Integrator, RunUpStudy};
use rotordyn::model::{Probe, Quantity, SpeedProfile, Unbalance};
use rotordyn::study::Machine;
use rotordyn::transient::energy::EnergyBalance;
use rotordyn::transient::reduction::Reduction;
use rotordyn::transient::run::{End, Settings, run};
use rotordyn::transient::stepper::Stepper;

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
fn end(reduction: &Reduction, integrator: Integrator, steps: usize) -> DVector<f64> {
    let system = &reduction.system;
    let mut v = &reduction.equilibrium * 0.0;
    v[0] = 0.02;
    v[1] = -0.01;
    let settings = Settings {
        integrator,
        step: DURATION / steps as f64,
        defect_step: f64::INFINITY,
        sample_rate: 1.0 / DURATION,
        duration: DURATION,
        energy_balance: true,
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
        let settings = Settings {
            integrator,
            step,
            defect_step: f64::INFINITY,
            sample_rate: 1.0 / step,
            duration,
            energy_balance: true,
        };
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

/// The vibration goes on in phase and amplitude where the length of the steps changes: velocities and accelerations change with the
/// fitted inertias, and the energy is kept.
#[test]
fn fitted_inertias_keep_vibrations_when_the_step_changes() {
    let mut model = variant(Some("spherical"), &[("shaft.stiffness_damping", "0 s")]);
    model.bushings.clear();
    model.profile = SpeedProfile::Constant { speed: 0.0, duration: 1.0 };
    model.unbalances.clear();
    let machine = Machine::new(model).unwrap();
    let reduction = machine.reduce(machine.model.studies.run_up.as_ref().unwrap()).unwrap();
    let system = &reduction.system;
    let frequencies: Vec<f64> = system.natural_frequencies.iter().copied().filter(|w| *w > 0.0).collect();
    let highest = frequencies.iter().copied().fold(0.0, f64::max);
    let long = 1.5 / highest;
    let mut v = &reduction.equilibrium * 0.0;
    let half = |w: f64| 0.5 * w * long;
    frequencies.iter().enumerate().for_each(|(k, w)| v[k] = 1e-6 * w * half(*w).tan() / half(*w));
    let mut state = system.initial_state(reduction.equilibrium.clone(), v).unwrap();
    let mut stepper = Stepper::new(system, Integrator::FittedNewmark, long);
    stepper.fit_inertias(system, &mut state, long);
    let mut balance = EnergyBalance::new(system, &state);
    let mut worst = 0.0f64;
    for (steps, length) in [(40, long), (31, 0.25 * long), (17, long), (60, 0.1 * long), (80, long)] {
        for _ in 0..steps {
            stepper.exact_step(system, &mut state, length).unwrap();
            balance.update(system, &state);
            for (k, w) in frequencies.iter().enumerate() {
                let exact = 1e-6 * (w * state.time).sin();
                worst = worst.max((state.x[k] - reduction.equilibrium[k] - exact).abs());
            }
        }
        balance.update_stored_energy(system, &state);
        let vibration: f64 = frequencies.iter().map(|w| 0.5e-12 * w * w).sum();
        let error = balance.energy.residual() / vibration;
        println!("{steps} steps of {length:.2e} s: energy {error:.1e}, largest error {:.1e}", 1e6 * worst);
        assert!(error.abs() < 1e-6, "{error}");
    }
    assert!(worst < 1e-6 * 1e-6, "{worst}");
}

/// Amplitudes of displacement and acceleration of a mass on a massless shaft with an unbalance, over m e Ω²/|k − m Ω² + j c Ω|
/// and Ω² times it, below, above and far above its critical speed.
///
/// A mass fitted to ω, and average acceleration, give displacements low by (Ω h)²/6 whatever ω is, and accelerations
/// right to fourth order: the theory chapter's statement.
#[test]
fn fitted_inertias_in_forced_vibration() {
    let (mass, unbalance) = (10.0, 1e-4);
    let spring: f64 = 48.0 * 2.1e11 * PI / 64.0 * 0.02f64.powi(4) / 0.8f64.powi(3);
    let natural = (spring / mass).sqrt();
    let external = 2.0 * 0.02 * mass * natural;
    for ratio in [0.5, 2.0, 5.0] {
        let speed = ratio * natural;
        let mut model = jeffcott(mass, 0.0, external);
        let a = Anchor::node(4);
        model.unbalances.push(Unbalance { name: "u".into(), node: 4, magnitude: unbalance, phase: 0.0 });
        for quantity in [Quantity::Displacement, Quantity::Acceleration] {
            let direction = [1.0, 0.0, 0.0, 0.0, 0.0, 0.0];
            model.probes.push(Probe { name: format!("{quantity:?}"), at: a, direction, quantity });
        }
        // The transient has decayed to 1e-10 when the last fifth begins.
        let duration = 23.0 / (0.02 * natural) / 0.8;
        model.profile = SpeedProfile::Constant { speed, duration };
        let machine = Machine::new(model).unwrap();
        for turn in [0.15, 0.3] {
            let step = turn / speed;
            let study = RunUpStudy {
                integrator: Integrator::FittedNewmark,
                step,
                defect_step: f64::INFINITY,
                sample_rate: 1.0 / step,
                cutoff: 100.0,
                from_equilibrium: true,
                cage_phases: 0,
                motion: None,
            };
            let reduction = machine.reduce(&study).unwrap();
            let [mut time, mut x, mut a] = [const { Vec::new() }; 3];
            let report = machine.run_up(&study, &reduction, |sample| {
                if sample.state.time > 0.8 * duration {
                    time.push(sample.state.time);
                    x.push(sample.channels[0]);
                    a.push(sample.channels[1]);
                }
                ControlFlow::Continue(())
            });
            assert_eq!(report.end, End::Complete);
            let amplitude = |values: &[f64]| {
                let rows = DMatrix::from_fn(time.len(), 2, |r, c| {
                    let angle = speed * time[r];
                    if c == 0 { angle.cos() } else { angle.sin() }
                });
                rows.svd(true, true).solve(&DVector::from_column_slice(values), 0.0).unwrap().norm()
            };
            let dynamic = (spring - mass * speed * speed).hypot(external * speed);
            let expected = unbalance * speed * speed / dynamic;
            let low = 1.0 - amplitude(&x) / expected;
            let off = amplitude(&a) / (speed * speed * expected) - 1.0;
            let predicted = turn * turn / 6.0;
            println!("Ω/ω {ratio}, Ω h {turn}: displacement low by {low:.3e}, acceleration off by {off:.1e}");
            // Of fourth order, (Ω h)⁴ and (ω h)⁴, with the damping's part.
            let fourth = (turn * ratio.recip().max(1.0)).powi(4);
            assert!((low - predicted).abs() < 0.05 * predicted + 0.1 * fourth, "{low} {predicted}");
            assert!(off.abs() < 0.1 * fourth + 2e-5, "{off}");
        }
    }
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
