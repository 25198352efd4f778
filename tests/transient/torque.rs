//! A torque drive of a balanced rotor compared with the closed form of its equation of rotation.

use std::ops::ControlFlow;

use crate::rig::variant;
use rotordyn::model::study::Integrator;
use rotordyn::model::{Drive, SpeedProfile};
use rotordyn::study::Machine;
use rotordyn::transient::run::End;

/// Largest deviations of speed and angle from J Ω̇ = T − c Ω, the law of a balanced rotor without bearing friction:
/// Ω = (T/c)(1 − e^{−ct/J}), θ = (T/c)(t − (J/c)(1 − e^{−ct/J})).
fn deviation(integrator: Integrator, unbalance: f64) -> [f64; 2] {
    let (torque, drag) = (6.0, 0.1);
    let mut model = variant(Some("cylindrical"), &[]);
    let Drive::Prescribed { node: Some(node) } = model.drive else { panic!("the rig is driven") };
    model.drive = Drive::Torque { node, table: vec![[0.0, torque]], drag };
    model.profile = SpeedProfile::Constant { speed: 0.0, duration: 1.5 };
    // A damper from the disc to ground would be an additional drag.
    model.bushings.retain(|b| b.damping[5][5] == 0.0);
    model.unbalances.iter_mut().for_each(|u| u.magnitude *= unbalance);
    let machine = Machine::new(model).unwrap();
    let inertia = machine.assembly.polar_inertia;
    let mut study = machine.model.studies.run_up.clone().unwrap();
    study.integrator = integrator;
    study.step = if integrator == Integrator::Newmark { 2.5e-5 } else { 1e-5 };
    study.sample_rate = 100.0;
    let reduction = machine.reduce(&study).unwrap();
    let mut worst = [0.0f64; 2];
    let report = machine.run_up(&study, &reduction, |sample| {
        let (t, spin) = (sample.state.time, &sample.state.spin);
        let decay = -(-drag * t / inertia).exp_m1();
        let speed = torque / drag * decay;
        let angle = torque / drag * (t - inertia / drag * decay);
        worst = [worst[0].max((spin.speed - speed).abs()), worst[1].max((spin.angle - angle).abs())];
        ControlFlow::Continue(())
    });
    assert_eq!(report.end, End::Complete);
    println!("{integrator:?}, unbalance x {unbalance}: J {inertia:.4}, worst {worst:?}");
    worst
}

#[test]
fn constant_torque_against_drag() {
    for integrator in [Integrator::Newmark, Integrator::RungeKutta4] {
        // 40 rad/s and 20 rad at the end; torsional vibration contributes 1e-9 of the drag.
        let balanced = deviation(integrator, 0.0);
        assert!(balanced[0] < 1e-7 && balanced[1] < 1e-7, "{balanced:?}");
    }
    // The reaction of the unbalance vanishes with it: gravity's moment in proportion, the whirl's with its square.
    let [whole, tenth] = [1.0, 0.1].map(|unbalance| deviation(Integrator::Newmark, unbalance));
    for (whole, tenth) in whole.iter().zip(tenth) {
        assert!(*whole > 1e-3 && (9.0..110.0).contains(&(whole / tenth)), "{whole} {tenth}");
    }
}
