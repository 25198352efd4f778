//! The nonlinear transient against linear theory, itself at another step, and its energy account.

#[path = "../common/rig.rs"]
mod rig;

mod attractor;
mod hammer;
mod high_speed;
mod imperfections;
mod run_up;
mod torque;
mod varying_compliance;
