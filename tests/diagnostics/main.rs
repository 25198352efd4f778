//! Each kind of bad input, and the message it gets.

#[macro_use]
mod sample;

mod bad_input;
mod bearings;
mod defects;
mod measured_speed;
mod mutations;
mod radial_balls;
mod steady;

#[path = "../../src/cli/diagnostics.rs"]
mod render;
