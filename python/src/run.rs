//! Run-ups: without the interpreter's lock, with progress, stopped by Ctrl-C with what was computed; spectrograms and
//! orders of a run.

use std::ops::ControlFlow;
use std::sync::Arc;
use std::time::Instant;

use pyo3::prelude::*;
use rotordyn::document::TO_RPM;
use rotordyn::model::Drive;
use rotordyn::results::{History, Results, RunSummary, RunUpResult};
use rotordyn::study::{Checkpoints, Recorder};
use rotordyn::transient::run::{End, Sample};
use rotordyn::warning::{Code, Warning};

use crate::cli::args::Command;
use crate::cli::failure::Failure;
use crate::cli::machine::ModelSource;
use crate::cli::settings::{self, Settings};
use crate::cli::studies::Study;
use crate::failure::{LOOK, Stop, detached};
use crate::results::StudyResults;
use crate::source::Source;
use crate::study::{Prepared, parsed, prepare};

/// What Python says during a run.
struct Watch {
    progress: Option<Py<PyAny>>,
    last: Instant,
    /// An exception that ends the run: that of the progress function.
    raised: Option<PyErr>,
    /// Whether Ctrl-C ends it.
    interrupted: bool,
}

impl Watch {
    fn new(progress: Option<Py<PyAny>>) -> Self {
        Self { progress, last: Instant::now(), raised: None, interrupted: false }
    }

    /// Looks at the interpreter from time to time; `done` of `whole` seconds at `speed` \[rad/s\] are computed.
    fn look(&mut self, done: f64, whole: f64, speed: f64) -> ControlFlow<()> {
        if self.last.elapsed() < LOOK {
            return ControlFlow::Continue(());
        }
        self.last = Instant::now();
        let found = Python::attach(|py| {
            py.check_signals()?;
            self.progress.as_ref().map_or(Ok(()), |f| f.call1(py, (done, whole, speed * TO_RPM)).map(drop))
        });
        let Err(error) = found else { return ControlFlow::Continue(()) };
        let ctrl_c = Python::attach(|py| error.is_instance_of::<pyo3::exceptions::PyKeyboardInterrupt>(py));
        self.interrupted = ctrl_c;
        self.raised = (!ctrl_c).then_some(error);
        ControlFlow::Break(())
    }
}

/// A run-up: the words of its command, keys of its section, and a function of (time \[s\], duration \[s\], speed \[rpm\]).
#[pyfunction]
pub fn run_up(
    py: Python<'_>,
    source: &Source,
    command: Vec<String>,
    keys: Vec<(String, String)>,
    progress: Option<Py<PyAny>>,
) -> PyResult<StudyResults> {
    detached(py, || {
        let mut prepared = prepare(&source.file, &source.loaded, &command, &keys)?;
        if prepared.study != Study::RunUp {
            return Err(Failure::Input("this command runs no run-up".into()).into());
        }
        let mut watch = Watch::new(progress);
        run(&mut prepared, &mut watch)?;
        if let Some(error) = watch.raised {
            return Err(Stop::Python(error));
        }
        if watch.interrupted {
            let run = prepared.results.run_up.as_ref();
            let end = run.map_or(0.0, |run| run.summary.end_time);
            let text =
                format!("the run-up was stopped by Ctrl-C after {end:.4} s; its results are up to there");
            prepared.results.warnings.push(Warning::new(Code::IncompleteRun, "study.run_up", text));
        }
        Ok(prepared.finished(&source.file, source.loaded.warnings.len(), watch.interrupted))
    })
}

