//! Steady motions compared with linear theory and Floquet multipliers.

use std::f64::consts::TAU;
use std::ops::ControlFlow;

use crate::rig::variant;
use nalgebra::DMatrix;
use rotordyn::bearing::{Bearing, Cage};
use rotordyn::linalg::Complex64;
use rotordyn::model::study::{
    Integrator, LyapunovStudy, ModalStudy, Plane, PoincareStudy, SectionTrigger, SteadyRunSettings,
    UnbalanceStudy,
};
use rotordyn::model::{Model, Options, Probe, Quantity, load};
use rotordyn::signal::motion_classification::Motion;
use rotordyn::study::Machine;
use rotordyn::transient::steady::run_steady;

const RPM: f64 = std::f64::consts::PI / 30.0;
pub const EVERY_INTEGRATOR: [Integrator; 4] = [
    Integrator::Newmark,
    Integrator::GeneralisedAlpha { rho_infinity: 0.8 },
    Integrator::RungeKutta4,
    Integrator::DormandPrince { relative_tolerance: 1e-8, absolute_tolerance: 1e-14 },
];

fn jeffcott(set: &[(&str, &str)]) -> Model {
    let set = set.iter().map(|(path, value)| ((*path).into(), (*value).into())).collect();
    let options = Options { set, ..Options::default() };
    load("jeffcott.toml", include_str!("../../models/jeffcott.toml"), &options).unwrap().model
}

pub fn steady(
    speed: f64,
    clock: SectionTrigger,
    step: f64,
    [settle, periods]: [usize; 2],
) -> SteadyRunSettings {
    let integrator = Integrator::Newmark;
    SteadyRunSettings {
        speed,
        integrator,
        step,
        cutoff: 400.0,
        trigger: clock,
        phase: 0.0,
        transient_periods: settle,
        periods,
        transient_limit: 0,
    }
}

fn go(_: f64) -> ControlFlow<()> {
    ControlFlow::Continue(())
}

fn plane(model: &Model, x: &str, y: &str) -> Plane {
    let probe = |name: &str| model.probes.iter().find(|p| p.name == name).expect("a probe").clone();
    Plane { name: "plane".into(), x: probe(x), y: probe(y) }
}

/// Lyapunov exponent of a linear rotor: the decay rate of its least damped mode, λ = −ζω.
#[test]
fn lyapunov_exponent_of_a_linear_rotor_is_its_decay_rate() {
    let speed = 2400.0 * RPM;
    let machine = Machine::new(jeffcott(&[("damping.modal.ratio", "0.02")])).unwrap();
    let modes = machine.modal(&ModalStudy { speeds: vec![speed], modes: 12 }).unwrap();
    let decay = modes[0].modes.iter().map(|m| m.eigenvalue.re).fold(f64::NEG_INFINITY, f64::max);
    for integrator in EVERY_INTEGRATOR {
        // Explicit methods must resolve the highest mode, the shaft's ends on their bearings.
        let explicit = matches!(integrator, Integrator::RungeKutta4 | Integrator::DormandPrince { .. });
        let step = if explicit { 1.5e-5 } else { 1e-4 };
        let mut steady = steady(speed, SectionTrigger::Shaft, step, [160, 160]);
        steady.cutoff = 150.0;
        steady.integrator = integrator;
        let study = LyapunovStudy { steady, perturbation: 1e-9 };
        let found = machine.lyapunov(&study, &mut go).unwrap().unwrap();
        let e = &found.exponent;
        println!("{integrator:?}: {:.5} ± {:.5}, linear {decay:.5}", e.value, e.standard_error);
        // Second-order steps of 1e-4 s reduce the decay by (ωh)²/4, 1e-4 at 160 rad/s.
        assert!((e.value / decay - 1.0).abs() < 2e-3, "{}, linear {decay}", e.value);
        assert!(e.standard_error < 0.02 * decay.abs());
        assert!((found.clock.frequency / 40.0 - 1.0).abs() < 1e-9);
        assert_eq!(e.history.len(), 160);
    }
}

