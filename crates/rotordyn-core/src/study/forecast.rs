//! Forecast of the work and the results of the studies of a model, before they start.

use std::f64::consts::TAU;
use std::ops::ControlFlow;
use std::time::Instant;

use super::{Machine, StudyError};
use crate::analysis::campbell::EXTRA_MODES;
use crate::assembly::PhysicsError;
use crate::model::study::{
    BifurcationStudy, CampbellStudy, Continuation, FrfStudy, Integrator, ModalStudy, RunUpStudy,
    SectionTrigger, SpectrogramStudy, SteadyRunSettings, Studies, Sweep, UnbalanceStudy,
};
use crate::model::{BearingSite, Model, Probe, Quantity, ShaftExtent};
use crate::results::Motion;
use crate::transient::reduction::{Reduction, check_size};
use crate::transient::run::{Settings, run};
use crate::transient::system::State;
use rotordyn_linalg::krylov::first_basis;

/// Steps of a measurement of the time per step, and the time after which it ends early \[s\].
const TIMED_STEPS: f64 = 300.0;
const MAX_TIMED_SECONDS: f64 = 0.2;
/// Work below which the time is not measured: it is seconds at most.
const SMALL_STEPS: f64 = 1e6;
const SMALL_SOLUTIONS: f64 = 2000.0;
/// Solutions × degrees of freedom below which the time is not measured either: minutes at most, with the dense matrices of modal
/// damping, where a warning begins at an hour.
const SMALL_UNKNOWNS: f64 = 2e6;
/// Points of a measurement of the time per linear solution.
const TIMED_POINTS: usize = 16;
/// Bytes of a number, and of a complex one.
const REAL: f64 = 8.0;
const COMPLEX: f64 = 16.0;
/// Channels of a run beside the probes: time, angle, speed and eight terms of the energy balance; and per bearing.
const COMMON_CHANNELS: usize = 11;
const BEARING_CHANNELS: usize = 4;
/// Largest size of the frames of a motion: 100 MB of an animation are already hard to show.
const MAX_MOTION_BYTES: f64 = 1e9;
/// Largest size of the mode shapes of a Campbell diagram: of 4000 nodes with 31 speeds and 14 modes, far more than a shaft needs.
const MAX_SHAPES_BYTES: f64 = 500e6;
/// Shapes of a mode: over the free DOFs and over all.
const SHAPES_PER_MODE: usize = 2;

/// Kind of work of a study.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Work {
    /// Integration steps.
    Steps,
    /// Linear solutions: frequencies or speeds.
    Solutions,
    /// Frames of a spectrogram.
    Frames,
}

/// Work and results of one study.
#[derive(Clone, Debug, PartialEq)]
pub struct Forecast {
    /// Name of the command, "run-up".
    pub study: &'static str,
    pub work: Work,
    /// Number of steps, solutions or frames.
    pub count: f64,
    /// Size of its results in the file, uncompressed \[bytes\].
    pub bytes: f64,
    /// Keys of the model file that determine the work.
    pub keys: &'static str,
}

