//! Errors of model updating.

use rotordyn_core::assembly::PhysicsError;

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

/// A comparison or update that cannot be computed: by the physics, or by its input.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum UpdateFailure {
    #[error("{0}")]
    Physics(#[from] PhysicsError),
    #[error(transparent)]
    Input(#[from] UpdateError),
}
