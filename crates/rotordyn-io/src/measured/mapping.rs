//! Mapping file: assigns measured channels to stations and directions of a model.
//!
//! ```toml
//! rate = "12 kHz"             # sampling rate of time records, if their file has none
//! frequency_step = "0.5 Hz"   # of spectra, if their file has none
//! axes = ["z", "x", "y"]      # the file's x, y, z in the model's axes
//!
//! [channel.X105_DE_time]      # by the channel's name
//! station = "B"
//! direction = "-y"
//! unit = "g"                  # if the file has none
//!
//! [point.12]                  # by the point's number, for every record there
//! station = "disc"
//! direction = "x"             # if the file has none
//! ```
//!
//! The shaft's speed or angle and a tacho have no station: `[channel.n] unit = "rpm"`. A channel's
//! `reference = { station = "disc", direction = "-x" }` is the excitation DOF of an FRF. A sensor at an
//! offset from a station, rigidly attached to it: `offset = "150, 0, 0 mm"`.

use std::collections::BTreeMap;
use std::path::Path;

use serde::Deserialize;

use super::{coherence_names, unit_label};
use crate::budget::{self, Limits};
use crate::error::Error;
use rotordyn_signal::record::{AttachedPoint, Dof, Geometry, Kind, MeasuredData, Record};
use rotordyn_units as units;
use rotordyn_units::names::nearest;

/// Content of a mapping file: rates, axes, channels and points.
#[derive(Clone, Debug, Default, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub struct Mapping {
    rate: Option<String>,
    frequency_step: Option<String>,
    axes: Option<[String; 3]>,
    #[serde(default)]
    channel: BTreeMap<String, ChannelEntry>,
    #[serde(default)]
    point: BTreeMap<String, ChannelEntry>,
}

#[derive(Clone, Debug, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
struct ChannelEntry {
    /// None for the shaft's speed, its angle or a tacho, which need only a unit.
    station: Option<String>,
    offset: Option<String>,
    direction: Option<String>,
    unit: Option<String>,
    reference: Option<ReferenceEntry>,
}

#[derive(Clone, Debug, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
struct ReferenceEntry {
    station: String,
    offset: Option<String>,
    direction: String,
}

/// Reads a mapping file.
///
/// # Errors
/// The file cannot be read, or does not have the format above; the message has the line.
pub fn read(path: &Path) -> Result<Mapping, Error> {
    let text = budget::read_text(path, &Limits::default())?;
    toml::from_str(&text).map_err(|error| Error::Content {
        path: path.into(),
        problem: error.to_string().trim_end().to_owned(),
        advice: "a mapping has rate, frequency_step, axes, [channel.NAME] and [point.NUMBER]".into(),
    })
}

/// Number of a direction: x y z are 1 2 3, theta_x or Rx and so on 4 5 6, with their sign; `None` for any
/// other text.
pub fn direction(word: &str) -> Option<i8> {
    let (sign, name) = match word.trim().split_at_checked(1) {
        Some(("-", name)) => (-1, name),
        Some(("+", name)) => (1, name),
        _ => (1, word.trim()),
    };
    let places =
        [["x", "x"], ["y", "y"], ["z", "z"], ["theta_x", "Rx"], ["theta_y", "Ry"], ["theta_z", "Rz"]];
    places.iter().position(|words| words.contains(&name)).map(|k| sign * (k as i8 + 1))
}

impl Mapping {
    /// Sampling rate \[Hz\] of records whose file has none; `None` if missing or invalid.
    pub fn rate(&self) -> Option<f64> {
        let rate = units::parse(self.rate.as_ref()?, units::FREQUENCY).ok()?;
        (rate > 0.0).then_some(rate)
    }

    /// Sets the units of the mapping on all records whose file has none.
    pub fn set_missing_units(&self, measured: &mut MeasuredData) {
        for record in &mut measured.records {
            let label = self.channel.get(&record.name).and_then(|own| own.unit.as_deref());
            if let Some((label, known)) = label.and_then(|l| Some((l, unit_label::si(l)?)))
                && record.unit.is_empty()
            {
                convert(record, label, known);
            }
        }
    }

