//! Ball inertia: which inertial loads the balls have, and which race resists the gyroscopic moment.

use serde::{Deserialize, Serialize};

/// Limit of F_c over the largest contact load above which automatic ball inertia is on.
///
/// Below it the neglected inertia changes displacements and stiffnesses by up to 0.2 %, and by up to 1.2 % where radial
/// load leaves balls of a steep contact angle (40°) nearly unloaded.
pub const INERTIA_LIMIT: f64 = 0.003;

/// Ball inertia model: centrifugal force, gyroscopic moment, raceway control hypothesis.
///
/// Friction of the races balances the gyroscopic moment M of a ball of diameter D, f_i + f_o = 2 M/D (f_i
/// inner, f_o outer); the control hypothesis gives the shares, and the race on which the ball rolls without spin.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum BallInertia {
    /// Decided by the ratio of F_c to the largest contact load at the highest speed of a study, outer race
    /// control where it is on; massless until decided.
    Auto(Option<InertiaDecision>),
    /// Massless balls: equal load and contact angle at both races.
    None,
    /// Two contact angles per ball; the outer race alone resists the gyroscopic moment: (f_i, f_o) = (0, 2) M/D.
    OuterRaceControl,
    /// The inner race alone resists it: (2, 0) M/D, save on balls whose inner contact carries less than the centrifugal
    /// force: there it passes to the outer race.
    InnerRaceControl,
    /// Rolling on the inner race as under inner race control, both races resisting alike: (1, 1) M/D, Harris'
    /// λ_i = λ_o = 1 wherever the outer race does not control.
    HarrisInnerRaceControl,
    /// d'Alembert: shared in proportion to the contact loads.
    Shared,
    /// Centrifugal force without gyroscopic moment; the cage speed is that of outer race control.
    Centrifugal,
    /// Constant centrifugal force F_c \[N\] of every ball at any speed, without gyroscopic moment.
    CentrifugalForce(f64),
}

/// Automatic decision about ball inertia.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct InertiaDecision {
    /// Whether the balls have inertia.
    pub on: bool,
    /// Highest speed of the study \[rad/s\].
    pub speed: f64,
    /// F_c at that speed, and the largest contact load \[N\].
    pub centrifugal: f64,
    pub contact_load: f64,
}

impl InertiaDecision {
    /// F_c over the largest contact load; infinite without load, 0 at rest.
    pub fn ratio(&self) -> f64 {
        match self.centrifugal > 0.0 {
            true => self.centrifugal / self.contact_load,
            false => 0.0,
        }
    }
}

impl Default for BallInertia {
    fn default() -> Self {
        Self::Auto(None)
    }
}

impl BallInertia {
    /// The model in effect, never `Auto`.
    pub fn in_effect(self) -> Self {
        match self {
            Self::Auto(Some(decision)) if decision.on => Self::OuterRaceControl,
            Self::Auto(_) => Self::None,
            stated => stated,
        }
    }

    /// The race that resists the gyroscopic moment M, with the friction of inner and outer race in units of M/D.
    pub fn hypothesis(self) -> &'static str {
        match self.in_effect() {
            Self::Auto(_) | Self::None => "none for massless balls",
            Self::OuterRaceControl => "outer race control, friction (inner, outer) = (0, 2) M/D",
            Self::InnerRaceControl => {
                "inner race control, friction (inner, outer) = (2, 0) M/D, less at the inner race of balls with Q_i below F_c"
            }
            Self::HarrisInnerRaceControl => {
                "inner race control after Harris, friction (inner, outer) = (1, 1) M/D, less at the inner race of balls \
                 with Q_i below F_c"
            }
            Self::Shared => "shared control, friction in proportion to the contact loads, 2 M/D in all",
            Self::Centrifugal | Self::CentrifugalForce(_) => {
                "none, centrifugal force without gyroscopic moment"
            }
        }
    }

    /// Whether the balls have inertial loads.
    pub fn is_on(self) -> bool {
        self.in_effect() != Self::None
    }

    /// Whether the inertial loads depend on speed.
    pub fn depends_on_speed(self) -> bool {
        self.is_on() && !matches!(self, Self::CentrifugalForce(_))
    }

    /// Share of the friction in the race on which the ball rolls, of 2 M/D.
    pub(super) fn friction_share(self) -> f64 {
        if self.in_effect() == Self::HarrisInnerRaceControl { 0.5 } else { 1.0 }
    }

    /// Whether the balls have a gyroscopic moment.
    pub(crate) fn has_moment(self) -> bool {
        !matches!(self.in_effect(), Self::None | Self::Centrifugal | Self::CentrifugalForce(_))
    }

    /// Keyword in model files and results.
    pub fn keyword(self) -> &'static str {
        match self {
            Self::Auto(_) => "auto",
            Self::None => "none",
            Self::OuterRaceControl => "outer_race_control",
            Self::InnerRaceControl => "inner_race_control",
            Self::HarrisInnerRaceControl => "harris_inner_race_control",
            Self::Shared => "shared",
            Self::Centrifugal => "centrifugal",
            Self::CentrifugalForce(_) => "centrifugal_force",
        }
    }
}
