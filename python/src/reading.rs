//! Limits of what is read from files.

use std::path::PathBuf;
use std::sync::OnceLock;

use crate::cli::limits;

/// The program that reads HDF5 files: the command of the wheel, if it is installed.
static HDF5_PROGRAM: OnceLock<Option<PathBuf>> = OnceLock::new();

/// States the program that reads HDF5 files; the first call holds.
pub fn set_hdf5_program(path: Option<PathBuf>) {
    let _ = HDF5_PROGRAM.set(path);
}

/// The program that reads HDF5 files in a process of its own; `None`: this process reads them.
pub fn hdf5_program() -> Option<PathBuf> {
    HDF5_PROGRAM.get().cloned().flatten()
}

/// The usual limits, of a process that is not a command: a command sets its own.
pub fn use_default_limits() {
    limits::set(None, hdf5_program());
}
