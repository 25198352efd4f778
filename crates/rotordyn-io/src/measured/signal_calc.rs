//! MATLAB files of the analyser SignalCalc (Data Physics): arrays X1, H1_2, C1_2 of two columns, axis and
//! value.

use std::collections::HashMap;

use super::array::{Array, Data};
use super::unit_label;
use crate::budget::{Budget, Exceeded};
use rotordyn_signal::record::{Axis, AxisQuantity, Dof, Kind, MeasuredData, Record, Values};

/// Name of the array that identifies such a file: rows of "Signal H1_2", "Real/Imag g / N", position.
pub const INFO_ARRAY: &str = "DP_Info";

/// Records of the signals that the file lists.
///
/// The first number of a name is the reference's channel, the second the response's; of a single one, it is
/// the channel itself.
///
/// # Errors
/// More records or memory than the budget of the file has: a signal may be listed any number of times.
pub fn to_records(arrays: &[Array], budget: &Budget) -> Result<MeasuredData, Exceeded> {
    let mut out = MeasuredData::default();
    let rows = arrays.iter().find(|a| a.name == INFO_ARRAY);
    let Some(Array { data: Data::Text(rows), .. }) = rows else { return Ok(out) };
    let places: HashMap<&str, &Array> =
        arrays.iter().rev().map(|array| (array.name.as_str(), array)).collect();
    for pair in rows.windows(2) {
        let Some(name) = pair[0].strip_prefix("Signal ") else { continue };
        let Some(array) = places.get(name.trim()) else { continue };
        budget.objects("signals", 1)?;
        budget.take_values::<[f64; 2]>(|| format!("`{}`", array.name), array.data.len())?;
        let words = ["Real EU", "Mag EU", "Real/Imag", "dB Mag EU"];
        let label = words.iter().find_map(|form| pair[1].strip_prefix(form)).unwrap_or_default().trim();
        out.records.extend(record(array, label));
    }
    Ok(out)
}

fn record(array: &Array, label: &str) -> Option<Record> {
    if array.shape.get(1) != Some(&2) {
        return None;
    }
    let (x, mut values): (Vec<f64>, Values) = match &array.data {
        Data::Real(v) => {
            let rows = v.chunks_exact(2);
            (rows.clone().map(|r| r[0]).collect(), Values::Real(rows.map(|r| r[1]).collect()))
        }
        Data::Complex(v) => {
            let rows = v.chunks_exact(2);
            (rows.clone().map(|r| r[0].re).collect(), Values::Complex(rows.map(|r| r[1]).collect()))
        }
        Data::Text(_) => return None,
    };
    let numbers: Vec<i64> = array.name.get(1..)?.split('_').map_while(|n| n.parse().ok()).collect();
    let (reference, response) = match numbers[..] {
        [one] => (0, one),
        [first, second] => (first, second),
        _ => return None,
    };
    let auto = reference == response;
    let kind = match array.name.as_bytes().first()? {
        b'X' | b'W' | b'Z' => Kind::Time,
        b'H' => Kind::Frf,
        b'C' => Kind::Coherence,
        b'G' | b'S' if auto => Kind::AutoSpectrum,
        b'S' if numbers.len() == 1 => Kind::Spectrum,
        b'G' | b'S' => Kind::CrossSpectrum,
        _ => Kind::General,
    };
    let quantity = if kind == Kind::Time { AxisQuantity::Time } else { AxisQuantity::Frequency };
    let known = unit_label::si(label);
    if let Some(known) = &known {
        values.scale(known.numerator, known.divisor);
    }
    let unit = match known {
        Some(known) => known.name,
        None if kind == Kind::Coherence => "1".into(),
        None => String::new(),
    };
    let mut record = Record::new(&array.name, kind, Axis::from_points(quantity, x), values, &unit);
    record.file_unit = label.into();
    record.response = Dof::new(response, 0);
    record.reference = if auto { Dof::NONE } else { Dof::new(reference, 0) };
    Some(record)
}
