//! Dependence of fitted values on parameters that are not free.
//!
//! The standard errors of a fit take all that is not free as exact. Two things are therefore tried of every parameter that is
//! not free, by its score test (`score_test.rs`):
//!
//! - whether the data would change it, and a fitted value with it. χ² of the whole fit sees a single wrong parameter badly: of
//!   13 degrees of freedom 17 are plausible although 15 of them vanish when one parameter more is free. The gain of the score
//!   test has one degree of freedom.
//! - whether the data can tell it from a fitted value at all. If they cannot, a wrong fixed value leaves no misfit: of Young's
//!   modulus and the diameter of a shaft, one free and the other 2 % off, the free one absorbs all of it.

use super::UpdateFailure;
use super::chi_squared::upper_probability;
use super::job::UpdateJob;
use super::parameter::FreeParameter;
use super::score_test::{MIN_GAIN, Point, Score, Scores};
use super::state::ModelState;

/// Change of a value in its standard errors, above which it depends on a parameter that is not free.
const MIN_SHIFT: f64 = 1.0;
/// Growth of the standard error of a value with a fixed parameter free, above which the data do not separate the two: a
/// correlation of 0.995.
const MIN_GROWTH: f64 = 10.0;
/// The same for a second value, once the data do not separate one from that fixed parameter: they cannot show that it is
/// wrong then.
const MIN_GROWTH_WITH_ANOTHER: f64 = 3.0;

/// A parameter that is not free, which the data would change, and a fitted value with it.
#[derive(Clone, Debug, PartialEq)]
pub struct Dependence {
    /// The parameter that is not free.
    pub on: FreeParameter,
    /// Decrease of χ² if it were free, predicted without a fit.
    pub gain: f64,
    /// Probability of such a decrease by chance, of this parameter by itself.
    pub probability: f64,
    /// Change of its coordinate then.
    pub change: f64,
    /// Change of the fitted coordinate that follows.
    pub shift: f64,
}

/// A parameter that is not free, from which the data do not separate a fitted value.
#[derive(Clone, Debug, PartialEq)]
pub struct Inseparable {
    /// The parameter that is not free.
    pub from: FreeParameter,
    /// Standard error of the fitted coordinate if it were free.
    pub error: f64,
    /// Change of the fitted coordinate for a unit change of that of the fixed parameter.
    pub slope: f64,
}

impl Inseparable {
    /// Change of the fitted coordinate for 1 % of the fixed value.
    pub fn change_for_one_per_cent(&self) -> f64 {
        let fixed = &self.from;
        self.slope * (fixed.coordinate(1.01 * fixed.value(fixed.mean)) - fixed.mean)
    }
}

/// Influence of parameters that are not free on a fitted value.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FixedInfluence {
    /// The parameter that it depends on most.
    pub depends_on: Option<Dependence>,
    /// The parameter from which it is separated worst.
    pub inseparable_from: Option<Inseparable>,
}

/// Influence of the parameters that are not free on each free parameter at a solution.
///
/// A value of standard error s depends on a parameter whose release would lower χ² by at least 6.635 (probability 1 % by
/// chance) and move the value by more than s. It is inseparable from one of standard error σ, which it follows by f for a
/// unit change, if √(s² + (σ f)²) > 10 s, or > 3 s if another value is inseparable from that one.
///
/// `errors`: s; `state`: the model at the solution. The fall of χ² is that of the data alone, in their stated deviations: a
/// fit closer than these says nothing of smaller deviations, as small errors of a measurement are rarely noise.
///
/// # Errors
/// The model cannot be evaluated at the solution.
pub(crate) fn fixed_influences(
    job: &UpdateJob,
    at: &Point,
    state: &ModelState,
    modes: &[usize],
    errors: &[f64],
) -> Result<Vec<FixedInfluence>, UpdateFailure> {
    if job.fixed.is_empty() {
        return Ok(vec![FixedInfluence::default(); errors.len()]);
    }
    let scores = at.scores(job, state, modes, job.fixed)?;
    let growth = |score: &Score, j: usize| 1.0f64.hypot(score.error * score.following[j] / errors[j]);
    let absorbed = |score: &Score| (0..errors.len()).any(|j| growth(score, j) > MIN_GROWTH);
    let absorbed: Vec<&Score> = scores.all.iter().filter(|score| absorbed(score)).collect();
    let of_value = |(j, &error): (usize, &f64)| FixedInfluence {
        depends_on: strongest(&scores, job.fixed, j, error),
        inseparable_from: absorbed
            .iter()
            .map(|score| (growth(score, j), score))
            .filter(|(growth, _)| *growth > MIN_GROWTH_WITH_ANOTHER)
            .max_by(|a, b| a.0.total_cmp(&b.0))
            .map(|(growth, score)| Inseparable {
                from: job.fixed[score.candidate].clone(),
                error: growth * error,
                slope: score.following[j],
            }),
    };
    Ok(errors.iter().enumerate().map(of_value).collect())
}

/// The parameter of the largest gain among those that value j depends on.
fn strongest(scores: &Scores, fixed: &[FreeParameter], j: usize, error: f64) -> Option<Dependence> {
    let strong =
        scores.all.iter().filter(|s| s.data_gain >= MIN_GAIN && s.shift(j).abs() > MIN_SHIFT * error);
    let best = strong.max_by(|a, b| a.data_gain.total_cmp(&b.data_gain))?;
    Some(Dependence {
        on: fixed[best.candidate].clone(),
        gain: best.data_gain,
        probability: upper_probability(best.data_gain, 1.0),
        change: best.change,
        shift: best.shift(j),
    })
}
