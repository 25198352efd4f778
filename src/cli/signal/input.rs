//! From a record's file and the flags to channels: chosen, at a rate, in a unit, in a stretch of time.

use std::path::{Path, PathBuf};

use rotordyn::edge::measured::run_up::is_clock;
use rotordyn::edge::measured::{self, unit};
use rotordyn::names::nearest;
use rotordyn::signal::record::{Measured, Points, Record, RecordError, Values};
use rotordyn::study::signal::SignalChannel;
use rotordyn::units::{self, Dimension, FREQUENCY, TIME};

use super::super::failure::Failure;
use super::super::store;

/// What is wrong with the flags and the file, all of it; and what the user should know.
#[derive(Default)]
pub struct Findings {
    pub problems: Vec<String>,
    pub warnings: Vec<String>,
}

impl Findings {
    pub fn problem(&mut self, text: impl Into<String>) {
        self.problems.push(text.into());
    }

    /// The value, or its problem noted.
    pub fn keep<T, E: std::fmt::Display>(&mut self, what: &str, found: Result<T, E>) -> Option<T> {
        found.map_err(|error| self.problem(format!("{what}{error}"))).ok()
    }

    /// A quantity of a flag.
    pub fn quantity(&mut self, flag: &str, text: &str, dimension: Dimension) -> Option<f64> {
        let found = units::parse(text, dimension);
        self.keep("", found.map_err(|error| format!("{flag}: {error}; such as \"{}\"", dimension.example)))
    }

    /// A positive quantity of a flag.
    pub fn positive(&mut self, flag: &str, text: &str, dimension: Dimension) -> Option<f64> {
        let value = self.quantity(flag, text, dimension)?;
        if value > 0.0 && value.is_finite() {
            return Some(value);
        }
        self.problem(format!("{flag} {text}: a positive {} is expected", dimension.name));
        None
    }

    /// A range "a .. b" of a flag; an end left out is that of `whole`.
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
        self.problem(format!("{flag} {text}: the range ends before it begins"));
        None
    }

    /// Ends the command when anything is wrong.
    pub fn settle(&self) -> Result<(), Failure> {
        match self.problems.as_slice() {
            [] => Ok(()),
            [one] => Err(Failure::Input(one.clone())),
            many => Err(Failure::Input(format!("{} problems:\n  - {}", many.len(), many.join("\n  - ")))),
        }
    }
}

/// A file of records.
pub struct File {
    pub path: PathBuf,
    /// Its name without folder and extension; that of the folder for a stored run.
    pub stem: String,
    pub measured: Measured,
    /// Whether it is a run of ours, whose results go beside it.
    pub stored_run: bool,
}

impl File {
    pub fn read(path: &Path) -> Result<File, Failure> {
        let path = if path.is_dir() { path.join(store::FILE) } else { path.to_path_buf() };
        let measured = measured::read(&path)?;
        let stored_run = path.file_name().is_some_and(|name| name == store::FILE);
        let named = if stored_run { path.parent().unwrap_or(&path) } else { &path };
        let stem = if stored_run { named.file_name() } else { named.file_stem() };
        let stem = stem.map_or_else(|| "record".into(), |s| s.to_string_lossy().into_owned());
        Ok(File { path, stem, measured, stored_run })
    }

    /// Records over time, or of which the file does not tell.
    pub fn time_records(&self) -> impl Iterator<Item = &Record> {
        self.measured.records.iter().filter(|r| r.time_samples().is_ok())
    }

    /// The record of a name, or what is alike.
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

    /// The first record that vibrates: by unit, accelerations before velocities before displacements.
    fn usual(&self, without: &[&str]) -> Option<&Record> {
        let rank = |r: &Record| match r.unit.as_str() {
            "m/s^2" => 0,
            "m/s" => 1,
            "m" => 2,
            "" | "1" | "V" => 3,
            _ => 4,
        };
        let vibrates = |r: &&Record| !without.contains(&r.name.as_str()) && !is_clock(r);
        self.time_records().filter(vibrates).min_by_key(|r| rank(r))
    }
}

/// Which channels, and how they are to be taken.
pub struct Choice<'a> {
    pub names: &'a [String],
    /// Channels that serve for something else.
    pub without: &'a [&'a str],
    pub beside: Option<&'a str>,
    pub rate: Option<&'a str>,
    pub unit: Option<&'a str>,
    pub time: Option<&'a str>,
    /// Flag prefix in messages, "--" or "--against-".
    pub flag: &'a str,
}

