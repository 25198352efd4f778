//! Common interface of all bearing models.

use crate::{
    BallBearing, BallElement, BallLoad, LinearBearing, LinearElement, PreloadState, RadialBallBearing,
    RadialElement, Reaction, Rotation,
};

/// A bearing model.
#[derive(Clone, Debug, PartialEq)]
#[allow(clippy::large_enum_variant)] // a model has a handful of bearings
pub enum Bearing {
    Linear(LinearBearing),
    Ball(BallBearing),
    RadialBall(RadialBallBearing),
}

impl Bearing {
    /// Initial cage angle \[rad\]; 0 for a bearing without cage.
    pub fn cage_angle(&self) -> f64 {
        self.ball().map_or(0.0, |ball| ball.cage_angle)
    }

    /// Geometry, materials, cage and races of a bearing with balls.
    pub fn ball(&self) -> Option<&BallBearing> {
        match self {
            Self::Linear(_) => None,
            Self::Ball(ball) => Some(ball),
            Self::RadialBall(radial) => Some(&radial.ball),
        }
    }
}

/// A bearing prepared for evaluation.
#[derive(Clone, Debug)]
pub enum BearingElement {
    Linear(LinearElement),
    Ball(Box<BallElement>),
    RadialBall(Box<RadialElement>),
}

impl BearingElement {
    /// Prepares a bearing for evaluation.
    pub fn new(bearing: &Bearing) -> Self {
        match bearing {
            Bearing::Linear(linear) => Self::Linear(LinearElement::new(linear)),
            Bearing::Ball(ball) => Self::Ball(Box::new(BallElement::new(ball))),
            Bearing::RadialBall(radial) => Self::RadialBall(Box::new(RadialElement::new(radial))),
        }
    }

    /// Force on the shaft and both tangents at displacement `d` and velocity `v` of the shaft relative to
    /// the housing (order u_x u_y u_z θ_x θ_y θ_z); balls with radial coordinates are in static equilibrium.
    pub fn reaction(&self, d: &[f64; 6], v: &[f64; 6], rotation: &Rotation) -> Reaction {
        match self {
            Self::Linear(linear) => linear.reaction(d, v, rotation.shaft_speed),
            Self::Ball(ball) => ball.reaction(d, v, rotation),
            Self::RadialBall(radial) => radial.reaction(d, v, rotation),
        }
    }

    /// The force of [`BearingElement::reaction`] with its energy, powers and mean contact angle, written to
    /// `out`; the tangents of `out` are unspecified. For explicit time integration.
    pub fn force(&self, d: &[f64; 6], v: &[f64; 6], rotation: &Rotation, out: &mut Reaction) {
        match self {
            Self::Linear(linear) => *out = linear.reaction(d, v, rotation.shaft_speed),
            Self::Ball(ball) => ball.force(d, v, rotation, out),
            Self::RadialBall(radial) => *out = radial.reaction(d, v, rotation),
        }
    }

    /// Static reaction averaged over one ball pitch of cage angles (`angles` samples).
    pub fn cage_average(&self, d: &[f64; 6], rotation: &Rotation, angles: usize) -> Reaction {
        match self {
            Self::Linear(linear) => linear.reaction(d, &[0.0; 6], rotation.shaft_speed),
            Self::Ball(ball) => ball.cage_average(d, rotation, angles),
            Self::RadialBall(radial) => radial.cage_average(d, rotation, angles),
        }
    }

    /// Loads, contact angles, approach and film of every ball; empty for a bearing without balls.
    pub fn ball_loads(&self, d: &[f64; 6], rotation: &Rotation) -> Vec<BallLoad> {
        match self {
            Self::Linear(_) => Vec::new(),
            Self::Ball(ball) => ball.ball_loads(d, rotation),
            Self::RadialBall(radial) => radial.ball_loads(d, rotation),
        }
    }

    /// Axial preload of the centred bearing at a speed Ω \[rad/s\]; zero for a bearing without balls.
    pub fn preload_state(&self, speed: f64) -> PreloadState {
        match self {
            Self::Linear(_) | Self::RadialBall(_) => PreloadState::default(),
            Self::Ball(ball) => ball.preload_state(speed),
        }
    }

    /// Whether the force at given displacement and velocity depends on shaft speed.
    pub fn depends_on_speed(&self) -> bool {
        match self {
            Self::Linear(linear) => linear.depends_on_speed(),
            Self::Ball(ball) => ball.depends_on_speed(),
            Self::RadialBall(radial) => radial.ball_mass() > 0.0,
        }
    }

    /// Number of balls of a row; 0 for a bearing without balls.
    pub fn balls(&self) -> usize {
        match self {
            Self::Linear(_) => 0,
            Self::Ball(ball) => ball.balls(),
            Self::RadialBall(radial) => radial.balls(),
        }
    }

    /// The bearing as one whose balls have their own radial degrees of freedom in a transient, if it is one.
    pub fn radial(&self) -> Option<&RadialElement> {
        match self {
            Self::RadialBall(radial) => Some(radial),
            Self::Linear(_) | Self::Ball(_) => None,
        }
    }

    /// Number of relative degrees of freedom the bearing acts on: 2 for a plane bearing, 5 with free rotation
    /// of the shaft, else 6.
    pub fn relative_dofs(&self) -> usize {
        match self {
            Self::Linear(_) => 6,
            Self::Ball(_) => 5,
            Self::RadialBall(_) => 2,
        }
    }

    /// Cage speed over shaft speed at a mean contact angle; 0 for a bearing without cage.
    pub fn cage_ratio(&self, mean_cos: f64) -> f64 {
        match self {
            Self::Linear(_) => 0.0,
            Self::Ball(ball) => ball.cage_ratio(mean_cos),
            Self::RadialBall(radial) => radial.cage_ratio(),
        }
    }

    /// Cosine of the nominal contact angle.
    pub fn nominal_cos(&self) -> f64 {
        match self {
            Self::Linear(_) | Self::RadialBall(_) => 1.0,
            Self::Ball(ball) => ball.nominal_cos(),
        }
    }
}
