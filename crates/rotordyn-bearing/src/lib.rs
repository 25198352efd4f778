//! Bearing models: force, stiffness and damping between a shaft node and its housing.

pub mod contact;
pub mod material;

pub mod ball;
pub mod ball_bearing;
mod ball_change;
mod ball_derivatives;
mod ball_equilibrium;
pub mod ball_inertia;
mod ball_load;
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
pub mod lubrication;
mod massless;
mod plane_motion;
mod preload;
mod preload_mechanism;
pub mod profile;
mod raceway;
pub mod radial;
pub mod rating;
mod reaction;
mod ring_equilibrium;
mod ring_motion;
mod root_finding;
mod row;
pub mod shoulder;
mod spall;
mod spring_preload;
mod surface;

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
pub use reaction::{Reaction, Rotation};
pub use shoulder::{ShoulderMargin, shoulder_margin};

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
