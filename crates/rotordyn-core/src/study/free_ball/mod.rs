//! One bearing with free balls under steady load: cage speed, skidding map, comparison with the kinematic cage.
//!
//! How far the hypotheses of race control are off: cage over shaft speed and pitch angle of the spin axis \[deg\] of the 218 angular
//! contact bearing under 17.8 kN of thrust (16 balls of 22.23 mm, pitch diameter 125.26 mm, 40°), by the hypotheses and by
//! friction integrated over the contact ellipse (`rotordyn_bearing`, example `race_control`; entries are recomputed by its test
//! `control_hypotheses_are_off_by_speed_and_friction`):
//!
//! | speed \[rpm\] | outer | inner | shared | μ = 0.02 | μ = 0.04 | μ = 0.06 | μ = 0.1 |
//! |---|---|---|---|---|---|---|---|
//! | 500 | 0.43357, 35.6 | 0.43353, 49.2 | 0.43353, 49.2 | 0.43368, 42.3 | 0.43368, 42.3 | 0.43368, 42.3 | 0.43368, 42.3 |
//! | 2000 | 0.43394, 35.2 | 0.43341, 49.4 | 0.43326, 49.5 | 0.43362, 42.2 | 0.43362, 42.3 | 0.43362, 42.3 | 0.43362, 42.3 |
//! | 5000 | 0.43664, 33.5 | 0.43262, 50.1 | 0.43565, 34.1 | 0.43425, 39.3 | 0.43463, 38.5 | 0.43486, 37.9 | 0.43496, 37.6 |
//! | 10000 | 0.45503, 26.7 | 0.42889, 52.4 | 0.44760, 28.9 | 0.48305, 5.0 | 0.46065, 19.4 | 0.44615, 30.9 | 0.44789, 30.5 |
//!
//! Slow balls spin alike on both races, half way between outer and inner control, whatever the friction; the axis is then 7° off
//! with either, the cage speed 0.03 %. The gyroscopic moment turns the axis towards outer control. At 10000 rpm outer control is
//! 4° and 2 % of the cage speed off for μ from 0.06, inner control 22° and 4 %; for less friction the balls slide
//! gyroscopically, and every hypothesis is wrong: μ = 0.02 leaves 5° of 27°, and a cage 6 % faster. Shared control,
//! friction in proportion to the loads, is the nearest at 10000 rpm (2°, 0.3 %) but 7° off at low speed.

mod error;
mod operating;
mod skidding;
#[cfg(feature = "shapes")]
mod start;
mod steady;
mod tally;

pub use error::FreeBallStudyError;
pub use operating::add_free_balls;
pub use skidding::skidding_map;
#[cfg(feature = "shapes")]
pub(crate) use start::overlap_at_start;
pub use steady::steady_run;
