//! Surfaces that touch in a ball bearing.

use crate::BallGeometry;
use serde::{Deserialize, Serialize};

/// Surface on which a defect is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Surface {
    Inner,
    Outer,
    /// On this ball; it meets both races, half a turn of ball spin apart.
    Ball(usize),
}

impl Surface {
    /// Radius of the circle along which a defect's width is measured \[m\].
    pub fn radius(self, g: &BallGeometry) -> f64 {
        let contact_offset = 0.5 * g.ball_diameter * g.contact_angle.cos();
        match self {
            Self::Inner => 0.5 * g.pitch_diameter - contact_offset,
            Self::Outer => 0.5 * g.pitch_diameter + contact_offset,
            Self::Ball(_) => 0.5 * g.ball_diameter,
        }
    }
}
