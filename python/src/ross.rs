//! Rotors that ROSS saved: the command `import`.

use std::path::PathBuf;

use pyo3::prelude::*;
use rotordyn::io::ross;
use rotordyn::warning::{Code, Warning};

use crate::cli::failure::Failure;
use crate::cli::import::model_name;
use crate::cli::limits::limits;
use crate::failure::detached;
use crate::reading::use_default_limits;
use crate::source::{WarningTexts, warning_texts};

/// A saved rotor as the text of a model named like `name`: text, version of ROSS, what was carried over (what, number,
/// into), and a warning for each part that was not.
#[pyfunction]
#[allow(clippy::type_complexity)]
pub fn import_ross(
    py: Python<'_>,
    path: PathBuf,
    name: &str,
) -> PyResult<(String, String, Vec<(String, usize, String)>, Vec<WarningTexts>)> {
    use_default_limits();
    detached(py, || {
        let found = ross::import(&path, &model_name(name), limits()).map_err(Failure::from)?;
        let carried = found.carried.into_iter().map(|row| (row.what, row.count, row.into)).collect();
        let lost = found.not_carried.iter().map(|row| {
            warning_texts(&Warning::new(Code::NotImported, "", format!("{}: {}", row.item, row.why)))
        });
        Ok((found.text, found.version, carried, lost.collect()))
    })
}
