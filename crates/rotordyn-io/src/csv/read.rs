//! Reads CSV and other text tables, of this and other programs, as records.
//!
//! The separator (comma, semicolon, tab or blanks) is the one that splits the first data line into numbers; a
//! decimal comma is accepted with the other three. Lines that begin with `#`, `%` or `//` are comments. Names
//! may contain units, `B_ax_m_s2`, `acc [g]`, `time (ms)`, or a line of units follows them. Columns `x_re`,
//! `x_im` are one complex record; cells may be complex, `(1.0-2.0j)`.

use std::path::Path;

use crate::error::Error;
use crate::measured::arrays::guess_kind;
use crate::measured::unit_label::{self, SiUnit};
use rotordyn_signal::Complex;
use rotordyn_signal::record::{Axis, AxisQuantity, Kind, MeasuredData, Points, Record, Values};

/// A real or complex value; `None` for an empty cell.
type Cell = Option<Complex<f64>>;

/// Reads a table.
///
/// # Errors
/// The file cannot be read, contains no numbers, a line has another number of cells, a cell is not a number,
/// an axis does not increase.
pub fn read(path: &Path) -> Result<MeasuredData, Error> {
    let bytes = std::fs::read(path).map_err(Error::of_file("read", path))?;
    let text = match String::from_utf8(bytes) {
        Ok(text) => text,
        // Not UTF-8: Latin-1, which has degree signs.
        Err(error) => error.as_bytes().iter().map(|&b| char::from(b)).collect(),
    };
    let stem = path.file_stem().unwrap_or_default().to_string_lossy();
    parse(text.trim_start_matches('\u{feff}'), &stem).map_err(|(problem, advice)| Error::Content {
        path: path.into(),
        problem,
        advice: advice.into(),
    })
}

/// Error message and hint.
type ParseError = (String, &'static str);

const FORMAT_HINT: &str = "write one line of names and then numbers, separated by commas";

/// Separator and decimal sign of a table.
#[derive(Clone, Copy)]
struct TableStyle {
    /// A blank means any number of blanks.
    separator: char,
    decimal_comma: bool,
}

impl TableStyle {
    /// The style in which every cell of a line is a number.
    fn of(line: &str) -> Option<TableStyle> {
        let styles =
            [('\t', false), (';', false), (',', false), (' ', false), ('\t', true), (';', true), (' ', true)];
        styles.into_iter().map(|(separator, decimal_comma)| TableStyle { separator, decimal_comma }).find(
            |style| {
                let cells = style.split(line);
                // A single cell has no separator.
                let is_separated =
                    cells.len() > 1 || style.separator == ' ' || !line.contains([',', ';', '\t']);
                is_separated
                    && cells.iter().any(|c| !c.is_empty())
                    && cells.iter().all(|c| style.value(c).is_some())
            },
        )
    }

    fn split<'a>(&self, line: &'a str) -> Vec<&'a str> {
        let clean = |cell: &'a str| cell.trim().trim_matches('"').trim();
        match self.separator {
            ' ' => line.split_whitespace().map(clean).collect(),
            separator => line.split(separator).map(clean).collect(),
        }
    }

    /// The cell's value: `Some(None)` for an empty one, `None` if it is not a number.
    fn value(&self, cell: &str) -> Option<Cell> {
        if cell.is_empty() {
            return Some(None);
        }
        let cell = if self.decimal_comma { cell.replace(',', ".") } else { cell.to_owned() };
        if let Ok(number) = cell.parse::<f64>() {
            return Some(Some(number.into()));
        }
        if matches!(cell.to_ascii_lowercase().as_str(), "#n/a" | "n/a" | "na" | "-nan" | "1.#qnan") {
            return Some(Some(f64::NAN.into()));
        }
        complex(&cell).map(Some)
    }
}

/// `(1.0-2.0e-3j)`, `1+2i`, `-2j`.
fn complex(cell: &str) -> Option<Complex<f64>> {
    let inner = cell.trim_start_matches('(').trim_end_matches(')');
    let body = inner.strip_suffix(['j', 'i', 'J', 'I'])?;
    let sign = body
        .char_indices()
        .skip(1)
        .filter(|&(at, c)| matches!(c, '+' | '-') && !body[..at].ends_with(['e', 'E']));
    match sign.last() {
        Some((at, _)) => {
            Some(Complex::new(body[..at].trim().parse().ok()?, body[at..].replace(' ', "").parse().ok()?))
        }
        None => Some(Complex::new(0.0, body.parse().ok()?)),
    }
}

