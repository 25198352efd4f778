//! Score tests: what a candidate would gain as a further free parameter, without a fit.
//!
//! With the residuals r and sensitivities J of the free parameters, prior weights P and the sensitivity g of the candidate at
//! its present value, of prior standard deviation d,
//!
//! u = gᵀr − gᵀJ (JᵀJ + P)⁻¹ (Jᵀr + P (x − m)),  i = gᵀg + d⁻² − gᵀJ (JᵀJ + P)⁻¹ Jᵀg
//!
//! and the objective decreases by u²/i for a change −u/i while all free parameters follow, by −(JᵀJ + P)⁻¹ Jᵀg for each
//! unit of it. It is the Gauss-Newton prediction. Source: Rao, *Linear Statistical Inference and its Applications* (1973),
//! section 6e.2.

use nalgebra::{Cholesky, DMatrix, DVector, Dyn};
use rayon::prelude::*;

use super::UpdateFailure;
use super::job::{UpdateJob, settings};
use super::least_squares::{Evaluation, Prior};
use super::parameter::FreeParameter;
use super::residual::evaluate_residuals;
use super::state::ModelState;

/// Largest number of candidates that are tried.
pub const MAX_CANDIDATES: usize = 200;
/// Gain below which chance suffices: the 1 % point of χ² with one degree of freedom.
pub const MIN_GAIN: f64 = 6.635;
/// Cosine of the effects on the data, beyond what the free parameters do, above which two candidates are alike.
const ALIKE: f64 = 0.99;
/// Largest number of best candidates of the same effect.
const MAX_ALIKE: usize = 3;

/// Free parameters at a solution.
pub(crate) struct Point {
    pub parameters: Vec<FreeParameter>,
    pub prior: Prior,
    pub x: Vec<f64>,
}

impl Point {
    /// Parameters that can move: neither reset nor at a bound.
    pub fn movable(&self) -> Vec<usize> {
        let inside = |&j: &usize| self.prior.lower[j] < self.x[j] && self.x[j] < self.prior.upper[j];
        (0..self.x.len()).filter(inside).collect()
    }

    /// Σ ((x − m)/d)².
    pub fn penalty(&self) -> f64 {
        let one = |j: usize| ((self.x[j] - self.prior.mean[j]) / self.prior.deviation[j]).powi(2);
        (0..self.x.len()).map(one).sum()
    }

    /// Score tests of the first [`MAX_CANDIDATES`] candidates, `state` the model at x; those that change no datum, or the
    /// mesh, are left out.
    pub fn scores(
        &self,
        job: &UpdateJob,
        state: &ModelState,
        modes: &[usize],
        candidates: &[FreeParameter],
    ) -> Result<Scores, UpdateFailure> {
        let candidates = &candidates[..candidates.len().min(MAX_CANDIDATES)];
        let all = settings(&self.parameters, &self.x);
        let movable = self.movable();
        let own = movable
            .par_iter()
            .map(|&j| job.derivative(&all, &self.parameters[j], self.x[j], state))
            .collect::<Result<Vec<_>, _>>()?;
        let others: Vec<_> =
            candidates.par_iter().map(|c| job.derivative(&all, c, c.mean, state).ok()).collect();
        let mut by = own;
        let mut places = Vec::new();
        for (k, derivative) in others.into_iter().enumerate() {
            if let Some(derivative) = derivative.filter(|d| !d.is_zero()) {
                by.push(derivative);
                places.push(k);
            }
        }
        let at = evaluate_residuals(state, job.target, job.fitting, modes, &by)?;
        Ok(Scores::new(&at, self, &movable, candidates, &places))
    }
}

/// Score test of a candidate.
#[derive(Clone, Debug)]
pub(crate) struct Score {
    /// Position among the candidates.
    pub candidate: usize,
    /// u²/i, the decrease of χ² and the priors' part of the objective together.
    pub gain: f64,
    /// Decrease of χ² alone: without the priors, which gain too if the fitted values are far from their means.
    pub data_gain: f64,
    /// −u/i.
    pub change: f64,
    /// 1/√i, the standard error of the candidate if it were free.
    pub error: f64,
    /// −(JᵀJ + P)⁻¹ Jᵀg: change of every free parameter for a unit change of the candidate.
    pub following: Vec<f64>,
}

impl Score {
    /// Change of free parameter j that follows the candidate.
    pub fn shift(&self, j: usize) -> f64 {
        self.change * self.following[j]
    }
}

pub(crate) struct Scores {
    pub chi_squared: f64,
    pub all: Vec<Score>,
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
            let mut following = vec![0.0; point.x.len()];
            movable.iter().zip(&followed[k]).for_each(|(&j, v)| following[j] = -v);
            let change = -slope / information;
            let effect = (&columns[k] - &own * &followed[k]) * change;
            Score {
                candidate: places[k],
                gain: slope * slope / information,
                data_gain: -(2.0 * at.residual.dot(&effect) + effect.norm_squared()),
                change,
                error: information.sqrt().recip(),
                following,
            }
        };
        let size = |k: usize| gram[(k, k)].max(f64::MIN_POSITIVE).sqrt();
        Self {
            chi_squared: at.residual.norm_squared(),
            all: (0..count).map(score).collect(),
            cosine: DMatrix::from_fn(count, count, |a, b| gram[(a, b)] / (size(a) * size(b))),
        }
    }

    /// Scores of the largest gains, of those of the same effect at most [`MAX_ALIKE`].
    pub fn best(&self, count: usize) -> Vec<usize> {
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
    pub fn alike(&self, k: usize) -> impl Iterator<Item = usize> + '_ {
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
        let at = Evaluation::of_frequencies(residual.iter().copied().collect(), jacobian);
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
            // What the candidate adds to the move of the free parameter.
            let score = &found.all[k];
            // From the point as it is, the free parameter follows the candidate only.
            let after = &residual + (&g + &j * score.following[0]) * score.change;
            let fall = residual.norm_squared() - after.norm_squared();
            assert!((score.data_gain - fall).abs() < 1e-12, "{k}: {} {fall}", score.data_gain);
            assert!((score.shift(0) - (both[0] - alone)).abs() < 1e-12);
            // Errors with the candidate free, by the inverse of both.
            let covariance = matrix.try_inverse().unwrap();
            assert!((score.error / covariance[(1, 1)].sqrt() - 1.0).abs() < 1e-12);
            let with = (matrix[(0, 0)].recip() + (score.error * score.following[0]).powi(2)).sqrt();
            assert!((with / covariance[(0, 0)].sqrt() - 1.0).abs() < 1e-12);
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
