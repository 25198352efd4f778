//! Modal identification from FRFs: exactness, noise, measured structures.

#[path = "../common/measured_data.rs"]
mod measured_data;
#[path = "../common/rig.rs"]
mod rig;

mod changed_rig;
#[path = "../../crates/rotordyn-identify/tests/identify/known_modes.rs"]
#[allow(dead_code)]
mod known_modes;
mod plane_ema;
