//! Rotors as ROSS saves them (`Rotor.save`, TOML or JSON), turned into a model file of this program.
//!
//! | file | what it does |
//! |---|---|
//! | `tree` | text to a tree of values, with the places of names for messages |
//! | [`rotor`] | tree to elements: [`SavedRotor`], in SI units as in the file |
//! | [`mapping`] | elements to tables and keys of the model file, with what was carried over and what was not |
//! | `text` | tables and keys to the text of the file |
//!
//! Format: one table for each element, named by its class and tag (`ShaftElement_Shaft Element 0`), `parameters` of the
//! rotor, `ross_version` (absent in files before 2.0). Node numbers count from 0 along the shaft; nodes of point masses follow.

pub mod mapping;
pub mod rotor;
mod text;
mod tree;

pub use mapping::{Carried, Imported, NotCarried};
pub use rotor::SavedRotor;

use crate::budget::{self, Limits};
use crate::error::Error;
use rotordyn_model::ModelErrors;
use std::path::Path;

/// Why a file is not imported.
#[derive(Debug, thiserror::Error)]
pub enum ImportError {
    /// The file cannot be read, or is too large.
    #[error(transparent)]
    File(#[from] Error),
    /// Its content is no rotor of ROSS; all problems at once, each with its place.
    #[error(transparent)]
    Content(#[from] ModelErrors),
}

/// Reads a rotor and writes it as a model file named `name`.
///
/// # Errors
/// A file that cannot be read or is beyond its budget, content that is no saved rotor, or one without a shaft.
pub fn import(path: &Path, name: &str, limits: &Limits) -> Result<Imported, ImportError> {
    let (bytes, budget) = budget::read_file(path, limits)?;
    let tree =
        tree::Tree::read(&path.display().to_string(), &bytes, &budget).map_err(|problem| match problem {
            tree::Unreadable::Content(errors) => ImportError::Content(errors),
            tree::Unreadable::TooLarge(exceeded) => ImportError::File(exceeded.of_file(path)),
        })?;
    let rotor = SavedRotor::read(&tree)?;
    budget.objects("elements", rotor.element_count()).map_err(|exceeded| exceeded.of_file(path))?;
    let file = path.file_name().map_or_else(String::new, |file| file.to_string_lossy().into_owned());
    Ok(mapping::model_file(&rotor, name, &file))
}
