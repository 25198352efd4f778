//! The axis of a trend: values given, dates, numbers in the names, speeds, numbers in the files, or an index.

use rotordyn::io::csv::date_seconds;
use rotordyn::names::nearest;
use rotordyn::results::TrendAxis;

use super::names;
use super::record::Analysed;

/// What `--over` asks for.
#[derive(Clone, Debug, PartialEq)]
pub enum Over {
    Auto,
    Index,
    Time,
    Name,
    Speed,
    /// One value per record.
    Given {
        name: String,
        unit: String,
        values: Vec<f64>,
    },
    /// A number that every file states.
    Number(String),
}

impl Over {
    /// Reads "time", "load=0,1,2,3 hp" or the name of a number.
    pub fn parse(text: Option<&str>) -> Result<Over, String> {
        let Some(text) = text else { return Ok(Over::Auto) };
        if let Some((name, values)) = text.split_once('=') {
            return given(name.trim(), values).map_err(|problem| {
                format!("--over {text}: {problem}; expected a name and one number per record, such as \"load=0,1,2,3 hp\"")
            });
        }
        Ok(match text.trim() {
            "index" => Over::Index,
            "time" => Over::Time,
            "name" => Over::Name,
            "speed" => Over::Speed,
            "" => {
                return Err(
                    "--over: expected index, time, name, speed, a number in the files, or NAME=VALUES".into(),
                );
            }
            other => Over::Number(other.into()),
        })
    }
}

/// "0,1,2,3 hp" or "0 hp, 1 hp": numbers and their unit.
fn given(name: &str, text: &str) -> Result<Over, String> {
    if name.is_empty() {
        return Err("the name is missing".into());
    }
    let mut unit = String::new();
    let mut values = Vec::new();
    for cell in text.split(',').map(str::trim) {
        let end = cell
            .find(|c: char| c.is_whitespace() || (c.is_alphabetic() && !matches!(c, 'e' | 'E')) || c == '%');
        let (number, own) = cell.split_at(end.unwrap_or(cell.len()));
        let value = number.parse::<f64>().ok().filter(|value| value.is_finite());
        values.push(value.ok_or_else(|| format!("`{cell}` is no number"))?);
        let own = own.trim();
        if !own.is_empty() && !unit.is_empty() && own != unit {
            return Err(format!("the values have two units, {unit} and {own}"));
        }
        if !own.is_empty() {
            unit = own.into();
        }
    }
    Ok(Over::Given { name: name.into(), unit, values })
}

/// The axis and the position of every record on it; NaN where it is not known.
///
/// Errors: the axis asked for is not that of all records that were read.
pub fn positions(over: &Over, records: &[Analysed]) -> Result<(TrendAxis, Vec<f64>), String> {
    let axis = |name: &str, unit: &str, source: &str| TrendAxis {
        name: name.into(),
        unit: unit.into(),
        source: source.into(),
    };
    let index = || (axis("record", "", "their order"), (1..=records.len()).map(|k| k as f64).collect());
    let in_names = || {
        let all: Vec<&str> = records.iter().map(|r| r.record.name.as_str()).collect();
        let found = names::numbers(&all)?;
        Some((axis(&found.name, &found.unit, "the number in the names"), found.values))
    };
    match over {
        Over::Auto => Ok(of_files(records).or_else(|| of_names(records)).or_else(in_names).unwrap_or_else(index)),
        Over::Index => Ok(index()),
        Over::Time => of_files(records).or_else(|| of_names(records)).ok_or_else(|| {
            "--over time: neither all files nor all names state a date, such as 2026-11-23_120000, that differs between \
             them; give the times, such as --over \"time=0,1,2 h\""
                .into()
        }),
        Over::Name => in_names().ok_or_else(|| {
            "--over name: the names are not the same but for a number that differs in each, such as rec1.mat, rec2.mat".into()
        }),
        Over::Speed => {
            let of = |r: &Analysed| r.record.state.as_ref().and_then(|s| s.speed).map_or(f64::NAN, |s| 60.0 * s);
            let found: Vec<f64> = records.iter().map(of).collect();
            match records.iter().zip(&found).find(|(r, speed)| r.record.state.is_some() && speed.is_nan()) {
                Some((r, _)) => Err(format!(
                    "--over speed: the speed of {} is not known; give --speed with one value per record",
                    r.record.name
                )),
                None => Ok((axis("speed", "rpm", "the shaft speeds"), found)),
            }
        }
        Over::Given { name, unit, values } => {
            if values.len() != records.len() {
                return Err(format!(
                    "--over {name} has {} values for {} records: {}",
                    values.len(),
                    records.len(),
                    names::few(records.iter().map(|r| r.record.name.as_str()))
                ));
            }
            Ok((axis(name, unit, "as given"), values.clone()))
        }
        Over::Number(name) => {
            let found = |r: &Analysed| r.number.unwrap_or(f64::NAN);
            match records.iter().find(|r| r.record.state.is_some() && r.number.is_none()) {
                Some(without) => Err(no_number(name, without)),
                None => {
                    let values = records.iter().map(found).collect();
                    Ok((axis(name, "", &format!("the number `{name}` in the files")), values))
                }
            }
        }
    }
}

