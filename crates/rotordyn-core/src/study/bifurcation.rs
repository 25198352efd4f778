//! Bifurcation diagrams: Poincaré sections over a parameter, with or without continuation, on all cores.

use std::collections::BTreeMap;
use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};

use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use super::milestone::Milestone;
use super::settled_run::{Criteria, SettledRun, SettledSnapshot, SettledStart};
use super::steady_motion::{RestartState, clock_name, section_channel};
use super::{Machine, StudyError};
use crate::analysis::ball_inertia::decided_together;
use crate::model::Model;
use crate::model::study::{BifurcationStudy, Continuation, Sweep};
use crate::results::{BifurcationPoint, BifurcationResult, BifurcationSweep, SteadyMotion};

/// Largest difference of sections and extremes of runs on the same branch, as a fraction of the orbit.
const SAME_BRANCH: f64 = 0.05;

/// Reason for a value not computed because the study was stopped.
const STOPPED: &str = "stopped";

/// Result of one parameter value, and the restart state of its run.
type Outcome = (Result<SteadyMotion, String>, Option<RestartState>);

/// Values of a bifurcation diagram finished so far, with the restart states of their runs.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub struct FinishedValues {
    chunks: BTreeMap<ChunkName, Vec<Outcome>>,
}

impl FinishedValues {
    /// Number of finished runs.
    pub fn len(&self) -> usize {
        self.chunks.values().map(Vec::len).sum()
    }

    /// Whether no run is finished.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }
}

/// A chunk of a sweep: name of the sweep, first and last step with those before the seam, and whether it is rerun from
/// the final state of the chunk before.
type ChunkName = (String, usize, usize, bool);

/// How far a bifurcation diagram is.
pub struct BifurcationProgress<'a> {
    /// Completed runs, those of an earlier run included.
    pub done: usize,
    /// Planned runs; a chunk that is rerun adds to them.
    pub planned: usize,
    finished: &'a Mutex<FinishedValues>,
}

impl BifurcationProgress<'_> {
    /// The finished values, from which [`bifurcation_from`] goes on to the same bits.
    pub fn snapshot(&self) -> FinishedValues {
        self.finished.lock().unwrap_or_else(PoisonError::into_inner).clone()
    }
}

/// Bifurcation diagram of a family of machines, one model per value of the study's parameter.
///
/// Every model has its own copy of the study (the parameter may be one of its settings, such as its speed).
/// From equilibrium all values are independent. With continuation (restart from the previous value's final
/// state) each sweep is divided into the study's number of chunks, independent of the number of threads; a
/// chunk starts from equilibrium `overlap` values early. The value before a seam is then computed by both
/// chunks: if these are not on the same branch, the chunk is rerun from the final state of the previous one.
/// The diagram equals that of one uninterrupted sweep on any number of cores. `progress` gets the numbers of
/// completed and planned runs (a rerun adds to the latter); when it breaks, the values completed by then are
/// returned.
///
/// # Errors
/// No model, a model without the study, or no value with a steady motion: the reason of the first value.
pub fn bifurcation(
    models: &[Model],
    progress: &(dyn Fn(usize, usize) -> ControlFlow<()> + Sync),
) -> Result<BifurcationResult, StudyError> {
    bifurcation_from(models, FinishedValues::default(), &|now| progress(now.done, now.planned))
}

