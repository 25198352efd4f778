//! Columns of a table, each from a function of its rows.

use super::{Array, Count, Data, Document, Field, MissingCell, Names, Table, Value, in_json, quantity};
use rotordyn_linalg::Complex64;

/// A named value of a record type, with its SI unit, for tables and files.
pub type Column<T> = (&'static str, &'static str, fn(&T) -> f64);

/// Rows of records of one type, and the columns declared so far.
pub struct Rows<'a, 'r, T> {
    rows: Vec<&'r T>,
    columns: Document<'a>,
    axis: Option<String>,
    heading: Option<String>,
}

impl<'a> Document<'a> {
    pub fn table<T>(self, names: impl Into<Names>, rows: Rows<'a, '_, T>) -> Self {
        self.with(names, Value::Table(rows.table()))
    }

    /// A single row of a table's columns.
    pub fn record<T>(self, names: impl Into<Names>, rows: Rows<'a, '_, T>) -> Self {
        self.with(names, Value::Table(Table { rows: Count::One, ..rows.table() }))
    }
}

impl<'a, 'r, T> Rows<'a, 'r, T> {
    pub fn of(rows: impl IntoIterator<Item = &'r T>) -> Self {
        Self { rows: rows.into_iter().collect(), columns: Document::new(), axis: None, heading: None }
    }

    /// Names the column (in HDF5) over which the others are given.
    pub fn over(mut self, axis: &str) -> Self {
        self.axis = Some(axis.into());
        self
    }

    /// Prints the table in the terminal under this heading.
    pub fn heading(mut self, heading: impl Into<String>) -> Self {
        self.heading = Some(heading.into());
        self
    }

