//! Results of a signal analysis of one channel.

mod average;
mod curves;
mod cyclic;
mod envelope;
mod jerk;
mod kurtogram;
mod orders;

pub use average::ShaftAverage;
pub use cyclic::{CyclicLine, CyclicResult};
pub use envelope::EnvelopeResult;
pub use jerk::{JerkResult, RaceResult};
pub use kurtogram::KurtogramResult;
pub use orders::ShaftOrders;
use serde::{Deserialize, Serialize};

use super::bearing::orders_document;
use crate::document::{Array, Document, Section, in_hdf5, in_json, named};
use curves::{highest_peaks, over_axis, peak_rows};
use rotordyn_bearing::CharacteristicOrders;
use rotordyn_signal::cepstrum::Cepstrum;
use rotordyn_signal::grading::SpeedFinding;
use rotordyn_signal::spectrum::Spectrum;
use rotordyn_signal::statistics::Statistics;
use rotordyn_signal::stft::Spectrogram;
use rotordyn_units::names::group_name;
use std::f64::consts::TAU;

/// Probability of a named part whose lines confirm the stated shaft speed.
const CERTAIN: f64 = 0.95;

/// Results of one channel; analyses not requested are empty.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub struct SignalResult {
    pub channel: String,
    /// SI unit; empty if unknown.
    pub unit: String,
    /// \[Hz\].
    pub sample_rate: f64,
    /// Time of the first sample \[s\].
    pub start: f64,
    /// The analysed samples.
    pub samples: Vec<f64>,
    pub shaft: Option<ShaftSummary>,
    /// Shaft speed that the record itself shows; `None` if it was not searched.
    pub record_speed: Option<SpeedFinding>,
    /// Times \[s\] and speeds \[rpm\] at some 200 instants; empty if only the mean is known.
    pub speed: [Vec<f64>; 2],
    pub bearing: Option<BearingWithOrders>,
    pub statistics: Statistics,
    /// Amplitude spectrum of the whole record (Hann, peak).
    pub spectrum: Option<Spectrum>,
    /// Power spectral density \[unit²/Hz\].
    pub density: Option<Spectrum>,
    pub spectrogram: Option<SpectrogramWithSpeed>,
    pub envelope: Option<EnvelopeResult>,
    pub kurtogram: Option<KurtogramResult>,
    /// Real cepstrum.
    pub cepstrum: Option<Cepstrum>,
    pub jerk: Option<JerkResult>,
    pub orders: Option<ShaftOrders>,
    pub average: Option<ShaftAverage>,
    pub cyclic: Option<CyclicResult>,
    /// Warnings for the user, once each.
    pub warnings: Vec<String>,
}

/// Shaft speed during a record.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ShaftSummary {
    /// Description of the speed's source.
    pub source: String,
    /// Speeds \[rev/s\].
    pub mean: f64,
    pub min: f64,
    pub max: f64,
    /// Whether the speed is constant within the tolerance: frequencies in Hz instead of orders.
    pub steady: bool,
}

/// A bearing with its characteristic orders (per shaft revolution).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct BearingWithOrders {
    pub name: String,
    /// Description of the orders' source.
    pub source: String,
    pub orders: CharacteristicOrders,
    /// Number of balls Z.
    pub balls: usize,
    /// Radii of the raceways, inner and outer, (D_pw ∓ D_w cos α)/2 \[m\]; `None` if only orders are known.
    pub raceway_radii: Option<[f64; 2]>,
}

/// Amplitudes over time and frequency, with the speed at each time if known.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SpectrogramWithSpeed {
    pub map: Spectrogram,
    /// \[rpm\]; empty if unknown.
    pub rpm: Vec<f64>,
}

impl SignalResult {
    /// Mean shaft speed \[rev/s\]: that of the record's own harmonics if they were found, else the stated one.
    pub fn shaft_speed(&self) -> Option<f64> {
        match self.record_speed {
            Some(SpeedFinding::Found(found)) => Some(found.speed),
            _ => self.shaft.as_ref().map(|s| s.mean),
        }
    }

