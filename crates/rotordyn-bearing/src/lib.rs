//! Bearing models: force, stiffness and damping between a shaft node and its housing.

pub mod contact;
pub mod geometry;
pub mod material;
mod reaction;
mod root_finding;

pub mod imperfection;

pub mod ball;
pub mod linear;
pub mod radial_ball;

pub mod element;
pub mod rating;

pub use ball::{
    Arrangement, BallBearing, BallElement, BallInertia, BallLoad, Cage, Duplex, Fit, FitMaterials,
    InertiaDecision, Preload, PreloadState, Service,
};
pub use element::{Bearing, BearingElement};
pub use geometry::{BallGeometry, CharacteristicOrders};
pub use imperfection::{
    BallSpin, BallWave, Defect, DefectForm, DefectLaw, Deviation, Imperfections, OffSize, Profile,
    ProfileState, Shape, Surface, Wave,
};
pub use linear::{BeyondTable, LinearBearing, LinearBearingRow, LinearElement, SiteTangent};
pub use radial_ball::{RadialBallBearing, RadialElement};
pub use rating::{
    BallMotion, FrictionTorque, MountedGeometry, ShoulderMargin, friction, kinematics, life, limits,
    shoulder, shoulder_margin,
};
pub use reaction::{Reaction, Rotation};

pub use ball::{fit, inertia as ball_inertia};
