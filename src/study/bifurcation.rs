//! Bifurcation diagrams: one machine after the other along a parameter, on every core.

use std::ops::ControlFlow;
use std::sync::atomic::{AtomicUsize, Ordering};

use rayon::prelude::*;

use super::Machine;
use super::attractor::{CarriedState, clock_name, described, sections};
use crate::error::Error;
use crate::model::Model;
use crate::model::study::{BifurcationStudy, Continuation, Sweep};
use crate::results::{BifurcationPoint, BifurcationResult, BifurcationSweep, SteadyMotion};

/// Two runs are on the same branch when their sections and extremes differ by less than this share of the orbit.
const SAME_BRANCH: f64 = 0.05;

/// Said of a value that was not come to because the work was stopped.
const STOPPED: &str = "stopped";

/// What one value gave, and where the run ended.
type Outcome = (Result<SteadyMotion, String>, Option<CarriedState>);

/// The motions of a family of machines, one model per value of the study's parameter.
///
/// Every model carries its own copy of the study (the parameter may be one of its settings, such as its speed).
/// From equilibrium all values are independent. With the state carried over, each sweep is cut into the study's number
/// of chunks, whatever the number of threads; a chunk starts from equilibrium `overlap` values early. The value before
/// a seam is then known from both sides: where the two runs are not on the same branch, the chunk is run again from
/// where the one before it ended. The diagram is that of one uninterrupted sweep, and the same on any number of cores.
/// `progress` is told the runs done and the runs to do (a chunk run again adds to those); when it breaks, what is done
/// by then is returned.
///
/// # Errors
/// No model, a model without the study, or not one value with a motion: the first one's reason.
pub fn bifurcation(
    models: &[Model],
    progress: &(dyn Fn(usize, usize) -> ControlFlow<()> + Sync),
) -> Result<BifurcationResult, Error> {
    let study = models.first().and_then(|m| m.studies.bifurcation.as_ref()).ok_or(Error::Signal(
        crate::signal::SignalError::Empty { name: "list of models with a bifurcation study" },
    ))?;
    let n = models.len();
    let directions: &[&'static str] = match (study.continuation, study.sweep) {
        (Continuation::Equilibrium, _) => &["from equilibrium"],
        (_, Sweep::Up) => &["up"],
        (_, Sweep::Down) => &["down"],
        (_, Sweep::Both) => &["up", "down"],
    };
    let (chunks, overlap) = match study.continuation {
        Continuation::Equilibrium => (n, 0),
        Continuation::Carried { chunks, overlap } => (chunks.clamp(1, n), overlap),
    };
    // Boundaries of the chunks along a sweep.
    let bounds: Vec<[usize; 2]> = (0..chunks).map(|c| [c * n / chunks, (c + 1) * n / chunks]).collect();
    let early = |start: usize| overlap.min(start);
    let runs: usize = bounds.iter().map(|[a, b]| b - a + early(*a)).sum();
    let work = Work {
        models,
        progress,
        done: AtomicUsize::new(0),
        planned: AtomicUsize::new(runs * directions.len()),
    };
    let tasks: Vec<(&'static str, [usize; 2])> =
        directions.iter().flat_map(|d| bounds.iter().map(move |b| (*d, *b))).collect();
    let carry = study.continuation != Continuation::Equilibrium;
    let found: Vec<Vec<Outcome>> = tasks
        .par_iter()
        .map(|(direction, [a, b])| work.chunk(direction, [a - early(*a), *b], None, carry))
        .collect();
    let joined: Vec<(Vec<Outcome>, usize)> = directions
        .par_iter()
        .zip(found.into_par_iter().chunks(chunks))
        .map(|(direction, parts)| work.join(direction, &bounds, overlap, parts))
        .collect();

    let repaired = joined.iter().map(|(_, repaired)| repaired).sum();
    let values = &study.parameter.values;
    let sweep = |(name, outcomes): (&'static str, Vec<Outcome>)| {
        let point = |(step, (found, _)): (usize, Outcome)| BifurcationPoint {
            value: values[place(name, step, n)],
            found,
        };
        BifurcationSweep { name, points: outcomes.into_iter().enumerate().map(point).collect() }
    };
    let sweeps: Vec<BifurcationSweep> =
        directions.iter().copied().zip(joined.into_iter().map(|(o, _)| o)).map(sweep).collect();
    let all = || sweeps.iter().flat_map(|s| &s.points);
    if all().all(|p| p.found.is_err())
        && let Some(Err(reason)) = all().next().map(|p| &p.found)
    {
        return Err(crate::error::PhysicsError::NoMotion { reason: reason.clone() }.into());
    }
    let complete = !all().any(|p| p.found.as_ref().is_err_and(|reason| reason == STOPPED));
    Ok(BifurcationResult {
        complete,
        parameter: study.parameter.clone(),
        clock: clock_name(&models[0], study.steady.clock),
        channels: study.channels.iter().map(described).collect(),
        seams: if carry { (chunks - 1) * directions.len() } else { 0 },
        repaired,
        sweeps,
    })
}

/// Which value a step of a sweep is at.
fn place(direction: &str, step: usize, n: usize) -> usize {
    if direction == "down" { n - 1 - step } else { step }
}

/// What all chunks share.
struct Work<'a> {
    models: &'a [Model],
    progress: &'a (dyn Fn(usize, usize) -> ControlFlow<()> + Sync),
    done: AtomicUsize,
    planned: AtomicUsize,
}

