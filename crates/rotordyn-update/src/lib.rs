//! Model updating: comparison of a model with measurements (validation) and fit of its parameters.
//!
//! | module | contents |
//! |---|---|
//! | [`target`] | measured points and modes mapped to the model |
//! | [`pairing`] | MAC, optimal assignment of measured to computed modes |
//! | `repeated` | repeated eigenvalues: modes of one frequency aligned with the measured shapes |
//! | [`state`] | the model's modes at the measured points, paired |
//! | [`correlation`] | measured and computed modes and FRFs side by side: MAC, FRAC |
//! | [`frf_levels`] | levels and signs of measured FRFs beside computed ones: wrong units, reversed and exchanged sensors |
//! | [`force_levels`] | shift of measured natural frequencies with the force level |
//! | `job` | what is fitted to what, and the fit of any choice of parameters |
//! | [`parameter`] | free parameters: numbers of the model file, single or grouped |
//! | [`residual`] | residuals of frequencies, damping and shapes, with exact sensitivities |
//! | [`frf`] | residuals of FRFs: selected lines and their weights |
//! | [`frf_scale`] | one factor between all measured and computed FRFs: wrong unit or quantity |
//! | [`least_squares`] | Levenberg-Marquardt with bounds and priors |
//! | [`identifiability`] | identifiability, standard errors and correlation of the parameters |
//! | [`data_kind`] | kinds of the data, and the misfit of each |
//! | [`goodness`], [`chi_squared`] | whether the fitted model explains the data: probability of χ² |
//! | [`dependence`] | fitted values that depend on parameters that are not free |
//! | [`culprits`] | parameters that are not free and would explain a misfit |
//! | `score_test` | gain of one more free parameter, without a fit |
//! | [`groups`] | parameters that the data cannot separate |
//! | [`profile`] | profile likelihood of a parameter, its 68 % and 95 % intervals |

pub mod chi_squared;
pub mod correlation;
pub mod culprits;
pub mod data_kind;
pub mod dependence;
mod document;
mod error;
pub mod force_levels;
pub mod frf;
pub mod frf_levels;
pub mod frf_scale;
pub mod goodness;
pub mod groups;
pub mod identifiability;
mod job;
pub mod least_squares;
pub mod pairing;
pub mod parameter;
pub mod profile;
mod repeated;
pub mod residual;
mod residual_rows;
mod score_test;
pub mod state;
pub mod target;

use dependence::{Dependence, FixedInfluence, Inseparable, fixed_influences};
pub use document::Findings;
pub use error::{UpdateError, UpdateFailure};
use goodness::GoodnessOfFit;
use identifiability::{Identifiability, MAX_PRIOR_SHARE, MAX_RELATIVE_ERROR, PRIOR_DOMINATED_SHARE};
pub use job::{ModelLoader, UpdateJob, settings};
use job::{data_count, decided, fit};
use least_squares::Iteration;
use parameter::FreeParameter;
use score_test::Point;
use state::ModelState;

/// Identifiability class of a parameter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum IdentifiabilityClass {
    /// Identifiable: at most 10 % of its prior variance is left, and its standard error is at most 10 %.
    Identifiable,
    /// Poorly identifiable: at most half of its prior variance is left. It is fitted with the others.
    PoorlyIdentifiable,
    /// Not identifiable: more than half of its prior variance is left. It is reset to its start.
    NotIdentifiable,
    /// The fit ended at a bound.
    AtBound,
    /// The data would also change a parameter that is not free, and this value with it ([`dependence`]).
    DependsOnFixed,
    /// The data do not separate the value from a parameter that is not free ([`dependence`]): its standard error holds only
    /// if that one is exact.
    InseparableFromFixed,
    /// The fitted model does not explain the data: the value stands for an error of the model elsewhere.
    PoorFit,
}

impl IdentifiabilityClass {
    /// Label.
    pub fn label(self) -> &'static str {
        match self {
            IdentifiabilityClass::Identifiable => "identifiable",
            IdentifiabilityClass::PoorlyIdentifiable => "poorly identifiable",
            IdentifiabilityClass::NotIdentifiable => "not identifiable",
            IdentifiabilityClass::AtBound => "at bound",
            IdentifiabilityClass::DependsOnFixed => "depends on a fixed value",
            IdentifiabilityClass::InseparableFromFixed => "inseparable from a fixed value",
            IdentifiabilityClass::PoorFit => "poor fit",
        }
    }

    /// Whether the value is that of the fit, and not known to be wrong.
    fn is_fitted(self) -> bool {
        matches!(self, IdentifiabilityClass::Identifiable | IdentifiabilityClass::PoorlyIdentifiable)
    }
}

