//! The decimal sign of a table, and what the lines before it state by that sign.

use std::collections::HashSet;

use super::settings::Setting;
use super::style::TableStyle;
use crate::error::snippet;
use crate::measured::axis_names::{Meaning, Role, StatedRate, is_same_rate, six_digits};
use crate::measured::content_problem::ContentProblem;

impl TableStyle {
    /// The style of the first line, with the decimal sign by all lines, by a line before them that states it, and by the
    /// last line of names.
    ///
    /// # Errors
    /// The table has both decimal signs, leaves open which it has, or commas are both decimal signs and separators.
    pub fn with_decimal_sign<'a>(
        self,
        lines: impl Iterator<Item = &'a str> + Clone,
        head: Option<&str>,
        stated: Option<char>,
    ) -> Result<TableStyle, ContentProblem> {
        let quoted = || self.quotes && lines.clone().any(|line| line.contains('"') && line.contains(','));
        if self.separator == ',' && !quoted() {
            let names = || head.map_or(0, |head| self.split(head).len());
            if self.stamps > 0 {
                return Ok(self);
            }
            if stated.is_some() && names() < 2 && lines.clone().all(|line| self.split(line).len() <= 2) {
                // One column: the separator is none that occurs.
                return TableStyle { separator: ';', ..self }.of_marks(lines, stated);
            }
            let found = self.of_commas(lines.clone(), head)?;
            // One column of decimal commas, or of thousands.
            return match found.decimal_comma && stated.is_none() {
                true => found.of_marks(lines, None),
                false => Ok(found),
            };
        }
        self.of_marks(lines, stated)
    }

    /// The decimal sign by the marks in all numbers.
    fn of_marks<'a>(
        self,
        lines: impl Iterator<Item = &'a str> + Clone,
        stated: Option<char>,
    ) -> Result<TableStyle, ContentProblem> {
        let marks = Marks::of(self, lines.clone());
        let decimal = match (stated, marks.points.definite, marks.commas.definite) {
            (_, Some(point), Some(comma)) => {
                return Err(ContentProblem::new(
                    format!(
                        "its numbers have decimal points (`{}`) and decimal commas (`{}`)",
                        snippet(point),
                        snippet(comma)
                    ),
                    "write all numbers with one decimal sign",
                ));
            }
            (Some('.'), _, Some(other)) | (Some(','), Some(other), _) => {
                return Err(ContentProblem::new(
                    format!("`{}` has another decimal sign than the one that is stated", snippet(other)),
                    "correct the line that states the decimal sign",
                ));
            }
            (Some(sign), _, _) => sign,
            (None, Some(_), None) => '.',
            (None, None, Some(_)) => ',',
            (None, None, None) => match (marks.points.open, marks.commas.open) {
                (None, None) => '.',
                // Points are decimal signs in most tables, but "1.400" and "731" in one column look like thousands.
                (Some(_), None) if !has_whole_numbers(self, lines, '.') => '.',
                (point, comma) => {
                    let open = comma.or(point).unwrap_or_default();
                    let whole: String = open.chars().filter(|c| !matches!(c, '.' | ',')).collect();
                    return Err(ContentProblem::new(
                        format!(
                            "`{open}` may be {whole} or {}: no number of the table shows which is the decimal sign",
                            open.replace(',', ".")
                        ),
                        "state it in a line before the numbers, `# decimal sign: ,` or `# decimal sign: .`",
                    ));
                }
            },
        };
        let grouped = if decimal == ',' { &marks.points } else { &marks.commas };
        let groups = grouped.open.is_some() || marks.both;
        Ok(TableStyle { decimal_comma: decimal == ',', groups, ..self })
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

/// What the marks of one kind are in the numbers of a table.
#[derive(Default)]
struct MarkUse<'a> {
    /// A number in which it is the decimal sign.
    definite: Option<&'a str>,
    /// A number in which it is the decimal sign or stands between thousands: "1,500".
    open: Option<&'a str>,
}

#[derive(Default)]
struct Marks<'a> {
    points: MarkUse<'a>,
    commas: MarkUse<'a>,
    /// Whether a number has both.
    both: bool,
}