/// The rotation of a shaft that no station drives is free: no instability, though its perturbed angle grows without end.
#[test]
fn free_rotation_has_no_part_in_the_lyapunov_exponent() {
    let speed = 2400.0 * RPM;
    let mut model = jeffcott(&[("damping.modal.ratio", "0.02")]);
    model.drive = rotordyn::model::Drive::Prescribed { node: None };
    let machine = Machine::new(model).unwrap();
    let modes = machine.modal(&ModalStudy { speeds: vec![speed], modes: 12 }).unwrap();
    let decay =
        modes[0].modes.iter().map(|m| m.eigenvalue.re).filter(|re| *re < -1e-6).fold(f64::MIN, f64::max);
    let mut steady = steady(speed, SectionTrigger::Shaft, 1e-4, [160, 160]);
    steady.cutoff = 150.0;
    let study = LyapunovStudy { steady, perturbation: 1e-9 };
    let exponent = machine.lyapunov(&study, &mut go).unwrap().unwrap().exponent;
    println!("{:.5} ± {:.5}, linear {decay:.5}", exponent.value, exponent.standard_error);
    assert!((exponent.value / decay - 1.0).abs() < 2e-3, "{}, linear {decay}", exponent.value);
}

/// The Poincaré section of a linear rotor is one point: static sag plus unbalance response at that shaft angle.
#[test]
fn section_of_a_linear_rotor_is_its_unbalance_response() {
    let speed = 2000.0 * RPM;
    let machine = Machine::new(jeffcott(&[("damping.modal.ratio", "0.05")])).unwrap();
    let plane = plane(&machine.model, "disc_x", "disc_y");
    let responses = vec![plane.x.clone(), plane.y.clone()];
    let linear = machine
        .unbalance(&UnbalanceStudy { speeds: vec![speed], refine: false, responses, operating_speeds: None })
        .unwrap();
    let rest = machine
        .equilibrium(&rotordyn::model::study::EquilibriumStudy { speed, cage_average: false })
        .unwrap();
    for phase in [0.0, 1.3] {
        let mut steady = steady(speed, SectionTrigger::Shaft, 5e-5, [150, 40]);
        steady.cutoff = f64::INFINITY;
        steady.phase = phase;
        let study = PoincareStudy { steady, planes: vec![plane.clone()], tolerance: 1e-5, longest_period: 8 };
        let found = machine.poincare(&study, &mut go).unwrap().unwrap();
        println!("{:?}", found.motion);
        assert_eq!(found.motion.motion, Motion::Periodic(1));
        assert_eq!(found.groups, 1);
        let result = &found.planes[0];
        assert_eq!(result.section[0].len(), 40);
        for (k, probe) in [&plane.x, &plane.y].into_iter().enumerate() {
            let [re, im] = linear.channels[k].amplitude[0];
            let amplitude = Complex64::new(re, im);
            let sag = machine.assembly.direction_row(&probe.at, &probe.direction).dot(&rest.q);
            let expected = sag + (amplitude * Complex64::from_polar(1.0, phase)).re;
            let worst = result.section[k].iter().map(|v| (v - expected).abs()).fold(0.0, f64::max);
            println!("{}: {expected:.6e} m, off by {worst:.1e}", probe.name);
            // (ωh)²/12 of Newmark's period error near resonance, 1e-5 of the amplitude times the magnification.
            assert!(worst < 2e-4 * amplitude.norm(), "{worst} of {}", amplitude.norm());
        }
        // The orbit has the size of the unbalance response.
        let size = result.orbit[0].iter().copied().fold(f64::MIN, f64::max)
            - result.orbit[0].iter().copied().fold(f64::MAX, f64::min);
        let [re, im] = linear.channels[0].amplitude[0];
        assert!((size / (2.0 * re.hypot(im)) - 1.0).abs() < 1e-3);
    }
}

/// The rig on preloaded bearings with a given cage speed ratio: its ball passages are exactly periodic.
fn preloaded() -> Machine {
    let clearance = |b: &str| format!("bearing.{b}.radial_clearance");
    let set = [(clearance("A"), "-12 um"), (clearance("B"), "-12 um")];
    let set: Vec<(&str, &str)> = set.iter().map(|(path, value)| (path.as_str(), *value)).collect();
    let mut model = variant(None, &set);
    model.unbalances.clear();
    // Ten times the damping of the disc: transients decay within seconds.
    for bushing in &mut model.bushings {
        bushing.damping.iter_mut().flatten().for_each(|c| *c *= 10.0);
    }
    for site in &mut model.bearings {
        if let Bearing::Ball(ball) = &mut site.bearing {
            ball.cage = Cage::Ratio(0.4);
        }
    }
    Machine::new(model).unwrap()
}

