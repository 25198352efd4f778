//! Errors of the library: input, physics, environment.

use std::path::{Path, PathBuf};

/// Anything that can go wrong outside reading a model file.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// The physics has no answer here: item, speed, time, iteration and residual as far as known.
    #[error("{0}")]
    Physics(#[from] PhysicsError),
    /// A record or setting that a signal function cannot work with.
    #[error(transparent)]
    Signal(#[from] crate::signal::SignalError),
    /// A record that cannot serve as what was asked of it.
    #[error(transparent)]
    Record(#[from] crate::signal::record::RecordError),
    /// A model that cannot be held against what was measured.
    #[error(transparent)]
    Update(#[from] crate::update::UpdateError),
    /// FRFs from which no modes come.
    #[error(transparent)]
    Identify(#[from] crate::identify::IdentifyError),
    /// A file whose content cannot be used: what is wrong with it, and what to do.
    #[error("{}: {problem}; {advice}", path.display())]
    Content { path: PathBuf, problem: String, advice: String },
    /// A file or folder did not obey.
    #[error("{operation} {}: {source}", path.display())]
    Environment { operation: &'static str, path: PathBuf, source: Box<dyn std::error::Error + Send + Sync> },
}

impl Error {
    /// The failure of an operation on a file or folder, for `map_err`.
    pub fn of_file<E>(operation: &'static str, path: &Path) -> impl Fn(E) -> Self
    where
        E: Into<Box<dyn std::error::Error + Send + Sync>>,
    {
        move |source| Self::Environment { operation, path: path.into(), source: source.into() }
    }
}

/// A failure of the physics, with all that is known about where it happened.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum PhysicsError {
    #[error(
        "the system is singular: {motion} is free to move; hold it with a bearing, bushing, joint or drive"
    )]
    Singular { motion: String },
    #[error(
        "no static equilibrium at {speed_rpm:.1} rpm: residual {residual:.3e} N at {item} after {iterations} iterations"
    )]
    NoEquilibrium { item: String, speed_rpm: f64, residual: f64, iterations: usize },
    #[error(
        "no convergence at t = {time:.6} s, {speed_rpm:.1} rpm: residual {residual:.3e} at {item} after {iterations} iterations and the smallest step"
    )]
    NoConvergence { item: String, time: f64, speed_rpm: f64, residual: f64, iterations: usize },
    #[error("the run diverged at t = {time:.6} s, {speed_rpm:.1} rpm: {item} is at {value:.3e}")]
    Diverged { item: String, time: f64, speed_rpm: f64, value: f64 },
    #[error("the clock of the section stands still at {speed_rpm:.1} rpm")]
    ClockStandsStill { speed_rpm: f64 },
    #[error("no steady motion at any value: {reason}")]
    NoMotion { reason: String },
    #[error(
        "bearing {bearing} has no equilibrium under F = ({:.4}, {:.4}, {:.4}) N, M = ({:.4}, {:.4}) N m at {speed_rpm:.1} rpm: residual {residual:.3e} N after {iterations} iterations",
        load[0], load[1], load[2], load[3], load[4]
    )]
    NoBearingEquilibrium { bearing: String, load: [f64; 5], speed_rpm: f64, residual: f64, iterations: usize },
    #[error("bearing {bearing}, {race} race: {reason}")]
    Film { bearing: String, race: String, reason: String },
    #[error("no derivative by the parameter: {reason}")]
    NoDerivative { reason: String },
    #[error("eigenvalue computation failed at {speed_rpm:.1} rpm: {reason}")]
    Eigen { speed_rpm: f64, reason: String },
}