impl Work<'_> {
    /// Runs the values of one chunk one after the other, each from where the one before ended.
    fn chunk(
        &self,
        direction: &str,
        [from, to]: [usize; 2],
        start: Option<CarriedState>,
        carry: bool,
    ) -> Vec<Outcome> {
        let mut carried = start;
        let mut outcomes = Vec::with_capacity(to - from);
        for step in from..to {
            let model = &self.models[place(direction, step, self.models.len())];
            let outcome = self.value(model, carried.as_ref());
            // After a value without a motion the next one starts from equilibrium.
            carried = outcome.1.clone().filter(|_| carry);
            outcomes.push(outcome);
        }
        outcomes
    }

    fn value(&self, model: &Model, carried: Option<&CarriedState>) -> Outcome {
        let told =
            || (self.progress)(self.done.load(Ordering::Relaxed), self.planned.load(Ordering::Relaxed));
        let outcome = match &model.studies.bifurcation {
            _ if told().is_break() => (Err(STOPPED.to_string()), None),
            None => (Err("the model has no bifurcation study".to_string()), None),
            Some(study) => match motion(model, study, carried, &mut |_| told()) {
                Ok(Some((found, state))) => (Ok(found), Some(state)),
                Ok(None) => (Err(STOPPED.to_string()), None),
                Err(error) => (Err(error.to_string()), None),
            },
        };
        self.done.fetch_add(1, Ordering::Relaxed);
        outcome
    }

    /// Puts the chunks of a sweep together, running again those that began on another branch than the one before them
    /// ended on.
    fn join(
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
                part = self.chunk(direction, [from, to], Some(state.clone()), true);
            } else {
                part.drain(..early);
            }
            whole.append(&mut part);
        }
        (whole, repaired)
    }
}

/// The steady motion of one model.
fn motion(
    model: &Model,
    study: &BifurcationStudy,
    carried: Option<&CarriedState>,
    progress: super::attractor::Progress,
) -> Result<Option<(SteadyMotion, CarriedState)>, Error> {
    let machine = Machine::new(model.clone())?;
    let (reduction, state) = machine.steady_start(&study.steady, carried)?;
    let probes: Vec<_> = study.channels.iter().collect();
    let run = machine.steady_run(&reduction, state, &study.steady, &probes, study.perturbation, progress)?;
    let Some(run) = run else { return Ok(None) };
    let channels: Vec<_> = study.channels.iter().map(described).collect();
    let (_, found) = sections(&run, &channels, &study.steady, study.tolerance, study.longest_period)?;
    Ok(Some((found, CarriedState::new(&reduction, &run.state))))
}

/// Whether two motions look the same: every section point of one has one of the other near it, and both reach as far.
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
