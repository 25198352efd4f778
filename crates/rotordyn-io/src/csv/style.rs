//! How the numbers of a table are written: separator, decimal sign, cells.

use std::borrow::Cow;

use super::date_time::Stamp;
use crate::measured::stated_value::without_groups;
use rotordyn_signal::Complex;

/// A real or complex value; `None` for an empty cell.
pub(super) type Cell = Option<Complex<f64>>;

/// What programs write for a value that is missing or no number.
const MISSING: [&str; 10] =
    ["#n/a", "n/a", "na", "-nan", "nan(ind)", "-nan(ind)", "nan(snan)", "1.#qnan", "1.#ind", "-1.#ind"];

/// Separator and decimal sign of a table.
#[derive(Clone, Copy)]
pub(super) struct TableStyle {
    /// A blank means any number of blanks.
    pub separator: char,
    pub decimal_comma: bool,
    /// Whether the other mark may stand between groups of three digits: "1,500.0", "1.500,0".
    pub groups: bool,
    /// Whether a separator between quotes is part of a cell.
    pub quotes: bool,
    /// First cells of every line that are a date and a time.
    pub stamps: usize,
}

impl TableStyle {
    pub fn new(separator: char, decimal_comma: bool) -> Self {
        TableStyle { separator, decimal_comma, groups: false, quotes: true, stamps: 0 }
    }

    /// The style in which every cell of a line is a number, after a date and a time; its decimal sign is not known yet.
    pub fn of(line: &str) -> Option<TableStyle> {
        let quotes = if line.contains('"') { &[true, false][..] } else { &[true] };
        let separators = ['\t', ';', ',', ' '];
        let styles = quotes.iter().flat_map(|quotes| separators.map(|separator| (separator, *quotes)));
        styles.into_iter().find_map(|(separator, quotes)| {
            let mut style = TableStyle { quotes, groups: true, ..Self::new(separator, false) };
            let cells = style.split(line);
            // A single cell has no separator, unless it is between quotes.
            let is_separated = cells.len() > 1
                || style.separator == ' '
                || !line.contains([',', ';', '\t'])
                || quotes && line.trim().starts_with('"');
            style.stamps = Stamp::cells(&cells);
            let numbers = &cells[style.stamps..];
            let comma = TableStyle { decimal_comma: true, ..style };
            let is_number = |cell: &&str| style.value(cell).is_some() || comma.value(cell).is_some();
            let fits = is_separated && numbers.iter().any(|c| !c.is_empty()) && numbers.iter().all(is_number);
            fits.then_some(TableStyle { groups: false, ..style })
        })
    }

    /// The cells of a line without blanks and quotes around them; two quotes within quotes are kept as they are.
    pub fn split<'a>(&self, line: &'a str) -> Vec<&'a str> {
        if self.quotes && line.contains('"') {
            return self.split_quoted(line);
        }
        let clean = |cell: &'a str| cell.trim().trim_matches('"').trim();
        match self.separator {
            ' ' => line.split_whitespace().map(clean).collect(),
            separator => line.split(separator).map(clean).collect(),
        }
    }

    /// As RFC 4180 has it: separators within the quotes around a cell belong to it.
    fn split_quoted<'a>(&self, line: &'a str) -> Vec<&'a str> {
        let blanks = self.separator == ' ';
        let ends = |c: char| if blanks { c.is_whitespace() } else { c == self.separator };
        let pad = |c: char| c.is_whitespace() && c != self.separator;
        let mut cells = Vec::new();
        let mut rest = line.trim_end_matches(['\r', '\n']);
        loop {
            rest = if blanks { rest.trim_start() } else { rest.trim_start_matches(pad) };
            if blanks && rest.is_empty() {
                return cells;
            }
            let (cell, after) = match closing_quote(rest, &ends) {
                Some(at) => (rest[1..at].trim(), &rest[at + 1..]),
                None => {
                    let end = rest.find(ends).unwrap_or(rest.len());
                    (rest[..end].trim().trim_matches('"').trim(), &rest[end..])
                }
            };
            cells.push(cell);
            let after = if blanks { after } else { after.trim_start_matches(pad) };
            let Some(separator) = after.chars().next() else { return cells };
            rest = &after[separator.len_utf8()..];
        }
    }

    /// A number with a decimal point and without marks between groups; `None` if a mark is at a wrong place.
    pub fn plain<'a>(&self, cell: &'a str) -> Option<Cow<'a, str>> {
        let (decimal, other) = if self.decimal_comma { (',', '.') } else { ('.', ',') };
        match cell.contains(other) {
            true if self.groups => without_groups(cell, decimal).map(Cow::from),
            true => None,
            false if self.decimal_comma => Some(cell.replace(',', ".").into()),
            false => Some(cell.into()),
        }
    }

    /// The cell's value: `Some(None)` for an empty one, `None` if it is not a number.
    pub fn value(&self, cell: &str) -> Option<Cell> {
        if cell.is_empty() {
            return Some(None);
        }
        let plain = self.plain(cell);
        if let Some(number) = plain.as_ref().and_then(|plain| plain.parse::<f64>().ok()) {
            return Some(Some(number.into()));
        }
        if MISSING.iter().any(|missing| cell.eq_ignore_ascii_case(missing)) {
            return Some(Some(f64::NAN.into()));
        }
        if let Some(sign) = cell.to_ascii_lowercase().strip_suffix("1.#inf") {
            return matches!(sign, "" | "+" | "-").then(|| {
                let infinity = if sign == "-" { f64::NEG_INFINITY } else { f64::INFINITY };
                Some(infinity.into())
            });
        }
        let plain = plain?;
        // Fortran's exponents: 1.25D-03.
        if let Some((mantissa, exponent)) = plain.split_once(['d', 'D'])
            && let Ok(number) = format!("{mantissa}e{exponent}").parse::<f64>()
        {
            return Some(Some(number.into()));
        }
        complex(&plain).map(Some)
    }
}

/// Place of the quote that ends a cell which begins with one; `None` if no separator or end follows it.
fn closing_quote(text: &str, ends: &impl Fn(char) -> bool) -> Option<usize> {
    let inside = text.strip_prefix('"')?;
    let mut marks = inside.match_indices('"').map(|(at, _)| at + 1).peekable();
    while let Some(at) = marks.next() {
        // Two quotes stand for one.
        if marks.next_if_eq(&(at + 1)).is_some() {
            continue;
        }
        let behind = text[at + 1..].trim_start_matches(|c: char| c.is_whitespace() && !ends(c));
        return (behind.is_empty() || behind.starts_with(ends)).then_some(at);
    }
    None
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
