//! What an implicit step takes from those before it: stored, and set again.

use serde::{Deserialize, Serialize};

use super::driven_buffers::{DrivenMemory, DrivenStep};
use super::force_history::ForceHistory;
use super::kept_jacobian::Kept;
use super::step_matrix::{Inversions, StepMatrices};
use super::{GeneralisedAlpha, Scheme};
use crate::transient::system::System;

/// Guesses and inversions that later steps use, and the counters of the report.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct StepMemory {
    forces: ForceHistory,
    inversions: Inversions,
    driven: Option<DrivenMemory>,
    jacobian: Kept,
    iterations: u64,
}

impl StepMemory {
    /// Whether it is one of a system of this size.
    pub fn fits(&self, system: &System) -> bool {
        self.forces.places() == system.interface_size()
            && self.jacobian.fits(system.rows())
            && self.driven.as_ref().is_none_or(|driven| system.drive.is_some() && driven.fits(system.size()))
    }
}

impl GeneralisedAlpha {
    /// What the next step takes from the last ones.
    pub fn memory(&self) -> StepMemory {
        StepMemory {
            forces: self.forces.clone(),
            inversions: self.matrices.inversions(),
            driven: self.driven.as_ref().map(DrivenStep::memory),
            jacobian: self.newton.memory(),
            iterations: self.iterations(),
        }
    }

    /// The integrator after the steps that left `memory`, which fits the system; its next step has the same bits.
    pub fn after(system: &System, scheme: Scheme, memory: &StepMemory) -> Self {
        let mut out = Self::new(system, scheme);
        out.forces = memory.forces.clone();
        out.matrices = StepMatrices::repeat(system, scheme, &memory.inversions);
        let driven = system.drive.as_ref().zip(memory.driven.as_ref());
        out.driven = driven.map(|(drive, memory)| DrivenStep::after(drive, memory));
        out.newton.restore(&memory.jacobian, memory.iterations);
        out
    }
}
