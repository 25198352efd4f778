//! Cage kinematics: ratio of cage to shaft speed, from a mean contact angle or as given.

use super::{BallBearing, Cage};

/// Cage speed of a bearing as a function of its mean contact angle.
#[derive(Clone, Copy, Debug)]
pub(super) struct CageKinematics {
    cage: Cage,
    ball_to_pitch: f64,
    pub nominal_cos: f64,
}

impl CageKinematics {
    pub fn new(bearing: &BallBearing) -> Self {
        let g = &bearing.geometry;
        Self {
            cage: bearing.cage,
            ball_to_pitch: g.ball_diameter / g.pitch_diameter,
            nominal_cos: g.contact_angle.cos(),
        }
    }

    /// Cage speed over shaft speed at a mean contact angle: ½ (1 − D_w cos α / D_pw), or the given ratio.
    pub fn ratio(&self, mean_cos: f64) -> f64 {
        match self.cage {
            Cage::Rolling => 0.5 * (1.0 - self.ball_to_pitch * mean_cos),
            Cage::Ratio(ratio) => ratio,
        }
    }

    /// Derivative of [`Self::ratio`] by the mean cos α.
    pub fn ratio_by_cos(&self) -> f64 {
        match self.cage {
            Cage::Rolling => -0.5 * self.ball_to_pitch,
            Cage::Ratio(_) => 0.0,
        }
    }

    /// Ratio at the nominal contact angle.
    pub fn nominal_ratio(&self) -> f64 {
        self.ratio(self.nominal_cos)
    }

    /// Whether the ratio depends on the contact angles.
    pub fn is_rolling(&self) -> bool {
        self.cage == Cage::Rolling
    }
}
