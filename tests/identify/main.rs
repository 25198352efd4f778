//! Modal identification from FRFs: exactness, noise, measured structures.

#[path = "../common/measured_data.rs"]
mod measured_data;
#[path = "../common/rig.rs"]
mod rig;

mod changed_rig;
mod exact;
mod known_modes;
mod noise;
mod plane_ema;
mod refusals;
mod single;
