//! Nonlinear least squares with bounds and normal priors (maximum a posteriori) by Levenberg-Marquardt.

use nalgebra::{DMatrix, DVector};

use super::UpdateFailure;
use super::data_kind::DataKind;

/// Normal priors x ~ N(mean, deviation²), and bounds.
#[derive(Clone, Debug, PartialEq)]
pub struct Prior {
    pub mean: Vec<f64>,
    pub deviation: Vec<f64>,
    pub lower: Vec<f64>,
    pub upper: Vec<f64>,
}

/// Residuals over their standard deviations, and their derivatives.
#[derive(Clone, Debug)]
pub struct Evaluation {
    pub residual: DVector<f64>,
    /// ∂r_i/∂x_j.
    pub jacobian: DMatrix<f64>,
    /// Kind of every residual.
    pub kinds: Vec<DataKind>,
    /// Effective number of data of each kind: a shape counts as one whatever its points; so do the lines of all FRFs near
    /// one frequency if the model error exceeds the noise.
    pub data: [f64; DataKind::COUNT],
}

impl Evaluation {
    /// Residuals that are data of one kind, each by itself.
    #[cfg(test)]
    pub fn of_frequencies(residual: Vec<f64>, jacobian: DMatrix<f64>) -> Self {
        let count = residual.len();
        Self {
            residual: DVector::from_vec(residual),
            jacobian,
            kinds: vec![DataKind::Frequency; count],
            data: [count as f64, 0.0, 0.0, 0.0],
        }
    }
}

/// State after an iteration.
#[derive(Clone, Debug, PartialEq)]
pub struct Iteration {
    pub x: Vec<f64>,
    /// ½ |r|² + ½ Σ ((x − mean)/deviation)².
    pub cost: f64,
    /// Largest step relative to the prior's deviation.
    pub step: f64,
}

/// Result of the minimisation.
#[derive(Clone, Debug)]
pub struct Solution {
    pub x: Vec<f64>,
    pub evaluation: Evaluation,
    /// The start, then every step taken.
    pub iterations: Vec<Iteration>,
    pub converged: bool,
}

/// Convergence: largest step over the conditional standard error of a parameter (others fixed).
const STEP_TOLERANCE: f64 = 1e-8;
/// Convergence: relative reduction of the cost.
const COST_TOLERANCE: f64 = 1e-10;
const MAX_REJECTED: usize = 12;

/// Minimises ½ |r(x)|² + ½ Σ ((x − mean)/deviation)² within the bounds, from `start`.
///
/// A trial point at which `evaluate` fails is rejected like one of higher cost, and a shorter step is tried.
/// A parameter at its bound stays there while the cost decreases outwards (active set). Source of the
/// damping: Nielsen, IMM-REP-1999-05.
///
/// # Errors
/// Those of `evaluate` at the start.
pub fn minimise(
    start: &[f64],
    prior: &Prior,
    max_iterations: usize,
    evaluate: &mut dyn FnMut(&[f64]) -> Result<Evaluation, UpdateFailure>,
) -> Result<Solution, UpdateFailure> {
    let n = start.len();
    let cost = |x: &[f64], at: &Evaluation| {
        let penalty: f64 = (0..n).map(|j| ((x[j] - prior.mean[j]) / prior.deviation[j]).powi(2)).sum();
        0.5 * (at.residual.norm_squared() + penalty)
    };
    let mut x = start.to_vec();
    let mut at = evaluate(&x)?;
    let mut now = cost(&x, &at);
    let mut iterations = vec![Iteration { x: x.clone(), cost: now, step: 0.0 }];
    let (mut damping, mut growth, mut rejected) = (1e-3, 2.0, 0);
    let mut converged = n == 0;
    while !converged && iterations.len() <= max_iterations && rejected < MAX_REJECTED {
        let Some(step) = damped_step(&x, &at, prior, damping) else { break };
        let trial: Vec<f64> =
            (0..n).map(|j| (x[j] + step[j]).clamp(prior.lower[j], prior.upper[j])).collect();
        let largest = |scale: &dyn Fn(usize) -> f64| {
            (0..n).map(|j| ((trial[j] - x[j]) / scale(j)).abs()).fold(0.0, f64::max)
        };
        let error =
            |j: usize| (at.jacobian.column(j).norm_squared() + prior.deviation[j].powi(-2)).sqrt().recip();
        let size = largest(&|j| prior.deviation[j]);
        if largest(&error) < STEP_TOLERANCE {
            converged = true;
            break;
        }
        let taken = evaluate(&trial).ok().map(|there| (cost(&trial, &there), there));
        match taken {
            Some((then, there)) if then < now => {
                let expected = predicted_reduction(&x, &trial, &at, prior);
                let gain = if expected > 0.0 { (now - then) / expected } else { 1.0 };
                damping *= (1.0 - (2.0 * gain - 1.0).powi(3)).clamp(1.0 / 3.0, 2.0);
                growth = 2.0;
                rejected = 0;
                converged = now - then < COST_TOLERANCE * now;
                (x, at, now) = (trial, there, then);
                iterations.push(Iteration { x: x.clone(), cost: now, step: size });
            }
            _ => {
                damping *= growth;
                growth *= 2.0;
                rejected += 1;
            }
        }
    }
    // No shorter step reduces the cost: round-off is reached.
    let converged = converged || rejected == MAX_REJECTED;
    Ok(Solution { x, evaluation: at, iterations, converged })
}