/// The Lyapunov exponent of a periodic motion is ln |ρ| / T of its largest Floquet multiplier ρ, here from a monodromy
/// matrix by finite differences, column by column.
#[test]
fn lyapunov_exponent_of_a_periodic_motion_is_its_floquet_exponent() {
    let machine = preloaded();
    let Bearing::Ball(ball) = &machine.model.bearings[0].bearing else { panic!("a ball bearing") };
    let clock = SectionTrigger::BallPass { bearing: 0, balls: ball.geometry.balls };
    let mut settings = steady(1200.0 * RPM, clock, 5e-5, [360, 12]);
    settings.cutoff = 100.0;
    let plane = plane(&machine.model, "disc_x", "disc_y");
    let poincare =
        PoincareStudy { steady: settings.clone(), planes: vec![plane], tolerance: 1e-3, longest_period: 4 };
    let section = machine.poincare(&poincare, &mut go).unwrap().unwrap();
    println!("{:?} at {:.3} Hz", section.motion, section.clock.frequency);
    assert_eq!(section.motion.motion, Motion::Periodic(1));
    assert!((section.clock.frequency / (20.0 * 0.4 * ball.geometry.balls as f64) - 1.0).abs() < 1e-6);

    // The settled state, then one period from it and from perturbed states.
    let (reduction, start) = machine.steady_initial_state(&settings, None).unwrap();
    let mut on = |_: usize| ControlFlow::Continue(());
    let run = |state, [settle, periods]: [usize; 2], on: &mut dyn FnMut(usize) -> ControlFlow<()>| {
        let settings = SteadyRunSettings { transient_periods: settle, periods, ..settings.clone() };
        run_steady(&reduction.system, state, &settings, &[], None, on).unwrap().unwrap()
    };
    let settled = run(start, [360, 1], &mut on).state;
    let n = reduction.system.size();
    let once = |x: &nalgebra::DVector<f64>, v: &nalgebra::DVector<f64>| {
        // The period is a whole number of steps, so that the map has a fixed time.
        let cages: Vec<f64> = settled.rotations.iter().map(|r| r.cage_angle).collect();
        let mut state = reduction.system.state_at(settled.time, &cages, &[], [x.clone(), v.clone()]).unwrap();
        let mut stepper =
            rotordyn::transient::stepper::Stepper::new(&reduction.system, settings.integrator, 0.0);
        let period = TAU / (settings.speed * 0.4 * ball.geometry.balls as f64);
        let steps = (period / settings.step).ceil() as usize;
        let step = period / steps as f64;
        for k in 1..=steps {
            let end = settled.time + k as f64 * step;
            stepper.advance(&reduction.system, &mut state, step, end, &mut |_, _| Ok(())).unwrap();
        }
        (state.x, state.v)
    };
    let at = once(&settled.x, &settled.v);
    let mut monodromy = DMatrix::zeros(2 * n, 2 * n);
    for c in 0..2 * n {
        let (mut x, mut v) = (settled.x.clone(), settled.v.clone());
        // Displacements of 1e-10 and velocities of 1e-7 in mass-normalised coordinates, scaled to one.
        let (dx, dv) = (1e-10, 1e-7);
        if c < n {
            x[c] += dx
        } else {
            v[c - n] += dv
        }
        let (x, v) = once(&x, &v);
        let size = if c < n { dx } else { dv };
        for r in 0..n {
            monodromy[(r, c)] = (x[r] - at.0[r]) / size;
            monodromy[(n + r, c)] = (v[r] - at.1[r]) / size;
        }
    }
    let largest = monodromy.complex_eigenvalues().iter().map(|e| e.norm()).fold(0.0, f64::max);
    let floquet = largest.ln() * section.clock.frequency;
    settings.periods = 400;
    let study = LyapunovStudy { steady: settings, perturbation: 1e-9 };
    let found = machine.lyapunov(&study, &mut go).unwrap().unwrap().exponent;
    println!("{:.4} ± {:.4}, Floquet {floquet:.4}", found.value, found.standard_error);
    assert!(floquet < 0.0);
    assert!((found.value / floquet - 1.0).abs() < 0.01, "{}, Floquet {floquet}", found.value);
}