/// As [`bifurcation`], with the values that an earlier run has finished: these are not computed again, and the diagram
/// is that of a run which was never stopped.
///
/// # Errors
/// As [`bifurcation`].
pub fn bifurcation_from(
    models: &[Model],
    finished: FinishedValues,
    progress: &(dyn Fn(&BifurcationProgress) -> ControlFlow<()> + Sync),
) -> Result<BifurcationResult, StudyError> {
    let study = models.first().and_then(|m| m.studies.bifurcation.as_ref()).ok_or(StudyError::Signal(
        rotordyn_signal::SignalError::Empty { name: "list of models with a bifurcation study" },
    ))?;
    let speeds: Vec<f64> = models
        .iter()
        .map(|model| model.studies.bifurcation.as_ref().map_or(0.0, |study| study.steady.speed))
        .collect();
    let models = &decided_together(models, &speeds)[..];
    let n = models.len();
    let directions: &[&'static str] = match (study.continuation, study.sweep) {
        (Continuation::Equilibrium, _) => &["from equilibrium"],
        (_, Sweep::Up) => &["up"],
        (_, Sweep::Down) => &["down"],
        (_, Sweep::Both) => &["up", "down"],
    };
    let (chunks, overlap) = match study.continuation {
        Continuation::Equilibrium => (n, 0),
        Continuation::PreviousState { chunks, overlap } => (chunks.clamp(1, n), overlap),
    };
    // Boundaries of the chunks along a sweep.
    let bounds: Vec<[usize; 2]> = (0..chunks).map(|c| [c * n / chunks, (c + 1) * n / chunks]).collect();
    let early = |start: usize| overlap.min(start);
    let runs: usize = bounds.iter().map(|[a, b]| b - a + early(*a)).sum();
    let work = ChunkRunner {
        models,
        progress,
        done: AtomicUsize::new(0),
        finished: Mutex::new(finished),
        stopped: AtomicBool::new(false),
        planned: AtomicUsize::new(runs * directions.len()),
    };
    let tasks: Vec<(&'static str, [usize; 2])> =
        directions.iter().flat_map(|d| bounds.iter().map(move |b| (*d, *b))).collect();
    let restart = study.continuation != Continuation::Equilibrium;
    let found: Vec<Vec<Outcome>> = tasks
        .par_iter()
        .map(|(direction, [a, b])| work.run_chunk(direction, [a - early(*a), *b], None, restart))
        .collect();
    let joined: Vec<(Vec<Outcome>, usize)> = directions
        .par_iter()
        .zip(found.into_par_iter().chunks(chunks))
        .map(|(direction, parts)| work.join_chunks(direction, &bounds, overlap, parts))
        .collect();

    let repaired = joined.iter().map(|(_, repaired)| repaired).sum();
    let values = &study.parameter.values;
    let sweep = |(name, outcomes): (&'static str, Vec<Outcome>)| {
        let point = |(step, (found, _)): (usize, Outcome)| BifurcationPoint {
            value: values[value_index(name, step, n)],
            motion: found,
        };
        BifurcationSweep { name: name.into(), points: outcomes.into_iter().enumerate().map(point).collect() }
    };
    let sweeps: Vec<BifurcationSweep> =
        directions.iter().copied().zip(joined.into_iter().map(|(o, _)| o)).map(sweep).collect();
    let all = || sweeps.iter().flat_map(|s| &s.points);
    if all().all(|p| p.motion.is_err())
        && let Some(Err(reason)) = all().next().map(|p| &p.motion)
    {
        return Err(crate::assembly::PhysicsError::NoSteadyMotion { reason: reason.clone() }.into());
    }
    let complete = !all().any(|p| p.motion.as_ref().is_err_and(|reason| reason == STOPPED));
    Ok(BifurcationResult {
        complete,
        parameter: study.parameter.clone(),
        clock: clock_name(&models[0], study.steady.trigger),
        channels: study.channels.iter().map(section_channel).collect(),
        seams: if restart { (chunks - 1) * directions.len() } else { 0 },
        rerun_chunks: repaired,
        sweeps,
    })
}

/// Index of the parameter value at a step of a sweep.
fn value_index(direction: &str, step: usize, n: usize) -> usize {
    if direction == "down" { n - 1 - step } else { step }
}

/// Data shared by all chunks.
struct ChunkRunner<'a> {
    models: &'a [Model],
    progress: &'a (dyn Fn(&BifurcationProgress) -> ControlFlow<()> + Sync),
    done: AtomicUsize,
    planned: AtomicUsize,
    finished: Mutex<FinishedValues>,
    stopped: AtomicBool,
}