    /// Assigns records to the model's point numbers and directions, and leaves out those that the mapping
    /// does not name; returns warnings. Of the geometry only points at an offset from stations remain, since
    /// points now have the model's numbers. A mapping without channels and points (only rates, axes) keeps
    /// all records.
    ///
    /// `place` gives the number of a station, bearing or body; `path` is the mapping file, for messages.
    ///
    /// # Errors
    /// All problems at once: channels and points missing in the records, stations missing in the model,
    /// invalid directions, units and rates, units that contradict the file's.
    pub fn apply(
        &self,
        measured: &mut MeasuredData,
        place: &dyn Fn(&str) -> Option<i64>,
        path: &Path,
    ) -> Result<Vec<String>, Error> {
        let mut problems = Vec::new();
        let mut frequency = |name: &str, text: &Option<String>| {
            let text = text.as_ref()?;
            match units::parse(text, units::FREQUENCY) {
                Ok(value) if value > 0.0 => Some(value),
                Ok(_) => push_problem(&mut problems, format!("{name} = \"{text}\" is not positive")),
                Err(error) => push_problem(&mut problems, format!("{name}: {error}")),
            }
        };
        let rate = frequency("rate", &self.rate);
        let step = frequency("frequency_step", &self.frequency_step);
        rate.into_iter().for_each(|rate| measured.set_missing_rate(rate));
        step.into_iter().for_each(|step| measured.set_missing_frequency_step(step));
        let axes = self.axes(&mut problems);

        let known: Vec<&str> = measured.records.iter().map(|r| r.name.as_str()).collect();
        // Channels without a station belong to the shaft and have been removed before.
        let placed = self.channel.iter().filter(|(_, own)| own.station.is_some()).map(|(name, _)| name);
        for name in placed.filter(|name| !known.contains(&name.as_str())) {
            problems.push(format!("there is no channel `{name}`{}", known_names_hint(name, &known)));
        }
        for number in self.point.keys() {
            let is_at = |dof: Dof| dof.node.to_string() == *number;
            if !measured.records.iter().any(|r| is_at(r.response) || is_at(r.reference)) {
                let mut points: Vec<String> = points_of(measured).iter().map(i64::to_string).collect();
                let more = if points.len() > 12 { ", ..." } else { "" };
                points.truncate(12);
                problems.push(match points[..] {
                    [] => format!(
                        "there is no record at point {number}: the file's records have no point numbers"
                    ),
                    _ => format!("there is no record at point {number}, but at {}{more}", points.join(", ")),
                });
            }
        }

        let frfs = measured.records.iter().filter(|r| r.kind == Kind::Frf).map(|r| r.name.clone());
        let frfs: Vec<String> = frfs.collect();
        let mut mapped = Vec::new();
        let mut left_out = Vec::new();
        let mut mounts = std::mem::take(&mut measured.geometry.attached_points);
        for mut record in std::mem::take(&mut measured.records) {
            // A coherence is placed like its FRF, whose problems have already been reported.
            let own = self.channel.get(&record.name);
            let is_coherence = record.kind == Kind::Coherence;
            let of_frf = if is_coherence { coherence_names::frf_of(&record.name, &frfs) } else { None };
            let entry = own.or_else(|| self.channel.get(of_frf?));
            let mut reported = Vec::new();
            let problems = if own.is_none() && entry.is_some() { &mut reported } else { &mut problems };
            let mut target = Placer { place, axes, problems, mounts: &mut mounts };
            let found = match entry {
                Some(own) => target.place_channel(&mut record, own),
                None if self.channel.is_empty() && self.point.is_empty() => target.keep(&mut record),
                None => target.place_by_points(&mut record, &self.point),
            };
            if found {
                mapped.push(record);
            } else {
                left_out.push(record.name);
            }
        }
        if mapped.is_empty() && !left_out.is_empty() && problems.is_empty() {
            let known: Vec<&str> = left_out.iter().map(String::as_str).collect();
            problems.push(format!(
                "it names none of the file's channels{}: add [channel.NAME] or [point.NUMBER]",
                known_names_hint("", &known)
            ));
        }
        measured.records = mapped;
        if !(self.channel.is_empty() && self.point.is_empty()) {
            measured.geometry = Geometry { attached_points: mounts, ..Geometry::default() };
        }
        problems.dedup();
        if !problems.is_empty() {
            return Err(Error::Content {
                path: path.into(),
                problem: problems.join("; "),
                advice: "correct the mapping".into(),
            });
        }
        let mut warnings = Vec::new();
        if !left_out.is_empty() {
            let count = left_out.len();
            left_out.truncate(8);
            let more = if count > 8 { ", ..." } else { "" };
            let what = if count == 1 { "channel is" } else { "channels are" };
            warnings.push(format!(
                "{count} {what} not in the mapping and left out: {}{more}",
                left_out.join(", ")
            ));
        }
        Ok(warnings)
    }

