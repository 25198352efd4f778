//! Error messages for each kind of invalid input.

#[macro_use]
mod sample;

mod bad_input;
mod bearings;
mod consequences;
mod defects;
mod measured_speed;
mod mutations;
mod radial_balls;
mod steady;

#[path = "../../src/cli/diagnostics.rs"]
mod render;
