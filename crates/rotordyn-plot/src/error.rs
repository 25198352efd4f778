//! Failure to draw or to write a figure.

use rotordyn_core::series::SeriesError;
use std::path::{Path, PathBuf};

/// A failed operation on a figure's file or folder.
#[derive(Debug, thiserror::Error)]
#[error("{operation} {}: {source}", path.display())]
pub struct FigureError {
    pub operation: &'static str,
    pub path: PathBuf,
    pub source: Box<dyn std::error::Error + Send + Sync>,
}

impl FigureError {
    /// The failure of an operation on a file or folder, for `map_err`.
    pub(crate) fn of_file<E>(operation: &'static str, path: &Path) -> impl Fn(E) -> Self
    where
        E: Into<Box<dyn std::error::Error + Send + Sync>>,
    {
        move |source| Self { operation, path: path.into(), source: source.into() }
    }
}

impl From<SeriesError> for FigureError {
    fn from(SeriesError { place, reason }: SeriesError) -> Self {
        Self { operation: "read", path: place.into(), source: reason.into() }
    }
}
