//! Command-line interface: parses arguments, runs studies, prints tables, writes files, sets the exit code.

pub(crate) mod args;
mod ball_motion_tables;
pub(crate) mod bearing;
mod bearing_list;
mod bearing_motion;
mod bearing_tables;
mod cage_tables;
pub(crate) mod catalogue;
mod check;
mod check_bearings;
mod checkpoint;
mod command_help;
mod compare;
mod csv_files;
mod defaults;
pub(crate) mod diagnostics;
pub(crate) mod ehl_films;
mod equilibrium_loads;
mod export;
pub(crate) mod failure;
mod folder_lock;
mod forecast;
mod free_ball_runs;
mod free_ball_tables;
pub(crate) mod free_parameters;
pub(crate) mod hdf5_reader;
mod help;
pub(crate) mod identified_file;
pub(crate) mod identify;
mod identify_tables;
pub(crate) mod import;
mod init;
pub(crate) mod interrupt;
mod job_files;
pub(crate) mod limits;
pub(crate) mod machine;
pub(crate) mod measured;
mod noisy_frf;
mod operational;
mod operational_tables;
pub(crate) mod outcome;
mod previous_files;
mod printed;
mod renamed;
mod report_page;
mod resumed_run;
mod rotor_tables;
mod run_identity;
mod run_up;
mod run_up_correlation;
mod run_up_tables;
mod setting_sources;
pub(crate) mod settings;
pub(crate) mod signal;
mod steady;
mod steady_settings;
mod steady_tables;
pub(crate) mod store;
mod stored_run;
pub(crate) mod studies;
pub(crate) mod study_command;
mod system;
mod tables;
pub(crate) mod terminal;
mod trend;
mod unbalance_tables;
pub(crate) mod update;
pub(crate) mod update_findings;
pub(crate) mod update_fit;
mod update_warnings;
mod usage;
mod validate;

use outcome::{Outcome, finish, print_json, print_model_warnings, print_written_files, report};
use std::ffi::OsString;
use std::io::Write;
use std::path::PathBuf;

use clap::Parser;
use rotordyn::model::{Diagnostic, Model};
use rotordyn::study::Machine;
use serde_json::json;

use args::{CheckpointArgs, Cli, Command, OutputFiles, StudyArgs};
use checkpoint::CheckpointWriter;
use failure::Failure;
use folder_lock::FolderLock;
use machine::ModelSource;
use run_identity::RunIdentity;
use settings::Settings;
use studies::{Job, Study};
use study_command::StudyCommand;
use terminal::Terminal;

/// Exit code of a file error.
const FILE_ERROR_EXIT_CODE: u8 = 4;
/// Exit code of a run with warnings under `--strict`.
const WARNINGS_EXIT_CODE: u8 = 5;

/// Performs the command of a command line, of which the first word is the name of the program; returns the exit code.
///
/// `hdf5_program`: the program to be started for reading HDF5 files.
pub fn command(arguments: impl IntoIterator<Item = OsString>, hdf5_program: Option<PathBuf>) -> u8 {
    std::panic::set_hook(Box::new(|bug| {
        // Not `eprintln`, which panics if standard error cannot be written.
        let _ = writeln!(
            std::io::stderr(),
            "internal error in rotordyn {}: {bug}\nPlease report this bug, with the model file and the command.",
            env!("CARGO_PKG_VERSION")
        );
    }));
    let arguments: Vec<OsString> = arguments.into_iter().collect();
    let mut cli = match Cli::try_parse_from(&arguments) {
        Ok(cli) => cli,
        Err(error) => return usage::report(&error, &arguments),
    };
    limits::set(cli.output.read_limit, hdf5_program);
    let terminal = Terminal::new(&cli.output);
    if let Some(threads) = cli.output.threads {
        // Fails only if the global pool already exists; nothing has created it yet.
        let _ = rayon::ThreadPoolBuilder::new().num_threads(threads.into()).build_global();
    }
    interrupt::install_handlers();
    let outcome = renamed::resolve(&mut cli.command, &terminal)
        .and_then(|()| perform(&cli.command, &terminal))
        .unwrap_or_else(|failure| Outcome { document: json!({}), failures: vec![("", failure)] });
    for (study, failure) in &outcome.failures {
        report(&terminal, study, failure);
    }
    // A signal takes precedence, then the first failure.
    let code = |(_, failure): &(&str, Failure)| failure.exit_code();
    let signals = outcome.failures.iter().filter(|(_, failure)| matches!(failure, Failure::Interrupted));
    let interrupted = signals.map(code).next();
    let warned = cli.output.strict && !terminal.warnings().is_empty();
    let without_failure = if warned { WARNINGS_EXIT_CODE } else { 0 };
    let code = interrupted.or(outcome.failures.first().map(code)).unwrap_or(without_failure);
    if cli.output.json {
        print_json(outcome, code, &terminal);
    }
    let Some(error) = terminal.lost_output() else { return leave(code) };
    let failure = Failure::lost_output(error);
    report(&terminal, "", &failure);
    leave(if code == 0 { failure.exit_code() } else { code })
}

/// Ends the program. After a failed write HDF5 would try it again when it is unloaded, and can crash there.
fn leave(code: u8) -> u8 {
    if code == FILE_ERROR_EXIT_CODE {
        interrupt::end_at_once(code);
    }
    code
}

