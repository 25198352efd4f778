//! Command-line interface: parses arguments, runs studies, prints tables, writes files, sets the exit code.

mod args;
mod ball_motion_tables;
mod bearing;
mod bearing_motion;
mod bearing_tables;
mod cage_tables;
mod catalogue;
mod check;
mod checkpoint;
mod command_help;
mod compare;
mod csv_files;
mod defaults;
mod diagnostics;
mod ehl_films;
mod equilibrium_loads;
mod export;
mod failure;
mod folder_lock;
mod forecast;
mod free_ball_runs;
mod free_ball_tables;
mod free_parameters;
mod hdf5_reader;
mod help;
mod identify;
mod identify_tables;
mod init;
mod interrupt;
mod job_files;
mod limits;
mod machine;
mod measured;
mod noisy_frf;
mod outcome;
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
mod settings;
mod signal;
mod steady;
mod steady_settings;
mod steady_tables;
mod store;
mod stored_run;
mod studies;
mod system;
mod tables;
mod terminal;
mod trend;
mod unbalance_tables;
mod update;
mod validate;

use outcome::{Outcome, finish, print_model_warnings, print_written_files, report};
use std::io::Write;
use std::process::ExitCode;

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
use terminal::Terminal;

/// Exit code of a file error.
const FILE_ERROR_EXIT_CODE: u8 = 4;
/// Exit code of a run with warnings under `--strict`.
const WARNINGS_EXIT_CODE: u8 = 5;

/// Entry point of the program.
pub fn run() -> ExitCode {
    if let Some(code) = hdf5_reader::run(std::env::args_os()) {
        return code;
    }
    std::panic::set_hook(Box::new(|bug| {
        // Not `eprintln`, which panics if standard error cannot be written.
        let _ = writeln!(
            std::io::stderr(),
            "internal error in rotordyn {}: {bug}\nPlease report this bug, with the model file and the command.",
            env!("CARGO_PKG_VERSION")
        );
    }));
    let mut cli = Cli::parse();
    limits::set(cli.output.read_limit);
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
fn leave(code: u8) -> ExitCode {
    if code == FILE_ERROR_EXIT_CODE {
        interrupt::end_at_once(code);
    }
    code.into()
}

fn perform(command: &Command, terminal: &Terminal) -> Result<Outcome, Failure> {
    let run_one = |args: &StudyArgs, study: Study, settings: &dyn Fn(&Model) -> Settings| {
        studies_of(args, None, terminal, Some(study), settings)
    };
    let resumable = |args, checkpoints, study: Study, settings: &dyn Fn(&Model) -> Settings| {
        studies_of(args, Some(checkpoints), terminal, Some(study), settings)
    };
    match command {
        Command::Run { study, checkpoints } => {
            studies_of(study, Some(checkpoints), terminal, None, &|_| Settings::default())
        }
        Command::Init(args) => init::run(args, terminal).map(Outcome::from),
        Command::Check(args) => check::run(args, terminal).map(Outcome::from),
        Command::Static { study, speed, fixed_cage_angle } => run_one(study, Study::Static, &|model| {
            settings::equilibrium(model, speed.as_ref(), *fixed_cage_angle)
        }),
        Command::Modal { study, speed, modes } => {
            run_one(study, Study::Modal, &|model| settings::modal(model, speed.as_ref(), *modes))
        }
        Command::Campbell { study, max_speed, modes } => {
            run_one(study, Study::Campbell, &|model| settings::campbell(model, max_speed.as_ref(), *modes))
        }
        Command::Critical { study, max_speed, orders } => {
            run_one(study, Study::Critical, &|model| settings::critical(model, max_speed.as_ref(), orders))
        }
        Command::CriticalMap(args) => {
            run_one(&args.study, Study::CriticalMap, &|model| settings::critical_map(model, args))
        }
        Command::Torsional(args) => {
            run_one(&args.study, Study::Torsional, &|model| settings::torsional(model, args))
        }
        Command::Frf { study, speed, max_frequency, quantity, test } => {
            let settings = |model: &Model| {
                settings::frf(model, speed.as_ref(), max_frequency.as_ref(), quantity.as_ref())
            };
            noisy_frf::check(test)?;
            let outcome = run_one(study, Study::Frf, &settings)?;
            noisy_frf::run(study, test, &settings, terminal)?;
            Ok(outcome)
        }
        Command::Unbalance { study, max_speed, speed_range } => run_one(study, Study::Unbalance, &|model| {
            settings::unbalance(model, max_speed.as_ref(), speed_range.as_ref())
        }),
        Command::RunUp { study, step, integrator, sample_rate, motion_rate, cage_phases, checkpoints } => {
            resumable(study, checkpoints, Study::RunUp, &|model| {
                let [step, integrator, rate, motion] =
                    [step, integrator, sample_rate, motion_rate].map(Option::as_ref);
                settings::run_up(model, step, integrator, rate, motion, *cage_phases)
            })
        }
        Command::Poincare(args) => {
            let steady = &args.steady;
            resumable(&steady.study, &steady.checkpoints, Study::Poincare, &|model| {
                steady_settings::poincare(model, args)
            })
        }
        Command::Lyapunov(args) => resumable(&args.study, &args.checkpoints, Study::Lyapunov, &|model| {
            steady_settings::lyapunov(model, args)
        }),
        Command::Bifurcation(args) => {
            let steady = &args.steady;
            resumable(&steady.study, &steady.checkpoints, Study::Bifurcation, &|model| {
                steady_settings::bifurcation(model, args)
            })
        }
        Command::Spectrogram(args) => stored_run::run(args, terminal, Study::Spectrogram),
        Command::Orders(args) => stored_run::run(args, terminal, Study::Orders),
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
    }
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

/// Prints the JSON document with errors, version and exit code.
fn print_json(outcome: Outcome, code: u8, terminal: &Terminal) {
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
