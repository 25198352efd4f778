//! Provenance of results: what they were computed from, in `/meta`.

use super::GroupWriter;
use super::external_files::write_external_files;
use crate::error::Error;
use crate::hdf5::{Attribute, COMPLETE, Reader, Store, run_state};
use crate::run_identity::run_identity;
use rotordyn_core::model::ExternalFile;

/// Version of the names of groups, data sets and attributes, in `/meta`.
pub const SCHEMA: i64 = 2;

const META: &str = "/meta";

/// Provenance of results.
#[derive(Clone, Copy, Debug, Default)]
pub struct Meta<'a> {
    /// Text of the model file.
    pub model: &'a str,
    pub title: &'a str,
    /// Empty for the base model.
    pub variant: &'a str,
    /// Every override "path = value" of the file.
    pub settings: &'a [String],
}

/// All that results were computed from.
#[derive(Clone, Debug, Default)]
pub struct Provenance {
    /// Text of the model file.
    pub model: String,
    pub title: String,
    /// Empty for the base model.
    pub variant: String,
    /// Every override "path = value" of the file.
    pub settings: Vec<String>,
    /// Bearings with estimated internal geometry, "name: how" a line.
    pub estimated_geometry: String,
    /// Source of the run's speed if it is measured, not that of the model's text.
    pub measured_speed: Option<String>,
    /// Data files that the model refers to.
    pub files: Vec<ExternalFile>,
}

impl Provenance {
    /// Identity of results computed from this, see [`run_identity`].
    pub fn identity(&self) -> String {
        run_identity(self.model.as_bytes(), &self.variant, &self.settings, &self.files)
    }

    /// Writes `/meta` into a new file.
    ///
    /// # Errors
    /// The file cannot be written.
    pub fn write(&self, store: &Store) -> Result<(), Error> {
        let Self { model, title, variant, settings, .. } = self;
        write_meta(store, &Meta { model, title, variant, settings })?;
        store.set_attribute(META, "identity", self.identity())?;
        if !self.estimated_geometry.is_empty() {
            store.set_attribute(META, "estimated_geometry", self.estimated_geometry.as_str())?;
        }
        if let Some(source) = &self.measured_speed {
            store.set_attribute(META, "speed", format!("as measured: {source}"))?;
        }
        write_external_files(store, &self.files)
    }
}

/// Writes `/meta`, replacing an earlier one.
///
/// # Errors
/// The file cannot be written.
pub fn write_meta(store: &Store, meta: &Meta) -> Result<(), Error> {
    let writer = GroupWriter::new(store, META)?;
    writer.set_attribute("schema", SCHEMA)?;
    writer.set_attribute("program", "rotordyn")?;
    writer.set_attribute("version", env!("CARGO_PKG_VERSION"))?;
    writer.set_attribute("git", option_env!("ROTORDYN_GIT").unwrap_or("unknown"))?;
    writer.set_attribute("model", meta.model)?;
    writer.set_attribute("title", meta.title)?;
    writer.set_attribute("variant", meta.variant)?;
    writer.set_attribute("settings", meta.settings.join("\n"))?;
    writer.set_attribute(
        "seed",
        "none for the program: random parts of the model have their seeds in its text",
    )?;
    writer.set_attribute("units", "SI: m, kg, s, N, rad; speeds in rad/s unless named rpm, frequencies in Hz")
}

/// Schema of a stored file; 1 for files written before the attribute was added.
///
/// # Errors
/// The file cannot be read.
pub fn schema(store: &dyn Reader) -> Result<i64, Error> {
    Ok(match attribute(store, "schema")? {
        Some(Attribute::Integer(schema)) => schema,
        _ => 1,
    })
}

/// Identity of the results of a file; `None` in files written before it was added.
///
/// # Errors
/// The file cannot be read.
pub fn stored_identity(store: &dyn Reader) -> Result<Option<String>, Error> {
    Ok(text(attribute(store, "identity")?))
}

/// Figures and tables that belong to the results of a file, relative to its folder.
///
/// # Errors
/// The file cannot be read.
pub fn stored_files(store: &dyn Reader) -> Result<Vec<String>, Error> {
    Ok(match attribute(store, "files")? {
        Some(Attribute::Texts(files)) => files,
        _ => Vec::new(),
    })
}

pub(super) fn set_stored_files(store: &Store, files: &[String]) -> Result<(), Error> {
    if files.is_empty() {
        return Ok(());
    }
    store.set_attribute(META, "files", files.to_vec())
}

/// State of the results: "complete", "running" (the program was killed or still runs) or "stopped: reason".
///
/// # Errors
/// The file cannot be read.
pub fn results_state(store: &dyn Reader) -> Result<String, Error> {
    let of_run = run_state(store, "")?.filter(|state| state != COMPLETE);
    let state = match of_run {
        Some(state) => Some(state),
        None => text(attribute(store, "run_state")?),
    };
    Ok(state.unwrap_or_else(|| COMPLETE.into()))
}

pub(super) fn set_results_state(store: &Store, state: &str) -> Result<(), Error> {
    store.set_attribute(META, "run_state", state)
}

fn attribute(store: &dyn Reader, name: &str) -> Result<Option<Attribute>, Error> {
    if store.contains(META)? { store.attribute(META, name) } else { Ok(None) }
}

fn text(attribute: Option<Attribute>) -> Option<String> {
    match attribute {
        Some(Attribute::Text(text)) => Some(text),
        _ => None,
    }
}
