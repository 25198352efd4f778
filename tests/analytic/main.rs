//! Closed forms.

#[path = "../common/bearing.rs"]
mod bearing;
#[path = "../common/machine.rs"]
mod machine;

mod fits;
mod hertz;
mod rigid_rotor;
mod shaft_limits;
