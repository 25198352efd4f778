//! Functions of the module: catalogue, the command, threads.

use std::ffi::OsString;
use std::path::PathBuf;

use pyo3::prelude::*;
use rotordyn::linalg::StopRequest;

use crate::cli;
use crate::failure::{Stop, detached};
use crate::reading;

#[pyfunction]
pub fn version() -> &'static str {
    env!("CARGO_PKG_VERSION")
}

/// States the program that reads HDF5 files in a process of its own; before anything is read.
#[pyfunction]
pub fn set_hdf5_program(path: Option<PathBuf>) {
    reading::set_hdf5_program(path);
}

/// Number of threads of all further computations; they exist from the first one on.
#[pyfunction]
pub fn set_threads(py: Python<'_>, threads: usize) -> PyResult<()> {
    detached(py, || {
        let built = rayon::ThreadPoolBuilder::new().num_threads(threads).build_global();
        if built.is_err() && rayon::current_num_threads() != threads {
            let text = format!(
                "the computations already have {} threads; set the number before the first one",
                rayon::current_num_threads()
            );
            return Err(Stop::from(cli::failure::Failure::Input(text)));
        }
        Ok(())
    })
}

/// Data sheets of the catalogue whose designation begins with a text, as JSON.
#[pyfunction]
pub fn catalogue(py: Python<'_>, designation: &str) -> PyResult<String> {
    detached(py, || {
        let found = cli::catalogue::run(Some(designation), &crate::study::silent(&StopRequest::default()))?;
        Ok(found["bearings"].to_string())
    })
}

/// Performs a command as the program `rotordyn` does; returns its exit code.
#[pyfunction]
pub fn command(py: Python<'_>, arguments: Vec<OsString>) -> u8 {
    py.detach(|| {
        if let Some(code) = cli::hdf5_reader::run(arguments.iter().cloned()) {
            return u8::from(code != std::process::ExitCode::SUCCESS);
        }
        cli::command(arguments, reading::hdf5_program())
    })
}
