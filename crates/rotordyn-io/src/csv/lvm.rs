//! LabVIEW measurement files (.lvm): tables in segments, each behind a header of its own.
//!
//! Format: Specification for the LabVIEW Measurement File (.lvm), National Instruments. Segments that continue each other
//! are one record.

use super::columns::column;
use super::style::TableStyle;
use crate::budget::Budget;
use crate::error::snippet;
use crate::measured::content_problem::ContentProblem;
use crate::measured::unit_label;
use rotordyn_signal::record::{Axis, AxisQuantity, Kind, MeasuredData, Points, Record, Values};

const TITLE: &str = "LabVIEW Measurement";
const END_OF_HEADER: &str = "***End_of_Header***";
const ADVICE: &str = "copy the file again, or export it as a text table";

/// Whether a text is a LabVIEW measurement file.
pub(super) fn is_lvm(text: &str) -> bool {
    text.starts_with(TITLE)
}

/// Columns of the abscissa.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Abscissas {
    No,
    One,
    Multi,
}

/// What the header of the file states.
struct FileHeader {
    separator: char,
    decimal_comma: bool,
    abscissas: Abscissas,
}

/// A channel of a segment.
#[derive(Default)]
struct Channel {
    name: String,
    unit: String,
    date: String,
    quantity: String,
    start: Option<f64>,
    step: Option<f64>,
    samples: Option<f64>,
    x: Vec<f64>,
    y: Vec<f64>,
}

/// Records of a text that is an .lvm file.
///
/// # Errors
/// No numbers, a cell that is no number, an abscissa that does not increase, or contents that exceed the budget.
pub(super) fn parse(text: &str, budget: &Budget) -> Result<MeasuredData, ContentProblem> {
    let mut lines = text.lines().enumerate().map(|(k, line)| (k + 1, line));
    let mut out = MeasuredData::default();
    let (mut comments, mut segments) = (0_usize, 0_usize);
    let header = file_header(&mut lines, &mut out);
    let style = TableStyle::new(header.separator, header.decimal_comma);
    let mut open: Vec<Channel> = Vec::new();
    let mut rows: Vec<Row> = Vec::new();
    // None within a header.
    let mut plan: Option<Plan> = None;
    while let Some((number, line)) = lines.next() {
        if line.trim().is_empty() {
            continue;
        }
        let cells = style.split(line);
        let key = cells.first().copied().unwrap_or_default();
        if key == "***Start_Special***" {
            skip_special(&mut lines, number, &mut out)?;
            continue;
        }
        if key == "Channels" {
            plan = None;
        }
        match &plan {
            Some(plan) => {
                budget.take_values::<[f64; 2]>(|| "the numbers".into(), cells.len())?;
                comments += plan.add(&cells, number, &style, &mut open)?;
            }
            None if key == "X_Value" => {
                finish(&mut open, &mut out, budget)?;
                let made = Plan::of(&cells, &rows, header.abscissas, budget)?;
                open = made.channels(&cells, &rows);
                segments += 1;
                plan = Some(made);
                rows.clear();
            }
            None if key == END_OF_HEADER => {}
            None => {
                let bytes = line.len() + cells.len() * size_of::<String>() + size_of::<Row>();
                budget.take(|| "the header".into(), bytes as u64)?;
                rows.push(Row { cells: cells.iter().map(|cell| (*cell).to_owned()).collect() });
            }
        }
    }
    if !rows.is_empty() && !open.is_empty() {
        out.left_out.push("a header at the end, without numbers".into());
    }
    finish(&mut open, &mut out, budget)?;
    name_packets(&mut out, segments);
    if out.records.is_empty() {
        return Err(ContentProblem::new(
            "the LabVIEW file contains no line of numbers behind a line `X_Value`",
            ADVICE,
        ));
    }
    if comments > 0 {
        out.left_out.push(format!("{comments} comments of the column Comment"));
    }
    Ok(out)
}

