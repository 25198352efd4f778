//! Groups and data sets of a [`Document`]: see the table there.

use crate::error::Error;
use crate::hdf5::{Attribute, Store};
use rotordyn_core::document::{Array, Count, Data, Document, Field, Section, Table, Value};
use rotordyn_linalg::Complex64;

/// Writes a section below `root` ("" or a path), replacing an earlier one.
///
/// # Errors
/// The file cannot be written.
pub fn write_section(store: &Store, root: &str, section: &Section) -> Result<(), Error> {
    let at = format!("{root}{}", section.hdf5);
    store.remove(&at)?;
    write_document(store, &at, &section.content)
}

/// Writes the members of a document to a group ("" for the root); their names must not exist yet.
///
/// # Errors
/// The file cannot be written.
pub fn write_document(store: &impl Sink, group: &str, found: &Document) -> Result<(), Error> {
    let mut writer = Writer { store, scales: Vec::new() };
    writer.document(group, found)?;
    // An axis can stand behind the arrays over it.
    for Scale { array, dimension, axis } in &writer.scales {
        let label = axis.rsplit('/').next().unwrap_or(axis);
        store.axis(array, *dimension, axis, label)?;
    }
    Ok(())
}

/// An axis to be attached to a dimension.
struct Scale {
    array: String,
    dimension: usize,
    axis: String,
}

/// What takes the groups, data sets and attributes of a document: an HDF5 file, or a tree in memory.
pub trait Sink {
    /// Makes a group if it does not exist yet.
    fn group(&self, path: &str) -> Result<(), Error>;
    /// Attribute of a group.
    fn attribute(&self, group: &str, name: &str, value: Attribute) -> Result<(), Error>;
    /// Numbers in row-major order.
    fn numbers(&self, path: &str, shape: &[usize], values: &[f64], unit: &str) -> Result<(), Error>;
    fn complex(&self, path: &str, shape: &[usize], values: &[Complex64], unit: &str) -> Result<(), Error>;
    fn texts(&self, path: &str, shape: &[usize], texts: &[&str]) -> Result<(), Error>;
    /// Names the axis of a dimension of a data set.
    fn axis(&self, path: &str, dimension: usize, axis: &str, label: &str) -> Result<(), Error>;
}

impl Sink for Store {
    fn group(&self, path: &str) -> Result<(), Error> {
        self.create_group(path)
    }

    fn attribute(&self, group: &str, name: &str, value: Attribute) -> Result<(), Error> {
        self.set_attribute(group, name, value)
    }

    fn numbers(&self, path: &str, shape: &[usize], values: &[f64], unit: &str) -> Result<(), Error> {
        self.write(path, shape, values, &[("unit", Attribute::from(unit))])
    }

    fn complex(&self, path: &str, shape: &[usize], values: &[Complex64], unit: &str) -> Result<(), Error> {
        self.write_complex(path, shape, values, &[("unit", Attribute::from(unit))])
    }

    fn texts(&self, path: &str, shape: &[usize], texts: &[&str]) -> Result<(), Error> {
        self.write_text_array(path, shape, texts, &[])
    }

    fn axis(&self, path: &str, dimension: usize, axis: &str, label: &str) -> Result<(), Error> {
        self.attach_scale(path, dimension, axis, label)
    }
}

struct Writer<'a, S> {
    store: &'a S,
    scales: Vec<Scale>,
}

/// Form of a table's columns: what the dimension of rows becomes.
#[derive(Clone, Copy)]
struct Form<'a> {
    /// Path of the group in which the cells' axes stand.
    group: &'a str,
    /// Whether there is one row and no dimension of rows.
    one: bool,
    /// Path of the axis of the rows.
    axis: Option<&'a str>,
}

fn join(group: &str, name: &str) -> String {
    if name.is_empty() { group.into() } else { format!("{group}/{name}") }
}

