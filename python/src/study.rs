//! Studies of a model, with the settings that the command of the same name takes from its flags.

use std::sync::{Arc, LazyLock};

use clap::{CommandFactory, FromArgMatches};
use pyo3::prelude::*;
use rotordyn::linalg::StopRequest;
use rotordyn::model::{Diagnostic, Loaded};
use rotordyn::results::Results;
use rotordyn::study::Machine;

use crate::cli::args::{Cli, Command, Output};
use crate::cli::ehl_films::prepare_machine_films;
use crate::cli::failure::Failure;
use crate::cli::machine::ModelSource;
use crate::cli::outcome::add_warnings;
use crate::cli::studies::Study;
use crate::cli::study_command::StudyCommand;
use crate::cli::terminal::Terminal;
use crate::failure::{Stop, interruptible};
use crate::results::StudyResults;
use crate::source::Source;

/// A study about to be computed: the machine with its settings.
pub struct Prepared {
    pub study: Study,
    pub machine: Machine,
    /// Changes of the user and settings of the study.
    pub settings: Vec<(String, String)>,
    pub results: Results,
}

/// A terminal that prints nothing; it keeps the warnings.
pub fn silent(stop: &StopRequest) -> Terminal {
    let output = Output { json: false, quiet: true, strict: false, threads: None, read_limit: None };
    let mut terminal = Terminal::new(&output).without_warnings();
    terminal.stop = stop.clone();
    terminal
}

/// All commands: their help texts take longer than a small study.
static COMMANDS: LazyLock<clap::Command> = LazyLock::new(Cli::command);

/// The command of a study with its flags, such as `["modal", "--speed=1200 rpm"]`.
pub fn parsed(command: &[String]) -> Result<Command, Failure> {
    let (name, flags) = command.split_first().map_or(("", &[][..]), |(name, rest)| (name.as_str(), rest));
    let words = ["rotordyn", name, "model"].into_iter().chain(flags.iter().map(String::as_str));
    let in_one_line = |error: clap::Error| {
        let text = error.to_string();
        let line = text.lines().next().unwrap_or_default().trim_start_matches("error: ").to_string();
        Failure::Input(line)
    };
    let found = COMMANDS.clone().try_get_matches_from(words);
    Ok(found.and_then(|mut found| Cli::from_arg_matches_mut(&mut found)).map_err(in_one_line)?.command)
}

/// The model of a study with its settings, assembled.
pub fn prepare(
    source: &ModelSource,
    base: &Loaded,
    command: &[String],
    keys: &[(String, String)],
) -> Result<Prepared, Stop> {
    let command = parsed(command)?;
    let Some(command) = StudyCommand::of(&command) else {
        return Err(Failure::Input("this command runs no study".into()).into());
    };
    let study = command.study;
    let mut settings = command.settings(&base.model);
    settings.set.extend_from_slice(keys);
    for (path, value) in keys {
        let name = path.rsplit('.').next().unwrap_or(path);
        settings.flags.push((path.clone(), format!("--{name} {value}")));
    }
    let mut loaded = if settings.set.is_empty() { base.clone() } else { source.load_with(&settings)? };
    prepare_machine_films(&mut loaded.model, &std::env::temp_dir(), &silent(&StopRequest::default()))?;
    let machine = Machine::new(loaded.model)?;
    machine.check_memory(study.name())?;
    let results = Results {
        warnings: loaded.warnings.iter().filter_map(Diagnostic::to_warning).collect(),
        ..Results::default()
    };
    let settings = source.options_with(&settings).set;
    Ok(Prepared { study, machine, settings, results })
}

impl Prepared {
    /// The results with all warnings, of a model with `known` warnings of its own.
    pub fn finished(mut self, source: &ModelSource, known: usize, stopped: bool) -> StudyResults {
        let study = [self.study];
        add_warnings(&self.machine, &mut self.results, &study, Vec::new());
        let mut file = source.clone();
        file.options.set = self.settings;
        StudyResults {
            study: self.study,
            results: self.results,
            machine: Arc::new(self.machine),
            file,
            known_warnings: known,
            stopped,
        }
    }
}

/// A linear study of a model.
pub fn compute(
    source: &ModelSource,
    base: &Loaded,
    command: &[String],
    keys: &[(String, String)],
    stop: &StopRequest,
) -> Result<StudyResults, Stop> {
    let mut prepared = prepare(source, base, command, keys)?;
    prepared.machine.stop = stop.clone();
    let Prepared { study, machine, results, .. } = &mut prepared;
    if !study.is_linear() {
        return Err(Failure::Input(format!("{} is not a linear study", study.name())).into());
    }
    let speeds = study.speeds(&machine.model);
    machine.check_tables(study.name(), &speeds)?;
    study.state_ball_inertia(machine, speeds, results);
    study.compute(machine, results)?;
    Ok(prepared.finished(source, base.warnings.len(), false))
}

/// A linear study: the words of its command, and keys of its section with values in TOML.
#[pyfunction]
pub fn linear_study(
    py: Python<'_>,
    source: &Source,
    command: Vec<String>,
    keys: Vec<(String, String)>,
) -> PyResult<StudyResults> {
    let (file, loaded) = (source.file.clone(), source.loaded.clone());
    interruptible(py, move |stop| compute(&file, &loaded, &command, &keys, stop))
}