/// A line of a segment's header: a name, and a value for every channel.
struct Row {
    cells: Vec<String>,
}

/// The header of the file, up to its end.
fn file_header<'a>(lines: &mut impl Iterator<Item = (usize, &'a str)>, out: &mut MeasuredData) -> FileHeader {
    let mut header = FileHeader { separator: '\t', decimal_comma: false, abscissas: Abscissas::One };
    for (_, line) in lines.by_ref() {
        if line.starts_with(END_OF_HEADER) {
            break;
        }
        let Some((key, value)) = line.split_once(['\t', ',']) else { continue };
        let value = value.trim_end_matches(['\t', ',']).trim();
        match key.trim() {
            "Separator" if value.eq_ignore_ascii_case("comma") => header.separator = ',',
            "Decimal_Separator" => header.decimal_comma = value.starts_with(',') || value.is_empty(),
            "X_Columns" => {
                header.abscissas = match value.to_ascii_lowercase().as_str() {
                    "no" => Abscissas::No,
                    "multi" => Abscissas::Multi,
                    _ => Abscissas::One,
                };
            }
            "Description" | "Project" if out.title.is_empty() && !value.is_empty() => {
                out.title = value.into()
            }
            // Who measured changes no number.
            "Notes" | "Description" | "Project" if !value.is_empty() => {
                out.left_out.push(format!("{} (text \"{}\")", key.trim(), snippet(value)));
            }
            _ => {}
        }
    }
    header
}

/// Skips a block of another program.
fn skip_special<'a>(
    lines: &mut impl Iterator<Item = (usize, &'a str)>,
    start: usize,
    out: &mut MeasuredData,
) -> Result<(), ContentProblem> {
    let end = lines.find(|(_, line)| line.starts_with("***End_Special***"));
    let (end, _) = end.ok_or_else(|| {
        ContentProblem::new(format!("the special block of line {start} has no end"), ADVICE)
    })?;
    out.left_out.push(format!("the special block of lines {start} to {end}"));
    Ok(())
}

/// Which cell of a data line belongs to which channel.
struct Plan {
    /// Cells of the abscissa and of the values of each channel.
    channels: Vec<(Option<usize>, usize)>,
    comment: Option<usize>,
}

impl Plan {
    /// From the line of names, `X_Value`, names, `Comment`.
    fn of(
        names: &[&str],
        rows: &[Row],
        abscissas: Abscissas,
        budget: &Budget,
    ) -> Result<Self, ContentProblem> {
        let last = names.iter().rposition(|name| !name.is_empty());
        let comment = last.filter(|at| names[*at] == "Comment");
        let end = comment.unwrap_or(names.len());
        let channels: Vec<_> = match abscissas {
            Abscissas::Multi => (0..end / 2).map(|k| (Some(2 * k), 2 * k + 1)).collect(),
            Abscissas::One => (1..end).map(|k| (Some(0), k)).collect(),
            Abscissas::No => (1..end).map(|k| (None, k)).collect(),
        };
        // A line of names may end in a separator.
        let stated = rows.iter().find(|row| row.cells.first().is_some_and(|key| key == "Channels"));
        let stated = stated.and_then(|row| row.cells.get(1)?.parse::<usize>().ok());
        let channels: Vec<_> = channels
            .into_iter()
            .filter(|(_, at)| stated.is_some() || !names[*at].is_empty())
            .take(stated.unwrap_or(usize::MAX))
            .collect();
        budget.objects("channels", channels.len())?;
        if channels.is_empty() {
            return Err(ContentProblem::new("a line `X_Value` of the LabVIEW file names no channel", ADVICE));
        }
        Ok(Self { channels, comment })
    }

