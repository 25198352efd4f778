//! Reads CSV and other text tables, of this and other programs, as records.
//!
//! The separator (comma, semicolon, tab or blanks) is the one that splits the first data line into numbers; cells may be
//! between quotes. A table has one decimal sign, a point or a comma, and the other mark stands between groups of thousands:
//! all numbers of the table decide which it is, or a line `# decimal sign: ,`. Lines that begin with `#`, `%` or `//` are comments. Names
//! may contain units, `B_ax_m_s2`, `acc [g]`, `time (ms)`, `a / m/s²`, or a line of units follows them. Columns `x_re`,
//! `x_im` are one complex record, as are magnitudes or levels with their phases over frequency; cells may be complex, `(1.0-2.0j)`. The axis is a column of times or frequencies, of
//! dates, the first column of a table without names if it increases uniformly, or the rate that a line states.

use std::collections::{HashMap, HashSet};
use std::path::Path;

use super::columns::{Column, columns};
use super::date_time::{Stamp, seconds};
use super::encoding::decoded;
use super::settings::{stated, unit_of_line};
use super::style::TableStyle;
use super::written_digits::Digits;
use super::{decimal_sign, lvm, polar, table_axis};
use crate::budget::{self, Budget, Exceeded, Limits};
use crate::error::{Error, snippet};
use crate::measured::arrays::guess_kind;
use crate::measured::content_problem::ContentProblem;
use crate::measured::unit_label;
use rotordyn_signal::Complex;
use rotordyn_signal::record::{Axis, Kind, MeasuredData, Record, Values};

/// Reads a table, or a LabVIEW measurement file; `given_rate` \[Hz\] holds where two sampling rates are stated.
///
/// # Errors
/// The file cannot be read, contains no numbers, a line has another number of cells, a cell is not a number,
/// an axis does not increase, dates may be read in two ways, two sampling rates are stated, or the contents exceed the
/// budget.
pub fn read(path: &Path, limits: &Limits, given_rate: Option<f64>) -> Result<(MeasuredData, Budget), Error> {
    let (bytes, budget) = budget::read_file(path, limits)?;
    let mut notes = Vec::new();
    let text = decoded(bytes, &budget, &mut notes).map_err(|exceeded| exceeded.of_file(path))?;
    let stem = path.file_stem().unwrap_or_default().to_string_lossy();
    // Lines that end in a carriage return alone.
    let text = match text.contains('\n') || !text.contains('\r') {
        true => text,
        false => {
            let taken = budget.take(|| "the text".into(), text.len() as u64);
            taken.map_err(|exceeded| exceeded.of_file(path))?;
            text.replace('\r', "\n")
        }
    };
    let text = text.trim_start_matches('\u{feff}');
    let found =
        if lvm::is_lvm(text) { lvm::parse(text, &budget) } else { parse(text, &stem, &budget, given_rate) };
    let mut found = found.map_err(|problem| problem.of_file(path))?;
    found.notes.splice(0..0, notes);
    Ok((found, budget))
}

const FORMAT_HINT: &str = "write one line of names and then numbers, separated by commas";

/// Lines that are longer are searched for their number of cells before they are split \[bytes\].
const LONG_LINE: usize = 100_000;

/// Refuses a line of too many cells.
fn check_width(line: &str, budget: &Budget) -> Result<(), Exceeded> {
    if line.len() < LONG_LINE {
        return Ok(());
    }
    let separated = |separator: u8| line.bytes().filter(|&b| b == separator).count() + 1;
    let cells = [b',', b';', b'\t'].map(separated).into_iter().chain([line.split_whitespace().count()]);
    cells.max().map_or(Ok(()), |most| budget.check_objects("columns", most))
}

/// Whether a line states a rate, a step, the decimal sign or a unit.
fn is_setting(line: &str) -> bool {
    stated(line).is_some() || decimal_sign::stated_sign(line).is_some() || unit_of_line(line).is_some()
}

fn is_comment(line: &str) -> bool {
    line.starts_with(['#', '%']) || line.starts_with("//")
}

/// Whether a line says nothing: separators only, or the separator for Excel.
fn is_bare(line: &str) -> bool {
    line.trim_matches([' ', '\t', ',', ';', '"', '#', '%', '/', '-', '=']).is_empty()
        || line.starts_with("sep=")
}

