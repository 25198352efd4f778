//! Results file of a folder: created, or extended if it belongs to the same model.

use std::path::Path;

use rotordyn::io::hdf5::{Attribute, Store};
use rotordyn::io::results_file::{self, Meta};
use rotordyn::model::{Loaded, Options};

use super::failure::Failure;
use super::machine::ModelSource;
use super::terminal::Terminal;

/// Name of the results file.
pub const FILE: &str = "results.h5";

/// Model text and title stored in a results file.
#[derive(Clone)]
pub struct ModelText<'a> {
    /// Text of the model file.
    pub model: &'a str,
    pub title: &'a str,
    /// Bearings with estimated internal geometry, "name: how" a line.
    pub estimated: String,
}

/// One line "name: how" for every bearing with estimated internal geometry.
pub fn estimated_lines<'b>(bearings: impl Iterator<Item = (&'b str, &'b str)>) -> String {
    bearings.map(|(name, how)| format!("{name}: {how}")).collect::<Vec<_>>().join("\n")
}

impl<'a> From<&'a Loaded> for ModelText<'a> {
    fn from(loaded: &'a Loaded) -> Self {
        let estimated = estimated_lines(loaded.model.estimated_geometries());
        Self { model: &loaded.text, title: &loaded.model.title, estimated }
    }
}

/// Opens the results file of a folder; one of a different model version or with an earlier schema is renamed to
/// results_previous.h5.
pub fn open(
    folder: &Path,
    text: ModelText,
    origin: &ModelSource,
    overwrite: bool,
    terminal: &Terminal,
) -> Result<Store, Failure> {
    let path = folder.join(FILE);
    if path.exists() && !overwrite {
        let stored = Store::append(&path)?;
        let same = stored_origin(&stored)
            .is_ok_and(|other| other.text == text.model.as_bytes() && other.options == origin.options);
        let current = results_file::schema(&stored).is_ok_and(|schema| schema == results_file::SCHEMA);
        if same && current {
            return Ok(stored);
        }
        let reason = match same {
            true => "has another schema",
            false => "belongs to another version of the model",
        };
        drop(stored);
        let previous = folder.join("results_previous.h5");
        std::fs::rename(&path, &previous).map_err(|e| Failure::environment("rename", &path, e))?;
        terminal.print(&format!("{} {reason}: renamed to {}", path.display(), previous.display()));
    }
    let store = Store::create(&path)?;
    let set = &origin.options.set;
    let settings: Vec<String> = set.iter().map(|(path, value)| format!("{path} = {value}")).collect();
    let meta = Meta {
        model: text.model,
        title: text.title,
        variant: origin.options.variant.as_deref().unwrap_or_default(),
        settings: &settings,
    };
    results_file::write_meta(&store, &meta)?;
    if !text.estimated.is_empty() {
        store.set_attribute("/meta", "estimated_geometry", text.estimated.as_str())?;
    }
    results_file::write_external_files(&store, &origin.side_files(&origin.options))?;
    Ok(store)
}

/// Model text, variant and settings stored in a results file.
pub fn stored_origin(store: &Store) -> Result<ModelSource, Failure> {
    let text = |name: &str| match store.attribute("/meta", name) {
        Ok(Some(Attribute::Text(text))) => Ok(text),
        _ => Err(Failure::Input(format!("{} contains no rotordyn run", store.path().display()))),
    };
    let setting = |line: &str| line.split_once(" = ").map(|(path, value)| (path.into(), value.into()));
    let variant = Some(text("variant")?).filter(|name| !name.is_empty());
    let set = text("settings")?.lines().filter_map(setting).collect();
    Ok(ModelSource {
        name: format!("{} /meta model", store.path().display()),
        text: text("model")?.into_bytes(),
        options: Options { variant, set },
        folder: store.path().parent().map(Path::to_path_buf).unwrap_or_default(),
        files: Some(results_file::read_external_files(store)?),
    })
}
