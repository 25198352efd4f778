//! The program as the process that reads one HDF5 file for another: limited in memory, computing time and files, so that
//! whatever the HDF5 library does with a damaged file ends there.

use std::ffi::OsString;
use std::process::ExitCode;

use rotordyn::io::hdf5::{Stage, serve_if_asked};

use super::system;

/// Memory of the HDF5 library besides the data, and of the program \[bytes\].
const OWN_MEMORY: u64 = 128_000_000;
/// Computing time of any question \[s\], most of which take a thousandth of it.
const BASE_SECONDS: f64 = 0.5;
/// Data that is read in a second of computing time at least, however slow the machine \[bytes\].
const SLOWEST_READING: f64 = 100e6;
/// Part of a file whose links and attributes are looked at in a second at least \[bytes\].
const SLOWEST_SEARCH: f64 = 5e6;

/// Reads the file for the process that started this one, if the arguments say so.
pub fn run(arguments: impl IntoIterator<Item = OsString>) -> Option<ExitCode> {
    serve_if_asked(arguments, &|stage, memory| match stage {
        // Data as it is read, and as its chunks are decompressed.
        Stage::Started => system::limit_memory(memory.saturating_mul(2).saturating_add(OWN_MEMORY)),
        Stage::Opened => system::limit_files(),
        Stage::Question { file, data } => system::limit_cpu_seconds(
            BASE_SECONDS + file as f64 / SLOWEST_SEARCH + data as f64 / SLOWEST_READING,
        ),
    })
}