/// A parameter after the update.
#[derive(Clone, Debug, PartialEq)]
pub struct Outcome {
    pub class: IdentifiabilityClass,
    /// Final coordinate: the fitted one, or the prior's mean if not identifiable.
    pub x: f64,
    /// Coordinate from the fit of all parameters.
    pub fitted: f64,
    /// Standard error of the coordinate.
    pub error: f64,
    /// Ratio of posterior to prior variance.
    pub prior_share: f64,
    /// Influence of parameters that are not free on a fitted value, if the model explains the data.
    pub fixed: FixedInfluence,
}

/// Result of a model update.
#[derive(Clone, Debug)]
pub struct Update {
    pub outcomes: Vec<Outcome>,
    pub identifiability: Identifiability,
    pub iterations: Vec<Iteration>,
    pub converged: bool,
    pub before: ModelState,
    pub after: ModelState,
    /// Fitted measured modes.
    pub fitted_modes: Vec<usize>,
    /// Number of data.
    pub data: usize,
    /// χ² of the model `after`, and whether it explains the data.
    pub goodness: GoodnessOfFit,
}

impl Update {
    /// Final coordinates.
    pub fn x(&self) -> Vec<f64> {
        self.outcomes.iter().map(|outcome| outcome.x).collect()
    }

    /// Parameters whose value depends on one that is not free, each with its outcome.
    pub fn dependences<'a>(
        &'a self,
        parameters: &'a [FreeParameter],
    ) -> impl Iterator<Item = (&'a FreeParameter, &'a Outcome, &'a Dependence)> {
        let one = |(p, o): (&'a FreeParameter, &'a Outcome)| Some((p, o, o.fixed.depends_on.as_ref()?));
        parameters.iter().zip(&self.outcomes).filter_map(one)
    }

    /// Parameters whose value is inseparable from one that is not free, each with its outcome.
    pub fn inseparable<'a>(
        &'a self,
        parameters: &'a [FreeParameter],
    ) -> impl Iterator<Item = (&'a FreeParameter, &'a Outcome, &'a Inseparable)> {
        let one = |(p, o): (&'a FreeParameter, &'a Outcome)| Some((p, o, o.fixed.inseparable_from.as_ref()?));
        parameters.iter().zip(&self.outcomes).filter_map(one)
    }

    /// Parameters fitted in the end: all but those reset to their start.
    pub fn fitted(&self) -> Vec<usize> {
        (0..self.outcomes.len()).filter(|&j| !self.outcomes[j].is_reset()).collect()
    }
}

impl Outcome {
    /// Whether the parameter has its start value, which the data do not improve.
    pub fn is_reset(&self) -> bool {
        self.class == IdentifiabilityClass::NotIdentifiable
    }
}

/// Fits the free parameters; those not identifiable are reset to their start, the others fitted again.
///
/// If the fitted model does not explain the data (probability of χ² below 1 %), no parameter is identifiable; otherwise none
/// that depends on a parameter that is not free.
///
/// # Errors
/// No mode pair to fit, more parameters than data, parameters without influence, no equilibrium at the start.
pub fn update(job: &UpdateJob) -> Result<Update, UpdateFailure> {
    decided(job, update_decided)
}

