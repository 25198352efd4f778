//! Runs the steady-speed studies (Poincaré, Lyapunov, bifurcation) with progress bars; Ctrl-C keeps partial
//! results.

use std::ops::ControlFlow;
use std::sync::{Mutex, PoisonError};

use indicatif::ProgressBar;
use rayon::prelude::*;
use rotordyn::model::{Loaded, Model};
use rotordyn::study::{BifurcationProgress, FinishedValues, bifurcation_from};

use super::checkpoint::Running;
use super::failure::Failure;
use super::interrupt::continue_unless_interrupted;
use super::machine::ModelSource;
use super::studies::Job;
use super::terminal::Terminal;
use super::{ehl_films, interrupt, steady_tables};

/// Length of the progress bar of a single run.
const BAR_LENGTH: f64 = 1000.0;

/// Models of a bifurcation diagram, one per parameter value, with the settings of the command.
pub fn parameter_models(
    origin: &ModelSource,
    settings: &[(String, String)],
    loaded: &Loaded,
    folder: &std::path::Path,
    terminal: &Terminal,
) -> Result<Vec<Model>, Failure> {
    let Some(study) = &loaded.model.studies.bifurcation else { return Ok(Vec::new()) };
    let parameter = &study.parameter;
    let spinner = terminal.spinner("models of the bifurcation diagram");
    let model = |k: usize| -> Result<Model, Failure> {
        let mut set = settings.to_vec();
        set.extend(parameter.settings(k));
        Ok(origin.load(&set)?.model)
    };
    let models: Result<Vec<Model>, Failure> =
        (0..parameter.values.len()).into_par_iter().map(model).collect::<Vec<_>>().into_iter().collect();
    spinner.finish_and_clear();
    let mut models = models?;
    models.iter_mut().try_for_each(|model| ehl_films::prepare_machine_films(model, folder, terminal))?;
    Ok(models)
}

impl Job<'_> {
    pub fn poincare(&mut self) -> Result<(), Failure> {
        let Some(study) = &self.machine.model.studies.poincare else { return Ok(()) };
        let bar = run_bar(self.terminal, "Poincaré section");
        let snapshot = match self.running.take_if(|running| matches!(running, Running::Poincare(_))) {
            Some(Running::Poincare(snapshot)) => Some(*snapshot),
            _ => None,
        };
        let (checkpoints, terminal) = (&mut self.checkpoints, self.terminal);
        let found = self.machine.poincare_from(study, snapshot, &mut |now| {
            let flow = update_bar(&bar, now.share);
            if let Some(writer) = checkpoints.as_mut().filter(|writer| writer.is_wanted(flow.is_break())) {
                writer.write(Some(&Running::Poincare(Box::new(now.snapshot()))), terminal);
            }
            flow
        });
        bar.finish_and_clear();
        let found = found?.ok_or(Failure::Interrupted)?;
        steady_tables::poincare(self.terminal, &found);
        let partial = found.partial.is_some();
        self.results.poincare = Some(found);
        if partial { Err(Failure::Interrupted) } else { Ok(()) }
    }

    pub fn lyapunov(&mut self) -> Result<(), Failure> {
        let Some(study) = &self.machine.model.studies.lyapunov else { return Ok(()) };
        let bar = run_bar(self.terminal, "Lyapunov exponent");
        let snapshot = match self.running.take_if(|running| matches!(running, Running::Lyapunov(_))) {
            Some(Running::Lyapunov(snapshot)) => Some(*snapshot),
            _ => None,
        };
        let (checkpoints, terminal) = (&mut self.checkpoints, self.terminal);
        let found = self.machine.lyapunov_from(study, snapshot, &mut |now| {
            let flow = update_bar(&bar, now.share);
            if let Some(writer) = checkpoints.as_mut().filter(|writer| writer.is_wanted(flow.is_break())) {
                writer.write(Some(&Running::Lyapunov(Box::new(now.snapshot()))), terminal);
            }
            flow
        });
        bar.finish_and_clear();
        let found = found?.ok_or(Failure::Interrupted)?;
        steady_tables::lyapunov(self.terminal, &found);
        let partial = found.partial.is_some();
        self.results.lyapunov = Some(found);
        if partial { Err(Failure::Interrupted) } else { Ok(()) }
    }

    /// Computes all values in parallel; results before Ctrl-C are kept.
    pub fn bifurcation(&mut self) -> Result<(), Failure> {
        let bar = self.terminal.count_bar();
        bar.set_message("bifurcation diagram");
        let finished = match self.running.take_if(|running| matches!(running, Running::Bifurcation(_))) {
            Some(Running::Bifurcation(finished)) => finished,
            _ => FinishedValues::default(),
        };
        let (checkpoints, terminal) = (Mutex::new(&mut self.checkpoints), self.terminal);
        let progress = |now: &BifurcationProgress| {
            bar.set_length(now.planned as u64);
            bar.set_position(now.done as u64);
            let flow = continue_unless_interrupted();
            // Another thread that writes one does it for all.
            let locked = match flow {
                ControlFlow::Continue(()) => checkpoints.try_lock().ok(),
                ControlFlow::Break(()) => Some(checkpoints.lock().unwrap_or_else(PoisonError::into_inner)),
            };
            if let Some(mut locked) = locked
                && let Some(writer) = locked.as_mut().filter(|writer| writer.is_wanted(flow.is_break()))
            {
                writer.write(Some(&Running::Bifurcation(now.snapshot())), terminal);
            }
            flow
        };
        let found = bifurcation_from(&self.parameter_models, finished, &progress);
        bar.finish_and_clear();
        let found = match found {
            Err(_) if interrupt::requested() => return Err(Failure::Interrupted),
            found => found?,
        };
        steady_tables::bifurcation(self.terminal, &found);
        let complete = found.complete;
        self.results.bifurcation = Some(found);
        if complete { Ok(()) } else { Err(Failure::Interrupted) }
    }
}

fn run_bar(terminal: &Terminal, what: &str) -> ProgressBar {
    let bar = terminal.fraction_bar();
    bar.set_length(BAR_LENGTH as u64);
    bar.set_message(what.to_string());
    bar
}

fn update_bar(bar: &ProgressBar, share: f64) -> ControlFlow<()> {
    bar.set_position((BAR_LENGTH * share) as u64);
    continue_unless_interrupted()
}
