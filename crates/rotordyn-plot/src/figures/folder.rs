//! Where figures are written, and of which run they are.

use std::path::{Path, PathBuf};

/// Folder of figures; `&Path` and `&PathBuf` are folders of figures of no run.
#[derive(Clone, Copy, Debug)]
pub struct FigureFolder<'a> {
    pub(super) path: &'a Path,
    pub(super) identity: Option<&'a str>,
}

impl<'a> FigureFolder<'a> {
    /// A folder of figures that belong to no run.
    pub fn new(path: &'a Path) -> Self {
        Self { path, identity: None }
    }

    /// The same folder; the figures carry the identity of the run that they show.
    pub fn with_identity(self, identity: &'a str) -> Self {
        Self { identity: Some(identity), ..self }
    }
}

impl<'a> From<&'a Path> for FigureFolder<'a> {
    fn from(path: &'a Path) -> Self {
        Self::new(path)
    }
}

impl<'a> From<&'a PathBuf> for FigureFolder<'a> {
    fn from(path: &'a PathBuf) -> Self {
        Self::new(path)
    }
}
