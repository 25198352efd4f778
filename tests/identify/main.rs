//! Modes from FRFs: exactness, noise, measured structures.

#[path = "../common/measured_data.rs"]
mod measured_data;

mod exact;
mod made;
mod plane_ema;
