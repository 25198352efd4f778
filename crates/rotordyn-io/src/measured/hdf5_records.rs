//! Records from HDF5: results files of this program, and any file with numeric data sets.

use std::collections::HashMap;
use std::path::Path;

use super::array::Data;
use super::hdf5_arrays::Collected;
use super::mapping::direction;
use super::{arrays, ramps, record_arrays, unit_label};
use crate::budget::{Budget, Limits};
use crate::error::Error;
use crate::hdf5::{Attribute, Reader, Store, open_reader, read_recording};
use rotordyn_signal::record::{Axis, AxisQuantity, Dof, Kind, MeasuredData, Record, Values};

/// Reads the channels and FRFs of a results file, else every numeric data set of any other file.
///
/// `given_rate` \[Hz\] holds where two sampling rates are stated for a record.
///
/// # Errors
/// The file cannot be read, states two sampling rates, or exceeds its budget.
pub fn read(path: &Path, limits: &Limits, given_rate: Option<f64>) -> Result<MeasuredData, Error> {
    let file = open_reader(path, limits)?;
    let program = if file.contains("/meta")? { file.attribute("/meta", "program")? } else { None };
    let own = program == Some(Attribute::Text("rotordyn".into()));
    if own && (file.contains("/time/t")? || file.contains("/frf/response")?) {
        return read_results_file(&*file);
    }
    let size = std::fs::metadata(path).map_err(Error::of_file("read", path))?.len();
    let budget = Budget::new(limits, size);
    let Collected { found, left_out, .. } = Collected::of_file(&*file, &budget)?;
    let mut out = arrays::to_records(&found, &budget, given_rate).map_err(|problem| problem.of_file(path))?;
    out.left_out.splice(0..0, left_out);
    ramps::take_times(&mut out, given_rate);
    Ok(out)
}

/// Writes records for [`read`] and h5py: one data set per array, as in .npz files.
///
/// # Errors
/// The file cannot be written.
pub fn write(path: &Path, measured: &MeasuredData) -> Result<(), Error> {
    let store = Store::replace(path)?;
    for array in record_arrays::from_records(measured, usize::MAX) {
        let name = format!("/{}", array.name);
        let shape = if array.shape.is_empty() { vec![1] } else { array.shape.clone() };
        match &array.data {
            Data::Real(values) => store.write(&name, &shape, values, &[])?,
            Data::Complex(values) => store.write_complex(&name, &shape, values, &[])?,
            Data::Text(texts) => store.write_texts(&name, texts, &[])?,
        }
    }
    store.commit()
}

/// Channels, shaft speed and FRFs of a results file.
fn read_results_file(file: &dyn Reader) -> Result<MeasuredData, Error> {
    let mut out = MeasuredData::default();
    if let Some(Attribute::Text(title)) = file.attribute("/meta", "title")? {
        out.title = title;
    }
    if file.contains("/time/t")? {
        let run = read_recording(file, "")?;
        let mut channels = run.channels;
        if let Some(Attribute::Texts(order)) = file.attribute("/channels", "names")? {
            let places: HashMap<&str, usize> =
                order.iter().enumerate().rev().map(|(k, name)| (name.as_str(), k)).collect();
            channels.sort_by_key(|(channel, _)| places.get(channel.name.as_str()).copied());
        }
        let record = |name: &str, unit: &str, values: Vec<f64>| {
            let si = unit_label::si(unit).map_or(String::new(), |si| si.name);
            let axis = Axis::uniform(AxisQuantity::Time, run.start, 1.0 / run.sample_rate);
            let mut record = Record::new(name, Kind::Time, axis, Values::Real(values), &si);
            record.file_unit = unit.into();
            record
        };
        for (channel, values) in channels {
            let mut channel_record = record(&channel.name, &channel.unit, values);
            channel_record.response.direction = direction(&channel.direction).unwrap_or(0);
            out.records.push(channel_record);
        }
        out.records.push(record("theta", "rad", run.angle));
        out.records.push(record("speed", "rad/s", run.speed));
        if run.state != "complete" {
            out.notes.push(format!("the run is incomplete: {}", run.state));
        }
    }
    if file.contains("/frf/response")? {
        frf_records(file, &mut out)?;
    }
    Ok(out)
}

/// FRFs of a results file: response \[response, excitation, frequency\].
fn frf_records(file: &dyn Reader, out: &mut MeasuredData) -> Result<(), Error> {
    let texts = |name: &str| file.read_texts(&format!("/frf/{name}"));
    let (responses, excitations, units) = (texts("responses")?, texts("excitations")?, texts("units")?);
    let frequencies = file.read("/frf/frequency")?.data;
    let values = file.read_complex("/frf/response")?;
    let shape = [responses.len(), excitations.len(), frequencies.len()];
    let frfs = responses.len().saturating_mul(excitations.len());
    if values.shape != shape || units.len() != frfs {
        return Err(Error::Content {
            path: file.path().into(),
            problem: format!(
                "/frf/response of shape {:?} and {} units do not belong to {} responses, {} excitations and {} \
                 frequencies",
                values.shape,
                units.len(),
                shape[0],
                shape[1],
                shape[2]
            ),
            advice: "compute it again with `rotordyn frf`".into(),
        });
    }
    for (r, response) in responses.iter().enumerate() {
        for (e, excitation) in excitations.iter().enumerate() {
            let at = r * excitations.len() + e;
            let lines = values.data[at * frequencies.len()..(at + 1) * frequencies.len()].to_vec();
            let axis = Axis::from_points(AxisQuantity::Frequency, frequencies.clone());
            let name = format!("{response}/{excitation}");
            let mut record = Record::new(&name, Kind::Frf, axis, Values::Complex(lines), &units[at]);
            record.response = Dof::new(r as i64 + 1, 0);
            record.reference = Dof::new(e as i64 + 1, 0);
            out.records.push(record);
        }
    }
    Ok(())
}
