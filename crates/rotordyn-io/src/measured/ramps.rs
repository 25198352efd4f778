//! Channels that increase by equal steps over the whole record: times or counters, no vibrations.

use super::array::{Array, Data};
use super::axis_names::{is_same_rate, six_digits};
use rotordyn_signal::record::{Axis, AxisQuantity, Kind, MeasuredData, Points, Record, Values};

/// Fewest values of a ramp.
const MIN_VALUES: usize = 8;

/// Whether a channel increases by equal steps over the whole record.
pub fn is_ramp(record: &Record) -> bool {
    ramp(record).is_some()
}

/// First value and step of a time record that is a ramp.
fn ramp(record: &Record) -> Option<(f64, f64)> {
    let Values::Real(values) = &record.values else { return None };
    // Most channels end here.
    if values.len() < MIN_VALUES || values.windows(2).take(100).any(|pair| pair[0] >= pair[1]) {
        return None;
    }
    let over_time = matches!(record.axis.quantity, AxisQuantity::Time | AxisQuantity::Unknown);
    if record.kind != Kind::Time || !over_time {
        return None;
    }
    match Axis::from_points(AxisQuantity::Time, values.clone()).points {
        Points::Uniform { start, step } => Some((start, step)),
        _ => None,
    }
}

/// Whether a list counts its values from 0 or 1.
pub(crate) fn is_counter(start: f64, step: f64) -> bool {
    step == 1.0 && (start == 0.0 || start == 1.0)
}

/// Takes channels whose step is that of the sampling as time, and names others that look like an axis.
///
/// `given_rate` \[Hz\]: for channels without a rate.
pub(super) fn take_times(out: &mut MeasuredData, given_rate: Option<f64>) {
    let ramps: Vec<Option<(f64, f64)>> = out.records.iter().map(ramp).collect();
    let mut times = Vec::new();
    for (k, found) in ramps.iter().enumerate() {
        let (record, Some((start, step))) = (&out.records[k], *found) else { continue };
        let is_channel = |other: usize| {
            let other_record = &out.records[other];
            ramps[other].is_none()
                && other_record.kind == Kind::Time
                && other_record.values.len() == record.values.len()
        };
        if !matches!(record.unit.as_str(), "" | "s") || !(0..ramps.len()).any(is_channel) {
            continue;
        }
        let rate = match record.axis.points {
            Points::Uniform { step, .. } => Some(1.0 / step),
            _ => given_rate,
        };
        let Some(rate) = rate else { continue };
        // Where a list states the times, another that starts elsewhere is a channel that rises so.
        let source = out.axis_sources.iter().find(|(name, _)| *name == record.name);
        let by_rate = source.is_none_or(|(_, source)| source.ends_with(')') || source == "the rate given");
        let starts_there = by_rate || (start - record.axis.start()).abs() < 0.5 * step;
        if is_same_rate(rate, 1.0 / step) && starts_there {
            times.push((k, start));
        } else if !is_counter(start, step) && record.name.ends_with(']') {
            // A column of a matrix has no name that says what it is.
            out.notes.push(format!(
                "`{}` increases by equal steps of {} like a time: in s it would be sampled at {} Hz, {} Hz is used",
                record.name,
                six_digits(step),
                six_digits(1.0 / step),
                six_digits(rate)
            ));
        }
    }
    for (k, start) in times.iter().rev() {
        let taken = out.records.remove(*k);
        out.axis_sources.retain(|(name, _)| *name != taken.name);
        out.notes
            .push(format!("`{}` increases by the step of the sampling: it is taken as the time", taken.name));
        for record in &mut out.records {
            let same = record.axis == taken.axis && record.values.len() == taken.values.len();
            if let (true, Points::Uniform { start: zero @ 0.0, .. }) = (same, &mut record.axis.points) {
                *zero = *start;
            }
        }
    }
}

/// Whether real values over a list of frequencies or over time are those of a time record.
///
/// Amplitudes and densities are not negative; lists of other parts of spectra are named so.
pub(super) fn is_time_record(array: &Array) -> bool {
    const PARTS: [&str; 15] = [
        "phase", "spec", "psd", "pxx", "gxx", "sxx", "fft", "frf", "real", "imag", "_re", "_im", "db", "mag",
        "angle",
    ];
    let Data::Real(values) = &array.data else { return false };
    let name = array.name.to_lowercase();
    let both_signs = values.iter().any(|v| *v < 0.0) && values.iter().any(|v| *v > 0.0);
    both_signs && !PARTS.iter().any(|part| name.contains(part))
}
