//! Units of axes and sampling rates: "kHz", "kS/s", "rad/s", "cpm", "ms", "s/1000".

use std::f64::consts::TAU;

use super::axis_names::Role;
use super::content_problem::ContentProblem;
use super::unit_label::{self, SiUnit};
use crate::error::snippet;

/// Units of samples or cycles over a time: one each second.
const PER_SECOND: [&str; 14] = [
    "s/s",
    "sa/s",
    "sample/s",
    "samples/s",
    "samples/sec",
    "samples/second",
    "samplespersecond",
    "sps",
    "hz",
    "hertz",
    "cps",
    "1/s",
    "s^-1",
    "1/sec",
];
/// Units of cycles each minute.
const PER_MINUTE: [&str; 9] =
    ["rpm", "cpm", "1/min", "r/min", "rev/min", "u/min", "min^-1", "min-1", "samples/min"];
const PER_RADIAN: [&str; 4] = ["rad/s", "rad/sec", "rads/s", "rad·s^-1"];
/// Words for times: \[s\].
#[rustfmt::skip]
const TIMES: [(&str, f64, f64); 18] = [
    ("sec", 1.0, 1.0), ("second", 1.0, 1.0), ("seconds", 1.0, 1.0), ("sekunden", 1.0, 1.0),
    ("msec", 1.0, 1e3), ("millisecond", 1.0, 1e3), ("milliseconds", 1.0, 1e3), ("usec", 1.0, 1e6),
    ("µsec", 1.0, 1e6), ("microseconds", 1.0, 1e6), ("ns", 1.0, 1e9), ("nsec", 1.0, 1e9), ("nanoseconds", 1.0, 1e9),
    ("minutes", 60.0, 1.0), ("hr", 3600.0, 1.0), ("hours", 3600.0, 1.0), ("days", 86_400.0, 1.0), ("d", 86_400.0, 1.0),
];

/// Longest label \[bytes\].
const MAX_LABEL: usize = 100;

/// The unit of a label of an axis or a sampling rate; `None` if it is not known.
pub(crate) fn si(label: &str) -> Option<SiUnit> {
    let label = label.trim().trim_end_matches('.');
    if label.len() > MAX_LABEL {
        return None;
    }
    let label = label.strip_prefix(['[', '(']).and_then(|l| l.strip_suffix([']', ')'])).unwrap_or(label);
    // "days since 2026-11-23" of netCDF.
    let label = label.split_once(" since ").map_or(label, |(unit, _)| unit).trim();
    let unit =
        |name: &str, numerator: f64, divisor: f64| Some(SiUnit { name: name.into(), numerator, divisor });
    let prefixes = [("", 1.0), ("k", 1e3), ("K", 1e3), ("kilo", 1e3), ("M", 1e6), ("mega", 1e6), ("G", 1e9)];
    for (prefix, factor) in prefixes {
        let Some(rest) = label.strip_prefix(prefix) else { continue };
        let rest: String = rest.replace("⁻¹", "^-1").chars().filter(|c| *c != ' ').collect();
        if PER_SECOND.contains(&rest.to_lowercase().as_str()) {
            return unit("Hz", factor, 1.0);
        }
    }
    let plain: String = label.replace("⁻¹", "^-1").to_lowercase().chars().filter(|c| *c != ' ').collect();
    if PER_MINUTE.contains(&plain.as_str()) {
        return unit("rpm", 1.0, 1.0);
    }
    if PER_RADIAN.contains(&plain.as_str()) {
        return unit("rad/s", 1.0, 1.0);
    }
    let word = if plain == label.to_lowercase() { plain.replace('μ', "µ") } else { String::new() };
    if let Some((_, numerator, divisor)) = TIMES.iter().find(|(name, ..)| *name == word) {
        return unit("s", *numerator, *divisor);
    }
    if let Some(known) = unit_label::si(label) {
        return Some(known);
    }
    // "s/1000"
    let (base, divisor) = label.rsplit_once('/')?;
    let divisor: f64 = divisor.trim().parse().ok()?;
    let known = si(base).filter(|_| !base.contains('/') && divisor > 0.0 && divisor.is_finite())?;
    unit(&known.name, known.numerator, known.divisor * divisor)
}

