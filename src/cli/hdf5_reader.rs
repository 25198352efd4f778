//! The program as the process that reads one HDF5 file for another: limited in memory, computing time and files, so that
//! whatever the HDF5 library does with a damaged file ends there.

use std::ffi::OsString;
use std::path::Path;
use std::process::ExitCode;

use rotordyn::io::hdf5::{READER_ARGUMENT, Stage, serve};

use super::system;

/// Memory of the HDF5 library besides the data, and of the program \[bytes\].
const OWN_MEMORY: u64 = 128_000_000;
/// Data that is read in a second of computing time at least, however slow the machine \[bytes\].
const SLOWEST_READING: u64 = 100_000_000;

/// Reads the file for the process that started this one, if the arguments say so: size of the data, file.
pub fn run(arguments: impl IntoIterator<Item = OsString>) -> Option<ExitCode> {
    let mut arguments = arguments.into_iter().skip(1);
    if arguments.next()? != READER_ARGUMENT {
        return None;
    }
    let (memory, file) = (arguments.next()?, arguments.next()?);
    let memory: u64 = memory.to_str()?.parse().ok()?;
    // Data as it is read, and as its chunks are decompressed.
    system::limit_memory(memory.saturating_mul(2).saturating_add(OWN_MEMORY));
    let prepare = |stage| match stage {
        Stage::Opened => system::limit_files(),
        Stage::Question => system::limit_cpu_seconds(1 + memory / SLOWEST_READING),
    };
    let mut questions = std::io::stdin().lock();
    let served = serve(Path::new(&file), memory, &mut questions, std::io::stdout().lock(), &prepare);
    Some(if served.is_ok() { ExitCode::SUCCESS } else { ExitCode::FAILURE })
}
