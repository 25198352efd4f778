//! Tables of documents as text, for CSV files and the terminal.
//!
//! Names and values are those of JSON; the unit stands behind the name of a column, as in `frequency_hz [Hz]`:
//!
//! | in the document | table |
//! |---|---|
//! | single values of a section | `SECTION`, one row; of listed sections, lists and groups by name a row each, in whose tables the texts at its beginning or its name come first |
//! | table | `SECTION_TABLE`; a table within its rows repeats the columns of the outer row, and puts its name before those of its own that are named alike |
//! | numbers over an axis in each row | `SECTION_TABLE_over_AXIS`, a row for each value of the axis |
//! | arrays over an axis | `SECTION_over_AXIS`, a column each |
//!
//! A vector or matrix of up to six rows has a column for each component. Maps (arrays over two axes) and mode shapes are
//! in the results file only.

mod cells;
mod columns;

use crate::atomic_file;
use crate::error::Error;
use cells::{Within, all_values, array_cells, is_axis, title, values};
pub use columns::TextTable;
use columns::{Columns, Tables, joined};
use rotordyn_core::document::{Array, Count, Data, Document, Field, Section, Table, Value};
use rotordyn_units::names::file_names;
use std::path::{Path, PathBuf};

/// All tables of the sections that have rows.
pub fn tables(sections: &[Section]) -> Vec<TextTable> {
    let mut out = Tables::default();
    for section in sections {
        let mut outer = Columns::one_row();
        if section.listed {
            first_texts(&mut outer, &section.content);
        }
        document(&mut out, section.json, &outer, &section.content);
    }
    out.finished()
}

/// The texts at the beginning of a document, which say whose values these are among several.
fn first_texts(row: &mut Columns, found: &Document) {
    for field in found.fields.iter().take_while(|field| matches!(field.value, Value::Text(_))) {
        values(row, "", field, Within::Document);
    }
}

/// Names of the CSV files of tables, none twice.
pub fn csv_names(tables: &[TextTable]) -> Vec<String> {
    let stems = file_names(tables.iter().map(|table| table.name.as_str()));
    stems.into_iter().map(|stem| format!("{stem}.csv")).collect()
}

/// Writes every table of the sections as `NAME.csv`; returns the files.
///
/// # Errors
/// A file cannot be written.
pub fn write_csv(folder: &Path, sections: &[Section]) -> Result<Vec<PathBuf>, Error> {
    std::fs::create_dir_all(folder).map_err(Error::of_file("create folder", folder))?;
    let mut files = Vec::new();
    let tables = tables(sections);
    for (table, name) in tables.iter().zip(csv_names(&tables)) {
        let path = folder.join(name);
        atomic_file::write_derived(&path, table.csv().as_bytes()).map_err(Error::of_file("write", &path))?;
        files.push(path);
    }
    Ok(files)
}

/// The single values of a document in one row, its tables and its curves; `outer`: what the row begins with.
fn document(out: &mut Tables, name: &str, outer: &Columns, found: &Document) {
    single_values(out, name, outer, found);
    members(out, name, outer, found, true);
}

/// The single values of a document in one row, if it has any.
fn single_values(out: &mut Tables, name: &str, outer: &Columns, found: &Document) {
    let mut row = outer.clone();
    all_values(&mut row, "", found, Within::Document);
    if row.len() > outer.len() {
        out.add(name, row);
    }
}

/// Tables, lists and curves of a document; `in_json`: whether JSON has it.
fn members(out: &mut Tables, name: &str, outer: &Columns, found: &Document, in_json: bool) {
    for field in &found.fields {
        let name = joined(name, title(field));
        match &field.value {
            Value::Group(inner) => {
                members(out, &name, outer, inner, in_json && field.names.json.is_some());
            }
            // What only HDF5 has in tables and lists, JSON has in another form.
            _ if field.names.json.is_none() => {}
            Value::Groups { .. } | Value::Table(_) if !in_json => {}
            Value::Groups { key, groups } => {
                for (of, inner) in groups {
                    let mut named = outer.clone();
                    if !key.is_empty() {
                        named.add(*key, vec![of.clone()]);
                    }
                    single_values(out, &name, &named, inner);
                    if key.is_empty() {
                        first_texts(&mut named, inner);
                    }
                    members(out, &name, &named, inner, true);
                }
            }
            // The single values of a record stand in the row of the document.
            Value::Table(Table { rows: Count::One, columns, .. }) => {
                rows_within(out, &name, outer, columns, found);
            }
            Value::Table(Table { rows: Count::Many(count), columns, .. }) => {
                table(out, &name, title(field), &outer.repeated(&[*count]), columns, found);
            }
            Value::Array(array) if in_json && is_list(array) && !is_axis(found, field) => {
                let mut list = outer.repeated(&[array.data.len()]);
                array_cells(&mut list, title(field), &field.names, array);
                out.add(&name, list);
            }
            _ => {}
        }
    }
    curves(out, name, outer, found);
}

