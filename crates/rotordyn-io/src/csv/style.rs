//! How the numbers of a table are written: separator, decimal sign, cells.

use std::borrow::Cow;

use super::date_time::Stamp;
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
    /// First cells of every line that are a date and a time.
    pub stamps: usize,
}

impl TableStyle {
    /// The style in which every cell of a line is a number, after a date and a time.
    pub fn of(line: &str) -> Option<TableStyle> {
        let styles =
            [('\t', false), (';', false), (',', false), (' ', false), ('\t', true), (';', true), (' ', true)];
        styles.into_iter().find_map(|(separator, decimal_comma)| {
            let mut style = TableStyle { separator, decimal_comma, stamps: 0 };
            let cells = style.split(line);
            // A single cell has no separator.
            let is_separated = cells.len() > 1 || style.separator == ' ' || !line.contains([',', ';', '\t']);
            style.stamps = Stamp::cells(&cells);
            let numbers = &cells[style.stamps..];
            let fits = is_separated
                && numbers.iter().any(|c| !c.is_empty())
                && numbers.iter().all(|c| style.value(c).is_some());
            fits.then_some(style)
        })
    }

    pub fn split<'a>(&self, line: &'a str) -> Vec<&'a str> {
        let clean = |cell: &'a str| cell.trim().trim_matches('"').trim();
        match self.separator {
            ' ' => line.split_whitespace().map(clean).collect(),
            separator => line.split(separator).map(clean).collect(),
        }
    }

    /// The cell's value: `Some(None)` for an empty one, `None` if it is not a number.
    pub fn value(&self, cell: &str) -> Option<Cell> {
        if cell.is_empty() {
            return Some(None);
        }
        let cell: Cow<str> = if self.decimal_comma { cell.replace(',', ".").into() } else { cell.into() };
        if let Ok(number) = cell.parse::<f64>() {
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
        // Fortran's exponents: 1.25D-03.
        if let Some((mantissa, exponent)) = cell.split_once(['d', 'D'])
            && let Ok(number) = format!("{mantissa}e{exponent}").parse::<f64>()
        {
            return Some(Some(number.into()));
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
