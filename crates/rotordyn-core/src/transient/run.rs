//! Runs a reduced machine through its speed profile.

use serde::{Deserialize, Serialize};
use std::ops::ControlFlow;

use super::channels::Channel;
use super::defect_steps::{DefectSteps, Vibration};
use super::energy::{Energy, EnergyBalance};
use super::stepper::{Stepper, StepperMemory, check_divergence};
use super::system::{State, System};
use crate::assembly::PhysicsError;
use crate::model::Quantity;
use crate::model::study::Integrator;

/// Integrator, step and sampling of a run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings {
    pub integrator: Integrator,
    /// Largest step \[s\]; the actual step divides the sampling interval.
    pub step: f64,
    /// Largest step while a rolling element is on a local defect, and shortly after \[s\]; infinite: as all the others. Not
    /// under error control.
    pub defect_step: f64,
    /// Sampling rate \[Hz\].
    pub sample_rate: f64,
    /// Duration of the run \[s\]: to this time, if it starts at t = 0.
    pub duration: f64,
    /// Whether to follow the energy balance; else the energies given are those at the start.
    pub energy_balance: bool,
}

/// Data passed to the observer at every sampling instant.
pub struct Sample<'a> {
    pub system: &'a System,
    pub index: usize,
    pub state: &'a State,
    /// Values of the system's channels, in order.
    pub channels: &'a [f64],
    /// The same at the equal steps since the sample before, one step after the other, this instant last; this instant alone
    /// at the first sample and under error control.
    pub steps: &'a [f64],
    /// Number of these steps in a sampling interval; 1 under error control.
    pub steps_per_sample: usize,
    /// The same within those of these steps that were divided.
    pub divided: Divided<'a>,
    /// Their means over the interval since the sample before, with free bodies; else empty.
    pub means: &'a [f64],
    pub energy: &'a Energy,
    run: RunParts<'a>,
}

/// Channels within the divided steps of a sampling interval.
#[derive(Clone, Copy)]
pub struct Divided<'a> {
    /// Number of equal parts of a divided step; 1 if no step of the run is divided.
    pub parts: usize,
    /// Which steps of the interval were divided.
    pub is_divided: &'a [bool],
    /// Values of the channels at the end of every part of these steps, one after the other.
    pub values: &'a [f64],
    /// Jumps where the length of the steps changes.
    pub jumps: &'a [Jump],
}

/// What a step of another length changes at its start.
#[derive(Clone, Debug, PartialEq)]
pub struct Jump {
    /// Index of the step in the sampling interval.
    pub step: usize,
    /// What the integral of every channel over time lacks by the trapezoidal rule, for an acceleration the change of velocity,
    /// over the length of a part.
    pub means: Vec<f64>,
}

/// What a snapshot takes from a run beside its state.
#[derive(Clone, Copy)]
struct RunParts<'a> {
    start: f64,
    last: usize,
    stepper: &'a Stepper,
    defects: &'a DefectSteps,
    balance: &'a EnergyBalance,
    means: &'a IntervalMeans,
}

impl Sample<'_> {
    /// Whether it is the last one of the run.
    pub fn is_last(&self) -> bool {
        self.index == self.run.last
    }

    /// The run at this sample, from which [`resume`] goes on with the same bits.
    pub fn snapshot(&self) -> RunSnapshot {
        RunSnapshot {
            index: self.index,
            start: self.run.start,
            state: self.state.clone(),
            stepper: self.run.stepper.memory(),
            vibration: self.run.defects.vibration(),
            balance: self.run.balance.clone(),
            channels: self.run.means.now.clone(),
        }
    }
}

/// A run at a sampling instant, complete: state, memory of the integrator, energy balance.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct RunSnapshot {
    index: usize,
    /// Time of the first sample \[s\].
    start: f64,
    state: State,
    stepper: StepperMemory,
    /// That around the last passage over a local defect.
    vibration: Vibration,
    balance: EnergyBalance,
    /// Channels at the last step, with free bodies.
    channels: Vec<f64>,
}

impl RunSnapshot {
    /// Index of its sample; the run goes on with the next one.
    pub fn index(&self) -> usize {
        self.index
    }

