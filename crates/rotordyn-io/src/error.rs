//! The error that wraps those of all layers: input, physics, environment. Each layer owns its own.

use std::path::{Path, PathBuf};

pub use rotordyn_core::assembly::PhysicsError;
use rotordyn_core::series::SeriesError;
use rotordyn_core::study::StudyError;
use rotordyn_signal::SignalError;
use rotordyn_signal::record::RecordError;
use rotordyn_update::{UpdateError, UpdateFailure};

/// Any error other than those of reading a model file.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// A failure of the physics or of its numerical solution.
    #[error("{0}")]
    Physics(#[from] PhysicsError),
    /// A record or setting that a signal function cannot work with.
    #[error(transparent)]
    Signal(#[from] SignalError),
    /// A record unsuitable for the requested evaluation.
    #[error(transparent)]
    Record(RecordError),
    /// A failure of model updating.
    #[error(transparent)]
    Update(#[from] UpdateError),
    /// FRFs in which no modes can be identified.
    #[error(transparent)]
    Identify(#[from] rotordyn_identify::IdentifyError),
    /// A file whose content cannot be used: the problem, and a hint how to correct it.
    #[error("{}: {problem}; {advice}", path.display())]
    Content { path: PathBuf, problem: String, advice: String },
    /// A failed operation on a file or folder.
    #[error("{operation} {}: {source}", path.display())]
    Environment { operation: &'static str, path: PathBuf, source: Box<dyn std::error::Error + Send + Sync> },
}

/// Longest piece of a file in a message [characters].
const SNIPPET: usize = 60;

/// The beginning of a text from a file, for a message.
pub(crate) fn snippet(text: &str) -> String {
    match text.char_indices().nth(SNIPPET) {
        Some((end, _)) => format!("{} ...", &text[..end]),
        None => text.into(),
    }
}

impl Error {
    /// The failure of an operation on a file or folder, for `map_err`.
    pub fn of_file<E>(operation: &'static str, path: &Path) -> impl Fn(E) -> Self
    where
        E: Into<Box<dyn std::error::Error + Send + Sync>>,
    {
        move |source| Self::Environment { operation, path: path.into(), source: source.into() }
    }
}

impl From<RecordError> for Error {
    fn from(error: RecordError) -> Self {
        match error {
            RecordError::Signal(error) => Self::Signal(error),
            error => Self::Record(error),
        }
    }
}

impl From<SeriesError> for Error {
    fn from(SeriesError { place, reason }: SeriesError) -> Self {
        Self::Environment { operation: "read", path: place.into(), source: reason.into() }
    }
}

impl From<StudyError> for Error {
    fn from(error: StudyError) -> Self {
        match error {
            StudyError::Physics(error) => Self::Physics(error),
            StudyError::Signal(error) => Self::Signal(error),
            StudyError::Samples(error) => error.into(),
        }
    }
}

impl From<UpdateFailure> for Error {
    fn from(failure: UpdateFailure) -> Self {
        match failure {
            UpdateFailure::Physics(error) => Self::Physics(error),
            UpdateFailure::Input(error) => Self::Update(error),
        }
    }
}
