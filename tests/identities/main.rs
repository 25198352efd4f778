//! Identities that hold for any machine, checked on random and example machines.

#[path = "../../crates/rotordyn-bearing/tests/common/bearing.rs"]
mod bearing;
#[path = "../common/machine.rs"]
#[allow(dead_code)]
mod machine;
#[path = "../common/rig.rs"]
mod rig;

mod automatic_ball_inertia;
mod bearing_solver;
mod complete_crossings;
mod divergence;
mod double_eigenvalues;
mod heavily_damped;
mod linear;
mod many_at_once;
mod modal_damping;
mod planes;
mod random_bearing_warnings;
mod random_bearings;
mod refined_grids;
mod sensitivity;
mod speed_dependent_bearings;
mod tables;
mod thresholds;
mod tracking;
mod undamped;
mod whirl_tables;
