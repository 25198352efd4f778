//! Rates that lines before the numbers of a table state: `Sampling rate: 12 kHz`, `dt;0,001`, `# fs = 12000 Hz`.

use super::columns::column;
use crate::measured::axis_names::{Meaning, Role, meaning};
use crate::measured::unit_label;

/// Longest line that states something \[bytes\].
const MAX_LINE: usize = 200;
/// Labels of rates that are no units.
const SAMPLES_PER_SECOND: [&str; 6] =
    ["s/s", "sa/s", "samples/s", "samples/sec", "sps", "samples per second"];

/// What a line states, with its name and number; `None` if nothing that is understood.
pub(super) fn stated(line: &str) -> Option<(Meaning, String, f64)> {
    if line.len() > MAX_LINE {
        return None;
    }
    let line = line.trim_start_matches(['#', '%', '/', ' ', '\t', '"']);
    let at = line.find([':', '=', ';', '\t']).or_else(|| line.find(','))?;
    let (key, value) = (&line[..at], line[at + 1..].trim_matches([' ', '\t', ';', '"', '=', ':']));
    let key = column(key.trim().trim_matches('"'));
    let mut meaning = meaning(&key.name, &[Role::Rate, Role::Step, Role::Start, Role::Count])?;
    let end = value.find(|c: char| !(c.is_ascii_digit() || "+-.,eE".contains(c))).unwrap_or(value.len());
    let (number, unit) = number(&value[..end]).map(|n| (n, &value[end..])).or_else(|| {
        // "5e" of "5 e..." or a comma that separates: the number ends before.
        let end = value.find([',', ' ', ';', '\t'])?;
        Some((number(&value[..end])?, &value[end..]))
    })?;
    let unit = unit.trim_matches([' ', '\t', ';', ',', '"', '[', ']', '(', ')']);
    let si = match unit {
        "" => key.si,
        unit if SAMPLES_PER_SECOND.iter().any(|label| unit.eq_ignore_ascii_case(label)) => {
            unit_label::si("Hz")
        }
        unit => Some(unit_label::si(unit)?),
    };
    if let Some(si) = si {
        if !meaning.role.takes_unit(&si.name) {
            return None;
        }
        (meaning.numerator, meaning.divisor) = (si.numerator, si.divisor);
    }
    Some((meaning, key.name, number))
}

/// A number with a decimal point or comma.
fn number(text: &str) -> Option<f64> {
    let text = text.trim_end_matches(',');
    let plain = if text.contains('.') { text.to_owned() } else { text.replacen(',', ".", 1) };
    plain.parse().ok().filter(|v: &f64| v.is_finite())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measured::axis_names::StatedRate;

    #[test]
    fn lines_that_state_a_rate() {
        let rate = |line: &str| {
            let (meaning, name, value) = stated(line)?;
            StatedRate::of(&meaning, &name, value).map(|stated| stated.rate)
        };
        for line in [
            "Sampling rate: 12 kHz",
            "# fs = 12000 Hz",
            "Sample Frequency;12000;Hz",
            "fs,12000",
            "\"SampleFrequency\"\t12000",
            "Sampling Rate [kHz]: 12,0",
            "% Sampling Frequency (Hz): 12000",
            "Abtastrate: 12 kHz",
            "Sample rate = 12000 S/s",
            "fs: 1.2e4",
        ] {
            assert_eq!(rate(line), Some(12_000.0), "{line}");
        }
        for line in ["dt: 0.5 ms", "Time step;0,0005;s", "Delta_X\t5.0E-4", "dt [ms] = 0.5"] {
            let found = rate(line).unwrap_or_else(|| panic!("{line}"));
            assert!((found / 2000.0 - 1.0).abs() < 1e-15, "{line}: {found}");
        }
        for line in ["Rotor: 3", "fs: fast", "fs: 12 mm", "fs", "", "dt: 5 Hz", "Speed rate of change: 5"] {
            assert_eq!(rate(line), None, "{line}");
        }
    }
}