fn update_decided(job: &UpdateJob) -> Result<Update, UpdateFailure> {
    let prior = parameter::prior(job.parameters);
    let start: Vec<f64> = prior.mean.clone();
    let before = ModelState::new((job.load)(&settings(job.parameters, &start))?, job.target, None)?;
    let mut fitted_modes: Vec<usize> = before.pairing.pairs.iter().map(|p| p.measured).collect();
    let frfs = job.fitting.frf.is_some() && job.target.frfs.is_some();
    if fitted_modes.is_empty() && !frfs {
        return Err(UpdateError::new(
            "no measured mode is paired with a computed mode",
            "check the MAC and the mapping with `rotordyn validate`, or start from a closer model",
        )
        .into());
    }
    let data = data_count(job, &fitted_modes);
    if job.parameters.len() > data {
        return Err(UpdateError::new(
            format!("there are {} free parameters, but only {data} data", job.parameters.len()),
            "free fewer, group some (\"housing.*.k_x\"), or measure more modes and points",
        )
        .into());
    }
    let mut best = fit(job, &prior, &start, &fitted_modes)?;
    // With the improved model more measured modes may be paired.
    let mut state = job.state(&best.x)?;
    let now: Vec<usize> = state.pairing.pairs.iter().map(|p| p.measured).collect();
    if now.len() > fitted_modes.len() {
        fitted_modes = now;
        best = fit(job, &prior, &best.x.clone(), &fitted_modes)?;
        state = job.state(&best.x)?;
    }
    let estimate = identifiability::identifiability(&best.evaluation, &prior);
    let mut classes: Vec<IdentifiabilityClass> =
        (0..job.parameters.len()).map(|j| classify(job, &best.x, &estimate, j)).collect();
    let kept: Vec<usize> =
        (0..best.x.len()).filter(|&j| classes[j] != IdentifiabilityClass::NotIdentifiable).collect();
    let mut x = best.x.clone();
    let mut iterations = best.iterations;
    let mut converged = best.converged;
    let mut evaluation = best.evaluation;
    let mut constrained = prior.clone();
    if kept.len() < x.len() {
        for j in (0..x.len()).filter(|j| !kept.contains(j)) {
            x[j] = prior.mean[j];
            (constrained.lower[j], constrained.upper[j]) = (x[j], x[j]);
        }
        if kept.is_empty() {
            evaluation = job.evaluate(&x, &fitted_modes)?;
        } else {
            let again = fit(job, &constrained, &x, &fitted_modes)?;
            (x, evaluation) = (again.x, again.evaluation);
            iterations.extend(again.iterations);
            converged &= again.converged;
        }
        state = job.state(&x)?;
    }
    let goodness = GoodnessOfFit::new(&evaluation, &prior, &kept);
    let at = Point { parameters: job.parameters.to_vec(), prior: constrained, x };
    let mut fixed = vec![FixedInfluence::default(); classes.len()];
    if goodness.is_rejected() {
        classes.iter_mut().filter(|c| c.is_fitted()).for_each(|c| *c = IdentifiabilityClass::PoorFit);
    } else if classes.iter().any(|class| class.is_fitted()) {
        fixed = fixed_influences(job, &at, &state, &fitted_modes, &estimate.errors)?;
        for (class, found) in classes.iter_mut().zip(&mut fixed) {
            if !class.is_fitted() {
                *found = FixedInfluence::default();
            } else if found.depends_on.is_some() {
                *class = IdentifiabilityClass::DependsOnFixed;
            } else if found.inseparable_from.is_some() {
                *class = IdentifiabilityClass::InseparableFromFixed;
            }
        }
    }
    let outcomes = (fixed.into_iter().enumerate())
        .map(|(j, fixed)| Outcome {
            class: classes[j],
            x: at.x[j],
            fitted: best.x[j],
            error: estimate.errors[j],
            prior_share: estimate.prior_share[j],
            fixed,
        })
        .collect();
    Ok(Update {
        outcomes,
        identifiability: estimate,
        iterations,
        converged,
        before,
        after: state,
        fitted_modes,
        data,
        goodness,
    })
}

fn classify(job: &UpdateJob, x: &[f64], estimate: &Identifiability, j: usize) -> IdentifiabilityClass {
    let parameter = &job.parameters[j];
    // Additive parameters: relative to the prior's deviation.
    let relative =
        if parameter.logarithmic { estimate.errors[j] } else { estimate.errors[j] / parameter.deviation };
    let near = 1e-9 * parameter.deviation;
    if x[j] <= parameter.lower + near || x[j] >= parameter.upper - near {
        IdentifiabilityClass::AtBound
    } else if estimate.prior_share[j] <= MAX_PRIOR_SHARE && relative <= MAX_RELATIVE_ERROR {
        IdentifiabilityClass::Identifiable
    } else if estimate.prior_share[j] <= PRIOR_DOMINATED_SHARE {
        IdentifiabilityClass::PoorlyIdentifiable
    } else {
        IdentifiabilityClass::NotIdentifiable
    }
}