fn perform(command: &Command, terminal: &Terminal) -> Result<Outcome, Failure> {
    match command {
        Command::Run { study, checkpoints } => {
            studies_of(study, Some(checkpoints), terminal, None, &|_| Settings::default())
        }
        Command::Import(args) => import::run(args, terminal).map(Outcome::from),
        Command::Init(args) => init::run(args, terminal).map(Outcome::from),
        Command::Check(args) => check::run(args, terminal).map(Outcome::from),
        Command::Spectrogram(args) => stored_run::spectrogram(args, terminal),
        Command::Orders(args) => stored_run::orders(args, terminal),
        Command::Bearing(args) => bearing::run(args, terminal),
        Command::Identify(args) => identify::run(args, terminal),
        Command::Compare(args) => compare::run(args, terminal),
        Command::Validate(args) => validate::run(args, terminal),
        Command::Update(args) => update::run(args, terminal),
        Command::Catalogue { designation } => {
            catalogue::run(designation.as_deref(), terminal).map(Outcome::from)
        }
        Command::Help { path, schema } => match schema {
            true => Ok(help::schema(terminal).into()),
            false => help::run(path.as_deref(), terminal).map(Outcome::from),
        },
        Command::Signal(args) => signal::run(args, terminal),
        Command::Trend(args) => trend::run(args, terminal),
        Command::Report(args) => report_page::run(args, terminal).map(Outcome::from),
        Command::Export(args) => export::run(args, terminal).map(Outcome::from),
        Command::Static { .. }
        | Command::Modal { .. }
        | Command::Campbell { .. }
        | Command::Critical { .. }
        | Command::CriticalMap(_)
        | Command::Torsional(_)
        | Command::Frf { .. }
        | Command::Unbalance { .. }
        | Command::RunUp { .. }
        | Command::Poincare(_)
        | Command::Lyapunov(_)
        | Command::Bifurcation(_) => {
            let study = StudyCommand::of(command).expect("each of these runs one study");
            run_study(&study, command, terminal)
        }
    }
}

/// Runs the study of a command.
fn run_study(study: &StudyCommand, command: &Command, terminal: &Terminal) -> Result<Outcome, Failure> {
    let settings = |model: &Model| study.settings(model);
    let test = match command {
        Command::Frf { test, .. } => Some(test),
        _ => None,
    };
    test.map_or(Ok(()), noisy_frf::check)?;
    let outcome = studies_of(study.args, study.checkpoints, terminal, Some(study.study), &settings)?;
    if let Some(test) = test {
        noisy_frf::run(study.args, test, &settings, terminal)?;
    }
    Ok(outcome)
}

/// Runs one study, or all studies of the file.
fn studies_of(
    args: &StudyArgs,
    checkpoints: Option<&CheckpointArgs>,
    terminal: &Terminal,
    study: Option<Study>,
    settings: &dyn Fn(&Model) -> Settings,
) -> Result<Outcome, Failure> {
    let origin = ModelSource::read(&args.model)?;
    let mut loaded = origin.load(&[])?;
    let settings = settings(&loaded.model);
    if !settings.set.is_empty() {
        loaded = origin.load_with(&settings)?;
    }
    if let Some(note) = &settings.note {
        terminal.print(note);
    }
    let requested = |study: &Study| study.is_requested(&loaded.model.studies);
    let wanted: Vec<Study> = match study {
        Some(Study::RunUp) => {
            let also = [Study::Spectrogram, Study::Orders].into_iter().filter(requested);
            std::iter::once(Study::RunUp).chain(also).collect()
        }
        Some(study) => vec![study],
        None => Study::ALL.into_iter().filter(requested).collect(),
    };
    if wanted.is_empty() {
        let message = format!("{} contains no study; add [study.modal] or another", origin.name);
        return Err(Failure::Input(message));
    }
    if wanted.iter().any(|study| matches!(study, Study::Spectrogram | Study::Orders)) {
        loaded.refuse_conflicts()?;
    }
    defaults::print_decisive(terminal, &loaded.defaults, &loaded.model, &wanted);
    let folder = origin.results_folder(args.out.as_ref(), &loaded.model.name);
    let _lock = FolderLock::take(&folder, terminal)?;
    ehl_films::prepare_machine_films(&mut loaded.model, &folder, terminal)?;
    let family = match wanted.contains(&Study::Bifurcation) {
        true => steady::parameter_models(&origin, &settings.set, &loaded, &folder, terminal)?,
        false => Vec::new(),
    };
    let machine = Machine::new(loaded.model.clone())?;
    forecast::examine(&machine, &wanted, &folder, terminal)?;
    let checkpoints = match checkpoints {
        None => None,
        Some(wanted) => {
            let options = origin.options_with(&settings);
            let (name, files) = (study.map_or("run", Study::name), origin.side_files(&options));
            let identity = RunIdentity::new(name, &origin.text, &options, &files);
            Some(CheckpointWriter::open(&folder, wanted, &identity, terminal)?)
        }
    };
    let output = store::open(&folder, (&loaded).into(), &origin, study.is_none(), terminal)?;
    let mut job = Job::new(terminal, machine, folder, output);
    job.parameter_models = family;
    job.results.warnings = loaded.warnings.iter().filter_map(Diagnostic::to_warning).collect();
    job.values = (&loaded).into();
    if let Some((writer, resumed)) = checkpoints {
        job.resume(writer, resumed);
    }
    job.perform(&wanted);
    // `run` leaves a page of all its results.
    let written = OutputFiles { page: study.is_none() && !args.no_figures, ..args.into() };
    let outcome = finish(job, &wanted, written, study.map_or("run", Study::name))?;
    print_model_warnings(terminal, &loaded);
    Ok(outcome)
}
