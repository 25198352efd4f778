//! Gyroscopic moment: precession and nutation of a pivoted rotor under a side force, and torsional lag in a
//! run-up.

use crate::agree;
use nalgebra::Complex;
use rotordyn::model::study::{Integrator, RunUpStudy};
use rotordyn::model::{Options, SpeedProfile, load};
use rotordyn::study::Machine;
use rotordyn::transient::run::End;
use std::ops::ControlFlow;

type C = Complex<f64>;

/// Rotor on a spherical joint at one end, free at the other, where a step force acts from t = 0.
const PIVOTED_ROTOR: &str = r#"
[model]
name = "pivoted"
gravity = "0 m/s^2"
[rotor]
mass = "4.8 kg"
centre = "0.1 m"
polar_inertia = "0.02 kg m^2"
diametral_inertia = "0.012 kg m^2"
[station]
A = "0 m"
tip = "0.3 m"
[joint.A]
between = ["station.A", "ground"]
kind = "spherical"
[load.side]
at = "tip"
force = "FORCE, 0 N"
time = "0, 10 s"
factor = [1, 1]
[drive]
kind = "prescribed"
station = "A"
[speed]
profile = "constant"
speed = "0 rad/s"
duration = "0.3 s"
[probe.x]
at = "tip"
direction = "x"
[probe.y]
at = "tip"
direction = "y"
[study.run_up]
step = "50 us"
sample_rate = "1 kHz"
cutoff = "1e6 Hz"
"#;

/// Angular momentum L = I_p Ω t + I t × ṫ with t = (β_x, β_y, 1); the force F at l z has the moment l z × F,
/// so that with β = β_x + jβ_y: I β̈ − j I_p Ω β̇ = l F and β̇ = j (l F/(I_p Ω)) (1 − e^{jνt}), with the
/// nutation frequency ν = I_p Ω/I, I about the joint. A downward force (−y) on a shaft along z that spins
/// from x to y thus moves the tip towards +x (precession).
#[test]
fn gyroscopic_precession_and_nutation_under_side_force() {
    let (polar, about_joint, arm): (f64, f64, f64) = (0.02, 0.012 + 4.8 * 0.01, 0.3);
    for (speed, force) in [(400.0, [0.0, -2.0]), (-400.0, [0.0, -2.0]), (700.0, [1.5, 0.0])] {
        let text = PIVOTED_ROTOR.replace("FORCE", &format!("{}, {}", force[0], force[1]));
        let mut model =
            load("pivoted.toml", &text, &Options::default()).unwrap_or_else(|e| panic!("{e:?}")).model;
        model.profile = SpeedProfile::Constant { speed, duration: 0.3 };
        let machine = Machine::new(model).unwrap();
        let study = RunUpStudy {
            integrator: Integrator::RungeKutta4,
            ..machine.model.studies.run_up.clone().unwrap()
        };
        let reduction = machine.reduce(&study).unwrap();
        let j = C::new(0.0, 1.0);
        let rate = j * C::new(force[0], force[1]) * arm / (polar * speed);
        let nutation = polar * speed / about_joint;
        let (mut worst, mut last) = (0.0_f64, C::default());
        let [mut time, mut ours, mut expected] = [const { Vec::new() }; 3];
        let report = machine.run_up(&study, &reduction, |sample| {
            let t = sample.state.time;
            let tilt = rate * (C::from(t) - ((j * nutation * t).exp() - 1.0) / (j * nutation));
            last = C::new(sample.channels[0], sample.channels[1]);
            worst = worst.max((last - tilt * arm).norm());
            time.push(t);
            ours.push(last.norm());
            expected.push((tilt * arm).norm());
            ControlFlow::Continue(())
        });
        assert_eq!(report.end, End::Complete);
        let precession = (rate * 0.3 * arm).norm();
        // Integration error (ν h)⁴ over 0.3 s.
        agree::curve("free precession [m]", worst, precession, 1e-6);
        let what = format_args!("distance of the free end at {speed} rad/s");
        agree::curves(what, "m", seconds(&time), &ours, &expected, 1e-6);
        if force[1] < 0.0 {
            // Precession is perpendicular to the force; motion along the force is nutation only.
            agree::curve("transverse part of the precession", last.im.abs(), precession, 0.2);
            assert!(last.re * speed.signum() > 0.9 * precession, "{last} of {precession}");
        }
    }
}

fn seconds(time: &[f64]) -> agree::Over<'_> {
    agree::Over { name: "time", unit: "s", values: time }
}

