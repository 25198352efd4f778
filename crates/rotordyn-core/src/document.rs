//! Results as named quantities with units: what goes to files, declared once for each result.
//!
//! A result builds its [`Document`] beside its type. The JSON document, the results file (HDF5) and tables are written
//! from it by one writer per format, none of which knows the result:
//!
//! | value | JSON | HDF5 |
//! |---|---|---|
//! | text, number, integer, flag | value | attribute of the group |
//! | array | nested lists; complex: `re`, `im` | data set with its unit and dimension scales |
//! | group | object | group |
//! | groups by name | list of objects with the name under `key` | a group each |
//! | table | list of objects, one a row | a data set for each column, first dimension the row |
//! | table within a table | list in each row | data sets of \[row, inner row\], padded with NaN |
//!
//! A document also says what is shown of it without further code: tables with a heading in the terminal, arrays marked as
//! drawn in a line figure over their axis.
//!
//! Names are those of both formats; [`in_json`], [`in_hdf5`] and [`named`] state exceptions, [`quantity`] the rule of the
//! JSON names. A name in HDF5 may contain `/`; an empty one puts the members into the surrounding group.

mod rows;

use crate::series::Series;
use rotordyn_linalg::Complex64;
use std::borrow::Cow;

pub use rows::{Column, Rows};

/// Revolutions per minute of 1 rad/s.
pub const TO_RPM: f64 = 60.0 / std::f64::consts::TAU;

/// A group of named values.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Document<'a> {
    pub fields: Vec<Field<'a>>,
}

/// A named value.
#[derive(Clone, Debug, PartialEq)]
pub struct Field<'a> {
    pub names: Names,
    pub value: Value<'a>,
}

/// Names of a value in JSON and in HDF5; `None` in a format that does not have it.
#[derive(Clone, Debug, PartialEq)]
pub struct Names {
    pub json: Option<String>,
    pub hdf5: Option<String>,
}

/// A value of a document.
#[derive(Clone, Debug, PartialEq)]
pub enum Value<'a> {
    Text(String),
    /// A number and its unit.
    Number(f64, String),
    Integer(i64),
    Flag(bool),
    Texts(Vec<String>),
    /// Not known: null in JSON, no attribute in HDF5.
    Missing,
    Array(Array<'a>),
    Group(Document<'a>),
    /// Groups by name; in JSON the name stands under `key`.
    Groups {
        key: &'static str,
        groups: Vec<(String, Document<'a>)>,
    },
    Table(Table<'a>),
    /// In HDF5 only.
    Stored(StoredArray),
}

/// Real values in row-major order that are read when they are written.
#[derive(Clone, Debug, PartialEq)]
pub struct StoredArray {
    pub shape: Vec<usize>,
    pub values: Series,
    pub unit: String,
    /// Dimensions and the names of their axes.
    pub axes: Vec<(usize, String)>,
}

/// Values in row-major order.
#[derive(Clone, Debug, PartialEq)]
pub struct Array<'a> {
    pub shape: Vec<usize>,
    pub data: Data<'a>,
    pub unit: String,
    /// Dimensions and the names of their axes, data sets in HDF5.
    pub axes: Vec<(usize, String)>,
    pub missing: MissingCell,
    /// Whether a line figure shows it over its axis.
    pub drawn: bool,
}

/// Data of an array.
#[derive(Clone, Debug, PartialEq)]
pub enum Data<'a> {
    Real(Cow<'a, [f64]>),
    Complex(Cow<'a, [Complex64]>),
    Integers(Vec<Option<i64>>),
    Flags(Vec<bool>),
    /// `None` is null in JSON and an empty text in HDF5.
    Texts(Vec<Option<String>>),
}

/// Form of a row's cell in JSON if all its numbers are NaN.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum MissingCell {
    /// null for every number.
    #[default]
    Numbers,
    /// One null.
    Null,
    /// The key is omitted.
    Omitted,
    /// The whole row is null.
    Row,
}

/// Rows of the same columns.
#[derive(Clone, Debug, PartialEq)]
pub struct Table<'a> {
    pub rows: Count,
    /// Arrays with the row as first dimension; groups of columns; tables within the rows.
    pub columns: Document<'a>,
    /// Name of the column (HDF5) that is the axis of the others.
    pub axis: Option<String>,
    /// Heading in the terminal, which prints only tables with a heading.
    pub heading: Option<String>,
}

/// Number of rows of a table.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Count {
    /// One record instead of a list: no dimension of rows.
    One,
    Many(usize),
    /// The table stands in the rows of another, with these numbers of rows.
    Within(Vec<usize>),
}

