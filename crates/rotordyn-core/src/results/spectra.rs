//! Spectrograms and order spectrograms of a run-up.

use super::OrderLine;
use super::order_tracks::tracks_document;
use crate::document::{Array, Document, Rows, Section, StoredArray, Value, in_hdf5, in_json};
use crate::series::Series;
use rotordyn_signal::order::{OrderCut, OrderSpectrogram};
use rotordyn_signal::order_tracks::OrderTracks;
use rotordyn_signal::segment::Level;
use rotordyn_signal::stft::Spectrogram;
use serde::{Deserialize, Serialize};
use std::f64::consts::TAU;

/// Spectrogram of one channel with the speed at every frame.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct SpectrogramResult {
    pub channel: String,
    pub unit: String,
    pub spectrogram: Spectrogram<Series>,
    /// Its highest amplitude; `None` of an empty one.
    pub peak: Option<SpectrogramPeak>,
    /// Speed at every frame \[rad/s\].
    pub speed: Vec<f64>,
    pub orders: Vec<OrderLine>,
}

/// The highest amplitude of a spectrogram.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct SpectrogramPeak {
    /// Speed \[rad/s\] and frequency \[Hz\] there.
    pub speed: f64,
    pub frequency: f64,
    pub amplitude: f64,
}

/// Order spectrogram and cuts of one channel.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct OrderResult {
    pub channel: String,
    pub unit: String,
    pub spectrogram: OrderSpectrogram<Series>,
    pub cuts: Vec<(OrderLine, OrderCut)>,
    /// Amplitude and phase of the cuts' orders by the Vold-Kalman filter, if asked for.
    pub tracks: Option<OrderTracks>,
}

impl SpectrogramResult {
    /// What is written to files.
    pub fn section(&self) -> Section<'_> {
        Section::listed("spectrograms", format!("spectra/{}/spectrogram", self.channel), self.document())
    }

    fn document(&self) -> Document<'_> {
        let s = &self.spectrogram;
        let (frames, bins) = (s.times.len(), s.frequencies.len());
        let peak = self.peak.map(|peak| {
            Document::new()
                .quantity("speed", "rad/s", peak.speed)
                .quantity("frequency", "Hz", peak.frequency)
                .number("amplitude", "", peak.amplitude)
        });
        let rpm: Vec<f64> = self.speed.iter().map(|speed| speed * 60.0 / TAU).collect();
        Document::new()
            .text(in_json("channel"), &self.channel)
            .text(in_json("unit"), &self.unit)
            .integer(in_json("frames"), frames)
            .integer(in_json("frequencies"), bins)
            .with(in_json("peak"), peak.map_or(Value::Missing, Value::Group))
            .and(map_document(
                s.level,
                s.noise_bandwidth_bins,
                &s.amplitude,
                [frames, bins],
                &self.unit,
                "frequency",
            ))
            .numbers(in_hdf5("rpm"), "rpm", rpm)
            .numbers(in_hdf5("time"), "s", &s.times)
            .numbers(in_hdf5("frequency"), "Hz", &s.frequencies)
    }
}

impl OrderResult {
    /// What is written to files.
    pub fn section(&self) -> Section<'_> {
        Section::listed("orders", format!("spectra/{}/orders", self.channel), self.document())
    }

    fn document(&self) -> Document<'_> {
        let s = &self.spectrogram;
        let (windows, bins) = (s.times.len(), s.orders.len());
        let cuts = Rows::of(&self.cuts)
            .text("label", |(line, _)| &line.label)
            .number("order", "1/revolution", |(_, cut)| cut.order)
            .series("speed_rpm", "rpm", |(_, cut)| &cut.rpm)
            .series("rms", "", |(_, cut)| &cut.rms);
        let out = Document::new()
            .text(in_json("channel"), &self.channel)
            .text(in_json("unit"), &self.unit)
            .table(in_json("cuts"), cuts)
            .and(map_document(
                s.level,
                s.noise_bandwidth_bins,
                &s.amplitude,
                [windows, bins],
                &self.unit,
                "order",
            ))
            .numbers(in_hdf5("rpm"), "rpm", &s.rpm)
            .numbers(in_hdf5("time"), "s", &s.times)
            .numbers(in_hdf5("order"), "1/revolution", &s.orders);
        if self.cuts.is_empty() {
            return out;
        }
        let lines = || self.cuts.iter().map(|(line, _)| line);
        let out = out.and_if(self.tracks.as_ref(), |out, found| {
            out.group("vold_kalman", tracks_document(&self.channel, lines(), found, &self.unit))
        });
        let rms: Vec<f64> = self.cuts.iter().flat_map(|(_, cut)| &cut.rms).copied().collect();
        let orders: Vec<f64> = self.cuts.iter().map(|(_, cut)| cut.order).collect();
        let rms = Array::real(&[self.cuts.len(), windows], &self.unit, rms).over(1, "rpm");
        out.array(in_hdf5("cuts/rms"), rms)
            .texts(in_hdf5("cuts/label"), self.cuts.iter().map(|(line, _)| &line.label))
            .numbers(in_hdf5("cuts/order"), "1/revolution", orders)
    }
}

/// Amplitudes over time (and rpm) and `axis`.
fn map_document<'a>(
    level: Level,
    noise_bandwidth_bins: f64,
    amplitude: &'a Series,
    shape: [usize; 2],
    unit: &str,
    axis: &str,
) -> Document<'a> {
    let level = match level {
        Level::Peak => "peak",
        Level::Rms => "RMS",
    };
    let out = Document::new().text(in_hdf5("level"), level).number(
        in_hdf5("noise_bandwidth_bins"),
        "1",
        noise_bandwidth_bins,
    );
    match amplitude.in_memory() {
        Some(values) => {
            let map = Array::real(&shape, unit, values).over(0, "rpm").over(0, "time").over(1, axis);
            out.array(in_hdf5("amplitude"), map)
        }
        None => {
            let axes = [(0, "rpm"), (0, "time"), (1, axis)].map(|(k, name)| (k, name.to_string())).into();
            let (shape, values) = (shape.into(), amplitude.clone());
            out.stored("amplitude", StoredArray { shape, values, unit: unit.into(), axes })
        }
    }
}
