//! Theorems that hold for any machine, on random ones.

#[path = "../common/ehl.rs"]
mod lubricated;
#[path = "../common/machine.rs"]
mod machine;
#[path = "../common/rig.rs"]
mod rig;

mod double_eigenvalues;
mod ehl;
mod follow_speed;
mod linear;
mod planes;
mod sensitivity;
mod tracking;
