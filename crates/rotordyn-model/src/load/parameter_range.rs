//! Validation of a bifurcation parameter: the model must be valid at its first and last value.

use crate::build;
use crate::file::diagnostic::{Kind, Log, Problem, Sources};
use crate::file::overlay::apply_set;
use crate::file::tree::{Table, Value};
use crate::study::{Continuation, Parameter};
use crate::{ExternalFile, Model};

/// Set the parameter of a bifurcation diagram to its first and last value and validate the model: an unknown
/// path, a wrong unit or an invalid value is reported at the study before any run.
pub(super) fn check(root: &Table, files: &[ExternalFile], model: &Model, log: &Log) {
    let Some(study) = &model.studies.bifurcation else { return };
    let parameter = &study.parameter;
    let Some(last) = parameter.values.len().checked_sub(1) else { return };
    let mut ends = Vec::new();
    for k in [0, last] {
        match model_at(root, files, parameter, k, log.file_end()) {
            Ok(model) => ends.push(model),
            Err(why) => {
                let (key, kind) =
                    if why.is_path { ("parameter", Kind::BadPath) } else { ("values", Kind::BadQuantity) };
                let message = format!(
                    "{} cannot be {}: {}",
                    parameter.paths.join(", "),
                    parameter.texts[k],
                    why.message
                );
                let mut problem = Problem::new(kind, &study_key_span(root, key), message);
                if let Some(hint) = why.hint {
                    problem = problem.hint(hint);
                }
                log.error(problem);
                return;
            }
        }
    }
    let size = |model: &Model| (model.node_count(), model.bearings.len());
    if let [first, last] = &ends[..]
        && size(first) != size(last)
        && matches!(study.continuation, Continuation::PreviousState { .. })
    {
        let message = format!("{} changes the number of degrees of freedom", parameter.paths.join(", "));
        let problem = Problem::new(Kind::Conflict, &study_key_span(root, "parameter"), message);
        log.error(
            problem.hint("the state cannot be continued from value to value: add start = \"equilibrium\""),
        );
    }
}

/// Reason why the model is invalid at a parameter value.
struct InvalidParameter {
    is_path: bool,
    message: String,
    hint: Option<String>,
}

fn model_at(
    root: &Table,
    files: &[ExternalFile],
    parameter: &Parameter,
    k: usize,
    file_end: usize,
) -> Result<Model, InvalidParameter> {
    let (mut varied, log, mut sources) = (root.clone(), Log::default(), Sources::default());
    // the spans of the settings lie beyond those of the file
    sources.push("", " ".repeat(file_end));
    log.set_file_end(file_end);
    for (path, value) in parameter.settings(k) {
        apply_set(&mut varied, [&path, &value], false, &mut sources, &log);
    }
    let mut is_path = log.error_count() > 0;
    let model =
        (!is_path).then(|| build::build_model(&varied, files, &log)).filter(|_| log.error_count() == 0);
    model.ok_or_else(|| {
        let first = sources.locate(log.into_errors()).into_iter().next();
        is_path |= first.as_ref().is_some_and(|d| d.kind == Kind::UnknownKey);
        let (message, hint) = first.map_or_else(Default::default, |d| (d.message, d.hint.or(d.expected)));
        InvalidParameter { is_path, message, hint }
    })
}

/// Span of a key of the study.
fn study_key_span(root: &Table, key: &str) -> std::ops::Range<usize> {
    let mut table = root;
    for name in ["study", "bifurcation"] {
        match table.get(name).map(|e| &e.node.value) {
            Some(Value::Table(next)) => table = next,
            _ => return 0..0,
        }
    }
    table.get(key).map_or(0..0, |e| e.node.span.clone())
}
