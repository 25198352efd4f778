//! External data files of a model, stored with its text: a stored run can be evaluated without them.

use super::GroupWriter;
use crate::budget::Budget;
use crate::error::Error;
use crate::hdf5::{Attribute, Reader, Store};
use rotordyn_core::model::{ExternalColumn, ExternalFile};

const GROUP: &str = "/meta/files";

/// Writes the columns of the files below `/meta`; call after `write_meta`, which empties that group.
///
/// # Errors
/// The file cannot be written.
pub fn write_external_files(store: &Store, files: &[ExternalFile]) -> Result<(), Error> {
    if files.is_empty() {
        return Ok(());
    }
    let writer = GroupWriter::new(store, GROUP)?;
    writer.set_attribute("paths", files.iter().map(|file| file.path.clone()).collect::<Vec<String>>())?;
    for (k, file) in files.iter().enumerate() {
        let Ok(columns) = &file.content else { continue };
        let at = writer.subgroup(&k.to_string())?;
        at.set_attribute("columns", columns.iter().map(|c| c.name.clone()).collect::<Vec<String>>())?;
        at.set_attribute("units", columns.iter().map(|c| c.unit.clone()).collect::<Vec<String>>())?;
        for (c, column) in columns.iter().enumerate() {
            at.write_array(&c.to_string(), &[column.values.len()], &column.values, &column.unit)?;
        }
    }
    Ok(())
}

/// Reads them back; empty if the model has none.
///
/// # Errors
/// The file cannot be read.
pub fn read_external_files(store: &dyn Reader) -> Result<Vec<ExternalFile>, Error> {
    let texts = |group: &str, name: &str| -> Result<Vec<String>, Error> {
        Ok(match store.attribute(group, name)? {
            Some(Attribute::Texts(texts)) => texts,
            Some(Attribute::Text(text)) => vec![text],
            _ => Vec::new(),
        })
    };
    if !store.contains(GROUP)? {
        return Ok(Vec::new());
    }
    let budget = Budget::of_memory(store.memory());
    let read = |(k, path): (usize, String)| -> Result<ExternalFile, Error> {
        let group = format!("{GROUP}/{k}");
        let columns = texts(&group, "columns")?.into_iter().zip(texts(&group, "units")?).enumerate();
        let column = |(c, (name, unit)): (usize, (String, String))| -> Result<ExternalColumn, Error> {
            let values = store.read(&format!("{group}/{c}"))?.data;
            let taken = budget.take_values::<f64>(|| group.clone(), values.len());
            taken.map_err(|exceeded| exceeded.of_file(store.path()))?;
            Ok(ExternalColumn { name, unit, values })
        };
        Ok(ExternalFile { path, content: Ok(columns.map(column).collect::<Result<_, _>>()?) })
    };
    texts(GROUP, "paths")?.into_iter().enumerate().map(read).collect()
}
