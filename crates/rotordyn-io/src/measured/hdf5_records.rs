//! Records from HDF5: results files of this program, and any file with numeric data sets.

use std::collections::HashMap;
use std::path::Path;

use super::array::{Array, Data};
use super::mapping::direction;
use super::{arrays, unit_label};
use crate::budget::{Budget, Limits, MAX_DEPTH};
use crate::error::Error;
use crate::hdf5::{
    Attribute, Link, LinkTarget, Links, ObjectKind, Reader, Store, open_reader, read_recording,
};
use rotordyn_signal::Complex;
use rotordyn_signal::record::{Axis, AxisQuantity, Dof, Kind, MeasuredData, Record, Values};

/// Attributes of data sets for unit, sampling rate, step and start in files of other programs.
const UNITS: [&str; 3] = ["unit", "units", "Unit"];
const RATES: [&str; 4] = ["fs", "sample_rate", "sampling_rate", "SamplingRate"];
const STEPS: [&str; 3] = ["dt", "wf_increment", "step"];
const STARTS: [&str; 2] = ["t0", "wf_start_offset"];

/// Reads the channels and FRFs of a results file, else every numeric data set of any other file.
///
/// # Errors
/// The file cannot be read, or exceeds its budget.
pub fn read(path: &Path, limits: &Limits) -> Result<MeasuredData, Error> {
    let file = open_reader(path, limits)?;
    let program = if file.contains("/meta")? { file.attribute("/meta", "program")? } else { None };
    let own = program == Some(Attribute::Text("rotordyn".into()));
    if own && (file.contains("/time/t")? || file.contains("/frf/response")?) {
        return read_results_file(&*file);
    }
    let size = std::fs::metadata(path).map_err(Error::of_file("read", path))?.len();
    let budget = Budget::new(limits, size);
    let mut collected = Collected {
        file: &*file,
        budget: &budget,
        found: Vec::new(),
        left_out: Vec::new(),
        seen: HashMap::new(),
    };
    collected.group("", 0)?;
    let Collected { found, left_out, .. } = collected;
    let mut out = arrays::to_records(&found, &budget).map_err(|exceeded| exceeded.of_file(path))?;
    out.left_out = left_out;
    Ok(out)
}