impl Role {
    /// Factor and divisor by which values in a unit are in Hz or s; `None` if it is the unit of something else.
    pub fn factor(self, si: &SiUnit) -> Option<(f64, f64)> {
        let (up, down) = (si.numerator, si.divisor);
        match (self, si.name.as_str()) {
            (Role::Rate | Role::Frequencies, "Hz") => Some((up, down)),
            (Role::Rate | Role::Frequencies, "rpm") => Some((up, down * 60.0)),
            (Role::Rate | Role::Frequencies, "rad/s") => Some((up, down * TAU)),
            (Role::Step | Role::Start | Role::Times, "s") => Some((up, down)),
            (Role::Count, "1") => Some((up, down)),
            _ => None,
        }
    }

    /// The factor of a label; `None` if it is empty or stands for no unit.
    ///
    /// # Errors
    /// The label is not that of a unit that values of this role have.
    pub fn factor_of_label(self, label: &str, of: &str) -> Result<Option<(f64, f64)>, ContentProblem> {
        let plain = label.trim();
        if plain.is_empty() || matches!(plain.to_lowercase().as_str(), "-" | "none" | "1") {
            return Ok(None);
        }
        let found = si(plain).and_then(|si| self.factor(&si));
        found.map(Some).ok_or_else(|| {
            let (label, of) = (snippet(plain), snippet(of));
            let problem = format!("the unit `{label}` of `{of}` is not understood");
            let advice = match self {
                Role::Frequencies => "state the frequencies in Hz, kHz, MHz, rad/s, rpm or cpm",
                Role::Rate | Role::Step => "give the sampling rate with --rate, such as --rate \"5120 Hz\"",
                _ => "state the times in s, ms, us, ns, min or h",
            };
            ContentProblem::new(problem, advice)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn units_of_rates_and_axes() {
        let factor = |role: Role, label: &str| {
            let (up, down) = role.factor(&si(label)?)?;
            Some(up / down)
        };
        for (label, expected) in [
            ("Hz", 1.0),
            ("kHz", 1e3),
            ("MHz", 1e6),
            ("kS/s", 1e3),
            ("MS/s", 1e6),
            ("S/s", 1.0),
            ("kSa/s", 1e3),
            ("ksps", 1e3),
            ("samples/s", 1.0),
            ("Samples per second", 1.0),
            ("1/s", 1.0),
            ("s⁻¹", 1.0),
            ("kilohertz", 1e3),
            ("rpm", 1.0 / 60.0),
            ("cpm", 1.0 / 60.0),
            ("1/min", 1.0 / 60.0),
            ("rad/s", 1.0 / TAU),
            ("[rad/s]", 1.0 / TAU),
        ] {
            let found = factor(Role::Frequencies, label);
            assert!(found.is_some_and(|f| (f / expected - 1.0).abs() < 1e-14), "{label}: {found:?}");
        }
        for (label, expected) in [
            ("s", 1.0),
            ("ms", 1e-3),
            ("us", 1e-6),
            ("µs", 1e-6),
            ("ns", 1e-9),
            ("min", 60.0),
            ("h", 3600.0),
            ("Seconds", 1.0),
            ("days since 2026-11-23 00:00:00", 86_400.0),
            ("s/1000", 1e-3),
        ] {
            let found = factor(Role::Times, label);
            assert!(found.is_some_and(|f| (f / expected - 1.0).abs() < 1e-14), "{label}: {found:?}");
        }
        for (role, label) in
            [(Role::Times, "Hz"), (Role::Rate, "s"), (Role::Rate, "kX/s"), (Role::Frequencies, "m")]
        {
            assert_eq!(factor(role, label), None, "{label}");
            assert!(role.factor_of_label(label, "f").is_err(), "{label}");
        }
    }
}
