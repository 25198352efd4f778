//! Closed forms.

#[path = "../common/agree.rs"]
mod agree;
#[path = "../../crates/rotordyn-bearing/tests/common/bearing.rs"]
mod bearing;
#[path = "../common/machine.rs"]
mod machine;

mod belt;
mod cage;
mod effective_mass;
mod fits;
mod jones_thrust;
mod large_shaft;
mod precession;
mod responses;
mod rigid_rotor;
mod rotor_maps;
mod shaft_limits;
mod shaft_loads;
mod stiff_springs;
mod unbalance_phase;
