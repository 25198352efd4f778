//! Tables of the results as CSV files in the results folder.

use super::failure::Failure;
use rotordyn::document::Section;
use rotordyn::io::document_tables;
use std::path::{Path, PathBuf};

/// Writes the tables of sections to `csv/` in the results folder; returns the files.
pub(super) fn write_csv(folder: &Path, sections: &[Section]) -> Result<Vec<PathBuf>, Failure> {
    Ok(document_tables::write_csv(&folder.join("csv"), sections)?)
}