    /// Assigns shapes to the stations of the mapping's points, in the model's axes; points it does not name
    /// are left out.
    ///
    /// # Errors
    /// As [`Mapping::apply`], and a mapping that names no point.
    pub fn apply_to_shapes(
        &self,
        measured: &mut MeasuredData,
        place: &dyn Fn(&str) -> Option<i64>,
        path: &Path,
    ) -> Result<(), Error> {
        let mut problems = Vec::new();
        let axes = self.axes(&mut problems);
        if self.point.is_empty() {
            problems.push("shapes are placed by points, and it names none: add [point.NUMBER]".into());
        }
        for number in self.point.keys() {
            if !measured.shapes.iter().any(|s| s.nodes.iter().any(|n| n.to_string() == *number)) {
                problems.push(format!("there is no point {number} in the shapes"));
            }
        }
        let mut mounts = std::mem::take(&mut measured.geometry.attached_points);
        for shape in &mut measured.shapes {
            let mut target = Placer { place, axes, problems: &mut problems, mounts: &mut mounts };
            let parts = shape.components;
            let (mut nodes, mut values) = (Vec::new(), Vec::new());
            for (k, number) in shape.nodes.iter().enumerate() {
                let Some(at) = self.point.get(&number.to_string()) else { continue };
                let own = &shape.values[k * parts..(k + 1) * parts];
                let mut rotated =
                    vec![rotordyn_signal::Complex::default(); if parts == 1 { 3 } else { parts }];
                for (c, value) in own.iter().enumerate() {
                    let way = match (parts, &at.direction) {
                        (1, Some(word)) => target.direction(word),
                        (1, None) => 0,
                        _ => target.in_model_axes(c as i8 + 1),
                    };
                    match rotated.get_mut(usize::from(way.unsigned_abs()).wrapping_sub(1)) {
                        Some(to) => *to += value * f64::from(way.signum()),
                        None => target.problems.push(format!("point {number} has no direction")),
                    }
                }
                nodes.push(target.point_at(&number.to_string(), at.station.as_deref(), at.offset.as_deref()));
                values.extend(rotated);
            }
            shape.components = if parts == 1 { 3 } else { parts };
            (shape.nodes, shape.values) = (nodes, values);
        }
        measured.geometry = Geometry { attached_points: mounts, ..Geometry::default() };
        problems.sort();
        problems.dedup();
        if problems.is_empty() {
            return Ok(());
        }
        Err(Error::Content {
            path: path.into(),
            problem: problems.join("; "),
            advice: "correct the mapping".into(),
        })
    }

    /// The model's direction for each of the file's x, y, z.
    fn axes(&self, problems: &mut Vec<String>) -> [i8; 3] {
        let Some(words) = &self.axes else { return [1, 2, 3] };
        let found: Vec<i8> =
            words.iter().filter_map(|word| direction(word)).filter(|d| d.abs() <= 3).collect();
        let mut sizes: Vec<i8> = found.iter().map(|d| d.abs()).collect();
        sizes.sort_unstable();
        match found[..] {
            [x, y, z] if sizes == [1, 2, 3] => {
                // An even permutation keeps the cyclic order of the axes.
                let in_order = (y.abs() - x.abs()).rem_euclid(3) == 1;
                if in_order != (x.signum() * y.signum() * z.signum() == 1) {
                    problems.push(format!("axes = {words:?} are left-handed: change the sign of one"));
                }
                [x, y, z]
            }
            _ => {
                problems.push(format!("axes = {words:?} are not x, y, z in some order, each with its sign"));
                [1, 2, 3]
            }
        }
    }
}

/// Point numbers of all responses and references.
fn points_of(measured: &MeasuredData) -> Vec<i64> {
    let mut points: Vec<i64> = measured
        .records
        .iter()
        .flat_map(|r| [r.response.node, r.reference.node])
        .filter(|n| *n != 0)
        .collect();
    points.sort_unstable();
    points.dedup();
    points
}

/// Converts values from a unit that their file does not state.
fn convert(record: &mut Record, label: &str, known: unit_label::SiUnit) {
    record.values.scale(known.numerator, known.divisor);
    record.unit = known.name;
    record.file_unit = label.into();
}

fn push_problem(problems: &mut Vec<String>, problem: String) -> Option<f64> {
    problems.push(problem);
    None
}

/// `, but` and the nearest known name, or the known names.
fn known_names_hint(name: &str, known: &[&str]) -> String {
    match nearest(name, known.iter().copied()) {
        Some(best) => format!(", but `{best}`"),
        None => {
            let some: Vec<&str> = known.iter().copied().take(8).collect();
            format!(", but {}{}", some.join(", "), if known.len() > 8 { ", ..." } else { "" })
        }
    }
}

/// Assigns records to points and directions of the model.
struct Placer<'a> {
    place: &'a dyn Fn(&str) -> Option<i64>,
    axes: [i8; 3],
    problems: &'a mut Vec<String>,
    mounts: &'a mut Vec<AttachedPoint>,
}

/// Numbers of points at an offset from stations start after this.
const OFFSET_POINT_BASE: i64 = 1_000_000;

