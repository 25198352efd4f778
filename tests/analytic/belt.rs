//! Belt on a rigid shaft with two spring bearings: static equilibrium, transient from equilibrium, step load,
//! damping.

use crate::agree;
use rotordyn::analysis::modal;
use rotordyn::model::study::{CriticalStudy, EquilibriumStudy};
use rotordyn::model::{Options, load};
use rotordyn::study::Machine;
use rotordyn::transient::run::End;
use std::ops::ControlFlow;

/// Cylinder on springs of 1e6 N/m at A and 2e6 N/m at B, with an overhung pulley beyond B.
const ROTOR: &str = r#"
[model]
name = "belt"
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
pulley = "0.26 m"
[bearing.A]
model = "linear"
station = "A"
k_xx = "1e6 N/m"
k_yy = "1e6 N/m"
k_zz = "1e6 N/m"
c_xx = "400 N s/m"
c_yy = "400 N s/m"
[bearing.B]
model = "linear"
station = "B"
k_xx = "2e6 N/m"
k_yy = "2e6 N/m"
c_xx = "700 N s/m"
c_yy = "700 N s/m"
[belt.drive]
station = "pulley"
pull = "300, -120 N"
constant_pull = CONSTANT
k_x = "4e5 N/m"
k_y = "5e4 N/m"
[drive]
kind = "prescribed"
station = "A"
[speed]
profile = "constant"
speed = "0 rad/s"
duration = "0.5 s"
[probe.x]
at = "pulley"
direction = "x"
[probe.y]
at = "pulley"
direction = "y"
[study.run_up]
step = "50 us"
sample_rate = "1 kHz"
cutoff = "1e6 Hz"
"#;

const PULL: [f64; 2] = [300.0, -120.0];
const STIFFNESS: [f64; 2] = [4e5, 5e4];

fn machine(constant: bool, more: &str) -> Machine {
    let text = ROTOR.replace("CONSTANT", if constant { "true" } else { "false" }) + more;
    Machine::new(load("belt.toml", &text, &Options::default()).unwrap_or_else(|e| panic!("{e:?}")).model)
        .unwrap()
}

/// Compliance of the pulley: 1 N there loads B with 0.46/0.4 N and A with −0.06/0.4 N (lever rule), and each
/// end moves by its load divided by its stiffness.
fn compliance() -> f64 {
    let (on_a, on_b) = (-0.06 / 0.4, 0.46 / 0.4);
    let (at_a, at_b) = (on_a / 1e6, on_b / 2e6);
    at_a + (at_b - at_a) * 0.46 / 0.4
}

/// Static displacement of the pulley under a constant belt pull, or under one that falls by k u with the
/// displacement.
fn static_displacement(constant: bool, axis: usize) -> f64 {
    let s = compliance();
    if constant { s * PULL[axis] } else { s * PULL[axis] / (1.0 + s * STIFFNESS[axis]) }
}

#[test]
fn static_equilibrium_under_belt_pull() {
    for constant in [true, false] {
        let machine = machine(constant, "");
        let found = machine.equilibrium(&EquilibriumStudy { speed: 0.0, cage_average: true }).unwrap();
        for axis in 0..2 {
            let probe = &machine.model.probes[axis];
            let computed = machine.assembly.direction_row(&probe.at, &probe.direction).dot(&found.q);
            let expected = static_displacement(constant, axis);
            // Equilibrium residual: 1e-10 of the pull.
            agree::relative(
                format_args!("static displacement, constant pull {constant}, axis {axis} [m]"),
                computed,
                expected,
                1e-8,
            );
            // The bearing forces balance the remaining belt pull.
            let remaining_pull = if constant { PULL[axis] } else { PULL[axis] - STIFFNESS[axis] * expected };
            let force: f64 = found.bearings.iter().map(|b| b.force[axis]).sum();
            let what = format_args!("bearing forces, constant pull {constant}, axis {axis} [N]");
            agree::absolute(what, force, -remaining_pull, 1e-6);
        }
    }
}

/// Last sample of a run from equilibrium, and the largest deviation from the first sample.
fn run(machine: &Machine) -> ([f64; 2], f64) {
    let study = machine.model.studies.run_up.clone().unwrap();
    let reduction = machine.reduce(&study).unwrap();
    let (mut first, mut last, mut deviation) = (None, [0.0; 2], 0.0_f64);
    let report = machine.run_up(&study, &reduction, |sample| {
        last = [sample.channels[0], sample.channels[1]];
        let [x, y] = *first.get_or_insert(last);
        deviation = deviation.max((last[0] - x).abs()).max((last[1] - y).abs());
        ControlFlow::Continue(())
    });
    assert_eq!(report.end, End::Complete);
    (last, deviation)
}

