//! Cage kinematics: ratio of cage to shaft speed, from a mean contact angle or as given.

use crate::{BallBearing, Cage};

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

/// Σ Q_i over Σ F_c below which the mean contact angle of the loads fades to the nominal one: inner contacts much
/// lighter than the outer ones under centrifugal force do not drive the cage.
const DRIVING_LOAD: f64 = 0.05;

/// Mean cos α that sets the cage speed, and its derivatives.
#[derive(Clone, Copy, Debug)]
pub(super) struct MeanCos {
    pub value: f64,
    /// By Σ Q_i, Σ Q_i cos α and Σ F_c.
    pub by_load: f64,
    pub by_load_cos: f64,
    pub by_centrifugal: f64,
}

impl MeanCos {
    /// Load-weighted mean Σ Q_i cos α/Σ Q_i; nominal without load, with a smooth transition up to
    /// [`DRIVING_LOAD`]. `centrifugal`: Σ F_c \[N\], 0 for massless balls.
    pub fn new(load: f64, load_cos: f64, centrifugal: f64, nominal: f64) -> Self {
        if load <= 0.0 {
            return Self { value: nominal, by_load: 0.0, by_load_cos: 0.0, by_centrifugal: 0.0 };
        }
        let (mean, full) = (load_cos / load, DRIVING_LOAD * centrifugal);
        if load >= full {
            return Self { value: mean, by_load: -mean / load, by_load_cos: 1.0 / load, by_centrifugal: 0.0 };
        }
        let x = load / full;
        let (part, slope) = (x * x * (3.0 - 2.0 * x), 6.0 * x * (1.0 - x));
        Self {
            value: nominal + part * (mean - nominal),
            by_load: slope * (mean - nominal) / full - part * mean / load,
            by_load_cos: part / load,
            by_centrifugal: -slope * x * (mean - nominal) / centrifugal,
        }
    }
}
