//! Tables that the documents of results give a heading.

use rotordyn::document::{Data, Document, Field, Table, Value};

use super::terminal::{Terminal, number};

/// Significant digits of a number.
const DIGITS: usize = 5;

/// Prints every table with a heading.
pub fn tables(terminal: &Terminal, found: &Document) {
    for field in &found.fields {
        match &field.value {
            Value::Group(members) => tables(terminal, members),
            Value::Groups { groups, .. } => groups.iter().for_each(|(_, members)| tables(terminal, members)),
            Value::Table(Table { heading: Some(heading), columns, .. }) => table(terminal, heading, columns),
            _ => {}
        }
    }
}

fn table(terminal: &Terminal, heading: &str, columns: &Document) {
    let (header, cells): (Vec<String>, Vec<Vec<String>>) = columns.fields.iter().filter_map(column).unzip();
    let header: Vec<&str> = header.iter().map(String::as_str).collect();
    let count = cells.first().map_or(0, Vec::len);
    let row = |k: usize| cells.iter().map(|column| column[k].clone()).collect();
    terminal.table(heading, &header, &(0..count).map(row).collect::<Vec<_>>());
}

/// Title with unit, and cells; `None` if a row has no single value, or JSON does not have the column.
fn column(field: &Field) -> Option<(String, Vec<String>)> {
    let (Value::Array(array), Some(json)) = (&field.value, &field.names.json) else { return None };
    if array.shape.len() != 1 {
        return None;
    }
    let factor = field.names.json_factor(&array.unit);
    let missing = || "-".to_string();
    let cells = match &array.data {
        Data::Real(values) => {
            let value = |value: &f64| number(value * factor.unwrap_or(1.0), DIGITS);
            values.iter().map(|v| if v.is_nan() { missing() } else { value(v) }).collect()
        }
        Data::Integers(values) => values.iter().map(|v| v.map_or_else(missing, |v| v.to_string())).collect(),
        Data::Flags(values) => values.iter().map(|flag| if *flag { "yes" } else { "no" }.into()).collect(),
        Data::Texts(values) => values.iter().map(|text| text.clone().unwrap_or_else(missing)).collect(),
        Data::Complex(_) => return None,
    };
    // The name in HDF5 has no unit in it.
    let name = field.names.hdf5.as_ref().unwrap_or(json).replace('_', " ");
    let title = match (array.unit.as_str(), factor) {
        (_, Some(_)) => format!("{name} rpm"),
        ("" | "1", None) => name,
        (unit, None) => format!("{name} {unit}"),
    };
    Some((title, cells))
}

#[cfg(test)]
mod tests {
    use super::*;
    use rotordyn::document::{Rows, in_hdf5};

    #[test]
    fn columns_have_names_with_units_and_short_numbers() {
        let rows = Rows::of(&[(0.1, Some(3)), (f64::NAN, None)])
            .quantity("mean_speed", "rad/s", |row| row.0)
            .number("share", "1", |row| 1.0 / 3.0 + row.0)
            .optional_integer("count", |row| row.1)
            .flag("complete", |row| row.1.is_some())
            .number(in_hdf5("only_hdf5"), "m", |row| row.0)
            .numbers("vector", "m", &[2], |_| [1.0, 2.0]);
        let found: Vec<_> = rows.table().columns.fields.iter().filter_map(column).collect();
        let text = |title: &str, cells: [&str; 2]| (title.to_string(), cells.map(String::from).to_vec());
        let expected = [
            text("mean speed rpm", ["0.95493", "-"]),
            text("share", ["0.43333", "-"]),
            text("count", ["3", "-"]),
            text("complete", ["yes", "no"]),
        ];
        assert_eq!(found, expected);
    }
}
