//! The axis of a table: a column, dates, or a rate that a line or a column states.

use super::columns::Column;
use crate::budget::Budget;
use crate::measured::axis_names::{Meaning, Role, StatedRate, check_same, six_digits};
use crate::measured::content_problem::ContentProblem;
use rotordyn_signal::record::{Axis, AxisQuantity, MeasuredData, Points};

/// Where the axis may be.
pub(super) struct Source {
    /// What lines before the numbers state.
    pub settings: Vec<(Meaning, String, f64)>,
    /// Seconds since the first date.
    pub times: Option<Vec<f64>>,
    /// Whether the columns have no names.
    pub nameless: bool,
    /// Sampling rate that holds where the file states two \[Hz\].
    pub given_rate: Option<f64>,
}

/// The axis of all columns.
pub(super) struct TableAxis {
    points: Option<(AxisQuantity, Vec<f64>)>,
    /// Start and step, where a rate is stated instead.
    uniform: Option<(f64, f64)>,
    /// What states it; empty if nothing.
    pub source: String,
}

impl TableAxis {
    /// The axis of a column of some length.
    pub fn of(&self, length: usize) -> Axis {
        match (&self.points, self.uniform) {
            (Some((quantity, points)), _) => Axis::from_points(*quantity, points[..length].to_vec()),
            (None, Some((start, step))) => Axis::uniform(AxisQuantity::Time, start, step),
            (None, None) => Axis::UNKNOWN,
        }
    }
}

/// Least values of a first column without a name that is taken as time.
const MIN_TIMES: usize = 3;

/// Takes the axis out of the columns.
///
/// # Errors
/// An axis that does not increase, or rates that differ.
pub(super) fn of_table(
    columns: &mut Vec<Column>,
    source: Source,
    budget: &Budget,
    out: &mut MeasuredData,
) -> Result<TableAxis, ContentProblem> {
    let (mut settings, source_rate) = (source.settings, source.given_rate);
    // A column that repeats the rate is no record, unless there is nothing else.
    while columns.len() > 1
        && let Some(at) = columns.iter().position(|column| column.setting().is_some())
    {
        let column = columns.remove(at);
        settings.extend(column.setting().map(|(meaning, value)| (meaning, column.name, value)));
    }
    let rates = settings.iter().filter_map(|(meaning, name, value)| {
        StatedRate::of(meaning, name, *value).map(|rate| (meaning.uncertain, rate))
    });
    let (uncertain, certain): (Vec<_>, Vec<_>) = rates.partition(|(uncertain, _)| *uncertain);
    let instead = one_rate(certain.iter().map(|(_, rate)| rate), source_rate, out)?;
    let contradicted = instead.is_some();
    let rate = instead.map(|rate| (false, rate)).or_else(|| certain.into_iter().chain(uncertain).next());

    let listed = match source.times {
        Some(times) => Some((AxisQuantity::Time, times, "dates".to_owned())),
        None => axis_column(columns, source.nameless, out),
    };
    let rows = columns.iter().map(|column| column.length).max().unwrap_or(0);
    check_count(&settings, rows, out);
    let Some((quantity, points, name)) = listed else {
        let start = settings.iter().find(|(meaning, ..)| meaning.role == Role::Start).map_or(0.0, |s| s.2);
        let uniform = rate.as_ref().map(|(_, rate)| (start, rate.step));
        let source = rate.map_or(String::new(), |(_, rate)| rate.source);
        return Ok(TableAxis { points: None, uniform, source });
    };
    if let Some(k) = points
        .windows(2)
        .position(|pair| !matches!(pair[0].partial_cmp(&pair[1]), Some(std::cmp::Ordering::Less)))
    {
        let problem = format!("`{name}` does not increase after its value {}", k + 1);
        return Err(ContentProblem::new(problem, "sort the lines, and remove duplicate and empty ones"));
    }
    match (Axis::from_points(quantity, points.clone()).points, rate) {
        (Points::NonUniform(_), _) => {
            out.notes.push(format!("`{name}` is not uniformly spaced"));
            // Every record has its own list.
            let all = points.len().saturating_mul(columns.len());
            budget.take_values::<f64>(|| "the axes of the columns".into(), all)?;
        }
        (Points::Uniform { step, .. }, Some((false, rate))) if quantity == AxisQuantity::Time => {
            let source = format!("the column `{name}`");
            let of_column = StatedRate { rate: 1.0 / step, step, source };
            let instead = match contradicted {
                true => Some(rate),
                false => one_rate([&rate, &of_column], source_rate, out)?,
            };
            if let Some(rate) = instead {
                let start = points.first().copied().unwrap_or(0.0);
                return Ok(TableAxis {
                    points: None,
                    uniform: Some((start, rate.step)),
                    source: rate.source,
                });
            }
        }
        _ => {}
    }
    Ok(TableAxis { points: Some((quantity, points)), uniform: None, source: format!("the column `{name}`") })
}

/// Refuses rates that differ, unless the user gives one: it holds instead, and a note names both.
fn one_rate<'r>(
    rates: impl IntoIterator<Item = &'r StatedRate>,
    given: Option<f64>,
    out: &mut MeasuredData,
) -> Result<Option<StatedRate>, ContentProblem> {
    match (check_same(rates), given) {
        (Ok(()), _) => Ok(None),
        (Err(problem), None) => Err(problem),
        (Err(problem), Some(rate)) => {
            out.notes.push(format!("{}: {} Hz is used, as given", problem.problem, six_digits(rate)));
            Ok(Some(StatedRate::given(rate)))
        }
    }
}

/// The column that is the axis, in SI: by its name, or the first one of a table without names.
fn axis_column(
    columns: &mut Vec<Column>,
    nameless: bool,
    out: &mut MeasuredData,
) -> Option<(AxisQuantity, Vec<f64>, String)> {
    if columns.len() < 2 {
        return None;
    }
    if let Some(at) = columns.iter().position(|column| column.axis().is_some()) {
        let column = columns.remove(at);
        let quantity = column.axis().unwrap_or_default();
        let (up, down) = column.si.as_ref().map_or((1.0, 1.0), |si| (si.numerator, si.divisor));
        let points = column.re.iter().map(|v| if up == down { *v } else { v * up / down }).collect();
        return Some((quantity, points, column.name));
    }
    let first = columns.first().filter(|first| nameless && first.length >= MIN_TIMES && first.increases())?;
    let axis = Axis::from_points(AxisQuantity::Time, first.re.clone());
    let Points::Uniform { start, step } = axis.points else { return None };
    let complex = columns.iter().any(|column| !column.im.is_empty());
    let first = columns.remove(0);
    if step == 1.0 && (start == 0.0 || start == 1.0) {
        out.left_out.push("the first column (it counts the lines)".into());
        return None;
    }
    let (quantity, what) = match complex {
        true => (AxisQuantity::Frequency, "frequency in Hz"),
        false => (AxisQuantity::Time, "time in s"),
    };
    out.notes.push(format!("the table has no names: its first column is taken as {what}"));
    Some((quantity, first.re, first.name))
}

/// Notes a number of samples that is not that of the lines.
fn check_count(settings: &[(Meaning, String, f64)], rows: usize, out: &mut MeasuredData) {
    let stated = settings.iter().find(|(meaning, ..)| meaning.role == Role::Count);
    if let Some((_, name, count)) = stated.filter(|(.., count)| *count != rows as f64) {
        let count = six_digits(*count);
        out.notes.push(format!("the table has {rows} lines of numbers, `{name}` states {count}"));
    }
}
