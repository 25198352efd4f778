//! A model held against what was measured, and changed until it agrees.
//!
//! | module | what it does |
//! |---|---|
//! | [`target`] | measured points and modes put into the model |
//! | [`pairing`] | MAC, optimal assignment of measured to computed modes |
//! | `double` | modes of one frequency turned to the measured shapes |
//! | [`state`] | the model's modes at the measured points, paired |
//! | [`parameter`] | numbers of the file that may change, alone or in groups |
//! | [`residual`] | frequencies, damping and shapes as data, with their exact derivatives |
//! | [`frf`] | FRFs alike: lines, what they are worth |
//! | [`least_squares`] | Levenberg-Marquardt with bounds and priors |
//! | [`identifiability`] | what the data tell of each parameter |

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

/// Why a model cannot be held against a measurement: what is wrong, and what to do.
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

/// The model with paths and values laid over it.
pub type Load<'a> = dyn Fn(&[(String, String)]) -> Result<Model, Error> + Sync + 'a;

/// What is asked of an update.
pub struct Job<'a> {
    pub parameters: &'a [FreeParameter],
    pub target: &'a Target,
    pub fitting: &'a Fitting,
    pub load: &'a Load<'a>,
    pub max_iterations: usize,
}

/// What a parameter may be called.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Verdict {
    /// The data tell it: at most a tenth of its prior variance is left, and its standard error is 10 % at most.
    Found,
    /// The data tell something: at most half of its prior variance is left. It is changed with the others.
    Poor,
    /// More than half of its prior variance is left: it stays at its start, and the others are fitted beside it.
    NotTold,
    /// It ended at a bound.
    AtBound,
}

impl Verdict {
    /// In words.
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
    /// Coordinate that the model is left at: the fitted one, or the prior's mean where the data do not tell it.
    pub x: f64,
    /// Coordinate that the fit of all parameters gave.
    pub fitted: f64,
    /// Standard error of the coordinate.
    pub error: f64,
    /// Posterior over prior variance.
    pub prior_share: f64,
}

/// What came out of an update.
#[derive(Clone, Debug)]
pub struct Update {
    pub outcomes: Vec<Outcome>,
    pub identifiability: Identifiability,
    pub iterations: Vec<Iteration>,
    pub converged: bool,
    pub before: State,
    pub after: State,
    /// Measured modes that were fitted.
    pub kept: Vec<usize>,
    /// Number of data.
    pub data: usize,
}

/// Fits the free parameters; those that the data do not tell go back to their start, and the others are fitted again.
///
/// # Errors
/// No pair to fit, more free parameters than data, parameters without influence, no equilibrium at the start.
pub fn update(job: &Job) -> Result<Update, Error> {
    let prior = parameter::prior(job.parameters);
    let start: Vec<f64> = prior.mean.clone();
    let before = State::new((job.load)(&settings(job.parameters, &start))?, job.target, None)?;
    let mut kept: Vec<usize> = before.pairing.pairs.iter().map(|p| p.measured).collect();
    let frfs = job.fitting.frf.is_some() && job.target.frfs.is_some();
    if kept.is_empty() && !frfs {
        return Err(UpdateError::new(
            "no measured mode has a partner in the model",
            "look at the MAC and the mapping with `rotordyn validate`, or start from a nearer model",
        )
        .into());
    }
    let data = data_count(job, &kept);
    if job.parameters.len() > data {
        return Err(UpdateError::new(
            format!("{} parameters are free, and there are {data} data", job.parameters.len()),
            "free fewer, let some move together (\"housing.*.k_x\"), or measure more modes and points",
        )
        .into());
    }
    let mut fit = fit(job, &prior, &start, &kept)?;
    // With the model nearer, measured modes may have found partners that they had not.
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

    /// dM, dD and dS by every coordinate at x.
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

/// A parameter whose prior's whole width moves no datum by this part of its deviation has no influence.
const NO_INFLUENCE: f64 = 1e-4;

/// One without influence among others stays at its start; where none has any there is nothing to fit.
fn check_influence(job: &Job, at: &Evaluation, prior: &Prior) -> Result<(), UpdateError> {
    let without: Vec<&str> = (0..job.parameters.len())
        .filter(|&j| at.jacobian.column(j).norm() * prior.deviation[j] < NO_INFLUENCE)
        .map(|j| job.parameters[j].name.as_str())
        .collect();
    if without.len() < job.parameters.len() {
        return Ok(());
    }
    let (verb, it) = if without.len() == 1 { ("changes", "it changes") } else { ("change", "they change") };
    Err(UpdateError::new(
        format!("{} {verb} nothing that was measured", without.join(" and ")),
        format!("free something else, or fit something that {it} (--fit damping, --fit frf)"),
    ))
}

/// Data that are independent: frequencies, damping ratios, shapes but for their size, FRF lines.
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
    // An additive parameter has no value to be relative to: its prior's width serves.
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
