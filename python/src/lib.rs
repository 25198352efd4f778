//! The native part of the Python package `rotordyn`: models, studies and results behind the classes in `rotordyn/*.py`.
//!
//! | module | contents |
//! |---|---|
//! | `cli` | the command line of the program: settings of studies by flags, messages, the command itself |
//! | `failure` | failures as Python exceptions, with the snippet of the model |
//! | `source` | a model file with variant and changes |
//! | `study` | the linear studies |
//! | `run` | run-ups, stopped by Ctrl-C, with progress |
//! | `results` | what a study found: tree, JSON, figures, files, bytes |
//! | `identify`, `update`, `bearing` | modes of measurements, model updating, ball bearings by themselves |
//! | `analysis` | what these found: tree, JSON, figures, files |
//! | `ross`, `to_ross` | rotors that ROSS saved; a machine in the elements of ROSS |
//! | `tree` | documents of results as Python values and NumPy arrays |
//! | `signal` | diagnosis of measured records |
//! | `matrices` | system matrices with labels |
//! | `reading` | limits of what is read from files |
//! | `module` | functions of the module |

#[path = "../../src/cli/mod.rs"]
mod cli;

mod analysis;
mod bearing;
mod failure;
mod identify;
mod matrices;
mod module;
mod reading;
mod results;
mod ross;
mod run;
mod signal;
mod source;
mod study;
mod to_ross;
mod tree;
mod update;

#[pyo3::pymodule(name = "_native")]
mod native {
    #[pymodule_export]
    use crate::analysis::Analysis;
    #[pymodule_export]
    use crate::bearing::bearings;
    #[pymodule_export]
    use crate::identify::{Measured, identify};
    #[pymodule_export]
    use crate::matrices::matrices;
    #[pymodule_export]
    use crate::module::{catalogue, command, set_hdf5_program, set_threads, version};
    #[pymodule_export]
    use crate::results::{StudyResults, results_of_bytes};
    #[pymodule_export]
    use crate::ross::import_ross;
    #[pymodule_export]
    use crate::run::{run_orders, run_spectrograms, run_up};
    #[pymodule_export]
    use crate::signal::diagnose;
    #[pymodule_export]
    use crate::source::Source;
    #[pymodule_export]
    use crate::study::linear_study;
    #[pymodule_export]
    use crate::to_ross::ross_elements;
    #[pymodule_export]
    use crate::update::update;
}
