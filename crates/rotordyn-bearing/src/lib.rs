//! Bearing models: force, stiffness and damping between a shaft node and its housing.
//!
//! | module | contents |
//! |---|---|
//! | [`material`], [`contact`] | materials; contacts: Hertz, films, fitted laws, damping |
//! | [`geometry`], [`imperfection`] | geometry of a ball bearing; waviness, defects and sizes of races and balls |
//! | [`model`], [`internal`], [`bodies`] | interfaces of all bearing models; internal coordinates; free bodies |
//! | [`linear`], [`ball`], [`radial_ball`] | one module for each kind of model |
//! | [`free_ball`] | balls and cage as free bodies between given rings |
//! | [`Bearing`] | the list of models |
//! | [`rating`] | from the loads of the balls: motion, friction, limits, ratings and life |

mod bearing_contact;
pub mod contact;
pub mod geometry;
mod lanes;
pub mod material;
mod reaction;
mod root_finding;

pub mod bodies;
pub mod internal;
pub mod model;

pub mod imperfection;

pub mod ball;
pub mod free_ball;
pub mod linear;
pub mod radial_ball;

mod bearing;

pub mod rating;

pub use ball::{
    Arrangement, BallBearing, BallElement, BallInertia, BallLoad, Cage, Duplex, Fit, FitMaterials,
    InertiaDecision, Preload, PreloadState, Service, SpacedBalls,
};
pub use bearing::Bearing;
pub use bearing_contact::BearingContact;
pub use bodies::{BodyPose, FreeBodies, PlacedBalls};
pub use geometry::{BallGeometry, CharacteristicOrders};
pub use imperfection::{
    BallSpin, BallWave, Defect, DefectForm, DefectLaw, Deviation, Imperfections, OffSize, Profile,
    ProfileState, Shape, Surface, Wave,
};
pub use internal::InternalCoordinates;
pub use linear::{LinearBearing, LinearBearingRow, LinearElement};
pub use model::{BearingElement, BearingModel, BearingSymbol, BeyondTable, CageStart, SpeedRange};
pub use radial_ball::{RadialBallBearing, RadialElement};
pub use rating::{
    BallMotion, FrictionTorque, LimitCheck, LimitState, MountedGeometry, ShoulderMargin, friction,
    kinematics, life, limits, shoulder, shoulder_margin,
};
pub use reaction::{Reaction, Rotation, SiteTangent};

pub use ball::{fit, inertia as ball_inertia};
