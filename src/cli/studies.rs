//! Runs the studies of a machine one after another: computes, prints tables, collects the results.

use std::ops::ControlFlow;
use std::path::PathBuf;
use std::time::Instant;

use rotordyn::analysis::table_range::{check_torque_table, speed_range};
use rotordyn::error::Error;
use rotordyn::figures;
use rotordyn::io::hdf5::{ChannelStream, Store};
use rotordyn::io::results_file;
use rotordyn::model::study::{RunUpStudy, Studies};
use rotordyn::model::{Drive, Model};
use rotordyn::results::{CagePhaseBand, History, Results, RollingCageComparison, RunUpResult};
use rotordyn::study::{Checkpoints, Machine, MotionRecorder, Recorder, StudyError};
use rotordyn::transient::run::End;
use rotordyn::warning::{Code, Warning};

use super::args::OutputFiles;
use super::csv_files::write_csv;
use super::failure::Failure;
use super::system::cpu_seconds;
use super::terminal::{Terminal, rpm};
use super::{cage_tables, free_ball_runs, interrupt, run_up_tables, tables};

/// One study of a model file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Study {
    Static,
    Modal,
    Campbell,
    Critical,
    Frf,
    Unbalance,
    RunUp,
    Spectrogram,
    Orders,
    Poincare,
    Lyapunov,
    Bifurcation,
    Bearing,
}

impl Study {
    pub const ALL: [Self; 13] = [
        Self::Static,
        Self::Modal,
        Self::Campbell,
        Self::Critical,
        Self::Frf,
        Self::Unbalance,
        Self::RunUp,
        Self::Spectrogram,
        Self::Orders,
        Self::Poincare,
        Self::Lyapunov,
        Self::Bifurcation,
        Self::Bearing,
    ];

    /// Name of its command.
    pub fn name(self) -> &'static str {
        match self {
            Self::Static => "static",
            Self::Modal => "modal",
            Self::Campbell => "campbell",
            Self::Critical => "critical",
            Self::Frf => "frf",
            Self::Unbalance => "unbalance",
            Self::RunUp => "run-up",
            Self::Spectrogram => "spectrogram",
            Self::Orders => "orders",
            Self::Poincare => "poincare",
            Self::Lyapunov => "lyapunov",
            Self::Bifurcation => "bifurcation",
            Self::Bearing => "bearing",
        }
    }

    /// Speeds at which it evaluates the bearings \[rad/s\]; none if the model file does not contain it.
    ///
    /// A run-up with a motor torque has its speeds only afterwards, in its history.
    pub fn speeds(self, model: &Model) -> Vec<f64> {
        let studies = &model.studies;
        let found = match self {
            Self::Static => studies.equilibrium.as_ref().map(|s| vec![s.speed]),
            Self::Modal => studies.modal.as_ref().map(|s| s.speeds.clone()),
            Self::Campbell => studies.campbell.as_ref().map(|s| s.speeds.clone()),
            Self::Critical => studies.critical.as_ref().map(|s| vec![0.0, s.max_speed]),
            Self::Frf => studies.frf.as_ref().map(|s| vec![s.speed]),
            Self::Unbalance => studies.unbalance.as_ref().map(|s| s.speeds.clone()),
            Self::RunUp => {
                let prescribed = matches!(model.drive, Drive::Prescribed { .. });
                prescribed.then(|| model.profile.speed_range().to_vec())
            }
            Self::Poincare => studies.poincare.as_ref().map(|s| vec![s.steady.speed]),
            Self::Lyapunov => studies.lyapunov.as_ref().map(|s| vec![s.steady.speed]),
            Self::Bifurcation => studies.bifurcation.as_ref().map(|s| vec![s.steady.speed]),
            Self::Spectrogram | Self::Orders | Self::Bearing => None,
        };
        found.unwrap_or_default()
    }

    /// Whether the model file contains it.
    pub fn is_requested(self, studies: &Studies) -> bool {
        match self {
            Self::Static => studies.equilibrium.is_some(),
            Self::Modal => studies.modal.is_some(),
            Self::Campbell => studies.campbell.is_some(),
            Self::Critical => studies.critical.is_some(),
            Self::Frf => studies.frf.is_some(),
            Self::Unbalance => studies.unbalance.is_some(),
            Self::RunUp => studies.run_up.is_some(),
            Self::Spectrogram => studies.spectrogram.is_some(),
            Self::Orders => studies.orders.is_some(),
            Self::Poincare => studies.poincare.is_some(),
            Self::Lyapunov => studies.lyapunov.is_some(),
            Self::Bifurcation => studies.bifurcation.is_some(),
            Self::Bearing => studies.bearing.is_some(),
        }
    }
}