    fn channels(&self, names: &[&str], rows: &[Row]) -> Vec<Channel> {
        let value = |key: &str, k: usize| {
            let row = rows.iter().rev().find(|row| row.cells.first().is_some_and(|first| first == key))?;
            row.cells.get(k + 1).filter(|cell| !cell.is_empty())
        };
        let text = |key: &str, k: usize| value(key, k).cloned().unwrap_or_default();
        let number = |key: &str, k: usize| value(key, k).and_then(|cell| cell.replace(',', ".").parse().ok());
        let channel = |(k, &(_, at)): (usize, &(Option<usize>, usize))| Channel {
            name: Some(names[at])
                .filter(|name| !name.is_empty())
                .map_or(format!("channel_{}", k + 1), str::to_owned),
            unit: text("Y_Unit_Label", k),
            date: format!("{} {}", text("Date", k), text("Time", k)).trim().to_owned(),
            quantity: text("X_Dimension", k),
            start: number("X0", k),
            step: number("Delta_X", k),
            samples: number("Samples", k),
            ..Channel::default()
        };
        self.channels.iter().enumerate().map(channel).collect()
    }

    /// Adds a line of numbers; the number of its comments.
    fn add(
        &self,
        cells: &[&str],
        number: usize,
        style: &TableStyle,
        channels: &mut [Channel],
    ) -> Result<usize, ContentProblem> {
        let real = |at: usize, channel: &Channel| -> Result<Option<f64>, ContentProblem> {
            let cell = cells.get(at).copied().unwrap_or_default();
            let value = style.value(cell).filter(|value| value.is_none_or(|value| value.im == 0.0));
            let value = value.ok_or_else(|| {
                let (cell, name) = (snippet(cell), snippet(&channel.name));
                ContentProblem::new(
                    format!("`{cell}` in line {number}, channel `{name}`, is not a number"),
                    ADVICE,
                )
            })?;
            Ok(value.map(|value| value.re))
        };
        for (channel, &(x, y)) in channels.iter_mut().zip(&self.channels) {
            // Channels of fewer samples end in empty cells.
            let Some(value) = real(y, channel)? else { continue };
            if let Some(x) = x {
                let at = real(x, channel)?;
                channel.x.extend(at);
            }
            channel.y.push(value);
        }
        let comment = self.comment.and_then(|at| cells.get(at)).is_some_and(|cell| !cell.is_empty());
        Ok(usize::from(comment))
    }
}

/// Deviation from the end of a segment over the step, up to which the next one continues it.
const CONTINUES: f64 = 0.05;

/// Adds the channels of a segment to the records.
fn finish(
    channels: &mut Vec<Channel>,
    out: &mut MeasuredData,
    budget: &Budget,
) -> Result<(), ContentProblem> {
    for channel in channels.drain(..).filter(|channel| !channel.y.is_empty()) {
        let Channel { name, unit, date, quantity, start, step, samples, x, y } = channel;
        if let Some(samples) = samples.filter(|samples| *samples != y.len() as f64) {
            out.notes.push(format!("`{name}` has {} values, its header states {samples}", y.len()));
        }
        let step = step.filter(|step| *step > 0.0 && step.is_finite());
        let abscissa = match quantity.as_str() {
            "" | "Time" => AxisQuantity::Time,
            "Frequency" => AxisQuantity::Frequency,
            _ => AxisQuantity::Unknown,
        };
        let listed = x.len() == y.len() && y.len() > 1;
        let (axis, source) = match step {
            // The printed abscissa has few digits.
            Some(step) => {
                let start = start.or_else(|| x.first().copied().filter(|_| listed)).unwrap_or(0.0);
                (Axis::uniform(abscissa, start, step), format!("`Delta_X` ({step})"))
            }
            None if listed => {
                if let Some(k) = x.windows(2).position(|pair| pair[0] >= pair[1] || pair[0].is_nan()) {
                    let problem =
                        format!("`X_Value` of `{name}` does not increase after its value {}", k + 1);
                    return Err(ContentProblem::new(problem, ADVICE));
                }
                (Axis::from_points(abscissa, x.clone()), "`X_Value`".into())
            }
            None => (Axis::UNKNOWN, String::new()),
        };
        let column = column(&name);
        let stated = if unit.is_empty() { column.stated } else { unit };
        let si = unit_label::si(&stated);
        let mut values = Values::Real(y);
        if let Some(si) = &si {
            values.scale(si.numerator, si.divisor);
        }
        let kind = if axis.quantity == AxisQuantity::Frequency { Kind::Spectrum } else { Kind::Time };
        let mut record = Record::new(&column.name, kind, axis, values, si.as_ref().map_or("", |si| &si.name));
        record.file_unit = stated;
        record.date = date;
        if let Some(record) = continued(record, out) {
            budget.objects("records", 1)?;
            if !source.is_empty() {
                out.axis_sources.push((record.name.clone(), source));
            }
            out.records.push(record);
        }
    }
    Ok(())
}