fn no_number(name: &str, without: &Analysed) -> String {
    let known = || without.number_names.iter().map(String::as_str);
    let hint = match (nearest(name, known()), without.number_names.is_empty()) {
        (Some(near), _) => format!("did you mean `{near}`?"),
        (None, true) => "the file states no number".into(),
        (None, false) => format!("the file has {}", names::few(known())),
    };
    format!(
        "--over {name}: {} states no number of this name; {hint}; or give the values, such as --over \"{name}=0,1,2\"",
        without.record.name
    )
}

/// Times that all files that were read state.
fn of_files(records: &[Analysed]) -> Option<(TrendAxis, Vec<f64>)> {
    let read: Vec<&Analysed> = records.iter().filter(|r| r.record.state.is_some()).collect();
    let dates: Vec<&str> = read.iter().map(|r| r.date.as_str()).collect();
    let mut seconds = times(&dates)?.into_iter();
    let places = records.iter().map(|r| if r.record.state.is_some() { seconds.next() } else { None });
    let seconds = places.map(|time| time.unwrap_or(f64::NAN)).collect();
    Some(over_time(seconds, &format!("dates in the files, from {}", dates.first()?)))
}

/// Times that all names state.
fn of_names(records: &[Analysed]) -> Option<(TrendAxis, Vec<f64>)> {
    let dates: Option<Vec<String>> = records.iter().map(|r| names::date(&r.record.name)).collect();
    let dates = dates?;
    let texts: Vec<&str> = dates.iter().map(String::as_str).collect();
    let seconds = times(&texts)?;
    Some(over_time(seconds, &format!("dates in the names, from {}", dates.iter().min()?)))
}

/// Seconds since the first of dates that differ.
fn times(dates: &[&str]) -> Option<Vec<f64>> {
    let seconds = date_seconds(dates)?;
    let first = seconds.iter().copied().reduce(f64::min)?;
    let last = seconds.iter().copied().reduce(f64::max)?;
    (last > first).then(|| seconds.iter().map(|t| t - first).collect())
}

/// Times \[s\] in the unit that suits their range.
fn over_time(seconds: Vec<f64>, source: &str) -> (TrendAxis, Vec<f64>) {
    let range = seconds.iter().copied().filter(|t| t.is_finite()).fold(0.0, f64::max);
    let (unit, divisor) = match range {
        r if r < 300.0 => ("s", 1.0),
        r if r < 5.0 * 3600.0 => ("min", 60.0),
        r if r < 5.0 * 86_400.0 => ("h", 3600.0),
        _ => ("d", 86_400.0),
    };
    let axis = TrendAxis { name: "time".into(), unit: unit.into(), source: source.into() };
    (axis, seconds.into_iter().map(|t| t / divisor).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn axes_that_are_asked_for() {
        let given = |name: &str, unit: &str, values: &[f64]| Over::Given {
            name: name.into(),
            unit: unit.into(),
            values: values.to_vec(),
        };
        let parse = |text: &str| Over::parse(Some(text));
        assert_eq!(parse("load=0,1,2,3 hp"), Ok(given("load", "hp", &[0.0, 1.0, 2.0, 3.0])));
        assert_eq!(parse("load = 0 hp, 1 hp"), Ok(given("load", "hp", &[0.0, 1.0])));
        assert_eq!(parse("load=-1.5e3,2E3"), Ok(given("load", "", &[-1500.0, 2000.0])));
        assert_eq!(parse("wear=10%,20%"), Ok(given("wear", "%", &[10.0, 20.0])));
        assert_eq!(parse("load"), Ok(Over::Number("load".into())));
        assert_eq!(Over::parse(None), Ok(Over::Auto));
        for wrong in ["load=", "load=1,,2", "load=1 hp,2 kW", "=1,2", "load=a,b", "load=1,inf", ""] {
            let problem = parse(wrong).unwrap_err();
            assert!(problem.contains("expected"), "{wrong}: {problem}");
        }
    }
}