/// Forecasts of the requested studies of a model with `dofs` degrees of freedom, with undivided steps.
fn forecasts(model: &Model, dofs: usize) -> Vec<Forecast> {
    let s = &model.studies;
    let mut found = Vec::new();
    let mut add = |study, work, count: f64, bytes: f64, keys| {
        found.push(Forecast { study, work, count, bytes, keys });
    };
    if let Some(study) = &s.modal {
        let (speeds, modes) = (study.speeds.len() as f64, study.modes.min(2 * dofs) as f64);
        add("modal", Work::Solutions, speeds, COMPLEX * speeds * modes * dofs as f64, "speeds or modes");
    }
    if let Some(study) = &s.campbell {
        let (speeds, modes) = (study.speeds.len() as f64, study.modes.min(2 * dofs) as f64);
        add("campbell", Work::Solutions, speeds, 8.0 * REAL * speeds * modes, "speeds or modes");
    }
    if let Some(study) = &s.frf {
        let lines = study.frequencies.len() as f64;
        let pairs = (study.excitations.len() * study.responses.len()) as f64;
        let solutions = lines * study.excitations.len() as f64;
        add("frf", Work::Solutions, solutions, COMPLEX * lines * pairs, "frequencies");
    }
    if let Some(study) = &s.unbalance {
        let speeds = study.speeds.len() as f64;
        let channels = (study.responses.len() + 2 * model.discs.len()) as f64;
        add("unbalance", Work::Solutions, speeds, COMPLEX * speeds * channels, "speeds");
    }
    if let Some(study) = &s.run_up {
        let (samples, steps) = run_up_work(study, model.profile.duration());
        let free: usize = model.bearings.iter().map(free_channels).sum();
        let channels = COMMON_CHANNELS + model.probes.len() + BEARING_CHANNELS * model.bearings.len() + free;
        let bytes = REAL * samples * channels as f64 + motion_bytes(study, model);
        add("run-up", Work::Steps, steps, bytes, "step, sample_rate, motion_rate or the profile");
        if let Some(spectrogram) = &s.spectrogram {
            let (frames, bytes) = spectrogram_work(spectrogram, study, model);
            add("spectrogram", Work::Frames, frames, bytes, "length or overlap");
        }
        if let Some(orders) = &s.orders {
            let turns = model.profile.curve().at(model.profile.duration()).angle.abs() / TAU;
            let frames = (turns * orders.resolution / (1.0 - orders.overlap)).max(1.0);
            let channels = shown_channels(&orders.channels, model);
            let bytes = REAL * frames * orders.max_order / orders.resolution * channels;
            add("orders", Work::Frames, frames * channels, bytes, "resolution, max_order or overlap");
        }
    }
    steady_forecasts(model, &mut add);
    found
}

fn steady_forecasts(model: &Model, add: &mut impl FnMut(&'static str, Work, f64, f64, &'static str)) {
    const KEYS: &str = "step, periods or transient_periods";
    let s = &model.studies;
    if let Some(study) = &s.poincare {
        let per_period = steps_per_period(model, &study.steady);
        let points = (study.steady.periods as f64 + super::steady_motion::ORBIT_PERIODS as f64 * per_period)
            * 2.0
            * study.planes.len() as f64;
        add("poincare", Work::Steps, steady_steps(model, &study.steady), REAL * points, KEYS);
    }
    if let Some(study) = &s.lyapunov {
        let steps = 2.0 * steady_steps(model, &study.steady);
        add("lyapunov", Work::Steps, steps, 2.0 * REAL * study.steady.periods as f64, KEYS);
    }
    if let Some(study) = &s.bifurcation {
        let runs = bifurcation_runs(study);
        let together = if study.perturbation.is_some() { 2.0 } else { 1.0 };
        let steps = together * runs * steady_steps(model, &study.steady);
        let bytes = REAL * runs * study.steady.periods as f64 * study.channels.len() as f64;
        add(
            "bifurcation",
            Work::Steps,
            steps,
            bytes,
            "step, periods, transient_periods or the number of values",
        );
    }
}

/// Channels of the free bodies of a bearing.
fn free_channels(site: &BearingSite) -> usize {
    site.bearing.element().bodies().map_or(0, |bodies| bodies.channels().len())
}

/// Refuses frames of a run-up's motion, which are in memory during the run, beyond [`MAX_MOTION_BYTES`].
fn check_motion(study: &RunUpStudy, model: &Model) -> Result<(), PhysicsError> {
    let bytes = motion_bytes(study, model);
    if bytes <= MAX_MOTION_BYTES {
        return Ok(());
    }
    let [gigabytes, limit] = [bytes, MAX_MOTION_BYTES].map(|bytes| 1e-9 * bytes);
    Err(PhysicsError::TooManyFrames { frames: motion_frames(study, model), gigabytes, limit })
}

