//! A torque drive compared with the closed form of its equation of rotation.

use std::ops::ControlFlow;

use crate::rig::variant;
use rotordyn::model::study::Integrator;
use rotordyn::model::{Drive, SpeedProfile};
use rotordyn::study::Machine;
use rotordyn::transient::run::End;

#[test]
fn constant_torque_against_drag() {
    // J Ω̇ = T − c Ω: Ω = (T/c)(1 − e^{−ct/J}), θ = (T/c)(t − (J/c)(1 − e^{−ct/J})).
    let (torque, drag) = (6.0, 0.1);
    for integrator in [Integrator::Newmark, Integrator::RungeKutta4] {
        let mut model = variant(None, &[]);
        let Drive::Prescribed { node: Some(node) } = model.drive else { panic!("the rig is driven") };
        model.drive = Drive::Torque { node, table: vec![[0.0, torque]], drag };
        model.profile = SpeedProfile::Constant { speed: 0.0, duration: 1.5 };
        // A damper from the disc to ground would be an additional drag.
        model.bushings.retain(|b| b.damping[5][5] == 0.0);
        let machine = Machine::new(model).unwrap();
        let inertia = machine.assembly.polar_inertia;
        let mut study = machine.model.studies.run_up.clone().unwrap();
        study.integrator = integrator;
        study.step = if integrator == Integrator::Newmark { 2.5e-5 } else { 1e-5 };
        study.sample_rate = 100.0;
        let reduction = machine.reduce(&study).unwrap();
        let mut worst: (f64, f64) = (0.0, 0.0);
        let report = machine.run_up(&study, &reduction, |sample| {
            let (t, spin) = (sample.state.time, &sample.state.spin);
            let decay = -(-drag * t / inertia).exp_m1();
            let speed = torque / drag * decay;
            let angle = torque / drag * (t - inertia / drag * decay);
            worst = (worst.0.max((spin.speed - speed).abs()), worst.1.max((spin.angle - angle).abs()));
            ControlFlow::Continue(())
        });
        println!("{integrator:?}: J {inertia:.4}, worst {worst:?}, {:?}", report.end);
        assert_eq!(report.end, End::Complete);
        // 40 rad/s and 20 rad at the end; torsional vibration contributes 1e-9 of the drag.
        assert!(worst.0 < 1e-7 && worst.1 < 1e-7, "{worst:?}");
    }
}
