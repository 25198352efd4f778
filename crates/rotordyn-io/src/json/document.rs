//! JSON of a [`Document`]: see the table there.

use rotordyn_core::document::{Array, Count, Data, Document, Field, MissingCell, Section, Table, Value};
use serde_json::{Map, Value as Json, json};
use std::ops::Range;

/// Adds sections under their keys.
pub fn add_sections(out: &mut Map<String, Json>, sections: &[Section]) {
    for section in sections {
        let content = document(&section.content);
        if section.listed {
            let list = out.entry(section.json).or_insert_with(|| json!([]));
            if let Some(list) = list.as_array_mut() {
                list.push(content);
            }
        } else {
            out.insert(section.json.into(), content);
        }
    }
}

/// An object; of a document whose only name is empty, that value itself.
pub fn document(found: &Document) -> Json {
    let mut out = Map::new();
    found.fields.iter().for_each(|field| insert(&mut out, field));
    unwrapped(out)
}

fn unwrapped(mut out: Map<String, Json>) -> Json {
    match out.remove("") {
        Some(only) => only,
        None => Json::Object(out),
    }
}

fn insert(out: &mut Map<String, Json>, Field { names, value }: &Field) {
    let Some(name) = &names.json else { return };
    let value = match value {
        Value::Text(text) => json!(text),
        Value::Number(number, unit) => match names.json_factor(unit) {
            Some(factor) => json!(number * factor),
            None => json!(number),
        },
        Value::Integer(number) => json!(number),
        Value::Flag(flag) => json!(flag),
        Value::Texts(texts) => json!(texts),
        Value::Missing => Json::Null,
        Value::Array(array) => {
            let factor = names.json_factor(&array.unit);
            return insert_cell(out, name, array, &array.shape, 0..array.data.len(), factor);
        }
        Value::Group(members) => document(members),
        Value::Groups { key, groups: found } => groups(key, found),
        Value::Table(table) => rows(table),
    };
    out.insert(name.clone(), value);
}

/// Groups by name as a list of objects with the name under `key`.
pub fn groups(key: &str, found: &[(String, Document)]) -> Json {
    let object = |(name, members): &(String, Document)| {
        let mut object = document(members);
        if !key.is_empty() {
            object[key] = json!(name);
        }
        object
    };
    found.iter().map(object).collect()
}

fn rows(table: &Table) -> Json {
    match &table.rows {
        Count::One => row(&table.columns, 0),
        Count::Many(count) => (0..*count).map(|k| row(&table.columns, k)).collect(),
        Count::Within(counts) => (0..counts.iter().sum()).map(|k| row(&table.columns, k)).collect(),
    }
}

fn row(columns: &Document, k: usize) -> Json {
    let mut out = Map::new();
    for Field { names, value } in &columns.fields {
        let Some(name) = &names.json else { continue };
        match value {
            Value::Array(array) => {
                let cell: usize = array.shape[1..].iter().product();
                let factor = names.json_factor(&array.unit);
                insert_cell(&mut out, name, array, &array.shape[1..], k * cell..(k + 1) * cell, factor);
            }
            Value::Group(members) => {
                out.insert(name.clone(), row(members, k));
            }
            Value::Table(Table { rows: Count::Within(counts), columns, .. }) => {
                let start: usize = counts[..k].iter().sum();
                out.insert(name.clone(), (start..start + counts[k]).map(|k| row(columns, k)).collect());
            }
            // No other value has rows.
            _ => {}
        }
    }
    unwrapped(out)
}

/// Values of one cell; complex ones as `re` and `im`, in the surrounding object if the name is empty.
fn insert_cell(
    out: &mut Map<String, Json>,
    name: &str,
    array: &Array,
    shape: &[usize],
    range: Range<usize>,
    factor: Option<f64>,
) {
    let value = match &array.data {
        Data::Real(values) => {
            let cell = &values[range.clone()];
            match (cell.iter().all(|v| v.is_nan()), array.missing) {
                (true, MissingCell::Omitted) => return,
                (true, MissingCell::Null) => Json::Null,
                _ => nested(shape, range, &|k| match factor {
                    Some(factor) => json!(values[k] * factor),
                    None => json!(values[k]),
                }),
            }
        }
        Data::Complex(values) => {
            let re = nested(shape, range.clone(), &|k| json!(values[k].re));
            let im = nested(shape, range, &|k| json!(values[k].im));
            if name.is_empty() {
                out.insert("re".into(), re);
                out.insert("im".into(), im);
                return;
            }
            json!({ "re": re, "im": im })
        }
        Data::Integers(values) => nested(shape, range, &|k| json!(values[k])),
        Data::Flags(values) => nested(shape, range, &|k| json!(values[k])),
        Data::Texts(values) => nested(shape, range, &|k| json!(values[k])),
    };
    out.insert(name.into(), value);
}

/// Nested lists of a shape in row-major order; of no dimension, the value.
fn nested(shape: &[usize], range: Range<usize>, value: &dyn Fn(usize) -> Json) -> Json {
    let Some((count, inner)) = shape.split_first() else { return value(range.start) };
    let size: usize = inner.iter().product();
    (0..*count).map(|k| nested(inner, range.start + k * size..range.start + (k + 1) * size, value)).collect()
}