struct Column {
    name: String,
    /// As written.
    stated: String,
    si: Option<SiUnit>,
    cells: Vec<Cell>,
}

fn parse(text: &str, stem: &str) -> Result<MeasuredData, ParseError> {
    let lines: Vec<(usize, &str)> = text
        .lines()
        .enumerate()
        .map(|(k, line)| (k + 1, line))
        .filter(|(_, l)| !l.trim().is_empty())
        .collect();
    let is_comment = |line: &str| line.starts_with(['#', '%']) || line.starts_with("//");
    let found = lines.iter().enumerate().find_map(|(at, (_, line))| {
        let style = TableStyle::of(line).filter(|_| !is_comment(line))?;
        Some((at, style))
    });
    let (first, mut style) = found.ok_or(("the file contains no line of numbers".to_owned(), FORMAT_HINT))?;
    // Numbers with a decimal comma in one column look like two columns: the header line decides.
    let header_lines: Vec<&str> =
        lines[..first].iter().map(|(_, line)| *line).filter(|l| !is_comment(l)).collect();
    if let Some(head) = header_lines.last()
        && style.separator == ','
        && head.contains([';', '\t'])
    {
        style = TableStyle { separator: if head.contains(';') { ';' } else { '\t' }, decimal_comma: true };
    }
    let width = style.split(lines[first].1).len();
    let mut columns =
        header(&header_lines, lines[..first].iter().map(|(_, l)| *l).collect(), style, width, stem);

    for (number, line) in lines[first..].iter().filter(|(_, line)| !is_comment(line)) {
        let cells = style.split(line);
        if cells.len() != width {
            let problem = format!("line {number} has {} cells, the first data line has {width}", cells.len());
            return Err((problem, "the file is cut off or damaged: copy or export it again"));
        }
        for (column, cell) in columns.iter_mut().zip(cells) {
            let value = style.value(cell).ok_or_else(|| {
                (format!("`{cell}` in line {number}, column `{}`, is not a number", column.name), FORMAT_HINT)
            })?;
            column.cells.push(value);
        }
    }
    // A separator at the end of every line makes an empty column.
    columns.retain(|c| c.cells.iter().any(Option::is_some));
    records(columns)
}

/// Names and units of the columns from the lines before the numbers.
fn header(header_lines: &[&str], all: Vec<&str>, style: TableStyle, width: usize, stem: &str) -> Vec<Column> {
    let cells = |line: &str| -> Option<Vec<String>> {
        let cells: Vec<String> = match style.separator {
            // Names may contain blanks; then commas separate them.
            ' ' if line.contains(',') => line.split(',').map(|c| c.trim().to_owned()).collect(),
            _ => style.split(line).into_iter().map(str::to_owned).collect(),
        };
        (cells.len() == width).then_some(cells)
    };
    let mut rows: Vec<Vec<String>> = header_lines.iter().filter_map(|line| cells(line)).collect();
    if rows.is_empty() {
        // numpy.savetxt puts names into a comment.
        rows.extend(all.last().and_then(|line| cells(line.trim_start_matches(['#', '%', '/', ' ']))));
    }
    let units = match rows.len() {
        0 | 1 => None,
        _ => rows.last().filter(|row| {
            let bare =
                |cell: &String| unit_cell(cell).is_empty() || unit_label::si(unit_cell(cell)).is_some();
            row.iter().all(bare)
        }),
    };
    let names = if units.is_some() { rows.get(rows.len() - 2) } else { rows.last() };
    (0..width)
        .map(|k| {
            let alone = if width == 1 { stem.to_owned() } else { format!("{stem}_{}", k + 1) };
            let name = names.map(|row| row[k].clone()).filter(|name| !name.is_empty()).unwrap_or(alone);
            match units {
                Some(row) => {
                    let stated = unit_cell(&row[k]).to_owned();
                    Column { si: unit_label::si(&stated), name, stated, cells: Vec::new() }
                }
                None => column(&name),
            }
        })
        .collect()
}

fn unit_cell(cell: &str) -> &str {
    cell.trim_start_matches(['[', '(']).trim_end_matches([']', ')'])
}

