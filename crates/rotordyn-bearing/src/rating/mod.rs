//! What the loads of the balls mean for a ball bearing: motion of the balls, friction, limits, ratings and life.

pub mod friction;
pub mod kinematics;
pub mod life;
pub mod limit_checks;
pub mod limits;
pub mod load_rating;
pub mod row_load;
pub mod shoulder;

pub use friction::FrictionTorque;
pub use kinematics::{BallMotion, MountedGeometry};
pub use limit_checks::{LimitCheck, LimitState};
pub use load_rating::{
    EquivalentLoad, LARGEST_RADIAL_ANGLE, LoadRating, STANDARD_OSCULATION, STATIC_CONTACT_STRESS,
    equivalent_load, static_equivalent_load, static_factor,
};
pub use row_load::RowLoad;
pub use shoulder::{ShoulderMargin, shoulder_margin};