/// Frames of a run-up whose motion is recorded.
fn motion_frames(study: &RunUpStudy, model: &Model) -> f64 {
    let Some(motion) = study.motion else { return 0.0 };
    let duration = (model.profile.duration().min(motion.to) - motion.from).max(0.0);
    let stride = motion.stride(study.sample_rate) as f64;
    (duration * study.sample_rate / stride).floor() + 1.0
}

/// Bytes of these frames.
fn motion_bytes(study: &RunUpStudy, model: &Model) -> f64 {
    let frames = motion_frames(study, model);
    let bodies = |site: &BearingSite| {
        let free = site.bearing.free_balls()?;
        Some(free.ball.geometry.balls + usize::from(free.cage.is_some()))
    };
    frames * Motion::frame_bytes(model.node_count(), model.bearings.iter().filter_map(bodies).sum())
}

/// Samples and steps of a run-up; with error control the steps are at least the samples.
fn run_up_work(study: &RunUpStudy, duration: f64) -> (f64, f64) {
    let samples = (duration * study.sample_rate).floor() + 1.0;
    (samples, samples * equal_steps(study).1)
}

/// Step \[s\] of a run-up and number of steps in a sampling interval.
fn equal_steps(study: &RunUpStudy) -> (f64, f64) {
    let interval = 1.0 / study.sample_rate;
    let number = match study.integrator {
        Integrator::DormandPrince { .. } => 1.0,
        _ => (interval / study.step * (1.0 - 1e-12)).ceil().max(1.0),
    };
    (interval / number, number)
}

fn spectrogram_work(study: &SpectrogramStudy, run: &RunUpStudy, model: &Model) -> (f64, f64) {
    let samples = model.profile.duration() * run.sample_rate;
    let length = study.length * run.sample_rate;
    let hop = (length * (1.0 - study.overlap)).round().max(1.0);
    let frames = ((samples - length) / hop).floor().max(0.0) + 1.0;
    let channels = shown_channels(&study.channels, model);
    let lines = study.max_frequency.min(0.5 * run.sample_rate) * study.length + 1.0;
    (frames * channels, REAL * frames * lines * channels)
}

fn shown_channels(names: &[String], model: &Model) -> f64 {
    let all = |p: &&Probe| {
        matches!(p.quantity, Quantity::Displacement | Quantity::Velocity | Quantity::Acceleration)
    };
    if names.is_empty() { model.probes.iter().filter(all).count() as f64 } else { names.len() as f64 }
}

/// Steps per period of the section's clock, with the cage speed of pure rolling.
pub(crate) fn steps_per_period(model: &Model, steady: &SteadyRunSettings) -> f64 {
    let order = |bearing: usize| {
        let ball = model.bearings.get(bearing).and_then(|site| site.bearing.ball());
        ball.map_or(1.0, |ball| ball.geometry.characteristic_orders(ball.geometry.contact_angle).ftf)
    };
    let turns = match steady.trigger {
        SectionTrigger::Shaft => 1.0,
        SectionTrigger::Cage { bearing } => order(bearing),
        SectionTrigger::BallPass { bearing, balls } => balls as f64 * order(bearing),
    };
    (TAU / (steady.speed * turns * steady.step)).ceil().max(1.0)
}

fn steady_steps(model: &Model, steady: &SteadyRunSettings) -> f64 {
    (steady.transient_periods + steady.periods) as f64 * steps_per_period(model, steady)
}

fn bifurcation_runs(study: &BifurcationStudy) -> f64 {
    let values = study.parameter.values.len() as f64;
    match (study.continuation, study.sweep) {
        (Continuation::PreviousState { chunks, overlap }, sweep) => {
            let directions = if sweep == Sweep::Both { 2.0 } else { 1.0 };
            directions * (values + (chunks.saturating_sub(1) * overlap) as f64)
        }
        (Continuation::Equilibrium, _) => values,
    }
}