/// A table and what stands within its rows; `own`: its name in the document, `around`: the document with the axes of its
/// cells.
fn table(out: &mut Tables, name: &str, own: &str, outer: &Columns, columns: &Document, around: &Document) {
    let mut values = Columns::of_rows(outer.rows());
    all_values(&mut values, "", columns, Within::Table);
    let mut rows = outer.clone();
    rows.append_named(values, own);
    if rows.len() > outer.len() {
        out.add(name, rows.clone());
    }
    rows_within(out, name, &rows, columns, around);
}

/// Numbers of rows within each outer row, and the named columns of all lists with these numbers.
type ListsWithin<'a, 'b> = (&'a [usize], Vec<(&'a str, &'a Document<'b>)>);

/// Tables, lists and numbers over an axis within the rows of a table.
fn rows_within(out: &mut Tables, name: &str, rows: &Columns, columns: &Document, around: &Document) {
    let mut lists: Vec<ListsWithin> = Vec::new();
    let mut series: Vec<(&Field, Vec<&Field>)> = Vec::new();
    for field in columns.fields.iter().filter(|field| field.names.json.is_some()) {
        match &field.value {
            Value::Group(inner) => rows_within(out, &joined(name, title(field)), rows, inner, around),
            Value::Table(Table { rows: Count::Within(counts), columns: inner, .. }) => {
                let is_unnamed = |field: &Field| title(field).is_empty();
                match inner.fields.iter().any(is_unnamed) {
                    false => {
                        let own = title(field);
                        table(out, &joined(name, own), own, &rows.repeated(counts), inner, around);
                    }
                    // Lists of the same lengths belong together.
                    true => match lists.iter_mut().find(|(other, _)| other == counts) {
                        Some((_, together)) => together.push((title(field), inner)),
                        None => lists.push((counts, vec![(title(field), inner)])),
                    },
                }
            }
            Value::Array(array) => {
                let over = array.axes.iter().find(|(k, _)| *k == 1 && array.shape.len() == 2);
                let Some(axis) = over.and_then(|(_, axis)| axis_field(around, axis)) else { continue };
                match series.iter_mut().find(|(other, _)| *other == axis) {
                    Some((_, together)) => together.push(field),
                    None => series.push((axis, vec![field])),
                }
            }
            _ => {}
        }
    }
    for (counts, together) in lists {
        let first = together[0].0;
        let name = if together.len() > 1 { format!("{name}_over_{first}") } else { joined(name, first) };
        let mut rows = rows.repeated(counts);
        for (title, inner) in together {
            all_values(&mut rows, title, inner, Within::Table);
        }
        out.add(&name, rows);
    }
    for (axis, together) in series {
        let Value::Array(points) = &axis.value else { continue };
        let count = points.data.len();
        let mut all = rows.repeated(&vec![count; rows.rows()]);
        let mut once = Columns::one_row();
        array_cells(&mut once, title(axis), &axis.names, points);
        all.append(once.cycled(rows.rows()));
        for field in together {
            if let Value::Array(array) = &field.value {
                array_cells(&mut all, title(field), &field.names, array);
            }
        }
        out.add(&format!("{name}_over_{}", title(axis)), all);
    }
}

