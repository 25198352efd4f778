//! Runs the studies of a machine one after another: computes, prints tables, collects the results.

use std::collections::BTreeSet;
use std::path::PathBuf;
use std::time::Instant;

use rotordyn::analysis::ball_inertia::InertiaUse;
use rotordyn::io::spill::Spill;
use rotordyn::model::study::Studies;
use rotordyn::model::{Drive, Model};
use rotordyn::results::{Motion, Results};
use rotordyn::study::Machine;
use rotordyn::warning::Warning;

use super::checkpoint::{CheckpointWriter, Running};
use super::failure::Failure;
use super::report_page::ModelValues;
use super::store::Output;
use super::system::cpu_seconds;
use super::terminal::Terminal;
use super::{free_ball_runs, interrupt, rotor_tables, tables};

/// One study of a model file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Study {
    Static,
    Modal,
    Campbell,
    Critical,
    CriticalMap,
    Torsional,
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
    pub const ALL: [Self; 15] = [
        Self::Static,
        Self::Modal,
        Self::Campbell,
        Self::Critical,
        Self::CriticalMap,
        Self::Torsional,
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
            Self::CriticalMap => "critical-map",
            Self::Torsional => "torsional",
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
            Self::CriticalMap => studies.critical_map.as_ref().map(|s| vec![0.0, s.max_speed]),
            Self::Frf => studies.frf.as_ref().map(|s| vec![s.speed]),
            Self::Unbalance => studies.unbalance.as_ref().map(|s| s.speeds.clone()),
            Self::RunUp => {
                let prescribed = matches!(model.drive, Drive::Prescribed { .. });
                prescribed.then(|| model.profile.speed_range().to_vec())
            }
            Self::Poincare => studies.poincare.as_ref().map(|s| vec![s.steady.speed]),
            Self::Lyapunov => studies.lyapunov.as_ref().map(|s| vec![s.steady.speed]),
            Self::Bifurcation => studies.bifurcation.as_ref().map(|s| vec![s.steady.speed]),
            Self::Torsional | Self::Spectrogram | Self::Orders | Self::Bearing => None,
        };
        found.unwrap_or_default()
    }

    /// Whether it computes from the equations linearised about an equilibrium, or that equilibrium, in a short time.
    pub fn is_linear(self) -> bool {
        use Study::{Campbell, Critical, CriticalMap, Frf, Modal, Static, Torsional, Unbalance};
        matches!(self, Static | Modal | Campbell | Critical | CriticalMap | Torsional | Frf | Unbalance)
    }

    /// Computes a linear study with the settings of the model; nothing without them.
    ///
    /// # Errors
    /// Those of the study.
    pub fn compute(self, machine: &Machine, results: &mut Results) -> Result<(), Failure> {
        let studies = &machine.model.studies;
        match self {
            Self::Static => {
                if let Some(settings) = &studies.equilibrium {
                    results.equilibrium = Some(machine.equilibrium(settings)?);
                }
            }
            Self::Modal => {
                if let Some(settings) = &studies.modal {
                    results.modal = machine.modal(settings)?;
                }
            }
            Self::Campbell => {
                if let Some(settings) = &studies.campbell {
                    results.campbell = Some(machine.campbell(settings)?);
                }
            }
            Self::Critical => {
                if let Some(settings) = &studies.critical {
                    results.critical = Some(machine.critical(settings)?);
                }
            }
            Self::CriticalMap => {
                if let Some(settings) = &studies.critical_map {
                    results.critical_map = Some(machine.critical_map(settings)?);
                }
            }
            Self::Torsional => {
                if let Some(settings) = &studies.torsional {
                    results.torsional = Some(machine.torsional(settings)?);
                }
            }
            Self::Frf => {
                if let Some(settings) = &studies.frf {
                    results.frf = Some(machine.frf(settings)?);
                }
            }
            Self::Unbalance => {
                if let Some(settings) = &studies.unbalance {
                    results.unbalance = Some(machine.unbalance(settings)?);
                }
            }
            _ => {}
        }
        Ok(())
    }

    /// States in the results which ball inertia the bearings have in it; `speeds` \[rad/s\].
    pub fn state_ball_inertia<'r>(
        self,
        machine: &Machine,
        mut speeds: Vec<f64>,
        results: &'r mut Results,
    ) -> &'r [InertiaUse] {
        if self == Self::RunUp {
            speeds.push(machine.top_speed_of_run());
        }
        let used = if speeds.is_empty() { Vec::new() } else { machine.ball_inertia(&speeds) };
        if used.is_empty() {
            return &[];
        }
        results.ball_inertia.push((self.name().into(), used));
        results.ball_inertia.last().map_or(&[], |(_, used)| used)
    }

    /// Whether the model file contains it.
    pub fn is_requested(self, studies: &Studies) -> bool {
        match self {
            Self::Static => studies.equilibrium.is_some(),
            Self::Modal => studies.modal.is_some(),
            Self::Campbell => studies.campbell.is_some(),
            Self::Critical => studies.critical.is_some(),
            Self::CriticalMap => studies.critical_map.is_some(),
            Self::Torsional => studies.torsional.is_some(),
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
    pub output: Output,
    /// Studies finished but not yet saved.
    pub unsaved: Vec<&'static str>,
    /// Where the level maps of spectrograms and order tracking are kept.
    pub spill: Spill,
    pub results: Results,
    /// Values of the model, for the page of the run.
    pub values: ModelValues,
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
    /// Checkpoints, of commands that write them.
    pub checkpoints: Option<CheckpointWriter>,
    /// The study that a resumed run goes on with.
    pub running: Option<Running>,
    /// Studies that have ended, with those of a resumed run; frames of the run-up.
    pub done: BTreeSet<String>,
    pub motion: Option<Motion>,
}

impl<'a> Job<'a> {
    pub fn new(terminal: &'a Terminal, machine: Machine, folder: PathBuf, output: Output) -> Self {
        Self {
            terminal,
            machine,
            spill: Spill::new(&folder),
            parameter_models: Vec::new(),
            folder,
            output,
            unsaved: Vec::new(),
            results: Results::default(),
            values: ModelValues::default(),
            seconds: Vec::new(),
            cpu_seconds: Vec::new(),
            files: Vec::new(),
            warnings: Vec::new(),
            failures: Vec::new(),
            checkpoints: None,
            running: None,
            done: BTreeSet::new(),
            motion: None,
        }
    }

    /// Runs studies in order; a failed study does not stop the others, Ctrl-C does.
    pub fn perform(&mut self, wanted: &[Study]) {
        for &study in wanted {
            let analyses_run = matches!(study, Study::Spectrogram | Study::Orders);
            if analyses_run && self.failures.iter().any(|(name, _)| *name == Study::RunUp.name()) {
                continue;
            }
            match self.restore(study) {
                Ok(false) => {}
                Ok(true) => {
                    self.unsaved.push(study.name());
                    continue;
                }
                Err(failure) => {
                    self.failures.push((study.name(), failure));
                    break;
                }
            }
            if !self.unsaved.is_empty()
                && let Err(failure) = self.save()
            {
                self.failures.push((study.name(), failure));
                break;
            }
            let (start, cpu) = (Instant::now(), cpu_seconds());
            let done = if interrupt::requested() { Err(Failure::Interrupted) } else { self.run_study(study) };
            self.seconds.push((study.name(), start.elapsed().as_secs_f64()));
            let used = cpu_seconds().zip(cpu).map(|(now, before)| (study.name(), now - before));
            self.cpu_seconds.extend(used);
            self.unsaved.push(study.name());
            // One that a signal cut short may not say so.
            if done.is_ok() && !interrupt::requested() {
                self.keep_finished(study);
            }
            if let Err(failure) = done {
                let ended = matches!(failure, Failure::Interrupted);
                self.failures.push((study.name(), failure));
                if ended {
                    let (ahead, terminal) = (self.running.as_ref(), self.terminal);
                    self.checkpoints.iter_mut().for_each(|writer| writer.stop(ahead, terminal));
                    break;
                }
            }
            // The last one is saved with the figures' names at the end.
            if Some(&study) != wanted.last()
                && let Err(failure) = self.save()
            {
                self.failures.push((study.name(), failure));
                break;
            }
        }
    }

    fn run_study(&mut self, study: Study) -> Result<(), Failure> {
        let mut speeds = study.speeds(&self.machine.model);
        if study == Study::Bifurcation {
            speeds = self.parameter_models.iter().flat_map(|model| study.speeds(model)).collect();
        }
        let tables = self.machine.check_tables(study.name(), &speeds)?;
        // The other studies show their speeds in their results.
        if study == Study::Bifurcation {
            self.warnings.extend(tables);
        }
        self.ball_inertia(study, speeds);
        let (machine, terminal) = (&self.machine, self.terminal);
        let studies = &machine.model.studies;
        let spinner = terminal.spinner(study.name());
        let is_computed = self.seconds.iter().any(|(done, _)| *done == Study::RunUp.name());
        let of_samples = |error| Failure::of_samples(error, is_computed);
        match study {
            linear if linear.is_linear() => {
                linear.compute(machine, &mut self.results)?;
                spinner.finish_and_clear();
                print_linear(terminal, linear, &self.results, machine);
            }
            Study::RunUp => {
                spinner.finish_and_clear();
                self.run_up()?;
            }
            Study::Spectrogram => {
                if let (Some(settings), Some(run)) = (&studies.spectrogram, &self.results.run_up) {
                    let found =
                        machine.spectrograms_kept(settings, &run.history, &mut |map| self.spill.keep(map));
                    let found = found.map_err(of_samples)?;
                    spinner.finish_and_clear();
                    tables::spectrograms(terminal, &found)?;
                    self.results.spectrograms = found;
                }
            }
            Study::Orders => {
                if let (Some(settings), Some(run)) = (&studies.orders, &self.results.run_up) {
                    let found = machine.orders_kept(settings, &run.history, &mut |map| self.spill.keep(map));
                    let found = found.map_err(of_samples)?;
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
            // Study::Bearing; the linear ones are above
            _ => {
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
    fn ball_inertia(&mut self, study: Study, speeds: Vec<f64>) {
        for bearing in study.state_ball_inertia(&self.machine, speeds, &mut self.results) {
            self.terminal.print(&format!("  {}: {}", study.name(), bearing.sentence()));
        }
    }

    /// Compares the ball inertia of a run under torque with the speed it reached.
    pub(super) fn note_reached_speed(&mut self, speeds: &[f64]) {
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
}

/// Prints the tables of a linear study.
fn print_linear(terminal: &Terminal, study: Study, results: &Results, machine: &Machine) {
    match study {
        Study::Static => results.equilibrium.iter().for_each(|found| tables::equilibrium(terminal, found)),
        Study::Modal if results.modal.is_empty() => {}
        Study::Modal => tables::modes(terminal, &results.modal, &machine.model),
        Study::Campbell => results.campbell.iter().for_each(|found| tables::campbell(terminal, found)),
        Study::Critical => results.critical.iter().for_each(|found| tables::critical(terminal, found)),
        Study::CriticalMap => {
            results.critical_map.iter().for_each(|found| rotor_tables::critical_map(terminal, found));
        }
        Study::Torsional => {
            results.torsional.iter().for_each(|found| rotor_tables::torsional(terminal, found));
        }
        Study::Frf => results.frf.iter().for_each(|found| tables::frf(terminal, found, machine)),
        Study::Unbalance => results.unbalance.iter().for_each(|found| tables::unbalance(terminal, found)),
        _ => {}
    }
}
