//! This program as the process that reads one HDF5 file for a target, limited like that of the command line.

use std::ffi::OsString;
use std::process::ExitCode;

use rotordyn::io::budget::Limits;
use rotordyn::io::hdf5::{Stage, serve_if_asked};

use crate::limits;

/// Memory of the HDF5 library besides the data, and of the program \[bytes\].
const OWN_MEMORY: u64 = 256_000_000;

/// Processor time for one question \[s\], as the program allows for files of this size.
const SECONDS: f64 = 0.5;

/// Environment variable that says where a worker reads HDF5 files.
pub const PLACE_VARIABLE: &str = "ROTORDYN_FUZZ_HDF5";
/// In the worker itself.
pub const HERE: &str = "here";
/// In a process for each file.
pub const APART: &str = "apart";

/// The limits with which targets read files: HDF5 by this program in a process of its own, as by the command line.
///
/// With [`PLACE_VARIABLE`] as [`HERE`], the worker itself reads them: many times faster, and a crash of the HDF5 library
/// ends it.
pub fn reading_limits() -> Limits {
    let program = if is_here() { None } else { std::env::current_exe().ok() };
    Limits { hdf5_program: program, ..Limits::default() }
}

/// Whether this process reads HDF5 files itself.
pub fn is_here() -> bool {
    std::env::var_os(PLACE_VARIABLE).is_some_and(|value| value == HERE)
}

/// Reads the file for the process that started this one, if the arguments say so.
pub fn run(arguments: impl IntoIterator<Item = OsString>) -> Option<ExitCode> {
    serve_if_asked(arguments, &|stage, memory| match stage {
        Stage::Started => limits::limit_memory(memory.saturating_mul(2).saturating_add(OWN_MEMORY)),
        Stage::Opened => {}
        Stage::Question { .. } => limits::limit_cpu_seconds(SECONDS),
    })
}
