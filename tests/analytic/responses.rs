//! Closed-form responses of one mass: FRF, step response, self-excited whirl (internal damping); axes of
//! elliptic orbits.

use crate::agree;
use crate::machine::jeffcott;
use nalgebra::Complex;
use rotordyn::analysis::frf::frf;
use rotordyn::analysis::unbalance::Orbit;
use rotordyn::contact::Lubricant;
use rotordyn::element::Anchor;
use rotordyn::model::study::{Integrator, RunUpStudy};
use rotordyn::model::{Load, LoadFactor, Options, Probe, Quantity, SpeedProfile, load};
use rotordyn::study::Machine;
use rotordyn::transient::run::End;
use std::f64::consts::{PI, TAU};
use std::ops::ControlFlow;

type C = Complex<f64>;

/// x + jy = e^{jγ} (a cos τ + j b sin τ), τ = Ωt + ϕ: semi-axis a along γ, and a quarter revolution later b
/// across it.
#[test]
fn axes_and_inclination_of_elliptic_orbit() {
    for (a, b, inclination, phase) in [(3.0, 1.0, 0.5, 0.9), (3.0, -1.0, 0.5, 0.9), (2.0, 1.9, -1.2, 2.0)] {
        let phasor = C::from_polar(1.0, phase);
        let (sin, cos) = f64::sin_cos(inclination);
        // Re(j e^{jτ}) = −sin τ.
        let x = C::new(a * cos, b * sin) * phasor;
        let y = C::new(a * sin, -b * cos) * phasor;
        let orbit = Orbit::new(x, y);
        agree::absolute("major semi-axis", orbit.major, a, 1e-14);
        agree::absolute("minor semi-axis", orbit.minor, b, 1e-14);
        let off = (orbit.inclination - inclination).rem_euclid(PI);
        agree::absolute("inclination of the orbit, error [rad]", off.min(PI - off), 0.0, 1e-14);
        assert!(orbit.whirl * b > 0.0);
    }
}

/// Dowson and Higginson's oil, 1 + 0.34 p/(5.9e8 + p): 193/159 at 1 GPa.
#[test]
fn dowson_higginson_density_ratio() {
    let oil = Lubricant { name: "oil".into(), viscosity: 0.04, pressure_viscosity: 2e-8, density: 870.0 };
    agree::absolute("density ratio at 1 GPa", oil.density_ratio(1e9), 193.0 / 159.0, 1e-14);
    assert_eq!(oil.density_ratio(0.0), 1.0);
}

/// 4.8 kg midway between two springs of 1e6 N/m.
fn mass_on_springs(more: &str) -> Machine {
    mass_on_springs_with(more, None)
}

fn mass_on_springs_with(more: &str, variant: Option<&str>) -> Machine {
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
        DAMPING
        [bearing.B]
        model = "linear"
        station = "B"
        k_xx = "1e6 N/m"
        k_yy = "1e6 N/m"
        DAMPING
        [drive]
        kind = "prescribed"
        station = "A"
        [speed]
        profile = "constant"
        speed = "0 rad/s"
        duration = "0.1 s"
        [probe.x]
        at = "C"
        direction = "x"
        [study.run_up]
        step = "20 us"
        sample_rate = "5 kHz"
        cutoff = "1e6 Hz"
        {more}
        "#
    );
    let damping = if more.is_empty() { "c_xx = \"300 N s/m\"" } else { "" };
    let text = text.replace("DAMPING", damping);
    let options = Options { variant: variant.map(String::from), ..Options::default() };
    Machine::new(load("mass.toml", &text, &options).unwrap_or_else(|e| panic!("{e:?}")).model).unwrap()
}

fn seconds(time: &[f64]) -> agree::Over<'_> {
    agree::Over { name: "time", unit: "s", values: time }
}

