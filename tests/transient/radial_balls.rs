//! Radial ball bearings with ball degrees of freedom on moving housings: run-up, energy balance, static equilibrium.

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

/// Energy balance of a run-up of the rig, within the second-order error of a Newmark step, with perfect and with
/// with_defects balls.
#[test]
fn energy_balance_of_a_run_up_of_the_rig() {
    for with_defects in [false, true] {
        let off = ("bearing.A.off_size", "[{ ball = 2, diameter_difference = \"1 um\" }]");
        let set = if with_defects { vec![off] } else { vec![] };
        let machine = rig(&set);
        let mut study = machine.model.studies.run_up.clone().unwrap();
        study.integrator = Integrator::Newmark;
        let reduction = machine.reduce(&study).unwrap();
        let report = machine.run_up(&study, &reduction, |_| ControlFlow::Continue(()));
        assert_eq!(report.end, rotordyn::transient::run::End::Complete);
        let e = report.energy;
        println!(
            "residual {:.2e} of {:.3e} J; {} halvings; {e:?}",
            e.residual(),
            e.exchanged(),
            report.halvings
        );
        assert!(e.residual().abs() < 2e-3 * e.exchanged(), "{e:?}: residual {}", e.residual());
    }
}

/// At standstill the static equilibrium of rotor, housings and balls is one of the transient: accelerations are within
/// the round-off of the equilibrium.
#[test]
fn static_equilibrium_is_one_of_the_transient() {
    let still = [("speed.to", "1e-6 rpm")];
    let machine = rig(&still);
    let mut study = machine.model.studies.run_up.clone().unwrap();
    // Without modal truncation the basis contains the static deflection exactly.
    study.cutoff = f64::INFINITY;
    let reduction = machine.reduce(&study).unwrap();
    let system = &reduction.system;
    let v = &reduction.equilibrium * 0.0;
    let state = system.initial_state(reduction.equilibrium.clone(), v).unwrap();
    let structure = system.structure();
    // Accelerations of mass-normalised coordinates, relative to those of gravity, Σ = g √m.
    let gravity = system.static_load.amax();
    // The highest modes of the shaft have ω² of 1e12 1/s² that make round-off large; they are left out.
    let seen = state.a.iter().take(60).chain(state.a.iter().skip(structure));
    let worst = seen.fold(0.0_f64, |m, a| m.max(a.abs()));
    println!(
        "largest residual acceleration {worst:.2e}, gravity {gravity:.2e}, {} ball DOFs",
        system.size() - structure
    );
    assert!(system.size() - structure == 18);
    assert!(worst < 1e-6 * gravity, "{:?}", state.a);
}