fn parse(
    text: &str,
    stem: &str,
    budget: &Budget,
    given_rate: Option<f64>,
) -> Result<MeasuredData, ContentProblem> {
    let lines = text.lines().enumerate().map(|(k, line)| (k + 1, line)).filter(|(_, l)| !l.trim().is_empty());
    // The lines before the numbers: rates, names and units are among them.
    let mut before = Vec::new();
    let mut data = lines.clone();
    let (first, style) = loop {
        let here = data.clone();
        let Some((_, line)) = data.next() else {
            return Err(ContentProblem::new("the file contains no line of numbers", FORMAT_HINT));
        };
        if !is_comment(line) {
            check_width(line, budget)?;
            if let Some(style) = TableStyle::of(line) {
                data = here;
                break (line, style);
            }
        }
        budget.take_values::<[&str; 2]>(|| "the header".into(), 1)?;
        before.push(line);
    };
    let settings: Vec<_> = before.iter().filter_map(|line| stated(line)).collect();
    let last_comment = before.last().copied().filter(|line| is_comment(line) && !is_setting(line));
    let header_lines: Vec<&str> =
        before.iter().copied().filter(|line| !is_comment(line) && !is_setting(line)).collect();
    let stated_sign = before.iter().find_map(|line| decimal_sign::stated_sign(line));
    let numbers = data.clone().map(|(_, line)| line).filter(|line| !is_comment(line));
    let style = style.with_decimal_sign(numbers, header_lines.last().copied(), stated_sign)?;
    let width = style.split(first).len();
    budget.objects("columns", width)?;
    let (mut columns, used) = columns(&header_lines, last_comment, style, width, stem);
    let nameless = used.lines.is_empty() && !used.comment;
    if let Some(unit) = before.iter().find_map(|line| unit_of_line(line)) {
        let first = usize::from(nameless && columns.len() > 1);
        for column in columns.iter_mut().skip(first).filter(|column| column.may_have_unit()) {
            (column.stated, column.si) = (unit.to_owned(), unit_label::si(unit));
        }
    }

    // The first column of a table without names may be the times.
    if let Some(first) = columns.first_mut().filter(|_| nameless) {
        first.digits = Some(Digits::default());
    }
    let mut sign = if style.decimal_comma { Some(',') } else { stated_sign };
    let mut stamps = Vec::new();
    for (number, line) in data.filter(|(_, line)| !is_comment(line)) {
        let mut cells = style.split(line);
        // The last line may have no separator at its end.
        if cells.len() + 1 == width && columns.last().is_some_and(|column| column.length == 0) {
            cells.push("");
        }
        if cells.len() != width {
            let problem = format!("line {number} has {} cells, the first data line has {width}", cells.len());
            return Err(ContentProblem::new(
                problem,
                "the file is cut off or damaged: copy or export it again",
            ));
        }
        // A column and the record of it.
        budget.take_values::<[f64; 2]>(|| "the numbers".into(), width)?;
        if style.stamps > 0 {
            budget.take_values::<Stamp>(|| "the times".into(), 1)?;
            let text = cells[..style.stamps].join(" ");
            let stamp = Stamp::read(&text).ok_or_else(|| {
                let text = snippet(&text);
                ContentProblem::new(
                    format!("`{text}` in line {number} is not a date and a time"),
                    FORMAT_HINT,
                )
            })?;
            stamps.push(stamp);
        }
        for (column, cell) in columns.iter_mut().zip(&cells[style.stamps..]) {
            let value = style.value(cell).ok_or_else(|| {
                let (cell, name) = (snippet(cell), snippet(&column.name));
                ContentProblem::new(
                    format!("`{cell}` in line {number}, column `{name}`, is not a number"),
                    FORMAT_HINT,
                )
            })?;
            match style.groups {
                true => column.push(value, &style.plain(cell).unwrap_or_default()),
                false => column.push(value, cell),
            }
            if sign.is_none() && cell.contains(['.', ',']) {
                sign = Some('.');
            }
        }
    }
    let mut out = MeasuredData::default();
    // A separator at the end of every line makes an empty column without a name.
    let is_named = |name: &str| !nameless && !name.starts_with(&format!("{stem}_"));
    let empty = columns.iter().filter(|c| c.length == 0 && is_named(&c.name));
    out.left_out.extend(empty.map(|column| format!("{} (an empty column)", column.name)));
    columns.retain(|c| c.length > 0);
    out.left_out.extend(unread_lines(&before, &header_lines, &used.lines, used.comment));
    let mut date = String::new();
    let mut times = None;
    if style.stamps > 0 {
        date = style.split(first)[..style.stamps].join(" ");
        times = Some(seconds(&stamps)?);
    }
    if style.separator == ',' && !style.decimal_comma {
        sign = Some('.');
    }
    let source = table_axis::Source { settings, sign, times, nameless, given_rate };
    let axis = table_axis::of_table(&mut columns, source, budget, &mut out)?;
    if axis.is_frequency() {
        out.notes.extend(polar::join(&mut columns));
    }
    records(columns, &axis, &mut out);
    out.records.iter_mut().for_each(|record| record.date.clone_from(&date));
    Ok(out)
}