/// (jω)^p/(k − m ω² + jω c), p = 0, 1, 2: velocity leads displacement by 90°.
#[test]
fn receptance_mobility_and_accelerance() {
    let machine = mass_on_springs("");
    let probe = &machine.model.probes[0];
    let row = [machine.assembly.direction_row(&probe.at, &probe.direction)];
    let system = machine.linear_system(0.0).unwrap();
    for (power, quantity) in
        [Quantity::Displacement, Quantity::Velocity, Quantity::Acceleration].iter().enumerate()
    {
        let hz = [20.0, 100.0, 102.7, 300.0];
        let found = frf(&machine.assembly, &system, &hz, &row, &row, *quantity).unwrap();
        for (hz, value) in hz.iter().zip(&found.values[0][0]) {
            let w = TAU * hz;
            let expected = C::new(0.0, w).powu(power as u32) / C::new(2e6 - 4.8 * w * w, 600.0 * w);
            let off = C::new(value.re, value.im) - expected;
            agree::curve(format_args!("{quantity:?} at {hz} Hz"), off.norm(), expected.norm(), 1e-12);
        }
        let hz: Vec<f64> = (10..=300).map(f64::from).collect();
        let found = frf(&machine.assembly, &system, &hz, &row, &row, *quantity).unwrap();
        let ours: Vec<f64> = found.values[0][0].iter().map(|value| value.re.hypot(value.im)).collect();
        let closed = |hz: &f64| {
            let w = TAU * hz;
            w.powi(power as i32) / C::new(2e6 - 4.8 * w * w, 600.0 * w).norm()
        };
        let closed: Vec<f64> = hz.iter().map(closed).collect();
        let unit = ["m/N", "m/s/N", "m/s²/N"][power];
        let over = agree::Over { name: "frequency", unit: "Hz", values: &hz };
        agree::curves(
            format_args!("magnitude of {quantity:?} over force"),
            unit,
            over,
            &ours,
            &closed,
            1e-12,
        );
    }
}

/// Step response with given modal damping: x = (F/k) (1 − e^{−ζωt} (cos ω_d t + ζω/ω_d sin ω_d t)).
#[test]
fn step_response_with_modal_damping() {
    let more = "[damping.modal]\nfrequency = \"50 Hz\"\nratio = 0.05\n[load.step]\nat = \"C\"\nforce = \"100, 0, 0 N\"\n\
                time = \"0, 10 s\"\nfactor = [1, 1]\n";
    let machine = mass_on_springs(more);
    let study =
        RunUpStudy { integrator: Integrator::RungeKutta4, ..machine.model.studies.run_up.clone().unwrap() };
    let reduction = machine.reduce(&study).unwrap();
    let (omega, zeta) = (f64::sqrt(2e6 / 4.8), 0.05_f64);
    let damped = omega * (1.0 - zeta * zeta).sqrt();
    let [mut time, mut ours, mut expected] = [const { Vec::new() }; 3];
    let report = machine.run_up(&study, &reduction, |sample| {
        let t = sample.state.time;
        let (sin, cos) = (damped * t).sin_cos();
        time.push(t);
        ours.push(sample.channels[0]);
        expected.push(5e-5 * (1.0 - (-zeta * omega * t).exp() * (cos + zeta * omega / damped * sin)));
        ControlFlow::Continue(())
    });
    assert_eq!(report.end, End::Complete);
    // Integration error at most (ω h)⁴ = 3e-8.
    agree::curves("step response", "m", seconds(&time), &ours, &expected, 1e-7);
}

/// Negative stiffness, as of a magnetic pull: x = F/(m a²) (cosh at − 1) with a² = −k/m. K is indefinite, so the
/// static correction modes of the reduction are computed with a mass shift.
#[test]
fn growth_on_negative_stiffness() {
    let more = "[load.step]\nat = \"C\"\nforce = \"1, 0, 0 N\"\ntime = \"0, 10 s\"\nfactor = [1, 1]\n\
                [variant.pull]\nbearing.A.k_xx = \"-60 N/m\"\nbearing.B.k_xx = \"-60 N/m\"\n";
    let machine = mass_on_springs_with(more, Some("pull"));
    let study =
        RunUpStudy { integrator: Integrator::RungeKutta4, ..machine.model.studies.run_up.clone().unwrap() };
    let reduction = machine.reduce(&study).unwrap();
    let rate = f64::sqrt(120.0 / 4.8);
    let [mut time, mut ours, mut expected] = [const { Vec::new() }; 3];
    let report = machine.run_up(&study, &reduction, |sample| {
        time.push(sample.state.time);
        ours.push(sample.channels[0]);
        expected.push(((rate * sample.state.time).cosh() - 1.0) / 120.0);
        ControlFlow::Continue(())
    });
    assert_eq!(report.end, End::Complete);
    agree::curves("growth on a negative stiffness", "m", seconds(&time), &ours, &expected, 1e-9);
}

