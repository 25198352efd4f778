//! Conversion between records and the named arrays of .mat, .npz and HDF5 files.
//!
//! Arrays written with the array `name` of a record: `fs` \[Hz\] and `t0` \[s\], or `freq_hz`, for all
//! records of one axis; else `name_fs`, `name_t0`, `name_t`, `name_freq_hz`. Then `name_unit`, `name_kind`,
//! `name_dof` (response node and direction, reference node and direction), `name_rpm` and, if the record's
//! name is not valid in the format, that name as `name_name` (`name_is` in earlier files).
//!
//! Arrays of other programs are interpreted by name: `fs`, `dt`, `time`, `frequency`; complex values over
//! frequency are FRFs; names that begin with `coh` are coherence; a scalar that ends in `RPM` is the speed of
//! the records with the same prefix. H\[i, j, line\] becomes one record for each response i + 1 and reference
//! j + 1. Arrays of a structure, `bearing.gs`, have its axes, `bearing.sr`, else those of the structures around it.

use std::collections::HashMap;

pub use super::array::{Array, Data};
use super::{signal_calc, unit_label};
use crate::budget::{Budget, Exceeded, MAX_DEPTH};
use rotordyn_signal::record::{Axis, AxisQuantity, Dof, Kind, MeasuredData, Points, Record, Values};

// Names of axes in lower case, the most definite first: of `sr` and `rate` the second may be the shaft's.
const RATES: [&str; 15] = [
    "fs",
    "fs_hz",
    "sample_rate",
    "samplerate",
    "sampling_rate",
    "samplingrate",
    "sample_frequency",
    "samplefrequency",
    "sampling_frequency",
    "samplingfrequency",
    "fsample",
    "fsamp",
    "sr",
    "srate",
    "rate",
];
const STEPS: [&str; 7] = ["dt", "delta_t", "deltat", "time_step", "timestep", "sample_interval", "ts"];
const TIMES: [&str; 8] = ["time", "t", "time_s", "t_s", "times", "time_domain", "tvec", "x_value"];
const FREQUENCIES: [&str; 11] = [
    "freq_hz",
    "frequency",
    "frequencies",
    "freq",
    "freqs",
    "f",
    "f_hz",
    "frequency_hz",
    "freq_domain",
    "frequency_domain",
    "fvec",
];
const UNITS: [&str; 2] = ["unit", "units"];

/// Suffixes of arrays that describe another array.
const PROPERTY_SUFFIXES: [&str; 10] =
    ["fs", "t0", "t", "freq_hz", "unit", "kind", "dof", "rpm", "name", "is"];

/// Records from arrays, by the naming rules above.
///
/// # Errors
/// More records or memory than the budget of the file has.
pub fn to_records(arrays: &[Array], budget: &Budget) -> Result<MeasuredData, Exceeded> {
    if arrays.iter().any(|a| a.name == signal_calc::INFO_ARRAY) {
        return signal_calc::to_records(arrays, budget);
    }
    let file = File::new(arrays);
    let mut out = MeasuredData::default();
    let mut axes: HashMap<&str, Axes> = HashMap::new();
    for array in arrays {
        let structure = structure_of(&array.name);
        let axes = axes.entry(structure).or_insert_with(|| file.axes(structure));
        if file.is_axis_list(array) || file.is_attribute(&array.name) {
            continue;
        }
        match (&array.data, array.as_scalar()) {
            (Data::Text(_), _) => {}
            (data, _) if data.is_empty() => {}
            (_, Some(_)) if file.is_axis_setting(array) => {}
            (_, Some(value)) => out.scalars.push((array.name.clone(), value)),
            _ => file.records(array, axes, budget, &mut out)?,
        }
    }
    assign_speeds(&mut out);
    if let Some(title) = file.get("title").and_then(Array::as_text) {
        out.title = title.into();
    }
    Ok(out)
}

struct File<'a> {
    arrays: &'a [Array],
    /// Place of the first array of a name.
    places: HashMap<&'a str, usize>,
    /// Place of the first array of a structure ("" for none) and a name in lower case.
    members: HashMap<(&'a str, String), usize>,
    /// Number of numeric arrays of more than one value of every structure.
    lists: HashMap<&'a str, usize>,
}

/// Structure of a path, `bearing` of `bearing.gs`; "" for none.
fn structure_of(name: &str) -> &str {
    name.rsplit_once('.').map_or("", |(structure, _)| structure)
}

/// Name without the structure's path.
fn last_name(name: &str) -> &str {
    name.rsplit_once('.').map_or(name, |(_, last)| last)
}

