//! Records from the named arrays of .mat, .npz and HDF5 files.
//!
//! `name_unit`, `name_fs` and the like describe the array `name`, as `record_arrays` writes them, and `fs_name`, `nameRate`
//! and other names of an axis with it (`own_axes`). Arrays of other programs
//! are interpreted by name (`axis_names`): `fs`, `dt`, `time`, `frequency`; complex values over frequency are FRFs; names
//! that begin with `coh` are coherence; a scalar that ends in `RPM` is the speed of the records with the same prefix.
//! H\[i, j, line\] becomes one record for each response i + 1 and reference j + 1. Arrays of a structure, `bearing.gs`, have
//! its axes, `bearing.sr`, else those of the structures around it.

use std::collections::HashMap;

pub use super::array::{Array, Data};
use super::array_names::last_name;
use super::axis_names::{Role, six_digits};
use super::content_problem::ContentProblem;
use super::structures::{Axes, AxisList, Structures};
use super::{coherence_names, ramps, signal_calc, unit_label};
use crate::budget::Budget;
use crate::error::snippet;
use rotordyn_signal::record::{Axis, AxisQuantity, Dof, Kind, MeasuredData, Points, Record, Values};

/// Suffixes of arrays that describe another array.
const PROPERTY_SUFFIXES: [&str; 10] =
    ["fs", "t0", "t", "freq_hz", "unit", "kind", "dof", "rpm", "name", "is"];

/// Records from arrays, by the naming rules above; `given_rate` \[Hz\] holds where two are stated.
///
/// # Errors
/// More records or memory than the budget of the file has, or two sampling rates that differ for one record.
pub(crate) fn to_records(
    arrays: &[Array],
    budget: &Budget,
    given_rate: Option<f64>,
) -> Result<MeasuredData, ContentProblem> {
    if arrays.iter().any(|a| a.name == signal_calc::INFO_ARRAY) {
        return Ok(signal_calc::to_records(arrays, budget)?);
    }
    let file = File { structures: Structures::new(arrays, given_rate)? };
    let mut out = MeasuredData::default();
    if let Some(title) = file.structures.get_used("title").and_then(Array::as_text) {
        out.title = title.into();
    }
    for (place, array) in arrays.iter().enumerate() {
        let is_record = array.data.len() > 1 && !matches!(array.data, Data::Text(_));
        let is_axis = file.structures.is_axis_list(place) || file.structures.is_own_axis(place);
        if is_record && !is_axis && !file.is_attribute(&array.name) {
            file.records(array, budget, &mut out)?;
        }
    }
    // What no record has taken is a number of the file, or left out.
    for (place, array) in arrays.iter().enumerate() {
        let is_unread_rate =
            array.name.ends_with("_fs") && matches!(array.data, Data::Text(_)) && rate_of(array).is_none();
        if file.structures.is_used(place) || (file.is_attribute(&array.name) && !is_unread_rate) {
            continue;
        }
        match (&array.data, array.as_scalar()) {
            (data, _) if data.is_empty() => out.left_out.push(format!("{} (empty)", array.name)),
            (Data::Text(texts), _) => {
                let more = if texts.len() > 1 { ", ..." } else { "" };
                let text = snippet(texts.first().map_or("", String::as_str));
                out.left_out.push(format!("{} (text \"{text}\"{more})", array.name));
            }
            (Data::Complex(values), _) if values.len() == 1 => {
                out.left_out.push(format!("{} (the complex number {})", array.name, values[0]));
            }
            (_, Some(value)) => out.scalars.push((array.name.clone(), value)),
            _ if file.structures.is_axis_list(place) => {
                let count = array.data.len();
                out.left_out
                    .push(format!("{} (an axis of {count} points, but no channel over it)", array.name));
            }
            _ => {}
        }
    }
    out.notes.append(&mut file.structures.notes.borrow_mut());
    assign_speeds(&mut out);
    Ok(out)
}

struct File<'a> {
    structures: Structures<'a>,
}

