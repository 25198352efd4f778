//! `[speed] profile = "measured"`: measured speed from tacho pulses, or from a speed signal over time.

use super::increasing::check_increasing;
use crate::file::diagnostic::{Kind, Problem};
use crate::file::key::{
    Count, Declared, Quantities, Quantity, Text, count, keys, not_negative, positive, quantities, quantity,
    text,
};
use crate::file::reader::Reader;
use crate::{ExternalColumn, ExternalFile, SpeedProfile};
use rotordyn_core::warning::Code;
use rotordyn_signal::tacho::PulseTrain;
use rotordyn_units::TIME;

keys! {
    /// Of a measured speed.
    pub(super) static MEASURED: MeasuredKeys {
        pulses: Quantities = quantities(not_negative(TIME), "four or more, increasing", "Times of the tacho pulses.")
            .required("or file").example("\"0, 0.1, 0.2, 0.29, 0.38 s\"");
        file: Text = text("path from the folder of the model file", "Data file with pulse times, or with speeds and time.")
            .required("or pulses").example("\"tacho.csv\"");
        column: Text = text("name of a column", "Column of the file.").computed("the only one beside time")
            .with("file = \"tacho.csv\"").example("\"pulse\"");
        unit: Text = text("s, ms, us, rpm, rad/s or Hz", "Unit of the column.").computed("as the file says")
            .with("file = \"tacho.csv\"").example("\"s\"");
        pulses_per_revolution: Count = count([1, 10_000], "Pulses per revolution.").default("1");
        smoothing: Count = count([0, MAX_SMOOTHING_PULSES], "Pulses averaged on either side; 1 is no smoothing and refused.")
            .default("0");
        from: Quantity = quantity(not_negative(TIME), "Start of the part used.").computed("the first pulse")
            .example("\"0 s\"");
        to: Quantity = quantity(positive(TIME), "End of the part used.").computed("the last pulse");
    }
}

/// Minimum number of pulses: required by the cubic spline.
const MIN_PULSES: usize = 4;
/// Maximum number of pulses averaged on either side.
const MAX_SMOOTHING_PULSES: usize = 100;

/// Pulses in the model file (`pulses = [...]`), or a column of a data file: pulse times, or speeds with a
/// time column.
pub(super) fn read(r: &Reader, files: &[ExternalFile]) -> Option<SpeedProfile> {
    let per_turn = r.count(&MEASURED.pulses_per_revolution);
    let smoothing = r.count(&MEASURED.smoothing);
    let ends = [r.get(&MEASURED.from), r.get(&MEASURED.to)];
    let source = r.one_of(&[&MEASURED.pulses, &MEASURED.file]);
    if source.is_some_and(|given| given.is(&MEASURED.pulses)) {
        for key in [&MEASURED.column, &MEASURED.unit].into_iter().filter(|key| r.has(*key)) {
            r.error(Kind::Conflict, key, format!("{} applies only to a data file", r.name(key)));
        }
        let pulses = r.need_list(&MEASURED.pulses);
        check_increasing(r, &MEASURED.pulses, &pulses);
        return r
            .has_no_errors()
            .then(|| from_pulses(r, &MEASURED.pulses, &pulses, per_turn, smoothing, ends))
            .flatten();
    }
    let [wanted, unit] = [r.text(&MEASURED.column), r.text(&MEASURED.unit)];
    if source.is_none() {
        r.missing_or(&MEASURED.file, ", or pulses = \"0.1, 0.3, 0.45 s\"");
        return None;
    }
    let path = r.text(&MEASURED.file);
    let columns = columns(r, path?, files)?;
    let column = select_column(r, columns, wanted)?;
    check_finite(r, column)?;
    match unit.unwrap_or(&column.unit) {
        "s" | "ms" | "us" => {
            let divisor = match unit {
                Some("ms") => 1e3,
                Some("us") => 1e6,
                _ => 1.0,
            };
            let times: Vec<f64> = column.values.iter().map(|t| t / divisor).collect();
            check_increasing_times(r, column, &times)?;
            from_pulses(r, &MEASURED.file, &times, per_turn, smoothing, ends)
        }
        "rpm" => from_speeds(r, columns, column, std::f64::consts::PI / 30.0, ends),
        "rad/s" => from_speeds(r, columns, column, 1.0, ends),
        "Hz" => from_speeds(r, columns, column, std::f64::consts::TAU, ends),
        other => {
            let message = match other {
                "" => format!("column `{}` has no unit", column.name),
                other => format!("column `{}` is in {other}", column.name),
            };
            let problem = Problem::new(Kind::WrongDimension, &r.span_of(&MEASURED.file), message);
            r.log.error(
                problem
                    .expected("times of pulses in s, ms or us, or speeds in rpm, rad/s or Hz")
                    .hint("name the column time_s or speed_rpm, or add unit = \"rpm\""),
            );
            None
        }
    }
}

