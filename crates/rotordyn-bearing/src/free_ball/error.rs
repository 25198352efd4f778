//! Errors of free balls and cage.

use thiserror::Error;

/// Why a bearing with free balls cannot be prepared or advanced.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum FreeBallError {
    /// Input data that are not supported or contradict each other, one sentence each.
    #[error("{}", .0.join("; "))]
    Input(Vec<String>),
    /// Two parts overlap at the start: cage and ring, cage and ball, two balls.
    #[error("{what} at the start, {depth:.3e} m deep")]
    Overlap { what: String, depth: f64 },
    /// The step exceeds the stability limit of RK4 for this part.
    #[error("step {step:.3e} s at t = {time:.6} s is too large for {limit}; stable: {stable:.3e} s")]
    Step { step: f64, stable: f64, limit: StepLimit, time: f64 },
    /// A ball has left the bearing.
    #[error("ball {ball} left the bearing at t = {time:.6} s: {cause}")]
    BallLost { ball: usize, time: f64, cause: String },
    /// The cage has left the bearing or its motion has diverged.
    #[error("the cage left the bearing at t = {time:.6} s: {cause}")]
    CageLost { time: f64, cause: String },
}

/// What limits the time step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StepLimit {
    /// Stiffness and damping of the contacts against the mass of balls and cage.
    Contact,
    /// Friction over slip and drag over speed against the mass and inertia of balls and cage.
    Friction,
}

impl std::fmt::Display for StepLimit {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::Contact => "the contact stiffness",
            Self::Friction => "friction and drag",
        })
    }
}