/// The rig with clearances at low load: a smoke test with basic physical checks.
#[test]
fn rig_with_clearance() {
    let machine = Machine::new(variant(Some("clearance_33um"), &[])).unwrap();
    let probe = |name: &str, node: usize, axis: usize| {
        let mut direction = [0.0; 6];
        direction[axis] = 1.0;
        Probe {
            name: name.into(),
            at: rotordyn::element::Anchor::node(node),
            direction,
            quantity: Quantity::Displacement,
        }
    };
    let at_b = machine.model.bearings[1].node;
    let plane = Plane { name: "B".into(), x: probe("x", at_b, 0), y: probe("y", at_b, 1) };
    let steady = steady(900.0 * RPM, SectionTrigger::Cage { bearing: 1 }, 5e-5, [40, 40]);
    let study = PoincareStudy { steady, planes: vec![plane], tolerance: 1e-3, longest_period: 8 };
    let found = machine.poincare(&study, &mut go).unwrap().unwrap();
    println!("{:?}, {} groups, {:.4} Hz", found.motion, found.groups, found.clock.frequency);
    // FTF of a 6205: 0.397 of the shaft speed, and slightly more at any contact angle above zero.
    assert!((found.clock.frequency / (15.0 * 0.3969) - 1.0).abs() < 2e-3, "{}", found.clock.frequency);
    // 2.52 shaft revolutions per cage revolution, and the load has both periods: not periodic.
    assert!(!matches!(found.motion.motion, Motion::Periodic(_)), "{:?}", found.motion);
    let result = &found.planes[0];
    for (orbit, section) in result.orbit.iter().zip(&result.section) {
        let range = |v: &[f64]| v.iter().fold([f64::MAX, f64::MIN], |[l, h], v| [v.min(l), v.max(h)]);
        let (o, s) = (range(orbit), range(section));
        println!("orbit {o:?}, section {s:?}");
        assert!(s[0] >= o[0] - 1e-9 && s[1] <= o[1] + 1e-9);
        // There is motion, limited by the clearance.
        assert!(o[1] - o[0] > 1e-8 && o[1] - o[0] < 40e-6);
    }
    // Stops when the callback breaks.
    let mut calls = 0;
    let stopped = machine.poincare(&study, &mut |_| {
        calls += 1;
        if calls == 3 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    });
    assert!(stopped.unwrap().is_none());
}

fn poincare_after(
    machine: &Machine,
    speed: f64,
    change: impl Fn(&mut PoincareStudy),
) -> rotordyn::results::PoincareResult {
    let mut study = machine.model.studies.poincare.clone().expect("a study");
    study.steady.speed = speed;
    change(&mut study);
    machine.poincare(&study, &mut go).unwrap().unwrap()
}

/// A lightly damped linear rotor whose unbalance acts from t = 0: its free vibration decays as e^(−ζωt) towards one
/// point, slowly. A short run is not settled, and its decay per revolution is e^(−ζωT); a run that may go on ends
/// at period 1.
#[test]
fn lightly_damped_rotor_settles_slowly_to_period_one() {
    let speed = 2000.0 * RPM;
    for ratio in ["0.0005", "0.002"] {
        let machine = Machine::new(jeffcott(&[("damping.modal.ratio", ratio)])).unwrap();
        let modes = machine.modal(&ModalStudy { speeds: vec![speed], modes: 12 }).unwrap();
        let slowest = modes[0].modes.iter().map(|m| m.eigenvalue.re).fold(f64::NEG_INFINITY, f64::max);
        let per_revolution = slowest * TAU / speed;
        let mut steady = steady(speed, SectionTrigger::Shaft, 2e-4, [60, 100]);
        steady.cutoff = 150.0;
        let planes = vec![plane(&machine.model, "disc_x", "disc_y")];
        let mut study = PoincareStudy { steady, planes, tolerance: 1e-3, longest_period: 32 };
        let short = machine.poincare(&study, &mut go).unwrap().unwrap();
        println!("{ratio}: {:?}, decay {per_revolution:.5} per revolution", short.motion);
        assert!(!short.motion.motion.is_settled(), "{:?}", short.motion.motion);
        assert_eq!(short.transient_periods, 60);
        study.steady.transient_limit = 20_000;
        let long = machine.poincare(&study, &mut go).unwrap().unwrap();
        println!("{ratio}: {:?} after {}", long.motion, long.transient_periods);
        assert_eq!(long.motion.motion, Motion::Periodic(1));
        // From the size of the orbit to the tolerance, ln(1000) time constants.
        let needed = 1e3_f64.ln() / per_revolution.abs();
        let factor = long.transient_periods as f64 / needed;
        assert!((0.5..2.0).contains(&factor), "{} periods, {needed:.0} expected", long.transient_periods);
        let rate = long.motion.decay_factor.ln() / per_revolution;
        assert!((rate - 1.0).abs() < 0.1, "{rate} of the decay rate");
    }
}

