//! Diagnoses of generated records: how often a part is found, how often one is named wrongly, how sure the grade is.

mod baseline;
mod basic;
mod bearing_6309;
mod belts;
mod calibration;
mod clock;
mod faults;
mod fit;
mod generator;
mod hum;
mod motors;
mod others;
mod path;
mod random;
mod speed;
mod statements;
mod table;

/// Sampling rate \[Hz\], duration \[s\] and number of samples of every record.
pub const RATE: f64 = 12_000.0;
pub const SECONDS: f64 = 5.0;
pub const SAMPLES: usize = 60_000;