/// Computes the run-up as the command does, with its samples in memory.
fn run(prepared: &mut Prepared, watch: &mut Watch) -> Result<(), Stop> {
    let Prepared { machine, results, study, .. } = prepared;
    let Some(settings) = &machine.model.studies.run_up else { return Ok(()) };
    machine.check_tables(study.name(), &study.speeds(&machine.model))?;
    study.state_ball_inertia(machine, study.speeds(&machine.model), results);
    let (profile, model) = (&machine.model.profile, &machine.model);
    let reduction = machine.reduce(settings)?;
    let frequency_error = machine.reduction_error(&reduction, settings.cutoff, profile.top_speed())?;
    let mut recorder = Recorder::new(model, &reduction.system, settings.sample_rate);
    let mut checkpoints = Checkpoints::new(settings, profile.duration());
    let report = machine.run_up(settings, &reduction, |sample: &Sample| {
        checkpoints.observe(sample);
        recorder.record(sample);
        watch.look(sample.state.time, profile.duration(), sample.state.spin.speed)
    });
    let peak_loads = recorder.peak_loads();
    let history = recorder.into_history();
    if let End::Failed(error) = &report.end {
        return Err(error.clone().into());
    }
    let summary = RunSummary::of(&history)?;
    let orders = machine.checked_orders();
    let step_error = machine.step_error(settings, &reduction, &orders, (&checkpoints, &history, &report))?;
    let stopped = watch.interrupted || watch.raised.is_some();
    let cage_comparison = match stopped {
        true => None,
        false => machine
            .compare_cages(settings, &history, &mut || {
                watch.look(profile.duration(), profile.duration(), 0.0)
            })
            .unwrap_or_else(|error| {
                let text = format!("no comparison with kinematic cages: {error}");
                results.warnings.push(Warning::new(Code::FreeBalls, "study.run_up", text));
                None
            }),
    };
    if matches!(model.drive, Drive::Torque { .. }) && !stopped {
        machine.check_tables(study.name(), summary.speed_range.as_slice().as_flattened())?;
    }
    results.run_up = Some(RunUpResult {
        modes: reduction.modes,
        corrections: reduction.corrections,
        static_error: reduction.static_error,
        frequency_error,
        history,
        summary,
        report,
        requested_step: settings.step,
        cage_angles: machine.cage_angles(),
        step_error,
        cage_comparison,
        peak_loads,
    });
    Ok(())
}

/// The history of a run-up.
fn history(run: &StudyResults) -> Result<&History, Failure> {
    let run = run.results.run_up.as_ref();
    run.map(|run| &run.history).ok_or_else(|| Failure::Input("these are not the results of a run-up".into()))
}

/// Analyses of a run-up: the model of the run with settings, and the results of `analyse`.
fn analysed(
    run: &StudyResults,
    study: Study,
    settings: impl Fn(&rotordyn::model::Model) -> Settings,
    analyse: impl Fn(&rotordyn::study::Machine, &mut Results) -> Result<(), Stop>,
) -> Result<StudyResults, Stop> {
    let mut file: ModelSource = run.file.clone();
    let loaded = file.load_with(&settings(&run.machine.model))?;
    file.options = file.options_with(&settings(&run.machine.model));
    let machine = rotordyn::study::Machine::new(loaded.model)?;
    let mut results = Results { warnings: run.results.warnings.clone(), ..Results::default() };
    analyse(&machine, &mut results)?;
    let known_warnings = results.warnings.len();
    let machine = Arc::new(machine);
    Ok(StudyResults { study, results, machine, file, known_warnings, stopped: run.stopped })
}

/// The command `name` with flags.
fn command_of(name: &str, flags: &[String]) -> Result<Command, Failure> {
    let words: Vec<String> = std::iter::once(name.to_string()).chain(flags.iter().cloned()).collect();
    parsed(&words)
}

fn no_analysis() -> Failure {
    Failure::Input("this command analyses no run-up".into())
}

/// Spectrograms (STFT) of channels of a run-up; `flags` are those of the command `spectrogram`.
#[pyfunction]
pub fn run_spectrograms(py: Python<'_>, run: &StudyResults, flags: Vec<String>) -> PyResult<StudyResults> {
    detached(py, || {
        let Command::Spectrogram(args) = command_of("spectrogram", &flags)? else {
            return Err(no_analysis().into());
        };
        let of_flags = |model: &rotordyn::model::Model| settings::spectrogram(model, &args);
        analysed(run, Study::Spectrogram, of_flags, |machine, results| {
            if let Some(study) = &machine.model.studies.spectrogram {
                results.spectrograms = machine.spectrograms(study, history(run)?)?;
            }
            Ok(())
        })
    })
}

/// Order tracking of channels of a run-up; `flags` are those of the command `orders`.
#[pyfunction]
pub fn run_orders(py: Python<'_>, run: &StudyResults, flags: Vec<String>) -> PyResult<StudyResults> {
    detached(py, || {
        let Command::Orders(args) = command_of("orders", &flags)? else {
            return Err(no_analysis().into());
        };
        let of_flags = |model: &rotordyn::model::Model| settings::orders(model, &args);
        analysed(run, Study::Orders, of_flags, |machine, results| {
            if let Some(study) = &machine.model.studies.orders {
                results.orders = machine.orders(study, history(run)?)?;
            }
            Ok(())
        })
    })
}