/// Notes channels of several packets that do not go on in one another: they stay channels of their own.
fn name_packets(out: &mut MeasuredData, segments: usize) {
    if segments < 2 {
        return;
    }
    let mut counts: Vec<(&str, usize)> = Vec::new();
    for record in &out.records {
        match counts.iter_mut().find(|(name, _)| *name == record.name) {
            Some((_, count)) => *count += 1,
            None => counts.push((&record.name, 1)),
        }
    }
    let several: Vec<(&str, usize)> = counts.into_iter().filter(|(_, count)| *count > 1).collect();
    let Some((first, count)) = several.first() else { return };
    let more = if several.len() > 1 { " and others" } else { "" };
    let note = format!(
        "`{first}`{more} comes in {count} packets with a header each, whose times do not go on: each is a channel of its own, the \
         second is `{first} (2)`"
    );
    out.notes.push(note);
}

/// Seconds of a day of a text `DATE HH:MM:SS.ffff` with milliseconds or finer, and its date.
fn time_of_day(stamp: &str) -> Option<(&str, f64)> {
    let (date, time) = stamp.rsplit_once(' ')?;
    let time = time.replace(',', ".");
    let mut parts = time.split(':');
    let (hours, minutes) = (parts.next()?.parse::<f64>().ok()?, parts.next()?.parse::<f64>().ok()?);
    let seconds = parts.next()?;
    seconds.split_once('.').filter(|(_, digits)| digits.len() >= 3)?;
    Some((date, 3600.0 * hours + 60.0 * minutes + seconds.parse::<f64>().ok()?))
}

/// Seconds from the start of one packet to that of another of the same day by their dates and times.
fn seconds_between(first: &str, next: &str) -> Option<f64> {
    let ((day, start), (its_day, end)) = (time_of_day(first)?, time_of_day(next)?);
    (day == its_day).then_some(end - start)
}

/// Appends a record to the last one of its name, if it goes on where that ends; the record itself if not.
///
/// By its first abscissa, or, where that begins anew, by the date and time of its header.
fn continued(record: Record, out: &mut MeasuredData) -> Option<Record> {
    let Some(last) = out.records.iter_mut().rev().find(|last| last.name == record.name) else {
        return Some(record);
    };
    let (Points::Uniform { start, step }, Points::Uniform { start: next, step: its }) =
        (&last.axis.points, &record.axis.points)
    else {
        return Some(record);
    };
    let end = start + last.values.len() as f64 * step;
    let by_clock = seconds_between(&last.date, &record.date).map(|passed| start + passed);
    let begins_anew = *next == *start;
    let at = if begins_anew { by_clock.unwrap_or(*next) } else { *next };
    // Clocks are read to parts of a sample only.
    let near = if begins_anew { 0.5 } else { CONTINUES };
    let goes_on = step == its && (at - end).abs() <= near * step && last.file_unit == record.file_unit;
    match (&mut last.values, record.values) {
        (Values::Real(values), Values::Real(more)) if goes_on && last.axis.quantity == AxisQuantity::Time => {
            values.extend(more);
            None
        }
        (_, values) => Some(Record { values, ..record }),
    }
}