/// A part of a document that is replaced as a whole when it is computed again.
#[derive(Clone, Debug, PartialEq)]
pub struct Section<'a> {
    /// Key in JSON.
    pub json: &'static str,
    /// Whether the key holds the list of all sections with this key.
    pub listed: bool,
    /// Path of the group in HDF5.
    pub hdf5: String,
    pub content: Document<'a>,
}

impl<'a> Section<'a> {
    /// An object under `json`, and the group `/hdf5`.
    pub fn new(json: &'static str, hdf5: impl AsRef<str>, content: Document<'a>) -> Self {
        Self { json, listed: false, hdf5: format!("/{}", hdf5.as_ref()), content }
    }

    /// An element of the list `json`, and the group `/hdf5`.
    pub fn listed(json: &'static str, hdf5: impl AsRef<str>, content: Document<'a>) -> Self {
        Self { listed: true, ..Self::new(json, hdf5, content) }
    }
}

impl From<&str> for Names {
    fn from(name: &str) -> Self {
        named(name, name)
    }
}

impl From<String> for Names {
    fn from(name: String) -> Self {
        named(name.clone(), name)
    }
}

/// Different names in JSON and HDF5.
pub fn named(json: impl Into<String>, hdf5: impl Into<String>) -> Names {
    Names { json: Some(json.into()), hdf5: Some(hdf5.into()) }
}

/// A value that only JSON has.
pub fn in_json(name: impl Into<String>) -> Names {
    Names { json: Some(name.into()), hdf5: None }
}

/// A value that only HDF5 has.
pub fn in_hdf5(name: impl Into<String>) -> Names {
    Names { json: None, hdf5: Some(name.into()) }
}

/// Names by the rule of most results: JSON has the unit as suffix, `speed_rpm` for a speed in rad/s; HDF5 is in SI.
pub fn quantity(name: &str, unit: &str) -> Names {
    let suffix = match unit {
        "rad/s" => "rpm",
        "Hz" => "hz",
        "N" => "n",
        "N/m" => "n_per_m",
        "m" => "m",
        "s" => "s",
        "rad" => "rad",
        _ => return name.into(),
    };
    named(format!("{name}_{suffix}"), name)
}

impl Names {
    /// Factor from the value to the number in JSON: rad/s become rpm under a name with that suffix.
    pub fn json_factor(&self, unit: &str) -> Option<f64> {
        let to_rpm = unit == "rad/s" && self.json.as_ref().is_some_and(|name| name.ends_with("_rpm"));
        to_rpm.then_some(TO_RPM)
    }
}

impl<'a> Document<'a> {
    pub fn new() -> Self {
        Self::default()
    }

    /// Adds a value.
    pub fn with(mut self, names: impl Into<Names>, value: Value<'a>) -> Self {
        self.fields.push(Field { names: names.into(), value });
        self
    }

    pub fn text(self, names: impl Into<Names>, text: impl Into<String>) -> Self {
        self.with(names, Value::Text(text.into()))
    }

    pub fn number(self, names: impl Into<Names>, unit: &str, value: f64) -> Self {
        self.with(names, Value::Number(value, unit.into()))
    }

    pub fn optional(self, names: impl Into<Names>, unit: &str, value: Option<f64>) -> Self {
        self.with(names, value.map_or(Value::Missing, |value| Value::Number(value, unit.into())))
    }

    /// A number with the names of [`quantity`].
    pub fn quantity(self, name: &str, unit: &str, value: f64) -> Self {
        self.number(quantity(name, unit), unit, value)
    }

    pub fn integer(self, names: impl Into<Names>, value: usize) -> Self {
        self.count(names, value as u64)
    }

    /// A number of steps or iterations, below 2⁶³.
    pub fn count(self, names: impl Into<Names>, value: u64) -> Self {
        self.with(names, Value::Integer(i64::try_from(value).unwrap_or(i64::MAX)))
    }

    pub fn flag(self, names: impl Into<Names>, value: bool) -> Self {
        self.with(names, Value::Flag(value))
    }

    /// One-dimensional numbers.
    pub fn numbers(self, names: impl Into<Names>, unit: &str, data: impl Into<Cow<'a, [f64]>>) -> Self {
        let data = data.into();
        self.array(names, Array::new(&[data.len()], unit, Data::Real(data)))
    }

