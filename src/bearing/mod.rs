//! Bearing models: force, stiffness and damping between a shaft node and its housing.

pub mod ball;
pub mod ball_bearing;
mod ball_change;
mod ball_derivatives;
mod ball_equilibrium;
pub mod ball_inertia;
mod ball_sum;
mod cage;
mod cage_equilibrium;
mod defect_force;
mod duplex;
pub mod element;
pub mod fit;
mod force_kernel;
pub mod friction;
pub mod geometry;
pub mod imperfections;
mod inertial_ball;
pub mod kinematics;
pub mod life;
pub mod limits;
pub mod linear;
mod massless;
mod preload;
pub mod profile;
mod raceway;
pub mod radial;
pub mod rating;
mod ring_equilibrium;
mod ring_motion;
mod root_finding;
mod row;
pub mod shoulder;
mod spall;
mod spring_preload;

pub use ball::{BallElement, BallLoad};
pub use ball_bearing::{Arrangement, BallBearing, Cage, Duplex, Preload, Service};
pub use ball_inertia::{BallInertia, InertiaDecision};
pub use element::BearingElement;
pub use fit::{Fit, FitMaterials};
pub use friction::FrictionTorque;
pub use geometry::{BallGeometry, CharacteristicOrders};
pub use imperfections::{
    BallSpin, BallWave, Defect, DefectForm, DefectLaw, Imperfections, OffSize, Shape, Surface, Wave,
};
pub use kinematics::{BallMotion, MountedGeometry};
pub use linear::{LinearElement, SiteTangent};
pub use preload::PreloadState;
pub use profile::{Deviation, Profile, ProfileState};
pub use radial::{RadialBallBearing, RadialElement};
pub use shoulder::{ShoulderMargin, shoulder_margin};

/// Kinematic state of a bearing at one instant: angles and speeds of cage and shaft.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Rotation {
    /// Cage angle ψ \[rad\].
    pub cage_angle: f64,
    /// Cage speed ψ̇ \[rad/s\]; `None` in statics: the contacts do not move past the rings, and the balls have
    /// the inertial loads of the cage speed at which they roll under the contact angles of the equilibrium.
    pub cage_speed: Option<f64>,
    /// Shaft (inner race) angle θ \[rad\] and speed θ̇ \[rad/s\].
    pub shaft_angle: f64,
    pub shaft_speed: f64,
}

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

/// Linear bearing: stiffness and damping matrices, constant or tabulated over speed.
#[derive(Clone, Debug, PartialEq)]
pub struct LinearBearing {
    /// Rows sorted by speed \[rad/s\]; one row means constant. Interpolated by monotone cubic (PCHIP); beyond
    /// its first and last row the values of that row hold.
    pub table: Vec<LinearBearingRow>,
    /// Studies at speeds beyond the table.
    pub beyond: BeyondTable,
}

/// Treatment of studies at speeds beyond a bearing's table.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum BeyondTable {
    /// The values of the table's end hold, with a warning.
    #[default]
    Hold,
    /// An error.
    Refuse,
}

impl LinearBearing {
    /// First and last speed of the table \[rad/s\]; `None` for constant stiffness and damping.
    pub fn table_range(&self) -> Option<[f64; 2]> {
        match self.table.as_slice() {
            [first, .., last] => Some([first.speed, last.speed]),
            _ => None,
        }
    }
}

/// One row of a [`LinearBearing`]'s table.
#[derive(Clone, Debug, PartialEq)]
pub struct LinearBearingRow {
    /// Speed Ω \[rad/s\].
    pub speed: f64,
    /// Stiffness K, order u_x u_y u_z θ_x θ_y θ_z.
    pub stiffness: [[f64; 6]; 6],
    /// Damping C, same order.
    pub damping: [[f64; 6]; 6],
}

/// Bearing force on the shaft with stiffness and damping tangents, at one relative displacement and velocity.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Reaction {
    /// Force and moment on the shaft f \[N, N m\]; the reaction on the housing is −f.
    pub force: [f64; 6],
    /// Additional force on the housing, on top of −f, along x and y \[N\]: weight and centrifugal force of
    /// balls with inertia.
    pub housing_force: [f64; 2],
    /// −∂f/∂d.
    pub stiffness: [[f64; 6]; 6],
    /// −∂f/∂ḋ.
    pub damping: [[f64; 6]; 6],
    /// Elastic energy stored \[J\].
    pub elastic_energy: f64,
    /// Parametric power \[W\]: input to the elastic energy by cage rotation, waviness and defects passing the
    /// contacts.
    pub parametric_power: f64,
    /// Power lost in contact damping \[W\].
    pub dissipated_power: f64,
    /// Load-weighted mean of cos α over the loaded balls.
    pub mean_cos: f64,
}

impl Reaction {
    /// Adds `weight` times another reaction.
    pub fn add(&mut self, other: &Self, weight: f64) {
        for a in 0..6 {
            self.force[a] += weight * other.force[a];
            for b in 0..6 {
                self.stiffness[a][b] += weight * other.stiffness[a][b];
                self.damping[a][b] += weight * other.damping[a][b];
            }
        }
        for (own, other) in self.housing_force.iter_mut().zip(other.housing_force) {
            *own += weight * other;
        }
        self.elastic_energy += weight * other.elastic_energy;
        self.parametric_power += weight * other.parametric_power;
        self.dissipated_power += weight * other.dissipated_power;
        self.mean_cos += weight * other.mean_cos;
    }
}
