//! Records from HDF5: results files of this program, and any file with numeric data sets.

use std::path::Path;

use super::array::{Array, Data};
use super::mapping::direction;
use super::{arrays, unit_label};
use crate::error::Error;
use crate::hdf5::{Attribute, ObjectKind, Store, read_recording};
use rotordyn_signal::record::{Axis, AxisQuantity, Dof, Kind, MeasuredData, Record, Values};

/// Attributes of data sets for unit, sampling rate, step and start in files of other programs.
const UNITS: [&str; 3] = ["unit", "units", "Unit"];
const RATES: [&str; 4] = ["fs", "sample_rate", "sampling_rate", "SamplingRate"];
const STEPS: [&str; 3] = ["dt", "wf_increment", "step"];
const STARTS: [&str; 2] = ["t0", "wf_start_offset"];

/// Reads the channels and FRFs of a results file, else every numeric data set of any other file.
///
/// # Errors
/// The file cannot be read.
pub fn read(path: &Path) -> Result<MeasuredData, Error> {
    let store = Store::open(path)?;
    let own = store.attribute("/meta", "program").ok().flatten() == Some(Attribute::Text("rotordyn".into()));
    if own && (store.contains("/time/t") || store.contains("/frf/response")) {
        return read_results_file(&store);
    }
    let (mut found, mut left_out) = (Vec::new(), Vec::new());
    collect_arrays(&store, "", &mut found, &mut left_out)?;
    let mut out = arrays::to_records(found);
    if !left_out.is_empty() {
        out.notes.push(format!("not read: {}", left_out.join(", ")));
    }
    Ok(out)
}

/// Writes records for [`read`] and h5py: one data set per array, as in .npz files.
///
/// # Errors
/// The file cannot be written.
pub fn write(path: &Path, measured: &MeasuredData) -> Result<(), Error> {
    let store = Store::create(path)?;
    for array in arrays::from_records(measured, usize::MAX) {
        let name = format!("/{}", array.name);
        let shape = if array.shape.is_empty() { vec![1] } else { array.shape.clone() };
        match &array.data {
            Data::Real(values) => store.write(&name, &shape, values, &[])?,
            Data::Complex(values) => store.write_complex(&name, &shape, values, &[])?,
            Data::Text(texts) => store.write_texts(&name, texts, &[])?,
        }
    }
    store.flush()
}

/// Every data set below a group as an array, with unit, rate and start from its attributes.
fn collect_arrays(
    store: &Store,
    group: &str,
    found: &mut Vec<Array>,
    left_out: &mut Vec<String>,
) -> Result<(), Error> {
    let members = store.members(if group.is_empty() { "/" } else { group })?;
    // MATLAB keeps the contents of cells in #refs#.
    for member in members.into_iter().filter(|name| !name.starts_with('#')) {
        let path = format!("{group}/{member}");
        let name = path[1..].replace('/', "_");
        let (shape, data) = match store.object_kind(&path)? {
            ObjectKind::Group => {
                collect_arrays(store, &path, found, left_out)?;
                continue;
            }
            ObjectKind::Real(shape) => (shape, Data::Real(store.read(&path)?.data)),
            ObjectKind::Complex(shape) => (shape, Data::Complex(store.read_complex(&path)?.data)),
            ObjectKind::Text(shape) => (shape, Data::Text(store.read_texts(&path)?)),
            ObjectKind::Other => {
                left_out.push(path);
                continue;
            }
        };
        let attribute =
            |names: &[&str]| names.iter().find_map(|name| store.attribute(&path, name).ok().flatten());
        let number = |names: &[&str]| match attribute(names) {
            Some(Attribute::Number(value)) => Some(value),
            Some(Attribute::Integer(value)) => Some(value as f64),
            _ => None,
        };
        if attribute(&["MATLAB_class"]) == Some(Attribute::Text("char".into())) {
            continue;
        }
        let rate = number(&RATES).or_else(|| number(&STEPS).map(|step| 1.0 / step));
        found.extend(rate.map(|rate| Array::scalar(&format!("{name}_fs"), rate)));
        found.extend(number(&STARTS).map(|start| Array::scalar(&format!("{name}_t0"), start)));
        if let Some(Attribute::Text(unit)) = attribute(&UNITS) {
            found.push(Array::text(&format!("{name}_unit"), &unit));
        }
        found.push(Array { name, shape, data });
    }
    Ok(())
}

/// Channels, shaft speed and FRFs of a results file.
fn read_results_file(store: &Store) -> Result<MeasuredData, Error> {
    let mut out = MeasuredData::default();
    if let Some(Attribute::Text(title)) = store.attribute("/meta", "title")? {
        out.title = title;
    }
    if store.contains("/time/t") {
        let run = read_recording(store, "")?;
        let order = match store.attribute("/channels", "names")? {
            Some(Attribute::Texts(names)) => names,
            _ => Vec::new(),
        };
        let mut channels = run.channels;
        channels.sort_by_key(|(channel, _)| order.iter().position(|name| *name == channel.name));
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
    if store.contains("/frf/response") {
        let texts = |name: &str| store.read_texts(&format!("/frf/{name}"));
        let (responses, excitations, units) = (texts("responses")?, texts("excitations")?, texts("units")?);
        let frequencies = store.read("/frf/frequency")?.data;
        let values = store.read_complex("/frf/response")?.data;
        for (r, response) in responses.iter().enumerate() {
            for (e, excitation) in excitations.iter().enumerate() {
                let at = r * excitations.len() + e;
                let lines = values[at * frequencies.len()..(at + 1) * frequencies.len()].to_vec();
                let axis = Axis::from_points(AxisQuantity::Frequency, frequencies.clone());
                let name = format!("{response}/{excitation}");
                let mut record = Record::new(&name, Kind::Frf, axis, Values::Complex(lines), &units[at]);
                record.response = Dof::new(r as i64 + 1, 0);
                record.reference = Dof::new(e as i64 + 1, 0);
                out.records.push(record);
            }
        }
    }
    Ok(out)
}
