//! Values of a document as the cells of columns.

use super::columns::{Columns, joined};
use rotordyn_core::document::{Array, Count, Data, Document, Field, Names, Table, Value};

/// Greatest number of rows of a vector or matrix with a column for each component.
const MAX_COMPONENTS: usize = 6;

/// Name in JSON; of what only HDF5 has or names, that in HDF5.
pub(super) fn title<'f>(field: &'f Field) -> &'f str {
    let known = [&field.names.json, &field.names.hdf5];
    known.into_iter().flatten().map(String::as_str).find(|name| !name.is_empty()).unwrap_or_default()
}

/// What stands around a value.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Within {
    Document,
    /// The first dimension of arrays is the row.
    Table,
}

/// Adds the values of a field that are single in each row; the names of groups stand before those of their members.
pub(super) fn values(out: &mut Columns, prefix: &str, field: &Field, within: Within) {
    if field.names.json.is_none() {
        return;
    }
    let name = joined(prefix, title(field));
    match &field.value {
        Value::Text(text) => out.add(name, vec![text.clone()]),
        Value::Texts(texts) => out.add(name, vec![texts.join("; ")]),
        Value::Integer(value) => out.add(name, vec![value.to_string()]),
        Value::Flag(flag) => out.add(name, vec![flag.to_string()]),
        Value::Number(value, unit) => {
            let factor = field.names.json_factor(unit);
            let value = factor.map_or(*value, |factor| value * factor);
            out.add(with_unit(&name, unit, factor), vec![number(value)]);
        }
        Value::Group(members) => all_values(out, &name, members, within),
        Value::Table(Table { rows: Count::One, columns, .. }) => {
            all_values(out, &name, columns, Within::Table)
        }
        Value::Array(array) if array.axes.is_empty() => array_values(out, &name, &field.names, array, within),
        _ => {}
    }
}

/// As [`values`], of all fields.
pub(super) fn all_values(out: &mut Columns, prefix: &str, members: &Document, within: Within) {
    let axes = |field: &&Field| within == Within::Document && is_axis(members, field);
    members.fields.iter().filter(|field| !axes(field)).for_each(|field| values(out, prefix, field, within));
}

/// Whether other arrays of the document are given over this one.
pub(super) fn is_axis(found: &Document, field: &Field) -> bool {
    found.fields.iter().any(|other| match &other.value {
        Value::Array(array) => array.axes.iter().any(|(_, axis)| field.names.hdf5.as_deref() == Some(axis)),
        Value::Table(table) => is_axis(&table.columns, field),
        _ => false,
    })
}

/// Whether a vector or matrix has a column for each component.
pub(super) fn is_small(shape: &[usize]) -> bool {
    match shape {
        [] => true,
        [rows] => *rows <= MAX_COMPONENTS,
        [rows, columns] => rows == columns && *rows <= MAX_COMPONENTS,
        _ => false,
    }
}

/// An array with a number, vector or matrix in each row.
fn array_values(out: &mut Columns, name: &str, names: &Names, array: &Array, within: Within) {
    let cell = match within {
        Within::Document => &array.shape[..],
        Within::Table => &array.shape[1..],
    };
    if cell.is_empty() {
        return array_cells(out, name, names, array);
    }
    let Data::Real(values) = &array.data else { return };
    if !is_small(cell) {
        return;
    }
    let size: usize = cell.iter().product();
    for k in 0..size {
        let place = match cell {
            [_, columns] => format!("{name}_{}_{}", k / columns + 1, k % columns + 1),
            _ => format!("{name}_{}", k + 1),
        };
        let component: Vec<f64> = values.iter().skip(k).step_by(size).copied().collect();
        let component = Array::real(&[component.len()], &array.unit, component);
        array_cells(out, &place, names, &component);
    }
}

/// Every value of an array as a cell of its own; complex numbers in two columns.
pub(super) fn array_cells(out: &mut Columns, name: &str, names: &Names, array: &Array) {
    let factor = names.json_factor(&array.unit);
    let mut put = |name: &str, cells: Vec<String>| out.add(with_unit(name, &array.unit, factor), cells);
    let scaled = |value: f64| number(factor.map_or(value, |factor| value * factor));
    match &array.data {
        Data::Real(values) => put(name, values.iter().map(|value| scaled(*value)).collect()),
        Data::Complex(values) => {
            put(&joined(name, "re"), values.iter().map(|value| number(value.re)).collect());
            put(&joined(name, "im"), values.iter().map(|value| number(value.im)).collect());
        }
        Data::Integers(values) => {
            put(name, values.iter().map(|value| value.map_or_else(String::new, |v| v.to_string())).collect());
        }
        Data::Flags(values) => put(name, values.iter().map(bool::to_string).collect()),
        Data::Texts(values) => {
            put(name, values.iter().map(|text| text.clone().unwrap_or_default()).collect());
        }
    }
}

fn with_unit(name: &str, unit: &str, factor: Option<f64>) -> String {
    match (unit, factor) {
        (_, Some(_)) => format!("{name} [rpm]"),
        ("" | "1", None) => name.into(),
        (unit, None) => format!("{name} [{unit}]"),
    }
}

/// As short as possible without loss, with an exponent if that is shorter; a missing number is empty.
pub(super) fn number(value: f64) -> String {
    if value.is_nan() { String::new() } else { format!("{value:?}") }
}