impl Placer<'_> {
    /// Number of a station, or of a point at an offset from it.
    fn point_at(&mut self, name: &str, station: Option<&str>, offset: Option<&str>) -> i64 {
        let Some(station) = station else {
            self.problems.push(format!("`{name}` has no station"));
            return 0;
        };
        let on = self.station(station);
        let Some(text) = offset else { return on };
        let offset: [f64; 3] = match units::parse_list(text, units::LENGTH).map(|list| list.try_into()) {
            Ok(Ok(offset)) => offset,
            Ok(Err(_)) => {
                self.problems
                    .push(format!("offset = \"{text}\" is not three lengths, such as \"150, 0, 0 mm\""));
                return on;
            }
            Err(error) => {
                self.problems.push(format!("offset: {error}, such as \"150, 0, 0 mm\""));
                return on;
            }
        };
        if let Some(known) = self.mounts.iter().find(|m| m.carrier == on && m.offset == offset) {
            return known.number;
        }
        let number = OFFSET_POINT_BASE + 1 + self.mounts.len() as i64;
        self.mounts.push(AttachedPoint { number, carrier: on, offset });
        number
    }

    fn station(&mut self, name: &str) -> i64 {
        (self.place)(name).unwrap_or_else(|| {
            self.problems.push(format!("the model has no station, bearing or body `{name}`"));
            0
        })
    }

    fn direction(&mut self, word: &str) -> i8 {
        direction(word).unwrap_or_else(|| {
            self.problems.push(format!("direction \"{word}\" is none of x, y, z, theta_x, theta_y, theta_z"));
            0
        })
    }

    /// A direction of the file in the model's axes.
    fn in_model_axes(&self, direction: i8) -> i8 {
        let size = direction.unsigned_abs();
        match size {
            0 => 0,
            1..=3 => direction.signum() * self.axes[usize::from(size) - 1],
            _ => {
                let axis = self.axes[usize::from(size - 4) % 3];
                direction.signum() * axis.signum() * (axis.abs() + 3)
            }
        }
    }

    /// Places a channel by its entry in the mapping.
    fn place_channel(&mut self, record: &mut Record, own: &ChannelEntry) -> bool {
        self.apply_unit(record, own.unit.as_deref());
        let way = match &own.direction {
            Some(word) => self.direction(word),
            None => self.in_model_axes(record.response.direction),
        };
        record.response =
            Dof::new(self.point_at(&record.name, own.station.as_deref(), own.offset.as_deref()), way);
        record.reference = match &own.reference {
            Some(r) => Dof::new(
                self.point_at(&record.name, Some(&r.station), r.offset.as_deref()),
                self.direction(&r.direction),
            ),
            None => Dof::NONE,
        };
        if way == 0 {
            self.problems.push(format!("`{}` has no direction", record.name));
        }
        true
    }

    /// Keeps a record at the point stated by its file, in the model's axes.
    fn keep(&self, record: &mut Record) -> bool {
        record.response.direction = self.in_model_axes(record.response.direction);
        record.reference.direction = self.in_model_axes(record.reference.direction);
        true
    }

    /// Places a record by its response and reference points; false if one of them is not in the mapping.
    fn place_by_points(&mut self, record: &mut Record, points: &BTreeMap<String, ChannelEntry>) -> bool {
        let of = |dof: Dof| points.get(&dof.node.to_string());
        let (response, reference) = (record.response, record.reference);
        let Some(at) = of(response).filter(|_| response.node != 0) else { return false };
        if reference.node != 0 && of(reference).is_none() {
            return false;
        }
        self.apply_unit(record, at.unit.as_deref());
        record.response = self.placed_dof(response, at, &record.name);
        if let Some(from) = of(reference).filter(|_| reference.node != 0) {
            record.reference = self.placed_dof(reference, from, &record.name);
        }
        true
    }

    fn placed_dof(&mut self, dof: Dof, at: &ChannelEntry, name: &str) -> Dof {
        let way = match (&at.direction, dof.direction) {
            (Some(word), 0) => self.direction(word),
            (_, way) => self.in_model_axes(way),
        };
        if way == 0 {
            self.problems.push(format!("`{name}` has no direction at point {}", dof.node));
        }
        Dof::new(self.point_at(name, at.station.as_deref(), at.offset.as_deref()), way)
    }

    /// Converts values whose unit the file does not state.
    fn apply_unit(&mut self, record: &mut Record, label: Option<&str>) {
        let Some(label) = label.filter(|_| record.kind != Kind::Coherence) else { return };
        let Some(known) = unit_label::si(label) else {
            self.problems.push(format!(
                "unit \"{label}\" of `{}` is not known: write it as \"m/s^2\", \"g\", \"mm/s\" or, of an FRF, \"g/N\"",
                record.name
            ));
            return;
        };
        if !record.unit.is_empty() {
            if record.unit != known.name {
                let (name, own) = (&record.name, &record.unit);
                self.problems.push(format!("`{name}` is in {own} according to its file, not in \"{label}\""));
            }
            return;
        }
        convert(record, label, known);
    }
}
