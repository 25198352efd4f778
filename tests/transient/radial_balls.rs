//! Balls with coordinates of their own in a machine whose housings move: it runs, and its energy account closes.

use crate::rig::variant;
use rotordyn::model::study::Integrator;
use rotordyn::study::Machine;
use std::ops::ControlFlow;

/// The rig's variant on sprung housings, run up quickly.
fn rig(set: &[(&str, &str)]) -> Machine {
    let quick = [
        ("speed.settle", "0.02 s"),
        ("speed.ramp", "0.2 s"),
        ("speed.hold", "0.03 s"),
        ("speed.to", "1200 rpm"),
        ("study.run_up.step", "10 us"),
        ("study.run_up.cutoff", "800 Hz"),
    ];
    Machine::new(variant(Some("radial_balls"), &[&quick[..], set].concat())).unwrap()
}

/// A run-up of the rig: what was lost and what is stored is what was put in, within what a step of Newmark's leaves
/// (second order), with perfect and with imperfect balls.
#[test]
fn the_rig_keeps_its_energy_account() {
    for imperfect in [false, true] {
        let off = ("bearing.A.off_size", "[{ ball = 2, by = \"1 um\" }]");
        let set = if imperfect { vec![off] } else { vec![] };
        let machine = rig(&set);
        let mut study = machine.model.studies.run_up.clone().unwrap();
        study.integrator = Integrator::Newmark;
        let reduction = machine.reduce(&study).unwrap();
        let report = machine.run_up(&study, &reduction, |_| ControlFlow::Continue(()));
        assert_eq!(report.end, rotordyn::transient::run::End::Complete);
        let e = report.energy;
        println!("left {:.2e} of {:.3e} J; {} halvings; {e:?}", e.residual(), e.turnover(), report.halvings);
        assert!(e.residual().abs() < 2e-3 * e.turnover(), "{e:?}: {} left", e.residual());
    }
}
