//! Upadhyay, Harsha & Jain 2009: the machine of models/upadhyay_2009.toml compared with the independent
//! program of tests/data/upadhyay_2009.json and with the classes of motion in Table II.

use crate::agree;
use crate::ross::{number, read};
use rotordyn::model::study::{EquilibriumStudy, Integrator, SectionTrigger, SteadyRunSettings};
use rotordyn::model::{self, Options, SpeedProfile};
use rotordyn::signal::spectrum::{Level, Spectrum, amplitude_spectrum};
use rotordyn::signal::window::WindowKind;
use rotordyn::study::Machine;
use rotordyn::transient::reduction::{Reduction, reduce};
use rotordyn::transient::steady::run_steady;
use rotordyn::transient::stepper::{Stepper, check_divergence};
use std::ops::ControlFlow;

const SPEED: f64 = 5000.0 * std::f64::consts::PI / 30.0;
/// r/(r + R) of 5000 rpm \[Hz\].
const CAGE: f64 = 18.738 / 47.0 * 5000.0 / 60.0;
const STEP: f64 = 1e-5;

fn machine(variant: &str, set: &[(&str, &str)]) -> Machine {
    let options = Options {
        variant: Some(variant.into()),
        set: set.iter().map(|(path, value)| ((*path).into(), (*value).into())).collect(),
    };
    let text = include_str!("../../models/upadhyay_2009.toml");
    Machine::new(model::load("upadhyay_2009.toml", text, &options).unwrap().model).unwrap()
}

/// The reduced machine at its speed, for time integration from the reference's start: the centre, every ball
/// on the outer race.
fn ready(machine: &Machine) -> Reduction {
    let rest = machine.equilibrium(&EquilibriumStudy { speed: SPEED, cage_average: false }).unwrap();
    let mut reduction = reduce(&machine.model, &machine.assembly, &rest, f64::INFINITY).unwrap();
    reduction.system.curve = SpeedProfile::Constant { speed: SPEED, duration: f64::INFINITY }.curve();
    reduction
}

/// x and y of the rotor \[m\] at the steps of `record` seconds after `settle` seconds, every `thin`-th.
fn motion(
    reduction: &Reduction,
    integrator: Integrator,
    step: f64,
    [settle, record]: [f64; 2],
    thin: usize,
) -> [Vec<f64>; 2] {
    let system = &reduction.system;
    let zero = &reduction.equilibrium * 0.0;
    let mut state = system.initial_state(zero.clone(), zero).unwrap();
    let mut stepper = Stepper::new(system, integrator, step);
    let (skip, count) = ((settle / step).round() as usize, (record / step).round() as usize);
    let mut out = [Vec::new(), Vec::new()];
    for k in 1..=skip + count {
        stepper.advance(system, &mut state, step, k as f64 * step, &mut |_, _| Ok(())).unwrap();
        if k > skip && (k - skip).is_multiple_of(thin) {
            check_divergence(system, &state, &stepper).unwrap();
            out.iter_mut()
                .zip(system.channels.list())
                .for_each(|(out, channel)| out.push(channel.read(state.motion())));
        }
    }
    assert_eq!(stepper.halvings, 0, "no step had to be halved");
    out
}

/// Spectra of x and y under a Hann window, and the mean of y.
struct Lines {
    spectra: [Spectrum; 2],
    mean_y: f64,
}

impl Lines {
    /// Two seconds as in the reference: bins of 0.5 Hz, so that a line may fall between two bins.
    ///
    /// The reference settles for 2 s; the slowest motion here decays by 64 1/s (N = 7), by e⁻⁶⁴ in one.
    fn of(machine: &Machine, [settle, record]: [f64; 2]) -> Self {
        let thin = 10;
        let [x, y] = motion(&ready(machine), Integrator::Newmark, STEP, [settle, record], thin);
        let mean_y = y.iter().sum::<f64>() / y.len() as f64;
        let spectrum = |v: &[f64]| {
            let mean = v.iter().sum::<f64>() / v.len() as f64;
            let v: Vec<f64> = v.iter().map(|v| v - mean).collect();
            amplitude_spectrum(&v, 1.0 / (STEP * thin as f64), WindowKind::Hann, Level::Peak).unwrap()
        };
        Self { spectra: [spectrum(&x), spectrum(&y)], mean_y }
    }

