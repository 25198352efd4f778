//! Reads the channels of a record: selection, sampling rate, unit and time range.

use std::collections::HashMap;
use std::path::{Path, PathBuf};

use rotordyn::io::measured::ramps::is_ramp;
use rotordyn::io::measured::run_up::is_rotation_signal;
use rotordyn::io::measured::{self, unit_label};
use rotordyn::io::results_file::newest_results;
use rotordyn::names::nearest;
use rotordyn::signal::clipping::clipping;
use rotordyn::signal::dropout::{Dropout, dropouts};
use rotordyn::signal::record::{MeasuredData, Points, Record, RecordError, Values};
use rotordyn::study::signal::SignalChannel;
use rotordyn::units::{self, Dimension, FREQUENCY, TIME};
use rotordyn::warning::Code;
use serde_json::{Value, json};

use super::super::failure::Failure;
use super::super::limits::limits;
use super::super::store;

/// All errors of the flags and the file, and warnings.
#[derive(Default)]
pub struct InputProblems {
    pub problems: Vec<String>,
    pub warnings: Vec<String>,
    /// Warnings with a code of their own.
    pub coded: Vec<(Code, String)>,
}

impl InputProblems {
    pub fn problem(&mut self, text: impl Into<String>) {
        self.problems.push(text.into());
    }

    /// Adds a warning with its code.
    pub fn warn_of(&mut self, code: Code, text: String) {
        self.coded.push((code, text));
    }

    /// The value; an error is added to the problems.
    pub fn value_or_problem<T, E: std::fmt::Display>(
        &mut self,
        what: &str,
        found: Result<T, E>,
    ) -> Option<T> {
        found.map_err(|error| self.problem(format!("{what}{error}"))).ok()
    }

    /// Parses a quantity of a flag.
    pub fn quantity(&mut self, flag: &str, text: &str, dimension: Dimension) -> Option<f64> {
        let found = units::parse(text, dimension);
        self.value_or_problem(
            "",
            found.map_err(|error| format!("{flag}: {error}; such as \"{}\"", dimension.example)),
        )
    }

    /// Parses a positive quantity of a flag.
    pub fn positive(&mut self, flag: &str, text: &str, dimension: Dimension) -> Option<f64> {
        let value = self.quantity(flag, text, dimension)?;
        if value > 0.0 && value.is_finite() {
            return Some(value);
        }
        self.problem(format!("{flag} {text}: a positive {} is expected", dimension.name));
        None
    }

    /// Parses a range "a .. b" of a flag; a missing end is that of `whole`.
    pub fn range(
        &mut self,
        flag: &str,
        text: &str,
        dimension: Dimension,
        whole: [f64; 2],
    ) -> Option<[f64; 2]> {
        let Some((from, to)) = text.split_once("..") else {
            self.problem(format!(
                "{flag} {text}: expected a range, such as \"{0} .. {0}\"",
                dimension.example
            ));
            return None;
        };
        let mut end = |text: &str, open: f64| match text.trim() {
            "" => Some(open),
            text => self.quantity(flag, text, dimension),
        };
        let (a, b) = (end(from, whole[0]), end(to, whole[1]));
        let (a, b) = (a?, b?);
        if a < b {
            return Some([a, b]);
        }
        self.problem(format!("{flag} {text}: the lower end must be below the upper end"));
        None
    }

    /// Returns all problems as one error.
    pub fn to_result(&self) -> Result<(), Failure> {
        match self.problems.as_slice() {
            [] => Ok(()),
            [one] => Err(Failure::Input(one.clone())),
            many => Err(Failure::Input(format!("{} problems:\n  - {}", many.len(), many.join("\n  - ")))),
        }
    }
}

/// A file with records.
pub struct File {
    pub path: PathBuf,
    /// File name without folder and extension; the folder name for a stored run.
    pub stem: String,
    pub measured: MeasuredData,
    /// Whether it is a stored run of rotordyn; results then go to its folder.
    pub stored_run: bool,
}

/// Whether a file holds a computed run, by its name.
pub fn is_stored_run(path: &Path) -> bool {
    path.file_name().is_some_and(|name| name == store::FILE || name == store::UNFINISHED)
}

