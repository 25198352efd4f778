//! Culprits of a misfit: parameters that are not free and would explain it.
//!
//! Each candidate is tried once by its score test (`score_test.rs`); the best are fitted together with the free parameters.
//! Free parameters that ended at a bound are fitted without it first.

use rayon::prelude::*;

use super::goodness::GoodnessOfFit;
use super::identifiability::identifiability;
use super::job::{UpdateJob, decided, fit};
use super::least_squares::Solution;
use super::parameter::{FreeParameter, prior};
pub use super::score_test::MAX_CANDIDATES;
use super::score_test::{MIN_GAIN, Point, Score};
use super::{IdentifiabilityClass, Update, UpdateFailure};

/// Candidates fitted in earnest: those of the largest predicted gains.
const MAX_REFITS: usize = 8;
/// Iterations of the fit with a candidate, which starts from the predicted change.
const MAX_ITERATIONS: usize = 15;
/// Largest number of candidates that explain a misfit together.
const MAX_TOGETHER: usize = 3;

/// A parameter that is not free, and what it would explain.
#[derive(Clone, Debug, PartialEq)]
pub struct Culprit {
    pub parameter: FreeParameter,
    /// Decrease of χ² when it is fitted together with the free parameters.
    pub gain: f64,
    /// Decrease predicted without a fit.
    pub predicted_gain: f64,
    /// χ² with it.
    pub goodness: GoodnessOfFit,
    /// Coordinate that it would take, and its standard error.
    pub x: f64,
    pub error: f64,
    /// Other candidates whose effect on the data is the same, by name.
    pub alike: Vec<String>,
}

/// Free parameters that ended at a bound, fitted without their bounds.
#[derive(Clone, Debug, PartialEq)]
pub struct ReleasedBounds {
    /// Which of the free parameters.
    pub parameters: Vec<usize>,
    /// Coordinates of all free parameters then.
    pub x: Vec<f64>,
    /// Decrease of χ².
    pub gain: f64,
    /// χ² then.
    pub goodness: GoodnessOfFit,
}

/// Candidates tried for a misfit.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct CulpritSearch {
    /// If bounds keep free parameters from a better fit.
    pub released: Option<ReleasedBounds>,
    /// Number of candidates, and of those that change the data.
    pub candidates: usize,
    pub with_influence: usize,
    /// Best first, each added alone.
    pub culprits: Vec<Culprit>,
    /// If none explains the misfit alone: the best one, the best one besides it, and so on; gains are by each further one.
    pub together: Vec<Culprit>,
}

impl CulpritSearch {
    /// Those that explain the misfit alone.
    pub fn explaining(&self) -> impl Iterator<Item = &Culprit> {
        self.culprits.iter().filter(|culprit| !culprit.goodness.is_rejected())
    }

    /// All in the order of proposal: those that explain the misfit alone, then those that explain it together, then the
    /// others by their gain.
    pub fn proposed(&self) -> Vec<&Culprit> {
        let mut out: Vec<&Culprit> = self.explaining().collect();
        for culprit in self.together.iter().chain(&self.culprits) {
            if !out.iter().any(|known| known.parameter.name == culprit.parameter.name) {
                out.push(culprit);
            }
        }
        out
    }
}

/// Tries each of `job.fixed` as a further free parameter of an update that does not explain the data.
///
/// # Errors
/// The model cannot be evaluated at the solution of the update.
pub fn search(job: &UpdateJob, found: &Update) -> Result<CulpritSearch, UpdateFailure> {
    let candidates = &job.fixed[..job.fixed.len().min(MAX_CANDIDATES)];
    let mut own = prior(job.parameters);
    for (j, outcome) in found.outcomes.iter().enumerate().filter(|(_, outcome)| outcome.is_reset()) {
        (own.lower[j], own.upper[j]) = (outcome.x, outcome.x);
    }
    decided(job, |job| {
        let start = Point { parameters: job.parameters.to_vec(), prior: own, x: found.x() };
        let first = start.ranking(job, &found.fitted_modes, candidates, MAX_REFITS)?;
        let mut out = CulpritSearch {
            released: start.without_active_bounds(job, found),
            candidates: candidates.len(),
            with_influence: first.with_influence,
            culprits: first.ranked.iter().map(|(culprit, _)| culprit.clone()).collect(),
            together: Vec::new(),
        };
        if out.explaining().next().is_some() {
            return Ok(out);
        }
        let mut next = first.ranked.into_iter().next();
        while let Some((culprit, point)) = next {
            let explained = !culprit.goodness.is_rejected();
            out.together.push(culprit);
            if explained || out.together.len() == MAX_TOGETHER {
                break;
            }
            let left: Vec<FreeParameter> =
                candidates.iter().filter(|c| !point.has_number_of(c)).cloned().collect();
            let further = point.ranking(job, &found.fitted_modes, &left, MAX_REFITS / 2)?;
            next = further.ranked.into_iter().next();
        }
        Ok(out)
    })
}

