//! Dependence of fitted values on parameters that are not free.
//!
//! χ² of the whole fit sees a single wrong parameter badly: of 13 degrees of freedom 17 are plausible although 15 of them
//! vanish when one parameter more is free, and the fitted values may move by many standard errors then. So every parameter
//! that is not free is tried by its score test (`score_test.rs`), whose gain has one degree of freedom.

use super::UpdateFailure;
use super::chi_squared::upper_probability;
use super::goodness::{FitQuality, GoodnessOfFit};
use super::job::UpdateJob;
use super::parameter::FreeParameter;
use super::score_test::{MIN_GAIN, Point, Scores};
use super::state::ModelState;

/// Change of a value in its standard errors, above which it depends on a parameter that is not free.
const MIN_SHIFT: f64 = 1.0;

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

/// What each free parameter at a solution depends on most, of the parameters that are not free.
///
/// A value depends on a parameter whose release would lower χ² by at least 6.635 (probability 1 % by chance) and move the
/// value by more than one standard error, `errors`; `state`: the model at the solution. Where the stated deviations of the data are too large, their scale is
/// taken from the misfit: the likelihood ratio is then ν ln(χ²/(χ² − gain)).
///
/// # Errors
/// The model cannot be evaluated at the solution.
pub(crate) fn dependences(
    job: &UpdateJob,
    at: &Point,
    state: &ModelState,
    modes: &[usize],
    errors: &[f64],
    goodness: &GoodnessOfFit,
) -> Result<Vec<Option<Dependence>>, UpdateFailure> {
    if job.fixed.is_empty() {
        return Ok(vec![None; errors.len()]);
    }
    let scores = at.scores(job, state, modes, job.fixed)?;
    Ok(strongest(&scores, job.fixed, errors, goodness))
}

fn strongest(
    scores: &Scores,
    fixed: &[FreeParameter],
    errors: &[f64],
    goodness: &GoodnessOfFit,
) -> Vec<Option<Dependence>> {
    let ratio = |gain: f64| match goodness.quality() {
        FitQuality::DeviationsTooLarge => {
            let left = (1.0 - gain / goodness.chi_squared).max(f64::EPSILON);
            -goodness.degrees_of_freedom * left.ln()
        }
        _ => gain,
    };
    let of_value = |(j, error): (usize, &f64)| {
        let strong = scores
            .all
            .iter()
            .filter(|score| ratio(score.gain) >= MIN_GAIN && score.following[j].abs() > MIN_SHIFT * error);
        let best = strong.max_by(|a, b| a.gain.total_cmp(&b.gain))?;
        Some(Dependence {
            on: fixed[best.candidate].clone(),
            gain: best.gain,
            probability: upper_probability(ratio(best.gain), 1.0),
            change: best.change,
            shift: best.following[j],
        })
    };
    errors.iter().enumerate().map(of_value).collect()
}