/// The varying-compliance machine above its resonances moves with period 1: its orbit decays by e^(−cT/2m) per ball
/// passage, the sum of its Floquet exponents being −2c/m for two pairs. After 300 passages this is not yet visible.
#[test]
fn varying_compliance_is_not_called_periodic_while_it_decays() {
    let text = include_str!("../../models/varying_compliance.toml");
    let machine = Machine::new(load("model.toml", text, &Options::default()).unwrap().model).unwrap();
    for rpm in [4800.0, 5000.0, 5100.0, 5600.0] {
        let short = poincare_after(&machine, rpm * RPM, |study| {
            study.steady.transient_periods = 300;
            study.steady.periods = 100;
            study.steady.transient_limit = 0;
        });
        let exponent = short.motion.decay_factor.ln() * short.clock.frequency;
        println!("{rpm}: {:?}, exponent {exponent:.2} 1/s", short.motion);
        assert!(!short.motion.motion.is_settled(), "{rpm} rpm: {:?}", short.motion.motion);
        if rpm > 5500.0 {
            // Not settled, without a decay that could be extrapolated.
            continue;
        }
        // c/2m = 5 1/s; the largest changes of a few points beat between the two directions.
        assert!((exponent / -5.0 - 1.0).abs() < 0.15, "{rpm} rpm: {exponent} 1/s");
        let long = poincare_after(&machine, rpm * RPM, |study| {
            study.steady.transient_periods = 300;
            study.steady.periods = 100;
        });
        println!("    {:?} after {}", long.motion, long.transient_periods);
        let very_long = poincare_after(&machine, rpm * RPM, |study| study.steady.transient_periods = 1500);
        assert_eq!(long.motion.motion, very_long.motion.motion, "{rpm} rpm");
        assert!((400..3000).contains(&long.transient_periods), "{}", long.transient_periods);
    }
}

/// Balls with their own degrees of freedom and little damping: the motion agrees with that after a much
/// longer run, or is not settled.
#[test]
fn radial_balls_are_not_called_periodic_while_they_decay() {
    let text = include_str!("../../models/upadhyay_2009.toml");
    let mut was_open = 0;
    for (variant, damping) in
        [("balls_13", "1e-6 s"), ("balls_13", "5e-6 s"), ("balls_16", "5e-6 s"), ("balls_8", "5e-6 s")]
    {
        let mut set =
            ["x", "y"].map(|axis| (format!("bushing.damper.c_{axis}"), "50 N s/m".to_string())).to_vec();
        set.push(("bearing.B.stiffness_damping".into(), damping.into()));
        let options = Options { set, variant: Some(variant.into()) };
        let machine = Machine::new(load("model.toml", text, &options).unwrap().model).unwrap();
        let speed = machine.model.studies.poincare.as_ref().unwrap().steady.speed;
        let at = |transient: usize, limit: usize| {
            poincare_after(&machine, speed, |study| {
                study.steady.transient_periods = transient;
                study.steady.periods = 60;
                study.steady.transient_limit = limit;
            })
            .motion
        };
        let truth = at(1500, 0);
        println!("{variant}, {damping}: {truth:?}");
        assert!(truth.motion.is_settled(), "{truth:?}");
        for transient in [20, 60, 150] {
            let (short, long) = (at(transient, 0), at(transient, 3000));
            println!("    after {transient}: {:?}, {:?}", short.motion, long.motion);
            assert!(!short.motion.is_settled() || short.motion == truth.motion);
            assert_eq!(long.motion, truth.motion);
            was_open += usize::from(!short.motion.is_settled());
        }
    }
    assert!(was_open >= 3, "{was_open}");
}