    /// Time of its sample \[s\].
    pub fn time(&self) -> f64 {
        self.state.time
    }

    /// Speed at its sample \[rad/s\].
    pub fn speed(&self) -> f64 {
        self.state.spin.speed
    }

    fn fits(&self, system: &System, integrator: Integrator) -> bool {
        let means = if system.has_bodies() { system.channels.list().len() } else { 0 };
        self.state.fits(system)
            && self.stepper.fits(system, integrator)
            && self.balance.fits(system)
            && self.channels.len() == means
    }
}

/// Outcome and cost of a run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Report {
    /// Step used, with free bodies the shortest \[s\]; `None` if error control chose the steps.
    pub step: Option<f64>,
    /// Length of the parts of steps that were divided on local defects \[s\]; `None` if no step is.
    pub defect_step: Option<f64>,
    pub samples: usize,
    pub steps: u64,
    /// Newton iterations of an implicit run.
    pub iterations: u64,
    /// Effective matrices inverted by an implicit run.
    pub refactored: u64,
    /// Steps that were halved (implicit) or rejected by error control (explicit).
    pub halvings: u64,
    pub energy: Energy,
    pub end: End,
}

impl Report {
    /// Report of a run without initial state.
    pub fn not_started(error: PhysicsError) -> Self {
        Self {
            step: None,
            defect_step: None,
            samples: 0,
            steps: 0,
            iterations: 0,
            refactored: 0,
            halvings: 0,
            energy: Energy::default(),
            end: End::Failed(error),
        }
    }
}

/// Why a run ended.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum End {
    Complete,
    /// Stopped by the observer (Ctrl-C).
    Stopped,
    /// Failed; the samples before remain valid.
    Failed(PhysicsError),
}

/// Runs `system` from `state`, calling `observe` at its time and every sampling instant after it.
///
/// A step that does not converge is halved; a run that fails ends with [`End::Failed`] after all earlier
/// samples have been observed. Deterministic: the result depends only on the arguments.
pub fn run(
    system: &System,
    state: State,
    settings: &Settings,
    observe: impl FnMut(&Sample) -> ControlFlow<()>,
) -> Report {
    let grid = Grid::new(settings);
    let run = Run {
        start: state.time,
        stepper: Stepper::new(system, settings.integrator, grid.step).end_below_step_error(),
        defects: DefectSteps::new(system, grid.step, settings.defect_step, Vibration::default()),
        balance: EnergyBalance::new(system, &state),
        follows_energy: settings.energy_balance,
        means: IntervalMeans::new(system, &state),
        state,
    };
    if let Err(error) = system.check_integrator(settings.integrator, &run.state) {
        return Report { energy: run.balance.energy, step: run.step(&grid), ..Report::not_started(error) };
    }
    run.perform(system, &grid, 0, observe)
}

/// Goes on with a run after the sample of a snapshot, in the same bits as the run that was never stopped.
///
/// `system` and `settings` are those of the run; `observe` gets the samples after that of the snapshot, and the report
/// is that of the whole run. A snapshot of another system or integrator ends with [`PhysicsError::OtherSnapshot`].
pub fn resume(
    system: &System,
    snapshot: RunSnapshot,
    settings: &Settings,
    observe: impl FnMut(&Sample) -> ControlFlow<()>,
) -> Report {
    if !snapshot.fits(system, settings.integrator) {
        return Report::not_started(PhysicsError::OtherSnapshot { time: snapshot.time() });
    }
    let RunSnapshot { index, start, state, stepper, vibration, balance, channels } = snapshot;
    let grid = Grid::new(settings);
    let defects = DefectSteps::new(system, grid.step, settings.defect_step, vibration);
    let stepper = Stepper::after(system, settings.integrator, &stepper).end_below_step_error();
    let means = IntervalMeans::after(channels);
    let follows_energy = settings.energy_balance;
    let run = Run { start, state, stepper, defects, balance, follows_energy, means };
    run.perform(system, &grid, index + 1, observe)
}

/// Times of a run: `calls` of the stepper of length `step` between two samples.
struct Grid {
    interval: f64,
    calls: usize,
    step: f64,
    /// Index of the last sample.
    samples: usize,
}