    /// The search for the shaft speed, if neither its harmonics nor a diagnosis confirm the stated one.
    ///
    /// A part named at 95 % or above has its lines at multiples of the stated speed. Lines of 4 times that speed
    /// are harmonics of it too; a family of a half or a quarter of it is doubtful whatever the diagnosis. So is one of
    /// twice that speed, its even harmonics without the odd ones: a shaft has 1x.
    pub fn unconfirmed_speed(&self) -> Option<SpeedFinding> {
        let found = self.record_speed.filter(|found| !matches!(found, SpeedFinding::Found(_)))?;
        let doubtful = matches!(found, SpeedFinding::Elsewhere { ratio, .. } if ratio <= 2.0);
        let graded = self.envelope.as_ref().and_then(|envelope| envelope.graded.as_ref());
        let is_named = graded.is_some_and(|g| g.part().is_some() && g.probability >= CERTAIN);
        (doubtful || !is_named).then_some(found)
    }

    /// The group of the channel.
    pub fn section(&self) -> Section<'_> {
        Section::listed("channels", group_name(&self.channel), self.document())
    }

    /// What is written to files.
    pub fn document(&self) -> Document<'_> {
        let unit = self.unit.as_str();
        let [time, rpm] = &self.speed;
        let resolution = |s: &Spectrum| {
            let peaks = peak_rows(&highest_peaks(&s.frequencies, &s.values), "frequency_hz", "amplitude");
            Document::new()
                .number(
                    in_json("resolution_hz"),
                    "Hz",
                    s.frequencies.get(1).map_or(f64::NAN, |f| f - s.frequencies[0]),
                )
                .with(in_json("peaks"), peaks)
        };
        Document::new()
            .text("channel", &self.channel)
            .text("unit", unit)
            .number(named("sample_rate_hz", "sample_rate"), "Hz", self.sample_rate)
            .quantity("start", "s", self.start)
            .integer(in_json("samples"), self.samples.len())
            .numbers(in_hdf5("record"), unit, &self.samples)
            .and_if(self.shaft.as_ref(), |out, shaft| out.group(named("shaft", ""), shaft.document()))
            .and_if(self.record_speed, |out, found| {
                let (found, ratio) = match found {
                    SpeedFinding::Found(speed) => (Some(speed), 1.0),
                    SpeedFinding::Elsewhere { speed, ratio } => (Some(speed), ratio),
                    SpeedFinding::NotFound => (None, f64::NAN),
                };
                let speed = Document::new()
                    .quantity("found", "rad/s", found.map_or(f64::NAN, |s| TAU * s.speed))
                    .quantity("uncertainty", "rad/s", found.map_or(f64::NAN, |s| TAU * s.uncertainty))
                    .integer("harmonics", found.map_or(0, |s| s.harmonics))
                    .number("ratio_to_stated", "1", ratio);
                out.group("record_speed", speed)
            })
            .and_if((!time.is_empty()).then_some(()), |out, ()| {
                let speed = Document::new()
                    .array("rpm", Array::real(&[rpm.len()], "rpm", rpm).over(0, "time"))
                    .numbers(named("time_s", "time"), "s", time);
                out.group("speed", speed)
            })
            .and_if(self.bearing.as_ref(), |out, b| out.group(named("bearing", ""), b.document()))
            .group(named("statistics", ""), statistics_document(&self.statistics))
            .and_if(self.spectrum.as_ref(), |out, s| {
                out.group("spectrum", over_axis(s, "frequency", "Hz", unit).and(resolution(s)))
            })
            .and_if(self.density.as_ref(), |out, s| {
                let unit = format!("({unit})^2/Hz");
                out.group("density", over_axis(s, "frequency", "Hz", &unit).and(resolution(s)))
            })
            .and_if(self.spectrogram.as_ref(), |out, s| out.group(in_hdf5("spectrogram"), s.document(unit)))
            .and_if(self.envelope.as_ref(), |out, found| out.and(found.document(unit)))
            .and_if(self.kurtogram.as_ref(), |out, found| out.and(found.document()))
            .and_if(self.cepstrum.as_ref(), |out, c| {
                let peaks = peak_rows(&highest_peaks(&c.quefrencies, &c.values), "quefrency_s", "value");
                let values = Array::real(&[c.values.len()], "1", &c.values).over(0, "quefrency");
                let content = Document::new()
                    .with(in_json("peaks"), peaks)
                    .array(in_hdf5("values"), values)
                    .numbers(in_hdf5("quefrency"), "s", &c.quefrencies);
                out.group("cepstrum", content)
            })
            .and_if(self.jerk.as_ref(), |out, found| out.and(found.document(unit)))
            .and_if(self.orders.as_ref(), |out, found| {
                out.group("orders", found.document(&self.channel, unit))
            })
            .and_if(self.average.as_ref(), |out, found| {
                out.group("synchronous_average", found.document(unit))
            })
            .and_if(self.cyclic.as_ref(), |out, found| {
                out.group("cyclic_coherence", found.document(&self.channel))
            })
            .texts(in_json("warnings"), &self.warnings)
    }
}

