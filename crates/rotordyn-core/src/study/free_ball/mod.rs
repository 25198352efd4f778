//! One bearing with free balls under steady load: cage speed, skidding map, comparison with the kinematic cage.

mod error;
mod skidding;
mod steady;
mod tally;

pub use error::FreeBallStudyError;
pub use skidding::skidding_map;
pub use steady::steady_run;
