//! Runs the steady-speed studies (Poincaré, Lyapunov, bifurcation) with progress bars; Ctrl-C keeps partial
//! results.

use std::ops::ControlFlow;

use indicatif::ProgressBar;
use rayon::prelude::*;
use rotordyn::model::{Loaded, Model};
use rotordyn::study::bifurcation;

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
        let found = self.machine.poincare(study, &mut |share| update_bar(&bar, share));
        bar.finish_and_clear();
        let found = found?.ok_or(Failure::Interrupted)?;
        steady_tables::poincare(self.terminal, &found);
        self.results.poincare = Some(found);
        Ok(())
    }

    pub fn lyapunov(&mut self) -> Result<(), Failure> {
        let Some(study) = &self.machine.model.studies.lyapunov else { return Ok(()) };
        let bar = run_bar(self.terminal, "Lyapunov exponent");
        let found = self.machine.lyapunov(study, &mut |share| update_bar(&bar, share));
        bar.finish_and_clear();
        let found = found?.ok_or(Failure::Interrupted)?;
        steady_tables::lyapunov(self.terminal, &found);
        self.results.lyapunov = Some(found);
        Ok(())
    }

    /// Computes all values in parallel; results before Ctrl-C are kept.
    pub fn bifurcation(&mut self) -> Result<(), Failure> {
        let bar = self.terminal.count_bar();
        bar.set_message("bifurcation diagram");
        let progress = |done: usize, planned: usize| {
            bar.set_length(planned as u64);
            bar.set_position(done as u64);
            continue_unless_interrupted()
        };
        let found = bifurcation(&self.parameter_models, &progress);
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
