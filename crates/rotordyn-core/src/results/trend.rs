//! Trend of several records of one machine: state of each over time, load or another axis, and what changes.

use serde::{Deserialize, Serialize};

use super::BearingWithOrders;
use crate::document::{Array, Document, Rows, Section};
use rotordyn_signal::bearing_lines::BearingPart;
use rotordyn_signal::statistics::Statistics;
use rotordyn_signal::trend::Trend;
use std::f64::consts::TAU;

/// Records of one machine in the order of an axis.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct TrendResult {
    pub axis: TrendAxis,
    /// SI unit of the records; empty if unknown or not the same.
    pub unit: String,
    pub bearing: Option<BearingWithOrders>,
    /// Demodulation band of the line amplitudes, one for all records \[Hz\].
    pub line_band: Option<(f64, f64)>,
    /// Bands of the additional RMS values \[Hz\].
    pub rms_bands: Vec<[f64; 2]>,
    pub records: Vec<TrendRecord>,
    pub changes: Vec<Change>,
    /// What is said of the whole, one sentence each.
    pub statements: Vec<String>,
}

/// What the records are given over.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct TrendAxis {
    /// "time", "load", "record" …
    pub name: String,
    /// Empty for a number of records.
    pub unit: String,
    /// Where the positions come from.
    pub source: String,
}

/// One record.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct TrendRecord {
    pub name: String,
    /// Position on the axis; NaN if unknown.
    pub position: f64,
    /// `None` if it was not read.
    pub state: Option<RecordState>,
    /// Why it was not read or not judged.
    pub problem: Option<String>,
}

/// State of the machine in one record.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct RecordState {
    pub channel: String,
    /// SI unit; empty if unknown.
    pub unit: String,
    /// \[Hz\].
    pub sample_rate: f64,
    pub samples: usize,
    pub statistics: Statistics,
    /// RMS in each of the trend's bands; NaN above half the sampling rate.
    pub band_rms: Vec<f64>,
    /// Shaft speed used \[rev/s\].
    pub speed: Option<f64>,
    /// Where it comes from.
    pub speed_source: String,
    pub diagnosis: Option<RecordDiagnosis>,
}

/// What one record says of the bearing.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct RecordDiagnosis {
    /// "outer race, 98 %".
    pub statement: String,
    /// The damaged part, if one is named.
    pub part: Option<BearingPart>,
    /// The part that fits best, and the probability that it is the damaged one.
    pub candidate: BearingPart,
    pub probability: f64,
    /// Demodulation band of this record \[Hz\].
    pub band: (f64, f64),
    /// Lines in the order of [`BearingPart::ALL`]; `None` if the record does not contain the common band.
    pub lines: Option<[LineLevel; 4]>,
}

/// Lines of one part in the envelope spectrum of the common band.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct LineLevel {
    /// Root sum of squares of its significant harmonics that no other source explains.
    pub strength: f64,
    /// The highest of its harmonics over the background \[dB\].
    pub level_db: f64,
}

/// Change of one quantity along the trend.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Change {
    /// "kurtosis", "BPFO amplitude".
    pub quantity: String,
    pub unit: String,
    pub trend: Trend,
    /// Significant at 5 % among all quantities of the trend together (Holm 1979).
    pub significant: bool,
}

impl TrendRecord {
    /// A number of its state; NaN if it has none.
    fn number(&self, of: impl Fn(&RecordState) -> Option<f64>) -> f64 {
        self.state.as_ref().and_then(of).unwrap_or(f64::NAN)
    }

    fn diagnosis(&self) -> Option<&RecordDiagnosis> {
        self.state.as_ref()?.diagnosis.as_ref()
    }

    /// A level of the lines of one part; NaN if it has none.
    fn line(&self, part: usize, of: fn(&LineLevel) -> f64) -> f64 {
        let lines = self.diagnosis().and_then(|found| found.lines.as_ref());
        lines.map_or(f64::NAN, |lines| of(&lines[part]))
    }
}

/// A quantity of every record.
#[derive(Clone, Debug, PartialEq)]
pub struct TrendQuantity {
    pub name: String,
    pub unit: String,
    /// NaN where it is not known.
    pub values: Vec<f64>,
}

impl TrendResult {
    /// Whether the records with a state have the same unit.
    pub fn has_one_unit(&self) -> bool {
        let mut units = self.records.iter().filter_map(|r| r.state.as_ref()).map(|s| &s.unit);
        units.next().is_none_or(|first| units.all(|unit| unit == first))
    }

    /// The quantities that are compared between the records; levels only if all have one unit.
    pub fn quantities(&self) -> Vec<TrendQuantity> {
        let quantity = |name: &str, unit: &str, of: &dyn Fn(&RecordState) -> Option<f64>| TrendQuantity {
            name: name.into(),
            unit: unit.into(),
            values: self.records.iter().map(|r| r.number(of)).collect(),
        };
        let unit = self.unit.as_str();
        let mut levels = vec![
            quantity("RMS", unit, &|s| Some(s.statistics.rms)),
            quantity("peak", unit, &|s| Some(s.statistics.peak)),
        ];
        levels.extend(self.rms_bands.iter().enumerate().map(|(k, [low, high])| {
            quantity(&format!("RMS {low} to {high} Hz"), unit, &|s| s.band_rms.get(k).copied())
        }));
        let mut shapes = vec![
            quantity("crest factor", "", &|s| s.statistics.crest_factor),
            quantity("kurtosis", "", &|s| s.statistics.kurtosis),
            quantity("skewness", "", &|s| s.statistics.skewness),
        ];
        let mut lines = Vec::new();
        if self.bearing.is_some() {
            lines.extend(BearingPart::ALL.into_iter().enumerate().map(|(k, part)| {
                let name = format!("{} amplitude", part.line_name());
                quantity(&name, unit, &|s| Some(s.diagnosis.as_ref()?.lines?[k].strength))
            }));
            let grade = |s: &RecordState| s.diagnosis.as_ref().map(|found| found.probability);
            shapes.push(quantity("probability of a bearing fault", "", &grade));
        }
        if !self.has_one_unit() {
            (levels, lines) = (Vec::new(), Vec::new());
        }
        let last = shapes.split_off(3.min(shapes.len()));
        levels.into_iter().chain(shapes).chain(lines).chain(last).collect()
    }

