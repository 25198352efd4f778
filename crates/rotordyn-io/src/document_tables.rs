//! Tables of a [`Document`] as text, for the terminal and CSV files.

use crate::error::Error;
use rotordyn_core::document::{Array, Count, Data, Document, Field, Section, Table, Value};
use rotordyn_units::names::file_name;
use std::path::{Path, PathBuf};

/// A table with its texts; numbers have all their digits.
#[derive(Clone, Debug, PartialEq)]
pub struct TextTable {
    /// Names from the document down to the table, separated by `/`.
    pub name: String,
    /// Names of the columns with their units.
    pub header: Vec<String>,
    pub rows: Vec<Vec<String>>,
}

/// All tables of a document that have rows, each with its columns of one value a row.
///
/// A table within the rows of another starts with the number of the outer row, from 1.
pub fn tables(name: &str, document: &Document) -> Vec<TextTable> {
    let mut out = Vec::new();
    collect(&mut out, name, document);
    out
}

/// Writes every table of the sections as `<section>_<table>.csv`; returns the files.
///
/// # Errors
/// A file cannot be written, or two tables have the same file name.
pub fn write_csv(folder: &Path, sections: &[Section]) -> Result<Vec<PathBuf>, Error> {
    let mut files = Vec::new();
    for section in sections {
        for table in tables(section.hdf5.trim_start_matches('/'), &section.content) {
            let path = folder.join(format!("{}.csv", file_name(&table.name.replace('/', "_"))));
            if files.contains(&path) {
                return Err(Error::of_file("write", &path)("two tables have this name"));
            }
            let lines: Vec<String> =
                std::iter::once(&table.header).chain(&table.rows).map(|cells| line(cells)).collect();
            std::fs::write(&path, lines.concat()).map_err(Error::of_file("write", &path))?;
            files.push(path);
        }
    }
    Ok(files)
}

/// A line of CSV; texts with a separator, quote or line break are quoted (RFC 4180).
fn line(cells: &[String]) -> String {
    let quoted = |cell: &String| match cell.contains([',', '"', '\n']) {
        true => format!("\"{}\"", cell.replace('"', "\"\"")),
        false => cell.clone(),
    };
    cells.iter().map(quoted).collect::<Vec<_>>().join(",") + "\n"
}

fn join(name: &str, inner: &str) -> String {
    if inner.is_empty() { name.into() } else { format!("{name}/{inner}") }
}

/// Name in HDF5, which is in SI; else that in JSON.
fn name_of<'a>(field: &'a Field) -> &'a str {
    field.names.hdf5.as_deref().or(field.names.json.as_deref()).unwrap_or_default()
}

fn collect(out: &mut Vec<TextTable>, name: &str, document: &Document) {
    for field in &document.fields {
        let name = join(name, name_of(field));
        match &field.value {
            Value::Group(members) => collect(out, &name, members),
            // Lists of JSON alone repeat groups that have names in HDF5.
            Value::Groups { groups, .. } if field.names.hdf5.is_some() => {
                groups.iter().for_each(|(of, members)| collect(out, &join(&name, of), members));
            }
            Value::Table(table) => collect_table(out, &name, table),
            _ => {}
        }
    }
}

fn collect_table(out: &mut Vec<TextTable>, name: &str, table: &Table) {
    let (count, mut found) = match &table.rows {
        Count::One => (1, Vec::new()),
        Count::Many(count) => (*count, Vec::new()),
        Count::Within(counts) => {
            let outer =
                counts.iter().enumerate().flat_map(|(k, n)| std::iter::repeat_n((k + 1).to_string(), *n));
            (counts.iter().sum(), vec![("row".to_string(), outer.collect::<Vec<_>>())])
        }
    };
    let own = found.len();
    columns(&mut found, "", &table.columns);
    if count > 0 && found.len() > own {
        let rows = (0..count).map(|k| found.iter().map(|(_, cells)| cells[k].clone()).collect()).collect();
        let header = found.into_iter().map(|(title, _)| title).collect();
        out.push(TextTable { name: name.into(), header, rows });
    }
    for field in &table.columns.fields {
        if let Value::Table(inner) = &field.value {
            collect_table(out, &join(name, name_of(field)), inner);
        }
    }
}

