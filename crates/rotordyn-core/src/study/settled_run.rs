//! Criteria of settling, and the run that meets them.

use crate::results::SteadyMotion;
use crate::transient::steady::{SteadyRun, SteadySnapshot};
use crate::transient::system::State;
use rotordyn_signal::motion_classification::Classification;
use rotordyn_signal::poincare::StroboscopicSampling;
use serde::{Deserialize, Serialize};

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
    /// Whether it ended by itself; else it was stopped and has the periods recorded by then.
    pub complete: bool,
}

/// A run that is continued until its motion has settled, after a period of its clock.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SettledSnapshot {
    /// Periods discarded before the present record, and how many of them the present run discards.
    pub(super) discarded: usize,
    pub(super) transient_periods: usize,
    /// Motion of the record before.
    pub(super) before: Option<Classification>,
    pub(super) run: SteadySnapshot,
}

impl SettledSnapshot {
    /// Time of the run \[s\].
    pub fn time(&self) -> f64 {
        self.run.time()
    }
}

/// Where a run that is to settle begins.
pub(super) enum SettledStart {
    State(Box<State>),
    Snapshot(Box<SettledSnapshot>),
}