/// Common axes of all records of a file or a structure.
struct Axes<'a> {
    /// Uniform time axis: start and step.
    rate: Option<Points>,
    time: Option<&'a [f64]>,
    frequency: Option<&'a [f64]>,
}

impl<'a> File<'a> {
    fn new(arrays: &'a [Array]) -> Self {
        let places = arrays.iter().enumerate().rev().map(|(k, array)| (array.name.as_str(), k)).collect();
        let key = |name: &'a str| (structure_of(name), last_name(name).to_lowercase());
        let members = arrays.iter().enumerate().rev().map(|(k, array)| (key(&array.name), k)).collect();
        let mut lists = HashMap::new();
        for array in arrays.iter().filter(|a| a.data.len() > 1 && !matches!(a.data, Data::Text(_))) {
            *lists.entry(structure_of(&array.name)).or_insert(0) += 1;
        }
        Self { arrays, places, members, lists }
    }

    fn get(&self, name: &str) -> Option<&'a Array> {
        self.places.get(name).map(|&k| &self.arrays[k])
    }

    /// First of the names that a structure has, in any case.
    fn member(&self, structure: &'a str, names: &[&str]) -> Option<&'a Array> {
        names.iter().find_map(|name| Some(&self.arrays[*self.members.get(&(structure, (*name).into()))?]))
    }

    /// Increasing list with one of the names.
    fn increasing_list(&self, structure: &'a str, names: &[&str]) -> Option<&'a [f64]> {
        let list = self.member(structure, names)?.as_list();
        list.filter(|list| list.windows(2).all(|pair| pair[0] < pair[1]))
    }

    /// Axes of a structure, else those of the structures around it.
    fn axes(&self, structure: &'a str) -> Axes<'a> {
        let mut found = Axes { rate: None, time: None, frequency: None };
        let mut at = structure;
        for _ in 0..=MAX_DEPTH {
            found.rate = found.rate.or_else(|| self.rate(at));
            found.time = found.time.or_else(|| self.increasing_list(at, &TIMES));
            found.frequency = found.frequency.or_else(|| self.increasing_list(at, &FREQUENCIES));
            if at.is_empty() {
                break;
            }
            at = structure_of(at);
        }
        found
    }

    fn rate(&self, structure: &'a str) -> Option<Points> {
        let scalar = |names: &[&str]| self.member(structure, names).and_then(Array::as_scalar);
        let step = scalar(&RATES).map(|rate| 1.0 / rate).or_else(|| scalar(&STEPS));
        let start = scalar(&["t0"]).unwrap_or(0.0);
        step.filter(|step| *step > 0.0 && step.is_finite()).map(|step| Points::Uniform { start, step })
    }

    /// Whether an array is a list of times or frequencies.
    fn is_axis_list(&self, array: &'a Array) -> bool {
        let structure = structure_of(&array.name);
        let named = [&TIMES[..], &FREQUENCIES].into_iter().filter_map(|names| self.member(structure, names));
        array.as_list().is_some() && named.into_iter().any(|axis| std::ptr::eq(axis, array))
    }

    /// Whether a scalar is the rate, the step or the start of an axis.
    fn is_axis_setting(&self, array: &'a Array) -> bool {
        let structure = structure_of(&array.name);
        let named =
            [&RATES[..], &STEPS, &["t0"]].into_iter().filter_map(|names| self.member(structure, names));
        named.into_iter().any(|setting| std::ptr::eq(setting, array))
    }

    /// Unit stated beside the only record of a structure.
    fn unit_of_structure(&self, array: &'a Array) -> Option<&'a str> {
        let structure = structure_of(&array.name);
        let is_list = |axis: &&Array| axis.as_list().is_some();
        let axes = [&TIMES[..], &FREQUENCIES].into_iter().filter_map(|names| self.member(structure, names));
        let records = self.lists.get(structure)?.saturating_sub(axes.filter(is_list).count());
        let alone = !structure.is_empty() && records == 1;
        self.member(structure, &UNITS).filter(|_| alone).and_then(Array::as_text)
    }

    /// Whether a name is that of another array with a suffix for its properties.
    fn is_attribute(&self, name: &str) -> bool {
        PROPERTY_SUFFIXES.iter().any(|suffix| {
            let of = name.strip_suffix(suffix).and_then(|base| base.strip_suffix('_'));
            of.is_some_and(|base| self.get(base).is_some_and(|a| !matches!(a.data, Data::Text(_))))
        })
    }

    /// The records of one array.
    fn records(
        &self,
        array: &'a Array,
        axes: &Axes,
        budget: &Budget,
        out: &mut MeasuredData,
    ) -> Result<(), Exceeded> {
        let own = |suffix: &str| self.get(&format!("{}_{suffix}", array.name));
        let name = own("name").or_else(|| own("is")).and_then(Array::as_text).unwrap_or(&array.name);
        let stated = own("unit").and_then(Array::as_text).or_else(|| self.unit_of_structure(array));
        let stated = stated.unwrap_or_default();
        let kind = own("kind").and_then(Array::as_text);
        let kind = kind.and_then(|word| Kind::LABELS.iter().find(|k| k.1 == word)).map(|k| k.0);
        let shape = array.squeezed();
        if let Some(column) = two_column_record(array, axes) {
            out.notes.push(format!("`{name}`: its first column is taken as time"));
            out.records.push(column);
            return Ok(());
        }
        let slices = self.slices_along_axis(array, &shape, axes, budget)?;
        for Slice { index, mut values, axis } in slices {
            let mut numbers: Vec<String> = index.iter().map(|k| (k + 1).to_string()).collect();
            let label =
                if index.is_empty() { name.to_owned() } else { format!("{name}[{}]", numbers.join(",")) };
            let kind = kind.unwrap_or_else(|| guess_kind(last_name(&array.name), &values, axis.quantity));
            let known = unit_label::si(stated);
            if let Some(known) = &known {
                values.scale(known.numerator, known.divisor);
            }
            let unit = match known {
                Some(known) => known.name,
                None if kind == Kind::Coherence && stated.is_empty() => "1".into(),
                None => String::new(),
            };
            let mut record = Record::new(&label, kind, axis, values, &unit);
            if !stated.is_empty() {
                record.file_unit = stated.into();
            }
            if let Some(Data::Real(dof)) = own("dof").map(|a| &a.data) {
                if let [node, way, reference, its_way] = dof[..] {
                    record.response = Dof::new(node as i64, way as i8);
                    record.reference = Dof::new(reference as i64, its_way as i8);
                }
            } else if axis_is_frequency(&record) {
                let mut nodes = numbers.drain(..).filter_map(|n| n.parse().ok());
                record.response.node = nodes.next().unwrap_or(0);
                record.reference.node = nodes.next().unwrap_or(0);
            }
            record.speed_rpm = own("rpm").and_then(Array::as_scalar);
            out.records.push(record);
        }
        Ok(())
    }

    /// One-dimensional slices of an array along its axis.
    fn slices_along_axis(
        &self,
        array: &Array,
        shape: &[usize],
        axes: &Axes,
        budget: &Budget,
    ) -> Result<Vec<Slice>, Exceeded> {
        let own = |suffix: &str| self.get(&format!("{}_{suffix}", array.name));
        let own_list = |suffix: &str| own(suffix).and_then(Array::as_list);
        let even = |rate: f64| {
            let start = own("t0").and_then(Array::as_scalar).unwrap_or(0.0);
            Axis::uniform(AxisQuantity::Time, start, 1.0 / rate)
        };
        let is_time = own("kind").and_then(Array::as_text) == Some(Kind::Time.label())
            || array.name.to_lowercase().ends_with("_time");
        let frequency = axes.frequency.filter(|_| !is_time);
        let over = |count: usize| {
            let fits = |list: &&[f64]| list.len() == count;
            if let Some(rate) = own("fs").and_then(Array::as_scalar).filter(|rate| *rate > 0.0) {
                even(rate)
            } else if let Some(list) = own_list("t").filter(fits) {
                Axis::from_points(AxisQuantity::Time, list.to_vec())
            } else if let Some(list) = own_list("freq_hz").filter(fits).or(frequency.filter(fits)) {
                Axis::from_points(AxisQuantity::Frequency, list.to_vec())
            } else if let Some(list) = axes.time.filter(fits) {
                Axis::from_points(AxisQuantity::Time, list.to_vec())
            } else if let Some(points) = axes.rate.clone() {
                Axis { quantity: AxisQuantity::Time, points }
            } else {
                Axis::UNKNOWN
            }
        };
        // The axis of a matrix is the dimension of the length of a known axis, else the longest.
        let has_axis =
            |count: usize| [frequency, axes.time].into_iter().flatten().any(|list| list.len() == count);
        let along = (0..shape.len())
            .rev()
            .find(|&k| has_axis(shape[k]))
            .or_else(|| (0..shape.len()).rev().max_by_key(|&k| shape[k]))
            .unwrap_or(0);
        let count = shape.get(along).copied().unwrap_or(1);
        let stride: usize = shape.iter().skip(along + 1).product();
        let outer: usize = shape.iter().take(along).product();
        // The values as a record, and a list of axis points of each.
        let complex = matches!(array.data, Data::Complex(_));
        let each = size_of::<f64>() * if complex { 3 } else { 2 } * count + size_of::<Record>();
        budget.objects("channels", stride.saturating_mul(outer))?;
        let what = || format!("the channels of `{}`", array.name);
        budget.take(what, (stride.saturating_mul(outer) as u64).saturating_mul(each as u64))?;
        let mut out = Vec::new();
        for lead in 0..outer {
            for trail in 0..stride {
                let places = (0..count).map(|k| (lead * count + k) * stride + trail);
                let values = match &array.data {
                    Data::Real(v) => Values::Real(places.map(|at| v[at]).collect()),
                    Data::Complex(v) => Values::Complex(places.map(|at| v[at]).collect()),
                    Data::Text(_) => continue,
                };
                let index = index_of(lead, &shape[..along])
                    .into_iter()
                    .chain(index_of(trail, &shape[(along + 1).min(shape.len())..]));
                out.push(Slice { index: index.collect(), values, axis: over(count) });
            }
        }
        Ok(out)
    }
}

/// Record from a two-column array whose first column is a uniform axis, if the file has no other axis.
fn two_column_record(array: &Array, axes: &Axes) -> Option<Record> {
    let Data::Real(values) = &array.data else { return None };
    let has_other_axis = axes.rate.is_some() || axes.time.is_some() || axes.frequency.is_some();
    if has_other_axis || array.shape.len() != 2 || array.shape[1] != 2 || array.shape[0] < 3 {
        return None;
    }
    let column = |k: usize| values.iter().skip(k).step_by(2).copied().collect::<Vec<f64>>();
    let axis = Axis::from_points(AxisQuantity::Time, column(0));
    let even = matches!(axis.points, Points::Uniform { .. });
    even.then(|| Record::new(&array.name, Kind::Time, axis, Values::Real(column(1)), ""))
}

/// One slice of an array along its axis, with its index in the other dimensions.
struct Slice {
    index: Vec<usize>,
    values: Values,
    axis: Axis,
}

fn index_of(mut flat: usize, shape: &[usize]) -> Vec<usize> {
    let mut index: Vec<usize> = shape
        .iter()
        .rev()
        .map(|n| {
            let here = flat % n;
            flat /= n;
            here
        })
        .collect();
    index.reverse();
    index
}

fn axis_is_frequency(record: &Record) -> bool {
    record.axis.quantity == AxisQuantity::Frequency
}

/// Kind of a record, guessed from its name, value type and axis.
pub(crate) fn guess_kind(name: &str, values: &Values, axis: AxisQuantity) -> Kind {
    let name = name.to_lowercase();
    let begins = |heads: &[&str]| heads.iter().any(|head| name.starts_with(head));
    match (axis, values) {
        (AxisQuantity::Frequency, Values::Complex(_)) => Kind::Frf,
        (AxisQuantity::Frequency, _) if begins(&["coh", "gamma"]) => Kind::Coherence,
        (AxisQuantity::Frequency, _) if begins(&["psd", "pxx", "gxx", "sxx"]) => Kind::Psd,
        (AxisQuantity::Frequency, _) => Kind::Spectrum,
        (_, Values::Complex(_)) => Kind::General,
        _ => Kind::Time,
    }
}

/// Assigns a speed `<prefix>RPM` to the time records with that prefix, a single speed to all.
fn assign_speeds(out: &mut MeasuredData) {
    let is_speed = |name: &str| name.to_lowercase().ends_with("rpm");
    let speeds: Vec<_> = out.scalars.iter().filter(|(name, _)| is_speed(name)).collect();
    // The first speed of every prefix, with its place.
    let mut prefixes: HashMap<&str, (usize, f64)> = HashMap::new();
    for (k, (name, rpm)) in speeds.iter().enumerate().rev() {
        let prefix = name.get(..name.len() - 3).unwrap_or_default().trim_end_matches('_');
        if !prefix.is_empty() {
            prefixes.insert(prefix, (k, *rpm));
        }
    }
    let longest = prefixes.keys().map(|prefix| prefix.len()).max().unwrap_or(0);
    let lone = speeds.first().filter(|_| speeds.len() == 1).map(|(_, rpm)| *rpm);
    for record in out.records.iter_mut().filter(|r| r.kind == Kind::Time && r.speed_rpm.is_none()) {
        let ends = (1..=longest.min(record.name.len())).filter_map(|end| record.name.get(..end));
        let own = ends.filter_map(|begin| prefixes.get(begin)).min_by_key(|(k, _)| *k);
        record.speed_rpm = own.map(|(_, rpm)| *rpm).or(lone);
    }
}

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
