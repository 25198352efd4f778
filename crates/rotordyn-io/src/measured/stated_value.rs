//! A number with its unit as text: "12000", "12 kHz", "0,5 ms".

use super::unit_label::{self, SiUnit};

/// Longest text of a number and a unit \[bytes\].
const MAX_TEXT: usize = 64;
/// Labels of rates that are no units.
const SAMPLES_PER_SECOND: [&str; 6] =
    ["s/s", "sa/s", "samples/s", "samples/sec", "sps", "samples per second"];

/// A number with a decimal point or comma, and its unit if it has one; `None` if it is something else.
pub(crate) fn stated_value(value: &str) -> Option<(f64, Option<SiUnit>)> {
    let value = value.trim();
    if value.len() > MAX_TEXT {
        return None;
    }
    let end = value.find(|c: char| !(c.is_ascii_digit() || "+-.,eE".contains(c))).unwrap_or(value.len());
    let (number, unit) = number(&value[..end]).map(|n| (n, &value[end..])).or_else(|| {
        // "5e" of "5 e..." or a comma that separates: the number ends before.
        let end = value.find([',', ' ', ';', '\t'])?;
        Some((number(&value[..end])?, &value[end..]))
    })?;
    let unit = unit.trim_matches([' ', '\t', ';', ',', '"', '[', ']', '(', ')']);
    let si = match unit {
        "" => None,
        unit if SAMPLES_PER_SECOND.iter().any(|label| unit.eq_ignore_ascii_case(label)) => {
            unit_label::si("Hz")
        }
        unit => Some(unit_label::si(unit)?),
    };
    Some((number, si))
}

fn number(text: &str) -> Option<f64> {
    let text = text.trim_end_matches(',');
    let plain = if text.contains('.') { text.to_owned() } else { text.replacen(',', ".", 1) };
    plain.parse().ok().filter(|v: &f64| v.is_finite())
}

#[cfg(test)]
mod tests {
    use super::stated_value;

    #[test]
    fn numbers_with_units() {
        let found =
            |text: &str| stated_value(text).map(|(n, si)| si.map_or(n, |si| n * si.numerator / si.divisor));
        for text in ["12000", " 12 kHz", "12000 Hz", "1.2e4", "12,0 kHz", "12000.0 S/s", "12 [kHz]"] {
            assert_eq!(found(text), Some(12_000.0), "{text}");
        }
        for wrong in ["", "fast", "kHz", "12 kHzz", "1e999", "nan", "12 kHz and more", "-"] {
            assert_eq!(found(wrong), None, "{wrong}");
        }
    }
}
