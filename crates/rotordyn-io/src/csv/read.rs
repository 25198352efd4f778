//! Reads CSV and other text tables, of this and other programs, as records.
//!
//! The separator (comma, semicolon, tab or blanks) is the one that splits the first data line into numbers; a
//! decimal comma is accepted with the other three. Lines that begin with `#`, `%` or `//` are comments. Names
//! may contain units, `B_ax_m_s2`, `acc [g]`, `time (ms)`, or a line of units follows them. Columns `x_re`,
//! `x_im` are one complex record; cells may be complex, `(1.0-2.0j)`.

use std::borrow::Cow;
use std::collections::{HashMap, HashSet};
use std::path::Path;

use crate::budget::{self, Budget, Exceeded, Limits};
use crate::error::{Error, snippet};
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
/// an axis does not increase, or the contents exceed the budget.
pub fn read(path: &Path, limits: &Limits) -> Result<(MeasuredData, Budget), Error> {
    let (bytes, budget) = budget::read_file(path, limits)?;
    let mut notes = Vec::new();
    let text = decoded(bytes, &budget, &mut notes).map_err(|exceeded| exceeded.of_file(path))?;
    let stem = path.file_stem().unwrap_or_default().to_string_lossy();
    let text = text.trim_start_matches('\u{feff}');
    let mut found = parse(text, &stem, &budget).map_err(|error| error.of_file(path))?;
    found.notes.splice(0..0, notes);
    Ok((found, budget))
}

/// Text in UTF-8, or in UTF-16 with its byte order mark, else in Latin-1, which has degree signs.
fn decoded(bytes: Vec<u8>, budget: &Budget, notes: &mut Vec<String>) -> Result<String, Exceeded> {
    let utf_16: Option<fn([u8; 2]) -> u16> = match bytes {
        _ if bytes.starts_with(&[0xff, 0xfe]) => Some(u16::from_le_bytes),
        _ if bytes.starts_with(&[0xfe, 0xff]) => Some(u16::from_be_bytes),
        _ => None,
    };
    let text = || "the text".to_owned();
    let Some(unit) = utf_16 else {
        return String::from_utf8(bytes).or_else(|error| {
            budget.take(text, 2 * error.as_bytes().len() as u64)?;
            Ok(error.as_bytes().iter().map(|&b| char::from(b)).collect())
        });
    };
    // Two bytes become three at most.
    let mut out = String::from_utf8(budget.list(text, bytes.len() / 2 * 3)?).unwrap_or_default();
    let (pairs, rest) = bytes.as_chunks::<2>();
    let mut damaged = rest.len();
    for letter in char::decode_utf16(pairs.iter().map(|pair| unit(*pair))) {
        damaged += usize::from(letter.is_err());
        out.push(letter.unwrap_or(char::REPLACEMENT_CHARACTER));
    }
    if damaged > 0 {
        notes.push(format!("the text is damaged: {damaged} characters are not valid UTF-16"));
    }
    Ok(out)
}

/// Error message and hint.
struct ParseError(String, String);

impl ParseError {
    fn new(problem: String, advice: &str) -> Self {
        Self(problem, advice.into())
    }

    fn of_file(self, path: &Path) -> Error {
        Error::Content { path: path.into(), problem: self.0, advice: self.1 }
    }
}

impl From<Exceeded> for ParseError {
    fn from(exceeded: Exceeded) -> Self {
        Self(exceeded.to_string(), exceeded.advice())
    }
}

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
        let cell: Cow<str> = if self.decimal_comma { cell.replace(',', ".").into() } else { cell.into() };
        if let Ok(number) = cell.parse::<f64>() {
            return Some(Some(number.into()));
        }
        if ["#n/a", "n/a", "na", "-nan", "1.#qnan"].iter().any(|missing| cell.eq_ignore_ascii_case(missing)) {
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
    /// Real parts, NaN for empty cells.
    re: Vec<f64>,
    /// Imaginary parts; empty as long as all are zero.
    im: Vec<f64>,
    /// Number of cells up to the last that is not empty.
    length: usize,
}

impl Column {
    fn new(name: String, stated: String, si: Option<SiUnit>) -> Self {
        Column { name, stated, si, re: Vec::new(), im: Vec::new(), length: 0 }
    }