/// The same rotor at constant angular acceleration, from L̇ = moment: with half of the drive torque I_p Ω̇
/// along z and half along t, j I β̈ + I_p (Ω β)˙ = j l F + ½ I_p Ω̇ β, integrated here independently.
#[test]
fn gyroscopic_precession_during_run_up() {
    let (polar, about_joint, arm): (f64, f64, f64) = (0.02, 0.012 + 4.8 * 0.01, 0.3);
    let text = PIVOTED_ROTOR.replace("FORCE", "0, -2");
    let mut model =
        load("pivoted.toml", &text, &Options::default()).unwrap_or_else(|e| panic!("{e:?}")).model;
    let (from, rate) = (100.0, 2000.0);
    model.profile = SpeedProfile::Ramp { from, to: from + 0.3 * rate, settle: 0.0, ramp: 0.3, hold: 0.0 };
    let machine = Machine::new(model).unwrap();
    let study =
        RunUpStudy { integrator: Integrator::RungeKutta4, ..machine.model.studies.run_up.clone().unwrap() };
    let reduction = machine.reduce(&study).unwrap();
    let mut computed = Vec::new();
    let report = machine.run_up(&study, &reduction, |sample| {
        computed.push(C::new(sample.channels[0], sample.channels[1]));
        ControlFlow::Continue(())
    });
    assert_eq!(report.end, End::Complete);

    let j = C::new(0.0, 1.0);
    let moment = j * C::new(0.0, -2.0) * arm;
    let tilt_acceleration = |t: f64, tilt: C, tilt_rate: C| {
        let speed = from + rate * t;
        (moment + tilt * (0.5 * polar * rate) - (tilt * rate + tilt_rate * speed) * polar) / (j * about_joint)
    };
    let (mut tilt, mut tilt_rate, h) = (C::default(), C::default(), 2e-5);
    let (mut worst, mut farthest) = (0.0_f64, 0.0_f64);
    let [mut time, mut ours, mut expected] = [const { Vec::new() }; 3];
    for (k, position) in computed.iter().enumerate() {
        time.push((50 * k) as f64 * h);
        ours.push(position.norm());
        expected.push((tilt * arm).norm());
        worst = worst.max((position - tilt * arm).norm());
        farthest = farthest.max(position.norm());
        for i in 0..50 {
            let t = (50 * k + i) as f64 * h;
            let (k1, l1) = (tilt_rate, tilt_acceleration(t, tilt, tilt_rate));
            let (k2, l2) = (
                tilt_rate + l1 * (0.5 * h),
                tilt_acceleration(t + 0.5 * h, tilt + k1 * (0.5 * h), tilt_rate + l1 * (0.5 * h)),
            );
            let (k3, l3) = (
                tilt_rate + l2 * (0.5 * h),
                tilt_acceleration(t + 0.5 * h, tilt + k2 * (0.5 * h), tilt_rate + l2 * (0.5 * h)),
            );
            let (k4, l4) = (tilt_rate + l3 * h, tilt_acceleration(t + h, tilt + k3 * h, tilt_rate + l3 * h));
            tilt += (k1 + k2 * 2.0 + k3 * 2.0 + k4) * (h / 6.0);
            tilt_rate += (l1 + l2 * 2.0 + l3 * 2.0 + l4) * (h / 6.0);
        }
    }
    // Integration error (ν h)⁴ of both integrators.
    agree::curve("precession in a run-up [m]", worst, farthest, 1e-6);
    agree::curves("distance of the free end in a run-up", "m", seconds(&time), &ours, &expected, 1e-6);
    assert!(computed.len() == 301, "{worst} of {farthest}, {}", computed.len());
}

/// Disc of inertia J at the end of a massless shaft whose other end has a constant angular acceleration α
/// from rest: torsional lag φ = (J α/k) (1 − cos √(k/J) t), k = G I_t/l.
#[test]
fn torsional_lag_of_disc_under_constant_angular_acceleration() {
    let text = r#"
        [model]
        name = "lag"
        gravity = "0 m/s^2"
        [material.light]
        young = "208 GPa"
        poisson = 0.3
        density = "0.001 kg/m^3"
        [shaft]
        material = "light"
        element_length = "100 mm"
        section = [{ length = "400 mm", outer_diameter = "12 mm" }]
        [station]
        A = "0 mm"
        disc = "300 mm"
        B = "400 mm"
        [disc.main]
        station = "disc"
        mass = "5 kg"
        polar_inertia = "0.05 kg m^2"
        diametral_inertia = "0.03 kg m^2"
        [bearing.A]
        model = "linear"
        station = "A"
        k_xx = "1e7 N/m"
        k_yy = "1e7 N/m"
        k_zz = "1e7 N/m"
        [bearing.B]
        model = "linear"
        station = "B"
        k_xx = "1e7 N/m"
        k_yy = "1e7 N/m"
        [drive]
        kind = "prescribed"
        station = "A"
        [speed]
        profile = "ramp"
        from = "0 rad/s"
        ramp = "0.3 s"
        to = "60 rad/s"
        [probe.twist]
        at = "disc"
        direction = "tz"
        [study.run_up]
        integrator = "newmark"
        step = "50 us"
        sample_rate = "1 kHz"
        cutoff = "500 Hz"
    "#;
    let model = load("lag.toml", text, &Options::default()).unwrap_or_else(|e| panic!("{e:?}")).model;
    let machine = Machine::new(model).unwrap();
    let study = machine.model.studies.run_up.clone().unwrap();
    let reduction = machine.reduce(&study).unwrap();
    let shear = 208e9 / 2.6;
    let stiffness = shear * std::f64::consts::PI / 32.0 * 12e-3_f64.powi(4) / 0.3;
    let (inertia, acceleration) = (0.05, 200.0);
    let (lag, omega) = (inertia * acceleration / stiffness, f64::sqrt(stiffness / inertia));
    let [mut time, mut ours, mut expected] = [const { Vec::new() }; 3];
    let report = machine.run_up(&study, &reduction, |sample| {
        let t = sample.state.time;
        time.push(t);
        ours.push(sample.channels[0]);
        expected.push(-lag * (1.0 - (omega * t).cos()));
        ControlFlow::Continue(())
    });
    assert_eq!(report.end, End::Complete);
    // Newmark period error (ω h)²/12 times ω t = 31 with ω = 104 rad/s: 7e-5.
    // The largest lag is twice its mean.
    agree::curves("torsional lag", "rad", seconds(&time), &ours, &expected, 1.5e-4);
}