/// The channels asked for.
pub fn channels(file: &File, choice: &Choice, findings: &mut Findings) -> Vec<SignalChannel> {
    let chosen: Vec<&Record> = match choice.names {
        [] => {
            let usual = file.usual(choice.without);
            if usual.is_none() {
                let kinds: Vec<&str> = file.measured.records.iter().map(|r| r.kind.word()).take(6).collect();
                findings.problem(format!(
                    "{} holds no channel of samples over time ({})",
                    file.path.display(),
                    kinds.join(", ")
                ));
            }
            usual.into_iter().collect()
        }
        [all] if all == "all" => file.time_records().filter(|r| !is_clock(r)).collect(),
        names => names.iter().filter_map(|name| findings.keep("", file.record(name))).collect(),
    };
    let beside = choice.beside.and_then(|name| findings.keep("--beside: ", file.record(name)));
    chosen.into_iter().filter_map(|record| channel(record, beside, choice, findings)).collect()
}

fn channel(
    record: &Record,
    beside: Option<&Record>,
    choice: &Choice,
    findings: &mut Findings,
) -> Option<SignalChannel> {
    let sample_rate = rate(record, choice, findings);
    let samples = findings.keep("", record.time_samples());
    let (sample_rate, samples) = (sample_rate?, samples?);
    let start = match record.axis.points {
        Points::Even { start, .. } => start,
        _ => 0.0,
    };
    let range = match choice.time {
        Some(text) => {
            let end = start + samples.len() as f64 / sample_rate;
            let flag = format!("{}time", choice.flag);
            stretch(findings.range(&flag, text, TIME, [start, end])?, start, sample_rate, samples.len())
        }
        None => 0..samples.len(),
    };
    if range.len() < 2 {
        findings.problem(format!("`{}` has {} samples in that time; two at least", record.name, range.len()));
        return None;
    }
    let mut values = samples[range.clone()].to_vec();
    if let Some(index) = values.iter().position(|v| !v.is_finite()) {
        let error = RecordError::NotFinite { channel: record.name.clone(), index: range.start + index };
        findings.problem(format!("{error}, such as with {}time", choice.flag));
        return None;
    }
    let mut unit_name = record.unit.clone();
    if let Some(label) = choice.unit {
        match unit::si(label) {
            None => findings
                .problem(format!("--unit {label}: the unit is not known; such as g, \"m/s^2\", \"mm/s\"")),
            Some(_) if !unit_name.is_empty() => findings.warnings.push(format!(
                "`{}` is in {}, as its file states: --unit {label} is not taken",
                record.name, record.stated_unit
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
    let beside = beside.and_then(|other| {
        let same = other.axis == record.axis && other.values.len() == record.values.len();
        let given = findings.keep("--beside: ", other.time_samples())?;
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
        beside,
    })
}

/// Leaves the part of a channel that a range of times names.
pub fn cut(channel: &mut SignalChannel, time: Option<&str>, flag: &str, findings: &mut Findings) {
    let (rate, start, samples) = (channel.sample_rate, channel.start, channel.samples.len());
    let whole = [start, start + samples as f64 / rate];
    let Some(ends) = time.and_then(|text| findings.range(flag, text, TIME, whole)) else { return };
    let range = stretch(ends, start, rate, samples);
    if range.len() < 2 {
        findings.problem(format!(
            "`{}` has {} samples in that time; two at least",
            channel.name,
            range.len()
        ));
        return;
    }
    channel.start += range.start as f64 / rate;
    channel.samples = channel.samples[range].to_vec();
}

/// Samples between two times.
fn stretch([from, to]: [f64; 2], start: f64, rate: f64, samples: usize) -> std::ops::Range<usize> {
    // A time on a sample belongs to it up to rounding.
    let at = |t: f64| ((t - start) * rate - 1e-6).ceil().clamp(0.0, samples as f64) as usize;
    let (a, b) = (at(from), at(to));
    a..b.max(a)
}

/// The sampling rate \[Hz\]: the file's, unless a flag says otherwise.
fn rate(record: &Record, choice: &Choice, findings: &mut Findings) -> Option<f64> {
    let flag = format!("{}rate", choice.flag);
    let given = match choice.rate {
        Some(text) => Some(findings.positive(&flag, text, FREQUENCY)?),
        None => None,
    };
    match (record.sample_rate(), given) {
        (Ok(stated), None) => Some(stated),
        (Ok(stated), Some(given)) => {
            if (given / stated - 1.0).abs() > 1e-6 {
                findings.warnings.push(format!(
                    "the file states {stated} Hz for `{}`: {given} Hz is taken, as told",
                    record.name
                ));
            }
            Some(given)
        }
        (Err(RecordError::NoRate { .. }), Some(given)) => Some(given),
        (Err(RecordError::NoRate { channel }), None) => {
            findings.problem(format!(
                "`{channel}` does not state its sampling rate; give it, such as {flag} \"12 kHz\""
            ));
            None
        }
        (Err(error), _) => {
            findings.problem(error.to_string());
            None
        }
    }
}