/// Arrays of one dimension over an axis of the document.
fn curves(out: &mut Tables, name: &str, outer: &Columns, found: &Document) {
    for axis in &found.fields {
        let Value::Array(points) = &axis.value else { continue };
        let over: Vec<(&Field, &Array)> = found
            .fields
            .iter()
            .filter_map(|field| match &field.value {
                Value::Array(array) if array.shape.len() == 1 => Some((field, array)),
                _ => None,
            })
            .filter(|(_, array)| array.axes.iter().any(|(_, of)| axis_field(found, of) == Some(axis)))
            .collect();
        if over.is_empty() {
            continue;
        }
        let mut columns = outer.repeated(&[points.data.len()]);
        for (field, array) in std::iter::once((axis, points)).chain(over) {
            array_cells(&mut columns, title(field), &field.names, array);
        }
        out.add(&format!("{name}_over_{}", title(axis)), columns);
    }
}

/// The array over which others of the document are given.
fn axis_field<'f, 'a>(found: &'f Document<'a>, axis: &str) -> Option<&'f Field<'a>> {
    let is_axis = |field: &&Field| field.names.hdf5.as_deref() == Some(axis);
    found.fields.iter().filter(|field| matches!(field.value, Value::Array(_))).find(is_axis)
}

/// Whether an array is a list of its own: texts, or more numbers than a vector; integers are indices of another array.
fn is_list(array: &Array) -> bool {
    let alone = match array.data {
        Data::Real(_) => !cells::is_small(&array.shape),
        Data::Integers(_) => false,
        _ => true,
    };
    array.shape.len() == 1 && array.axes.is_empty() && alone
}

#[cfg(test)]
mod tests {
    use super::*;
    use rotordyn_core::document::{Rows, in_hdf5, in_json, named};

    struct Outer {
        speed: f64,
        inner: Vec<(String, f64)>,
        curve: [f64; 2],
        list: Vec<f64>,
    }

    fn outer() -> [Outer; 2] {
        let inner = |names: &[&str]| names.iter().map(|name| ((*name).to_string(), 0.1)).collect();
        [
            Outer { speed: 1.0, inner: inner(&["a"]), curve: [1.0, 2.0], list: vec![5.0] },
            Outer {
                speed: f64::NAN,
                inner: inner(&["b, \"c\"", "d"]),
                curve: [3.0, 4.0],
                list: vec![6.0, 7.0],
            },
        ]
    }

    fn text(name: &str, header: &[&str], rows: &[&[&str]]) -> TextTable {
        TextTable {
            name: name.into(),
            header: header.iter().map(|t| (*t).to_string()).collect(),
            rows: rows.iter().map(|row| row.iter().map(|t| (*t).to_string()).collect()).collect(),
        }
    }

