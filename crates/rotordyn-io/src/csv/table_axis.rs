//! The axis of a table: a column, dates, or a rate that a line or a column states.

use super::columns::Column;
use super::decimal_sign::numbers;
use super::settings::Setting;
use super::written_digits::{Digits, RoundedStep, are_of_step, rounded_step};
use crate::budget::Budget;
use crate::measured::axis_names::{Meaning, Role, StatedRate, check_same, is_same_rate, six_digits};
use crate::measured::content_problem::ContentProblem;
use rotordyn_signal::record::{Axis, AxisQuantity, MeasuredData, Points};

/// Where the axis may be.
pub(super) struct Source {
    /// What lines before the numbers state.
    pub settings: Vec<Setting>,
    /// Decimal sign of the table, if it has one.
    pub sign: Option<char>,
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
    pub fn is_frequency(&self) -> bool {
        matches!(self.points, Some((AxisQuantity::Frequency, _)))
    }

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
    let source_rate = source.given_rate;
    let mut repeated = Vec::new();
    // A column that repeats the rate is no record, unless there is nothing else.
    while columns.len() > 1
        && let Some(at) = columns.iter().position(|column| column.setting().is_some())
    {
        let column = columns.remove(at);
        repeated.extend(column.setting().map(|(meaning, value)| (meaning, column.name, value)));
    }
    let listed = match source.times {
        Some(times) => Some(Listed::new(AxisQuantity::Time, times, "dates".into(), None)),
        None => axis_column(columns, source.nameless, out),
    };
    let states_rate = source_rate.is_some()
        || source.settings.iter().any(|s| matches!(s.meaning.role, Role::Rate | Role::Step));
    if listed.is_none()
        && !states_rate
        && let Some(problem) = columns.iter().find_map(Column::axis_problem)
    {
        return Err(problem);
    }
    let step = listed.as_ref().and_then(|listed| listed.step);
    let mut settings = numbers(source.settings, source.sign, step, source_rate, &mut out.notes)?;
    settings.append(&mut repeated);
    let rates = settings.iter().filter_map(|(meaning, name, value)| {
        StatedRate::of(meaning, name, *value).map(|rate| (meaning.uncertain, rate))
    });
    let (uncertain, certain): (Vec<_>, Vec<_>) = rates.partition(|(uncertain, _)| *uncertain);
    let instead = one_rate(certain.iter().map(|(_, rate)| rate), source_rate, out)?;
    let contradicted = instead.is_some();
    let rate = instead.map(|rate| (false, rate)).or_else(|| certain.into_iter().chain(uncertain).next());