/// Gradient Jᵀ r + P (x − mean) and Gauss-Newton matrix Jᵀ J + P of the cost.
fn normal_equations(x: &[f64], at: &Evaluation, prior: &Prior) -> (DVector<f64>, DMatrix<f64>) {
    let mut gradient = at.jacobian.tr_mul(&at.residual);
    let mut matrix = at.jacobian.tr_mul(&at.jacobian);
    for j in 0..x.len() {
        let weight = prior.deviation[j].powi(-2);
        gradient[j] += weight * (x[j] - prior.mean[j]);
        matrix[(j, j)] += weight;
    }
    (gradient, matrix)
}

/// Levenberg-Marquardt step of (JᵀJ + P + μ diag) dx = −gradient over the parameters not at a bound.
fn damped_step(x: &[f64], at: &Evaluation, prior: &Prior, damping: f64) -> Option<Vec<f64>> {
    let (gradient, matrix) = normal_equations(x, at, prior);
    let free: Vec<usize> = (0..x.len())
        .filter(|&j| {
            let out =
                x[j] <= prior.lower[j] && gradient[j] > 0.0 || x[j] >= prior.upper[j] && gradient[j] < 0.0;
            !out && prior.lower[j] < prior.upper[j]
        })
        .collect();
    let mut small = DMatrix::from_fn(free.len(), free.len(), |i, j| matrix[(free[i], free[j])]);
    for i in 0..free.len() {
        small[(i, i)] *= 1.0 + damping;
    }
    let right = DVector::from_fn(free.len(), |i, _| -gradient[free[i]]);
    let solved = small.cholesky()?.solve(&right);
    let mut step = vec![0.0; x.len()];
    for (&j, s) in free.iter().zip(solved.iter()) {
        step[j] = *s;
    }
    Some(step)
}

/// Cost reduction between two points predicted by the linear model.
fn predicted_reduction(x: &[f64], trial: &[f64], at: &Evaluation, prior: &Prior) -> f64 {
    let (gradient, matrix) = normal_equations(x, at, prior);
    let step = DVector::from_iterator(x.len(), trial.iter().zip(x).map(|(t, x)| t - x));
    -(gradient.dot(&step) + 0.5 * step.dot(&(matrix * &step)))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rosenbrock(x: &[f64]) -> Result<Evaluation, UpdateFailure> {
        let jacobian = DMatrix::from_row_slice(2, 2, &[-20.0 * x[0], 10.0, -1.0, 0.0]);
        Ok(Evaluation::of_frequencies(vec![10.0 * (x[1] - x[0] * x[0]), 1.0 - x[0]], jacobian))
    }

    fn prior(deviation: f64, upper: f64) -> Prior {
        Prior {
            mean: vec![0.0; 2],
            deviation: vec![deviation; 2],
            lower: vec![f64::NEG_INFINITY; 2],
            upper: vec![upper, f64::INFINITY],
        }
    }

    #[test]
    fn finds_the_minimum_of_rosenbrocks_valley() {
        let found = minimise(&[-1.2, 1.0], &prior(1e6, f64::INFINITY), 100, &mut rosenbrock).unwrap();
        assert!(found.converged, "{:?}", found.iterations);
        assert!(found.x.iter().all(|x| (x - 1.0).abs() < 1e-6), "{:?}", found.x);
    }

    #[test]
    fn minimum_on_an_active_bound() {
        let found = minimise(&[-1.2, 1.0], &prior(1e6, 0.5), 100, &mut rosenbrock).unwrap();
        // At x = 0.5 the valley's floor is y = 0.25.
        assert!(found.converged && found.x[0] == 0.5, "{:?}", found.x);
        assert!((found.x[1] - 0.25).abs() < 1e-6, "{:?}", found.x);
    }

    #[test]
    fn prior_weighted_like_a_datum() {
        // One datum x = 1 ± 0.5 against the prior 0 ± 1: the mean weighted by 4 to 1.
        let mut datum = |x: &[f64]| {
            Ok(Evaluation::of_frequencies(vec![(x[0] - 1.0) / 0.5], DMatrix::from_element(1, 1, 2.0)))
        };
        let one = Prior { mean: vec![0.0], deviation: vec![1.0], lower: vec![-9.0], upper: vec![9.0] };
        let found = minimise(&[0.0], &one, 50, &mut datum).unwrap();
        assert!((found.x[0] - 0.8).abs() < 1e-9, "{:?}", found.x);
    }
}