impl<'a> File<'a> {
    fn get(&self, name: &str) -> Option<&'a Array> {
        self.structures.get(name)
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
        budget: &Budget,
        out: &mut MeasuredData,
    ) -> Result<(), ContentProblem> {
        let axes = &self.structures.axes(array)?;
        let own = |suffix: &str| self.get(&format!("{}_{suffix}", array.name));
        let name = own("name").or_else(|| own("is")).and_then(Array::as_text).unwrap_or(&array.name);
        let stated = own("unit").and_then(Array::as_text).or_else(|| self.structures.unit(array));
        let stated = stated.unwrap_or_default();
        let kind = own("kind").and_then(Array::as_text);
        let kind = kind.and_then(|word| Kind::LABELS.iter().find(|k| k.1 == word)).map(|k| k.0);
        let shape = array.squeezed();
        if let Some(column) = two_column_record(array, axes) {
            out.notes.push(format!("`{name}`: its first column is taken as time"));
            out.axis_sources.push((column.name.clone(), "its first column".into()));
            out.records.push(column);
            return Ok(());
        }
        let slices = self.slices_along_axis(array, &shape, axes, budget)?;
        if let Some((stated, of)) = self.structures.count(axes)
            && let Some(found) = slices.first().map(|slice| slice.values.len())
            && stated != found as f64
        {
            let stated = six_digits(stated);
            out.notes.push(format!("`{name}` has {found} values, `{of}` states {stated}"));
        }
        for Slice { index, mut values, axis, source } in slices {
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
            if !source.is_empty() {
                out.axis_sources.push((record.name.clone(), source));
            }
            out.records.push(record);
        }
        Ok(())
    }

    /// Whether an array is a time record although a list of frequencies has its length; a note says so.
    fn is_time_rather(&self, array: &Array, shape: &[usize], axes: &Axes<'a>) -> bool {
        let fits = |list: Option<AxisList<'a>>| list.filter(|list| shape.contains(&list.values.len()));
        let Some(frequency) = fits(axes.frequency) else { return false };
        let by_time = fits(axes.time).is_some_and(|time| time.distance <= frequency.distance);
        let by_rate = axes.states_rate_within(frequency.distance);
        let found = (by_time || by_rate) && ramps::is_time_record(array);
        if found {
            self.structures.notes.borrow_mut().push(format!(
                "`{}` may lie over time or over `{}`: it has values of both signs and is read as a time record",
                array.name,
                self.structures.name_of(&frequency)
            ));
        }
        found
    }

    /// One-dimensional slices of an array along its axis.
    fn slices_along_axis(
        &self,
        array: &Array,
        shape: &[usize],
        axes: &Axes<'a>,
        budget: &Budget,
    ) -> Result<Vec<Slice>, ContentProblem> {
        let own = |suffix: &str| self.get(&format!("{}_{suffix}", array.name));
        let own_list = |suffix: &str| own(suffix).and_then(Array::as_list);
        let is_time = own("kind").and_then(Array::as_text) == Some(Kind::Time.label())
            || array.name.to_lowercase().ends_with("_time")
            || own("kind").is_none() && self.is_time_rather(array, shape, axes);
        let over = |count: usize| -> Result<(Axis, String), ContentProblem> {
            let fits = |list: &&[f64]| list.len() == count;
            let stated_by = |suffix: &str| format!("`{}_{suffix}`", array.name);
            if let Some(rate) = own("fs").and_then(rate_of) {
                let start = own("t0").and_then(Array::as_scalar).unwrap_or(0.0);
                Ok((Axis::uniform(AxisQuantity::Time, start, 1.0 / rate), stated_by("fs")))
            } else if let Some(list) = own_list("t").filter(fits) {
                Ok((Axis::from_points(AxisQuantity::Time, list.to_vec()), stated_by("t")))
            } else if let Some(list) = own_list("freq_hz").filter(fits) {
                Ok((Axis::from_points(AxisQuantity::Frequency, list.to_vec()), stated_by("freq_hz")))
            } else if let Some(own) = self.structures.own_axis(array) {
                Ok(own)
            } else {
                self.structures.axis(axes, count, is_time)
            }
        };
        // The axis of a matrix is the dimension of the length of a known axis, else the longest.
        let frequency = axes.frequency.filter(|_| !is_time);
        let has_axis = |count: usize| {
            [frequency, axes.time].into_iter().flatten().any(|list| list.values.len() == count)
        };
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
        let (axis, source) = over(count)?;
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
                let (index, axis, source) = (index.collect(), axis.clone(), source.clone());
                out.push(Slice { index, values, axis, source });
            }
        }
        Ok(out)
    }
}

/// Record from a two-column array whose first column is a uniform axis, if the file has no other axis.
fn two_column_record(array: &Array, axes: &Axes<'_>) -> Option<Record> {
    let Data::Real(values) = &array.data else { return None };
    if !axes.are_unknown() || array.shape.len() != 2 || array.shape[1] != 2 || array.shape[0] < 3 {
        return None;
    }
    let column = |k: usize| values.iter().skip(k).step_by(2).copied().collect::<Vec<f64>>();
    let axis = Axis::from_points(AxisQuantity::Time, column(0));
    // A counter states no rate.
    let even = matches!(axis.points, Points::Uniform { start, step } if !ramps::is_counter(start, step));
    even.then(|| Record::new(&array.name, Kind::Time, axis, Values::Real(column(1)), ""))
}

/// One slice of an array along its axis, with its index in the other dimensions.
struct Slice {
    index: Vec<usize>,
    values: Values,
    axis: Axis,
    /// What states the axis.
    source: String,
}

/// Sampling rate \[Hz\] that an array states by its value, also as text; `None` if it is none.
fn rate_of(array: &Array) -> Option<f64> {
    let (value, si) = array.as_stated()?;
    let rate = match si {
        Some(si) => {
            let (numerator, divisor) = Role::Rate.factor(&si)?;
            if numerator == divisor { value } else { value * numerator / divisor }
        }
        None => value,
    };
    (rate > 0.0 && rate.is_finite()).then_some(rate)
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
        (AxisQuantity::Frequency, _) if begins(&["gamma"]) || coherence_names::is_coherence(&name) => {
            Kind::Coherence
        }
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
