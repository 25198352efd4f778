//! A run at constant speed: decay of the transient, then recording over whole periods of a clock.

use std::f64::consts::TAU;
use std::ops::ControlFlow;

use serde::{Deserialize, Serialize};

use super::channels::Channel;
use super::perturbed_trajectory::{PerturbedSnapshot, PerturbedTrajectory};
use super::stepper::{Stepper, StepperMemory, check_divergence};
use super::system::{State, System};
use crate::assembly::PhysicsError;
use crate::model::study::{SectionTrigger, SteadyRunSettings};

/// Samples recorded before the first and after the last Poincaré section, for interpolation between samples.
const MARGIN_SAMPLES: f64 = 3.5;
/// Round-off of a phase, as a fraction of its period.
const ROUND_OFF: f64 = 1e-9;

/// Result of a run at constant speed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
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
    /// Whole periods recorded; fewer than requested if the run was stopped.
    pub periods: usize,
}

/// Where a run at constant speed begins.
pub enum SteadyStart {
    State(Box<State>),
    Snapshot(Box<SteadySnapshot>),
}

/// A run at constant speed between two steps, complete, with what it has recorded.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SteadySnapshot {
    run: SteadyRun,
    stepper: StepperMemory,
    perturbed: Option<PerturbedSnapshot>,
    times: SectionTimes,
}

impl SteadySnapshot {
    /// Time of the run \[s\].
    pub fn time(&self) -> f64 {
        self.run.state.time
    }

    fn fits(&self, system: &System, settings: &SteadyRunSettings, channels: usize) -> bool {
        let record = &self.run;
        let lengths = record.channels.iter().map(Vec::len).chain([record.shaft_angle.len()]);
        record.state.fits(system)
            && self.stepper.fits(system, settings.integrator)
            && self.perturbed.as_ref().is_none_or(|own| own.fits(system, settings.integrator))
            && record.channels.len() == channels
            && lengths.into_iter().all(|length| length == record.phase.len())
    }
}

/// Sections and times of a run that its start fixes, and those it has passed.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
struct SectionTimes {
    /// Steps per period.
    per_period: f64,
    /// Section at or after the first state, in turns of the clock, and time of that state \[s\].
    start: f64,
    begin: f64,
    /// Steps of the stepper.
    count: u64,
    last_section: f64,
    last_section_time: f64,
}

/// A run at constant speed when a period of its clock has passed.
pub struct SteadyProgress<'a> {
    /// Periods since the start.
    pub periods: usize,
    run: &'a SteadyRun,
    stepper: &'a Stepper,
    perturbed: Option<&'a PerturbedTrajectory>,
    times: SectionTimes,
}

impl SteadyProgress<'_> {
    /// The run at this instant, from which [`run_steady_from`] goes on with the same bits.
    pub fn snapshot(&self) -> SteadySnapshot {
        SteadySnapshot {
            run: self.run.clone(),
            stepper: self.stepper.memory(),
            perturbed: self.perturbed.map(PerturbedTrajectory::snapshot),
            times: self.times,
        }
    }
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
    state: State,
    settings: &SteadyRunSettings,
    channels: &[Channel],
    perturbation: Option<f64>,
    progress: &mut dyn FnMut(usize) -> ControlFlow<()>,
) -> Result<Option<SteadyRun>, PhysicsError> {
    let mut stopped = false;
    let run = run_steady_from(
        system,
        SteadyStart::State(Box::new(state)),
        settings,
        (channels, perturbation),
        &mut |now| {
            let flow = progress(now.periods);
            stopped |= flow.is_break();
            flow
        },
    )?;
    Ok((!stopped).then_some(run))
}

