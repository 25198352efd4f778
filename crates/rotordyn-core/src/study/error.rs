//! Errors of studies that need the physics, signal processing and recorded samples.

use crate::assembly::PhysicsError;
use crate::series::SeriesError;
use rotordyn_signal::SignalError;

/// A study without result.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum StudyError {
    #[error("{0}")]
    Physics(#[from] PhysicsError),
    #[error(transparent)]
    Signal(#[from] SignalError),
    /// Recorded samples that cannot be read.
    #[error(transparent)]
    Samples(#[from] SeriesError),
}
