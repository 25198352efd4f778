//! The bearing forces that Newton's method leaves in a state, against those evaluated at it.

use std::ops::ControlFlow;

use crate::rig::variant;
use rotordyn::study::Machine;
use rotordyn::transient::system::{Bodies, State, System};

/// Largest acceleration of an interface row \[m/s², rad/s²\] by what the forces of a state differ from those of its displacements
/// and velocities, with all inertia that a force at the row meets.
fn acceleration_error(system: &System, state: &State) -> f64 {
    let mut reactions = state.reactions.clone();
    let mut force = vec![0.0; system.interface_size()];
    let none = Bodies { states: &[], rates: &mut [] };
    system.bearing_reactions(&state.d, &state.d_rate, &state.rotations, none, &mut reactions, &mut force);
    let difference = nalgebra::DVector::from_fn(force.len(), |k, _| state.force[k] - force[k]);
    (&system.interface_map * system.interface_map.transpose() * difference).amax()
}

/// A Jacobian serves many steps: no step may end before its forces are those of its displacements.
#[test]
fn forces_of_every_state_are_those_of_its_displacements() {
    for name in [None, Some("wavy"), Some("dented")] {
        let quick = [("speed.settle", "0.01 s"), ("speed.ramp", "1 s"), ("speed.hold", "0.2 s")];
        let machine = Machine::new(variant(name, &quick)).unwrap();
        let study = machine.model.studies.run_up.clone().unwrap();
        let system = &machine.reduce(&study).unwrap();
        let (mut errors, mut largest) = (Vec::new(), 0.0_f64);
        let report = machine.run_up(&study, system, |sample| {
            errors.push(acceleration_error(&system.system, sample.state));
            largest = largest.max(sample.state.acceleration.amax());
            ControlFlow::Continue(())
        });
        let worst = errors.iter().copied().fold(0.0, f64::max);
        let rms = (errors.iter().map(|e| e * e).sum::<f64>() / errors.len() as f64).sqrt();
        let per_step = report.iterations as f64 / report.steps as f64;
        println!(
            "{name:?}: {rms:.1e}, at most {worst:.1e}, of {largest:.1e}; {per_step:.2} iterations a step"
        );
        assert!(largest > 10.0, "{name:?}: {largest}");
        assert!(rms < 1e-5 && worst < 2e-4, "{name:?}: {rms:e}, {worst:e} m/s^2");
        assert!(per_step < 4.0, "{name:?}: {per_step}");
    }
}
