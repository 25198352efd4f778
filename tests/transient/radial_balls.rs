//! Balls with coordinates of their own in machines whose housings move: they run, rest at equilibrium, close their energy
//! account, and carry the machine's weight.

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
        println!("left {:.2e} of {:.3e} J; {} halvings; {e:?}", e.residual(), e.exchanged(), report.halvings);
        assert!(e.residual().abs() < 2e-3 * e.exchanged(), "{e:?}: {} left", e.residual());
    }
}

/// At standstill the machine stays where statics put it, housings and balls included: nothing moves beyond round-off of
/// the equilibrium.
#[test]
fn equilibrium_of_statics_is_one_of_the_transient() {
    let still = [("speed.to", "1e-6 rpm")];
    let machine = rig(&still);
    let mut study = machine.model.studies.run_up.clone().unwrap();
    // Without truncation the statics are in the basis as they are.
    study.cutoff = f64::INFINITY;
    let reduction = machine.reduce(&study).unwrap();
    let system = &reduction.system;
    let v = &reduction.equilibrium * 0.0;
    let state = system.initial_state(reduction.equilibrium.clone(), v);
    let structure = system.structure();
    // Accelerations of mass-normalised coordinates: against those of gravity, Σ = g √m.
    let gravity = system.static_load.amax();
    // The highest modes of the shaft have ω² of 1e12 1/s² that make round-off large; they are left out.
    let seen = state.a.iter().take(60).chain(state.a.iter().skip(structure));
    let worst = seen.fold(0.0_f64, |m, a| m.max(a.abs()));
    println!(
        "largest acceleration left {worst:.2e} beside {gravity:.2e}, {} balls",
        system.size() - structure
    );
    assert!(system.size() - structure == 18);
    assert!(worst < 1e-6 * gravity, "{:?}", state.a);
}