impl Grid {
    fn new(settings: &Settings) -> Self {
        let interval = 1.0 / settings.sample_rate;
        let substeps = (interval / settings.step * (1.0 - 1e-12)).ceil().max(1.0) as usize;
        let samples = (settings.duration * settings.sample_rate + 1e-9).floor() as usize;
        Self { interval, calls: substeps, step: interval / substeps as f64, samples }
    }
}

/// A run between two samples.
struct Run {
    /// Time of the first sample \[s\].
    start: f64,
    state: State,
    stepper: Stepper,
    defects: DefectSteps,
    balance: EnergyBalance,
    follows_energy: bool,
    means: IntervalMeans,
}

/// Channels in a sampling interval: at the end of every step, and of every part of the divided ones.
#[derive(Default)]
struct IntervalChannels {
    steps: Vec<f64>,
    is_divided: Vec<bool>,
    parts: Vec<f64>,
    jumps: Vec<Jump>,
}

impl IntervalChannels {
    fn clear(&mut self) {
        self.steps.clear();
        self.is_divided.clear();
        self.parts.clear();
        self.jumps.clear();
    }
}

impl Run {
    /// Step reported before free bodies divide it; `None` if error control chooses it.
    fn step(&self, grid: &Grid) -> Option<f64> {
        (!self.stepper.is_adaptive()).then_some(grid.step)
    }

    /// Runs to the samples from the index `from` on and observes them.
    fn perform(
        mut self,
        system: &System,
        grid: &Grid,
        from: usize,
        mut observe: impl FnMut(&Sample) -> ControlFlow<()>,
    ) -> Report {
        let mut interval = IntervalChannels::default();
        let (mut seen, mut end) = (from, End::Complete);
        // Of the last sample: of a step that fails some energies are added up and others are not.
        let mut energy = self.balance.energy;
        for index in from..=grid.samples {
            interval.clear();
            if index == 0 {
                system.channels.read(self.state.motion(), &mut interval.steps);
            } else if let Err(error) = self.advance(system, grid, index, &mut interval) {
                end = End::Failed(error);
                break;
            }
            if self.follows_energy {
                self.balance.update_stored_energy(system, &self.state);
            }
            energy = self.balance.energy;
            seen = index + 1;
            let Self { start, state, stepper, defects, balance, means, .. } = &self;
            let run = RunParts { start: *start, last: grid.samples, stepper, defects, balance, means };
            let IntervalChannels { steps, is_divided, parts, jumps } = &interval;
            let sample = Sample {
                system,
                index,
                state,
                channels: &steps[steps.len() - system.channels.list().len()..],
                steps,
                steps_per_sample: if stepper.is_adaptive() { 1 } else { grid.calls },
                divided: Divided { parts: defects.parts(), is_divided, values: parts, jumps },
                means: &means.sums,
                energy: &balance.energy,
                run,
            };
            if observe(&sample).is_break() {
                end = End::Stopped;
                break;
            }
        }
        let (iterations, refactored) = self.stepper.iteration_counts();
        let parts = self.defects.parts();
        Report {
            step: self.step(grid).map(|step| step.min(self.stepper.shortest_step())),
            defect_step: self.step(grid).filter(|_| parts > 1).map(|step| step / parts as f64),
            samples: seen,
            steps: self.stepper.steps,
            iterations,
            refactored,
            halvings: self.stepper.halvings,
            energy,
            end,
        }
    }

