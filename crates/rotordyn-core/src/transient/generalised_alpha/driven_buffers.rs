//! Buffers and guesses of a step under a torque drive.

use crate::transient::system::State;
use crate::transient::torque::TorqueDrive;
use crate::transient::torque::coupling::Workspace;
use nalgebra::DVector;

/// Buffers and guesses of the iteration.
pub(super) struct DrivenStep {
    pub(super) work: Workspace,
    /// e at the end of the step, and its correction.
    pub(super) load: DVector<f64>,
    pub(super) correction: DVector<f64>,
    pub(super) response: DVector<f64>,
    pub(super) scratch: Vec<f64>,
    /// Part of Ω̇ K_s x that the effective matrix leaves out.
    pub(super) spin_up: DVector<f64>,
    pub(super) x: DVector<f64>,
    pub(super) v: DVector<f64>,
    pub(super) acceleration: DVector<f64>,
    /// e and Ω̇ at the start of the previous step, and that step's length.
    pub(super) previous_load: DVector<f64>,
    pub(super) previous_rate: f64,
    pub(super) previous_step: f64,
}

impl DrivenStep {
    pub fn new(drive: &TorqueDrive, size: usize) -> Self {
        let zero = || DVector::zeros(size);
        Self {
            work: Workspace::new(drive, size),
            load: zero(),
            correction: zero(),
            response: zero(),
            scratch: Vec::new(),
            spin_up: zero(),
            x: zero(),
            v: zero(),
            acceleration: zero(),
            previous_load: zero(),
            previous_rate: 0.0,
            previous_step: 0.0,
        }
    }

    /// Guesses e and returns the guess of Ω̇ at the end of a step.
    pub(super) fn guess(&mut self, state: &State, step: f64) -> f64 {
        self.load.copy_from(&state.driven.load);
        if self.previous_step != step {
            self.spin_up.fill(0.0);
            return state.spin.acceleration;
        }
        self.load *= 2.0;
        self.load -= &self.previous_load;
        2.0 * state.spin.acceleration - self.previous_rate
    }
}
