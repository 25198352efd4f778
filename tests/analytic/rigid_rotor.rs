//! Rigid rotor: rigid-body modes, free precession, two springs in closed form, unbalance response.

use crate::agree;
use rotordyn::analysis::{ModeKind, modal};
use rotordyn::assembly::{Assembly, LinearSystem, rigid_body_modes};
use rotordyn::model::{self, Model};
use rotordyn::study::{Machine, Recorder};
use rotordyn::transient::run::End;
use std::ops::ControlFlow;

/// Solid cylinder of 4.8 kg, 0.55 m long and 40 mm thick, with its centre 0.25 m along the axis.
const ROTOR: &str = r#"
[model]
name = "rigid"
[rotor]
length = "0.55 m"
outer_diameter = "40 mm"
mass = "4.8 kg"
centre = "0.25 m"
[station]
A = "0.05 m"
B = "0.5 m"
"#;

fn load(text: &str) -> Model {
    model::load("rigid.toml", format!("{ROTOR}{text}"), &Default::default()).unwrap().model
}

/// Solid cylinder: I_p = m R²/2, I_d = m (3 R² + L²)/12.
const INERTIA: [f64; 3] = [4.8, 4.8 * 4e-4 / 2.0, 4.8 * (12e-4 + 0.3025) / 12.0];

#[test]
fn free_rotor_mass_matrix_and_six_rigid_body_modes() {
    let assembly = Assembly::new(&load("")).unwrap();
    let [mass, polar, diametral] = INERTIA;
    assert_eq!((assembly.dofs.len(), assembly.dofs.full_len()), (6, 18));
    for (i, expected) in [mass, mass, mass, diametral, diametral, polar].into_iter().enumerate() {
        for j in 0..6 {
            let expected = if i == j { expected } else { 0.0 };
            agree::absolute(
                format_args!("mass matrix [{i}][{j}]"),
                assembly.mass.to_dense()[(i, j)],
                expected,
                1e-15 * mass,
            );
        }
    }
    agree::absolute("polar inertia [kg m²]", assembly.polar_inertia, polar, 1e-18);
    let system = LinearSystem::new(&assembly, &[], 0.0).unwrap();
    assert_eq!(rigid_body_modes::rigid_body_modes_of(&assembly, &system).unwrap().len(), 6);
    // Displacements of the ends as a rigid body: u_x = x + (z - z_c) θ_y, u_y = y - (z - z_c) θ_x.
    let q = assembly.dofs.expand(&[1.0, 2.0, 3.0, 0.01, 0.02, 0.03]);
    for (node, arm) in [(0, -0.2), (1, 0.0), (2, 0.25)] {
        let expected = [1.0 + 0.02 * arm, 2.0 - 0.01 * arm, 3.0, 0.01, 0.02, 0.03];
        for (i, value) in expected.into_iter().enumerate() {
            agree::absolute(
                format_args!("rigid-body motion of node {node}, {i}"),
                q[6 * node + i],
                value,
                1e-15,
            );
        }
    }
}

/// The axis of a free rotor precesses at Ω I_p/I_d.
#[test]
fn free_precession() {
    let assembly = Assembly::new(&load("")).unwrap();
    let speed = 500.0;
    let system = LinearSystem::new(&assembly, &[], speed).unwrap();
    let modes = modal::modes(&assembly, &system, 6).unwrap();
    let fastest = modes.iter().map(|m| m.eigenvalue.im.abs()).fold(0.0, f64::max);
    let expected = speed * INERTIA[1] / INERTIA[2];
    agree::relative("rate of free precession [rad/s]", fastest, expected, 1e-9);
}

