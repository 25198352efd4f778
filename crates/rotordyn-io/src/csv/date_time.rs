//! Dates and times of day in the cells of tables: ISO 8601, `23.11.2026 12:00:00,5`, `11/23/2026 12:00:00 PM`.
//!
//! Whether day or month is first in dates with slashes follows from all dates of a column; where they leave it open, the
//! file is refused. There are no leap seconds, and no summer time unless each time states its offset.

use crate::measured::content_problem::ContentProblem;

/// Nanoseconds of a second and a day.
const SECOND: i64 = 1_000_000_000;
const DAY: i64 = 86_400 * SECOND;

/// A date, as far as it is known.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Date {
    /// Days since 1970-01-01.
    Known(i32),
    /// First and second number of a date with slashes, and the year.
    Slashed(u8, u8, i32),
}

/// A point in time: a date, a time of day, or both.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Stamp {
    date: Option<Date>,
    /// Time of day in UTC if an offset is stated \[ns\].
    time: Option<i64>,
}

/// Longest text of a date and a time \[bytes\].
const MAX_TEXT: usize = 48;

impl Stamp {
    /// Reads a date and a time, or one of them; `None` if it is neither.
    pub fn read(text: &str) -> Option<Self> {
        if text.len() > MAX_TEXT || !text.starts_with(|c: char| c.is_ascii_digit()) {
            return None;
        }
        let (date, time) = match text.split_once([' ', 'T']) {
            Some((date, time)) if date.contains(['-', '/', '.']) && !date.contains(':') => {
                (Some(date), Some(time.trim()))
            }
            None if !text.contains(':') => (Some(text), None),
            _ => (None, Some(text)),
        };
        let date = match date {
            Some(text) => Some(read_date(text)?),
            None => None,
        };
        let time = match time {
            Some(text) => Some(read_time(text)?),
            None => None,
        };
        Some(Self { date, time })
    }

    /// How many of the first cells of a line are date and time; 0 if none.
    pub fn cells(cells: &[&str]) -> usize {
        let read = |k: usize| cells.get(k).and_then(|cell| Stamp::read(cell));
        let half = |k: usize| {
            cells.get(k).is_some_and(|cell| ["AM", "PM"].iter().any(|h| cell.eq_ignore_ascii_case(h)))
        };
        match (read(0), read(1)) {
            (None, _) => 0,
            (Some(Stamp { time: None, .. }), Some(Stamp { date: None, .. })) => 2 + usize::from(half(2)),
            (Some(Stamp { time: Some(_), .. }), _) => 1 + usize::from(half(1)),
            _ => 1,
        }
    }
}

fn digits(text: &str, lengths: std::ops::RangeInclusive<usize>) -> Option<u32> {
    let sound = lengths.contains(&text.len()) && text.bytes().all(|b| b.is_ascii_digit());
    text.parse().ok().filter(|_| sound)
}

fn read_date(text: &str) -> Option<Date> {
    let separator = ['-', '/', '.'].into_iter().find(|s| text.contains(*s))?;
    let parts: Vec<&str> = text.split(separator).collect();
    let [a, b, c] = parts[..] else { return None };
    if a.len() == 4 && separator != '.' {
        let (year, month, day) = (digits(a, 4..=4)?, digits(b, 1..=2)?, digits(c, 1..=2)?);
        return days(year, month, day).map(Date::Known);
    }
    let (first, second, year) = (digits(a, 1..=2)?, digits(b, 1..=2)?, digits(c, 4..=4)?);
    match separator {
        '.' => days(year, second, first).map(Date::Known),
        '/' => {
            let possible = days(year, second, first).is_some() || days(year, first, second).is_some();
            possible.then_some(Date::Slashed(first as u8, second as u8, year as i32))
        }
        _ => None,
    }
}

/// Days since 1970-01-01 of a date of the Gregorian calendar; `None` if there is no such day.
fn days(year: u32, month: u32, day: u32) -> Option<i32> {
    let leap = year.is_multiple_of(4) && (!year.is_multiple_of(100) || year.is_multiple_of(400));
    let lengths = [31, if leap { 29 } else { 28 }, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31];
    let length = *lengths.get(month.checked_sub(1)? as usize)?;
    if !(1..=length).contains(&day) || year == 0 {
        return None;
    }
    let before = year - 1;
    let years = 365 * before + before / 4 - before / 100 + before / 400;
    let months: u32 = lengths.iter().take(month as usize - 1).sum();
    Some((years + months + day - 1) as i32 - 719_162)
}

