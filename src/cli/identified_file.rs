//! Results file of `identify`.

use std::path::{Path, PathBuf};

use rotordyn::document::Section;
use rotordyn::io::hdf5::Store;
use rotordyn::io::results_file;

use super::failure::Failure;
use super::store::FILE;

/// Writes the results file of a folder with the modes of a measurement; returns its path.
pub fn write_results(folder: &Path, title: &str, section: &Section) -> Result<PathBuf, Failure> {
    let path = folder.join(FILE);
    let store = Store::replace(&path)?;
    store.set_attribute("/meta", "program", "rotordyn")?;
    store.set_attribute("/meta", "version", env!("CARGO_PKG_VERSION"))?;
    store.set_attribute("/meta", "title", title)?;
    results_file::write_section(&store, "", section)?;
    store.commit()?;
    Ok(path)
}
