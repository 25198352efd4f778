//! Model updating: comparison of a model with measurements (validation) and fit of its parameters.
//!
//! | module | contents |
//! |---|---|
//! | [`target`] | measured points and modes mapped to the model |
//! | [`pairing`] | MAC, optimal assignment of measured to computed modes |
//! | `double` | repeated eigenvalues: modes of one frequency aligned with the measured shapes |
//! | [`state`] | the model's modes at the measured points, paired |
//! | [`parameter`] | free parameters: numbers of the model file, single or grouped |
//! | [`residual`] | residuals of frequencies, damping and shapes, with exact sensitivities |
//! | [`frf`] | residuals of FRFs: selected lines and their weights |
//! | [`least_squares`] | Levenberg-Marquardt with bounds and priors |
//! | [`identifiability`] | identifiability, standard errors and correlation of the parameters |

mod double;
pub mod frf;
pub mod identifiability;
pub mod least_squares;
pub mod pairing;
pub mod parameter;
pub mod residual;
pub mod state;
pub mod target;

use rayon::prelude::*;

use crate::analysis::sensitivity::SystemDerivative;
use crate::error::Error;
use crate::model::Model;
use identifiability::{Identifiability, LARGEST_ERROR, LARGEST_PRIOR_SHARE, MOSTLY_PRIOR};
use least_squares::{Evaluation, Iteration, Prior, minimise};
use parameter::FreeParameter;
use residual::{Fitting, evaluation};
use state::State;
use target::Target;

/// Error of a comparison or update with measurements: what is wrong, and what to do.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{problem}; {advice}")]
pub struct UpdateError {
    pub problem: String,
    pub advice: String,
}

impl UpdateError {
    pub fn new(problem: impl Into<String>, advice: impl Into<String>) -> Self {
        Self { problem: problem.into(), advice: advice.into() }
    }
}

/// Builds the model with parameter values (path, value) overridden.
pub type Load<'a> = dyn Fn(&[(String, String)]) -> Result<Model, Error> + Sync + 'a;

/// Input of a model update.
pub struct Job<'a> {
    pub parameters: &'a [FreeParameter],
    pub target: &'a Target,
    pub fitting: &'a Fitting,
    pub load: &'a Load<'a>,
    pub max_iterations: usize,
}

/// Identifiability class of a parameter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Verdict {
    /// Identifiable: at most 10 % of its prior variance is left, and its standard error is at most 10 %.
    Found,
    /// Poorly identifiable: at most half of its prior variance is left. It is fitted with the others.
    Poor,
    /// Not identifiable: more than half of its prior variance is left. It is reset to its start.
    NotTold,
    /// The fit ended at a bound.
    AtBound,
}

impl Verdict {
    /// Label.
    pub fn words(self) -> &'static str {
        match self {
            Verdict::Found => "found",
            Verdict::Poor => "poorly determined",
            Verdict::NotTold => "not told by the data",
            Verdict::AtBound => "at its bound",
        }
    }
}

/// A parameter after the update.
#[derive(Clone, Debug, PartialEq)]
pub struct Outcome {
    pub verdict: Verdict,
    /// Final coordinate: the fitted one, or the prior's mean if not identifiable.
    pub x: f64,
    /// Coordinate from the fit of all parameters.
    pub fitted: f64,
    /// Standard error of the coordinate.
    pub error: f64,
    /// Ratio of posterior to prior variance.
    pub prior_share: f64,
}

/// Result of a model update.
#[derive(Clone, Debug)]
pub struct Update {
    pub outcomes: Vec<Outcome>,
    pub identifiability: Identifiability,
    pub iterations: Vec<Iteration>,
    pub converged: bool,
    pub before: State,
    pub after: State,
    /// Fitted measured modes.
    pub kept: Vec<usize>,
    /// Number of data.
    pub data: usize,
}

/// Fits the free parameters; those not identifiable are reset to their start, the others fitted again.
///
/// # Errors
/// No mode pair to fit, more parameters than data, parameters without influence, no equilibrium at the start.
pub fn update(job: &Job) -> Result<Update, Error> {
    let prior = parameter::prior(job.parameters);
    let start: Vec<f64> = prior.mean.clone();
    let before = State::new((job.load)(&settings(job.parameters, &start))?, job.target, None)?;
    let mut kept: Vec<usize> = before.pairing.pairs.iter().map(|p| p.measured).collect();
    let frfs = job.fitting.frf.is_some() && job.target.frfs.is_some();
    if kept.is_empty() && !frfs {
        return Err(UpdateError::new(
            "no measured mode is paired with a computed mode",
            "check the MAC and the mapping with `rotordyn validate`, or start from a closer model",
        )
        .into());
    }
    let data = data_count(job, &kept);
    if job.parameters.len() > data {
        return Err(UpdateError::new(
            format!("there are {} free parameters, but only {data} data", job.parameters.len()),
            "free fewer, group some (\"housing.*.k_x\"), or measure more modes and points",
        )
        .into());
    }
    let mut fit = fit(job, &prior, &start, &kept)?;
    // With the improved model more measured modes may be paired.
    let mut state = job.state(&fit.x)?;
    let now: Vec<usize> = state.pairing.pairs.iter().map(|p| p.measured).collect();
    if now.len() > kept.len() {
        kept = now;
        fit = self::fit(job, &prior, &fit.x.clone(), &kept)?;
        state = job.state(&fit.x)?;
    }
    let told = identifiability::identifiability(&fit.at, &prior);
    let verdicts: Vec<Verdict> = (0..job.parameters.len()).map(|j| verdict(job, &fit.x, &told, j)).collect();
    let mut x = fit.x.clone();
    let mut iterations = fit.iterations;
    let mut converged = fit.converged;
    if verdicts.contains(&Verdict::NotTold) {
        let mut held = prior.clone();
        for j in (0..x.len()).filter(|&j| verdicts[j] == Verdict::NotTold) {
            x[j] = prior.mean[j];
            (held.lower[j], held.upper[j]) = (x[j], x[j]);
        }
        if verdicts.iter().any(|v| *v != Verdict::NotTold) {
            let again = self::fit(job, &held, &x, &kept)?;
            x = again.x;
            iterations.extend(again.iterations);
            converged &= again.converged;
        }
        state = job.state(&x)?;
    }
    let outcomes = (0..x.len())
        .map(|j| Outcome {
            verdict: verdicts[j],
            x: x[j],
            fitted: fit.x[j],
            error: told.errors[j],
            prior_share: told.prior_share[j],
        })
        .collect();
    Ok(Update { outcomes, identifiability: told, iterations, converged, before, after: state, kept, data })
}