/// Nanoseconds since midnight, less a stated offset from UTC.
fn read_time(text: &str) -> Option<i64> {
    let upper = text.to_ascii_uppercase();
    let (clock, half) = match (upper.strip_suffix("AM"), upper.strip_suffix("PM")) {
        (Some(rest), _) => (rest.trim_end(), Some(0)),
        (_, Some(rest)) => (rest.trim_end(), Some(12)),
        _ => (upper.as_str(), None),
    };
    let (clock, offset) = match clock.rfind(['Z', '+', '-']) {
        None => (clock, 0),
        Some(at) => {
            let (clock, zone) = clock.split_at(at);
            let (hours, minutes) = match zone[1..].split_once(':') {
                _ if zone == "Z" => (0, 0),
                Some((hours, minutes)) => (digits(hours, 2..=2)?, digits(minutes, 2..=2)?),
                None if zone.len() == 5 => (digits(zone.get(1..3)?, 2..=2)?, digits(zone.get(3..5)?, 2..=2)?),
                None => (digits(&zone[1..], 2..=2)?, 0),
            };
            let minutes = i64::from(hours.min(99) * 60 + minutes);
            (clock.trim_end(), if zone.starts_with('-') { -minutes } else { minutes })
        }
    };
    let mut parts = clock.split(':');
    let (hour, minute) = (digits(parts.next()?, 1..=2)?, digits(parts.next()?, 2..=2)?);
    let (second, fraction) = match parts.next() {
        None => (0, 0),
        Some(seconds) => match seconds.split_once(['.', ',']) {
            None => (digits(seconds, 1..=2)?, 0),
            Some((whole, part)) => {
                let kept = part.get(..part.len().min(9))?;
                digits(kept, 1..=9)?;
                let sound = part.bytes().all(|b| b.is_ascii_digit());
                let nanoseconds: i64 = format!("{kept:0<9}").parse().ok().filter(|_| sound)?;
                (digits(whole, 1..=2)?, nanoseconds)
            }
        },
    };
    let hour = match half {
        None => hour,
        Some(later) if (1..=12).contains(&hour) => hour % 12 + later,
        Some(_) => return None,
    };
    if parts.next().is_some() || hour > 24 || minute > 59 || second > 60 {
        return None;
    }
    let seconds = i64::from(hour) * 3600 + i64::from(minute) * 60 + i64::from(second);
    Some(seconds * SECOND + fraction - offset * 60 * SECOND)
}

/// Seconds since the first of the points in time.
///
/// # Errors
/// Dates with slashes whose order of day and month is open, or dates that are in no order.
pub(super) fn seconds(stamps: &[Stamp]) -> Result<Vec<f64>, ContentProblem> {
    let month_first = month_first(stamps)?;
    let at = |stamp: &Stamp| {
        let days = match stamp.date {
            None => Some(0),
            Some(Date::Known(days)) => Some(days),
            Some(Date::Slashed(a, b, year)) => {
                let (month, day) = if month_first { (a, b) } else { (b, a) };
                days(year as u32, month.into(), day.into())
            }
        };
        days.map(|days| i128::from(days) * i128::from(DAY) + i128::from(stamp.time.unwrap_or(0)))
    };
    let first = stamps.first().and_then(at).unwrap_or(0);
    let seconds = |stamp: &Stamp| at(stamp).map(|at| (at - first) as f64 / SECOND as f64);
    let found: Option<Vec<f64>> = stamps.iter().map(seconds).collect();
    found.ok_or_else(|| ContentProblem::new("some dates have the month first and others the day", ADVICE))
}

const ADVICE: &str = "write the dates as year-month-day, such as 2026-11-23";

/// Seconds since the first of dates of any of these forms, and of universal files: "12-Feb-04 10:32:39".
///
/// `None` without texts, if one is no date, has no date but a time of day, or is open to two readings.
pub fn date_seconds(texts: &[&str]) -> Option<Vec<f64>> {
    let stamps: Option<Vec<Stamp>> = texts
        .iter()
        .map(|text| Stamp::read(&in_digits(text.trim())).filter(|stamp| stamp.date.is_some()))
        .collect();
    stamps.filter(|stamps| !stamps.is_empty()).and_then(|stamps| seconds(&stamps).ok())
}

/// "12-Feb-04 10:32:39" as "2004-02-12 10:32:39"; other texts as they are.
fn in_digits(text: &str) -> String {
    const MONTHS: [&str; 12] =
        ["jan", "feb", "mar", "apr", "may", "jun", "jul", "aug", "sep", "oct", "nov", "dec"];
    let (date, time) = text.split_once(' ').unwrap_or((text, ""));
    let parts: Vec<&str> = date.split('-').collect();
    let [day, month, year] = parts[..] else { return text.into() };
    let Some(month) = MONTHS.iter().position(|name| month.eq_ignore_ascii_case(name)) else {
        return text.into();
    };
    let year = match (digits(year, 2..=2), digits(year, 4..=4)) {
        // The first universal files are of 1970.
        (Some(short), _) => short + if short < 70 { 2000 } else { 1900 },
        (_, Some(year)) => year,
        _ => return text.into(),
    };
    format!("{year}-{:02}-{day} {time}", month + 1).trim_end().into()
}