impl Machine {
    /// Refuses a study whose matrices would not fit into memory, before anything is computed.
    ///
    /// # Errors
    /// [`PhysicsError::TooLarge`] with what makes the machine so large, [`PhysicsError::TooManyFrames`].
    pub fn check_memory(&self, study: &str) -> Result<(), PhysicsError> {
        match study {
            "run-up" => {
                check_size(&self.assembly)?;
                self.model.studies.run_up.as_ref().map_or(Ok(()), |study| check_motion(study, &self.model))
            }
            "poincare" | "lyapunov" | "bifurcation" => check_size(&self.assembly),
            "campbell" => self.model.studies.campbell.as_ref().map_or(Ok(()), |campbell| {
                // Those of all speeds, and the search at one of them.
                let modes = campbell.modes + EXTRA_MODES;
                let search = first_basis(modes + 1, 2) + SHAPES_PER_MODE * (modes + 1);
                self.check_shapes(study, SHAPES_PER_MODE * campbell.speeds.len() * modes + search)
            }),
            _ => Ok(()),
        }
    }

    /// Refuses more mode shapes in memory together than are allowed.
    fn check_shapes(&self, study: &str, shapes: usize) -> Result<(), PhysicsError> {
        let bytes = COMPLEX * shapes as f64 * self.assembly.dofs.len() as f64;
        if bytes <= MAX_SHAPES_BYTES {
            return Ok(());
        }
        let [megabytes, limit] = [bytes, MAX_SHAPES_BYTES].map(|bytes| 1e-6 * bytes);
        let shaft = ShaftExtent::of(&self.model).to_string();
        Err(PhysicsError::TooManyShapes { study: study.into(), megabytes, limit, shaft })
    }

    /// Forecasts of the requested studies; free balls divide the steps of runs as their contacts need at the start.
    pub fn forecasts(&self) -> Vec<Forecast> {
        let mut found = forecasts(&self.model, self.assembly.dofs.len());
        let has_bodies = |site: &BearingSite| site.bearing.element().bodies().is_some();
        if !self.model.bearings.iter().any(has_bodies) {
            return found;
        }
        for forecast in &mut found {
            // A machine without equilibrium fails in the study itself, with its reason.
            if let Some(Ok(parts)) = self.step_parts(forecast.study) {
                forecast.count *= parts;
            }
        }
        found
    }

    /// Parts into which free balls divide a step at the start of a study's runs; `None` if it has none.
    fn step_parts(&self, study: &str) -> Option<Result<f64, StudyError>> {
        let studies = &self.model.studies;
        let parts = |(reduction, state): (Reduction, State), step: f64| {
            let system = &reduction.system;
            (step / system.structure_step(&state).min(system.body_step(&state))).ceil().max(1.0)
        };
        let of_steady =
            |steady: &SteadyRunSettings| Ok(parts(self.steady_initial_state(steady, None)?, steady.step));
        match study {
            "run-up" => studies.run_up.as_ref().map(|study| {
                let (step, _) = equal_steps(study);
                Ok(parts(self.run_up_start(study)?, step))
            }),
            "poincare" => studies.poincare.as_ref().map(|study| of_steady(&study.steady)),
            "bifurcation" => studies.bifurcation.as_ref().map(|study| of_steady(&study.steady)),
            _ => None,
        }
    }

