//! The decimal sign of a table, and what the lines before it state by that sign.

use super::settings::Setting;
use super::style::TableStyle;
use crate::measured::axis_names::{Meaning, Role, StatedRate, is_same_rate, six_digits};
use crate::measured::content_problem::ContentProblem;

impl TableStyle {
    /// The style of the first line, with the decimal sign by all lines and by the last line of names before them.
    ///
    /// # Errors
    /// Commas are both decimal signs and separators.
    pub fn with_decimal_sign<'a>(
        self,
        lines: impl Iterator<Item = &'a str> + Clone,
        head: Option<&str>,
    ) -> Result<TableStyle, ContentProblem> {
        if self.separator == ',' && self.stamps == 0 {
            return self.of_commas(lines, head);
        }
        if self.separator == ',' || self.decimal_comma {
            return Ok(self);
        }
        // The first line may be "0;0;0": the first sign decides.
        let comma = TableStyle { decimal_comma: true, ..self };
        let mut signs = lines.filter_map(|line| {
            if !line.contains(['.', ',']) {
                return None;
            }
            let cells = self.split(line);
            let cells = cells.get(self.stamps..)?;
            let point = cells.iter().any(|cell| cell.contains('.'));
            let is_comma = || cells.iter().all(|cell| comma.value(cell).is_some());
            cells.iter().any(|cell| cell.contains(['.', ','])).then(|| !point && is_comma())
        });
        Ok(TableStyle { decimal_comma: signs.next().unwrap_or(false), ..self })
    }

    /// Commas may be decimal signs: "0,137" in one column looks like two.
    fn of_commas<'a>(
        self,
        lines: impl Iterator<Item = &'a str> + Clone,
        head: Option<&str>,
    ) -> Result<TableStyle, ContentProblem> {
        // Numbers with a decimal comma in one column look like two columns: the header line decides.
        if let Some(separator) =
            head.and_then(|head| [';', '\t'].into_iter().find(|mark| head.contains(*mark)))
        {
            return Ok(TableStyle { separator, decimal_comma: true, ..self });
        }
        let names = head.map_or(0, |head| self.split(head).iter().filter(|name| !name.is_empty()).count());
        let width = lines.clone().next().map_or(0, |line| self.split(line).len());
        let Some(Halves { marked, steps_by_one, count }) = Halves::of(lines, width, self) else {
            return Ok(self);
        };
        match (names, width) {
            // Not a counter before numbers with leading zeros.
            (0, 2) if marked && !steps_by_one => {}
            // Of many numbers with a decimal comma one has a zero behind it.
            (1, 2) if marked || count < MANY_LINES && !steps_by_one => {}
            (2.., _) if marked && width == 2 * names => {
                return Err(ContentProblem::new(
                    format!(
                        "its lines have {width} cells between commas for {names} names: commas are decimal signs and \
                         separators at once"
                    ),
                    "write it with semicolons or tabs between the columns",
                ));
            }
            _ => return Ok(self),
        }
        // One column: the separator is none that occurs.
        Ok(TableStyle { separator: ';', decimal_comma: true, ..self })
    }
}

/// Lines from which on decimal commas are seen by the digits behind them.
const MANY_LINES: usize = 50;

/// Lines whose cells may be the halves of numbers with a decimal comma.
struct Halves {
    /// Whether some cannot be pairs of whole numbers: "-0,5", "0,05", and "1" among them.
    marked: bool,
    /// Whether the first cell counts the lines.
    steps_by_one: bool,
    count: usize,
}

impl Halves {
    /// `None` if a line has a cell that is no half of a number.
    fn of<'a>(lines: impl Iterator<Item = &'a str>, width: usize, style: TableStyle) -> Option<Self> {
        let mut found = Self { marked: false, steps_by_one: true, count: 0 };
        let mut last: Option<i64> = None;
        let is_digits = |text: &str| !text.is_empty() && text.bytes().all(|b| b.is_ascii_digit());
        for line in lines {
            let cells = style.split(line);
            let lone = width == 2 && cells.len() == 1;
            if cells.len() != width && !lone {
                return None;
            }
            for pair in cells.chunks(2) {
                let whole = pair[0].trim_start_matches(['+', '-']);
                let behind = pair.get(1).copied().unwrap_or("0");
                let (fraction, exponent) = behind.split_at(behind.find(['e', 'E']).unwrap_or(behind.len()));
                let power = exponent.trim_start_matches(['e', 'E']).trim_start_matches(['+', '-']);
                if !is_digits(whole) || !is_digits(fraction) || !(exponent.is_empty() || is_digits(power)) {
                    return None;
                }
                let zeros = fraction.len() > 1 && fraction.starts_with('0');
                found.marked |= zeros || !exponent.is_empty() || pair.len() == 1;
                found.marked |= pair[0].starts_with("-0") && whole.len() == 1;
            }
            let first = cells.first().and_then(|cell| cell.parse::<i64>().ok());
            found.steps_by_one &= last.is_none() || first == last.and_then(|last| last.checked_add(1));
            last = first;
            found.count += 1;
        }
        Some(found)
    }
}

/// What the lines before a table state, as numbers.
///
/// `sign`: the decimal sign of the table, if it has one. `step` \[s\]: that of a time column, which wins.
///
/// # Errors
/// A rate or a step may be read in two ways, and none is given.
pub(super) fn numbers(
    settings: Vec<Setting>,
    sign: Option<char>,
    step: Option<f64>,
    given_rate: Option<f64>,
    notes: &mut Vec<String>,
) -> Result<Vec<(Meaning, String, f64)>, ContentProblem> {
    let mut found = Vec::new();
    for Setting { meaning, name, value } in settings {
        let fits = |reading: &f64| {
            let stated = StatedRate::of(&meaning, &name, *reading);
            stated.zip(step).is_some_and(|(stated, step)| is_same_rate(stated.rate, 1.0 / step))
        };
        // No table writes groups of thousands of kHz or of steps with points.
        let is_plain = meaning.role == Role::Step || meaning.numerator > meaning.divisor;
        let number =
            value.definite().or_else(|| value.readings().find(fits)).or_else(|| match meaning.role {
                Role::Rate | Role::Step if is_plain && value.has_point() => {
                    value.readings().min_by(f64::total_cmp)
                }
                _ if sign.is_some() => value.with(sign?),
                Role::Count => value.readings().max_by(f64::total_cmp),
                Role::Rate | Role::Step => None,
                _ => value.readings().min_by(f64::total_cmp),
            });
        if let Some(number) = number {
            found.push((meaning, name, number));
            continue;
        }
        let rates: Vec<f64> = value
            .readings()
            .filter_map(|reading| StatedRate::of(&meaning, &name, reading))
            .map(|stated| stated.rate)
            .collect();
        let texts: Vec<String> = rates.iter().map(|rate| format!("{} Hz", six_digits(*rate))).collect();
        let problem = format!(
            "the sampling rate that `{name}` states may be {}: the table has no number with a decimal sign",
            texts.join(" or ")
        );
        match given_rate {
            Some(rate) => notes.push(format!("{problem}: {} Hz is used, as given", six_digits(rate))),
            None => {
                let largest = rates.iter().copied().fold(0.0, f64::max);
                let advice = format!("give the rate, such as --rate \"{} Hz\"", six_digits(largest));
                return Err(ContentProblem::new(problem, advice));
            }
        }
    }
    Ok(found)
}
