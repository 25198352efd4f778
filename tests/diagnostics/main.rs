//! Each kind of bad input, and the message it gets.

#[macro_use]
mod sample;

mod bad_input;
mod bearings;
mod defects;
mod mutations;

#[path = "../../src/cli/diagnostics.rs"]
mod render;
