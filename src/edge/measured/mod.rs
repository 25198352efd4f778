//! Measured files of any known format.

pub mod unit;
