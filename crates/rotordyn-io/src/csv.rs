//! CSV with a header of names and units, '.' as decimal sign, constant step.

mod columns;
mod date_time;
mod decimal_sign;
pub(crate) mod encoding;
mod lvm;
mod polar;
mod read;
mod settings;
mod style;
mod table_axis;
mod written_digits;

pub use date_time::date_seconds;
pub use read::read;

use std::fmt::Write as _;
use std::path::Path;

use crate::atomic_file;
use crate::error::Error;
use rotordyn_signal::record::{AxisQuantity, Record, RecordError, Values};

/// One column: a name such as `B_ax`, its unit such as `m/s^2`, and its values.
#[derive(Clone, Copy, Debug)]
pub struct Column<'a> {
    pub name: &'a str,
    pub unit: &'a str,
    pub values: &'a [f64],
}

impl Column<'_> {
    /// Name with unit in letters, digits and underscores: `B_ax` in m/s² becomes `B_ax_m_s2`.
    pub fn header(&self) -> String {
        let mut out = String::new();
        for c in self.name.chars().chain(['_']).chain(self.unit.chars()) {
            match c {
                '²' => out.push('2'),
                '³' => out.push('3'),
                '°' => out.push_str("deg"),
                'µ' | 'μ' => out.push('u'),
                '^' => {}
                c if c.is_alphanumeric() => out.push(c),
                _ if out.is_empty() || out.ends_with('_') => {}
                _ => out.push('_'),
            }
        }
        out.trim_end_matches('_').to_owned()
    }
}

/// Columns as CSV text; numbers in the shortest form that reads back exactly.
///
/// The last cells of shorter columns are empty.
pub fn to_csv(columns: &[Column]) -> String {
    let mut out = columns.iter().map(Column::header).collect::<Vec<_>>().join(",");
    out.push('\n');
    let rows = columns.iter().map(|c| c.values.len()).max().unwrap_or(0);
    for row in 0..rows {
        for (k, column) in columns.iter().enumerate() {
            if k > 0 {
                out.push(',');
            }
            if let Some(value) = column.values.get(row) {
                // Writing to a String cannot fail.
                let _ = write!(out, "{value:e}");
            }
        }
        out.push('\n');
    }
    out
}

/// Writes a table of any columns.
///
/// # Errors
/// [`Error::Environment`] when the file cannot be written.
pub fn write(path: &Path, columns: &[Column]) -> Result<(), Error> {
    atomic_file::write(path, to_csv(columns).as_bytes()).map_err(Error::of_file("write", path))
}

/// Writes channels of one constant sample rate, with the first column `time_s` = t₀ + k/f_s.
///
/// `rate`: f_s \[Hz\]; `start`: t₀ \[s\].
///
/// # Errors
/// [`Error::Environment`] when the file cannot be written.
pub fn write_series(path: &Path, rate: f64, start: f64, channels: &[Column]) -> Result<(), Error> {
    let rows = channels.iter().map(|c| c.values.len()).max().unwrap_or(0);
    let time: Vec<f64> = (0..rows).map(|k| start + k as f64 / rate).collect();
    let mut columns = vec![Column { name: "time", unit: "s", values: &time }];
    columns.extend(channels);
    write(path, &columns)
}

/// Writes records over one axis, with the first column `time_s` or `frequency_Hz`; complex ones as `name_re`,
/// `name_im`.
///
/// # Errors
/// Axes that differ or are unknown, or a file that cannot be written.
pub fn write_records(path: &Path, records: &[&Record]) -> Result<(), Error> {
    let Some(first) = records.first() else { return write(path, &[]) };
    let count = first.values.len();
    for other in records {
        if other.axis != first.axis || other.values.len() != count {
            return Err(RecordError::axes_differ(first, other).into());
        }
    }
    let points =
        first.axis.points(count).ok_or_else(|| RecordError::NoRate { channel: first.name.clone() })?;
    let name = match first.axis.quantity {
        AxisQuantity::Time => "time",
        AxisQuantity::Frequency => "frequency",
        AxisQuantity::Speed => "speed",
        AxisQuantity::Order => "order",
        AxisQuantity::Unknown => "x",
    };
    let mut parts: Vec<(String, &str, Vec<f64>)> = vec![(name.into(), first.axis.quantity.unit(), points)];
    for record in records {
        let unit = if record.unit == "1" { "" } else { record.unit.as_str() };
        match &record.values {
            Values::Real(values) => parts.push((record.name.clone(), unit, values.clone())),
            Values::Complex(values) => {
                let part = |end: &str| format!("{}_{end}", record.name);
                parts.push((part("re"), unit, values.iter().map(|v| v.re).collect()));
                parts.push((part("im"), unit, values.iter().map(|v| v.im).collect()));
            }
        }
    }
    let columns: Vec<Column> =
        parts.iter().map(|(name, unit, values)| Column { name, unit, values }).collect();
    write(path, &columns)
}