/// As [`run_steady`], from a state or a snapshot of an earlier run, with what is recorded when `progress` stops it.
///
/// From a snapshot the result is that of the run which was never stopped, bit for bit. A run that is stopped has its
/// record to the last whole period, as a run of that many `periods` would.
///
/// # Errors
/// As [`run_steady`], and a snapshot of another system or integrator.
pub fn run_steady_from(
    system: &System,
    start: SteadyStart,
    settings: &SteadyRunSettings,
    (channels, perturbation): (&[Channel], Option<f64>),
    progress: &mut dyn FnMut(&SteadyProgress) -> ControlFlow<()>,
) -> Result<SteadyRun, PhysicsError> {
    // Phase in clock periods relative to the section; sections lie at integers.
    let turns = |state: &State| (phase(settings.trigger, state) - settings.phase) / TAU;
    let integrator = settings.integrator;
    let (mut run, mut stepper, mut perturbed, mut times) = match start {
        SteadyStart::State(state) => {
            let (per_period, step) = steps_of_period(settings, &state)?;
            system.check_integrator(integrator, &state)?;
            if perturbation.is_some() {
                system.refuse_bodies("a Lyapunov exponent", &state)?;
            }
            let times = SectionTimes {
                per_period,
                start: (turns(&state) - ROUND_OFF).ceil(),
                begin: state.time,
                count: 0,
                last_section: (turns(&state) + ROUND_OFF).floor(),
                last_section_time: state.time,
            };
            (
                SteadyRun::new(step, channels.len(), *state),
                Stepper::new(system, integrator, step),
                None,
                times,
            )
        }
        SteadyStart::Snapshot(snapshot) => {
            if !snapshot.fits(system, settings, channels.len()) {
                return Err(PhysicsError::OtherSnapshot { time: snapshot.time() });
            }
            let SteadySnapshot { run, stepper, perturbed, times } = *snapshot;
            let stepper = Stepper::after(system, integrator, &stepper);
            let perturbed = perturbed.map(|own| PerturbedTrajectory::after(system, integrator, own));
            (run, stepper, perturbed, times)
        }
    };
    let step = run.step;
    let first = times.start + settings.transient_periods as f64;
    let mut last = first + settings.periods as f64;
    let perturbed_from = times.start + (settings.transient_periods / 2) as f64;
    let margin = MARGIN_SAMPLES / times.per_period;
    let mut stopped = false;
    loop {
        let at = turns(&run.state);
        if at >= first - margin {
            run.record(phase(settings.trigger, &run.state), channels);
        }
        if at > last + margin {
            break;
        }
        if let Some(displacement) = perturbation
            && perturbed.is_none()
            && at >= perturbed_from - ROUND_OFF
        {
            perturbed = Some(PerturbedTrajectory::new(system, &run.state, integrator, step, displacement));
            times.last_section_time = run.state.time;
        }
        times.count += 1;
        let end = times.begin + times.count as f64 * step;
        stepper.advance(system, &mut run.state, step, end, &mut |state, step| match &mut perturbed {
            Some(trajectory) => trajectory.repeat_step(system, state, step),
            None => Ok(()),
        })?;
        check_divergence(system, &run.state, &stepper)?;
        let now = (turns(&run.state) + ROUND_OFF).floor();
        let passed = now > times.last_section;
        if let Some(trajectory) = &mut perturbed {
            trajectory.sync(&run.state);
            if passed {
                let growth = trajectory.renormalise(system, &run.state);
                if now > first && now <= last {
                    run.log_growth.push(growth);
                    run.intervals.push(run.state.time - times.last_section_time);
                }
                times.last_section_time = run.state.time;
            }
        }
        if passed {
            times.last_section = now;
            let periods = (now - times.start).max(0.0) as usize;
            let perturbed = perturbed.as_ref();
            let instant = SteadyProgress { periods, run: &run, stepper: &stepper, perturbed, times };
            if !stopped && progress(&instant).is_break() {
                stopped = true;
                // The record ends with this period; some samples after it are needed to interpolate the section.
                last = last.min(now);
                if last <= first {
                    break;
                }
            }
        }
    }
    run.periods = (last - first).max(0.0) as usize;
    run.steps = stepper.steps;
    Ok(run)
}

/// Steps of a period of the clock at a state, and their length \[s\].
fn steps_of_period(settings: &SteadyRunSettings, state: &State) -> Result<(f64, f64), PhysicsError> {
    let nominal = TAU / phase_rate(settings.trigger, state);
    if !(nominal > 0.0 && nominal.is_finite()) {
        return Err(PhysicsError::SectionClockStopped { speed_rpm: state.spin.speed * 60.0 / TAU });
    }
    let per_period = (nominal / settings.step * (1.0 - 1e-12)).ceil().max(1.0);
    Ok((per_period, nominal / per_period))
}

impl SteadyRun {
    /// A run at its start, without samples.
    fn new(step: f64, channels: usize, state: State) -> Self {
        Self {
            step,
            phase: Vec::new(),
            shaft_angle: Vec::new(),
            channels: vec![Vec::new(); channels],
            log_growth: Vec::new(),
            intervals: Vec::new(),
            state,
            steps: 0,
            periods: 0,
        }
    }

    fn record(&mut self, phase: f64, channels: &[Channel]) {
        self.phase.push(phase);
        self.shaft_angle.push(self.state.spin.angle);
        for (channel, values) in channels.iter().zip(&mut self.channels) {
            values.push(channel.read(self.state.motion()));
        }
    }
}
