//! Rates that lines before the numbers of a table state: `Sampling rate: 12 kHz`, `dt;0,001`, `# fs = 12000 Hz`.

use super::columns::column;
use crate::measured::axis_names::{Meaning, Role, meaning};
use crate::measured::axis_units;
use crate::measured::stated_value::{Written, stated_value};
use crate::measured::unit_label;

/// Longest line that states something \[bytes\].
const MAX_LINE: usize = 200;

/// What a line states.
pub(super) struct Setting {
    pub meaning: Meaning,
    pub name: String,
    pub value: Written,
    /// A unit in the name that is not known.
    pub unknown_unit: Option<String>,
}

/// What a line states, with its name and number; `None` if nothing that is understood.
pub(super) fn stated(line: &str) -> Option<Setting> {
    if line.len() > MAX_LINE {
        return None;
    }
    let line = line.trim_start_matches(['#', '%', '/', ' ', '\t', '"']);
    let at = line.find([':', '=', ';', '\t']).or_else(|| line.find(','))?;
    let (key, value) = (&line[..at], line[at + 1..].trim_matches([' ', '\t', ';', '"', '=', ':']));
    let key = column(key.trim().trim_matches('"'));
    let mut meaning = meaning(&key.name, &[Role::Rate, Role::Step, Role::Start, Role::Count])?;
    let (value, own) = stated_value(value)?;
    let mut unknown_unit = None;
    match own.or_else(|| axis_units::si(&key.stated)).or(key.si) {
        Some(si) => (meaning.numerator, meaning.divisor) = meaning.role.factor(&si)?,
        // Words are no unit: "Sampling rate (per channel)".
        None if key.stated.is_empty() || is_text(&key.stated) => {}
        None => unknown_unit = Some(key.stated),
    }
    Some(Setting { meaning, name: key.name, value, unknown_unit })
}

/// The unit that a line states for the columns, `# unit: g`.
pub(super) fn unit_of_line(line: &str) -> Option<&str> {
    let line = line.trim_start_matches(['#', '%', '/', ' ', '\t', '"']);
    let (key, value) = line.split_once([':', '='])?;
    let value = value.trim_matches([' ', '\t', ';', ',', '"', '[', ']']);
    let is_unit = ["unit", "units", "einheit"].iter().any(|name| key.trim().eq_ignore_ascii_case(name));
    (is_unit && unit_label::si(value).is_some()).then_some(value)
}

fn is_text(label: &str) -> bool {
    label.contains(' ') && !label.contains('/')
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measured::axis_names::StatedRate;

    #[test]
    fn lines_that_state_a_unit() {
        for line in ["# unit: g", "Unit = g", "% units: [g]", "Einheit: g"] {
            assert_eq!(unit_of_line(line), Some("g"), "{line}");
        }
        for line in ["unit", "unit: 3", "unit: apples", "g", "force unit: N"] {
            assert_eq!(unit_of_line(line), None, "{line}");
        }
    }

    #[test]
    fn lines_that_state_a_rate() {
        let rate = |line: &str| {
            let Setting { meaning, name, value, .. } = stated(line)?;
            let value = value.definite().expect("a number of one reading");
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
            "Sampling rate [kS/s]: 12",
            "Sample rate: 12 kSa/s",
            "Sample rate: 12 ksps",
            "Sampling rate (per channel): 12000",
            "Sampling rate [MHz]: 0.012",
            "Sampling rate [cpm]: 720000",
        ] {
            assert_eq!(rate(line), Some(12_000.0), "{line}");
        }
        for line in
            ["dt: 0.5 ms", "Time step;0,0005;s", "Delta_X\t5.0E-4", "dt [ms] = 0.5", "dt [s/1000]: 0.5"]
        {
            let found = rate(line).unwrap_or_else(|| panic!("{line}"));
            assert!((found / 2000.0 - 1.0).abs() < 1e-15, "{line}: {found}");
        }
        for line in ["Rotor: 3", "fs: fast", "fs: 12 mm", "fs", "", "dt: 5 Hz", "Speed rate of change: 5"] {
            assert_eq!(rate(line), None, "{line}");
        }
    }
}