/// Whether the month is first in dates with slashes.
fn month_first(stamps: &[Stamp]) -> Result<bool, ContentProblem> {
    let dates = || {
        stamps.iter().filter_map(|stamp| match stamp.date {
            Some(Date::Slashed(a, b, year)) => Some((a, b, year)),
            _ => None,
        })
    };
    let Some(first) = dates().next() else { return Ok(false) };
    if dates().any(|(a, ..)| a > 12) {
        return Ok(false);
    }
    if dates().any(|(_, b, _)| b > 12) {
        return Ok(true);
    }
    // On one day the order does not matter, nor if both numbers are equal.
    if dates().all(|date| date == first) || dates().all(|(a, b, _)| a == b) {
        return Ok(false);
    }
    let (a, b, year) = first;
    let text = format!("`{a:02}/{b:02}/{year}` may be month and day or day and month");
    Err(ContentProblem::new(text, ADVICE))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Seconds between two texts.
    fn between(a: &str, b: &str) -> f64 {
        let stamps: Vec<Stamp> =
            [a, b].map(|text| Stamp::read(text).unwrap_or_else(|| panic!("{text}"))).into();
        seconds(&stamps).unwrap()[1]
    }

    #[test]
    fn dates_of_files_and_names() {
        assert_eq!(date_seconds(&["12-Feb-04 10:32:39", "2004-02-12 10:33:39.5"]), Some(vec![0.0, 60.5]));
        assert_eq!(date_seconds(&["28-FEB-1999", "1-mar-99"]), Some(vec![0.0, 86_400.0]));
        // A time of day alone, a day that there is not, no date, and two readings.
        for wrong in ["10:32:39", "31-Feb-04", "pump", "", "1-xyz-04", "-Feb-"] {
            assert_eq!(date_seconds(&[wrong]), None, "{wrong}");
        }
        assert_eq!(date_seconds(&["03/04/2026", "05/06/2026"]), None);
        assert_eq!(date_seconds(&[]), None);
    }

    #[test]
    fn forms_of_dates_and_times() {
        assert_eq!(between("2026-11-23T12:00:00Z", "2026-11-23T12:00:00.25Z"), 0.25);
        assert_eq!(between("2026-11-23 12:00", "2026-11-23 12:01:00,000000001"), 60.000000001);
        assert_eq!(between("2026/11/23 23:59:59.5", "2026/11/24 00:00:00"), 0.5);
        assert_eq!(between("28.02.2028 23:59:59,5", "1.3.2028 0:00:00"), 86_400.5);
        assert_eq!(between("2026-11-23T12:00:00+01:00", "2026-11-23T12:00:00Z"), 3600.0);
        assert_eq!(between("2026-11-23T12:00:00-0130", "2026-11-23T12:00:00Z"), -5400.0);
        assert_eq!(between("12:00:00.0", "12:00:00.1"), 0.1);
        assert_eq!(between("11/23/2026 12:00:00 AM", "11/23/2026 12:00:00 PM"), 43_200.0);
        // A leap day, and the days of 400 years.
        assert_eq!(between("1900-02-28 0:00", "1900-03-01 0:00"), 86_400.0);
        assert_eq!(between("1600-01-01 0:00", "2000-01-01 0:00"), 146_097.0 * 86_400.0);
        assert_eq!(between("1970-01-01", "1970-01-02"), 86_400.0);
        for none in [
            "",
            "12",
            "1.5",
            "2026-02-30 0:00",
            "32.1.2026 0:00",
            "13/13/2026 0:00",
            "25:00",
            "12:60",
            "12:00:00.x",
            "13:00 PM",
            "2026-11-23T",
            "1.2.3",
            "-1:00",
            "12:00:00+1:2:3",
            "2026-11-23 12:00:00 noon",
        ] {
            assert_eq!(Stamp::read(none), None, "{none}");
        }
    }

    #[test]
    fn order_of_day_and_month_follows_from_the_column_or_is_asked_for() {
        let seconds_of = |texts: &[&str]| {
            let stamps: Vec<Stamp> = texts.iter().map(|text| Stamp::read(text).unwrap()).collect();
            seconds(&stamps).map_err(|problem| problem.problem)
        };
        assert_eq!(seconds_of(&["11/12/2026 0:00", "11/13/2026 0:00"]).unwrap()[1], 86_400.0);
        assert_eq!(seconds_of(&["12/11/2026 0:00", "13/11/2026 0:00"]).unwrap()[1], 86_400.0);
        // The same day in either order.
        assert_eq!(seconds_of(&["01/02/2026 0:00", "01/02/2026 0:01"]).unwrap()[1], 60.0);
        let open = seconds_of(&["01/02/2026 0:00", "01/03/2026 0:00"]).unwrap_err();
        assert_eq!(open, "`01/02/2026` may be month and day or day and month");
        let mixed = seconds_of(&["11/13/2026 0:00", "13/11/2026 0:00"]).unwrap_err();
        assert_eq!(mixed, "some dates have the month first and others the day");
    }

    #[test]
    fn cells_of_a_line() {
        assert_eq!(Stamp::cells(&["2026-11-23 12:00:00", "1.5"]), 1);
        assert_eq!(Stamp::cells(&["23.11.2026", "12:00:00,5", "1"]), 2);
        assert_eq!(Stamp::cells(&["11/23/2026", "12:00:00", "PM", "1"]), 3);
        assert_eq!(Stamp::cells(&["1.0", "2.0"]), 0);
    }
}
