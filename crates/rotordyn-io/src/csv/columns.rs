//! The columns of a table: names and units from the lines before the numbers, and what a column is.

use super::style::{Cell, TableStyle};
use super::written_digits::Digits;
use crate::measured::axis_names::{Meaning, Role, meaning};
use crate::measured::axis_units;
use crate::measured::content_problem::ContentProblem;
use crate::measured::name_unit;
use crate::measured::unit_label::{self, SiUnit};
use rotordyn_signal::Complex;
use rotordyn_signal::record::AxisQuantity;

pub(super) struct Column {
    pub name: String,
    /// As written.
    pub stated: String,
    pub si: Option<SiUnit>,
    /// Real parts, NaN for empty cells.
    pub re: Vec<f64>,
    /// Imaginary parts; empty as long as all are zero.
    pub im: Vec<f64>,
    /// Number of cells up to the last that is not empty.
    pub length: usize,
    /// Digits of its numbers, if it may be the times.
    pub digits: Option<Digits>,
}

impl Column {
    pub fn new(name: String, stated: String, si: Option<SiUnit>) -> Self {
        let may_be_times = name.eq_ignore_ascii_case("x") || meaning(&name, &[Role::Times]).is_some();
        let digits = may_be_times.then(Digits::default);
        Column { name, stated, si, re: Vec::new(), im: Vec::new(), length: 0, digits }
    }

    /// Adds a cell with its text.
    pub fn push(&mut self, cell: Cell, text: &str) {
        if let Some(digits) = &mut self.digits {
            digits.note(text);
        }
        let value = cell.unwrap_or(Complex::new(f64::NAN, 0.0));
        if value.im != 0.0 && self.im.is_empty() {
            self.im.resize(self.re.len(), 0.0);
        }
        if value.im != 0.0 || !self.im.is_empty() {
            self.im.push(value.im);
        }
        self.re.push(value.re);
        if cell.is_some() {
            self.length = self.re.len();
        }
    }

    /// Whether every value is larger than the one before it.
    pub fn increases(&self) -> bool {
        self.im.is_empty() && self.re.windows(2).all(|pair| pair[0] < pair[1])
    }

    /// Whether no value is smaller than the one before it; rounded times may repeat.
    pub fn does_not_decrease(&self) -> bool {
        self.im.is_empty()
            && self.re.windows(2).all(|pair| pair[0] <= pair[1])
            && self.re.first() < self.re.last()
    }

    /// Quantity of the axis that the column is, by its name and unit, with the factor and the divisor to s or Hz; `None` if
    /// it is none.
    pub fn axis(&self) -> Option<(AxisQuantity, (f64, f64))> {
        let quantity = |role| if role == Role::Times { AxisQuantity::Time } else { AxisQuantity::Frequency };
        let unit = self.axis_unit();
        if self.name.eq_ignore_ascii_case("x") {
            let unit = unit?;
            let factor = |role: Role| Some((quantity(role), role.factor(&unit)?));
            return factor(Role::Times).or_else(|| factor(Role::Frequencies).filter(|_| unit.name == "Hz"));
        }
        let meaning = meaning(&self.name, &[Role::Times, Role::Frequencies])?;
        let factor = match &unit {
            Some(unit) => meaning.role.factor(unit)?,
            // A column `f` of no unit may be a force, which does not increase.
            None if !self.stated.is_empty() || meaning.role != Role::Times && !self.increases() => {
                return None;
            }
            None => (1.0, 1.0),
        };
        Some((quantity(meaning.role), factor))
    }

    /// Whether it has no unit of its own and is no axis or number of the file by its name.
    pub fn may_have_unit(&self) -> bool {
        let roles = [Role::Times, Role::Frequencies, Role::Rate, Role::Step, Role::Start, Role::Count];
        self.stated.is_empty() && meaning(&self.name, &roles).is_none()
    }

    /// The unit of an axis or a rate.
    fn axis_unit(&self) -> Option<SiUnit> {
        axis_units::si(&self.stated).or_else(|| self.si.clone())
    }

    /// Why a column that is an axis by its name and values is none: its unit is not known.
    pub fn axis_problem(&self) -> Option<ContentProblem> {
        let meaning = meaning(&self.name, &[Role::Times, Role::Frequencies])?;
        let unknown = !meaning.uncertain && self.axis_unit().is_none() && self.increases();
        meaning.role.factor_of_label(&self.stated, &self.name).err().filter(|_| unknown)
    }

