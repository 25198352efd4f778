//! Line figures of the quantities that documents mark as drawn.

use super::Named;
use super::display_unit::{typographic_unit, unit};
use crate::{Curve, Figure, Lines};
use rotordyn_core::document::{Array, Data, Document, Field, Section, Value};

/// A figure of every drawn array over its axis; `note` stands below the titles.
pub fn figures(sections: &[Section], note: &str) -> Vec<Named> {
    let mut out = Vec::new();
    for section in sections {
        let mut name = section.json.to_string();
        // The text at the beginning of a listed section says whose values these are.
        if let (true, Some(Field { value: Value::Text(of), .. })) =
            (section.listed, section.content.fields.first())
        {
            name = format!("{name}_{of}");
        }
        document(&mut out, &name, note, &section.content);
    }
    out
}

fn document(out: &mut Vec<Named>, name: &str, note: &str, found: &Document) {
    for field in &found.fields {
        let within = format!("{name}_{}", word(field));
        let name = if word(field).is_empty() { name } else { &within };
        match &field.value {
            Value::Group(members) => document(out, name, note, members),
            Value::Groups { groups, .. } => {
                groups.iter().for_each(|(of, members)| document(out, &format!("{name}_{of}"), note, members));
            }
            Value::Table(table) => {
                let drawn = table.columns.fields.iter().filter_map(|field| Some((field, drawn(field)?)));
                for (column, values) in drawn {
                    let axis = table.axis.as_deref().and_then(|axis| array_of(&table.columns, axis));
                    let name = format!("{name}_{}", word(column));
                    out.extend(axis.and_then(|axis| figure(name, note, axis, (column, values))));
                }
            }
            Value::Array(_) => {
                let Some(values) = drawn(field) else { continue };
                let axis = values.axes.first().and_then(|(_, axis)| array_of(found, axis));
                out.extend(axis.and_then(|axis| figure(name.into(), note, axis, (field, values))));
            }
            _ => {}
        }
    }
}

/// The array of a field that is marked as drawn.
fn drawn<'f, 'a>(field: &'f Field<'a>) -> Option<&'f Array<'a>> {
    match &field.value {
        Value::Array(array) if array.drawn => Some(array),
        _ => None,
    }
}

/// The array of a name in HDF5.
fn array_of<'f, 'a>(found: &'f Document<'a>, name: &str) -> Option<(&'f Field<'a>, &'f Array<'a>)> {
    found.fields.iter().find_map(|field| match &field.value {
        Value::Array(array) if field.names.hdf5.as_deref() == Some(name) => Some((field, array)),
        _ => None,
    })
}

/// A curve of one array over another; `None` if either has other values than real ones.
fn figure(
    name: String,
    note: &str,
    (x_field, x): (&Field, &Array),
    (y_field, y): (&Field, &Array),
) -> Option<Named> {
    let ((x_values, x_unit), (y_values, y_unit)) = (shown(x_field, x)?, shown(y_field, y)?);
    let (x_name, y_name) = (word(x_field).replace('_', " "), word(y_field).replace('_', " "));
    let mut letters = y_name.chars();
    let first = letters.next().map(char::to_uppercase).into_iter().flatten();
    let title = format!("{}{} over {x_name}", first.collect::<String>(), letters.as_str());
    let curve = Curve { x: x_values, y: y_values, ..Curve::default() };
    let note = note.into();
    let figure =
        Lines { title, note, x_name, x_unit, y_name, y_unit, curves: vec![curve], ..Lines::default() };
    Some((name, Figure::Lines(figure)))
}

/// Values of an array in the unit of figures.
fn shown(field: &Field, array: &Array) -> Option<(Vec<f64>, String)> {
    let Data::Real(values) = &array.data else { return None };
    let (factor, name) = match (field.names.json_factor(&array.unit), unit(&array.unit)) {
        (Some(to_rpm), _) => (to_rpm, "rpm".into()),
        (None, known) if known.name != "SI" => (known.factor, known.name.into()),
        (None, _) => (1.0, typographic_unit(&array.unit)),
    };
    Some((values.iter().map(|value| value * factor).collect(), name))
}

/// Name of a quantity without the unit that some names in JSON have.
fn word<'f>(field: &'f Field) -> &'f str {
    field.names.hdf5.as_deref().or(field.names.json.as_deref()).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;
    use rotordyn_core::document::{Rows, in_json, named, quantity};

    #[test]
    fn drawn_arrays_have_figures_over_their_axis() {
        let rows = Rows::of(&[[10.0, 1e-6], [20.0, 3e-6]])
            .over("speed")
            .quantity("speed", "rad/s", |p| p[0])
            .number(quantity("largest_deflection", "m"), "m", |p| p[1])
            .drawn()
            .number("not_drawn", "m", |p| p[1]);
        let level = Array::real(&[2], "m/s^2", vec![4.0, 5.0]).over(0, "time").drawn();
        let content = Document::new().text(in_json("channel"), "A_x").table("points", rows).group(
            "part",
            Document::new().array("level", level).numbers(named("time_s", "time"), "s", &[0.5, 1.0]),
        );
        let found = figures(&[Section::listed("all", "all", content)], "a machine");
        let texts =
            |l: &Lines| [&l.title, &l.x_name, &l.x_unit, &l.y_name, &l.y_unit, &l.note].map(String::clone);
        let [(first, Figure::Lines(deflection)), (second, Figure::Lines(level))] = &found[..] else {
            panic!("two line figures are expected: {found:?}");
        };
        assert_eq!(
            (first.as_str(), second.as_str()),
            ("all_A_x_points_largest_deflection", "all_A_x_part_level")
        );
        let expected =
            ["Largest deflection over speed", "speed", "rpm", "largest deflection", "µm", "a machine"];
        assert_eq!(texts(deflection), expected);
        assert_eq!(texts(level), ["Level over time", "time", "s", "level", "m/s²", "a machine"]);
        let to_rpm = 60.0 / std::f64::consts::TAU;
        assert_eq!(deflection.curves[0].x, [10.0 * to_rpm, 20.0 * to_rpm]);
        assert_eq!(deflection.curves[0].y, [1.0, 3e-6 * 1e6]);
        assert_eq!((&level.curves[0].x[..], &level.curves[0].y[..]), (&[0.5, 1.0][..], &[4.0, 5.0][..]));
    }
}
