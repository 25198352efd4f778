//! Error of the modal model in the standard errors of poles.
//!
//! Three patterns of the residuals show it:
//!
//! * outputs that have different poles: stiffness that varies from row to row, or a temperature that drifts. The variance
//!   is the mean of δ δᵀ of the changes δ of the pole when an output is left out, if it exceeds that of noise by more than chance; with
//!   few outputs the factor of Student's t for 95 % over that of a Gaussian makes ±1.96 standard errors a 95 % interval;
//! * poles of the outputs that follow the square of their motion: the mass of a sensor that is moved. The pole without it
//!   is that of an output at rest;
//! * a pole that follows the square of the motion along the resonance, λ + κ|σ/(s − λ)|²: a nonlinearity. The pole of
//!   the linear structure is that of no motion, λ + δ (`nonlinearity`).
//!
//! Half the square of the distance to the pole at rest joins the variance, so that the interval covers both.
//!
//! Source: Bell & McCaffrey, Survey Methodology 28 (2002), on few groups and their degrees of freedom; Cameron, Gelbach &
//! Miller, J. Business & Economic Statistics 29 (2011), on sums over groupings in several ways.

use nalgebra::DMatrix;

use super::data::Data;
use super::dense::tr_mul;
use super::nonlinearity::linear_poles;
use super::refine::{FitPoint, GaussNewtonStep, Problem};
use super::uncertainty::PoleCovariance;
use rotordyn_linalg::Complex64;

/// F statistic from which a change of the pole along the resonance is no chance; and its mean over all modes, from which
/// the structure is nonlinear, so that all count.
const MIN_SIGNIFICANCE: f64 = 5.0;
const MIN_MEAN_SIGNIFICANCE: f64 = 3.0;
/// Share of the squared distance to the pole at rest in the variance.
const AT_REST: f64 = 0.5;
/// Least number of groups, in their effective number, for a variance between them.
const MIN_GROUPS: f64 = 2.5;
/// Largest share of a group in the information on a pole: more would extrapolate from what is left.
const MAX_SHARE: f64 = 0.85;
/// Student's t from which a trend of the outputs' poles with their motion is no chance; and the least number of outputs, in
/// their effective number: of fewer, t is large by chance.
const MIN_TREND: f64 = 3.5;
const MIN_TREND_GROUPS: f64 = 6.0;
/// Share of the scatter of the outputs' poles that a pattern may leave unexplained.
const UNEXPLAINED: f64 = 0.3;
/// Quantile of the Gaussian for a two-sided 95 %.
const GAUSSIAN: f64 = 1.959_964;

/// Covariances of noise and of the model's error together.
pub(super) fn with_model_error(
    problem: &Problem,
    at: &FitPoint,
    noise: &[PoleCovariance],
) -> Vec<PoleCovariance> {
    let (data, step) = (problem.data(), &problem.step(at));
    let slope = tr_mul(&step.projected_jacobian, &at.residual);
    let gram = tr_mul(&step.projected_jacobian, &step.projected_jacobian);
    let modes: Vec<ModeGroups> = (0..at.poles.len()).map(|m| ModeGroups::new(data, at, step, m)).collect();
    let trends: Vec<Option<Trend>> = modes.iter().map(|mode| mode.trend(data, &slope)).collect();
    // The mass of a sensor lowers all modes: their trends count together.
    let known: Vec<f64> = trends.iter().flatten().map(|trend| trend.t).collect();
    let together = known.iter().sum::<f64>() / (known.len().max(1) as f64).sqrt();
    // So does a nonlinearity.
    let rests = linear_poles(problem, at, step);
    let known: Vec<f64> = rests.iter().flatten().map(|rest| rest.significance).collect();
    let nonlinear = known.iter().sum::<f64>() > MIN_MEAN_SIGNIFICANCE * known.len() as f64;
    modes
        .iter()
        .zip(noise)
        .zip(&trends)
        .zip(&rests)
        .map(|(((mode, noise), trend), rest)| {
            let mut sum = *noise;
            if mode.count == 0 {
                return sum;
            }
            let excess = mode.outputs(&slope, &gram).excess(noise);
            sum.iter_mut().zip(excess).for_each(|(sum, excess)| *sum += excess);
            if let Some(trend) = trend
                && (trend.t.abs() > MIN_TREND || (together < -MIN_TREND && trend.t < 0.0))
            {
                sum[1] += AT_REST * trend.at_rest * trend.at_rest;
            }
            if let Some(rest) = rest
                && (rest.significance > MIN_SIGNIFICANCE || nonlinear)
            {
                sum[0] += AT_REST * rest.distance.re.powi(2);
                sum[1] += AT_REST * rest.distance.im.powi(2);
            }
            sum
        })
        .collect()
}