#[test]
fn transient_from_equilibrium_stays_at_equilibrium() {
    for constant in [true, false] {
        let (last, deviation) = run(&machine(constant, ""));
        for (axis, end) in last.into_iter().enumerate() {
            agree::relative(
                format_args!("end of the run, constant pull {constant}, axis {axis} [m]"),
                end,
                static_displacement(constant, axis),
                1e-8,
            );
        }
        // Deflection 200 um; accuracy of the equilibrium 1e-10 of it.
        agree::absolute(
            format_args!("drift from equilibrium, constant pull {constant} [m]"),
            deviation,
            0.0,
            1e-13,
        );
    }
}

/// The belt stiffness acts on an additional force ΔF in both cases: Δu = s ΔF/(1 + s k).
#[test]
fn step_load_with_belt_stiffness() {
    let step = "[load.more]\nat = \"pulley\"\nforce = \"50, 80, 0 N\"\ntime = \"0, 10 s\"\nfactor = [1, 1]\n";
    for constant in [true, false] {
        let (last, _) = run(&machine(constant, step));
        for (axis, more) in [50.0, 80.0].into_iter().enumerate() {
            let s = compliance();
            let expected = static_displacement(constant, axis) + s * more / (1.0 + s * STIFFNESS[axis]);
            // The slowest mode, 590 rad/s with a decay rate of 80 1/s, has decayed to e⁻⁴⁰ of the step.
            agree::relative(
                format_args!("after a step load, constant pull {constant}, axis {axis} [m]"),
                last[axis],
                expected,
                1e-8,
            );
        }
    }
}

/// One mass on springs, damped by the belt only: ζ = c/(2 √(k m)), logarithmic decrement δ = 2πζ/√(1 − ζ²),
/// computed here as δ = −σ T from the eigenvalue λ = σ ± j 2π/T of λ² m + λ c + k = 0.
#[test]
fn damping_ratio_and_log_decrement_of_belt_damping() {
    for damping in [60.0, 2500.0] {
        let text = ROTOR
            .replace("CONSTANT", "false")
            .replace("c_xx = \"400 N s/m\"\n", "")
            .replace("c_yy = \"400 N s/m\"\n", "")
            .replace("c_xx = \"700 N s/m\"\n", "")
            .replace("c_yy = \"700 N s/m\"\n", "")
            .replace("2e6 N/m", "1e6 N/m")
            .replace("pulley = \"0.26 m\"", "pulley = \"0 m\"")
            .replace("C = \"0 m\"\n", "")
            .replace("k_y = \"5e4 N/m\"", &format!("k_y = \"5e4 N/m\"\nc_x = \"{damping} N s/m\""));
        let model = load("belt.toml", &text, &Options::default()).unwrap_or_else(|e| panic!("{e:?}")).model;
        let machine = Machine::new(model).unwrap();
        let modes = modal::modes(&machine.assembly, &machine.linear_system(0.0).unwrap(), 5).unwrap();
        let (mass, stiffness): (f64, f64) = (4.8, 2.4e6);
        let zeta = damping / (2.0 * (stiffness * mass).sqrt());
        let (sigma, omega) =
            (-damping / (2.0 * mass), (stiffness / mass - (damping / (2.0 * mass)).powi(2)).sqrt());
        let damped: Vec<_> = modes.iter().filter(|m| m.zeta() > 1e-6).collect();
        assert_eq!(damped.len(), 1, "only the mode along x is damped by the belt");
        let mode = damped[0];
        agree::relative(format_args!("damping ratio with {damping} N s/m"), mode.zeta(), zeta, 1e-9);
        agree::relative(format_args!("frequency with {damping} N s/m [rad/s]"), mode.omega(), omega, 1e-9);
        let decrement = -sigma * std::f64::consts::TAU / omega;
        let what = format_args!("logarithmic decrement with {damping} N s/m");
        agree::relative(what, mode.log_dec(), decrement, 1e-9);

        // Without gyroscopic effect the order line n Ω crosses the damped frequency of the mode along x at
        // ω/n.
        for order in [0.5, 1.0, 2.0, 3.0] {
            let found = machine.critical(&CriticalStudy { max_speed: 2000.0, orders: vec![order] }).unwrap();
            let damped_speeds: Vec<f64> =
                found.crossings.list.iter().filter(|c| c.mode.zeta() > 1e-6).map(|c| c.speed).collect();
            assert_eq!(damped_speeds.len(), 1, "{order}: {damped_speeds:?} {}", omega / order);
            let what = format_args!("critical speed of order {order} with {damping} N s/m [rad/s]");
            agree::relative(what, damped_speeds[0], omega / order, 1e-9);
        }
    }
}