/// A column from its name, with the unit in brackets or as a suffix.
fn column(name: &str) -> Column {
    for (open, close) in [('[', ']'), ('(', ')')] {
        if let Some(at) = name.find(open).filter(|_| name.ends_with(close)) {
            let (base, stated) = (name[..at].trim(), &name[at + 1..name.len() - 1]);
            if !base.is_empty() {
                return Column {
                    name: base.into(),
                    stated: stated.into(),
                    si: unit_label::si(stated),
                    cells: Vec::new(),
                };
            }
        }
    }
    match unit_label::split_unit_suffix(name) {
        Some((base, si)) => Column {
            name: base.into(),
            stated: name[base.len() + 1..].into(),
            si: Some(si),
            cells: Vec::new(),
        },
        None => Column { name: name.into(), stated: String::new(), si: None, cells: Vec::new() },
    }
}

/// Axis quantity of a column, by its name and unit; `None` if it is not an axis.
fn axis_of(column: &Column) -> Option<AxisQuantity> {
    let name = column.name.to_lowercase();
    let unit = column.si.as_ref().map(|si| si.name.as_str());
    match (name.as_str(), unit) {
        ("time" | "t" | "times" | "zeit" | "x", Some("s")) | ("time" | "t", None) => Some(AxisQuantity::Time),
        ("frequency" | "freq" | "f" | "frequencies" | "x", Some("Hz")) => Some(AxisQuantity::Frequency),
        ("frequency" | "freq" | "f", None) => Some(AxisQuantity::Frequency),
        _ => None,
    }
}

fn records(mut columns: Vec<Column>) -> Result<MeasuredData, ParseError> {
    let mut out = MeasuredData::default();
    let mut axis: Option<(AxisQuantity, Vec<f64>)> = None;
    let place = columns.iter().position(|c| axis_of(c).is_some()).filter(|_| columns.len() > 1);
    if let Some(at) = place {
        let column = columns.remove(at);
        let quantity = axis_of(&column).unwrap_or_default();
        let (up, down) = column.si.as_ref().map_or((1.0, 1.0), |si| (si.numerator, si.divisor));
        let points: Vec<f64> = column
            .cells
            .iter()
            .map(|c| c.map_or(f64::NAN, |v| if up == down { v.re } else { v.re * up / down }))
            .collect();
        if let Some(k) = points
            .windows(2)
            .position(|pair| !matches!(pair[0].partial_cmp(&pair[1]), Some(std::cmp::Ordering::Less)))
        {
            let problem = format!("`{}` does not increase after its value {}", column.name, k + 1);
            return Err((problem, "sort the lines, and remove duplicate and empty ones"));
        }
        if let Axis { points: Points::NonUniform(_), .. } = Axis::from_points(quantity, points.clone()) {
            out.notes.push(format!("`{}` is not uniformly spaced", column.name));
        }
        axis = Some((quantity, points));
    }
    let mut taken = vec![false; columns.len()];
    for k in 0..columns.len() {
        if taken[k] {
            continue;
        }
        let column = &columns[k];
        let partner = column.name.strip_suffix("_re").and_then(|base| {
            let is_partner =
                |c: &Column| c.name.strip_suffix("_im") == Some(base) && c.stated == column.stated;
            columns.iter().position(is_partner).map(|at| (base, at))
        });
        let mut name = column.name.clone();
        let mut values: Vec<Cell> = column.cells.clone();
        // Shorter columns end in empty cells.
        let length = values.iter().rposition(Option::is_some).map_or(0, |last| last + 1);
        values.truncate(length);
        let mut is_complex = values.iter().flatten().any(|v| v.im != 0.0);
        if let Some((base, at)) = partner {
            name = base.to_owned();
            (taken[at], is_complex) = (true, true);
            for (value, im) in values.iter_mut().zip(&columns[at].cells) {
                *value = value.zip(*im).map(|(re, im)| Complex::new(re.re, im.re));
            }
        }
        let filled = values.iter().map(|v| v.unwrap_or(Complex::new(f64::NAN, 0.0)));
        let mut values = match is_complex {
            true => Values::Complex(filled.collect()),
            false => Values::Real(filled.map(|v| v.re).collect()),
        };
        if let Some(si) = &column.si {
            values.scale(si.numerator, si.divisor);
        }
        let axis = match &axis {
            Some((quantity, points)) => Axis::from_points(*quantity, points[..length].to_vec()),
            None => Axis::UNKNOWN,
        };
        let kind = guess_kind(&name, &values, axis.quantity);
        let unit = match &column.si {
            Some(si) => si.name.clone(),
            None if kind == Kind::Coherence && column.stated.is_empty() => "1".into(),
            None => String::new(),
        };
        let mut record = Record::new(&name, kind, axis, values, &unit);
        record.file_unit = if unit == "1" { unit } else { column.stated.clone() };
        out.records.push(record);
    }
    Ok(out)
}