/// Random force of density G = F²/(f₂ − f₁) \[N²/Hz\] around the natural frequency: the mean square of the displacement is
/// G π f_n/(4 ζ k²). What the band leaves out is 0.2 % of it; a mean over T deviates by chance by 1/√(2π ζ f_n T).
#[test]
fn random_vibration_of_one_mass() {
    let more = "[damping.modal]\nfrequency = \"50 Hz\"\nratio = 0.02\n[load.flow]\nat = \"C\"\nforce = \"0, 6, 8 N\"\n\
                band = \"5, 255 Hz\"\n[probe.y]\nat = \"C\"\ndirection = \"y\"\n";
    let mut machine = mass_on_springs(more);
    machine.model.profile = SpeedProfile::Constant { speed: 0.0, duration: 200.0 };
    let study = RunUpStudy { step: 2e-4, ..machine.model.studies.run_up.clone().unwrap() };
    let reduction = machine.reduce(&study).unwrap();
    let (mut count, mut squares) = (0.0, [0.0, 0.0]);
    let report = machine.run_up(&study, &reduction, |sample| {
        // After the start from rest has decayed.
        if sample.state.time > 1.0 {
            count += 1.0;
            squares[0] += sample.channels[0].powi(2);
            squares[1] += sample.channels[1].powi(2);
        }
        ControlFlow::Continue(())
    });
    assert_eq!(report.end, End::Complete);
    let (stiffness, hz, zeta) = (2e6, f64::sqrt(2e6 / 4.8) / TAU, 0.02);
    let density = 36.0 / 250.0;
    let expected = density * PI * hz / (4.0 * zeta) / (stiffness * stiffness);
    let by_chance = 1.0 / (TAU * zeta * hz * 200.0).sqrt();
    agree::relative("mean square under a random force", squares[1] / count, expected, 3.0 * by_chance);
    assert_eq!(squares[0], 0.0);
}

/// Jeffcott rotor with internal (rotating) damping: m z̈ + (c_e + c_i) ż + (k − jΩ c_i) z = F,
/// z = u_x + j u_y, c_i = η k. From rest z = z∞ (1 + (s₂ e^{s₁t} − s₁ e^{s₂t})/(s₁ − s₂)),
/// z∞ = F/(k − jΩ c_i), s₁ and s₂ the roots. Far above the stability threshold speed the forward whirl grows.
#[test]
fn unstable_forward_whirl_due_to_internal_damping() {
    let (eta, external, mass, speed, force) = (4e-4, 20.0, 10.0, 500.0, 30.0);
    let mut model = jeffcott(mass, eta, external);
    let a = Anchor::node(4);
    let factor = LoadFactor::Table(vec![[0.0, 1.0], [10.0, 1.0]]);
    model.loads.push(Load { name: "step".into(), at: a, force: [force, 0.0, 0.0, 0.0, 0.0, 0.0], factor });
    for k in 0..2 {
        let mut direction = [0.0; 6];
        direction[k] = 1.0;
        model.probes.push(Probe { name: format!("{k}"), at: a, direction, quantity: Quantity::Displacement });
    }
    model.profile = SpeedProfile::Constant { speed, duration: 0.4 };
    let machine = Machine::new(model).unwrap();
    let study = RunUpStudy {
        integrator: Integrator::Newmark,
        step: 2e-5,
        defect_step: f64::INFINITY,
        sample_rate: 1000.0,
        cutoff: 100.0,
        from_equilibrium: true,
        cage_phases: 0,
        motion: None,
    };
    let reduction = machine.reduce(&study).unwrap();

    let spring = 48.0 * 2.1e11 * PI / 64.0 * 0.02f64.powi(4) / 0.8f64.powi(3);
    let (damping, stiffness) = (external + eta * spring, C::new(spring, -speed * eta * spring));
    let root = (C::from(damping * damping) - stiffness * (4.0 * mass)).sqrt();
    let (s1, s2) = ((root - damping) / (2.0 * mass), (-root - damping) / (2.0 * mass));
    assert!(s1.re.max(s2.re) > 5.0, "{s1} {s2}");
    let (mut worst, mut farthest) = (0.0_f64, 0.0_f64);
    let [mut time, mut along_x, mut expected_x] = [const { Vec::new() }; 3];
    let report = machine.run_up(&study, &reduction, |sample| {
        let t = sample.state.time;
        let transient = (s2 * (s1 * t).exp() - s1 * (s2 * t).exp()) / (s1 - s2);
        let expected = C::from(force) / stiffness * (transient + 1.0);
        let computed = C::new(sample.channels[0], sample.channels[1]);
        worst = worst.max((computed - expected).norm());
        farthest = farthest.max(expected.norm());
        time.push(t);
        along_x.push(computed.re);
        expected_x.push(expected.re);
        ControlFlow::Continue(())
    });
    assert_eq!(report.end, End::Complete);
    // Newmark period error (ω h)²/12 times 50 rad: 3e-5; rotary inertia of disc and shaft: 1e-6.
    agree::curve("unstable forward whirl [m]", worst, farthest, 3e-4);
    agree::curves("unstable forward whirl, x", "m", seconds(&time), &along_x, &expected_x, 3e-4);
}