    /// The finished table.
    pub fn table(self) -> Table<'a> {
        let rows = Count::Many(self.rows.len());
        Table { rows, columns: self.columns, axis: self.axis, heading: self.heading }
    }

    fn column(mut self, names: impl Into<Names>, cell: &[usize], unit: &str, data: Data<'a>) -> Self {
        let shape: Vec<usize> = [self.rows.len()].into_iter().chain(cell.iter().copied()).collect();
        let names = names.into();
        assert_eq!(
            shape.iter().product::<usize>(),
            data.len(),
            "{names:?}: every row has one cell of this shape"
        );
        let value = Value::Array(Array::new(&shape, unit, data));
        self.columns.fields.push(Field { names, value });
        self
    }

    /// The last column, to state more of it.
    fn last(&mut self) -> Option<&mut Array<'a>> {
        match self.columns.fields.last_mut()?.value {
            Value::Array(ref mut array) => Some(array),
            _ => None,
        }
    }

    /// Names the axis of a dimension of the last column's cells.
    pub fn cells_over(mut self, dimension: usize, axis: &str) -> Self {
        if let Some(array) = self.last() {
            array.axes.push((dimension + 1, axis.into()));
        }
        self
    }

    /// States how JSON shows cells of the last column without any number.
    pub fn missing(mut self, form: MissingCell) -> Self {
        if let Some(array) = self.last() {
            array.missing = form;
        }
        self
    }

    /// Has a line figure of the last column over the table's axis.
    pub fn drawn(mut self) -> Self {
        if let Some(array) = self.last() {
            array.drawn = true;
        }
        self
    }

    pub fn number(self, names: impl Into<Names>, unit: &str, of: impl Fn(&'r T) -> f64) -> Self {
        let data = self.rows.iter().map(|row| of(row)).collect::<Vec<_>>();
        self.column(names, &[], unit, Data::Real(data.into()))
    }

    /// Several numbers, and how JSON shows missing ones.
    pub fn columns(self, columns: &[Column<T>], missing: MissingCell) -> Self {
        columns
            .iter()
            .fold(self, |rows, (name, unit, value)| rows.number(*name, unit, value).missing(missing))
    }

    /// A number with the names of [`quantity`].
    pub fn quantity(self, name: &str, unit: &str, of: impl Fn(&'r T) -> f64) -> Self {
        self.number(quantity(name, unit), unit, of)
    }

    /// A number that may be missing: NaN.
    pub fn optional(self, names: impl Into<Names>, unit: &str, of: impl Fn(&'r T) -> Option<f64>) -> Self {
        self.number(names, unit, |row| of(row).unwrap_or(f64::NAN))
    }

    pub fn integer(self, names: impl Into<Names>, of: impl Fn(&'r T) -> usize) -> Self {
        self.optional_integer(names, |row| Some(of(row)))
    }

    pub fn optional_integer(self, names: impl Into<Names>, of: impl Fn(&'r T) -> Option<usize>) -> Self {
        let data = self.rows.iter().map(|row| i64::try_from(of(row)?).ok()).collect();
        self.column(names, &[], "1", Data::Integers(data))
    }

    pub fn signed(self, names: impl Into<Names>, of: impl Fn(&'r T) -> i64) -> Self {
        let data = self.rows.iter().map(|row| Some(of(row))).collect();
        self.column(names, &[], "1", Data::Integers(data))
    }

    pub fn flag(self, names: impl Into<Names>, of: impl Fn(&'r T) -> bool) -> Self {
        let data = self.rows.iter().map(|row| of(row)).collect();
        self.column(names, &[], "1", Data::Flags(data))
    }

    pub fn text<S: AsRef<str>>(self, names: impl Into<Names>, of: impl Fn(&'r T) -> S) -> Self {
        self.optional_text(names, |row| Some(of(row)))
    }

    pub fn optional_text<S: AsRef<str>>(
        self,
        names: impl Into<Names>,
        of: impl Fn(&'r T) -> Option<S>,
    ) -> Self {
        let data = self.rows.iter().map(|row| of(row).map(|text| text.as_ref().to_string())).collect();
        self.column(names, &[], "", Data::Texts(data))
    }

    /// Numbers of one shape in every row.
    pub fn numbers<V: AsRef<[f64]>>(
        self,
        names: impl Into<Names>,
        unit: &str,
        cell: &[usize],
        of: impl Fn(&'r T) -> V,
    ) -> Self {
        let data = self.cells_of(of);
        self.column(names, cell, unit, Data::Real(data.into()))
    }

    /// The cells of all rows, one after the other.
    fn cells_of<N: Clone, V: AsRef<[N]>>(&self, of: impl Fn(&'r T) -> V) -> Vec<N> {
        let mut cells = Vec::new();
        self.rows.iter().for_each(|row| cells.extend_from_slice(of(row).as_ref()));
        cells
    }

    pub fn complex(self, names: impl Into<Names>, unit: &str, of: impl Fn(&'r T) -> Complex64) -> Self {
        self.complex_numbers(names, unit, &[], |row| [of(row)])
    }

    pub fn complex_numbers<V: AsRef<[Complex64]>>(
        self,
        names: impl Into<Names>,
        unit: &str,
        cell: &[usize],
        of: impl Fn(&'r T) -> V,
    ) -> Self {
        let data = self.cells_of(of);
        self.column(names, cell, unit, Data::Complex(data.into()))
    }

    /// Texts of one number in every row.
    pub fn texts(
        self,
        names: impl Into<Names>,
        count: usize,
        of: impl Fn(&'r T) -> Vec<Option<String>>,
    ) -> Self {
        let data = self.rows.iter().flat_map(|row| of(row)).collect();
        self.column(names, &[count], "", Data::Texts(data))
    }

    /// Texts, different in number from row to row: JSON only.
    pub fn lists(self, json: &str, of: impl Fn(&'r T) -> Vec<String>) -> Self {
        let lists: Vec<Vec<String>> = self.rows.iter().map(|row| of(row)).collect();
        let counts = lists.iter().map(Vec::len).collect();
        self.within(json, counts, Document::new().texts("", lists.concat()))
    }

    /// Numbers, different in number from row to row: JSON only.
    pub fn series(self, json: &str, unit: &str, of: impl Fn(&'r T) -> &'r [f64]) -> Self {
        let series: Vec<&[f64]> = self.rows.iter().map(|row| of(row)).collect();
        let counts = series.iter().map(|values| values.len()).collect();
        // The numbers have no name of their own that would state their unit.
        let factor = in_json(json).json_factor(unit).unwrap_or(1.0);
        let values: Vec<f64> = series.concat().iter().map(|value| value * factor).collect();
        self.within(json, counts, Document::new().numbers("", unit, values))
    }

    fn within(mut self, json: &str, counts: Vec<usize>, columns: Document<'a>) -> Self {
        let value = Value::Table(Table { rows: Count::Within(counts), columns, axis: None, heading: None });
        self.columns.fields.push(Field { names: in_json(json), value });
        self
    }

    /// Columns of a record in every row.
    pub fn group<U: 'r>(
        mut self,
        names: impl Into<Names>,
        pick: impl Fn(&'r T) -> &'r U,
        columns: impl FnOnce(Rows<'a, 'r, U>) -> Rows<'a, 'r, U>,
    ) -> Self {
        let inner = columns(Rows::of(self.rows.iter().map(|row| pick(row))));
        self.columns.fields.push(Field { names: names.into(), value: Value::Group(inner.columns) });
        self
    }

    /// A table in every row.
    pub fn nested<U: 'r>(
        mut self,
        names: impl Into<Names>,
        pick: impl Fn(&'r T) -> &'r [U],
        columns: impl FnOnce(Rows<'a, 'r, U>) -> Rows<'a, 'r, U>,
    ) -> Self {
        let counts = self.rows.iter().map(|row| pick(row).len()).collect();
        let inner = columns(Rows::of(self.rows.iter().flat_map(|row| pick(row))));
        let value = Value::Table(Table { rows: Count::Within(counts), ..inner.table() });
        self.columns.fields.push(Field { names: names.into(), value });
        self
    }
}
