//! Nonlinear transients in time.

pub mod system;
