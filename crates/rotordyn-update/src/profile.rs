//! Profile likelihood of a parameter: χ² over its value with all other parameters fitted again.
//!
//! The interval of a probability has the values whose χ² exceeds the smallest one by less than that quantile of χ² with
//! one degree of freedom: 1.00 for 68.3 %, 3.84 for 95 %. It holds where the standard error does not, for a parameter on
//! which the data depend nonlinearly, and it is open where they do not bound the parameter. Source: Venzon & Moolgavkar,
//! *Applied Statistics* 37 (1988), 87–94.

use super::job::{UpdateJob, decided, fit};
use super::least_squares::Solution;
use super::parameter::prior;
use super::{Update, UpdateFailure};

/// Increase of χ² at the ends of the 68.3 % interval.
pub const DELTA_68: f64 = 1.0;
/// Increase of χ² at the ends of the 95 % interval.
pub const DELTA_95: f64 = 3.841_459;
/// Increase of χ² at which the profile ends.
const DELTA_END: f64 = 6.0;
/// Largest number of values on either side of the smallest χ².
const MAX_STEPS: usize = 12;
/// Factor by which the parameter's own prior is widened: the profile is of the data and of the other priors.
const NO_PRIOR: f64 = 1e6;

/// χ² over the coordinate of a parameter.
#[derive(Clone, Debug, PartialEq)]
pub struct Profile {
    /// Which of the free parameters.
    pub parameter: usize,
    /// Coordinates in ascending order, and the smallest χ² at each, that of the other parameters' priors included.
    pub x: Vec<f64>,
    pub chi_squared: Vec<f64>,
    /// Coordinate of the smallest χ², and that χ².
    pub best: f64,
    pub least: f64,
    /// Factor of the increases: that of the standard errors squared, above 1 if χ² exceeds its degrees of freedom.
    pub scale: f64,
    /// Ends of the intervals; `None` where χ² does not increase so far up to a bound or four prior deviations.
    pub interval_68: [Option<f64>; 2],
    pub interval_95: [Option<f64>; 2],
}

/// Profile of one of the free parameters about the solution of an update.
///
/// # Errors
/// The model cannot be evaluated at the solution.
pub fn profile(job: &UpdateJob, found: &Update, parameter: usize) -> Result<Profile, UpdateFailure> {
    decided(job, |job| Profiler { job, found, parameter }.profile())
}

struct Profiler<'a> {
    job: &'a UpdateJob<'a>,
    found: &'a Update,
    parameter: usize,
}

impl Profiler<'_> {
    /// Fit with the parameter at a value, or free without its prior.
    fn at(&self, x: Option<f64>, start: &[f64]) -> Result<Solution, UpdateFailure> {
        let j = self.parameter;
        let mut own = prior(self.job.parameters);
        own.deviation[j] *= NO_PRIOR;
        let mut start = start.to_vec();
        if let Some(x) = x {
            (own.lower[j], own.upper[j], own.mean[j], start[j]) = (x, x, x, x);
        }
        fit(self.job, &own, &start, &self.found.fitted_modes)
    }

    fn profile(&self) -> Result<Profile, UpdateFailure> {
        let j = self.parameter;
        let parameter = &self.job.parameters[j];
        let outcomes = &self.found.outcomes;
        let start: Vec<f64> = outcomes.iter().map(|outcome| outcome.fitted).collect();
        let scale = self.found.identifiability.scale[j].powi(2);
        // Without its prior the parameter can leave the range in which it has an influence.
        let reach = 4.0 * parameter.deviation;
        let (lower, upper) =
            (parameter.lower.max(parameter.mean - reach), parameter.upper.min(parameter.mean + reach));
        let free = self.at(None, &start).ok().filter(|free| (lower..=upper).contains(&free.x[j]));
        let middle = match free {
            Some(free) => free,
            None => self.at(Some(start[j].clamp(lower, upper)), &start)?,
        };
        let mut points = vec![(middle.x[j], chi_squared(&middle))];
        let width = outcomes[j].error.min(parameter.deviation).max(1e-6 * parameter.deviation);
        for way in [-1.0, 1.0] {
            let end = if way < 0.0 { lower } else { upper };
            let (mut x, mut from, mut step) = (middle.x[j], middle.x.clone(), 0.5 * width);
            for _ in 0..MAX_STEPS {
                let next = (x + way * step).clamp(lower, upper);
                let Ok(there) = self.at(Some(next), &from) else { break };
                let rise = (chi_squared(&there) - points[0].1) / scale;
                points.push((next, chi_squared(&there)));
                // A flat profile is crossed in growing steps.
                if rise < 0.2 * DELTA_68 {
                    step *= 2.0;
                }
                (x, from) = (next, there.x);
                if rise > DELTA_END || next == end {
                    break;
                }
            }
        }
        points.sort_by(|a, b| a.0.total_cmp(&b.0));
        let best = points.iter().copied().min_by(|a, b| a.1.total_cmp(&b.1)).unwrap_or(points[0]);
        let interval = |delta: f64| [-1.0, 1.0].map(|way| crossing(&points, best, delta * scale, way));
        Ok(Profile {
            parameter: j,
            best: best.0,
            least: best.1,
            scale,
            interval_68: interval(DELTA_68),
            interval_95: interval(DELTA_95),
            x: points.iter().map(|p| p.0).collect(),
            chi_squared: points.iter().map(|p| p.1).collect(),
        })
    }
}

/// Twice the objective: χ² of the data with the priors of the other parameters.
fn chi_squared(solution: &Solution) -> f64 {
    2.0 * solution.iterations.last().map_or(f64::NAN, |last| last.cost)
}

/// Coordinate at which χ² has risen by `delta` on one side of the best one, by interpolation of √(χ² − least), which is
/// nearly linear.
fn crossing(points: &[(f64, f64)], best: (f64, f64), delta: f64, way: f64) -> Option<f64> {
    let root = |p: &(f64, f64)| (p.1 - best.1).max(0.0).sqrt();
    let mut side: Vec<&(f64, f64)> = points.iter().filter(|p| way * (p.0 - best.0) >= 0.0).collect();
    side.sort_by(|a, b| (way * a.0).total_cmp(&(way * b.0)));
    let pair = side.windows(2).find(|pair| root(pair[1]) >= delta.sqrt())?;
    let (from, to) = (root(pair[0]), root(pair[1]));
    Some(pair[0].0 + (pair[1].0 - pair[0].0) * (delta.sqrt() - from) / (to - from))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn crossings_of_a_parabola_and_of_one_side() {
        // ((x − 1)/0.2)² + 7
        let points: Vec<(f64, f64)> = [0.4, 0.7, 0.9, 1.0, 1.1, 1.35]
            .into_iter()
            .map(|x: f64| (x, ((x - 1.0) / 0.2).powi(2) + 7.0))
            .collect();
        let best = (1.0, 7.0);
        for (delta, way, expected) in [(1.0, 1.0, Some(1.2)), (1.0, -1.0, Some(0.8)), (4.0, -1.0, Some(0.6))]
        {
            let found: Option<f64> = crossing(&points, best, delta, way);
            let (found, expected): (f64, f64) = (found.unwrap(), expected.unwrap());
            assert!((found - expected).abs() < 1e-12, "{delta} {way}: {found}");
        }
        assert_eq!(crossing(&points, best, 4.0, 1.0), None);
    }
}