impl<S: Sink> Writer<'_, S> {
    fn document(&mut self, group: &str, found: &Document) -> Result<(), Error> {
        self.store.group(group)?;
        for Field { names, value } in &found.fields {
            let Some(name) = &names.hdf5 else { continue };
            let at = join(group, name);
            match value {
                Value::Text(text) => self.attribute(&at, text.as_str())?,
                Value::Number(number, _) => self.attribute(&at, *number)?,
                Value::Integer(number) => self.attribute(&at, *number)?,
                Value::Flag(flag) => self.attribute(&at, i64::from(*flag))?,
                Value::Texts(texts) => self.attribute(&at, texts.clone())?,
                Value::Missing => {}
                Value::Array(array) => {
                    let axes = array.axes.iter().map(|(k, axis)| (*k, join(group, axis))).collect();
                    self.array(&at, &array.shape, &array.data, &array.unit, axes)?;
                }
                Value::Stored(stored) => {
                    let axes = stored.axes.iter().map(|(k, axis)| (*k, join(group, axis))).collect();
                    let data = Data::Real(stored.values.all()?);
                    self.array(&at, &stored.shape, &data, &stored.unit, axes)?;
                }
                Value::Group(members) => self.document(&at, members)?,
                Value::Groups { groups, .. } => {
                    groups.iter().try_for_each(|(name, members)| self.document(&join(&at, name), members))?;
                }
                Value::Table(table) => self.table(&at, table)?,
            }
        }
        Ok(())
    }

    fn attribute(&self, at: &str, value: impl Into<Attribute>) -> Result<(), Error> {
        let (object, name) = at.rsplit_once('/').unwrap_or(("", at));
        self.store.attribute(object, name, value.into())
    }

    fn table(&mut self, at: &str, table: &Table) -> Result<(), Error> {
        self.store.group(at)?;
        let axis = table.axis.as_ref().map(|axis| join(at, axis));
        let form = Form { group: at, one: table.rows == Count::One, axis: axis.as_deref() };
        self.columns(at, &table.columns, form, &mut Vec::new())
    }

    /// Columns of a table; `counts`: numbers of rows of the tables around it, from outside to inside.
    fn columns<'c>(
        &mut self,
        group: &str,
        columns: &'c Document,
        form: Form,
        counts: &mut Vec<&'c [usize]>,
    ) -> Result<(), Error> {
        for Field { names, value } in &columns.fields {
            let Some(name) = &names.hdf5 else { continue };
            let at = join(group, name);
            match value {
                Value::Array(array) => self.column(&at, array, form, counts)?,
                Value::Group(members) => self.columns(&at, members, form, counts)?,
                Value::Table(Table { rows: Count::Within(inner), columns, .. }) => {
                    counts.push(inner);
                    self.columns(&at, columns, form, counts)?;
                    counts.pop();
                }
                // No other value has rows.
                _ => {}
            }
        }
        Ok(())
    }

    fn column(&mut self, at: &str, array: &Array, form: Form, counts: &[&[usize]]) -> Result<(), Error> {
        let (mut shape, mut data) = (array.shape.clone(), array.data.clone());
        for counts in counts.iter().rev() {
            data = padded(&mut shape, data, counts);
        }
        let dimensions = shape.len() - array.shape.len();
        if form.one {
            shape.remove(0);
        }
        let shifted = |k: usize| (k + dimensions).saturating_sub(usize::from(form.one));
        let axes = array.axes.iter().map(|(k, axis)| (shifted(*k), join(form.group, axis)));
        let mut axes: Vec<_> = axes.collect();
        let has_axis = !matches!(data, Data::Texts(_));
        axes.extend(form.axis.filter(|axis| has_axis && *axis != at).map(|axis| (0, axis.to_string())));
        self.array(at, &shape, &data, &array.unit, axes)
    }

    fn array(
        &mut self,
        at: &str,
        shape: &[usize],
        data: &Data,
        unit: &str,
        axes: Vec<(usize, String)>,
    ) -> Result<(), Error> {
        let real = |values: Vec<f64>| self.store.numbers(at, shape, &values, unit);
        match data {
            Data::Real(values) => self.store.numbers(at, shape, values, unit)?,
            Data::Complex(values) => self.store.complex(at, shape, values, unit)?,
            Data::Integers(values) => {
                real(values.iter().map(|value| value.map_or(f64::NAN, |value| value as f64)).collect())?;
            }
            Data::Flags(values) => real(values.iter().map(|flag| f64::from(u8::from(*flag))).collect())?,
            Data::Texts(texts) => {
                let texts: Vec<&str> = texts.iter().map(|text| text.as_deref().unwrap_or_default()).collect();
                self.store.texts(at, shape, &texts)?;
            }
        }
        let scale = |(dimension, axis)| Scale { array: at.into(), dimension, axis };
        self.scales.extend(axes.into_iter().map(scale));
        Ok(())
    }
}

/// Rows of tables within rows as one array \[outer row, inner row, ...\], filled with missing values.
fn padded<'a>(shape: &mut Vec<usize>, data: Data<'a>, counts: &[usize]) -> Data<'a> {
    let cell: usize = shape[1..].iter().product();
    let longest = counts.iter().copied().max().unwrap_or(0);
    shape.splice(..1, [counts.len(), longest]);
    let nan = Complex64::new(f64::NAN, f64::NAN);
    match data {
        Data::Real(values) => Data::Real(fill(&values, counts, longest, cell, &f64::NAN).into()),
        Data::Complex(values) => Data::Complex(fill(&values, counts, longest, cell, &nan).into()),
        Data::Integers(values) => Data::Integers(fill(&values, counts, longest, cell, &None)),
        Data::Flags(values) => {
            let values: Vec<f64> = values.iter().map(|flag| f64::from(u8::from(*flag))).collect();
            Data::Real(fill(&values, counts, longest, cell, &f64::NAN).into())
        }
        Data::Texts(values) => Data::Texts(fill(&values, counts, longest, cell, &None)),
    }
}

fn fill<T: Clone>(values: &[T], counts: &[usize], longest: usize, cell: usize, missing: &T) -> Vec<T> {
    let mut out = Vec::with_capacity(counts.len() * longest * cell);
    let mut start = 0;
    for count in counts {
        let end = start + count * cell;
        out.extend_from_slice(&values[start..end]);
        out.extend(std::iter::repeat_n(missing, (longest - count) * cell).cloned());
        start = end;
    }
    out
}