    /// Highest bin within 1.6 Hz of a frequency, along x (0) or y (1) \[m\].
    fn at(&self, axis: usize, frequency: f64) -> f64 {
        let s = &self.spectra[axis];
        let near = s.frequencies.iter().zip(&s.values).filter(|(f, _)| (*f - frequency).abs() <= 1.6);
        near.map(|(_, v)| *v).fold(0.0, f64::max)
    }

    /// The highest line \[Hz\].
    fn main(&self, axis: usize) -> f64 {
        let s = &self.spectra[axis];
        let highest = s.frequencies.iter().zip(&s.values).max_by(|a, b| a.1.total_cmp(b.1));
        *highest.unwrap().0
    }

    /// Frequency of the highest line over the ball-pass frequency.
    fn main_of_ball_pass(&self, axis: usize, balls: usize) -> f64 {
        self.main(axis) / (balls as f64 * CAGE)
    }
}

fn row<'a>(reference: &'a serde_json::Value, id: &str) -> &'a serde_json::Value {
    reference["tight"].as_array().unwrap().iter().find(|row| row["id"] == id).unwrap()
}

fn numbers(values: &serde_json::Value) -> Vec<f64> {
    values.as_array().unwrap().iter().map(number).collect()
}

/// U01-U04.
#[test]
fn cage_and_ball_pass_frequencies_and_ball_mass() {
    let reference = read("upadhyay_2009.json");
    let machine = machine("balls_8", &[]);
    let interface = &ready(&machine).system.interfaces[0];
    let radial = &interface.element;
    let ball_mass = radial.internal().unwrap().masses()[0];
    let cage = radial.cage_ratio(1.0) * 5000.0 / 60.0;
    agree::relative("cage frequency [Hz]", cage, number(&row(&reference, "U01")["value"]), 1e-4);
    for (balls, theirs) in
        [6.0, 7.0, 8.0, 9.0, 13.0, 16.0].iter().zip(numbers(&row(&reference, "U02")["value"]))
    {
        agree::relative(
            format_args!("ball-pass frequency of {balls} balls [Hz]"),
            balls * cage,
            theirs,
            1e-4,
        );
    }
    let ball = machine.model.bearings[0].bearing.ball().unwrap();
    agree::relative(
        "ball spin frequency [Hz]",
        ball.geometry.characteristic_orders(0.0).bsf * 5000.0 / 60.0,
        number(&row(&reference, "U03")["value"]),
        1e-4,
    );
    let theirs = numbers(&row(&reference, "U04")["value"]);
    agree::relative("ball mass [kg]", ball_mass, theirs[0], 2e-3);
    let cage_speed = std::f64::consts::TAU * cage;
    let force = ball_mass * cage_speed * cage_speed * 0.5 * ball.geometry.pitch_diameter;
    agree::relative("centrifugal force of a ball [N]", force, theirs[1], 2e-3);
}

