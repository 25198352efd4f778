//! The result of a command: what it prints and which files it wrote.

use super::args::OutputFiles;
use super::checkpoint::CheckpointWriter;
use super::failure::Failure;
use super::studies::{Job, Study};
use super::terminal::Terminal;
use miette::Severity;
use rotordyn::model::{Diagnostic, Loaded, Source};
use rotordyn::results::Results;
use rotordyn::study::Machine;
use rotordyn::warning::Warning;
use serde_json::{Value, json};
use std::path::{Path, PathBuf};

/// Result of a command: JSON document, `null` if none is asked for, and failed studies.
pub(crate) struct Outcome {
    pub(super) document: Value,
    pub(super) failures: Vec<(&'static str, Failure)>,
}

impl From<Value> for Outcome {
    fn from(document: Value) -> Self {
        Self { document, failures: Vec::new() }
    }
}

/// Writes the results and figures of a job, prints the file list and the warnings.
pub(super) fn finish(
    mut job: Job,
    studies: &[Study],
    written: OutputFiles,
    command: &'static str,
) -> Result<Outcome, Failure> {
    let known = job.results.warnings.len();
    collect_warnings(&mut job, studies);
    match job.write(written) {
        Err(failure) => job.failures.push(("", failure)),
        Ok(()) if job.failures.iter().any(|(_, failure)| matches!(failure, Failure::Interrupted)) => {
            job.checkpoints.iter().for_each(|checkpoints| checkpoints.say_how_to_go_on(job.terminal));
        }
        Ok(()) => job.checkpoints.iter().for_each(CheckpointWriter::remove),
    }
    let terminal = job.terminal;
    for (name, how) in job.machine.model.estimated_geometries() {
        terminal.print(&format!("  internal geometry of bearing {name} {how}"));
    }
    let rows: Vec<Vec<String>> =
        job.seconds.iter().map(|(name, s)| vec![(*name).to_string(), format!("{s:.3}")]).collect();
    terminal.table("Computing time (elapsed)", &["", "s"], &rows);
    if !job.files.is_empty() {
        print_written_files(terminal, &job.folder, &job.files);
    }
    if job.files.len() > 1 {
        terminal.print("  (figures are written as SVG and PNG)");
    }
    job.results.warnings[known..].iter().for_each(|warning| terminal.warn(warning));
    if !terminal.json {
        return Ok(Outcome { document: Value::Null, failures: job.failures });
    }
    let mut document = rotordyn::io::json::to_json(&job.results, &job.machine);
    if let Some(object) = document.as_object_mut() {
        object.insert("command".into(), command.into());
        let seconds: serde_json::Map<_, _> =
            job.seconds.iter().map(|(name, s)| ((*name).to_string(), json!(s))).collect();
        object.insert("seconds".into(), seconds.clone().into());
        object.insert("wall_seconds".into(), seconds.into());
        let cpu: serde_json::Map<_, _> =
            job.cpu_seconds.iter().map(|(name, s)| ((*name).to_string(), json!(s))).collect();
        object.insert("cpu_seconds".into(), cpu.into());
        object.insert("files".into(), json!(job.files));
        if let Some(checkpoints) = &job.checkpoints {
            object.insert("checkpoints".into(), checkpoints.to_json());
        }
        object.insert("identity".into(), job.output.writer.identity().into());
    }
    Ok(Outcome { document, failures: job.failures })
}

/// Warnings of the studies and their results.
pub(super) fn collect_warnings(job: &mut Job, studies: &[Study]) {
    let found = std::mem::take(&mut job.warnings);
    add_warnings(&job.machine, &mut job.results, studies, found);
}

/// Adds warnings to those of the results, and those of the studies and of what they found; each once.
pub(crate) fn add_warnings(
    machine: &Machine,
    results: &mut Results,
    studies: &[Study],
    mut found: Vec<Warning>,
) {
    let mut speeds: Vec<f64> = studies.iter().flat_map(|study| study.speeds(&machine.model)).collect();
    // A study without speeds of its own, such as a run under torque, is at least one at standstill.
    if speeds.is_empty() && !studies.is_empty() {
        speeds.push(0.0);
    }
    found.extend(machine.warnings(results, &speeds));
    for warning in found {
        if !results.warnings.contains(&warning) {
            results.warnings.push(warning);
        }
    }
}

/// Prints the list of written files, wrapped to the line width, and last the page of all results.
pub(super) fn print_written_files(terminal: &Terminal, folder: &Path, files: &[PathBuf]) {
    terminal.heading(&format!("Written to {}", folder.display()));
    let mut line = String::from(" ");
    let is_page = |file: &&PathBuf| file.ends_with(super::report_page::FILE);
    for file in files.iter().filter(|file| !is_page(file)) {
        let name = file.strip_prefix(folder).unwrap_or(file).display().to_string();
        if line.len() + name.len() > 98 {
            terminal.print(&line);
            line = String::from(" ");
        }
        line.push(' ');
        line.push_str(&name);
    }
    if !line.trim().is_empty() {
        terminal.print(&line);
    }
    if let Some(page) = files.iter().find(is_page) {
        terminal.print(&format!("  page of all results, to open first: {}", page.display()));
    }
}

/// Prints the warnings and hints of the model file.
pub(super) fn print_model_warnings(terminal: &Terminal, loaded: &Loaded) {
    print_file_warnings(terminal, &loaded.hints, &loaded.warnings, &loaded.sources);
}

/// Hints and warnings of a model file; those printed before are not repeated.
pub(super) fn print_file_warnings(
    terminal: &Terminal,
    hints: &[Diagnostic],
    warnings: &[Diagnostic],
    sources: &[Source],
) {
    super::renamed::print_hints(hints, sources, terminal);
    // Those of the file itself are those of each of its variants.
    let known = terminal.warnings();
    let is_new = |found: &&Diagnostic| found.to_warning().is_none_or(|warning| !known.contains(&warning));
    let found: Vec<Diagnostic> = warnings.iter().filter(is_new).cloned().collect();
    if !found.is_empty() {
        let text = super::diagnostics::render(&found, sources, Severity::Warning, terminal.colour);
        terminal.diagnostics(&text);
        found.iter().filter_map(Diagnostic::to_warning).for_each(|w| terminal.record_warning(w));
    }
}

pub(super) fn report(terminal: &Terminal, study: &str, failure: &Failure) {
    if let Failure::Model(errors) = failure {
        let text = super::diagnostics::render(
            &errors.diagnostics,
            &errors.sources,
            Severity::Error,
            terminal.colour,
        );
        terminal.diagnostics(&text);
        return;
    }
    let place = if study.is_empty() { String::new() } else { format!("{study}: ") };
    terminal.error(&format!("{place}{}", failure.message()));
}

/// Prints the JSON document with errors, version and exit code.
pub(super) fn print_json(outcome: Outcome, code: u8, terminal: &Terminal) {
    let mut document = outcome.document;
    if let Some(object) = document.as_object_mut() {
        let with_study = |(study, failure): &(&str, Failure)| {
            let mut error = failure.to_json();
            error["study"] = json!(study);
            error
        };
        // Results have the warnings of their studies; those of the command, such as a long computation, come after them.
        let printed = rotordyn::io::json::warnings(&terminal.warnings());
        match (object.get_mut("warnings").and_then(|known| known.as_array_mut()), printed.as_array()) {
            (Some(known), Some(printed)) => {
                let missing: Vec<_> =
                    printed.iter().filter(|warning| !known.contains(warning)).cloned().collect();
                known.extend(missing);
            }
            _ => {
                object.insert("warnings".into(), printed);
            }
        }
        object.entry("schema").or_insert_with(|| json!(rotordyn::io::json::SCHEMA));
        object.insert("program".into(), "rotordyn".into());
        object.insert("version".into(), env!("CARGO_PKG_VERSION").into());
        object.insert("exit_code".into(), code.into());
        object.insert("errors".into(), outcome.failures.iter().map(with_study).collect());
    }
    terminal.print_document(&format!("{document}\n"));
}