    #[test]
    fn tables_repeat_the_outer_row_and_have_units() {
        let found = outer();
        let rows = Rows::of(&found)
            .quantity("speed", "rad/s", |o| o.speed)
            .numbers("force", "N", &[2], |o| o.curve)
            .numbers("zeta", "1", &[2], |o| o.curve)
            .cells_over(0, "frequency")
            .series("level", "m", |o| &o.list)
            .series("at", "s", |o| &o.list)
            .nested("inner", |o| &o.inner, |rows| rows.text("name", |i| &i.0).number("level", "1", |i| i.1));
        let content = Document::new()
            .number("count", "1", 2.0)
            .optional("missing", "m", None)
            .number(in_hdf5("only_hdf5"), "m", 2.0)
            .group("part", Document::new().flag("complete", true).numbers("vector", "m", &[0.5, 1e-7]))
            .numbers(named("frequency_hz", "frequency"), "Hz", &[10.0, 20.0])
            .array(in_hdf5("response"), Array::real(&[2], "m", &[0.5, 0.25]).over(0, "frequency"))
            .array(in_hdf5("map"), Array::real(&[1, 2], "m", &[0.5, 0.25]).over(1, "frequency"))
            .texts(in_json("nodes"), ["a", "b"])
            .table("outer", rows);
        let found = tables(&[Section::new("all", "all_in_hdf5", content)]);
        let rpm = crate::document_tables::cells::number(rotordyn_core::document::TO_RPM);
        let columns = ["speed_rpm [rpm]", "force_1 [N]", "force_2 [N]"];
        let with = |more: &[&'static str]| -> Vec<&str> { columns.iter().chain(more).copied().collect() };
        let expected = [
            text(
                "all",
                &["count", "part_complete", "part_vector_1 [m]", "part_vector_2 [m]"],
                &[&["2.0", "true", "0.5", "1e-7"]],
            ),
            text("all_nodes", &["nodes"], &[&["a"], &["b"]]),
            text("all_outer", &columns, &[&[&rpm, "1.0", "2.0"], &["", "3.0", "4.0"]]),
            text(
                "all_outer_inner",
                &with(&["name", "level"]),
                &[
                    &[&rpm, "1.0", "2.0", "a", "0.1"],
                    &["", "3.0", "4.0", "b, \"c\"", "0.1"],
                    &["", "3.0", "4.0", "d", "0.1"],
                ],
            ),
            text(
                "all_outer_over_level",
                &with(&["level [m]", "at [s]"]),
                &[
                    &[&rpm, "1.0", "2.0", "5.0", "5.0"],
                    &["", "3.0", "4.0", "6.0", "6.0"],
                    &["", "3.0", "4.0", "7.0", "7.0"],
                ],
            ),
            text(
                "all_outer_over_frequency_hz",
                &with(&["frequency_hz [Hz]", "zeta"]),
                &[
                    &[&rpm, "1.0", "2.0", "10.0", "1.0"],
                    &[&rpm, "1.0", "2.0", "20.0", "2.0"],
                    &["", "3.0", "4.0", "10.0", "3.0"],
                    &["", "3.0", "4.0", "20.0", "4.0"],
                ],
            ),
            text(
                "all_over_frequency_hz",
                &["frequency_hz [Hz]", "response [m]"],
                &[&["10.0", "0.5"], &["20.0", "0.25"]],
            ),
        ];
        for (found, expected) in found.iter().zip(&expected) {
            assert_eq!(found, expected);
        }
        assert_eq!(found.len(), expected.len());
    }

    /// The channel's level and that of its orders are columns of their own; what only HDF5 has, and indices, are no lists.
    #[test]
    fn columns_named_alike_are_kept() {
        let rows = Rows::of(&[(1.0, [(2.0, 3.0), (4.0, 5.0)])]).number("rms", "m", |r| r.0).nested(
            "orders",
            |r| &r.1,
            |inner| inner.number("rms", "m", |o| o.0).number("order", "1", |o| o.1),
        );
        let only_hdf5 =
            Document::new().texts("labels", ["a"]).table("rows", Rows::of(&[1.0]).number("x", "m", |x| *x));
        let content = Document::new()
            .table("channels", rows)
            .array(in_json("requested"), Array::indices(&[0, 1]))
            .group(in_hdf5("detail"), only_hdf5);
        let expected = [
            text("all_channels", &["rms [m]"], &[&["1.0"]]),
            text(
                "all_channels_orders",
                &["rms [m]", "orders_rms [m]", "order"],
                &[&["1.0", "2.0", "3.0"], &["1.0", "4.0", "5.0"]],
            ),
        ];
        assert_eq!(tables(&[Section::new("all", "all", content)]), expected);
    }

    #[test]
    fn listed_sections_and_groups_by_name_share_tables() {
        let section = |name: &str, value: Option<f64>| {
            let inner = Document::new().optional("force", "N", value);
            let groups = [("A".to_string(), inner.clone()), ("B".to_string(), inner)];
            let content = Document::new()
                .text(in_json("channel"), name)
                .optional("rms", "m", value)
                .groups("bearings", "name", groups);
            Section::listed("channels", name, content)
        };
        let found = tables(&[section("x", None), section("y", Some(2.0))]);
        let expected = [
            text("channels", &["channel", "rms [m]"], &[&["y", "2.0"]]),
            text(
                "channels_bearings",
                &["channel", "name", "force [N]"],
                &[&["y", "A", "2.0"], &["y", "B", "2.0"]],
            ),
        ];
        assert_eq!(found, expected);
    }

    #[test]
    fn csv_files_quote_texts() {
        let content = Document::new().table("t", Rows::of(&["b, \"c\"", "d"]).text("name", |name| name));
        let folder = tempfile::tempdir().unwrap();
        let files = write_csv(folder.path(), &[Section::new("all", "all", content)]).unwrap();
        let names: Vec<_> = files.iter().map(|f| f.file_name().unwrap().to_str().unwrap()).collect();
        assert_eq!(names, ["all_t.csv"]);
        assert_eq!(std::fs::read_to_string(&files[0]).unwrap(), "name\n\"b, \"\"c\"\"\"\nd\n");
    }
}