    /// Steps from the sample before to the one at `index`, with their channels.
    fn advance(
        &mut self,
        system: &System,
        grid: &Grid,
        index: usize,
        channels: &mut IntervalChannels,
    ) -> Result<(), PhysicsError> {
        let Self { start, state, stepper, defects, balance, follows_energy, means } = self;
        // Error control chooses the steps between two samples.
        let is_adaptive = stepper.is_adaptive();
        let (calls, step) = if is_adaptive { (1, grid.interval) } else { (grid.calls, grid.step) };
        means.restart();
        for k in 0..calls {
            let (parts, last) = if is_adaptive { (1, None) } else { defects.divide(system, state, step) };
            let part = step / parts as f64;
            if let Some(last) = last {
                let impulses = change_step(system, state, stepper, [step / last as f64, part]);
                let shortest = step / defects.parts() as f64;
                let means = impulses.into_iter().map(|impulse| impulse / shortest).collect();
                channels.jumps.push(Jump { step: k, means });
            }
            let steps_before = ((index - 1) * calls + k) as f64;
            for p in 1..=parts {
                let end = *start + (steps_before + p as f64 / parts as f64) * step;
                stepper.advance(system, state, part, end, &mut |state, taken| {
                    if *follows_energy {
                        balance.update(system, state);
                    }
                    if let Some(drive) = &system.drive {
                        drive.recentre(state);
                        if *follows_energy {
                            balance.restart_from(system, state);
                        }
                    }
                    means.add(system, state, taken / grid.interval);
                    Ok(())
                })?;
                if parts > 1 {
                    system.channels.read(state.motion(), &mut channels.parts);
                }
            }
            system.channels.read(state.motion(), &mut channels.steps);
            channels.is_divided.push(parts > 1);
        }
        check_divergence(system, state, stepper)
    }
}

/// Prepares a state for steps of another length; of every channel, what its integral over time lacks by the trapezoidal rule.
///
/// Velocities and accelerations may jump, from v₀ to v₁ and from a₀ to a₁. A step of length h changes the velocity by the mean of
/// its accelerations plus h (γ − ½) of their change, which adds up to nothing but where h changes from h₀ to h₁: together
/// v₁ − v₀ + ½ h₁ (a₁ − a₀) + (γ − ½)(h₀ a₀ − h₁ a₁) for an acceleration, ½ h₁ (v₁ − v₀) + (β − ½γ)(h₀² a₀ − h₁² a₁) for a velocity.
fn change_step(system: &System, state: &mut State, stepper: &Stepper, [h0, h1]: [f64; 2]) -> Vec<f64> {
    let channels = system.channels.list();
    let read = |state: &State| -> Vec<[f64; 2]> {
        channels.iter().map(|channel| channel.velocity_and_acceleration(state.motion())).collect()
    };
    let before = read(state);
    stepper.fit_inertias(system, state, h1);
    let after = read(state);
    let [gamma, beta] = stepper.distance_from_trapezoidal_rule();
    let impulse = |(channel, ([v0, a0], [v1, a1])): (&Channel, ([f64; 2], [f64; 2]))| match channel.quantity {
        Quantity::Displacement => 0.0,
        Quantity::Velocity => 0.5 * h1 * (v1 - v0) + beta * (h0 * h0 * a0 - h1 * h1 * a1),
        Quantity::Acceleration => v1 - v0 + 0.5 * h1 * (a1 - a0) + gamma * (h0 * a0 - h1 * a1),
    };
    channels.iter().zip(before.into_iter().zip(after)).map(impulse).collect()
}

/// Means of the channels over a sampling interval, by the trapezoidal rule over the steps.
///
/// Collisions of free bodies vibrate at tens of kHz, which samples alone would fold into the band of the record.
struct IntervalMeans {
    sums: Vec<f64>,
    before: Vec<f64>,
    now: Vec<f64>,
}

impl IntervalMeans {
    /// At the start, where they are the values; nothing without free bodies.
    fn new(system: &System, state: &State) -> Self {
        let mut now = Vec::new();
        if system.has_bodies() {
            system.channels.read(state.motion(), &mut now);
        }
        Self { sums: now.clone(), before: now.clone(), now }
    }

    /// After a sample, at whose step the channels had the values `now`.
    fn after(now: Vec<f64>) -> Self {
        Self { sums: vec![0.0; now.len()], before: now.clone(), now }
    }

    fn restart(&mut self) {
        self.sums.fill(0.0);
    }

    /// Adds a step that took a share of the interval.
    fn add(&mut self, system: &System, state: &State, share: f64) {
        if self.sums.is_empty() {
            return;
        }
        std::mem::swap(&mut self.before, &mut self.now);
        self.now.clear();
        system.channels.read(state.motion(), &mut self.now);
        for ((sum, before), now) in self.sums.iter_mut().zip(&self.before).zip(&self.now) {
            *sum += 0.5 * share * (before + now);
        }
    }
}