    /// The rate, the step or the number of samples that the column states, if all its values are the same.
    pub fn setting(&self) -> Option<(Meaning, f64)> {
        let mut meaning = meaning(&self.name, &[Role::Rate, Role::Step, Role::Count])?;
        let mut values = self.re[..self.length].iter().filter(|v| !v.is_nan());
        let first = *values.next()?;
        match self.axis_unit() {
            Some(si) => (meaning.numerator, meaning.divisor) = meaning.role.factor(&si)?,
            None if !self.stated.is_empty() => return None,
            None => {}
        }
        let constant = self.im.is_empty() && values.all(|v| *v == first);
        (constant && !meaning.uncertain).then_some((meaning, first))
    }
}

/// The columns of a table from the lines before its numbers, and how many of the last lines name them.
///
/// `header_lines`: without comments. `comment`: the last line before the numbers, if it is one. `width`: of the data lines,
/// date and time included.
pub(super) fn columns(
    header_lines: &[&str],
    comment: Option<&str>,
    style: TableStyle,
    width: usize,
    stem: &str,
) -> (Vec<Column>, HeaderUse) {
    let cells = |line: &str| -> Option<Vec<String>> {
        let mut cells: Vec<String> = match style.separator {
            // Names may contain blanks; then commas separate them.
            ' ' if line.contains(',') => line.split(',').map(|c| c.trim().to_owned()).collect(),
            _ => style.split(line).into_iter().map(|cell| cell.replace("\"\"", "\"")).collect(),
        };
        // Date and time in two cells have often one name, and lines may end in a separator.
        if style.stamps > 1 && cells.len() + style.stamps - 1 == width {
            cells.splice(0..0, vec![String::new(); style.stamps - 1]);
        }
        let trailing = |cells: &[String]| cells.last().is_some_and(String::is_empty);
        match cells.len() {
            n if n == width => {}
            n if n + 1 == width && style.separator != ' ' => cells.push(String::new()),
            n if n == width + 1 && trailing(&cells) => {
                cells.pop();
            }
            _ => return None,
        }
        Some(cells)
    };
    let mut rows: Vec<(usize, Vec<String>)> = header_lines
        .iter()
        .enumerate()
        .rev()
        .filter_map(|(k, line)| cells(line).map(|cells| (k, cells)))
        .take(2)
        .collect();
    rows.reverse();
    let mut taken = HeaderUse::default();
    let units = match &rows[..] {
        [_, (k, row)] => {
            let bare =
                |cell: &String| unit_cell(cell).is_empty() || unit_label::si(unit_cell(cell)).is_some();
            row.iter().all(bare).then_some((*k, row))
        }
        _ => None,
    };
    let names = if units.is_some() { rows.first() } else { rows.last() };
    taken.lines.extend(units.iter().map(|(k, _)| *k).chain(names.iter().map(|(k, _)| *k)));
    let mut names = names.map(|(_, row)| row.clone());
    if rows.is_empty() {
        // numpy.savetxt puts names into a comment.
        names = comment.and_then(|line| cells(line.trim_start_matches(['#', '%', '/', ' '])));
        taken.comment = names.is_some();
    }
    let columns = (style.stamps..width).map(|k| {
        let alone = if width == 1 { stem.to_owned() } else { format!("{stem}_{}", k + 1) };
        let name = names.as_ref().map(|row| row[k].clone()).filter(|name| !name.is_empty()).unwrap_or(alone);
        match units {
            Some((_, row)) => {
                let stated = unit_cell(&row[k]).to_owned();
                Column::new(name, stated.clone(), unit_label::si(&stated))
            }
            None => column(&name),
        }
    });
    (columns.collect(), taken)
}

/// Which of the lines before the numbers name the columns or state their units.
#[derive(Default)]
pub(super) struct HeaderUse {
    /// Places among the lines without comments.
    pub lines: Vec<usize>,
    /// The comment before the numbers.
    pub comment: bool,
}

fn unit_cell(cell: &str) -> &str {
    cell.trim_start_matches(['[', '(']).trim_end_matches([']', ')'])
}

/// A column from its name, with the unit at its end.
pub(super) fn column(name: &str) -> Column {
    match name_unit::split(name) {
        Some((base, stated, si)) => Column::new(base.into(), stated.into(), si),
        None => Column::new(name.into(), String::new(), None),
    }
}
