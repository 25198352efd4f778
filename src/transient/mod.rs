//! Nonlinear transients in time: through a speed profile, and at steady speed for its attractors.

pub mod cage;
pub mod companion;
pub mod energy;
pub mod generalised_alpha;
pub mod reduction;
pub mod run;
pub mod runge_kutta;
pub mod steady;
pub mod stepper;
pub mod system;
pub mod torque;