/// What of the lines before the numbers says something that is not read, as one entry.
fn unread_lines(before: &[&str], header_lines: &[&str], used: &[usize], comment: bool) -> Option<String> {
    let used: Vec<&str> = used.iter().map(|&k| header_lines[k]).collect();
    let last = before.len().saturating_sub(1);
    let is_used = |k: usize, line: &str| {
        used.iter().any(|used| std::ptr::eq(*used, line)) || (comment && k == last) || is_setting(line)
    };
    let mut unread = before
        .iter()
        .enumerate()
        .filter(|(k, line)| !is_used(*k, line) && !is_bare(line))
        .map(|(_, line)| line);
    let first = unread.next()?;
    let (first, more) = (snippet(first.trim()), unread.count());
    Some(match more {
        0 => format!("a line before the numbers (`{first}`)"),
        more => format!("{} lines before the numbers (`{first}`, ...)", more + 1),
    })
}

/// The column `x_im` for each `x_re` of the same unit.
fn imaginary_parts(columns: &[Column]) -> HashMap<usize, usize> {
    let ending = |end: &str| {
        let mut found = HashMap::new();
        for (k, column) in columns.iter().enumerate() {
            if let Some(base) = column.name.strip_suffix(end) {
                found.entry((base.to_owned(), column.stated.clone())).or_insert(k);
            }
        }
        found
    };
    let (re, im) = (ending("_re"), ending("_im"));
    re.iter().filter_map(|(of, k)| Some((*k, *im.get(of)?))).collect()
}

/// Adds the record of every column over the axis.
fn records(mut columns: Vec<Column>, axis: &table_axis::TableAxis, out: &mut MeasuredData) {
    let partners = imaginary_parts(&columns);
    let is_partner: HashSet<usize> = partners.values().copied().collect();
    for k in (0..columns.len()).filter(|k| !is_partner.contains(k)) {
        let partner = partners.get(&k);
        let im = match partner {
            Some(&at) => std::mem::take(&mut columns[at].re),
            None => std::mem::take(&mut columns[k].im),
        };
        let column = &mut columns[k];
        let mut name = column.name.clone();
        let is_complex = partner.is_some() || !im.is_empty();
        // Shorter columns end in empty cells.
        let mut re = std::mem::take(&mut column.re);
        re.truncate(column.length);
        let mut values = match is_complex {
            true => {
                let im = im.into_iter().chain(std::iter::repeat(f64::NAN));
                Values::Complex(re.into_iter().zip(im).map(|(re, im)| Complex::new(re, im)).collect())
            }
            false => Values::Real(re),
        };
        if let Some(si) = &column.si {
            values.scale(si.numerator, si.divisor);
        }
        let axis_of_record: Axis = axis.of(column.length);
        if partner.is_some() {
            name.truncate(name.len() - "_re".len());
        }
        let kind = guess_kind(&name, &values, axis_of_record.quantity);
        let unit = match &column.si {
            Some(si) => si.name.clone(),
            None if kind == Kind::Coherence && column.stated.is_empty() => "1".into(),
            None => String::new(),
        };
        if !axis.source.is_empty() {
            out.axis_sources.push((name.clone(), axis.source.clone()));
        }
        let mut record = Record::new(&name, kind, axis_of_record, values, &unit);
        record.file_unit = if unit == "1" { unit } else { column.stated.clone() };
        out.records.push(record);
    }
}
