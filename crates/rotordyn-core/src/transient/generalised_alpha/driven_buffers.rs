//! Buffers and guesses of a step under a torque drive.

use crate::transient::numbers::vector;
use crate::transient::system::State;
use crate::transient::torque::TorqueDrive;
use crate::transient::torque::coupling::Workspace;
use nalgebra::DVector;
use serde::{Deserialize, Serialize};

/// Buffers and guesses of the iteration.
pub(super) struct DrivenStep {
    pub(super) work: Workspace,
    /// e at the end of the step, and its correction.
    pub(super) load: DVector<f64>,
    pub(super) correction: DVector<f64>,
    pub(super) response: DVector<f64>,
    /// e with what the step matrix leaves out.
    pub(super) total: DVector<f64>,
    /// End of the step.
    pub(super) x: DVector<f64>,
    pub(super) v: DVector<f64>,
    /// e and Ω̇ at the start of the previous step, and that step's length.
    pub(super) previous_load: DVector<f64>,
    pub(super) previous_rate: f64,
    pub(super) previous_step: f64,
}

/// What a step under a torque drive takes from the one before.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct DrivenMemory {
    #[serde(with = "vector")]
    previous_load: DVector<f64>,
    previous_rate: f64,
    previous_step: f64,
}

impl DrivenMemory {
    pub(super) fn fits(&self, size: usize) -> bool {
        self.previous_load.len() == size
    }
}

impl DrivenStep {
    /// What the next step takes from the last one.
    pub(super) fn memory(&self) -> DrivenMemory {
        DrivenMemory {
            previous_load: self.previous_load.clone(),
            previous_rate: self.previous_rate,
            previous_step: self.previous_step,
        }
    }

    /// Buffers after the step that left `memory`.
    pub(super) fn after(drive: &TorqueDrive, memory: &DrivenMemory) -> Self {
        let mut out = Self::new(drive, memory.previous_load.len());
        out.previous_load.copy_from(&memory.previous_load);
        (out.previous_rate, out.previous_step) = (memory.previous_rate, memory.previous_step);
        out
    }

    pub fn new(drive: &TorqueDrive, size: usize) -> Self {
        let zero = || DVector::zeros(size);
        Self {
            work: Workspace::new(drive, size),
            load: zero(),
            correction: zero(),
            response: zero(),
            total: zero(),
            x: zero(),
            v: zero(),
            previous_load: zero(),
            previous_rate: 0.0,
            previous_step: 0.0,
        }
    }

    /// Guesses e and returns the guess of Ω̇ at the end of a step.
    pub(super) fn guess(&mut self, state: &State, step: f64) -> f64 {
        self.load.copy_from(&state.driven.load);
        if self.previous_step != step {
            return state.spin.acceleration;
        }
        self.load *= 2.0;
        self.load -= &self.previous_load;
        2.0 * state.spin.acceleration - self.previous_rate
    }
}