fn columns<'f>(r: &Reader, path: &str, files: &'f [ExternalFile]) -> Option<&'f [ExternalColumn]> {
    let problem = |message: String| Problem::new(Kind::UnknownName, &r.span_of(&MEASURED.file), message);
    let Some(file) = files.iter().find(|file| file.path == path) else {
        r.log.error(
            problem(format!("`{path}` was not read")).hint("pass the file to the loader (model::load_with)"),
        );
        return None;
    };
    match &file.content {
        Ok(columns) if columns.is_empty() => {
            r.log.error(problem(format!("`{path}` contains no numeric column")));
            None
        }
        Ok(columns) => Some(columns),
        Err(why) => {
            r.log.error(problem(why.clone()).hint("the path is relative to the model file's folder"));
            None
        }
    }
}

/// The requested column; without a name the only column, or the only one other than time.
fn select_column<'f>(
    r: &Reader,
    columns: &'f [ExternalColumn],
    wanted: Option<&str>,
) -> Option<&'f ExternalColumn> {
    let names = || columns.iter().map(|c| c.name.as_str());
    if let Some(name) = wanted {
        let found = columns.iter().find(|c| c.name == name);
        if found.is_none() {
            let problem = Problem::new(
                Kind::UnknownName,
                &r.span_of(&MEASURED.column),
                format!("the file has no column `{name}`"),
            );
            r.log.error(problem.suggest(r.log, name, names()));
        }
        return found;
    }
    if let [only] = columns {
        return Some(only);
    }
    let mut others = columns.iter().filter(|c| c.name != TIME_COLUMN);
    match (others.next(), others.next()) {
        (Some(one), None) => Some(one),
        _ => {
            let message = format!("the file has {} columns", columns.len());
            let problem = Problem::new(Kind::MissingKey, &r.span_of(&MEASURED.file), message);
            let names: Vec<&str> = names().collect();
            r.log.error(problem.hint(format!("add column = one of {}", names.join(", "))));
            None
        }
    }
}

const TIME_COLUMN: &str = "time";

/// Report the first value that is not finite.
fn check_finite(r: &Reader, column: &ExternalColumn) -> Option<()> {
    let Some(k) = column.values.iter().position(|v| !v.is_finite()) else { return Some(()) };
    let message = format!("column `{}` contains {} at value {}", column.name, column.values[k], k + 1);
    r.log.error(Problem::new(Kind::OutOfRange, &r.span_of(&MEASURED.file), message));
    None
}

fn check_increasing_times(r: &Reader, column: &ExternalColumn, times: &[f64]) -> Option<()> {
    let Some(k) = times.windows(2).position(|w| w[1] <= w[0]) else { return Some(()) };
    let message = format!(
        "the times in column `{}` do not increase: {} s after {} s at value {}",
        column.name,
        times[k + 1],
        times[k],
        k + 2
    );
    let problem = Problem::new(Kind::OutOfRange, &r.span_of(&MEASURED.file), message);
    r.log.error(problem.expected("increasing pulse times"));
    None
}