impl File {
    /// Reads a file; the rate of a flag holds where the file states two that differ.
    pub fn read(path: &Path, rate: Option<&str>) -> Result<File, Failure> {
        // A rate that is none is reported with the other problems of the flags.
        let given_rate = rate
            .and_then(|text| units::parse(text, FREQUENCY).ok())
            .filter(|rate| *rate > 0.0 && rate.is_finite());
        let path = if path.is_dir() { newest_results(path) } else { path.to_path_buf() };
        let measured = measured::read_at_rate(&path, limits(), given_rate)?;
        let stored_run = is_stored_run(&path);
        let named = if stored_run { path.parent().unwrap_or(&path) } else { &path };
        let stem = if stored_run { named.file_name() } else { named.file_stem() };
        let stem = stem.map_or_else(|| "record".into(), |s| s.to_string_lossy().into_owned());
        Ok(File { path, stem, measured, stored_run })
    }

    /// The results file of a stored run.
    pub fn run(&self) -> Option<&Path> {
        self.stored_run.then_some(self.path.as_path())
    }

    /// Time records, or records without a stated abscissa.
    pub fn time_records(&self) -> impl Iterator<Item = &Record> {
        self.measured.records.iter().filter(|r| r.time_samples().is_ok())
    }

    /// The record with a name, or an error with the most similar name.
    pub fn record(&self, name: &str) -> Result<&Record, String> {
        let found = self.measured.record(name);
        found.map_err(|error| {
            let near = nearest(name, self.measured.records.iter().map(|r| r.name.as_str()));
            near.map_or_else(
                || error.to_string(),
                |near| format!("there is no channel `{name}`; did you mean `{near}`?"),
            )
        })
    }

    /// The first vibration record: by unit, accelerations before velocities before displacements.
    fn default_record(&self, without: &[&str]) -> Option<&Record> {
        let rank = |r: &Record| match r.unit.as_str() {
            "m/s^2" => 0,
            "m/s" => 1,
            "m" => 2,
            "" | "1" | "V" => 3,
            _ => 4,
        };
        let vibrates = |r: &&Record| !without.contains(&r.name.as_str()) && !is_rotation_signal(r);
        // A time or a counter is one only where there is nothing else.
        self.time_records().filter(vibrates).min_by_key(|r| (is_ramp(r), rank(r)))
    }
}

/// Name of a variable without the number of a record, as in the CWRU files: "X105_DE_time" becomes "de".
pub fn plain_name(name: &str) -> String {
    let name = name.to_lowercase();
    let bare = match name.split_once('_') {
        Some((id, rest)) if id.starts_with('x') && id[1..].bytes().all(|b| b.is_ascii_digit()) => rest,
        _ => &name,
    };
    bare.strip_suffix("_time").unwrap_or(bare).to_string()
}

/// For JSON: every channel of a file with what states its axis, its numbers, and what was not read.
pub fn contents(file: &File) -> Value {
    let sources: HashMap<&str, &str> =
        file.measured.axis_sources.iter().map(|(name, source)| (name.as_str(), source.as_str())).collect();
    let channel = |record: &Record| {
        json!({
            "name": record.name,
            "kind": record.kind.label(),
            "samples": record.values.len(),
            "sample_rate": record.sample_rate().ok(),
            "axis_stated_by": sources.get(record.name.as_str()),
            "unit": record.unit,
            "unit_in_file": record.file_unit,
        })
    };
    json!({
        "channels": file.measured.records.iter().map(channel).collect::<Vec<_>>(),
        "numbers": file.measured.scalars.iter().map(|(name, value)| json!({ "name": name, "value": value })).collect::<Vec<_>>(),
        "not_read": file.measured.left_out,
    })
}

/// Selection of channels, and overrides of rate, unit and time range.
pub struct ChannelSelection<'a> {
    pub names: &'a [String],
    /// Channels used otherwise (tacho, quadrature channel).
    pub excluded: &'a [&'a str],
    pub quadrature: Option<&'a str>,
    pub rate: Option<&'a str>,
    pub unit: Option<&'a str>,
    pub time: Option<&'a str>,
    /// Flag prefix in messages, "--" or "--compare-".
    pub flag_prefix: &'a str,
}

