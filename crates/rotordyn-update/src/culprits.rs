//! Culprits of a misfit: parameters that are not free and would explain it.
//!
//! Each candidate is tried once. The score test gives its gain without a fit: with the residuals r and sensitivities J
//! of the free parameters, prior weights P and the sensitivity g of the candidate at its present value, of prior
//! standard deviation d,
//!
//! u = gᵀr − gᵀJ (JᵀJ + P)⁻¹ (Jᵀr + P (x − m)),  i = gᵀg + d⁻² − gᵀJ (JᵀJ + P)⁻¹ Jᵀg
//!
//! and the objective decreases by u²/i for a change −u/i while all free parameters follow. It is the Gauss-Newton
//! prediction: the best candidates are fitted together with the free parameters. Source: Rao, *Linear Statistical
//! Inference and its Applications* (1973), section 6e.2.

use nalgebra::{Cholesky, DMatrix, DVector, Dyn};
use rayon::prelude::*;

use super::goodness::GoodnessOfFit;
use super::identifiability::identifiability;
use super::least_squares::{Evaluation, Prior, Solution};
use super::parameter::{FreeParameter, prior};
use super::residual::evaluate_residuals;
use super::{Update, UpdateFailure, UpdateJob, decided, fit, settings};

/// Largest number of candidates that are tried.
pub const MAX_CANDIDATES: usize = 200;
/// Candidates fitted in earnest: those of the largest predicted gains.
const MAX_REFITS: usize = 8;
/// Largest number of fitted candidates of the same effect.
const MAX_ALIKE: usize = 3;
/// Cosine of the effects on the data, beyond what the free parameters do, above which two candidates are alike.
const ALIKE: f64 = 0.99;
/// Iterations of the fit with a candidate, which starts from the predicted change.
const MAX_ITERATIONS: usize = 15;
/// Gain below which a candidate is not proposed: the 1 % point of χ² with one degree of freedom.
const MIN_GAIN: f64 = 6.635;
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

/// Candidates tried for a misfit.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct CulpritSearch {
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

