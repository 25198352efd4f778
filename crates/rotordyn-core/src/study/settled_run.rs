//! Criteria of settling, and the run that meets them.

use crate::results::SteadyMotion;
use crate::transient::steady::SteadyRun;
use rotordyn_signal::poincare::StroboscopicSampling;

/// Criteria of the classification.
#[derive(Clone, Copy, Debug)]
pub(super) struct Criteria {
    pub tolerance: f64,
    pub longest_period: usize,
    /// Perturbation for a Lyapunov exponent \[m\].
    pub perturbation: Option<f64>,
}

/// The last record of a run, its section instants and its motion.
pub(super) struct SettledRun {
    pub run: SteadyRun,
    pub strobe: StroboscopicSampling,
    pub motion: SteadyMotion,
}
