//! Files of measured records as users have them: rates, units, columns and axes that are easily misread.

mod arrays;
#[cfg(feature = "hdf5")]
mod axis_units;
mod dialects;
mod polar_frfs;
mod tables;

use rotordyn_io::budget::Limits;
use rotordyn_io::measured;
use rotordyn_signal::record::{MeasuredData, Values};

/// Reads a file of some contents.
fn read(name: &str, bytes: &[u8], rate: Option<f64>) -> Result<MeasuredData, String> {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join(name);
    std::fs::write(&path, bytes).unwrap();
    measured::read_at_rate(&path, &Limits::default(), rate).map_err(|error| error.to_string())
}

/// Names of the records.
fn names(found: &MeasuredData) -> Vec<&str> {
    found.records.iter().map(|record| record.name.as_str()).collect()
}

fn values<'a>(found: &'a MeasuredData, name: &str) -> &'a [f64] {
    match &found.record(name).unwrap().values {
        Values::Real(values) => values,
        Values::Complex(_) => panic!("{name} is complex"),
    }
}

fn rate(found: &MeasuredData, name: &str) -> f64 {
    found.record(name).unwrap().sample_rate().unwrap()
}

/// A vibration of about 1.
fn vibration(k: usize) -> f64 {
    (0.7 * k as f64).sin() + 0.6 * (1.9 * k as f64 + 0.3).cos()
}
