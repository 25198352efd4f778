//! Nonlinear transient simulation (time integration): run-ups through a speed profile, and steady motions at
//! constant speed.

pub mod cage;
pub mod channels;
mod defect_steps;
pub mod energy;
mod free_bodies;
pub mod generalised_alpha;
pub mod inertias;
pub mod interface;
mod load_corners;
mod loads;
mod numbers;
mod panels;
pub mod peak_loads;
pub mod perturbed_trajectory;
pub mod reduction;
pub mod run;
pub mod runge_kutta;
pub mod steady;
pub mod stepper;
pub mod system;
pub mod torque;
