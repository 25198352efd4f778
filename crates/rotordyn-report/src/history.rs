//! Time histories reduced to what a screen shows: smallest and largest value of every interval.

use super::arrays::Arrays;
use super::items;
use rotordyn_io::error::Error;
use rotordyn_io::hdf5::{Attribute, Reader, recorded_samples};
use serde_json::{Value, json};

/// Intervals of a history: about one per pixel of a large screen.
const INTERVALS: usize = 2000;
/// Samples read at once.
const BLOCK: usize = 1 << 18;
/// Revolutions per minute of 1 rad/s.
const TO_RPM: f64 = 60.0 / std::f64::consts::TAU;

/// The channels of a run-up over time; `None` without one.
pub(crate) fn read(reader: &dyn Reader, arrays: &mut Arrays) -> Result<Option<Value>, Error> {
    if !reader.contains("/time/t")? || !reader.contains("/channels")? {
        return Ok(None);
    }
    let samples = recorded_samples(reader, "")?;
    if samples == 0 {
        return Ok(None);
    }
    let per_interval = samples.div_ceil(INTERVALS);
    let mean = |path: &str, factor: f64| -> Result<Vec<f64>, Error> {
        let mut out = Vec::new();
        in_intervals(reader, path, samples, per_interval, |part| {
            out.push(factor * part.iter().sum::<f64>() / part.len() as f64);
        })?;
        Ok(out)
    };
    let (time, rpm) = (mean("/time/t", 1.0)?, mean("/time/speed", TO_RPM)?);
    let mut channels = Vec::new();
    for name in items::sets(reader, "/channels")? {
        let path = format!("/channels/{name}");
        let unit = match reader.attribute(&path, "unit")? {
            Some(Attribute::Text(unit)) => unit,
            _ => String::new(),
        };
        let (mut low, mut high) = (Vec::new(), Vec::new());
        in_intervals(reader, &path, samples, per_interval, |part| {
            low.push(part.iter().copied().fold(f64::INFINITY, f64::min));
            high.push(part.iter().copied().fold(f64::NEG_INFINITY, f64::max));
        })?;
        channels
            .push(json!({ "name": name, "unit": unit, "low": arrays.add(&low), "high": arrays.add(&high) }));
    }
    let (time, rpm) = (arrays.add(&time), arrays.add(&rpm));
    Ok(Some(json!({ "samples": samples, "time": time, "rpm": rpm, "channels": channels })))
}

/// Calls `visit` with every interval of a data set in turn.
fn in_intervals(
    reader: &dyn Reader,
    path: &str,
    samples: usize,
    per_interval: usize,
    mut visit: impl FnMut(&[f64]),
) -> Result<(), Error> {
    // Whole intervals in every block.
    let block = per_interval * BLOCK.div_ceil(per_interval);
    let mut from = 0;
    while from < samples {
        let to = (from + block).min(samples);
        reader.read_range(path, from..to)?.chunks(per_interval).for_each(&mut visit);
        from = to;
    }
    Ok(())
}
