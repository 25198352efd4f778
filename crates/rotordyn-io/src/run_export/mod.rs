//! Time histories of a run in the file formats of other programs, for `export`: a line of [`FORMATS`] each.

mod options;
mod wav_files;

pub use options::Options;

use crate::error::Error;
use crate::machine_records::with_cwru_names;
use crate::measured;
use rotordyn_signal::record::MeasuredData;
use std::path::PathBuf;

/// A file format of exported time histories.
#[derive(Clone, Copy, Debug)]
pub struct RunFormat {
    /// Its name on the command line.
    pub name: &'static str,
    write: Writer,
}

/// Writes the channels of a run; returns the files.
pub type Writer = fn(&MeasuredData, &Options) -> Result<Vec<PathBuf>, Error>;

/// Every format.
pub const FORMATS: [RunFormat; 5] = [
    RunFormat { name: "csv", write: |run, options| one_file(run, options, "csv") },
    RunFormat { name: "uff", write: |run, options| one_file(run, options, "uff") },
    RunFormat {
        name: "mat",
        write: |run, options| one_file(&with_cwru_names(run, options.number), options, "mat"),
    },
    RunFormat { name: "npz", write: |run, options| one_file(run, options, "npz") },
    RunFormat { name: "wav", write: wav_files::write },
];

impl RunFormat {
    /// A format of one's own.
    pub const fn new(name: &'static str, write: Writer) -> Self {
        Self { name, write }
    }

    /// The format of a name.
    pub fn named(name: &str) -> Option<Self> {
        FORMATS.into_iter().find(|format| format.name == name)
    }

    /// Writes the channels of a run; returns the files.
    ///
    /// # Errors
    /// Records that the format cannot store, or a file that cannot be written.
    pub fn write(&self, run: &MeasuredData, options: &Options) -> Result<Vec<PathBuf>, Error> {
        (self.write)(run, options)
    }
}

fn one_file(run: &MeasuredData, options: &Options, extension: &str) -> Result<Vec<PathBuf>, Error> {
    let path = options.folder.join(format!("channels.{extension}"));
    measured::write(&path, run)?;
    Ok(vec![path])
}