/// With r = u_x + j u_y and β = θ_y − j θ_x, a whirl e^{jωt} (ω < 0 backward) satisfies
/// (Σ k − m ω²)(Σ k z² + I_p Ω ω − I_d ω²) = (Σ k z)², z from the centre of mass.
#[test]
fn rotor_on_two_springs() {
    let springs = r#"
[bearing.A]
model = "linear"
station = "A"
k_xx = "2e7 N/m"
k_yy = "2e7 N/m"
k_zz = "1e8 N/m"
[bearing.B]
model = "linear"
station = "B"
k_xx = "5e6 N/m"
k_yy = "5e6 N/m"
[drive]
kind = "prescribed"
station = "A"
"#;
    let machine = Machine::new(load(springs)).unwrap();
    let [mass, polar, diametral] = INERTIA;
    let moment = |power: i32| 2e7 * (-0.2_f64).powi(power) + 5e6 * 0.25_f64.powi(power);
    for speed in [0.1, 300.0, 3000.0, 30000.0] {
        let value = |w: f64| {
            let tilt = moment(2) + polar * speed * w - diametral * w * w;
            (moment(0) - mass * w * w) * tilt - moment(1).powi(2)
        };
        let modes = modal::modes(&machine.assembly, &machine.linear_system(speed).unwrap(), 5).unwrap();
        let mut found = 0;
        for mode in modes.iter().filter(|mode| mode.kind != ModeKind::Axial) {
            let w = match mode.kind {
                ModeKind::Forward => mode.eigenvalue.im,
                ModeKind::Backward => -mode.eigenvalue.im,
                // also a mode whose two ends whirl in opposite senses is one circular whirl
                kind => panic!("{kind:?} at {speed} rad/s"),
            };
            let h = 1e-6 * w;
            let newton = value(w) / ((value(w + h) - value(w - h)) / (2.0 * h));
            let what = format_args!("whirl frequency at {speed} rad/s, {:?} [rad/s]", mode.kind);
            agree::relative(what, w, w - newton, 1e-8);
            assert!(mode.label.contains("rigid-body"), "{}", mode.label);
            found += 1;
        }
        assert_eq!(found, 4, "{speed}");
    }
}

#[test]
fn rigid_rotor_given_by_inertia() {
    let [mass, polar, diametral] = INERTIA;
    let text = format!(
        "[model]\nname = \"r\"\n[rotor]\ncentre = \"0 m\"\nmass = \"{mass} kg\"\npolar_inertia = \"{polar} kg m^2\"\n\
         diametral_inertia = \"{diametral} kg m^2\"\n[station]\nC = \"0 m\"\n"
    );
    let model = model::load("r.toml", text, &Default::default()).unwrap().model;
    let rotor = model.rigid_rotor.unwrap();
    assert_eq!([rotor.mass, rotor.polar_inertia, rotor.diametral_inertia], INERTIA);
    assert_eq!((model.node_z, rotor.node), (vec![0.0], 0));
}

/// Unbalance U at the centre of a rotor midway between equal springs, at constant speed after the transient:
/// r = U Ω²/(2 k − m Ω² + 2 j c Ω), within the discretisation error of the time step.
#[test]
fn steady_unbalance_response() {
    let text = r#"
[model]
name = "whirl"
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
c_xx = "300 N s/m"
c_yy = "300 N s/m"
[bearing.B]
model = "linear"
station = "B"
k_xx = "1e6 N/m"
k_yy = "1e6 N/m"
c_xx = "300 N s/m"
c_yy = "300 N s/m"
[unbalance.u]
station = "C"
magnitude = "100 g mm"
[drive]
kind = "prescribed"
station = "A"
[speed]
profile = "constant"
speed = "500 rad/s"
duration = "1 s"
[probe.x]
at = "rotor"
direction = "x"
[study.run_up]
step = "20 us"
sample_rate = "2 kHz"
[study.unbalance]
speeds = "500 rad/s"
"#;
    let machine = Machine::new(model::load("whirl.toml", text, &Default::default()).unwrap().model).unwrap();
    let (mass, speed) = (INERTIA[0], 500.0_f64);
    let (real, imaginary) = (2e6 - mass * speed * speed, 600.0 * speed);
    let expected = 1e-4 * speed * speed / real.hypot(imaginary);

    let linear = machine.unbalance(machine.model.studies.unbalance.as_ref().unwrap()).unwrap();
    let [re, im] = linear.channels[0].amplitude[0];
    agree::relative("linear unbalance response [m]", re.hypot(im), expected, 1e-10);

    let study = machine.model.studies.run_up.clone().unwrap();
    let reduction = machine.reduce(&study).unwrap();
    let mut recorder = Recorder::new(&machine.model, &reduction.system, study.sample_rate);
    let report = machine.run_up(&study, &reduction, |sample| {
        recorder.record(sample);
        ControlFlow::Continue(())
    });
    assert_eq!(report.end, End::Complete);
    let history = recorder.into_history();
    let x = history.channel("x").unwrap().values.in_memory().unwrap();
    let late = &x[x.len() * 3 / 4..];
    // 20 revolutions: the RMS is independent of the start phase.
    let rms = (late.iter().map(|v| v * v).sum::<f64>() / late.len() as f64).sqrt();
    agree::relative("unbalance response of a run [m]", rms * 2.0_f64.sqrt(), expected, 2e-3);
}
