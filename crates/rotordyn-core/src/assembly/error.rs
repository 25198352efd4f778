//! Errors of the physics and of its numerical solution.

use serde::{Deserialize, Serialize};

/// A failure of the physics or of its numerical solution, with item, speed, time and residual if known.
#[derive(Clone, Debug, PartialEq, thiserror::Error, Serialize, Deserialize)]
pub enum PhysicsError {
    #[error(
        "the system is singular: {motion} is unconstrained; constrain it with a bearing, bushing, joint or drive"
    )]
    Singular { motion: String },
    #[error(
        "{motion} has a natural frequency of {frequency:.1e} Hz, almost 0 beside those of the shaft: stiffness holds it, but {item} of {mass:.3e} kg is too large for it; check the dimensions of {item}"
    )]
    AlmostFree { motion: String, frequency: f64, item: String, mass: f64 },
    #[error(
        "{item} has no inertia: a shaft of density 0 has mass at its discs only; state a small density, such as \"1 kg/m^3\", or a mass there"
    )]
    NoInertia { item: String },
    #[error(
        "no static equilibrium at {speed_rpm:.1} rpm: residual {residual:.3e} N at {item} after {iterations} iterations"
    )]
    NoEquilibrium { item: String, speed_rpm: f64, residual: f64, iterations: usize },
    #[error(
        "no convergence at t = {time:.6} s, {speed_rpm:.1} rpm: residual {residual:.3e} at {item} after {iterations} iterations and the smallest step"
    )]
    NoConvergence { item: String, time: f64, speed_rpm: f64, residual: f64, iterations: usize },
    #[error("the run diverged at t = {time:.6} s, {speed_rpm:.1} rpm: {item} is at {value:.3e}{advice}")]
    Diverged {
        item: String,
        time: f64,
        speed_rpm: f64,
        value: f64,
        /// What helps against it, after "; "; empty if only the machine may be the cause.
        #[serde(default)]
        advice: String,
    },
    #[error(
        "unbalance {unbalance} of {magnitude:.3e} kg m is too large for a torque drive: U^2 must be less than m J of the rotor at its station, and there m = {mass:.3e} kg and J = {inertia:.3e} kg m^2 move with it; put it on a disc, or add its mass as a disc"
    )]
    UnbalanceAboveInertia { unbalance: String, magnitude: f64, mass: f64, inertia: f64 },
    #[error(
        "the snapshot at t = {time:.6} s is one of another machine or integrator: resume with the model and settings of its run"
    )]
    OtherSnapshot { time: f64 },
    #[error("the clock of the Poincaré section does not advance at {speed_rpm:.1} rpm")]
    SectionClockStopped { speed_rpm: f64 },
    #[error("no steady motion at any value of the parameter: {reason}")]
    NoSteadyMotion { reason: String },
    #[error(
        "bearing {bearing} has no equilibrium under F = ({:.4}, {:.4}, {:.4}) N, M = ({:.4}, {:.4}) N m at {speed_rpm:.1} rpm: residual {residual:.3e} N after {iterations} iterations",
        load[0], load[1], load[2], load[3], load[4]
    )]
    NoBearingEquilibrium { bearing: String, load: [f64; 5], speed_rpm: f64, residual: f64, iterations: usize },
    #[error(
        "bearing {bearing}: its table covers {:.0} to {:.0} rpm, {study} needs {} rpm",
        table_rpm[0], table_rpm[1], range(study_rpm)
    )]
    BeyondTable { bearing: String, study: String, table_rpm: [f64; 2], study_rpm: [f64; 2] },
    #[error(
        "no interference of bearing {item} gives its mounted preload of {force:.4} N: it carries {reached:.4} N in the machine at standstill; the shaft's other axial supports or its axial load limit it"
    )]
    NoMountedPreload { item: String, force: f64, reached: f64 },
    #[error("bearing {bearing}, {race} race: {reason}")]
    Film { bearing: String, race: String, reason: String },
    #[error("bearing {bearing} at t = {time:.6} s, {speed_rpm:.1} rpm: {reason}")]
    FreeBodies { bearing: String, time: f64, speed_rpm: f64, reason: String },
    #[error(
        "{purpose} needs {gigabytes:.1} GB for dense matrices of {unknowns} coupled unknowns, at most {limit:.1} GB are allowed: {shaft}; check the unit of its length, or raise element_length"
    )]
    TooLarge { purpose: String, unknowns: usize, gigabytes: f64, limit: f64, shaft: String },
    #[error(
        "round-off, which grows with the fourth power of the number of elements, leaves an error of about {:.1e} of the static displacements: {shaft}; check the unit of its length, or raise element_length",
        .error
    )]
    RoundOff { error: f64, shaft: String },
    #[error(
        "{study} needs {megabytes:.0} MB for mode shapes at all speeds, at most {limit:.0} MB are allowed: {shaft}; check the unit of its length, or raise element_length"
    )]
    TooManyShapes { study: String, megabytes: f64, limit: f64, shaft: String },
    #[error(
        "the recorded motion of a run has {frames:.0} frames, {gigabytes:.1} GB in memory, at most {limit:.1} GB are allowed; lower motion_rate, or record a shorter time"
    )]
    TooManyFrames { frames: f64, gigabytes: f64, limit: f64 },
    #[error(
        "{motion} is unconstrained, or so soft that its natural frequency is below 0.016 Hz: {shaft}, {slenderness:.0} times its thickness; check the unit of its length"
    )]
    TooSlender { motion: String, slenderness: f64, shaft: String },
    #[error("no derivative with respect to the parameter: {reason}")]
    NoDerivative { reason: String },
    #[error("the computation was stopped")]
    Stopped,
    #[error("eigenvalue computation failed at {speed_rpm:.1} rpm: {reason}")]
    Eigen { speed_rpm: f64, reason: String },
}

/// A range of speeds in words; one speed if both are the same.
fn range(rpm: &[f64; 2]) -> String {
    let [low, high] = rpm.map(|speed| format!("{speed:.0}"));
    if low == high { low } else { format!("{low} to {high}") }
}
