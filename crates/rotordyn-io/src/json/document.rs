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
        // Has no name in JSON.
        Value::Stored(_) => return,
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
                let range = k * cell..(k + 1) * cell;
                if array.missing == MissingCell::Row && is_missing(&array.data, range.clone()) {
                    return Json::Null;
                }
                let factor = names.json_factor(&array.unit);
                insert_cell(&mut out, name, array, &array.shape[1..], range, factor);
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

/// Whether a cell has no number.
fn is_missing(data: &Data, range: Range<usize>) -> bool {
    matches!(data, Data::Real(values) if values[range].iter().all(|v| v.is_nan()))
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
        Data::Real(values) => match (is_missing(&array.data, range.clone()), array.missing) {
            (true, MissingCell::Omitted) => return,
            (true, MissingCell::Null) => Json::Null,
            _ => nested(shape, range, &|k| match factor {
                Some(factor) => json!(values[k] * factor),
                None => json!(values[k]),
            }),
        },
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

#[cfg(test)]
mod tests {
    use super::*;
    use rotordyn_core::document::Rows;

    #[test]
    fn missing_cells_and_rows() {
        let rows = |form| {
            let level = |row: &Option<f64>| *row;
            let table = Rows::of(&[Some(1.0), None]).optional("level", "m", level).missing(form);
            document(&Document::new().table("", table.integer("count", |_| 2)))
        };
        let of = |second: Json| json!([{ "level": 1.0, "count": 2 }, second]);
        assert_eq!(rows(MissingCell::Numbers), of(json!({ "level": null, "count": 2 })));
        assert_eq!(rows(MissingCell::Omitted), of(json!({ "count": 2 })));
        assert_eq!(rows(MissingCell::Row), of(Json::Null));
    }
}