/// Paths and values of all parameters.
pub fn settings(parameters: &[FreeParameter], x: &[f64]) -> Vec<(String, String)> {
    parameters.iter().zip(x).flat_map(|(p, x)| p.settings(*x)).collect()
}

impl Job<'_> {
    fn state(&self, x: &[f64]) -> Result<State, Error> {
        State::new((self.load)(&settings(self.parameters, x))?, self.target, None)
    }

    /// Derivatives dM, dD and dS by every coordinate at x.
    fn derivatives(&self, x: &[f64], state: &State) -> Result<Vec<SystemDerivative>, Error> {
        let all = settings(self.parameters, x);
        let one = |parameter: &FreeParameter, x: f64| {
            let (sides, width) = parameter.neighbours(x);
            let model = |own: &Vec<(String, String)>| {
                let mut set = all.clone();
                set.extend_from_slice(own);
                (self.load)(&set)
            };
            state.linear.derivative(&model(&sides[0])?, &model(&sides[1])?, width)
        };
        self.parameters.par_iter().zip(x).map(|(p, x)| one(p, *x)).collect()
    }
}

fn fit(job: &Job, prior: &Prior, start: &[f64], kept: &[usize]) -> Result<least_squares::Solution, Error> {
    let mut first = true;
    let mut evaluate = |x: &[f64]| -> Result<Evaluation, Error> {
        let state = job.state(x)?;
        let by = job.derivatives(x, &state)?;
        let found = evaluation(&state, job.target, job.fitting, kept, &by)?;
        if std::mem::take(&mut first) {
            check_influence(job, &found, prior)?;
        }
        Ok(found)
    };
    minimise(start, prior, job.max_iterations, &mut evaluate)
}

/// Minimum influence: change of the weighted residuals per prior standard deviation of a parameter.
const NO_INFLUENCE: f64 = 1e-4;

/// Error if no parameter influences the data; single ones without influence stay at their start.
fn check_influence(job: &Job, at: &Evaluation, prior: &Prior) -> Result<(), UpdateError> {
    let without: Vec<&str> = (0..job.parameters.len())
        .filter(|&j| at.jacobian.column(j).norm() * prior.deviation[j] < NO_INFLUENCE)
        .map(|j| job.parameters[j].name.as_str())
        .collect();
    if without.len() < job.parameters.len() {
        return Ok(());
    }
    let (verb, it) = if without.len() == 1 { ("has", "it affects") } else { ("have", "they affect") };
    Err(UpdateError::new(
        format!("{} {verb} no influence on the fitted data", without.join(" and ")),
        format!("free other parameters, or fit data that {it} (--fit damping, --fit frf)"),
    ))
}

/// Number of independent data: frequencies, damping ratios, shapes except for their scale, FRF lines.
fn data_count(job: &Job, kept: &[usize]) -> usize {
    let fitting = job.fitting;
    let mut count = 0;
    for mode in kept.iter().map(|&k| &job.target.modes[k]) {
        count += usize::from(fitting.frequency.is_some());
        count += usize::from(fitting.damping.is_some() && mode.damping_ratio.is_some());
        if fitting.shape.is_some() {
            count += mode.shape.len().saturating_sub(1);
        }
    }
    if let (Some(frf), Some(measured)) = (&fitting.frf, &job.target.frfs) {
        count += frf::count(measured, frf);
    }
    count
}

fn verdict(job: &Job, x: &[f64], told: &Identifiability, j: usize) -> Verdict {
    let parameter = &job.parameters[j];
    // Additive parameters: relative to the prior's deviation.
    let relative = if parameter.logarithmic { told.errors[j] } else { told.errors[j] / parameter.deviation };
    let near = 1e-9 * parameter.deviation;
    if x[j] <= parameter.lower + near || x[j] >= parameter.upper - near {
        Verdict::AtBound
    } else if told.prior_share[j] <= LARGEST_PRIOR_SHARE && relative <= LARGEST_ERROR {
        Verdict::Found
    } else if told.prior_share[j] <= MOSTLY_PRIOR {
        Verdict::Poor
    } else {
        Verdict::NotTold
    }
}