    /// What is written to files.
    pub fn section(&self) -> Section<'_> {
        let axis = Document::new()
            .text("name", &self.axis.name)
            .text("unit", &self.axis.unit)
            .text("source", &self.axis.source);
        let bands: Vec<f64> = self.rms_bands.iter().flatten().copied().collect();
        let content = Document::new()
            .group("axis", axis)
            .text("unit", &self.unit)
            .and_if(self.bearing.as_ref(), |out, bearing| out.group("bearing", bearing.document()))
            .and_if(self.line_band, |out, (low, high)| {
                out.number("line_band_low_hz", "Hz", low).number("line_band_high_hz", "Hz", high)
            })
            .and_if((!bands.is_empty()).then_some(bands), |out, bands| {
                out.array("rms_bands_hz", Array::real(&[self.rms_bands.len(), 2], "Hz", bands))
            })
            .table("records", self.record_rows())
            .and_if((!self.changes.is_empty()).then_some(()), |out, ()| {
                out.table("changes", self.change_rows())
            })
            .texts("statements", &self.statements);
        Section::new("trend", "trend", content)
    }

    fn record_rows(&self) -> Rows<'_, '_, TrendRecord> {
        let unit = self.unit.as_str();
        let bands = self.rms_bands.len();
        let rows = Rows::of(&self.records)
            .over("position")
            .text("name", |r| &r.name)
            .number("position", &self.axis.unit, |r| r.position)
            .optional_text("problem", |r| r.problem.as_ref())
            .optional_text("channel", |r| r.state.as_ref().map(|s| &s.channel))
            .optional_text("record_unit", |r| r.state.as_ref().map(|s| &s.unit))
            .number("sample_rate_hz", "Hz", |r| r.number(|s| Some(s.sample_rate)))
            .optional_integer("samples", |r| r.state.as_ref().map(|s| s.samples))
            .quantity("speed", "rad/s", |r| r.number(|s| s.speed.map(|speed| TAU * speed)))
            .optional_text("speed_source", |r| r.state.as_ref().map(|s| &s.speed_source))
            .number("mean", unit, |r| r.number(|s| Some(s.statistics.mean)))
            .number("rms", unit, |r| r.number(|s| Some(s.statistics.rms)))
            .number("peak", unit, |r| r.number(|s| Some(s.statistics.peak)))
            .number("crest_factor", "1", |r| r.number(|s| s.statistics.crest_factor))
            .number("kurtosis", "1", |r| r.number(|s| s.statistics.kurtosis))
            .number("skewness", "1", |r| r.number(|s| s.statistics.skewness));
        let rows = match bands {
            0 => rows,
            _ => rows.numbers("band_rms", unit, &[bands], |r| {
                r.state.as_ref().map_or_else(|| vec![f64::NAN; bands], |s| s.band_rms.clone())
            }),
        };
        if self.bearing.is_none() {
            return rows;
        }
        let edge = |of: fn(&(f64, f64)) -> f64| {
            move |r: &TrendRecord| r.diagnosis().map_or(f64::NAN, |found| of(&found.band))
        };
        let with_lines = BearingPart::ALL.into_iter().enumerate().fold(rows, |rows, (k, part)| {
            let name = part.line_name().to_lowercase().replace(' ', "");
            rows.number(format!("{name}_amplitude"), unit, |r| r.line(k, |line| line.strength)).number(
                format!("{name}_level_db"),
                "dB",
                |r| r.line(k, |line| line.level_db),
            )
        });
        with_lines
            .optional_text("statement", |r| r.diagnosis().map(|found| &found.statement))
            .optional_text("diagnosis", |r| r.diagnosis()?.part.map(BearingPart::name))
            .optional_text("candidate", |r| r.diagnosis().map(|found| found.candidate.name()))
            .number("probability", "1", |r| r.diagnosis().map_or(f64::NAN, |found| found.probability))
            .number("band_low_hz", "Hz", edge(|band| band.0))
            .number("band_high_hz", "Hz", edge(|band| band.1))
    }

    fn change_rows(&self) -> Rows<'_, '_, Change> {
        Rows::of(&self.changes)
            .text("quantity", |c| &c.quantity)
            .text("unit", |c| &c.unit)
            .integer("records", |c| c.trend.count)
            .number("first", "", |c| c.trend.ends[0])
            .number("last", "", |c| c.trend.ends[1])
            .number("slope", "", |c| c.trend.slope)
            .numbers("slope_95_percent", "", &[2], |c| c.trend.slope_interval)
            .number("tau", "1", |c| c.trend.tau)
            .number("p_value", "1", |c| c.trend.p_value)
            .flag("significant", |c| c.significant)
    }
}