impl ChunkRunner<'_> {
    /// Runs the values of one chunk in sequence, each restarted from the final state of the previous one.
    fn run_chunk(
        &self,
        direction: &str,
        [from, to]: [usize; 2],
        start: Option<RestartState>,
        carry: bool,
    ) -> Vec<Outcome> {
        let name: ChunkName = (direction.to_string(), from, to, start.is_some());
        let known = |found: &FinishedValues| found.chunks.get(&name).cloned().unwrap_or_default();
        let mut outcomes = known(&self.finished());
        outcomes.truncate(to - from);
        self.done.fetch_add(outcomes.len(), Ordering::Relaxed);
        let mut carried = start;
        if let Some((_, state)) = outcomes.last() {
            carried = state.clone().filter(|_| carry);
        }
        for step in from + outcomes.len()..to {
            let model = &self.models[value_index(direction, step, self.models.len())];
            let outcome = self.run_value(model, carried.as_ref());
            // After a failed value the next one starts from equilibrium.
            carried = outcome.1.clone().filter(|_| carry);
            if !matches!(&outcome.0, Err(reason) if reason == STOPPED) {
                self.finished().chunks.entry(name.clone()).or_default().push(outcome.clone());
            }
            outcomes.push(outcome);
        }
        outcomes
    }

    fn finished(&self) -> MutexGuard<'_, FinishedValues> {
        self.finished.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn run_value(&self, model: &Model, carried: Option<&RestartState>) -> Outcome {
        let report_progress = || {
            let (done, planned) = (self.done.load(Ordering::Relaxed), self.planned.load(Ordering::Relaxed));
            // Once stopped it stays so: what follows would start from another state than it should.
            if self.stopped.load(Ordering::Relaxed) {
                return ControlFlow::Break(());
            }
            let flow = (self.progress)(&BifurcationProgress { done, planned, finished: &self.finished });
            self.stopped.fetch_or(flow.is_break(), Ordering::Relaxed);
            flow
        };
        let outcome = match &model.studies.bifurcation {
            _ if report_progress().is_break() => (Err(STOPPED.to_string()), None),
            None => (Err("the model has no bifurcation study".to_string()), None),
            Some(study) => match steady_motion(model, study, carried, &mut |_| report_progress()) {
                Ok(Some((found, state))) => (Ok(found), Some(state)),
                Ok(None) => (Err(STOPPED.to_string()), None),
                Err(error) => (Err(error.to_string()), None),
            },
        };
        self.done.fetch_add(1, Ordering::Relaxed);
        outcome
    }

    /// Joins the chunks of a sweep, rerunning those that start on another branch than the previous chunk
    /// ended on.
    fn join_chunks(
        &self,
        direction: &str,
        bounds: &[[usize; 2]],
        overlap: usize,
        parts: Vec<Vec<Outcome>>,
    ) -> (Vec<Outcome>, usize) {
        let mut whole: Vec<Outcome> = Vec::new();
        let mut repaired = 0;
        for (mut part, &[from, to]) in parts.into_iter().zip(bounds) {
            let early = overlap.min(from);
            if let (Some(before), Some(at_seam)) = (whole.last(), part[..early].last())
                && let (Ok(a), Ok(b), Some(state)) = (&before.0, &at_seam.0, &before.1)
                && !same_branch(a, b)
            {
                repaired += 1;
                self.planned.fetch_add(to - from, Ordering::Relaxed);
                part = self.run_chunk(direction, [from, to], Some(state.clone()), true);
            } else {
                part.drain(..early);
            }
            whole.append(&mut part);
        }
        (whole, repaired)
    }
}

/// The steady motion of one model.
fn steady_motion(
    model: &Model,
    study: &BifurcationStudy,
    carried: Option<&RestartState>,
    progress: super::steady_motion::Progress,
) -> Result<Option<(SteadyMotion, RestartState)>, StudyError> {
    let machine = Machine::new(model.clone())?;
    let (reduction, state) = machine.steady_initial_state(&study.steady, carried)?;
    let probes: Vec<_> = study.channels.iter().collect();
    let channels: Vec<_> = study.channels.iter().map(section_channel).collect();
    let criteria = Criteria {
        tolerance: study.tolerance,
        longest_period: study.longest_period,
        perturbation: study.perturbation,
    };
    let shown = (&probes[..], &channels[..]);
    let start = SettledStart::State(Box::new(state));
    let observe = &mut |now: &Milestone<SettledSnapshot>| progress(now.share);
    let settled = machine.settled_run(&reduction, start, &study.steady, shown, criteria, observe)?;
    let Some(SettledRun { run, motion, complete: true, .. }) = settled else { return Ok(None) };
    Ok(Some((motion, RestartState::new(&reduction, &run.state))))
}

/// Whether two motions are on the same branch: every section point of one has a near point of the other, and
/// the extremes agree.
fn same_branch(a: &SteadyMotion, b: &SteadyMotion) -> bool {
    let sizes: Vec<f64> = a
        .extremes
        .iter()
        .zip(&b.extremes)
        .map(|(p, q)| SAME_BRANCH * (p[1].max(q[1]) - p[0].min(q[0])))
        .collect();
    let reach = |k: usize| (0..2).all(|e| (a.extremes[k][e] - b.extremes[k][e]).abs() <= sizes[k]);
    let near = |a: &[Vec<f64>], i: usize, b: &[Vec<f64>], j: usize| {
        a.iter().zip(b).zip(&sizes).all(|((a, b), size)| (a[i] - b[j]).abs() <= *size)
    };
    let points = |m: &SteadyMotion| m.sections.first().map_or(0, Vec::len);
    let covers = |a: &SteadyMotion, b: &SteadyMotion| {
        (0..points(a)).all(|i| (0..points(b)).any(|j| near(&a.sections, i, &b.sections, j)))
    };
    (0..sizes.len()).all(reach) && covers(a, b) && covers(b, a)
}
