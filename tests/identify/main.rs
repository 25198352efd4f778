//! Modes from FRFs: exactness, noise, measured structures.

#[path = "../common/measured_data.rs"]
mod measured_data;

mod exact;
mod made;
mod noise;
mod plane_ema;
#[path = "../common/rig.rs"]
mod rig;
#[path = "rig.rs"]
mod rig_truth;
