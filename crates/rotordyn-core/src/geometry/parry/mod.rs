//! Distances and overlaps of a bearing's parts by parry; a ball's gap to a race is exact to rounding.

mod convert;
mod distance;
pub mod free_ball;
pub mod overlap;
mod shape;

pub(crate) use convert::vector;
pub use free_ball::ParryDistances;
pub use overlap::{Overlap, Part};
pub(crate) use shape::ExactShape;