/// The selected channels.
pub fn channels(file: &File, choice: &ChannelSelection, findings: &mut InputProblems) -> Vec<SignalChannel> {
    let chosen: Vec<&Record> = match choice.names {
        [] => file.default_record(choice.excluded).into_iter().collect(),
        [all] if all == "all" => file.time_records().filter(|r| !is_rotation_signal(r)).collect(),
        names => names.iter().filter_map(|name| findings.value_or_problem("", file.record(name))).collect(),
    };
    if chosen.is_empty() && matches!(choice.names, [] | [_]) && choice.names.iter().all(|name| name == "all")
    {
        let kinds: Vec<&str> = file.measured.records.iter().map(|r| r.kind.label()).take(6).collect();
        findings.problem(format!("{} contains no time record ({})", file.path.display(), kinds.join(", ")));
    }
    let quadrature = choice
        .quadrature
        .and_then(|name| findings.value_or_problem("--quadrature-channel: ", file.record(name)));
    chosen.into_iter().filter_map(|record| channel(record, quadrature, choice, findings)).collect()
}

fn channel(
    record: &Record,
    quadrature: Option<&Record>,
    choice: &ChannelSelection,
    findings: &mut InputProblems,
) -> Option<SignalChannel> {
    let sample_rate = rate(record, choice, findings);
    let samples = findings.value_or_problem("", record.time_samples());
    let (sample_rate, samples) = (sample_rate?, samples?);
    let start = match record.axis.points {
        Points::Uniform { start, .. } => start,
        _ => 0.0,
    };
    let range = match choice.time {
        Some(text) => {
            let end = start + samples.len() as f64 / sample_rate;
            let flag = format!("{}time", choice.flag_prefix);
            sample_range(findings.range(&flag, text, TIME, [start, end])?, start, sample_rate, samples.len())
        }
        None => 0..samples.len(),
    };
    if range.len() < 2 {
        findings.problem(format!(
            "`{}` has {} samples in that range; at least 2 needed",
            record.name,
            range.len()
        ));
        return None;
    }
    let mut values = samples[range.clone()].to_vec();
    if let Some(index) = values.iter().position(|v| !v.is_finite()) {
        let error = RecordError::NotFinite { channel: record.name.clone(), index: range.start + index };
        findings.problem(format!("{error}, such as with {}time", choice.flag_prefix));
        return None;
    }
    let mut unit_name = record.unit.clone();
    if let Some(label) = choice.unit {
        match unit_label::si(label) {
            None => findings
                .problem(format!("--unit {label}: unknown unit; expected such as g, \"m/s^2\", \"mm/s\"")),
            Some(_) if !unit_name.is_empty() => findings.warnings.push(format!(
                "the file states the unit {1} for `{0}`: --unit {label} is ignored",
                record.name, record.file_unit
            )),
            Some(si) => {
                let mut scaled = Values::Real(values);
                scaled.scale(si.numerator, si.divisor);
                let Values::Real(scaled) = scaled else { return None };
                values = scaled;
                unit_name = si.name;
            }
        }
    }
    let quadrature = quadrature.and_then(|other| {
        let same = other.axis == record.axis && other.values.len() == record.values.len();
        let given = findings.value_or_problem("--quadrature-channel: ", other.time_samples())?;
        if !same {
            findings.problem(RecordError::axes_differ(record, other).to_string());
            return None;
        }
        Some(given[range.clone()].to_vec())
    });
    let start = start + range.start as f64 / sample_rate;
    Some(SignalChannel {
        name: record.name.clone(),
        unit: unit_name,
        sample_rate,
        start,
        samples: values,
        orthogonal: quadrature,
    })
}

/// Cuts a channel to a time range.
pub fn cut_time_range(
    channel: &mut SignalChannel,
    time: Option<&str>,
    flag: &str,
    findings: &mut InputProblems,
) {
    let (rate, start, samples) = (channel.sample_rate, channel.start, channel.samples.len());
    let whole = [start, start + samples as f64 / rate];
    let Some(ends) = time.and_then(|text| findings.range(flag, text, TIME, whole)) else { return };
    let range = sample_range(ends, start, rate, samples);
    if range.len() < 2 {
        findings.problem(format!(
            "`{}` has {} samples in that range; at least 2 needed",
            channel.name,
            range.len()
        ));
        return;
    }
    channel.start += range.start as f64 / rate;
    channel.samples = channel.samples[range].to_vec();
}