/// U05 and U06, of massless balls: by `model = "ball"`, and by this model with nearly massless balls, where
/// the line of contact of a ball off the load line runs through the race centres instead of along the radius:
/// up to d_t²/(2 χ) = 1e-9 m more deflection.
#[test]
fn statics_with_massless_balls() {
    let reference = read("upadhyay_2009.json");
    let light = [("material.steel.density", "1e-3 kg/m^3")];
    for balls in [6_usize, 8, 9, 13, 16] {
        let expected = numbers(&row(&reference, "U05")["value"][balls.to_string()]);
        for (offset, expected) in [0.0, 0.5].iter().zip(expected) {
            let angle = format!("{} deg", -90.0 + offset * 360.0 / balls as f64);
            let count = balls.to_string();
            // Sixteen of the full size would not fit; with given contact stiffness the size has no effect
            // here.
            let size = if balls == 16 { "8.5 mm" } else { "9.524 mm" };
            let place = [
                ("bearing.B.cage_angle", angle.as_str()),
                ("bearing.B.balls", count.as_str()),
                ("bearing.B.ball_diameter", size),
            ];
            let still = EquilibriumStudy { speed: 0.0, cage_average: false };
            let massless = machine("massless", &place).equilibrium(&still).unwrap();
            let down = 1e6 * massless.bearings[0].displacement[1];
            agree::absolute(format_args!("{balls} balls: deflection [um]"), down, expected, 1e-3);
            let radial = machine("balls_8", &[&place[..], &light[..]].concat()).equilibrium(&still).unwrap();
            let down = 1e6 * radial.bearings[0].displacement[1];
            agree::absolute(format_args!("{balls} balls: deflection, printed [um]"), down, expected, 2.5e-3);
            if balls == 13 {
                let name = if *offset == 0.0 { "bottom" } else { "straddle" };
                let mut expected = numbers(&row(&reference, "U06")["value"][name]);
                for found in [&massless, &radial] {
                    let mut loads: Vec<f64> = found.bearings[0].balls.iter().map(|b| b.load).collect();
                    loads.sort_by(|a, b| b.total_cmp(a));
                    expected.sort_by(|a, b| b.total_cmp(a));
                    // The same 1e-9 m on 3e6 N/m.
                    let tolerance = if std::ptr::eq(found, &massless) { 2e-3 } else { 6e-3 };
                    for (ours, theirs) in loads.iter().zip(&expected) {
                        agree::absolute(
                            format_args!("{balls} balls, {name}: load [N]"),
                            *ours,
                            *theirs,
                            tolerance,
                        );
                    }
                }
            }
        }
    }
}

/// U07-U10, and U20: half the ball-pass frequency is the highest line of x for 7, 8 and 9 perfect balls, the
/// ball-pass frequency for 11, 13 and 16. U21: 6 and 10 balls are close to bifurcations and are printed, not
/// asserted.
#[test]
fn spectral_lines_of_perfect_balls() {
    let reference = read("upadhyay_2009.json");
    for (balls, id) in
        [(7_usize, "U08"), (8, "U07"), (9, "U09"), (13, "U10"), (11, ""), (16, ""), (6, ""), (10, "")]
    {
        let lines = Lines::of(&machine(&format!("balls_{balls}"), &[]), [1.0, 2.0]);
        let pass = balls as f64 * CAGE;
        let main = lines.main_of_ball_pass(0, balls);
        println!(
            "{balls} balls: highest line of x at {main:.4} ball pass, y mean {:.4} um",
            1e6 * lines.mean_y
        );
        let class = match balls {
            7..=9 => Some(0.5),
            11 | 13 | 16 => Some(1.0),
            _ => None,
        };
        if let Some(class) = class {
            agree::relative(format_args!("{balls} balls: highest line over ball pass"), main, class, 0.01);
        }
        if id.is_empty() {
            continue;
        }
        let value = &row(&reference, id)["value"];
        let tolerance = number(&row(&reference, id)["rel_tol"]);
        let compare = |name: String, ours: f64, theirs: f64| {
            agree::relative(format_args!("{balls} balls, {name} [um]"), ours, theirs, tolerance);
        };
        compare("mean of y".into(), 1e6 * lines.mean_y, number(&value["ymean"]));
        if balls == 13 {
            compare("x at 1".into(), 1e6 * lines.at(0, pass), number(&value["x_bp"]));
            compare("y at 1".into(), 1e6 * lines.at(1, pass), number(&value["y_bp"]));
            let half = 1e6 * lines.at(0, 0.5 * pass);
            assert!(half <= number(&value["x_half_max"]), "13 balls: {half} um at half");
            continue;
        }
        for (axis, name) in ["x", "y"].iter().enumerate() {
            for (factor, theirs) in [0.5, 1.0, 1.5, 2.0].iter().zip(numbers(&value[name])) {
                compare(format!("{name} at {factor}"), 1e6 * lines.at(axis, factor * pass), theirs);
            }
        }
    }
}

