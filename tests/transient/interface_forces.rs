//! The bearing forces that Newton's method leaves in a state, against those evaluated at it.

use std::ops::ControlFlow;

use nalgebra::DVector;

use crate::rig::variant;
use rotordyn::model::study::RunUpStudy;
use rotordyn::study::Machine;
use rotordyn::transient::reduction::Reduction;
use rotordyn::transient::stepper::Stepper;
use rotordyn::transient::system::{Bodies, State, System};

/// Accelerations of the interface rows \[m/s², rad/s²\] by what the forces of a state differ from those of its displacements
/// and velocities, with all inertia that a force at the row meets.
fn acceleration_error(system: &System, state: &State) -> DVector<f64> {
    let mut reactions = state.reactions.clone();
    let mut force = vec![0.0; system.interface_size()];
    let none = Bodies { states: &[], rates: &mut [] };
    system.bearing_reactions(&state.d, &state.d_rate, &state.rotations, none, &mut reactions, &mut force);
    let difference = DVector::from_fn(force.len(), |k, _| state.force[k] - force[k]);
    &system.interface_map * system.interface_map.transpose() * difference
}

fn rms(values: &[DVector<f64>]) -> f64 {
    let count: usize = values.iter().map(DVector::len).sum();
    (values.iter().map(|value| value.norm_squared()).sum::<f64>() / count as f64).sqrt()
}

/// A variant of the rig that runs up in a second.
fn fast_run_up(name: Option<&str>) -> (Machine, RunUpStudy, Reduction) {
    let quick = [("speed.settle", "0.01 s"), ("speed.ramp", "1 s"), ("speed.hold", "0.2 s")];
    let machine = Machine::new(variant(name, &quick)).unwrap();
    let study = machine.model.studies.run_up.clone().unwrap();
    let reduction = machine.reduce(&study).unwrap();
    (machine, study, reduction)
}

/// A Jacobian serves many steps: no step may end before its forces are those of its displacements, but for a small part of the
/// error that its length makes.
#[test]
fn forces_of_every_state_are_those_of_its_displacements() {
    for name in [None, Some("wavy"), Some("dented")] {
        let (machine, study, reduction) = fast_run_up(name);
        let run = |part: f64| {
            let mut study = study.clone();
            (study.step, study.defect_step) = (part * study.step, part * study.defect_step);
            let (mut errors, mut accelerations) = (Vec::new(), Vec::new());
            let report = machine.run_up(&study, &reduction, |sample| {
                errors.push(acceleration_error(&reduction.system, sample.state));
                accelerations.push(&reduction.system.interface_map * &sample.state.acceleration);
                ControlFlow::Continue(())
            });
            (errors, accelerations, report.iterations as f64 / report.steps as f64)
        };
        let (errors, accelerations, per_step) = run(1.0);
        let (_, with_half_the_step, _) = run(0.5);
        let pairs = accelerations.iter().zip(&with_half_the_step);
        let by_step: Vec<_> = pairs.map(|(whole, half)| whole - half).collect();
        let worst = errors.iter().map(|error| error.amax()).fold(0.0, f64::max);
        let largest = accelerations.iter().map(|a| a.amax()).fold(0.0, f64::max);
        let (error, step_error, vibration) = (rms(&errors), rms(&by_step), rms(&accelerations));
        println!(
            "{name:?}: {error:.1e}, at most {worst:.1e}; by half the step {step_error:.1e}; of {vibration:.1e}, at most \
             {largest:.1e}; {per_step:.2} iterations a step"
        );
        assert!(largest > 10.0, "{name:?}: {largest}");
        assert!(error < 0.003 * step_error, "{name:?}: {error:e}, by half the step {step_error:e} m/s^2");
        assert!(error < 1e-3 * vibration && worst < 1e-3 * largest, "{name:?}: {error:e}, {worst:e} m/s^2");
        assert!(per_step < 3.0, "{name:?}: {per_step}");
    }
}

/// Steps that no run-up takes end where what they leave shows in no result, not even in the difference of two trajectories.
#[test]
fn forces_of_steady_motions_have_no_error_that_shows() {
    for name in [None, Some("wavy"), Some("dented")] {
        let (_, study, reduction) = fast_run_up(name);
        let (system, step) = (&reduction.system, study.step.min(study.defect_step));
        let mut stepper = Stepper::new(system, study.integrator, step);
        let at_rest = &reduction.equilibrium * 0.0;
        let mut state = system.initial_state(reduction.equilibrium.clone(), at_rest).unwrap();
        let (mut worst, mut squares, steps) = (0.0_f64, 0.0, (1.2 / step) as u32);
        for k in 1..=steps {
            stepper.advance(system, &mut state, step, f64::from(k) * step, &mut |_, _| Ok(())).unwrap();
            let error = acceleration_error(system, &state).amax();
            worst = worst.max(error);
            squares += error * error;
        }
        let rms = (squares / f64::from(steps)).sqrt();
        let per_step = stepper.iteration_counts().0 as f64 / f64::from(steps);
        println!("{name:?}: {rms:.1e}, at most {worst:.1e} m/s^2; {per_step:.2} iterations a step");
        assert!(rms < 1e-5 && worst < 1e-3, "{name:?}: {rms:e}, {worst:e} m/s^2");
        assert!(per_step < 4.0, "{name:?}: {per_step}");
    }
}
