//! The commands that run one study of a model: which study, and its settings from flags and defaults.

use rotordyn::model::Model;

use super::args::{CheckpointArgs, Command, StudyArgs};
use super::settings::{self, Settings};
use super::steady_settings;
use super::studies::Study;

/// The study of a command, with its arguments.
#[derive(Clone, Copy, Debug)]
pub struct StudyCommand<'c> {
    pub study: Study,
    pub args: &'c StudyArgs,
    /// Of studies that can be stopped and resumed.
    pub checkpoints: Option<&'c CheckpointArgs>,
    command: &'c Command,
}

impl<'c> StudyCommand<'c> {
    /// The study of a command; `None` for other commands.
    pub fn of(command: &'c Command) -> Option<Self> {
        let (study, args, checkpoints) = match command {
            Command::Static { study, .. } => (Study::Static, study, None),
            Command::Modal { study, .. } => (Study::Modal, study, None),
            Command::Campbell { study, .. } => (Study::Campbell, study, None),
            Command::Critical { study, .. } => (Study::Critical, study, None),
            Command::CriticalMap(args) => (Study::CriticalMap, &args.study, None),
            Command::Torsional(args) => (Study::Torsional, &args.study, None),
            Command::Frf { study, .. } => (Study::Frf, study, None),
            Command::Unbalance { study, .. } => (Study::Unbalance, study, None),
            Command::RunUp { study, checkpoints, .. } => (Study::RunUp, study, Some(checkpoints)),
            Command::Poincare(args) => (Study::Poincare, &args.steady.study, Some(&args.steady.checkpoints)),
            Command::Lyapunov(args) => (Study::Lyapunov, &args.study, Some(&args.checkpoints)),
            Command::Bifurcation(args) => {
                (Study::Bifurcation, &args.steady.study, Some(&args.steady.checkpoints))
            }
            _ => return None,
        };
        Some(Self { study, args, checkpoints, command })
    }

    /// Settings from the flags, and defaults where the model has no section of the study.
    pub fn settings(&self, model: &Model) -> Settings {
        match self.command {
            Command::Static { speed, fixed_cage_angle, .. } => {
                settings::equilibrium(model, speed.as_ref(), *fixed_cage_angle)
            }
            Command::Modal { speed, modes, .. } => settings::modal(model, speed.as_ref(), *modes),
            Command::Campbell { max_speed, modes, .. } => {
                settings::campbell(model, max_speed.as_ref(), *modes)
            }
            Command::Critical { max_speed, orders, .. } => {
                settings::critical(model, max_speed.as_ref(), orders)
            }
            Command::CriticalMap(args) => settings::critical_map(model, args),
            Command::Torsional(args) => settings::torsional(model, args),
            Command::Frf { speed, max_frequency, quantity, .. } => {
                settings::frf(model, speed.as_ref(), max_frequency.as_ref(), quantity.as_ref())
            }
            Command::Unbalance { max_speed, speed_range, .. } => {
                settings::unbalance(model, max_speed.as_ref(), speed_range.as_ref())
            }
            Command::RunUp { step, integrator, sample_rate, motion_rate, cage_phases, .. } => {
                let [step, integrator, rate, motion] =
                    [step, integrator, sample_rate, motion_rate].map(Option::as_ref);
                settings::run_up(model, step, integrator, rate, motion, *cage_phases)
            }
            Command::Poincare(args) => steady_settings::poincare(model, args),
            Command::Lyapunov(args) => steady_settings::lyapunov(model, args),
            Command::Bifurcation(args) => steady_settings::bifurcation(model, args),
            _ => Settings::default(),
        }
    }
}
