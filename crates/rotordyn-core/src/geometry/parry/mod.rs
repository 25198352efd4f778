//! Distances and overlaps of a bearing's parts by parry; a ball's gap to a race is exact to rounding.

mod convert;
mod distance;
pub mod overlap;
mod shape;

pub(crate) use convert::vector;
pub use overlap::{Overlap, Part};
pub(crate) use shape::ExactShape;
