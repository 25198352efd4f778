//! A number with its unit as text: "12000", "12 kHz", "0,5 ms", "51,200 Hz".

use super::axis_units;
use super::unit_label::SiUnit;

/// Longest text of a number and a unit \[bytes\].
const MAX_TEXT: usize = 64;
/// Marks between groups of three digits that are no decimal sign.
const GROUP_MARKS: [char; 5] = [' ', '\'', '\u{2019}', '\u{a0}', '\u{202f}'];

/// A number as written: "12,800" is 12800 where the decimal sign is a point, and 12.8 where it is a comma.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Written {
    with_point: Option<f64>,
    with_comma: Option<f64>,
}

impl Written {
    /// `None` if the text is no number with either decimal sign.
    fn of(text: &str) -> Option<Self> {
        let text = text.trim_end_matches(',');
        let found = Self { with_point: reading(text, '.'), with_comma: reading(text, ',') };
        found.readings().next().map(|_| found)
    }

    /// Its readings, that with a decimal point first.
    pub fn readings(self) -> impl Iterator<Item = f64> {
        let comma = self.with_comma.filter(|value| self.with_point != Some(*value));
        self.with_point.into_iter().chain(comma)
    }

    /// The only reading; `None` where the decimal sign decides.
    pub fn definite(self) -> Option<f64> {
        let mut readings = self.readings();
        readings.next().filter(|_| readings.next().is_none())
    }

    /// The reading with a decimal sign, else the only one.
    pub fn with(self, sign: char) -> Option<f64> {
        self.definite().or(if sign == ',' { self.with_comma } else { self.with_point })
    }

    /// Whether the sign that may be the decimal sign is a point, "12.800".
    pub fn has_point(self) -> bool {
        self.with_point < self.with_comma
    }
}

/// A number with a decimal point or comma, and its unit if it has one; `None` if it is something else.
pub(crate) fn stated_value(value: &str) -> Option<(Written, Option<SiUnit>)> {
    let value = value.trim();
    if value.len() > MAX_TEXT {
        return None;
    }
    let plain = |c: char| c.is_ascii_digit() || "+-.,eE".contains(c);
    let end = |keep: &dyn Fn(char) -> bool| value.find(|c: char| !keep(c)).unwrap_or(value.len());
    let ends = [
        // Groups of digits: "51 200 Hz", where the mark may stand before the unit as well.
        value[..end(&|c| plain(c) || GROUP_MARKS.contains(&c))].trim_end_matches(GROUP_MARKS).len(),
        end(&plain),
        // "5e" of "5 e..." or a comma that separates: the number ends before.
        value.find([',', ' ', ';', '\t']).unwrap_or(0),
    ];
    let (number, unit) =
        ends.into_iter().find_map(|end| Some((Written::of(&value[..end])?, &value[end..])))?;
    let unit = unit.trim_matches([' ', '\t', ';', ',', '"', '[', ']', '(', ')', '\u{a0}', '\u{202f}']);
    let si = match unit {
        "" => None,
        unit => Some(axis_units::si(unit)?),
    };
    Some((number, si))
}

/// A number with a decimal sign; other marks may stand between groups of three digits.
fn reading(text: &str, decimal: char) -> Option<f64> {
    without_groups(text, decimal)?.parse().ok().filter(|v: &f64| v.is_finite())
}

/// The text of a number with a decimal point and without the marks between its groups of three digits.
pub(crate) fn without_groups(text: &str, decimal: char) -> Option<String> {
    let (mantissa, exponent) = text.split_at(text.find(['e', 'E']).unwrap_or(text.len()));
    let (whole, fraction) = mantissa.split_once(decimal).unwrap_or((mantissa, ""));
    let is_digits = |text: &str| text.bytes().all(|b| b.is_ascii_digit());
    let digits = whole.trim_start_matches(['+', '-']);
    let other = if decimal == '.' { ',' } else { '.' };
    let is_mark = |c: char| c == other || GROUP_MARKS.contains(&c);
    let mark = digits.find(is_mark).and_then(|at| digits[at..].chars().next());
    let groups: Vec<&str> = mark.map_or_else(|| vec![digits], |mark| digits.split(mark).collect());
    if groups.len() > 1 {
        let (lead, others) = (groups[0], &groups[1..]);
        let fits = (1..=3).contains(&lead.len())
            && !lead.starts_with('0')
            && others.iter().all(|group| group.len() == 3)
            && exponent.is_empty();
        if !fits {
            return None;
        }
    }
    if !is_digits(fraction) || !groups.iter().all(|group| is_digits(group)) {
        return None;
    }
    let sign = &whole[..whole.len() - digits.len()];
    let has_digits = !digits.is_empty() || !fraction.is_empty();
    let mark = if fraction.is_empty() { "" } else { "." };
    has_digits.then(|| format!("{sign}{}{mark}{fraction}{exponent}", groups.concat()))
}

#[cfg(test)]
mod tests {
    use super::stated_value;

    fn readings(text: &str) -> Option<Vec<f64>> {
        let (written, si) = stated_value(text)?;
        let in_si = |n: f64| si.as_ref().map_or(n, |si| n * si.numerator / si.divisor);
        Some(written.readings().map(in_si).collect())
    }

    #[test]
    fn numbers_with_units() {
        for text in ["12000", " 12 kHz", "12000 Hz", "1.2e4", "12,0 kHz", "12000.0 S/s", "12 [kHz]", "12000,"]
        {
            assert_eq!(readings(text), Some(vec![12_000.0]), "{text}");
        }
        for wrong in ["", "fast", "kHz", "12 kHzz", "1e999", "nan", "12 kHz and more", "-", ".", "12 00 Hz"] {
            assert_eq!(readings(wrong), None, "{wrong}");
        }
    }

    /// A mark before exactly three digits may separate thousands; others are definite.
    #[test]
    fn groups_of_three_digits() {
        for text in ["51,200 Hz", "51.200", "51.200 Hz"] {
            assert_eq!(
                readings(text),
                Some(if text.contains(',') { vec![51_200.0, 51.2] } else { vec![51.2, 51_200.0] })
            );
        }
        for text in
            ["51 200 Hz", "51'200", "51\u{a0}200 Hz", "51.200,0", "51,200.0", "51.200,00 Hz", "051200"]
        {
            assert_eq!(readings(text), Some(vec![51_200.0]), "{text}");
        }
        for (text, value) in
            [("0,001 s", 0.001), ("1,2345", 1.2345), ("1234,567", 1234.567), ("1,234e0", 1.234)]
        {
            assert_eq!(readings(text), Some(vec![value]), "{text}");
        }
        assert_eq!(readings("1,048,576"), Some(vec![1_048_576.0]));
        assert_eq!(readings("1.048.576 Hz"), Some(vec![1_048_576.0]));
    }
}