/// Candidates by the objective with them, best first, each with the solution.
struct Ranking {
    with_influence: usize,
    ranked: Vec<(Culprit, Point)>,
}

impl Point {
    /// Whether a number of the file is already a free parameter.
    fn has_number_of(&self, candidate: &FreeParameter) -> bool {
        let paths = || self.parameters.iter().flat_map(|p| &p.numbers).map(|number| &number.path);
        candidate.numbers.iter().any(|number| paths().any(|path| *path == number.path))
    }

    fn job<'a>(&'a self, job: &UpdateJob<'a>) -> UpdateJob<'a> {
        UpdateJob { parameters: &self.parameters, max_iterations: MAX_ITERATIONS, ..*job }
    }

    fn ranking(
        &self,
        job: &UpdateJob,
        modes: &[usize],
        candidates: &[FreeParameter],
        refits: usize,
    ) -> Result<Ranking, UpdateFailure> {
        let job = self.job(job);
        let scores = self.scores(&job, &job.state(&self.x)?, modes, candidates)?;
        let before = (scores.chi_squared, scores.chi_squared + self.penalty());
        let refitted: Vec<Option<(f64, Culprit, Point)>> = scores
            .best(refits)
            .into_par_iter()
            .map(|k| {
                let score = &scores.all[k];
                let candidate = &candidates[score.candidate];
                let alike = scores.alike(k).map(|other| candidates[other].name.clone()).collect();
                self.refit(&job, modes, candidate, score, before, alike)
            })
            .collect();
        let mut ranked: Vec<(f64, Culprit, Point)> = refitted.into_iter().flatten().collect();
        ranked.sort_by(|a, b| b.0.total_cmp(&a.0));
        let ranked = ranked.into_iter().map(|(_, culprit, point)| (culprit, point)).collect();
        Ok(Ranking { with_influence: scores.all.len(), ranked })
    }

    /// Fit without the bounds at which free parameters ended; `None` without such bounds, a solution or a gain.
    fn without_active_bounds(&self, job: &UpdateJob, found: &Update) -> Option<ReleasedBounds> {
        let at_bound = |&j: &usize| found.outcomes[j].class == IdentifiabilityClass::AtBound;
        let parameters: Vec<usize> = (0..self.x.len()).filter(at_bound).collect();
        if parameters.is_empty() {
            return None;
        }
        let mut prior = self.prior.clone();
        for &j in &parameters {
            (prior.lower[j], prior.upper[j]) = (f64::NEG_INFINITY, f64::INFINITY);
        }
        let solution = fit(&self.job(job), &prior, &self.x, &found.fitted_modes).ok()?;
        let point = Point { parameters: self.parameters.clone(), prior, x: solution.x };
        let goodness = GoodnessOfFit::new(&solution.evaluation, &point.prior, &point.movable());
        let gain = found.goodness.chi_squared - goodness.chi_squared;
        (gain >= MIN_GAIN).then_some(ReleasedBounds { parameters, x: point.x, gain, goodness })
    }

    /// Fits a candidate together with the free parameters; `before`: χ² and objective without it. With the decrease of the
    /// objective, which has the priors too; `None` without a solution or a gain.
    fn refit(
        &self,
        job: &UpdateJob,
        modes: &[usize],
        candidate: &FreeParameter,
        score: &Score,
        before: (f64, f64),
        alike: Vec<String>,
    ) -> Option<(f64, Culprit, Point)> {
        let mut point = Point {
            parameters: [&self.parameters[..], std::slice::from_ref(candidate)].concat(),
            prior: self.prior.clone(),
            x: self.x.clone(),
        };
        point.prior.mean.push(candidate.mean);
        point.prior.deviation.push(candidate.deviation);
        point.prior.lower.push(candidate.lower);
        point.prior.upper.push(candidate.upper);
        let last = self.x.len();
        let predicted = score.change.clamp(-candidate.deviation, candidate.deviation);
        let solution: Solution = [predicted, 0.0].into_iter().find_map(|change| {
            let start = [&self.x[..], &[candidate.mean + change]].concat();
            fit(&point.job(job), &point.prior, &start, modes).ok()
        })?;
        point.x = solution.x;
        let estimate = identifiability(&solution.evaluation, &point.prior);
        let chi_squared = estimate.chi_squared;
        let gain = before.0 - chi_squared;
        let goodness = GoodnessOfFit::new(&solution.evaluation, &point.prior, &point.movable());
        let culprit = Culprit {
            parameter: candidate.clone(),
            gain,
            predicted_gain: score.gain,
            goodness,
            x: point.x[last],
            error: estimate.errors[last],
            alike,
        };
        let decrease = before.1 - (chi_squared + point.penalty());
        (gain >= MIN_GAIN && decrease > 0.0).then_some((decrease, culprit, point))
    }
}