    fn push(&mut self, cell: Cell) {
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
}

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

fn parse(text: &str, stem: &str, budget: &Budget) -> Result<MeasuredData, ParseError> {
    let lines = text.lines().enumerate().map(|(k, line)| (k + 1, line)).filter(|(_, l)| !l.trim().is_empty());
    let is_comment = |line: &str| line.starts_with(['#', '%']) || line.starts_with("//");
    // The last lines before the numbers, with and without comments: units and names are among them.
    let (mut last_header, mut header_lines) = ("", Vec::new());
    let mut data = lines.clone();
    let (first, mut style) = loop {
        let before = data.clone();
        let Some((_, line)) = data.next() else {
            return Err(ParseError::new("the file contains no line of numbers".into(), FORMAT_HINT));
        };
        if !is_comment(line) {
            check_width(line, budget)?;
            if let Some(style) = TableStyle::of(line) {
                data = before;
                break (line, style);
            }
            budget.take_values::<&str>(|| "the header".into(), 1)?;
            header_lines.push(line);
        }
        last_header = line;
    };
    // Numbers with a decimal comma in one column look like two columns: the header line decides.
    if let Some(head) = header_lines.last()
        && style.separator == ','
        && head.contains([';', '\t'])
    {
        style = TableStyle { separator: if head.contains(';') { ';' } else { '\t' }, decimal_comma: true };
    }
    let width = style.split(first).len();
    budget.objects("columns", width)?;
    let mut columns = header(&header_lines, last_header, style, width, stem);

    for (number, line) in data.filter(|(_, line)| !is_comment(line)) {
        let cells = style.split(line);
        if cells.len() != width {
            let problem = format!("line {number} has {} cells, the first data line has {width}", cells.len());
            return Err(ParseError::new(problem, "the file is cut off or damaged: copy or export it again"));
        }
        // A column and the record of it.
        budget.take_values::<[f64; 2]>(|| "the numbers".into(), width)?;
        for (column, cell) in columns.iter_mut().zip(cells) {
            let value = style.value(cell).ok_or_else(|| {
                let (cell, name) = (snippet(cell), snippet(&column.name));
                ParseError::new(
                    format!("`{cell}` in line {number}, column `{name}`, is not a number"),
                    FORMAT_HINT,
                )
            })?;
            column.push(value);
        }
    }
    // A separator at the end of every line makes an empty column.
    columns.retain(|c| c.length > 0);
    records(columns, budget)
}

/// Names and units of the columns from the lines before the numbers.
fn header(header_lines: &[&str], last: &str, style: TableStyle, width: usize, stem: &str) -> Vec<Column> {
    let cells = |line: &str| -> Option<Vec<String>> {
        let cells: Vec<String> = match style.separator {
            // Names may contain blanks; then commas separate them.
            ' ' if line.contains(',') => line.split(',').map(|c| c.trim().to_owned()).collect(),
            _ => style.split(line).into_iter().map(str::to_owned).collect(),
        };
        (cells.len() == width).then_some(cells)
    };
    let mut rows: Vec<Vec<String>> =
        header_lines.iter().rev().filter_map(|line| cells(line)).take(2).collect();
    rows.reverse();
    if rows.is_empty() {
        // numpy.savetxt puts names into a comment.
        rows.extend(cells(last.trim_start_matches(['#', '%', '/', ' '])));
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
                    Column::new(name, stated.clone(), unit_label::si(&stated))
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
                return Column::new(base.into(), stated.into(), unit_label::si(stated));
            }
        }
    }
    match unit_label::split_unit_suffix(name) {
        Some((base, si)) => Column::new(base.into(), name[base.len() + 1..].into(), Some(si)),
        None => Column::new(name.into(), String::new(), None),
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

fn records(mut columns: Vec<Column>, budget: &Budget) -> Result<MeasuredData, ParseError> {
    let mut out = MeasuredData::default();
    let mut axis: Option<(AxisQuantity, Vec<f64>)> = None;
    let place = columns.iter().position(|c| axis_of(c).is_some()).filter(|_| columns.len() > 1);
    if let Some(at) = place {
        let column = columns.remove(at);
        let quantity = axis_of(&column).unwrap_or_default();
        let (up, down) = column.si.as_ref().map_or((1.0, 1.0), |si| (si.numerator, si.divisor));
        let points: Vec<f64> =
            column.re.iter().map(|v| if up == down { *v } else { v * up / down }).collect();
        if let Some(k) = points
            .windows(2)
            .position(|pair| !matches!(pair[0].partial_cmp(&pair[1]), Some(std::cmp::Ordering::Less)))
        {
            let problem = format!("`{}` does not increase after its value {}", column.name, k + 1);
            return Err(ParseError::new(problem, "sort the lines, and remove duplicate and empty ones"));
        }
        if let Axis { points: Points::NonUniform(_), .. } = Axis::from_points(quantity, points.clone()) {
            out.notes.push(format!("`{}` is not uniformly spaced", column.name));
            // Every record has its own list.
            let all = points.len().saturating_mul(columns.len());
            budget.take_values::<f64>(|| "the axes of the columns".into(), all)?;
        }
        axis = Some((quantity, points));
    }
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
        let axis = match &axis {
            Some((quantity, points)) => Axis::from_points(*quantity, points[..column.length].to_vec()),
            None => Axis::UNKNOWN,
        };
        if partner.is_some() {
            name.truncate(name.len() - "_re".len());
        }
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