    /// Estimated computing time of a study on one core \[s\], from a short measurement of one step or solution;
    /// `None` for little work, which is not worth a measurement, or a measurement that fails.
    pub fn estimated_seconds(&self, forecast: &Forecast) -> Option<f64> {
        let small = match forecast.work {
            Work::Steps => SMALL_STEPS,
            Work::Solutions => SMALL_SOLUTIONS,
            Work::Frames => f64::INFINITY,
        };
        let unknowns = forecast.count * self.assembly.dofs.len() as f64;
        if forecast.count < small || (forecast.work == Work::Solutions && unknowns < SMALL_UNKNOWNS) {
            return None;
        }
        let studies = &self.model.studies;
        let per_item = match forecast.study {
            "run-up" => self.run_up_step_time(studies.run_up.as_ref()?),
            "poincare" => self.steady_step_time(&studies.poincare.as_ref()?.steady),
            "lyapunov" => self.steady_step_time(&studies.lyapunov.as_ref()?.steady),
            "bifurcation" => self.steady_step_time(&studies.bifurcation.as_ref()?.steady),
            _ => self.solution_time(forecast.study, studies),
        };
        per_item.ok().map(|seconds| seconds * forecast.count)
    }

    fn run_up_step_time(&self, study: &RunUpStudy) -> Result<f64, StudyError> {
        let (reduction, state) = self.run_up_start(study)?;
        let step = study.step.min(1.0 / study.sample_rate);
        Ok(step_time(&reduction, state, study.integrator, step))
    }

    fn run_up_start(&self, study: &RunUpStudy) -> Result<(Reduction, State), StudyError> {
        let reduction = self.reduce(study)?;
        let x = &reduction.equilibrium * if study.from_equilibrium { 1.0 } else { 0.0 };
        let v = &reduction.equilibrium * 0.0;
        let state = reduction.system.initial_state(x, v)?;
        Ok((reduction, state))
    }

    fn steady_step_time(&self, steady: &SteadyRunSettings) -> Result<f64, StudyError> {
        let (reduction, state) = self.steady_initial_state(steady, None)?;
        Ok(step_time(&reduction, state, steady.integrator, steady.step))
    }

    /// Time of one of the first solutions of a linear study.
    fn solution_time(&self, study: &str, studies: &Studies) -> Result<f64, StudyError> {
        let first = |values: &[f64]| values[..TIMED_POINTS.min(values.len())].to_vec();
        let start = Instant::now();
        let points = match study {
            "modal" => studies.modal.as_ref().map(|s| {
                let speeds = first(&s.speeds);
                self.modal(&ModalStudy { speeds: speeds.clone(), ..s.clone() }).map(|_| speeds.len())
            }),
            "campbell" => studies.campbell.as_ref().map(|s| {
                let speeds = first(&s.speeds);
                self.campbell(&CampbellStudy { speeds: speeds.clone(), ..s.clone() }).map(|_| speeds.len())
            }),
            "frf" => studies.frf.as_ref().map(|s| {
                let frequencies = first(&s.frequencies);
                let points = frequencies.len() * s.excitations.len();
                self.frf(&FrfStudy { frequencies, ..s.clone() }).map(|_| points)
            }),
            _ => studies.unbalance.as_ref().map(|s| {
                let speeds = first(&s.speeds);
                self.unbalance(&UnbalanceStudy { speeds: speeds.clone(), ..s.clone() }).map(|_| speeds.len())
            }),
        };
        let points = points.transpose()?.unwrap_or(1).max(1);
        Ok(start.elapsed().as_secs_f64() / points as f64)
    }
}

/// Measured time of one step at the start of a run.
fn step_time(reduction: &Reduction, state: State, integrator: Integrator, step: f64) -> f64 {
    let settings = Settings {
        integrator,
        step,
        defect_step: f64::INFINITY,
        sample_rate: 1.0 / step,
        duration: TIMED_STEPS * step,
        energy_balance: true,
    };
    let start = Instant::now();
    let report = run(&reduction.system, state, &settings, |_| {
        if start.elapsed().as_secs_f64() > MAX_TIMED_SECONDS {
            ControlFlow::Break(())
        } else {
            ControlFlow::Continue(())
        }
    });
    start.elapsed().as_secs_f64() / report.steps.max(1) as f64
}