/// Writes records for [`read`] and h5py: one data set per array, as in .npz files.
///
/// # Errors
/// The file cannot be written.
pub fn write(path: &Path, measured: &MeasuredData) -> Result<(), Error> {
    let store = Store::replace(path)?;
    for array in arrays::from_records(measured, usize::MAX) {
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

/// The data sets of a file as arrays, with unit, rate and start from their attributes.
struct Collected<'a> {
    file: &'a dyn Reader,
    budget: &'a Budget,
    found: Vec<Array>,
    /// Names of what is not read, with the reason.
    left_out: Vec<String>,
    /// Path of every group by the mark of its place.
    seen: HashMap<String, String>,
}

impl Collected<'_> {
    /// Every data set below a group ("" for the root), which is `depth` groups deep.
    fn group(&mut self, group: &str, depth: usize) -> Result<(), Error> {
        let whole = if group.is_empty() { "/" } else { group };
        let Links { group: mark, links } = match self.file.links(whole) {
            Ok(links) => links,
            Err(error) => return self.leave_out(whole, error),
        };
        self.seen.insert(mark, whole.into());
        self.count("links", links.len())?;
        // MATLAB keeps the contents of cells in #refs#.
        for Link { name, target } in links.into_iter().filter(|link| !link.name.starts_with('#')) {
            let path = format!("{group}/{name}");
            match target {
                LinkTarget::Group(mark) => match self.seen.get(&mark) {
                    Some(same) => self.left_out.push(format!("{path} (the group {same} again)")),
                    None if depth == MAX_DEPTH => {
                        self.left_out.push(format!("{path} (more than {MAX_DEPTH} groups deep)"));
                    }
                    None => self.group(&path, depth + 1)?,
                },
                LinkTarget::DataSet(kind) => {
                    let bytes = memory_of(&kind);
                    let whole = Budget::of_memory(self.file.memory());
                    if let Err(exceeded) = whole.take(|| "it".into(), bytes) {
                        let advice = exceeded.advice();
                        self.left_out.push(format!("{path} ({exceeded}; {advice})"));
                        continue;
                    }
                    // All data sets together are another matter than one that nobody can read.
                    let taken = self.budget.take(|| path.clone(), bytes);
                    taken.map_err(|exceeded| exceeded.of_file(self.file.path()))?;
                    if let Err(error) = self.data_set(&path, kind) {
                        self.leave_out(&path, error)?;
                    }
                }
                LinkTarget::Nothing(why) => self.left_out.push(format!("{path} ({why})")),
            }
        }
        Ok(())
    }

    /// Notes an object that cannot be read, unless nothing can be read any more.
    fn leave_out(&mut self, path: &str, error: Error) -> Result<(), Error> {
        self.file.contains("/")?;
        match error {
            Error::Content { problem, .. } => {
                self.left_out.push(format!("{path} ({})", problem.trim_start_matches(&format!("{path}: "))));
            }
            other => return Err(other),
        }
        Ok(())
    }

    fn count(&self, what: &str, count: usize) -> Result<(), Error> {
        self.budget.objects(what, count).map_err(|exceeded| exceeded.of_file(self.file.path()))
    }

    fn data_set(&mut self, path: &str, kind: ObjectKind) -> Result<(), Error> {
        let name = path[1..].replace('/', "_");
        let attributes = self.file.attributes(path)?;
        let attribute = |names: &[&str]| {
            names.iter().find_map(|name| Some(&attributes.iter().find(|(n, _)| n == name)?.1))
        };
        let number = |names: &[&str]| match attribute(names) {
            Some(Attribute::Number(value)) => Some(*value),
            Some(Attribute::Integer(value)) => Some(*value as f64),
            Some(Attribute::Numbers(values)) if values.len() == 1 => Some(values[0]),
            _ => None,
        };
        let text = |names: &[&str]| match attribute(names) {
            Some(Attribute::Text(text)) => Some(text.clone()),
            Some(Attribute::Texts(texts)) if texts.len() == 1 => Some(texts[0].clone()),
            _ => None,
        };
        let is_text = text(&["MATLAB_class"]).as_deref() == Some("char");
        let (shape, data) = match kind {
            ObjectKind::Complex(_) => {
                let array = self.file.read_complex(path)?;
                (array.shape, Data::Complex(array.data))
            }
            ObjectKind::Text(shape) => (shape, Data::Text(self.file.read_texts(path)?)),
            _ => {
                let array = self.file.read(path)?;
                match is_text {
                    true => {
                        let texts = matlab_texts(&array.shape, &array.data);
                        (vec![texts.len()], Data::Text(texts))
                    }
                    false => (array.shape, Data::Real(array.data)),
                }
            }
        };
        let rate = number(&RATES).or_else(|| number(&STEPS).map(|step| 1.0 / step));
        self.found.extend(rate.map(|rate| Array::scalar(&format!("{name}_fs"), rate)));
        self.found.extend(number(&STARTS).map(|start| Array::scalar(&format!("{name}_t0"), start)));
        if let Some(unit) = text(&UNITS) {
            self.found.push(Array::text(&format!("{name}_unit"), &unit));
        }
        self.found.push(Array { name, shape, data });
        Ok(())
    }
}

/// Memory of the values of a data set \[bytes\].
fn memory_of(kind: &ObjectKind) -> u64 {
    let (shape, value) = match kind {
        ObjectKind::Real(shape) => (shape, size_of::<f64>()),
        ObjectKind::Complex(shape) => (shape, size_of::<Complex<f64>>()),
        ObjectKind::Text(shape) => (shape, size_of::<String>()),
        ObjectKind::Group | ObjectKind::Other => return 0,
    };
    shape.iter().fold(value as u64, |product, n| product.saturating_mul(*n as u64))
}

/// Rows of a text of MATLAB 7.3: codes over column and row.
fn matlab_texts(shape: &[usize], codes: &[f64]) -> Vec<String> {
    let [_, rows] = *shape else { return Vec::new() };
    let row = |k: usize| {
        let units = codes.iter().skip(k).step_by(rows).map(|&code| code as u16);
        let text: String =
            char::decode_utf16(units).map(|c| c.unwrap_or(char::REPLACEMENT_CHARACTER)).collect();
        text.trim_matches(|c: char| c == '\0' || c.is_whitespace()).to_owned()
    };
    // Empty ones state their size as numbers.
    if codes.len() < rows { Vec::new() } else { (0..rows).map(row).collect() }
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
