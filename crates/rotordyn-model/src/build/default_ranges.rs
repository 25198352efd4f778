//! Speeds and frequencies of studies that state none: those of their commands.

use crate::Model;
use crate::file::key::{Key, Quantity, Spaced};
use crate::file::reader::Reader;
use rotordyn_units::parse;
use std::f64::consts::TAU;

/// Highest speed of a file without speeds, and of studies that go beyond the highest of the machine \[rpm\].
const TOP_RPM: f64 = 3000.0;
const HIGHER_RPM: f64 = 6000.0;
/// Speeds of a Campbell diagram, and of a response to unbalance.
const CAMPBELL_SPEEDS: usize = 25;
const UNBALANCE_SPEEDS: usize = 200;

/// Values spaced evenly, as they would be written in a file.
pub(super) struct DefaultRange {
    from: String,
    to: String,
    count: usize,
}

/// From standstill to the highest speed of [speed].
pub(super) fn campbell(model: &Model) -> DefaultRange {
    DefaultRange { from: "0 rpm".into(), to: times_top(model, 1.0, TOP_RPM), count: CAMPBELL_SPEEDS }
}

/// Up to 1.5 times the highest speed of [speed].
pub(super) fn unbalance(model: &Model) -> DefaultRange {
    DefaultRange { from: "1 rpm".into(), to: times_top(model, 1.5, HIGHER_RPM), count: UNBALANCE_SPEEDS }
}

/// 1 to 500 Hz in steps of 0.25 Hz.
pub(super) fn frequencies() -> DefaultRange {
    DefaultRange { from: "1 Hz".into(), to: "500 Hz".into(), count: 1997 }
}

/// The values of a key, or of a range without it.
pub(super) fn spaced_or(r: &Reader, key: &Key<Spaced>, range: &DefaultRange) -> Vec<f64> {
    if r.has(key) {
        return r.spaced(key).unwrap_or_else(|| vec![0.0]);
    }
    let DefaultRange { from, to, count } = range;
    r.taken_by_default(key, format!("{{ from = \"{from}\", to = \"{to}\", count = {count} }}"));
    let end = |text: &str| parse(text, key.value.0.dimension).expect("the units are those of the key");
    let ([from, to], last) = ([from, to].map(|text| end(text)), count - 1);
    let value = |k: usize| if k == last { to } else { from + (to - from) * (k as f64 / last as f64) };
    (0..*count).map(value).collect()
}

/// The highest speed of a key \[rad/s\], or `factor` times that of [speed], else 6000 rpm.
pub(super) fn max_speed_or(r: &Reader, key: &Key<Quantity>, model: &Model, factor: f64) -> f64 {
    if r.has(key) {
        return r.value(key);
    }
    let text = times_top(model, factor, HIGHER_RPM);
    r.taken_by_default(key, format!("\"{text}\""));
    parse(&text, key.value.dimension).expect("a speed in rpm")
}

/// A multiple of the highest speed of [speed], else another \[rpm\].
fn times_top(model: &Model, factor: f64, other: f64) -> String {
    let top = (model.profile.top_speed() * 60.0 / TAU * 1e6).round() / 1e6;
    format!("{} rpm", if top > 0.0 { factor * top } else { other })
}