/// Tries each candidate as a further free parameter of an update that does not explain the data.
///
/// # Errors
/// The model cannot be evaluated at the solution of the update.
pub fn search(
    job: &UpdateJob,
    found: &Update,
    candidates: &[FreeParameter],
) -> Result<CulpritSearch, UpdateFailure> {
    let candidates = &candidates[..candidates.len().min(MAX_CANDIDATES)];
    let mut own = prior(job.parameters);
    for (j, outcome) in found.outcomes.iter().enumerate().filter(|(_, outcome)| outcome.is_reset()) {
        (own.lower[j], own.upper[j]) = (outcome.x, outcome.x);
    }
    decided(job, |job| {
        let start = Point { parameters: job.parameters.to_vec(), prior: own, x: found.x() };
        let first = start.ranking(job, &found.fitted_modes, candidates, MAX_REFITS)?;
        let mut out = CulpritSearch {
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

/// Free parameters at a solution.
struct Point {
    parameters: Vec<FreeParameter>,
    prior: Prior,
    x: Vec<f64>,
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

    /// Parameters that can move: neither reset nor at a bound.
    fn movable(&self) -> Vec<usize> {
        let inside = |&j: &usize| self.prior.lower[j] < self.x[j] && self.x[j] < self.prior.upper[j];
        (0..self.x.len()).filter(inside).collect()
    }

    /// Σ ((x − m)/d)².
    fn penalty(&self) -> f64 {
        let one = |j: usize| ((self.x[j] - self.prior.mean[j]) / self.prior.deviation[j]).powi(2);
        (0..self.x.len()).map(one).sum()
    }

    fn ranking(
        &self,
        job: &UpdateJob,
        modes: &[usize],
        candidates: &[FreeParameter],
        refits: usize,
    ) -> Result<Ranking, UpdateFailure> {
        let job = self.job(job);
        let scores = self.scores(&job, modes, candidates)?;
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

    /// Score tests of the candidates; those that change no datum, or the mesh, are left out.
    fn scores(
        &self,
        job: &UpdateJob,
        modes: &[usize],
        candidates: &[FreeParameter],
    ) -> Result<Scores, UpdateFailure> {
        let state = job.state(&self.x)?;
        let all = settings(&self.parameters, &self.x);
        let movable = self.movable();
        let own = movable
            .par_iter()
            .map(|&j| job.derivative(&all, &self.parameters[j], self.x[j], &state))
            .collect::<Result<Vec<_>, _>>()?;
        let others: Vec<_> =
            candidates.par_iter().map(|c| job.derivative(&all, c, c.mean, &state).ok()).collect();
        let mut by = own;
        let mut places = Vec::new();
        for (k, derivative) in others.into_iter().enumerate() {
            if let Some(derivative) = derivative.filter(|d| !d.is_zero()) {
                by.push(derivative);
                places.push(k);
            }
        }
        let at = evaluate_residuals(&state, job.target, job.fitting, modes, &by)?;
        Ok(Scores::new(&at, self, &movable, candidates, &places))
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

/// Score test of a candidate.
#[derive(Clone, Debug)]
struct Score {
    candidate: usize,
    /// u²/i.
    gain: f64,
    /// −u/i.
    change: f64,
}

struct Scores {
    chi_squared: f64,
    all: Vec<Score>,
    /// Cosines between the effects on the data of two candidates, those of the free parameters removed.
    cosine: DMatrix<f64>,
}

impl Scores {
    /// `at` has the sensitivities of the movable parameters, then those of the candidates `places`.
    fn new(
        at: &Evaluation,
        point: &Point,
        movable: &[usize],
        candidates: &[FreeParameter],
        places: &[usize],
    ) -> Self {
        let n = movable.len();
        let own = at.jacobian.columns(0, n).into_owned();
        let weights = movable.iter().map(|&j| point.prior.deviation[j].powi(-2));
        let weights = DVector::from_iterator(n, weights);
        let off = DVector::from_fn(n, |k, _| point.x[movable[k]] - point.prior.mean[movable[k]]);
        let matrix = own.tr_mul(&own) + DMatrix::from_diagonal(&weights);
        let gradient = own.tr_mul(&at.residual) + weights.component_mul(&off);
        // Positive definite by the prior weights.
        let factor: Option<Cholesky<f64, Dyn>> = if n > 0 { matrix.cholesky() } else { None };
        let follow = |right: &DVector<f64>| match &factor {
            Some(factor) => factor.solve(right),
            None => DVector::zeros(n),
        };
        let columns: Vec<DVector<f64>> =
            (0..places.len()).map(|k| at.jacobian.column(n + k).into_owned()).collect();
        let coupling: Vec<DVector<f64>> = columns.iter().map(|g| own.tr_mul(g)).collect();
        let followed: Vec<DVector<f64>> = coupling.iter().map(&follow).collect();
        let count = places.len();
        let gram = DMatrix::from_fn(count, count, |a, b| {
            columns[a].dot(&columns[b]) - coupling[a].dot(&followed[b])
        });
        let score = |k: usize| {
            let deviation = candidates[places[k]].deviation;
            let information = gram[(k, k)].max(0.0) + deviation.powi(-2);
            let slope = columns[k].dot(&at.residual) - followed[k].dot(&gradient);
            Score { candidate: places[k], gain: slope * slope / information, change: -slope / information }
        };
        let size = |k: usize| gram[(k, k)].max(f64::MIN_POSITIVE).sqrt();
        Self {
            chi_squared: at.residual.norm_squared(),
            all: (0..count).map(score).collect(),
            cosine: DMatrix::from_fn(count, count, |a, b| gram[(a, b)] / (size(a) * size(b))),
        }
    }

    /// Scores of the largest gains, of those of the same effect at most three.
    fn best(&self, count: usize) -> Vec<usize> {
        let mut order: Vec<usize> = (0..self.all.len()).filter(|&k| self.all[k].gain > 0.0).collect();
        order.sort_by(|&a, &b| self.all[b].gain.total_cmp(&self.all[a].gain));
        let mut chosen: Vec<usize> = Vec::new();
        for k in order {
            let same = chosen.iter().filter(|&&other| self.cosine[(k, other)].abs() > ALIKE).count();
            if chosen.len() < count && same < MAX_ALIKE {
                chosen.push(k);
            }
        }
        chosen
    }

    /// Candidates with the same effect as score number k.
    fn alike(&self, k: usize) -> impl Iterator<Item = usize> + '_ {
        let same = move |other: &usize| *other != k && self.cosine[(k, *other)].abs() > ALIKE;
        (0..self.all.len()).filter(same).map(|other| self.all[other].candidate)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::parameter::ModelNumber;

    fn parameter(name: &str, deviation: f64) -> FreeParameter {
        let place = ModelNumber { path: name.into(), value: 1.0, unit: "N".into(), quoted: true };
        FreeParameter { deviation, ..FreeParameter::new(name, vec![place], true, None).unwrap() }
    }

    /// Three linear data of one free parameter and three candidates, of which two have the same effect.
    fn scores() -> (Scores, DVector<f64>) {
        let residual = DVector::from_vec(vec![0.5, -1.0, 4.0]);
        let jacobian = DMatrix::from_row_slice(
            3,
            4,
            &[
                2.0, 1.0, 0.3, 0.5, //
                1.0, 0.0, 0.1, 0.0, //
                0.0, 3.0, 1.0, 1.5,
            ],
        );
        let at = Evaluation { residual: residual.clone(), jacobian, data: 3.0 };
        let own = Prior { mean: vec![0.1], deviation: vec![0.5], lower: vec![-9.0], upper: vec![9.0] };
        let point = Point { parameters: vec![parameter("free", 0.5)], prior: own, x: vec![0.3] };
        let candidates = [parameter("a", 0.7), parameter("b", 0.7), parameter("c", 0.7)];
        (Scores::new(&at, &point, &[0], &candidates, &[0, 1, 2]), residual)
    }

    #[test]
    fn score_test_is_the_minimum_of_the_linear_problem() {
        let (found, residual) = scores();
        // Minimum over x and θ of |r + J dx + g θ|² + ((x + dx − m)/0.5)² + (θ/0.7)², by the normal equations; without θ
        // the parameter moves too, as the point is not at its minimum: the difference of both minima is the gain.
        let j = DVector::from_vec(vec![2.0, 1.0, 0.0]);
        for (k, g) in [[1.0, 0.0, 3.0], [0.3, 0.1, 1.0]].into_iter().enumerate() {
            let g = DVector::from_row_slice(&g);
            let objective = |dx: f64, theta: f64| {
                (&residual + &j * dx + &g * theta).norm_squared()
                    + ((0.2 + dx) / 0.5).powi(2)
                    + (theta / 0.7).powi(2)
            };
            let weight = 4.0;
            let alone = -(j.dot(&residual) + weight * 0.2) / (j.dot(&j) + weight);
            let matrix = nalgebra::Matrix2::new(
                j.dot(&j) + weight,
                j.dot(&g),
                j.dot(&g),
                g.dot(&g) + 0.7_f64.powi(-2),
            );
            let right = -nalgebra::Vector2::new(j.dot(&residual) + weight * 0.2, g.dot(&residual));
            let both = matrix.lu().solve(&right).unwrap();
            let gain = objective(alone, 0.0) - objective(both[0], both[1]);
            assert!((found.all[k].gain / gain - 1.0).abs() < 1e-12, "{k}: {} {gain}", found.all[k].gain);
            assert!((found.all[k].change - both[1]).abs() < 1e-12);
        }
    }

    #[test]
    fn candidates_of_the_same_effect_are_recognised() {
        let (found, _) = scores();
        // The third is half the first.
        assert_eq!(found.alike(0).collect::<Vec<_>>(), [1, 2]);
        assert!((found.cosine[(0, 2)] - 1.0).abs() < 1e-12);
        assert_eq!(found.best(2).len(), 2);
    }
}
