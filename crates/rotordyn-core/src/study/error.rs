//! Errors of studies that need both the physics and signal processing.

use crate::assembly::PhysicsError;
use rotordyn_signal::SignalError;

/// A study without result.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum StudyError {
    #[error("{0}")]
    Physics(#[from] PhysicsError),
    #[error(transparent)]
    Signal(#[from] SignalError),
}
