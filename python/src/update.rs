//! Model updating: the command `update` on a model in memory.

use pyo3::prelude::*;

use crate::analysis::{Analysis, Found};
use crate::cli::args::Command;
use crate::cli::failure::Failure;
use crate::cli::update::read;
use crate::cli::update_fit::{Fit, UpdateContext};
use crate::cli::{free_parameters, update_findings};
use crate::failure::{Stop, interruptible};
use crate::identify::Measured;
use crate::source::Source;
use crate::study::{parsed, silent};

/// A fit of the free parameters in `words`, the arguments of the command `update` without the model; `measured` takes the
/// place of the measured file.
#[pyfunction]
pub fn update(
    py: Python<'_>,
    source: &Source,
    words: Vec<String>,
    measured: Option<&Measured>,
) -> PyResult<Analysis> {
    let (origin, model) = (source.file.clone(), source.loaded.model.clone());
    let given = measured.map(|measured| measured.data.clone());
    interruptible(py, move |stop| {
        let words: Vec<String> = std::iter::once("update".into()).chain(words).collect();
        let Command::Update(args) = parsed(&words)? else {
            return Err(Stop::from(Failure::Input("this command updates no model".into())));
        };
        let terminal = silent(stop);
        let parameters = free_parameters::parameters(&args, &origin, &terminal)?;
        update_findings::check_profiles(&args.profile, &parameters)?;
        let folder = std::env::temp_dir();
        let context = UpdateContext { origin: &origin, folder: &folder, terminal: &terminal };
        let model = context.with_films(model)?;
        let read = read(&args, &model, given, &terminal)?;
        let fit = Fit::new(&args, &context, model.title, parameters, read)?;
        fit.pair_warnings(&terminal)?;
        let findings = fit.findings(&context, &args.profile)?;
        fit.warn(&terminal, &findings);
        Ok(Analysis::new(Found::Update(Box::new((fit, findings))), &terminal.warnings(), 0))
    })
}