/// Modes with outputs of different poles for a reason that is no second mode: their frequencies are off as those of the other
/// modes (stiffness that varies from row to row), or by the square of their motion (the mass of a sensor that is moved).
pub(super) fn outputs_differ(problem: &Problem, at: &FitPoint) -> Vec<bool> {
    let (data, step) = (problem.data(), &problem.step(at));
    let slope = tr_mul(&step.projected_jacobian, &at.residual);
    let modes: Vec<ModeGroups> = (0..at.poles.len()).map(|m| ModeGroups::new(data, at, step, m)).collect();
    let weights: Vec<Vec<f64>> = modes.iter().map(ModeGroups::weights).collect();
    // Relative changes of frequency by each output, of that output alone times its weight.
    let shifts: Vec<Vec<f64>> = modes
        .iter()
        .zip(&at.poles)
        .map(|(mode, pole)| mode.shifts(&slope).into_iter().map(|shift| shift / pole.value.im).collect())
        .collect();
    let others = |of: &[Vec<f64>], m: usize, o: usize| -> f64 {
        of.iter().enumerate().filter(|(k, _)| *k != m).map(|(_, own)| own[o]).sum()
    };
    let differs = |m: usize| {
        let (mut all, mut rest) = (0.0, 0.0);
        for o in 0..data.outputs() {
            let weight = weights[m][o];
            if weight > 0.0 {
                let own = shifts[m][o] / weight;
                let expected = others(&shifts, m, o) / others(&weights, m, o).max(f64::MIN_POSITIVE);
                all += weight * own * own;
                rest += weight * (own - expected).powi(2);
            }
        }
        let trend = modes[m].trend(data, &slope);
        rest < UNEXPLAINED * all
            || trend.is_some_and(|trend| trend.t < 0.0 && trend.explained > 1.0 - UNEXPLAINED)
    };
    (0..modes.len()).map(differs).collect()
}

/// Groups of data of one mode.
struct ModeGroups {
    /// First parameter of the mode and their number, complex.
    first: usize,
    count: usize,
    /// Block of (JᵀJ)⁻¹ of the mode.
    inverse: DMatrix<f64>,
    shape: Vec<Complex64>,
}

/// Variance between groups, and their effective number.
struct GroupSum {
    variance: PoleCovariance,
    number: f64,
}

/// The pole of an output over the square of its motion.
struct Trend {
    /// Slope over its standard error.
    t: f64,
    /// Share of the scatter of the outputs' poles that it explains.
    explained: f64,
    /// Imaginary part of the pole of an output at rest, from that of the mode \[rad/s\].
    at_rest: f64,
}

impl ModeGroups {
    fn new(data: &Data, at: &FitPoint, step: &GaussNewtonStep, m: usize) -> Self {
        let first = step.parameters.iter().position(|p| p.mode == m).unwrap_or(0);
        let count = step.parameters.iter().filter(|p| p.mode == m).count();
        let inverse = step.inverse_block(2 * first, 2 * count);
        let shape = (0..data.outputs()).map(|o| at.shape(m, o)).collect();
        Self { first, count, inverse, shape }
    }

    /// Jᵀe of one output.
    fn gradient(&self, slope: &DMatrix<f64>, o: usize) -> DMatrix<f64> {
        let mut gradient = DMatrix::zeros(2 * self.count, 1);
        for a in 0..self.count {
            let row = 2 * (self.first + a);
            let g = self.shape[o].conj() * Complex64::new(slope[(row, o)], slope[(row + 1, o)]);
            (gradient[2 * a], gradient[2 * a + 1]) = (g.re, g.im);
        }
        gradient
    }

    /// JᵀJ of the mode for products `[rr, ri, ii]` of the shape and of the derivatives.
    fn information(&self, [rr, ri, ii]: [f64; 3], gram: &dyn Fn(usize, usize) -> f64) -> DMatrix<f64> {
        let mut square = DMatrix::zeros(2 * self.count, 2 * self.count);
        for a in 0..self.count {
            for b in 0..self.count {
                let g = |i: usize, j: usize| gram(2 * a + i, 2 * b + j);
                square[(2 * a, 2 * b)] = rr * g(0, 0) + ri * (g(0, 1) + g(1, 0)) + ii * g(1, 1);
                square[(2 * a, 2 * b + 1)] = rr * g(0, 1) + ri * (g(1, 1) - g(0, 0)) - ii * g(1, 0);
                square[(2 * a + 1, 2 * b)] = rr * g(1, 0) + ri * (g(1, 1) - g(0, 0)) - ii * g(0, 1);
                square[(2 * a + 1, 2 * b + 1)] = rr * g(1, 1) - ri * (g(1, 0) + g(0, 1)) + ii * g(0, 0);
            }
        }
        square
    }

    /// Adds the change of the pole without a group: δ = B (I − G B)⁻¹ g.
    fn add(&self, total: &mut Total, gradient: &DMatrix<f64>, information: &DMatrix<f64>) {
        let size = 2 * self.count;
        let mut share = information * &self.inverse;
        let own = 0.5 * (share[(0, 0)] + share[(1, 1)]);
        if own > MAX_SHARE {
            share *= MAX_SHARE / own;
        }
        let left = DMatrix::identity(size, size) - share;
        let gradient = left.lu().solve(gradient).unwrap_or_else(|| gradient.clone());
        let change = self.inverse.rows(0, 2) * gradient;
        let (re, im) = (change[0], change[1]);
        total.sum.iter_mut().zip([re * re, im * im, re * im]).for_each(|(sum, own)| *sum += own);
        let own = own.min(MAX_SHARE);
        total.shares += own;
        total.squares += own * own;
        total.expected += own / (1.0 - own);
    }