/// What is said of a channel whose samples stand at a limit.
pub fn clipping_text(channel: &SignalChannel) -> Option<String> {
    let found = clipping(&channel.samples)?;
    let limit = format!("{:.4e} {}", found.limit, channel.unit);
    Some(format!(
        "`{}` is clipped: {} samples stand at {}, in {} excursions: its levels are too low and its harmonics too high",
        channel.name,
        found.samples,
        limit.trim_end(),
        found.times
    ))
}

/// What is said of a channel that is dead, has gaps or absurd samples.
pub fn dropout_texts(channel: &SignalChannel) -> Vec<(Code, String)> {
    let SignalChannel { name, start, sample_rate, samples: all, .. } = channel;
    let of_unit = |value: f64| match channel.unit.as_str() {
        "" => value.to_string(),
        unit => format!("{value} {unit}"),
    };
    let time = |index: usize| format!("{:.6} s", start + index as f64 / sample_rate);
    let text = |found: Dropout| match found {
        Dropout::Constant(value) => {
            let (value, count) = (of_unit(value), all.len());
            let text =
                format!("`{name}` is {value} in all of its {count} samples: it says nothing of the machine");
            (Code::DeadChannel, text)
        }
        Dropout::Held { index, samples, value } => {
            let (value, from, to) = (of_unit(value), time(index), time(index + samples - 1));
            (Code::RecordGap, format!("`{name}` stands at {value} for {samples} samples, {from} to {to}"))
        }
        Dropout::Spikes { index, samples, value, ratio } => {
            let (value, at) = (of_unit(value), time(index));
            let samples =
                if samples == 1 { "a single sample".into() } else { format!("{samples} single samples") };
            let far = format!("{ratio:.0} times as far from the median as any other");
            (Code::RecordSpike, format!("`{name}` has {samples} {far}: {value} at {at}"))
        }
        Dropout::FarValue { index, samples, value, ratio } => {
            let (value, at) = (of_unit(value), time(index));
            let text = format!(
                "`{name}` has {samples} samples of {value}, {ratio:.0} times as far from the median as any other, the first at {at}: a \
                 value for samples that are missing"
            );
            (Code::RecordSpike, text)
        }
    };
    // The pulse of a hammer may last a sample, and a force window leaves zeros behind it.
    let is_of_hammer = |found: &Dropout| {
        channel.unit == "N"
            && matches!(
                found,
                Dropout::Held { value: 0.0, .. } | Dropout::Spikes { .. } | Dropout::FarValue { .. }
            )
    };
    dropouts(all).into_iter().filter(|found| !is_of_hammer(found)).map(text).collect()
}

/// Sample range between two times.
fn sample_range([from, to]: [f64; 2], start: f64, rate: f64, samples: usize) -> std::ops::Range<usize> {
    // A time on a sample, within rounding, includes that sample.
    let at = |t: f64| ((t - start) * rate - 1e-6).ceil().clamp(0.0, samples as f64) as usize;
    let (a, b) = (at(from), at(to));
    a..b.max(a)
}

/// Sampling rate \[Hz\]: from the flag, else from the file.
fn rate(record: &Record, choice: &ChannelSelection, findings: &mut InputProblems) -> Option<f64> {
    let flag = format!("{}rate", choice.flag_prefix);
    let given = match choice.rate {
        Some(text) => Some(findings.positive(&flag, text, FREQUENCY)?),
        None => None,
    };
    match (record.sample_rate(), given) {
        (Ok(stated), None) => Some(stated),
        (Ok(stated), Some(given)) => {
            if (given / stated - 1.0).abs() > 1e-6 {
                findings.warnings.push(format!(
                    "the file states {stated} Hz for `{}`: {given} Hz of {flag} is used",
                    record.name
                ));
            }
            Some(given)
        }
        (Err(RecordError::NoRate { .. }), Some(given)) => Some(given),
        (Err(RecordError::NoRate { channel }), None) => {
            findings.problem(format!(
                "`{channel}` has no sampling rate: the file states none by a name that is known (fs, dt, time, ...); give it \
                 with {flag} RATE"
            ));
            None
        }
        (Err(error), _) => {
            findings.problem(error.to_string());
            None
        }
    }
}
