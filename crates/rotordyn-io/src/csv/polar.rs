//! FRFs in a table as magnitude, or level in dB, and phase.

use std::collections::HashMap;

use super::columns::Column;
use crate::measured::unit_label::{self, SiUnit};
use rotordyn_signal::Complex;

const MAGNITUDE: [&str; 7] = ["magnitude", "mag", "amplitude", "amp", "abs", "modulus", "betrag"];
const PHASE: [&str; 6] = ["phase", "ph", "arg", "angle", "phi", "phasenwinkel"];

/// Units of amplitudes of one quantity: such columns are a spectrum, not an FRF.
const OF_SPECTRA: [&str; 14] =
    ["m", "m/s", "m/s^2", "N", "N m", "V", "Pa", "rad", "rad/s", "rad/s^2", "K", "W", "rpm", "kg"];

/// Marks between the words of a name.
const MARKS: [char; 10] = [' ', '_', '-', '.', ':', '(', ')', '[', ']', '|'];

/// Longest name that is searched for a word of the part \[bytes\].
const MAX_NAME: usize = 200;

/// The name without a word at its begin or end, in lower case: "h1" of `H1_mag`, `Mag(H1)`, `H1 magnitude`.
fn base(name: &str, words: &[&str]) -> Option<String> {
    if name.len() > MAX_NAME {
        return None;
    }
    let lower = name.to_lowercase();
    let parts: Vec<&str> = lower.split(MARKS).filter(|part| !part.is_empty()).collect();
    let is_word = |part: &&str| words.contains(part);
    match &parts[..] {
        [others @ .., last] if is_word(last) => Some(others.join(" ")),
        [first, others @ ..] if is_word(first) => Some(others.join(" ")),
        _ => None,
    }
}

/// Reference of a level: `dB re 1 m/s^2/N`, `dB (re 1e-6 m/N)`; `Some(None)` without one, `None` if it is no level.
fn reference(stated: &str) -> Option<Option<(f64, SiUnit)>> {
    let rest = stated.trim().strip_prefix("dB").or_else(|| stated.trim().strip_prefix("db"))?;
    let rest = rest.trim_matches([' ', '(', ',', ':']);
    let behind =
        ["re.", "re:", "ref.", "ref", "rel.", "rel", "re"].iter().find_map(|word| rest.strip_prefix(word));
    let Some(behind) = behind.map(str::trim) else { return Some(None) };
    let end = behind.find(|c: char| !(c.is_ascii_digit() || ".eE+-".contains(c))).unwrap_or(behind.len());
    let (number, unit) = behind.split_at(end);
    let number: f64 = if number.is_empty() { 1.0 } else { number.parse().ok()? };
    // A bracket around all of it is closed at the end.
    let unit = unit.trim();
    let closed = |unit: &str| unit.strip_suffix(')').and_then(|unit| unit_label::si(unit.trim()));
    let si = unit_label::si(unit).or_else(|| closed(unit));
    Some(si.filter(|_| number > 0.0 && number.is_finite()).map(|si| (number, si)))
}

/// What a column of magnitudes is.
enum Scale {
    Linear,
    /// Level in dB over a reference.
    Level(f64, SiUnit),
}

/// Makes one complex column of every magnitude and its phase; returns notes on pairs that cannot be joined.
pub(super) fn join(columns: &mut Vec<Column>) -> Vec<String> {
    let mut notes = Vec::new();
    let mut phases: HashMap<String, Vec<usize>> = HashMap::new();
    let mut magnitudes: HashMap<String, Vec<usize>> = HashMap::new();
    for (k, column) in columns.iter().enumerate().filter(|(_, column)| column.im.is_empty()) {
        if let Some(of) = base(&column.name, &PHASE) {
            phases.entry(of).or_default().push(k);
        } else {
            let of = base(&column.name, &MAGNITUDE).unwrap_or_else(|| plain(&column.name));
            magnitudes.entry(of).or_default().push(k);
        }
    }
    let mut taken = Vec::new();
    let mut all: Vec<(String, Vec<usize>)> = phases.into_iter().collect();
    all.sort_by_key(|(_, places)| places[0]);
    for (of, places) in all {
        let (&[phase], Some(&[magnitude])) = (&places[..], magnitudes.get(&of).map(Vec::as_slice)) else {
            continue;
        };
        let (own, angle) = (&columns[magnitude], &columns[phase]);
        let level = reference(&own.stated);
        let is_spectrum = own.si.as_ref().is_some_and(|si| OF_SPECTRA.contains(&si.name.as_str()));
        let scale = match level {
            Some(Some((number, si))) => Scale::Level(number, si),
            Some(None) => {
                notes.push(format!(
                    "`{}` and `{}` are not read as an FRF: the level has no reference, such as [dB re 1 m/s^2/N]",
                    own.name, angle.name
                ));
                continue;
            }
            None if is_spectrum || (own.si.is_none() && !own.stated.is_empty()) => continue,
            None => Scale::Linear,
        };
        let Some(si) = angle.si.clone().filter(|si| si.name == "rad") else {
            notes.push(format!(
                "`{}` and `{}` are not read as an FRF: the phase has no unit, [deg] or [rad]",
                own.name, angle.name
            ));
            continue;
        };
        let angles: Vec<f64> = angle.re.iter().map(|phase| phase * si.numerator / si.divisor).collect();
        let length = own.length.min(angle.length);
        let own = &mut columns[magnitude];
        let value = |size: f64| match &scale {
            Scale::Linear => size,
            Scale::Level(number, _) => number * 10.0_f64.powf(size / 20.0),
        };
        let values: Vec<Complex<f64>> =
            own.re.iter().zip(angles).map(|(size, phase)| Complex::from_polar(value(*size), phase)).collect();
        own.re = values.iter().map(|value| value.re).collect();
        own.im = values.iter().map(|value| value.im).collect();
        own.length = length;
        if let Scale::Level(_, si) = scale {
            own.si = Some(si);
        }
        own.name = without_word(&own.name);
        taken.push(phase);
    }
    taken.sort_unstable();
    taken.into_iter().rev().for_each(|k| drop(columns.remove(k)));
    notes
}

fn plain(name: &str) -> String {
    let lower = name.to_lowercase();
    lower.split(MARKS).filter(|part| !part.is_empty()).collect::<Vec<_>>().join(" ")
}

/// `H1` of `H1_mag`; the name itself where nothing else is in it.
fn without_word(name: &str) -> String {
    let is_word = |part: &str| MAGNITUDE.contains(&part.to_lowercase().as_str());
    let cut = name.trim_matches(MARKS);
    let last = cut.rsplit(MARKS).next().unwrap_or_default();
    let first = cut.split(MARKS).next().unwrap_or_default();
    let rest = match (is_word(last), is_word(first)) {
        (true, _) => &cut[..cut.len() - last.len()],
        (false, true) => &cut[first.len()..],
        (false, false) => cut,
    };
    let rest = rest.trim_matches(MARKS);
    if rest.is_empty() { name.to_owned() } else { rest.to_owned() }
}