    /// Every output is a group.
    fn outputs(&self, slope: &DMatrix<f64>, gram: &DMatrix<f64>) -> GroupSum {
        let mut total = Total::default();
        let place = 2 * self.first;
        for (o, psi) in self.shape.iter().enumerate() {
            let products = [psi.re * psi.re, psi.re * psi.im, psi.im * psi.im];
            let information = self.information(products, &|i, j| gram[(place + i, place + j)]);
            self.add(&mut total, &self.gradient(slope, o), &information);
        }
        total.groups()
    }

    /// Trend of the outputs' poles with the square of their motion; `None` with too few outputs.
    fn trend(&self, data: &Data, slope: &DMatrix<f64>) -> Option<Trend> {
        if self.count == 0 {
            return None;
        }
        let weights = self.weights();
        let number = 1.0 / weights.iter().map(|w| w * w).sum::<f64>();
        if number.is_nan() || number < MIN_TREND_GROUPS {
            return None;
        }
        let motion: Vec<f64> =
            self.shape.iter().zip(&data.output_scale).map(|(p, scale)| (p * *scale).norm_sqr()).collect();
        let mean: f64 = weights.iter().zip(&motion).map(|(w, x)| w * x).sum();
        let variance: f64 = weights.iter().zip(&motion).map(|(w, x)| w * (x - mean).powi(2)).sum();
        // Poles of the outputs, each by itself: those of large motion alone determine the trend.
        let shift = self.shifts(slope);
        let product: f64 = shift.iter().zip(&motion).map(|(own, x)| own * (x - mean)).sum();
        let trend = product / variance;
        let rest: f64 = weights
            .iter()
            .zip(&shift)
            .zip(&motion)
            .filter(|((w, _), _)| **w > 0.0)
            .map(|((w, own), x)| w * (own / w - trend * (x - mean)).powi(2))
            .sum();
        let error = (rest / (number - 2.0) / variance).sqrt();
        let explained = 1.0 - rest / (rest + trend * trend * variance);
        (error > 0.0 && error.is_finite()).then(|| Trend {
            t: trend / error,
            explained,
            at_rest: -trend * mean,
        })
    }

    /// Shares of the outputs in the energy of the mode.
    fn weights(&self) -> Vec<f64> {
        let energy = self.shape.iter().map(|p| p.norm_sqr()).sum::<f64>();
        self.shape.iter().map(|p| p.norm_sqr() / energy).collect()
    }

    /// Change of Im λ by each output \[rad/s\]; over its weight, that of the output alone.
    fn shifts(&self, slope: &DMatrix<f64>) -> Vec<f64> {
        if self.count == 0 {
            return vec![0.0; self.shape.len()];
        }
        (0..self.shape.len()).map(|o| (self.inverse.rows(1, 1) * self.gradient(slope, o))[0]).collect()
    }
}

#[derive(Default)]
struct Total {
    sum: PoleCovariance,
    shares: f64,
    squares: f64,
    /// Of δ δᵀ over the variance of the pole, for groups that differ by chance: n/(n − 1) for n equal ones.
    expected: f64,
}

impl Total {
    fn groups(self) -> GroupSum {
        let number = if self.squares > 0.0 { self.shares * self.shares / self.squares } else { 0.0 };
        let expected = self.expected.max(f64::MIN_POSITIVE);
        GroupSum { variance: self.sum.map(|sum| sum / expected), number }
    }
}

impl GroupSum {
    /// Variance in excess of noise, if it is larger than by chance.
    fn excess(&self, noise: &PoleCovariance) -> PoleCovariance {
        if self.number < MIN_GROUPS {
            return [0.0; 3];
        }
        let freedom = (self.number - 1.0).max(1.5);
        let wider = (student(freedom) / GAUSSIAN).powi(2);
        // 95 % quantile of chi² over its degrees of freedom (Wilson & Hilferty 1931).
        let width = 2.0 / (9.0 * freedom);
        let chance = (1.0 - width + 1.645 * width.sqrt()).powi(3);
        let own = self.variance;
        let of = |k: usize| if own[k] > chance * noise[k] { wider * own[k] - noise[k] } else { 0.0 };
        let (re, im) = (of(0), of(1));
        let both = if re > 0.0 && im > 0.0 { wider * own[2] - noise[2] } else { 0.0 };
        [re, im, both]
    }
}

/// Student's t for a two-sided 95 %, by the expansion about the Gaussian (Abramowitz & Stegun 26.7.5).
fn student(freedom: f64) -> f64 {
    let z = GAUSSIAN;
    let first = (z.powi(3) + z) / 4.0;
    let second = (5.0 * z.powi(5) + 16.0 * z.powi(3) + 3.0 * z) / 96.0;
    let third = (3.0 * z.powi(7) + 19.0 * z.powi(5) + 17.0 * z.powi(3) - 15.0 * z) / 384.0;
    z + first / freedom + second / freedom.powi(2) + third / freedom.powi(3)
}