/// U11: Newmark at 1e-5 s compared with Runge-Kutta at 1e-6 s. Errors of lines below a hundredth of the
/// highest are relative to that hundredth, since Newmark's error is 1e-4 of the whole motion.
///
/// Both settle for 0.25 s, in which the slowest motion decays by e⁻³⁰; lines are evaluated at their exact
/// frequencies.
#[test]
fn spectral_lines_by_newmark_and_runge_kutta() {
    for balls in [7_usize, 8, 9, 13] {
        let reduction = ready(&machine(&format!("balls_{balls}"), &[]));
        // A whole number of double ball passages.
        let record = 40.0 / (balls as f64 * CAGE);
        let lines = |integrator, step: f64, thin: usize| {
            let steps = (record / step / thin as f64).round() * thin as f64;
            let step = record / steps;
            let motions = motion(&reduction, integrator, step, [0.25, record], thin);
            motions.map(|v| {
                [0.5, 1.0, 1.5, 2.0].map(|order: f64| {
                    let turn = std::f64::consts::TAU * 40.0 * order / v.len() as f64;
                    let sum = v.iter().enumerate().fold([0.0; 2], |[c, s], (k, v)| {
                        let (sin, cos) = (turn * k as f64).sin_cos();
                        [c + v * cos, s + v * sin]
                    });
                    2.0 / v.len() as f64 * sum[0].hypot(sum[1])
                })
            })
        };
        let newmark = lines(Integrator::Newmark, STEP, 1);
        let kutta = lines(Integrator::RungeKutta4, 1e-6, 10);
        for axis in 0..2 {
            let highest = kutta[axis].iter().fold(0.0_f64, |m, v| m.max(*v));
            for (order, (ours, theirs)) in newmark[axis].iter().zip(&kutta[axis]).enumerate() {
                let off = (ours - theirs).abs() / theirs.max(0.01 * highest);
                let what = format_args!("{balls} balls, axis {axis}: line {}, two integrators", order + 1);
                agree::curve(what, off, 1.0, 2e-3);
            }
        }
    }
}

/// Rate at which a run converges to its period-2 motion \[1/s\], over ten double ball passages in the first
/// 0.2 s.
fn convergence_rate(balls: usize) -> f64 {
    let double = 2.0 / (balls as f64 * CAGE);
    let per = 860;
    let x = &motion(
        &ready(&machine(&format!("balls_{balls}"), &[])),
        Integrator::Newmark,
        double / per as f64,
        [0.0, 60.0 * double],
        per,
    )[0];
    let away = |k: usize| (x[k] - x[x.len() - 1]).abs().ln();
    (away(20) - away(10)) / (10.0 * double)
}

/// U23: neighbouring motions diverge for 6 balls (chaos) and converge for the others.
///
/// The reference gives −134 1/s for 7 balls, without the size of its perturbation. For 1e-9 m and less it is
/// −64 1/s, for 1e-8 m, which shifts the opening of contacts, −147 1/s. The run itself converges to its
/// period at −64 1/s, which is the value compared here.
#[test]
fn largest_lyapunov_exponents() {
    let seven = convergence_rate(7);
    println!("7 balls: the run converges at {seven:.1} 1/s");
    for (balls, expected) in [
        (6_usize, None),
        (7, Some(seven)),
        (8, Some(-337.0)),
        (9, Some(-232.0)),
        (13, Some(-227.0)),
        (16, Some(-250.0)),
    ] {
        let reduction = ready(&machine(&format!("balls_{balls}"), &[]));
        let zero = &reduction.equilibrium * 0.0;
        let start = reduction.system.initial_state(zero.clone(), zero).unwrap();
        let steady = SteadyRunSettings {
            speed: SPEED,
            integrator: Integrator::Newmark,
            step: STEP,
            cutoff: f64::INFINITY,
            trigger: SectionTrigger::BallPass { bearing: 0, balls },
            phase: 0.0,
            transient_periods: 150,
            // The chaotic one needs an average.
            periods: if expected.is_none() { 600 } else { 100 },
            transient_limit: 0,
        };
        let mut go = |_| ControlFlow::Continue(());
        let run = run_steady(&reduction.system, start, &steady, &[], Some(1e-9), &mut go).unwrap().unwrap();
        let found = run.log_growth.iter().sum::<f64>() / run.intervals.iter().sum::<f64>();
        println!("{balls} balls: {found:.1} 1/s for {expected:?}");
        match expected {
            None => assert!(found > 5.0, "6 balls: {found} 1/s"),
            Some(expected) => {
                agree::relative(format_args!("{balls} balls: growth rate [1/s]"), found, expected, 0.3)
            }
        }
    }
}

