//! The result of a command: what it prints and which files it wrote.

use super::args::OutputFiles;
use super::failure::Failure;
use super::studies::{Job, Study};
use super::terminal::Terminal;
use miette::Severity;
use rotordyn::model::Loaded;
use serde_json::{Value, json};
use std::path::{Path, PathBuf};

/// Result of a command: JSON document and failed studies.
pub(super) struct Outcome {
    pub(super) document: Value,
    pub(super) failures: Vec<(&'static str, Failure)>,
}

impl From<Value> for Outcome {
    fn from(document: Value) -> Self {
        Self { document, failures: Vec::new() }
    }
}

/// Writes the results and figures of a job, prints the file list and the quality warnings.
pub(super) fn finish(
    mut job: Job,
    studies: &[Study],
    written: OutputFiles,
    command: &'static str,
) -> Result<Outcome, Failure> {
    let known = job.results.warnings.len();
    quality_warnings(&mut job, studies);
    job.write(written)?;
    let terminal = job.terminal;
    for (name, how) in job.machine.model.estimated_geometries() {
        terminal.print(&format!("  internal geometry of bearing {name} {how}"));
    }
    let rows: Vec<Vec<String>> =
        job.seconds.iter().map(|(name, s)| vec![(*name).to_string(), format!("{s:.3}")]).collect();
    terminal.table("Computing time (elapsed)", &["", "s"], &rows);
    print_written_files(terminal, &job.folder, &job.files);
    if job.files.len() > 1 {
        terminal.print("  (figures are written as SVG and PNG)");
    }
    for warning in &job.results.warnings[known..] {
        terminal.print_diagnostic("warning", warning);
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
    }
    Ok(Outcome { document, failures: job.failures })
}

/// Quality warnings: unstable modes, energy balance of the run-up, error of the reduced model.
pub(super) fn quality_warnings(job: &mut Job, studies: &[Study]) {
    let mut found = std::mem::take(&mut job.quality_warnings);
    let speeds: Vec<f64> = studies.iter().flat_map(|study| study.speeds(&job.machine.model)).collect();
    // Post-processing of a stored run computes nothing of the machine.
    if !studies.is_empty() {
        match job.machine.bearing_warnings(&speeds) {
            Ok(warnings) => found.extend(warnings),
            Err(error) => found.push(format!("the limits of the bearings are not checked: {error}")),
        }
    }
    let used: Vec<_> = job.results.ball_inertia.iter().flat_map(|(_, used)| used).collect();
    for (k, bearing) in used.iter().enumerate() {
        // Once per bearing, at the highest ratio.
        let ratio = bearing.compared.ratio();
        let others = used.iter().enumerate().filter(|(_, other)| other.bearing == bearing.bearing);
        let largest = others.rev().max_by(|a, b| a.1.compared.ratio().total_cmp(&b.1.compared.ratio()));
        if ratio > 0.0 && largest.is_some_and(|(at, _)| at == k) {
            found.extend(bearing.warning());
        }
    }
    for at in &job.results.modal {
        for mode in at.modes.iter().filter(|mode| mode.zeta() < -1e-9) {
            let speed = super::terminal::rpm(at.speed);
            let zeta = 100.0 * mode.zeta();
            found.push(format!("{} is unstable at {speed:.0} rpm: zeta = {zeta:.3} %", mode.label));
        }
    }
    let campbell = job.results.campbell.as_ref();
    let critical = job.results.critical.as_ref().map(|found| &found.crossings);
    for list in campbell.map(|found| &found.crossings).into_iter().chain(critical) {
        found.extend(list.uncertain.iter().map(|range| {
            let [from, to] = [range.from, range.to].map(super::terminal::rpm);
            format!(
                "crossings of order {} between {from:.1} and {to:.1} rpm may be missing: the bearings change faster \
                 with speed than the search can follow",
                range.order
            )
        }));
    }
    if let Some(diagram) = campbell.map(|found| &found.diagram) {
        found.extend(diagram.lost.iter().map(|lost| {
            let [from, to] = lost.speeds.map(super::terminal::rpm);
            let label = |branch: usize| diagram.branches[branch].label.as_str();
            let continued = match lost.continued_by {
                Some(next) => format!("a new branch starts as {}", label(next)),
                None => "it ends there".into(),
            };
            format!(
                "the branch {} cannot be followed from {from:.0} to {to:.0} rpm (no mode of similar shape): \
                 {continued}",
                label(lost.branch)
            )
        }));
    }
    found.extend(job.results.run_up.iter().flat_map(super::run_up_tables::quality_warnings));
    found.extend(super::equilibrium_loads::warnings(&job.machine));
    found.extend(super::steady_tables::settling_warnings(&job.machine.model, &job.results));
    job.results.warnings.extend(found);
}

/// Prints the list of written files, wrapped to the line width.
pub(super) fn print_written_files(terminal: &Terminal, folder: &Path, files: &[PathBuf]) {
    terminal.heading(&format!("Written to {}", folder.display()));
    let mut line = String::from(" ");
    for file in files {
        let name = file.strip_prefix(folder).unwrap_or(file).display().to_string();
        if line.len() + name.len() > 98 {
            terminal.print(&line);
            line = String::from(" ");
        }
        line.push(' ');
        line.push_str(&name);
    }
    terminal.print(&line);
}

/// Prints the warnings and hints of the model file.
pub(super) fn print_model_warnings(terminal: &Terminal, loaded: &Loaded) {
    super::renamed::print_hints(&loaded.hints, &loaded.sources, terminal);
    if !loaded.warnings.is_empty() {
        let text =
            super::diagnostics::render(&loaded.warnings, &loaded.sources, Severity::Warning, terminal.colour);
        eprint!("{text}");
        loaded.warnings.iter().for_each(|warning| terminal.record_warning(&warning.message));
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
        eprint!("{text}");
        return;
    }
    let place = if study.is_empty() { String::new() } else { format!("{study}: ") };
    terminal.print_diagnostic("error", &format!("{place}{}", failure.message()));
}
