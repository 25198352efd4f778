//! Fitted orders of convergence.

#[path = "../common/machine.rs"]
#[allow(dead_code)]
mod machine;
#[path = "../common/rig.rs"]
mod rig;
#[path = "../common/ross.rs"]
#[allow(dead_code)]
mod ross;

mod integrators;
mod radial_balls;
mod shaft_element;