/// U24: classes of motion for other parameters; one second of settling and bins of 1 Hz suffice to
/// distinguish them.
#[test]
fn classes_of_motion_for_other_parameters() {
    let main = |balls: usize, set: &[(&str, &str)], axis: usize| {
        let lines = Lines::of(&machine(&format!("balls_{balls}"), set), [1.0, 1.0]);
        let main = lines.main_of_ball_pass(axis, balls);
        println!("{balls} balls with {set:?}: {main:.4} ball pass on axis {axis}");
        (main, lines)
    };
    let near = |main: f64, class: f64| agree::relative("main frequency [Hz]", main, class, 0.01);
    let down = [("load.further.force", "0, -6, 0 N")];
    near(main(6, &down, 0).0, 1.0);
    near(main(7, &down, 0).0, 2.0 / 3.0);
    let tight = [("bearing.B.radial_clearance", "10 um")];
    near(main(6, &tight, 0).0, 1.0);
    near(main(7, &tight, 0).0, 1.0);
    // Equation 8 as printed: the load lifts the rotor.
    let up = [("load.further.force", "0, 6, 0 N")];
    for balls in [6, 7, 8, 9, 13, 16] {
        let (class, lines) = main(balls, &up, 1);
        near(class, 0.5);
        assert!(lines.at(0, 0.5 * balls as f64 * CAGE) < 0.2e-6);
    }
    let undamped = [("bushing.damper.c_x", "0 N s/m"), ("bushing.damper.c_y", "1e-9 N s/m")];
    // Chaotic: the ball-pass line is the highest. Over the reference's two seconds it depends on round-off whether one of the
    // broad band about half of it is higher; that band falls with the bins of a longer record.
    let lines = Lines::of(&machine("balls_6", &undamped), [2.0, 8.0]);
    near(lines.main_of_ball_pass(0, 6), 1.0);
    // Broadband: the highest of the 1 Hz bins contains only a part of the power.
    let (_, lines) = main(9, &undamped, 0);
    let x = &lines.spectra[0];
    let power: f64 = x.values.iter().map(|v| v * v / x.noise_bandwidth_hz).sum();
    let highest = x.values.iter().fold(0.0_f64, |m, v| m.max(*v));
    println!("highest bin contains {:.3} of the power", highest * highest / power);
    assert!(highest * highest < 0.5 * power);
}

/// U25: with two balls 0.2 um larger, half the ball-pass frequency stays highest for 6 to 9 balls, but for 13
/// and 16 a multiple of the cage frequency is, not the paper's ball-pass frequency.
#[test]
fn off_size_balls() {
    for balls in [6_usize, 7, 8, 9, 13, 16] {
        let lines = Lines::of(&machine(&format!("off_size_{balls}"), &[]), [1.0, 2.0]);
        let (main, cage) = (lines.main_of_ball_pass(0, balls), lines.main(0) / CAGE);
        let size = 1e6 * lines.at(0, lines.main(0));
        println!("{balls} balls, two off size: {main:.4} ball pass, {cage:.3} of the cage, {size:.3} um");
        if balls < 10 {
            agree::relative(format_args!("{balls} balls: main line over the ball pass"), main, 0.5, 0.01);
        } else {
            agree::absolute(format_args!("{balls} balls: line over the cage frequency"), cage, 4.0, 0.02);
            assert!((0.30..0.34).contains(&size), "{balls} balls: {size} um");
        }
    }
}

/// Balls with as many waves as balls, spinning with the shaft as in the paper: its "wave passage" N_w times
/// the shaft speed appears in y; printed, not asserted, since the paper gives no amplitude.
#[test]
fn wavy_balls_run() {
    for balls in [6_usize, 8, 13] {
        let lines = Lines::of(&machine(&format!("wavy_{balls}"), &[]), [0.4, 0.5]);
        let shaft = lines.main(1) / (5000.0 / 60.0);
        println!("{balls} wavy balls: highest line of y at {shaft:.3} of the shaft's speed");
        assert!(1e6 * lines.mean_y < -10.0 && 1e6 * lines.mean_y > -14.0);
    }
}