    let rows = columns.iter().map(|column| column.length).max().unwrap_or(0);
    check_count(&settings, rows, out);
    let Some(listed) = listed else {
        let start = settings.iter().find(|(meaning, ..)| meaning.role == Role::Start).map_or(0.0, |s| s.2);
        let uniform = rate.as_ref().map(|(_, rate)| (start, rate.step));
        let source = rate.map_or(String::new(), |(_, rate)| rate.source);
        return Ok(TableAxis { points: None, uniform, source });
    };
    let increases = || listed.points.windows(2).all(|pair| pair[0] < pair[1]);
    // Few whole numbers that increase unevenly are no rounded times.
    let is_known = |found: &RoundedStep| {
        found.error <= LARGEST_ERROR || rate.is_some() || source_rate.is_some() || !increases()
    };
    // One step in a hundred that is longer may be a lost sample: only a rate can tell.
    let known_rates =
        [source_rate, rate.as_ref().filter(|(uncertain, _)| !uncertain).map(|(_, rate)| rate.rate)];
    let fits = |rate: f64| listed.are_of_rate(rate);
    let tells = |found: &RoundedStep| !found.may_have_slips || known_rates.into_iter().flatten().any(fits);
    if let Some(rounded) = listed.rounded.filter(is_known).filter(tells) {
        let stated = rate.filter(|(uncertain, _)| !uncertain).map(|(_, rate)| rate);
        return of_rounded(&rounded, &listed.name, stated, (contradicted, source_rate), out);
    }
    let Listed { quantity, points, name, .. } = listed;
    if let Some(k) = points
        .windows(2)
        .position(|pair| !matches!(pair[0].partial_cmp(&pair[1]), Some(std::cmp::Ordering::Less)))
    {
        let problem = format!("`{name}` does not increase after its value {}", k + 1);
        let repeated = points.windows(2).filter(|pair| pair[0] == pair[1]).count();
        let advice = match points.windows(2).any(|pair| pair[0] > pair[1]) {
            true => "sort the lines, or write the parts of the record to files of their own",
            false if 100 * repeated < points.len() => "remove duplicate and empty lines",
            false => {
                "write the times with more digits; or, if the samples are at equal steps, write the file without this \
                 column and give --rate"
            }
        };
        return Err(ContentProblem::new(problem, advice));
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

/// Largest relative error of a step by the rounding of its times, and the largest that needs no note.
const LARGEST_ERROR: f64 = 1e-3;
const NOTED_ERROR: f64 = 1e-4;

/// The axis of rounded times: by the rate that is given or stated, else by the step that fits them.
fn of_rounded(
    rounded: &RoundedStep,
    name: &str,
    stated: Option<StatedRate>,
    (contradicted, given): (bool, Option<f64>),
    out: &mut MeasuredData,
) -> Result<TableAxis, ContentProblem> {
    let RoundedStep { start, step, error, .. } = *rounded;
    let mean = 1.0 / step;
    let uniform =
        |step: f64, source: String| TableAxis { points: None, uniform: Some((start, step)), source };
    let of_column = format!("the column `{name}`");
    let is_meant = |rate: f64| (rate / mean - 1.0).abs() <= error + 1e-9 || is_same_rate(rate, mean);
    if let Some(rate) = given.filter(|rate| is_meant(*rate)) {
        return Ok(uniform(1.0 / rate, StatedRate::given(rate).source));
    }
    if let Some(stated) = stated {
        let fits = contradicted || is_meant(stated.rate);
        let of_column = StatedRate { rate: mean, step, source: of_column };
        let instead = if fits { None } else { one_rate([&stated, &of_column], given, out)? };
        let rate = instead.unwrap_or(stated);
        return Ok(uniform(rate.step, rate.source));
    }
    // A whole number of Hz within the error is meant.
    let whole =
        Some(mean.round()).filter(|whole| *whole >= 1.0 && (whole / mean - 1.0).abs() <= error + 1e-9);
    let rate = whole.unwrap_or(mean);
    if error > LARGEST_ERROR && given.is_none() {
        let problem = format!(
            "`{name}` is written with too few digits: its sampling rate lies between {} and {} Hz",
            six_digits(mean * (1.0 - error)),
            six_digits(mean * (1.0 + error))
        );
        return Err(ContentProblem::new(problem, "give the sampling rate with --rate, or write more digits"));
    }
    if error > NOTED_ERROR {
        let percent = six_digits((1e4 * error).ceil() / 100.0);
        out.notes.push(format!("`{name}` is rounded: its sampling rate is known to {percent} % only"));
    }
    Ok(uniform(1.0 / rate, of_column))
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
fn axis_column(columns: &mut Vec<Column>, nameless: bool, out: &mut MeasuredData) -> Option<Listed> {
    if columns.len() < 2 {
        return None;
    }
    let of = |quantity: AxisQuantity| {
        columns.iter().position(|column| column.axis().is_some_and(|(of, _)| of == quantity))
    };
    // Beside times `f` is a force.
    if let Some(at) = of(AxisQuantity::Time).or_else(|| of(AxisQuantity::Frequency)) {
        let column = columns.remove(at);
        let (quantity, (up, down)) = column.axis().unwrap_or((AxisQuantity::Time, (1.0, 1.0)));
        let si = |v: f64| if up == down { v } else { v * up / down };
        let points = column.re.iter().copied().map(si).collect();
        let rounded = column.digits.and_then(|digits| rounded_step(&column.re, &digits));
        let rounded =
            rounded.map(|found| RoundedStep { start: si(found.start), step: si(found.step), ..found });
        let written = column.digits.map(|digits| (digits, up / down));
        return Some(Listed { written, ..Listed::new(quantity, points, column.name, rounded) });
    }
    let first =
        columns.first().filter(|first| nameless && first.length >= MIN_TIMES && first.does_not_decrease())?;
    let axis = Axis::from_points(AxisQuantity::Time, first.re.clone());
    let rounded = first.digits.and_then(|digits| rounded_step(&first.re, &digits));
    let (start, step) = match (axis.points, rounded) {
        (Points::Uniform { start, step }, _) => (start, step),
        (_, Some(found)) if found.error <= LARGEST_ERROR => (found.start, found.step),
        _ => return None,
    };
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
    let written = first.digits.map(|digits| (digits, 1.0));
    Some(Listed { written, ..Listed::new(quantity, first.re, first.name, rounded) })
}

/// A list of times or frequencies.
struct Listed {
    quantity: AxisQuantity,
    points: Vec<f64>,
    name: String,
    /// Step of times at equal steps \[s\].
    step: Option<f64>,
    /// The step of times that are uniform only within their rounding.
    rounded: Option<RoundedStep>,
    /// Digits of the times as written, and the factor to seconds.
    written: Option<(Digits, f64)>,
}

impl Listed {
    fn new(quantity: AxisQuantity, points: Vec<f64>, name: String, rounded: Option<RoundedStep>) -> Self {
        let even = match Axis::from_points(quantity, points.clone()).points {
            Points::Uniform { step, .. } => Some(step),
            _ => None,
        };
        let rounded = rounded.filter(|_| quantity == AxisQuantity::Time && even.is_none());
        let step = even.or(rounded.map(|found| found.step)).filter(|_| quantity == AxisQuantity::Time);
        Self { quantity, points, name, step, rounded, written: None }
    }

    /// Whether the times are those of a rate but for their rounding.
    fn are_of_rate(&self, rate: f64) -> bool {
        self.written.is_some_and(|(digits, factor)| {
            let written: Vec<f64> = self.points.iter().map(|time| time / factor).collect();
            are_of_step(&written, &digits, 1.0 / (rate * factor))
        })
    }
}

/// Notes a number of samples that is not that of the lines.
fn check_count(settings: &[(Meaning, String, f64)], rows: usize, out: &mut MeasuredData) {
    let stated = settings.iter().find(|(meaning, ..)| meaning.role == Role::Count);
    if let Some((_, name, count)) = stated.filter(|(.., count)| *count != rows as f64) {
        let count = six_digits(*count);
        out.notes.push(format!("the table has {rows} lines of numbers, `{name}` states {count}"));
    }
}