impl<'a> Marks<'a> {
    fn of(style: TableStyle, lines: impl Iterator<Item = &'a str>) -> Self {
        let mut found = Self::default();
        for line in lines {
            // Further numbers of the kind that is the decimal sign tell nothing.
            let [comma, point] = [',', '.'].map(|mark| line.contains(mark));
            if !(comma && found.commas.definite.is_none() || point && found.points.definite.is_none()) {
                continue;
            }
            for cell in style.split(line).into_iter().skip(style.stamps) {
                found.add(cell);
            }
        }
        found
    }

    fn add(&mut self, cell: &'a str) {
        let count = |mark: char| cell.matches(mark).count();
        let (points, commas) = (count('.'), count(','));
        if points + commas == 0 || cell.contains('#') {
            return;
        }
        let last = cell.rfind(['.', ',']).unwrap_or(0);
        let of_last = |found: &mut Self, is_comma: bool| {
            let used = if is_comma { &mut found.commas } else { &mut found.points };
            used.definite.get_or_insert(cell);
        };
        let ends_in_comma = cell[last..].starts_with(',');
        match (points, commas) {
            (1.., 1..) => {
                of_last(self, ends_in_comma);
                self.both = true;
            }
            // "1,234,567": the comma is no decimal sign.
            (0, 2..) | (2.., 0) if is_grouped(cell) => {
                of_last(self, !ends_in_comma);
                self.both = true;
            }
            _ if is_grouped(cell) => {
                let used = if ends_in_comma { &mut self.commas } else { &mut self.points };
                used.open.get_or_insert(cell);
            }
            _ => of_last(self, ends_in_comma),
        }
    }
}

/// Whether the marks of a number may stand between groups of three digits.
fn is_grouped(cell: &str) -> bool {
    let digits = cell.trim_start_matches(['+', '-']);
    let mut groups = digits.split(['.', ',']);
    let is_number = |group: &str| !group.is_empty() && group.bytes().all(|b| b.is_ascii_digit());
    groups.next().is_some_and(|lead| is_number(lead) && lead.len() <= 3 && !lead.starts_with('0'))
        && groups.all(|group| is_number(group) && group.len() == 3)
}

/// Whether a column with numbers of the mark has whole numbers other than zero without it.
fn has_whole_numbers<'a>(
    style: TableStyle,
    lines: impl Iterator<Item = &'a str> + Clone,
    mark: char,
) -> bool {
    let cells = |line: &'a str| style.split(line).into_iter().skip(style.stamps).enumerate();
    let marked: HashSet<usize> = lines
        .clone()
        .flat_map(|line| cells(line).filter(|(_, cell)| cell.contains(mark)).map(|(k, _)| k))
        .collect();
    let is_whole = |cell: &str| {
        let digits = cell.trim_start_matches(['+', '-']);
        digits.bytes().all(|b| b.is_ascii_digit()) && digits.bytes().any(|b| b != b'0')
    };
    lines.flat_map(cells).any(|(k, cell)| marked.contains(&k) && is_whole(cell))
}

/// Names of a line that states the decimal sign, without case and separators.
const SIGN_NAMES: [&str; 6] =
    ["decimalsign", "decimalseparator", "decimalmark", "decimal", "dezimalzeichen", "dezimaltrennzeichen"];

/// The decimal sign that a line before the numbers states: `# decimal sign: ,`.
pub(super) fn stated_sign(line: &str) -> Option<char> {
    let line = line.trim_matches(['#', '%', '/', ' ', '\t', '"']);
    let (name, value) = line.split_at(line.find([':', '=', ';', '\t', ','])?);
    let name: String = name.chars().filter(|c| c.is_alphabetic()).flat_map(char::to_lowercase).collect();
    let value = value[1..].trim_matches([' ', '\t', '"', '\'', '=', ':']).to_lowercase();
    let sign = match value.trim_end_matches(';') {
        "," | "comma" | "komma" => ',',
        "." | "point" | "dot" | "punkt" => '.',
        _ => return None,
    };
    SIGN_NAMES.contains(&name.as_str()).then_some(sign)
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
    for Setting { meaning, name, value, unknown_unit } in settings {
        if let Some(label) = unknown_unit {
            match (meaning.role, given_rate) {
                (Role::Rate | Role::Step, None) => {
                    meaning.role.factor_of_label(&label, &name)?;
                }
                (Role::Rate | Role::Step, Some(rate)) => notes.push(format!(
                    "the unit `{}` of `{name}` is not understood: {} Hz is used, as given",
                    snippet(&label),
                    six_digits(rate)
                )),
                _ => {}
            }
            continue;
        }
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