impl ShaftSummary {
    fn document(&self) -> Document<'_> {
        Document::new()
            .text(named("source", "speed_source"), &self.source)
            .number(in_json("mean_rpm"), "rpm", 60.0 * self.mean)
            .number(in_json("min_rpm"), "rpm", 60.0 * self.min)
            .number(in_json("max_rpm"), "rpm", 60.0 * self.max)
            .number(in_hdf5("speed"), "rad/s", TAU * self.mean)
            .number(in_hdf5("min_speed"), "rad/s", TAU * self.min)
            .number(in_hdf5("max_speed"), "rad/s", TAU * self.max)
            .flag(in_json("steady"), self.steady)
    }
}

impl BearingWithOrders {
    pub(super) fn document(&self) -> Document<'_> {
        Document::new()
            .text(named("name", "bearing"), &self.name)
            .text(in_json("source"), &self.source)
            .integer(in_json("balls"), self.balls)
            .group(named("orders", ""), orders_document(&self.orders))
    }
}

fn statistics_document<'a>(s: &Statistics) -> Document<'a> {
    let known = |value: Option<f64>| value.unwrap_or(f64::NAN);
    Document::new()
        .number("mean", "", s.mean)
        .number("standard_deviation", "", s.standard_deviation)
        .number("rms", "", s.rms)
        .number("peak", "", s.peak)
        .number("crest_factor", "1", known(s.crest_factor))
        .number("kurtosis", "1", known(s.kurtosis))
        .number("skewness", "1", known(s.skewness))
        .number(in_json("peak_to_peak"), "", s.peak_to_peak)
        .number(in_json("mean_absolute"), "", s.mean_absolute)
        .number(in_json("shape_factor"), "1", known(s.shape_factor))
        .number(in_json("impulse_factor"), "1", known(s.impulse_factor))
        .number(in_json("clearance_factor"), "1", known(s.clearance_factor))
}

impl SpectrogramWithSpeed {
    fn document(&self, unit: &str) -> Document<'_> {
        let map = &self.map;
        let shape = [map.times.len(), map.frequencies.len()];
        let amplitude = Array::real(&shape, unit, &map.amplitude).over(0, "time").over(1, "frequency");
        Document::new()
            .array("amplitude", amplitude)
            .numbers("time", "s", &map.times)
            .numbers("frequency", "Hz", &map.frequencies)
            .and_if((!self.rpm.is_empty()).then_some(&self.rpm), |out, rpm| out.numbers("rpm", "rpm", rpm))
    }
}
