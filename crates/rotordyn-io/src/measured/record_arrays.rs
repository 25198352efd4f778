//! Named arrays from records, for .mat, .npz and HDF5 files.
//!
//! With the array `name` of a record: `fs` \[Hz\] and `t0` \[s\], or `freq_hz`, for all records of one axis; else
//! `name_fs`, `name_t0`, `name_t`, `name_freq_hz`. Then `name_unit`, `name_kind`, `name_dof` (response node and
//! direction, reference node and direction), `name_rpm` and, if the record's name is not valid in the format, that name
//! as `name_name` (`name_is` in earlier files).

use super::array::{Array, Data};
use rotordyn_signal::record::{Axis, AxisQuantity, Dof, Kind, MeasuredData, Points, Record, Values};

/// Arrays of the records; names start with a letter and have at most `name_length` letters, digits and
/// underscores.
///
/// Geometry and shapes are not stored.
pub fn from_records(measured: &MeasuredData, name_length: usize) -> Vec<Array> {
    let mut out: Vec<Array> = Vec::new();
    if !measured.title.is_empty() {
        out.push(Array::text("title", &measured.title));
    }
    let on = |quantity| measured.records.iter().filter(move |r| r.axis.quantity == quantity);
    let common = |quantity: AxisQuantity| {
        let first = on(quantity).next()?;
        let same = |r: &Record| r.axis == first.axis && r.values.len() == first.values.len();
        on(quantity).all(same).then_some(first)
    };
    let time = common(AxisQuantity::Time);
    if let Some(Record { axis: Axis { points: Points::Uniform { start, step }, .. }, .. }) = time {
        out.push(Array::scalar("fs", 1.0 / step));
        if *start != 0.0 {
            out.push(Array::scalar("t0", *start));
        }
    }
    let frequency = common(AxisQuantity::Frequency);
    if let Some(list) = frequency.and_then(|r| r.axis.points(r.values.len())) {
        out.push(Array::real("freq_hz", list));
    }
    out.extend(measured.scalars.iter().map(|(name, value)| Array::scalar(&valid_array_name(name), *value)));
    for record in &measured.records {
        let mut name: String = valid_array_name(&record.name).chars().take(name_length - 8).collect();
        while out.iter().any(|a| a.name == name) {
            name.push('_');
        }
        let own = |suffix: &str| format!("{name}_{suffix}");
        let mut properties = Vec::new();
        match (record.axis.quantity, &record.axis.points) {
            (AxisQuantity::Time, Points::Uniform { start, step }) if time.is_none() => {
                properties.push(Array::scalar(&own("fs"), 1.0 / step));
                properties.push(Array::scalar(&own("t0"), *start));
            }
            (AxisQuantity::Time, Points::NonUniform(list)) => {
                properties.push(Array::real(&own("t"), list.clone()))
            }
            (AxisQuantity::Frequency, _) if frequency.is_none() => {
                let list = record.axis.points(record.values.len()).unwrap_or_default();
                properties.push(Array::real(&own("freq_hz"), list));
            }
            _ => {}
        }
        let unit = if record.unit.is_empty() { &record.file_unit } else { &record.unit };
        if !unit.is_empty() {
            properties.push(Array::text(&own("unit"), unit));
        }
        // A time record may by chance be as long as the list of frequencies.
        if record.kind != Kind::Time || frequency.is_some() {
            properties.push(Array::text(&own("kind"), record.kind.label()));
        }
        if (record.response, record.reference) != (Dof::NONE, Dof::NONE) {
            let (at, from) = (record.response, record.reference);
            let dof = [at.node as f64, at.direction.into(), from.node as f64, from.direction.into()];
            properties.push(Array::real(&own("dof"), dof.to_vec()));
        }
        properties.extend(record.speed_rpm.map(|rpm| Array::scalar(&own("rpm"), rpm)));
        if name != record.name {
            properties.push(Array::text(&own("name"), &record.name));
        }
        let data = match &record.values {
            Values::Real(values) => Data::Real(values.clone()),
            Values::Complex(values) => Data::Complex(values.clone()),
        };
        out.push(Array { name, shape: vec![record.values.len()], data });
        out.extend(properties);
    }
    out
}

/// A name of letters, digits and underscores that begins with a letter.
fn valid_array_name(name: &str) -> String {
    let plain: String = name.chars().map(|c| if c.is_ascii_alphanumeric() { c } else { '_' }).collect();
    if plain.starts_with(|c: char| c.is_ascii_alphabetic()) { plain } else { format!("x{plain}") }
}
