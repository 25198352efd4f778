//! Phase of the unbalance response (high spot and heavy spot): unbalances of different phase, at constant
//! speed and in a run-up.

use crate::agree;
use nalgebra::{Complex, Matrix2, Vector2};
use rotordyn::model::study::{Integrator, RunUpStudy, UnbalanceStudy};
use rotordyn::model::{Options, load};
use rotordyn::study::Machine;
use rotordyn::transient::run::End;
use std::f64::consts::PI;
use std::ops::ControlFlow;

type C = Complex<f64>;

/// Solid cylinder of 4.8 kg, 0.55 m long, 40 mm in diameter, centre of mass at z = 0.
const ROTOR: &str = r#"
[model]
name = "phases"
gravity = "0 m/s^2"
[rotor]
length = "0.55 m"
outer_diameter = "40 mm"
mass = "4.8 kg"
centre = "0 m"
[station]
A = "-0.2 m"
left = "-0.12 m"
C = "0 m"
right = "0.18 m"
B = "0.22 m"
[drive]
kind = "prescribed"
station = "A"
[probe.left_x]
at = "left"
direction = "x"
[probe.left_y]
at = "left"
direction = "y"
[probe.right_x]
at = "right"
direction = "x"
[probe.right_y]
at = "right"
direction = "y"
[study.run_up]
step = "20 us"
sample_rate = "5 kHz"
cutoff = "1e6 Hz"
"#;

const MASS: f64 = 4.8;
const POLAR: f64 = MASS * 4e-4 / 2.0;
const DIAMETRAL: f64 = MASS * (12e-4 + 0.3025) / 12.0;
/// Bearings A and B: position z \[m\], stiffness \[N/m\] and damping \[N s/m\], the same along x and y.
const BEARINGS: [[f64; 3]; 2] = [[-0.2, 1e6, 300.0], [0.22, 1.6e6, 400.0]];
/// Unbalances: position z \[m\], magnitude \[kg m\], phase \[°\].
const UNBALANCES: [[f64; 3]; 2] = [[-0.12, 1e-4, 30.0], [0.18, 7e-5, 110.0]];

/// Complex amplitude R(z) = r + z β of u_x + j u_y = R e^{jΩt}, from the Newton-Euler equations:
/// (Σ k + jΩ Σ c − m Ω²) r + (Σ k z + jΩ Σ c z) β = Σ U Ω² e^{jϕ} and
/// (Σ k z + jΩ Σ c z) r + (Σ k z² + jΩ Σ c z² + (I_p − I_d) Ω²) β = Σ z U Ω² e^{jϕ}.
fn closed_form(speed: f64) -> impl Fn(f64) -> C {
    let sum =
        |power: i32| -> C { BEARINGS.iter().map(|[z, k, c]| C::new(*k, speed * c) * z.powi(power)).sum() };
    let square = speed * speed;
    let matrix = Matrix2::new(
        sum(0) - C::from(MASS * square),
        sum(1),
        sum(1),
        sum(2) + C::from((POLAR - DIAMETRAL) * square),
    );
    let excitation = |power: i32| -> C {
        UNBALANCES.iter().map(|[z, u, deg]| C::from_polar(u * square * z.powi(power), deg * PI / 180.0)).sum()
    };
    let found = matrix.try_inverse().unwrap() * Vector2::new(excitation(0), excitation(1));
    move |z| found[0] + found[1] * z
}

fn machine(more: &str) -> Machine {
    let mut text = ROTOR.to_string() + more;
    for (name, [_, magnitude, phase]) in ["left", "right"].iter().zip(UNBALANCES) {
        if !more.contains("[unbalance") {
            text += &format!(
                "[unbalance.{name}]\nstation = \"{name}\"\nmagnitude = \"{} g mm\"\nphase = \"{phase} deg\"\n",
                1e6 * magnitude
            );
        }
    }
    Machine::new(load("phases.toml", &text, &Options::default()).unwrap_or_else(|e| panic!("{e:?}")).model)
        .unwrap()
}

fn machine_on_bearings(speed: f64) -> Machine {
    let bearings: String = ["A", "B"]
        .iter()
        .zip(BEARINGS)
        .map(|(name, [_, k, c])| {
            format!(
                "[bearing.{name}]\nmodel = \"linear\"\nstation = \"{name}\"\nk_xx = \"{k} N/m\"\nk_yy = \"{k} N/m\"\n\
                 k_zz = \"1e6 N/m\"\nc_xx = \"{c} N s/m\"\nc_yy = \"{c} N s/m\"\n"
            )
        })
        .collect();
    machine(&format!(
        "{bearings}[speed]\nprofile = \"constant\"\nspeed = \"{speed} rad/s\"\nduration = \"0.6 s\"\n"
    ))
}

