//! Nonlinear transient runs: comparison with linear theory and smaller steps, energy balance.

#[path = "../common/measured_data.rs"]
mod measured_data;
#[path = "../common/rig.rs"]
mod rig;

mod cage_phases;
mod cross_coupling;
mod defect_steps;
mod free_balls;
mod high_speed;
mod impact;
mod imperfections;
mod interface_forces;
mod load_history;
mod measured_run_up;
mod radial_balls;
mod resume;
mod resume_steady;
mod run_up;
mod static_and_steady;
mod steady_motion;
mod torque;
mod torque_coupling;
mod varying_compliance;
