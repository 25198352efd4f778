//! Runs a reduced machine through its speed profile.

use serde::{Deserialize, Serialize};
use std::ops::ControlFlow;

use super::energy::{Energy, EnergyBalance};
use super::stepper::{Stepper, check_divergence};
use super::system::{State, System};
use crate::assembly::PhysicsError;
use crate::model::study::Integrator;

/// Integrator, step and sampling of a run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings {
    pub integrator: Integrator,
    /// Largest step \[s\]; the actual step divides the sampling interval.
    pub step: f64,
    /// Sampling rate \[Hz\].
    pub sample_rate: f64,
    /// Duration of the run \[s\]: to this time, if it starts at t = 0.
    pub duration: f64,
}

/// Data passed to the observer at every sampling instant.
pub struct Sample<'a> {
    pub system: &'a System,
    pub index: usize,
    pub state: &'a State,
    /// Values of the system's channels, in order.
    pub channels: &'a [f64],
    /// Their means over the interval since the sample before, with free bodies; else empty.
    pub means: &'a [f64],
    pub energy: &'a Energy,
}

/// Outcome and cost of a run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Report {
    /// Step used, with free bodies the shortest \[s\]; `None` if error control chose the steps.
    pub step: Option<f64>,
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
    mut state: State,
    settings: &Settings,
    mut observe: impl FnMut(&Sample) -> ControlFlow<()>,
) -> Report {
    let interval = 1.0 / settings.sample_rate;
    let substeps = (interval / settings.step * (1.0 - 1e-12)).ceil().max(1.0) as usize;
    let step = interval / substeps as f64;
    let samples = (settings.duration * settings.sample_rate + 1e-9).floor() as usize;
    let mut stepper = Stepper::new(system, settings.integrator, step);
    let start = state.time;
    let used = (!stepper.is_adaptive()).then_some(step);
    // Error control chooses the steps between two samples.
    let (calls, step) = if stepper.is_adaptive() { (1, interval) } else { (substeps, step) };
    let mut balance = EnergyBalance::new(system, &state);
    let mut channels = vec![0.0; system.channels.len()];
    let mut means = IntervalMeans::new(system, &state);
    let mut report = Report {
        step: used,
        samples: 0,
        steps: 0,
        iterations: 0,
        refactored: 0,
        halvings: 0,
        energy: balance.energy,
        end: End::Complete,
    };
    if let Err(error) = system.check_integrator(settings.integrator, &state) {
        report.end = End::Failed(error);
        return report;
    }
    for index in 0..=samples {
        if index > 0 {
            means.restart();
            let advanced = (0..calls).try_for_each(|k| {
                let end = start + ((index - 1) * calls + k + 1) as f64 * step;
                stepper.advance(system, &mut state, step, end, &mut |state, taken| {
                    finish_step(system, state, &mut balance);
                    means.add(system, state, taken / interval);
                    Ok(())
                })
            });
            if let Err(error) = advanced.and_then(|()| check_divergence(system, &state)) {
                report.end = End::Failed(error);
                break;
            }
        }
        balance.update_stored_energy(system, &state);
        system.read_channels(&state, &mut channels);
        report.samples = index + 1;
        let (channels, means) = (&channels, &means.sums);
        let sample = Sample { system, index, state: &state, channels, means, energy: &balance.energy };
        if observe(&sample).is_break() {
            report.end = End::Stopped;
            break;
        }
    }
    (report.iterations, report.refactored) = stepper.iteration_counts();
    (report.steps, report.halvings) = (stepper.steps, stepper.halvings);
    report.step = report.step.map(|step| step.min(stepper.shortest_step()));
    report.energy = balance.energy;
    report
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
        let size = if system.has_bodies() { system.channels.len() } else { 0 };
        let mut now = vec![0.0; size];
        system.read_channels(state, &mut now);
        Self { sums: now.clone(), before: now.clone(), now }
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
        system.read_channels(state, &mut self.now);
        for ((sum, before), now) in self.sums.iter_mut().zip(&self.before).zip(&self.now) {
            *sum += 0.5 * share * (before + now);
        }
    }
}

fn finish_step(system: &System, state: &mut State, balance: &mut EnergyBalance) {
    balance.update(system, state);
    if let Some(drive) = &system.drive {
        drive.recentre(state);
        balance.restart_from(system, state);
    }
}
