//! One WAV file per vibration channel of a run.

use super::Options;
use crate::error::Error;
use crate::machine_records::is_vibration;
use crate::measured;
use rotordyn_signal::record::{MeasuredData, RecordError};
use rotordyn_units::names::file_names;
use std::path::PathBuf;

/// Writes the files.
///
/// # Errors
/// A run without vibration channels, or a file that cannot be written.
pub(super) fn write(run: &MeasuredData, options: &Options) -> Result<Vec<PathBuf>, Error> {
    let audible: Vec<_> = run.records.iter().filter(|record| is_vibration(record)).collect();
    if audible.is_empty() {
        return Err(RecordError::NoChannel { name: "vibration".into(), known: "none".into() }.into());
    }
    let mut files = Vec::new();
    let stems = file_names(audible.iter().map(|record| record.name.as_str()));
    for (record, stem) in audible.into_iter().zip(stems) {
        let path = options.folder.join(format!("{stem}.wav"));
        let one = MeasuredData { records: vec![record.clone()], ..MeasuredData::default() };
        measured::write(&path, &one)?;
        files.push(path);
    }
    Ok(files)
}