/// A sequence of studies of one machine, with its results file and the results so far.
pub struct Job<'a> {
    pub terminal: &'a Terminal,
    pub machine: Machine,
    /// Models of a bifurcation diagram, one per parameter value.
    pub parameter_models: Vec<Model>,
    pub folder: PathBuf,
    pub store: Store,
    pub results: Results,
    /// Elapsed (wall-clock) time of every study \[s\].
    pub seconds: Vec<(&'static str, f64)>,
    /// Processor time of every study, all threads together \[s\].
    pub cpu_seconds: Vec<(&'static str, f64)>,
    /// Files written, results.h5 included.
    pub files: Vec<PathBuf>,
    /// Warnings of the studies that their results do not show, printed at the end.
    pub warnings: Vec<Warning>,
    /// Failed studies with their errors.
    pub failures: Vec<(&'static str, Failure)>,
}

impl<'a> Job<'a> {
    pub fn new(terminal: &'a Terminal, machine: Machine, folder: PathBuf, store: Store) -> Self {
        Self {
            terminal,
            machine,
            parameter_models: Vec::new(),
            folder,
            store,
            results: Results::default(),
            seconds: Vec::new(),
            cpu_seconds: Vec::new(),
            files: Vec::new(),
            warnings: Vec::new(),
            failures: Vec::new(),
        }
    }

    /// Runs studies in order; a failed study does not stop the others, Ctrl-C does.
    pub fn perform(&mut self, wanted: &[Study]) {
        for &study in wanted {
            let analyses_run = matches!(study, Study::Spectrogram | Study::Orders);
            if analyses_run && self.failures.iter().any(|(name, _)| *name == Study::RunUp.name()) {
                continue;
            }
            let (start, cpu) = (Instant::now(), cpu_seconds());
            let done = if interrupt::requested() { Err(Failure::Interrupted) } else { self.run_study(study) };
            self.seconds.push((study.name(), start.elapsed().as_secs_f64()));
            let used = cpu_seconds().zip(cpu).map(|(now, before)| (study.name(), now - before));
            self.cpu_seconds.extend(used);
            if let Err(failure) = done {
                let interrupted = matches!(failure, Failure::Interrupted);
                self.failures.push((study.name(), failure));
                if interrupted {
                    break;
                }
            }
        }
    }

    fn run_study(&mut self, study: Study) -> Result<(), Failure> {
        let mut speeds = study.speeds(&self.machine.model);
        if study == Study::Bifurcation {
            speeds = self.parameter_models.iter().flat_map(|model| study.speeds(model)).collect();
        }
        self.warnings.extend(self.machine.check_tables(study.name(), &speeds)?);
        self.ball_inertia(study, speeds);
        let (machine, terminal) = (&self.machine, self.terminal);
        let studies = &machine.model.studies;
        let spinner = terminal.spinner(study.name());
        match study {
            Study::Static => {
                if let Some(settings) = &studies.equilibrium {
                    let found = machine.equilibrium(settings)?;
                    spinner.finish_and_clear();
                    tables::equilibrium(terminal, &found);
                    self.results.equilibrium = Some(found);
                }
            }
            Study::Modal => {
                if let Some(settings) = &studies.modal {
                    let found = machine.modal(settings)?;
                    spinner.finish_and_clear();
                    tables::modes(terminal, &found, &machine.model);
                    self.results.modal = found;
                }
            }
            Study::Campbell => {
                if let Some(settings) = &studies.campbell {
                    let found = machine.campbell(settings)?;
                    spinner.finish_and_clear();
                    tables::campbell(terminal, &found);
                    self.results.campbell = Some(found);
                }
            }
            Study::Critical => {
                if let Some(settings) = &studies.critical {
                    let found = machine.critical(settings)?;
                    spinner.finish_and_clear();
                    tables::critical(terminal, &found);
                    self.results.critical = Some(found);
                }
            }
            Study::Frf => {
                if let Some(settings) = &studies.frf {
                    let found = machine.frf(settings)?;
                    spinner.finish_and_clear();
                    tables::frf(terminal, &found);
                    self.results.frf = Some(found);
                }
            }
            Study::Unbalance => {
                if let Some(settings) = &studies.unbalance {
                    let found = machine.unbalance(settings)?;
                    spinner.finish_and_clear();
                    tables::unbalance(terminal, &found);
                    self.results.unbalance = Some(found);
                }
            }
            Study::RunUp => {
                spinner.finish_and_clear();
                self.run_up()?;
            }
            Study::Spectrogram => {
                if let (Some(settings), Some(run)) = (&studies.spectrogram, &self.results.run_up) {
                    let found = machine.spectrograms(settings, &run.history)?;
                    spinner.finish_and_clear();
                    tables::spectrograms(terminal, &found);
                    self.results.spectrograms = found;
                }
            }
            Study::Orders => {
                if let (Some(settings), Some(run)) = (&studies.orders, &self.results.run_up) {
                    let found = machine.orders(settings, &run.history)?;
                    spinner.finish_and_clear();
                    tables::orders(terminal, &found);
                    self.results.orders = found;
                }
            }
            Study::Poincare | Study::Lyapunov | Study::Bifurcation => {
                spinner.finish_and_clear();
                match study {
                    Study::Poincare => self.poincare()?,
                    Study::Lyapunov => self.lyapunov()?,
                    _ => self.bifurcation()?,
                }
            }
            Study::Bearing => {
                if let Some(settings) = &studies.bearing {
                    let mut found = machine.static_bearings(settings)?;
                    spinner.finish_and_clear();
                    let complete = free_ball_runs::run(&mut found, &machine.free_balls(), settings, terminal);
                    free_ball_runs::print(terminal, &found);
                    self.results.warnings.extend(found.iter().flat_map(|b| b.warnings.clone()));
                    self.results.bearings = found;
                    if !complete {
                        return Err(Failure::Interrupted);
                    }
                }
            }
        }
        Ok(())
    }

    /// States the ball inertia of the bearings in a study.
    fn ball_inertia(&mut self, study: Study, mut speeds: Vec<f64>) {
        if study == Study::RunUp {
            speeds.push(self.machine.top_speed_of_run());
        }
        if speeds.is_empty() {
            return;
        }
        let used = self.machine.ball_inertia(&speeds);
        for bearing in &used {
            self.terminal.print(&format!("  {}: {}", study.name(), bearing.sentence()));
        }
        if !used.is_empty() {
            self.results.ball_inertia.push((study.name().into(), used));
        }
    }

    /// Compares the ball inertia of a run under torque with the speed it reached.
    fn note_reached_speed(&mut self, speeds: &[f64]) {
        let reached = self.machine.ball_inertia(speeds);
        let Some((_, used)) = self.results.ball_inertia.iter_mut().find(|(s, _)| *s == Study::RunUp.name())
        else {
            return;
        };
        for (used, reached) in used.iter_mut().zip(reached) {
            if reached.compared.speed > used.compared.speed {
                used.compared = reached.compared;
            }
        }
    }

    /// Transient run-up, streamed to the file sample by sample.
    fn run_up(&mut self) -> Result<(), Failure> {
        let machine = &self.machine;
        let Some(settings) = &machine.model.studies.run_up else { return Ok(()) };
        let profile = &machine.model.profile;
        let reduction = machine.reduce(settings)?;
        let frequency_error = machine.reduction_error(&reduction, settings.cutoff, profile.top_speed())?;
        let mut recorder = Recorder::new(&machine.model, &reduction.system, settings.sample_rate);
        results_file::remove_run(&self.store)?;
        let channels = results_file::channels_of(&recorder.history);
        let mut motion = settings
            .motion
            .map(|motion| MotionRecorder::new(machine, &reduction, motion, settings.sample_rate));
        let mut stream = ChannelStream::create(&self.store, "", &channels, settings.sample_rate, 0.0)?;
        let bar = self.terminal.time_bar(profile.duration());
        let mut checkpoints = Checkpoints::new(settings, profile.duration());
        let mut disk: Result<(), Error> = Ok(());
        let mut last = (0.0, 0.0);
        let report = machine.run_up(settings, &reduction, |sample| {
            let (time, spin) = (sample.state.time, &sample.state.spin);
            last = (time, rpm(spin.speed));
            checkpoints.observe(sample);
            if let Some(motion) = &mut motion {
                motion.observe(sample);
            }
            disk = stream.push(time, spin.angle, spin.speed, recorder.record(sample));
            if sample.index % 64 == 0 {
                bar.set_position((1e3 * time) as u64);
                bar.set_message(format!("{:.0} rpm", last.1));
            }
            if disk.is_err() || interrupt::requested() {
                ControlFlow::Break(())
            } else {
                ControlFlow::Continue(())
            }
        });
        bar.finish_and_clear();
        let failure = match (disk, &report.end) {
            (Err(error), _) => Some(error.into()),
            (Ok(()), End::Complete) => None,
            (Ok(()), End::Stopped) => Some(Failure::Interrupted),
            (Ok(()), End::Failed(error)) => Some(Failure::Library(error.clone().into())),
        };
        let state = match &failure {
            None => "complete".to_string(),
            Some(why) => format!("stopped: {} at t = {:.4} s, {:.1} rpm", why.message(), last.0, last.1),
        };
        stream.finish(&state)?;
        if let Some(recorder) = motion.filter(|recorder| !recorder.motion.time.is_empty()) {
            results_file::write_motion(&self.store, &recorder.motion)?;
        }
        let history = recorder.history;
        let spinner = self.terminal.spinner("step error");
        let orders = machine.checked_orders();
        let start = Instant::now();
        let step_error = machine.step_error(settings, &reduction, &orders, (&checkpoints, &history, &report));
        let check_seconds = start.elapsed().as_secs_f64();
        spinner.finish_and_clear();
        let cage_comparison =
            if failure.is_none() { self.cage_comparison(settings, &history) } else { Ok(None) };
        // A kinematic run that fails does not take the run with free balls with it.
        let cage_comparison = cage_comparison.unwrap_or_else(|error| {
            let text = format!("no comparison with kinematic cages: {error}");
            self.warnings.push(Warning::new(Code::FreeBalls, "study.run_up", text));
            None
        });
        let found = RunUpResult {
            modes: reduction.modes,
            corrections: reduction.corrections,
            static_error: reduction.static_error,
            frequency_error,
            history,
            report,
            requested_step: settings.step,
            cage_angles: machine.cage_angles(),
            step_error,
            cage_comparison,
        };
        tables::run_up(self.terminal, &found, check_seconds);
        if let Some(comparison) = &found.cage_comparison {
            cage_tables::comparison(self.terminal, comparison);
        }
        let failure = match (failure, &machine.model.drive) {
            (None, Drive::Torque { table, .. }) => {
                let reached = speed_range(&found.history.speed);
                let torque = reached.and_then(|reached| check_torque_table(table, reached));
                self.warnings.extend(torque);
                match machine.check_tables(Study::RunUp.name(), &found.history.speed) {
                    Ok(warnings) => {
                        self.warnings.extend(warnings);
                        None
                    }
                    Err(error) => Some(error.into()),
                }
            }
            (failure, _) => failure,
        };
        if failure.is_none() && settings.cage_phases > 1 {
            self.results.cage_phases = self.cage_phases(settings, &found)?;
        }
        if matches!(machine.model.drive, Drive::Torque { .. }) {
            self.note_reached_speed(&found.history.speed);
        }
        self.results.run_up = Some(found);
        failure.map_or(Ok(()), Err)
    }

    /// Run-up with kinematic cages beside one with free balls.
    fn cage_comparison(
        &self,
        settings: &RunUpStudy,
        history: &History,
    ) -> Result<Option<RollingCageComparison>, StudyError> {
        let spinner = self.terminal.spinner("kinematic cages");
        let found = self.machine.compare_cages(settings, history, &mut || {
            if interrupt::requested() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        });
        spinner.finish_and_clear();
        found
    }

    /// Range of the order cuts over the initial cage phases.
    fn cage_phases(
        &self,
        settings: &RunUpStudy,
        found: &RunUpResult,
    ) -> Result<Option<CagePhaseBand>, Failure> {
        let Some(orders) = &self.machine.model.studies.orders else { return Ok(None) };
        let spinner = self.terminal.spinner("cage phases");
        let base = self.machine.orders(orders, &found.history)?;
        let progress =
            || if interrupt::requested() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) };
        let band = self.machine.cage_phase_band(settings, orders, &base, &progress)?;
        spinner.finish_and_clear();
        let band = band.ok_or(Failure::Interrupted)?;
        run_up_tables::cage_phases(self.terminal, &band);
        Ok(Some(band))
    }

    /// Writes and draws the results so far, also after failures.
    pub fn write(&mut self, written: OutputFiles) -> Result<(), Failure> {
        let start = Instant::now();
        results_file::write_study(&self.store, &self.results, &self.machine)?;
        self.files.push(self.store.path().to_path_buf());
        if written.csv {
            let sections = self.results.sections(&self.machine.assembly.dofs);
            self.files.extend(write_csv(&self.folder, &sections)?);
        }
        if written.figures {
            let spinner = self.terminal.spinner("figures");
            self.files.extend(figures::draw(&self.results, &self.machine, &self.folder)?);
            spinner.finish_and_clear();
        }
        self.seconds.push(("files and figures", start.elapsed().as_secs_f64()));
        Ok(())
    }
}
