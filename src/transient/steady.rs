//! A run at constant speed: decay of the transient, then recording over whole periods of a clock.

use std::f64::consts::TAU;
use std::ops::ControlFlow;

use super::companion::Companion;
use super::stepper::{Stepper, check};
use super::system::{Channel, State, System};
use crate::error::PhysicsError;
use crate::model::study::{Clock, Steady};

/// Samples recorded before the first and after the last Poincaré section, for interpolation between samples.
const MARGIN: f64 = 3.5;
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
pub fn phase(clock: Clock, state: &State) -> f64 {
    match clock {
        Clock::Shaft => state.spin.angle,
        Clock::Cage { bearing } => state.rotations[bearing].cage_angle,
        Clock::BallPass { bearing, balls } => balls as f64 * state.rotations[bearing].cage_angle,
    }
}

fn phase_rate(clock: Clock, state: &State) -> f64 {
    match clock {
        Clock::Shaft => state.spin.speed,
        Clock::Cage { bearing } => state.rotations[bearing].cage_speed,
        Clock::BallPass { bearing, balls } => balls as f64 * state.rotations[bearing].cage_speed,
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
    settings: &Steady,
    channels: &[Channel],
    perturbation: Option<f64>,
    progress: &mut dyn FnMut(usize) -> ControlFlow<()>,
) -> Result<Option<SteadyRun>, PhysicsError> {
    let rate = phase_rate(settings.clock, &state);
    let nominal = TAU / rate;
    if !(nominal > 0.0 && nominal.is_finite()) {
        return Err(PhysicsError::ClockStandsStill { speed_rpm: state.spin.speed * 60.0 / TAU });
    }
    let per_period = (nominal / settings.step * (1.0 - 1e-12)).ceil().max(1.0);
    let step = nominal / per_period;
    // Phase in clock periods relative to the section; sections lie at integers.
    let turns = |state: &State| (phase(settings.clock, state) - settings.phase) / TAU;
    let start = (turns(&state) - ROUND_OFF).ceil();
    let first = start + settings.settle as f64;
    let last = first + settings.periods as f64;
    let paired = start + (settings.settle / 2) as f64;
    let margin = MARGIN / per_period;

    let mut stepper = Stepper::new(system, settings.integrator, step);
    let mut companion: Option<Companion> = None;
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
    let (mut passed, mut passed_at) = ((turns(&state) + ROUND_OFF).floor(), state.time);
    for count in 1u64.. {
        let at = turns(&state);
        if at >= first - margin {
            run.phase.push(phase(settings.clock, &state));
            run.shaft_angle.push(state.spin.angle);
            for (channel, values) in channels.iter().zip(&mut run.channels) {
                values.push(channel.read(&state));
            }
        }
        if at > last + margin {
            break;
        }
        if perturbation.is_some_and(|_| companion.is_none() && at >= paired - ROUND_OFF) {
            let displacement = perturbation.unwrap_or_default();
            companion = Some(Companion::new(system, &state, settings.integrator, step, displacement));
            passed_at = state.time;
        }
        let end = begin + count as f64 * step;
        stepper.advance(system, &mut state, step, end, &mut |state, step| match &mut companion {
            Some(companion) => companion.follow(system, state, step),
            None => Ok(()),
        })?;
        check(system, &state)?;
        let now = (turns(&state) + ROUND_OFF).floor();
        if let Some(companion) = &mut companion {
            companion.sync(&state);
            if now > passed {
                let growth = companion.renormalise(system, &state);
                if now > first && now <= last {
                    run.log_growth.push(growth);
                    run.intervals.push(state.time - passed_at);
                }
                passed_at = state.time;
            }
        }
        if now > passed {
            passed = now;
            if progress((now - start).max(0.0) as usize).is_break() {
                return Ok(None);
            }
        }
    }
    run.steps = stepper.steps;
    run.state = state;
    Ok(Some(run))
}