/// Shaft angles at the pulses, including one pulse before and after the requested part.
fn from_pulses(
    r: &Reader,
    key: &dyn Declared,
    times: &[f64],
    per_turn: usize,
    smoothing: usize,
    [from, to]: [Option<f64>; 2],
) -> Option<SpeedProfile> {
    let first = from.map_or(0, |t| times.partition_point(|p| *p <= t).saturating_sub(1));
    let last = to.map_or(times.len(), |t| (times.partition_point(|p| *p < t) + 1).min(times.len()));
    let times = times.get(first..last).unwrap_or_default();
    if times.len() < MIN_PULSES {
        let part = if from.is_some() || to.is_some() { " in the requested part" } else { "" };
        let message = format!("{} pulses{part} are too few", times.len());
        let problem = Problem::new(Kind::OutOfRange, &r.span_of(key), message);
        r.log.error(problem.expected(format!("{MIN_PULSES} pulses or more")));
        return None;
    }
    // Cannot fail: already checked to be finite, increasing and at least four.
    let mut train = PulseTrain::new(times, per_turn).ok()?;
    if train.missing + train.dropped > 0 {
        let message = format!(
            "of {} pulses {} were rejected as spurious; {} missing pulses were inserted",
            times.len(),
            train.dropped,
            train.missing
        );
        r.log.warn(
            Code::MeasuredSpeed,
            r.name(key),
            Problem::new(Kind::OutOfRange, &r.span_of(key), message),
        );
    }
    if smoothing >= 2 {
        match train.smoothed(smoothing) {
            Ok(smooth) => train = smooth,
            Err(error) => {
                r.error(Kind::OutOfRange, &MEASURED.smoothing, error.to_string());
                return None;
            }
        }
    } else if smoothing == 1 {
        let problem = Problem::new(
            Kind::OutOfRange,
            &r.span_of(&MEASURED.smoothing),
            "one pulse on either side gives no smoothing",
        );
        r.log.error(problem.expected("0, or 2 pulses or more"));
        return None;
    }
    let start = from.unwrap_or(train.times[0]).max(train.times[0]);
    let end = train.times[train.times.len() - 1];
    let duration = to.unwrap_or(end).min(end) - start;
    if duration <= 0.0 {
        r.error(
            Kind::OutOfRange,
            if to.is_some() { &MEASURED.to } else { key },
            "there are no pulses between from and to",
        );
        return None;
    }
    let points = train.times.iter().zip(&train.revolutions);
    let points = points.map(|(t, turns)| [t - start, std::f64::consts::TAU * turns]).collect();
    Some(SpeedProfile::Pulses { points, duration })
}

fn from_speeds(
    r: &Reader,
    columns: &[ExternalColumn],
    speeds: &ExternalColumn,
    factor: f64,
    [from, to]: [Option<f64>; 2],
) -> Option<SpeedProfile> {
    let Some(time) = columns.iter().find(|c| c.name == TIME_COLUMN) else {
        let message = format!("the file has speeds, `{}`, but no time column", speeds.name);
        let problem = Problem::new(Kind::MissingKey, &r.span_of(&MEASURED.file), message);
        r.log.error(problem.hint("name the time column time_s"));
        return None;
    };
    check_finite(r, time)?;
    check_increasing_times(r, time, &time.values)?;
    if let Some(k) = speeds.values.iter().position(|v| *v < 0.0) {
        let message = format!(
            "column `{}` has a negative value, {}, at value {}",
            speeds.name,
            speeds.values[k],
            k + 1
        );
        let problem = Problem::new(Kind::OutOfRange, &r.span_of(&MEASURED.file), message);
        r.log.error(problem.expected("rotation in one direction: speeds of zero or more"));
        return None;
    }
    let inside = |t: f64| from.is_none_or(|from| t >= from) && to.is_none_or(|to| t <= to);
    let pairs = time.values.iter().zip(&speeds.values).filter(|(t, _)| inside(**t));
    let all: Vec<[f64; 2]> = pairs.map(|(t, v)| [*t, factor * v]).collect();
    let [first, _, ..] = all[..] else {
        let message = format!("{} speeds are too few", all.len());
        r.log.error(
            Problem::new(Kind::OutOfRange, &r.span_of(&MEASURED.file), message).expected("two or more"),
        );
        return None;
    };
    Some(SpeedProfile::Table { points: all.iter().map(|[t, v]| [t - first[0], *v]).collect() })
}
