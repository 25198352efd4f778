//! Nonlinear transients in time.

pub mod cage;
pub mod energy;
pub mod generalised_alpha;
pub mod reduction;
pub mod run;
pub mod runge_kutta;
pub mod system;
pub mod torque;
