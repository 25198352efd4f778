//! Errors of the study of a bearing with free balls.

use crate::assembly::PhysicsError;
use rotordyn_bearing::free_ball::FreeBallError;

/// Why a bearing with free balls has no steady state.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum FreeBallStudyError {
    #[error(transparent)]
    Physics(#[from] PhysicsError),
    #[error("bearing {bearing} at {speed_rpm:.0} rpm: {cause}")]
    FreeBalls { bearing: String, speed_rpm: f64, cause: FreeBallError },
    #[error(
        "the cage speed of bearing {bearing} at {speed_rpm:.0} rpm has not settled in {turns} turns of the kinematic \
         cage: it is {ratio:.4} of kinematics and still changes by {change:.1e} of it"
    )]
    NotSettled { bearing: String, speed_rpm: f64, turns: usize, ratio: f64, change: f64 },
    #[error(
        "the force of bearing {bearing} at {speed_rpm:.0} rpm does not balance its load of {load:.4e} N: {residual:.1e} \
         of it remains"
    )]
    NotBalanced { bearing: String, speed_rpm: f64, load: f64, residual: f64 },
    #[error("bearing {bearing}: {what}")]
    Overlap { bearing: String, what: String },
    #[error("the run of bearing {bearing} with free balls was stopped")]
    Stopped { bearing: String },
    #[error("bearing {bearing} with free balls needs {what}")]
    Setting { bearing: String, what: &'static str },
}
