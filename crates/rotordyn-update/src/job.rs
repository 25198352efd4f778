//! The job of a model update: the fit and its parts, for any choice of free parameters.

use rayon::prelude::*;

use super::error::{UpdateError, UpdateFailure};
use super::frf;
use super::least_squares::{self, Evaluation, Prior, minimise};
use super::parameter::{self, FreeParameter};
use super::residual::{Fitting, evaluate_residuals};
use super::state::ModelState;
use super::target::Target;
use rotordyn_core::analysis::ball_inertia::{ball_inertia, is_undecided, with_decisions};
use rotordyn_core::analysis::sensitivity::SystemDerivative;
use rotordyn_core::assembly::Assembly;
use rotordyn_core::model::Model;

/// Builds the model with parameter values (path, value) overridden.
pub type ModelLoader<'a> = dyn Fn(&[(String, String)]) -> Result<Model, UpdateError> + Sync + 'a;

/// Input of a model update.
pub struct UpdateJob<'a> {
    pub parameters: &'a [FreeParameter],
    pub target: &'a Target,
    pub fitting: &'a Fitting,
    pub load: &'a ModelLoader<'a>,
    pub max_iterations: usize,
    /// Parameters that are not free but may be wrong, such as [`parameter::candidates`]: a value that depends on one of them
    /// is not identifiable, and a misfit is searched among them. Empty: all that is not free is taken as exact.
    pub fixed: &'a [FreeParameter],
}

/// Calls `with` on the job with the decisions on ball inertia of its first model, for all steps.
pub(crate) fn decided<T>(
    job: &UpdateJob,
    with: impl FnOnce(&UpdateJob) -> Result<T, UpdateFailure>,
) -> Result<T, UpdateFailure> {
    let first = (job.load)(&settings(job.parameters, &parameter::prior(job.parameters).mean))?;
    if !is_undecided(&first) {
        return with(job);
    }
    let used = ball_inertia(&first, &Assembly::new(&first)?, job.target.speed, None);
    let load =
        |settings: &[(String, String)]| (job.load)(settings).map(|model| with_decisions(&model, &used));
    with(&UpdateJob { load: &load, ..*job })
}

/// Paths and values of all parameters.
pub fn settings(parameters: &[FreeParameter], x: &[f64]) -> Vec<(String, String)> {
    parameters.iter().zip(x).flat_map(|(p, x)| p.settings(*x)).collect()
}

impl UpdateJob<'_> {
    pub(crate) fn state(&self, x: &[f64]) -> Result<ModelState, UpdateFailure> {
        ModelState::new((self.load)(&settings(self.parameters, x))?, self.target, None)
    }

    /// Derivatives dM, dD and dS by every coordinate at x.
    fn derivatives(&self, x: &[f64], state: &ModelState) -> Result<Vec<SystemDerivative>, UpdateFailure> {
        let all = settings(self.parameters, x);
        let one = |parameter: &FreeParameter, x: f64| self.derivative(&all, parameter, x, state);
        self.parameters.par_iter().zip(x).map(|(p, x)| one(p, *x)).collect()
    }

    /// Derivatives dM, dD and dS of the model with settings `all` by the coordinate of a parameter at x.
    pub(crate) fn derivative(
        &self,
        all: &[(String, String)],
        parameter: &FreeParameter,
        x: f64,
        state: &ModelState,
    ) -> Result<SystemDerivative, UpdateFailure> {
        let (sides, width) = parameter.difference_settings(x);
        let model = |own: &[(String, String)]| (self.load)(&[all, own].concat());
        Ok(state.linearised.derivative(&model(&sides[0])?, &model(&sides[1])?, width)?)
    }

    /// Residuals of the modes `kept` and of the FRFs at x, with their derivatives.
    pub(crate) fn evaluate(&self, x: &[f64], kept: &[usize]) -> Result<Evaluation, UpdateFailure> {
        let state = self.state(x)?;
        let by = self.derivatives(x, &state)?;
        evaluate_residuals(&state, self.target, self.fitting, kept, &by)
    }
}

/// Fits the parameters to the modes `kept` and the FRFs.
pub(crate) fn fit(
    job: &UpdateJob,
    prior: &Prior,
    start: &[f64],
    kept: &[usize],
) -> Result<least_squares::Solution, UpdateFailure> {
    let mut first = true;
    let mut evaluate = |x: &[f64]| -> Result<Evaluation, UpdateFailure> {
        let found = job.evaluate(x, kept)?;
        if std::mem::take(&mut first) {
            check_influence(job, &found, prior)?;
        }
        Ok(found)
    };
    minimise(start, prior, job.max_iterations, &mut evaluate)
}

/// Minimum influence: change of the weighted residuals per prior standard deviation of a parameter.
const MIN_INFLUENCE: f64 = 1e-4;

/// Error if no parameter influences the data; single ones without influence stay at their start.
fn check_influence(job: &UpdateJob, at: &Evaluation, prior: &Prior) -> Result<(), UpdateError> {
    let without: Vec<&str> = (0..job.parameters.len())
        .filter(|&j| at.jacobian.column(j).norm() * prior.deviation[j] < MIN_INFLUENCE)
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
pub(crate) fn data_count(job: &UpdateJob, kept: &[usize]) -> usize {
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
        count += frf::data_count(measured, frf);
    }
    count
}
