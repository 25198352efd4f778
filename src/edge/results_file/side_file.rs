//! External data files of a model, stored with its text: a stored run can be evaluated without them.

use super::Place;
use crate::edge::hdf5::{Attribute, Store};
use crate::error::Error;
use crate::model::{SideColumn, SideFile};

const GROUP: &str = "/meta/files";

/// Writes the columns of the files below `/meta`; call after `write_meta`, which empties that group.
///
/// # Errors
/// The file cannot be written.
pub fn write_side_files(store: &Store, files: &[SideFile]) -> Result<(), Error> {
    if files.is_empty() {
        return Ok(());
    }
    let place = Place::new(store, GROUP)?;
    place.note("paths", files.iter().map(|file| file.path.clone()).collect::<Vec<String>>())?;
    for (k, file) in files.iter().enumerate() {
        let Ok(columns) = &file.content else { continue };
        let at = place.below(&k.to_string())?;
        at.note("columns", columns.iter().map(|c| c.name.clone()).collect::<Vec<String>>())?;
        at.note("units", columns.iter().map(|c| c.unit.clone()).collect::<Vec<String>>())?;
        for (c, column) in columns.iter().enumerate() {
            at.array(&c.to_string(), &[column.values.len()], &column.values, &column.unit)?;
        }
    }
    Ok(())
}

/// Reads them back; empty if the model has none.
///
/// # Errors
/// The file cannot be read.
pub fn read_side_files(store: &Store) -> Result<Vec<SideFile>, Error> {
    let texts = |group: &str, name: &str| -> Result<Vec<String>, Error> {
        Ok(match store.attribute(group, name)? {
            Some(Attribute::Texts(texts)) => texts,
            Some(Attribute::Text(text)) => vec![text],
            _ => Vec::new(),
        })
    };
    if !store.contains(GROUP) {
        return Ok(Vec::new());
    }
    let read = |(k, path): (usize, String)| -> Result<SideFile, Error> {
        let group = format!("{GROUP}/{k}");
        let columns = texts(&group, "columns")?.into_iter().zip(texts(&group, "units")?).enumerate();
        let column = |(c, (name, unit)): (usize, (String, String))| -> Result<SideColumn, Error> {
            Ok(SideColumn { name, unit, values: store.read(&format!("{group}/{c}"))?.data })
        };
        Ok(SideFile { path, content: Ok(columns.map(column).collect::<Result<_, _>>()?) })
    };
    texts(GROUP, "paths")?.into_iter().enumerate().map(read).collect()
}