/// Below, between and far above the resonances; runs start at rest, and in 0.5 s the transient decays to
/// e⁻²⁵.
#[test]
fn unbalance_response_phase_of_two_unbalances() {
    for speed in [150.0, 800.0, 2500.0] {
        let machine = machine_on_bearings(speed);
        let at = closed_form(speed);
        let [left, right] = [at(-0.12), at(0.18)];

        let responses = machine.model.probes.clone();
        let linear = machine
            .unbalance(&UnbalanceStudy {
                speeds: vec![speed],
                refine: false,
                responses,
                operating_speeds: None,
            })
            .unwrap();
        let y_from_x = C::new(0.0, -1.0);
        let expected = [left, left * y_from_x, right, right * y_from_x];
        for (channel, expected) in linear.channels.iter().zip(expected) {
            let [re, im] = channel.amplitude[0];
            let off = (C::new(re, im) - expected).norm();
            // Round-off of a small system.
            agree::curve(format_args!("{} at {speed} rad/s", channel.probe.name), off, left.norm(), 1e-12);
        }

        for integrator in [Integrator::RungeKutta4, Integrator::Newmark] {
            // Newmark shifts the resonances, up to 900 rad/s, by (ω h)²/12; near resonance the response
            // changes by many times that.
            let tolerance = match integrator {
                Integrator::Newmark => 10.0 * (20e-6 * speed.max(900.0)).powi(2),
                _ => 1e-6,
            };
            let study = RunUpStudy { integrator, ..machine.model.studies.run_up.clone().unwrap() };
            let reduction = machine.reduce(&study).unwrap();
            let (mut compared, mut worst) = (0, [0.0_f64; 2]);
            let report = machine.run_up(&study, &reduction, |sample| {
                if sample.state.time > 0.5 {
                    let rotation = C::from_polar(1.0, sample.state.spin.angle);
                    let computed = |k: usize| C::new(sample.channels[2 * k], sample.channels[2 * k + 1]);
                    for (k, expected) in [left, right].into_iter().enumerate() {
                        worst[k] = worst[k].max((computed(k) - expected * rotation).norm());
                    }
                    compared += 1;
                }
                ControlFlow::Continue(())
            });
            for (k, expected) in [left, right].into_iter().enumerate() {
                let what = format_args!("{integrator:?} at {speed} rad/s, probe {k}, settled");
                agree::curve(what, worst[k], expected.norm(), tolerance);
            }
            assert_eq!((report.end, compared > 400), (End::Complete, true));
        }
        // Far below resonance the high spot is near the heavy spot, far above it opposite.
        let heavy_spot: C = UNBALANCES.iter().map(|[_, u, deg]| C::from_polar(*u, deg * PI / 180.0)).sum();
        let phase_lag = (at(0.0) / heavy_spot).arg().abs();
        assert!(
            if speed < 200.0 { phase_lag < 0.2 } else { speed < 2000.0 || phase_lag > 2.8 },
            "{phase_lag}"
        );
    }
}

/// Free rotor without supports: the centre of mass of rotor and unbalance stays at rest at any speed and
/// acceleration: m r + U e^{j(θ + ϕ)} is constant, r = −(U/m) (e^{j(θ + ϕ)} − e^{jϕ}) from rest.
#[test]
fn run_up_of_free_rotor_about_its_centre_of_mass() {
    let machine = machine(
        "[unbalance.middle]\nstation = \"C\"\nmagnitude = \"100 g mm\"\nphase = \"40 deg\"\n\
         [speed]\nprofile = \"ramp\"\nfrom = \"0 rad/s\"\nramp = \"0.3 s\"\nto = \"300 rad/s\"\n",
    );
    let study =
        RunUpStudy { integrator: Integrator::RungeKutta4, ..machine.model.studies.run_up.clone().unwrap() };
    let reduction = machine.reduce(&study).unwrap();
    let arm = 1e-4 / MASS;
    let (mut worst, mut farthest) = (0.0_f64, 0.0_f64);
    let [mut time, mut ours, mut along_x] = [const { Vec::new() }; 3];
    let report = machine.run_up(&study, &reduction, |sample| {
        let start = 40.0 * PI / 180.0;
        let angle = sample.state.spin.angle + start;
        let expected = -(C::from_polar(arm, angle) - C::from_polar(arm, start));
        for k in [0, 2] {
            let computed = C::new(sample.channels[k], sample.channels[k + 1]);
            worst = worst.max((computed - expected).norm());
            farthest = farthest.max(computed.norm());
        }
        time.push(sample.state.time);
        ours.push(sample.channels[0]);
        along_x.push(expected.re);
        ControlFlow::Continue(())
    });
    assert_eq!(report.end, End::Complete);
    // Integration error (Ω h)⁴ at the maximum speed over 7 revolutions, a tenth of it from the angular
    // acceleration.
    agree::curve("unbalance response over time [m]", worst, arm, 1e-7);
    let over = agree::Over { name: "time", unit: "s", values: &time };
    agree::curves("run-up of a free rotor, x", "m", over, &ours, &along_x, 1e-7);
    assert!(farthest > 1.99 * arm, "{farthest} of {arm}");
}