    /// One-dimensional texts.
    pub fn texts<T: AsRef<str>>(self, names: impl Into<Names>, texts: impl IntoIterator<Item = T>) -> Self {
        let data: Vec<_> = texts.into_iter().map(|text| Some(text.as_ref().to_string())).collect();
        self.array(names, Array::new(&[data.len()], "", Data::Texts(data)))
    }

    pub fn array(self, names: impl Into<Names>, array: Array<'a>) -> Self {
        self.with(names, Value::Array(array))
    }

    /// Values that are read when they are written, in HDF5 only.
    pub fn stored(self, hdf5: &str, array: StoredArray) -> Self {
        self.with(in_hdf5(hdf5), Value::Stored(array))
    }

    pub fn group(self, names: impl Into<Names>, members: Document<'a>) -> Self {
        self.with(names, Value::Group(members))
    }

    pub fn groups(
        self,
        names: impl Into<Names>,
        key: &'static str,
        groups: impl IntoIterator<Item = (String, Document<'a>)>,
    ) -> Self {
        self.with(names, Value::Groups { key, groups: groups.into_iter().collect() })
    }

    /// Objects of different keys, a list in JSON only.
    pub fn list(self, json: &str, objects: impl IntoIterator<Item = Document<'a>>) -> Self {
        let groups = objects.into_iter().map(|object| (String::new(), object));
        self.groups(in_json(json), "", groups)
    }

    /// Adds the values of another document.
    pub fn and(mut self, other: Document<'a>) -> Self {
        self.fields.extend(other.fields);
        self
    }

    /// Adds the values of a document if there is one.
    pub fn and_if<T>(self, found: Option<T>, build: impl FnOnce(Self, T) -> Self) -> Self {
        match found {
            Some(found) => build(self, found),
            None => self,
        }
    }
}

impl<'a> Array<'a> {
    pub fn new(shape: &[usize], unit: &str, data: Data<'a>) -> Self {
        let missing = MissingCell::default();
        Self { shape: shape.into(), data, unit: unit.into(), axes: Vec::new(), missing, drawn: false }
    }

    /// Real numbers.
    pub fn real(shape: &[usize], unit: &str, data: impl Into<Cow<'a, [f64]>>) -> Self {
        Self::new(shape, unit, Data::Real(data.into()))
    }

    /// Complex numbers.
    pub fn complex(shape: &[usize], unit: &str, data: impl Into<Cow<'a, [Complex64]>>) -> Self {
        Self::new(shape, unit, Data::Complex(data.into()))
    }

    /// Texts.
    pub fn texts<T: AsRef<str>>(shape: &[usize], texts: impl IntoIterator<Item = T>) -> Self {
        let data = texts.into_iter().map(|text| Some(text.as_ref().to_string())).collect();
        Self::new(shape, "", Data::Texts(data))
    }

    /// Indices.
    pub fn indices(indices: &[usize]) -> Self {
        let data = indices.iter().map(|&k| i64::try_from(k).ok()).collect();
        Self::new(&[indices.len()], "1", Data::Integers(data))
    }

    /// Has a line figure of it, of one dimension, over its axis.
    pub fn drawn(mut self) -> Self {
        self.drawn = true;
        self
    }

    /// Names the axis of a dimension.
    pub fn over(mut self, dimension: usize, axis: &str) -> Self {
        self.axes.push((dimension, axis.into()));
        self
    }
}

impl Data<'_> {
    pub fn len(&self) -> usize {
        match self {
            Self::Real(values) => values.len(),
            Self::Complex(values) => values.len(),
            Self::Integers(values) => values.len(),
            Self::Flags(values) => values.len(),
            Self::Texts(values) => values.len(),
        }
    }

    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }
}

/// Formats a number with about `digits` significant digits: fixed-point if short, otherwise with an exponent.
pub fn number(value: f64, digits: usize) -> String {
    if value == 0.0 {
        return "0".into();
    }
    let exponent = value.abs().log10().floor();
    if !exponent.is_finite() {
        return value.to_string();
    }
    if (-3.0..6.0).contains(&exponent) {
        let decimals = (digits as f64 - 1.0 - exponent).max(0.0) as usize;
        format!("{value:.decimals$}")
    } else {
        format!("{value:.*e}", digits.saturating_sub(1))
    }
}

#[cfg(test)]
mod tests {
    use super::number;

    #[test]
    fn number_significant_digits() {
        assert_eq!(number(1234.5678, 5), "1234.6");
        assert_eq!(number(0.012_345, 3), "0.0123");
        assert_eq!(number(2.0e7, 3), "2.00e7");
        assert_eq!(number(-0.5, 2), "-0.50");
        assert_eq!(number(0.0, 2), "0");
    }
}
