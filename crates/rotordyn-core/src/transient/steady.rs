//! A run at constant speed: decay of the transient, then recording over whole periods of a clock.

use std::f64::consts::TAU;
use std::ops::ControlFlow;

use super::perturbed_trajectory::PerturbedTrajectory;
use super::stepper::{Stepper, check_divergence};
use super::system::{Channel, State, System};
use crate::assembly::PhysicsError;
use crate::model::study::{SectionTrigger, SteadyRunSettings};

/// Samples recorded before the first and after the last Poincaré section, for interpolation between samples.
const MARGIN_SAMPLES: f64 = 3.5;
/// Round-off of a phase, as a fraction of its period.
const ROUND_OFF: f64 = 1e-9;

/// Result of a run at constant speed.
#[derive(Clone, Debug)]
pub struct SteadyRun {
    /// Time between samples \[s\]: the integrator's step.
    pub step: f64,
    /// Phase of the clock at every sample \[rad\].
    pub phase: Vec<f64>,
    /// Shaft angle at every sample \[rad\].
    pub shaft_angle: Vec<f64>,
    /// Samples of every channel.
    pub channels: Vec<Vec<f64>>,
    /// ln of a perturbation's growth from section to section over the recorded periods (for Lyapunov
    /// exponents), if requested, and the time between sections \[s\].
    pub log_growth: Vec<f64>,
    pub intervals: Vec<f64>,
    /// State at the end of the run.
    pub state: State,
    /// Integration steps.
    pub steps: u64,
}

/// Phase of a clock \[rad\]; a Poincaré section is taken every 2π.
pub fn phase(clock: SectionTrigger, state: &State) -> f64 {
    match clock {
        SectionTrigger::Shaft => state.spin.angle,
        SectionTrigger::Cage { bearing } => state.rotations[bearing].cage_angle,
        SectionTrigger::BallPass { bearing, balls } => balls as f64 * state.rotations[bearing].cage_angle,
    }
}

fn phase_rate(clock: SectionTrigger, state: &State) -> f64 {
    let cage_speed = |bearing: usize| state.rotations[bearing].cage_speed.unwrap_or(0.0);
    match clock {
        SectionTrigger::Shaft => state.spin.speed,
        SectionTrigger::Cage { bearing } => cage_speed(bearing),
        SectionTrigger::BallPass { bearing, balls } => balls as f64 * cage_speed(bearing),
    }
}

/// Runs from `state` for the requested periods; `progress` may stop the run after any period (`None`).
///
/// With a `perturbation` \[m\] a perturbed trajectory is integrated from half of the settling on, so that it
/// has aligned with the fastest growing direction when the recording begins, and renormalised at every
/// section. Deterministic: the result depends only on the arguments.
///
/// # Errors
/// A clock that does not advance, a step that does not converge, a run that diverges.
pub fn run_steady(
    system: &System,
    mut state: State,
    settings: &SteadyRunSettings,
    channels: &[Channel],
    perturbation: Option<f64>,
    progress: &mut dyn FnMut(usize) -> ControlFlow<()>,
) -> Result<Option<SteadyRun>, PhysicsError> {
    let rate = phase_rate(settings.trigger, &state);
    let nominal = TAU / rate;
    if !(nominal > 0.0 && nominal.is_finite()) {
        return Err(PhysicsError::SectionClockStopped { speed_rpm: state.spin.speed * 60.0 / TAU });
    }
    let per_period = (nominal / settings.step * (1.0 - 1e-12)).ceil().max(1.0);
    let step = nominal / per_period;
    // Phase in clock periods relative to the section; sections lie at integers.
    let turns = |state: &State| (phase(settings.trigger, state) - settings.phase) / TAU;
    let start = (turns(&state) - ROUND_OFF).ceil();
    let first = start + settings.transient_periods as f64;
    let last = first + settings.periods as f64;
    let perturbed_from = start + (settings.transient_periods / 2) as f64;
    let margin = MARGIN_SAMPLES / per_period;

    system.check_integrator(settings.integrator, &state)?;
    if perturbation.is_some() {
        system.refuse_bodies("a Lyapunov exponent", &state)?;
    }
    let mut stepper = Stepper::new(system, settings.integrator, step);
    let mut perturbed: Option<PerturbedTrajectory> = None;
    let mut run = SteadyRun {
        step,
        phase: Vec::new(),
        shaft_angle: Vec::new(),
        channels: vec![Vec::new(); channels.len()],
        log_growth: Vec::new(),
        intervals: Vec::new(),
        state: state.clone(),
        steps: 0,
    };
    let begin = state.time;
    let (mut last_section, mut last_section_time) = ((turns(&state) + ROUND_OFF).floor(), state.time);
    for count in 1u64.. {
        let at = turns(&state);
        if at >= first - margin {
            run.phase.push(phase(settings.trigger, &state));
            run.shaft_angle.push(state.spin.angle);
            for (channel, values) in channels.iter().zip(&mut run.channels) {
                values.push(channel.read(&state));
            }
        }
        if at > last + margin {
            break;
        }
        if perturbation.is_some_and(|_| perturbed.is_none() && at >= perturbed_from - ROUND_OFF) {
            let displacement = perturbation.unwrap_or_default();
            perturbed =
                Some(PerturbedTrajectory::new(system, &state, settings.integrator, step, displacement));
            last_section_time = state.time;
        }
        let end = begin + count as f64 * step;
        stepper.advance(system, &mut state, step, end, &mut |state, step| match &mut perturbed {
            Some(trajectory) => trajectory.repeat_step(system, state, step),
            None => Ok(()),
        })?;
        check_divergence(system, &state)?;
        let now = (turns(&state) + ROUND_OFF).floor();
        if let Some(trajectory) = &mut perturbed {
            trajectory.sync(&state);
            if now > last_section {
                let growth = trajectory.renormalise(system, &state);
                if now > first && now <= last {
                    run.log_growth.push(growth);
                    run.intervals.push(state.time - last_section_time);
                }
                last_section_time = state.time;
            }
        }
        if now > last_section {
            last_section = now;
            if progress((now - start).max(0.0) as usize).is_break() {
                return Ok(None);
            }
        }
    }
    run.steps = stepper.steps;
    run.state = state;
    Ok(Some(run))
}
