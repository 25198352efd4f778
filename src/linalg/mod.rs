//! Linear algebra: the only bridge between nalgebra and faer, and interpolation.

pub mod pchip;
pub mod small;