/// Titles and cells of the columns of one value a row.
fn columns(out: &mut Vec<(String, Vec<String>)>, prefix: &str, found: &Document) {
    for field in &found.fields {
        let name = format!("{prefix}{}", name_of(field));
        match &field.value {
            Value::Array(array) if array.shape.len() == 1 && !name.is_empty() => column(out, &name, array),
            Value::Group(members) => columns(out, &format!("{name} "), members),
            _ => {}
        }
    }
}

fn column(out: &mut Vec<(String, Vec<String>)>, name: &str, array: &Array) {
    let title = |name: &str| match array.unit.as_str() {
        "" | "1" => name.to_string(),
        unit => format!("{name} {unit}"),
    };
    let mut put = |name: &str, cells| out.push((title(name), cells));
    // As short as possible without loss, with an exponent if that is shorter.
    let text = |value: f64| format!("{value:?}");
    match &array.data {
        Data::Real(values) => put(name, values.iter().map(|value| text(*value)).collect()),
        Data::Complex(values) => {
            put(&format!("{name}_re"), values.iter().map(|value| text(value.re)).collect());
            put(&format!("{name}_im"), values.iter().map(|value| text(value.im)).collect());
        }
        Data::Integers(values) => {
            put(name, values.iter().map(|value| value.map_or_else(String::new, |v| v.to_string())).collect());
        }
        Data::Flags(values) => put(name, values.iter().map(bool::to_string).collect()),
        Data::Texts(values) => {
            put(name, values.iter().map(|text| text.clone().unwrap_or_default()).collect())
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rotordyn_core::document::Rows;

    struct Outer {
        speed: f64,
        inner: Vec<(String, f64)>,
    }

    fn outer() -> [Outer; 2] {
        let inner = |names: &[&str]| names.iter().map(|name| ((*name).to_string(), 0.1)).collect();
        [
            Outer { speed: 1.0, inner: inner(&["a"]) },
            Outer { speed: f64::NAN, inner: inner(&["b, \"c\"", "d"]) },
        ]
    }

    #[test]
    fn tables_have_units_and_rows_within_rows() {
        let found = outer();
        let rows = Rows::of(&found)
            .quantity("speed", "rad/s", |o| o.speed)
            .numbers("vector", "m", &[2], |o| [o.speed; 2])
            .nested("inner", |o| &o.inner, |rows| rows.text("name", |i| &i.0).number("level", "1", |i| i.1));
        let document = Document::new().group("part", Document::new().table("outer", rows));
        let found = tables("all", &document);
        let text = |name: &str, header: &[&str], rows: &[&[&str]]| TextTable {
            name: name.into(),
            header: header.iter().map(|t| (*t).to_string()).collect(),
            rows: rows.iter().map(|row| row.iter().map(|t| (*t).to_string()).collect()).collect(),
        };
        let expected = [
            text("all/part/outer", &["speed rad/s"], &[&["1.0"], &["NaN"]]),
            text(
                "all/part/outer/inner",
                &["row", "name", "level"],
                &[&["1", "a", "0.1"], &["2", "b, \"c\"", "0.1"], &["2", "d", "0.1"]],
            ),
        ];
        assert_eq!(found, expected);

        let folder = tempfile::tempdir().unwrap();
        let files = write_csv(folder.path(), &[Section::new("all", "all", document)]).unwrap();
        let names: Vec<_> = files.iter().map(|f| f.file_name().unwrap().to_str().unwrap()).collect();
        assert_eq!(names, ["all_part_outer.csv", "all_part_outer_inner.csv"]);
        let content = std::fs::read_to_string(&files[1]).unwrap();
        assert_eq!(content, "row,name,level\n1,a,0.1\n2,\"b, \"\"c\"\"\",0.1\n2,d,0.1\n");
    }
}
