//! An envelope spectrum over its noise floor: evidence of a line at each bin, and the strongest peaks.

use std::f64::consts::LN_2;

use super::super::background::running_median;
use super::super::ridge::interpolate_peak;
use super::super::spectrum::Spectrum;
use super::rival_kind::{MAINS, RivalKind};

/// Lowest background over the highest line: what is 54 dB below it may be its own by-product.
const DYNAMIC_RANGE: f64 = 2e-3;
/// Bins averaged for lines that speed and slip smear, with the frequency over bin spacing from which a line
/// may be that wide (0.5 % of its frequency), and the independent values they hold behind a Hann window.
const WIDTHS: [(usize, f64, f64); 4] = [(1, 0.0, 1.0), (3, 300.0, 1.86), (5, 500.0, 2.87), (9, 900.0, 4.91)];
/// Evidence from which a single peak counts as a line: one noise bin in 2e5 has as much.
const PEAK_EVIDENCE: f64 = 9.0;
/// Evidence of a line that may be a beat, the share of its amplitude that is left without shaft and mains if it is one,
/// and how many bins off it may be left.
const BEAT_EVIDENCE: f64 = 4.0;
const LEFT: f64 = 0.5;
const BEAT_REACH: usize = 1;
/// Peaks kept.
const MAX_PEAKS: usize = 40;

/// Envelope spectrum with the evidence of lines.
pub(super) struct LineSpectrum {
    /// Spacing of the bins.
    pub step: f64,
    pub amplitude: Vec<f64>,
    background: Vec<f64>,
    evidence: Vec<f64>,
    /// Evidence without the lines that shaft or mains may have.
    foreign: Vec<f64>,
    /// Lines that every machine may have.
    pub known: KnownLines,
    /// Strongest local maxima above the background, strongest first.
    pub peaks: Vec<LinePeak>,
}

/// A peak that noise does not explain.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct LinePeak {
    pub frequency: f64,
    pub amplitude: f64,
    pub background: f64,
}

impl LineSpectrum {
    /// Evidence: log-likelihood ratio n (q̄ − 1 − ln q̄) of the mean of n bins of q = A² ln 2/m² > 1 against noise.
    ///
    /// m is the running median over ± ¾ of the shaft speed; the noise has q exponential with mean 1.
    ///
    /// `without_tones`: the spectrum of the same envelope without the lines of shaft and mains in the band.
    pub fn new(
        spectrum: &Spectrum,
        shaft: f64,
        hz_per_unit: Option<f64>,
        without_tones: Option<&Spectrum>,
    ) -> Self {
        let step = spectrum.frequencies[1] - spectrum.frequencies[0];
        let half_width = ((0.75 * shaft / step).round() as usize).max(24);
        let mut background = running_median(&spectrum.values, half_width);
        let highest = spectrum.values.iter().skip(1).copied().fold(0.0, f64::max);
        background.iter_mut().for_each(|m| *m = m.max(DYNAMIC_RANGE * highest));
        let ratio: Vec<f64> =
            spectrum.values.iter().zip(&background).map(|(a, m)| LN_2 * (a / m).powi(2)).collect();
        let evidence = line_evidence(&ratio);
        let peaks = peaks(spectrum, &background, &ratio);
        let known = KnownLines::new(shaft, hz_per_unit, step, beats(without_tones, spectrum, &evidence));
        let open = |(k, e): (usize, &f64)| if known.contains(k as f64 * step) { 0.0 } else { *e };
        let foreign = evidence.iter().enumerate().map(open).collect();
        LineSpectrum { step, amplitude: spectrum.values.clone(), background, evidence, foreign, known, peaks }
    }

    /// Peaks that beats of shaft and mains do not explain.
    pub fn free_peaks(&self) -> impl Iterator<Item = &LinePeak> {
        self.peaks.iter().filter(|peak| !self.known.is_beat(peak.frequency))
    }

    /// Highest frequency.
    pub fn end(&self) -> f64 {
        self.step * (self.amplitude.len() - 2) as f64
    }

    /// Evidence at a frequency: the higher of the two bins beside it; 0 outside the spectrum.
    pub fn evidence(&self, frequency: f64) -> f64 {
        self.higher_of_two(&self.evidence, frequency)
    }

    /// Evidence of a line that is neither of the shaft nor of the mains.
    pub fn foreign_evidence(&self, frequency: f64) -> f64 {
        self.higher_of_two(&self.foreign, frequency)
    }

    /// Mean of [`Self::evidence`], at most `limit` at each place, over the spectrum.
    pub fn mean_evidence(&self, limit: f64) -> f64 {
        let inner = self.evidence.get(2..).unwrap_or(&[]);
        let count = inner.len().saturating_sub(1).max(1) as f64;
        inner.windows(2).map(|two| two[0].max(two[1]).min(limit)).sum::<f64>() / count
    }

    /// Power of an amplitude at a bin over that of the noise, q = A² ln 2/m².
    pub fn power_ratio(&self, bin: usize, amplitude: f64) -> f64 {
        LN_2 * (amplitude / self.background[bin.min(self.background.len() - 1)]).powi(2)
    }

    /// Mean power of the noise in a bin, m²/ln 2.
    pub fn noise_power(&self, bin: usize) -> f64 {
        self.background[bin].powi(2) / LN_2
    }

    fn higher_of_two(&self, evidence: &[f64], frequency: f64) -> f64 {
        let place = frequency / self.step;
        if place < 2.0 || place >= (evidence.len() - 2) as f64 {
            return 0.0;
        }
        let bin = place as usize;
        evidence[bin].max(evidence[bin + 1])
    }

    /// Frequency of the maximum up the slope from the bin nearest to a frequency, at most `reach` bins off; `None` if there
    /// is none.
    ///
    /// Between bins by a parabola through the logarithms, which is what a line behind a Hann window is.
    pub fn top_near(&self, frequency: f64, reach: usize) -> Option<f64> {
        let start = (frequency / self.step).round() as usize;
        let a = &self.amplitude;
        let inside = |k: usize| k >= 2 && k + 2 < a.len();
        let mut bin = start;
        while inside(bin) && a[bin - 1].max(a[bin + 1]) > a[bin] {
            bin = if a[bin + 1] > a[bin - 1] { bin + 1 } else { bin - 1 };
        }
        if !inside(bin) || bin.abs_diff(start) > reach {
            return None;
        }
        let [low, top, high] = [bin - 1, bin, bin + 1].map(|k| a[k].max(f64::MIN_POSITIVE).ln());
        let curvature = low - 2.0 * top + high;
        let shift = if curvature < 0.0 { 0.5 * (low - high) / curvature } else { 0.0 };
        Some((bin as f64 + shift) * self.step)
    }

    /// Highest bin within ± `reach` of a frequency: frequency and amplitude; `None` outside the spectrum.
    pub fn highest(&self, frequency: f64, reach: f64) -> Option<(f64, f64)> {
        let first = ((frequency - reach) / self.step).ceil().max(2.0) as usize;
        let last = ((frequency + reach) / self.step).floor().max(0.0) as usize;
        let bins = first..=last.min(self.amplitude.len() - 2);
        let bin = bins.max_by(|&a, &b| self.amplitude[a].total_cmp(&self.amplitude[b]))?;
        Some((bin as f64 * self.step, self.amplitude[bin]))
    }
}

/// Lines that every machine may have: harmonics of the shaft speed and of the mains.
///
/// A line that coincides with one of them says nothing of a bearing, whether or not the others stand. Nor does one that
/// lines of shaft and mains in the record itself give by their beats in the demodulated band.
#[derive(Clone)]
pub(super) struct KnownLines {
    pub shaft: f64,
    hz_per_unit: Option<f64>,
    step: f64,
    /// Whether beats explain what stands in a bin; empty without any.
    beats: Vec<bool>,
}

impl KnownLines {
    /// Highest shaft order, highest frequency of the mains' harmonics \[Hz\].
    const SHAFT_ORDERS: f64 = 30.0;
    const MAINS_END: f64 = 600.0;

    pub fn new(shaft: f64, hz_per_unit: Option<f64>, step: f64, beats: Vec<bool>) -> Self {
        KnownLines { shaft, hz_per_unit, step, beats }
    }

    pub fn contains(&self, frequency: f64) -> bool {
        self.is_beat(frequency) || self.origin(frequency).is_some()
    }

    /// Whether beats of shaft and mains explain a line at a frequency.
    pub fn is_beat(&self, frequency: f64) -> bool {
        let bin = (frequency / self.step).round() as usize;
        self.beats.get(bin).is_some_and(|beat| *beat)
    }

    /// What has a line at a frequency, and its rate.
    pub fn origin(&self, frequency: f64) -> Option<(RivalKind, f64)> {
        if self.is_shaft(frequency) {
            return Some((RivalKind::Shaft, self.shaft));
        }
        self.mains(frequency).map(|rate| (RivalKind::Mains, rate))
    }

    /// 1 at a line of shaft or mains, falling to 0 at four tolerances from it.
    pub fn nearness(&self, frequency: f64) -> f64 {
        if self.is_beat(frequency) {
            return 1.0;
        }
        let near = |rate: f64, relative: f64| {
            let number = (frequency / rate).round().max(1.0);
            let distance = (frequency - number * rate).abs() / (self.step + relative * frequency);
            (1.0 - 0.25 * distance).max(0.0)
        };
        let mains = |rate: f64| {
            self.hz_per_unit
                .filter(|unit| frequency * unit <= Self::MAINS_END)
                .map_or(0.0, |unit| near(rate / unit, 3e-4))
        };
        MAINS.into_iter().map(mains).fold(near(self.shaft, 7e-4), f64::max)
    }

    /// Tolerance: a bin, and 0.07 % of the stated speed.
    fn is_shaft(&self, frequency: f64) -> bool {
        let order = (frequency / self.shaft).round();
        (1.0..=Self::SHAFT_ORDERS).contains(&order)
            && (frequency - order * self.shaft).abs() <= self.step + 7e-4 * frequency
    }

    /// Tolerance: a bin, and 0.03 % of the mains' frequency.
    fn mains(&self, frequency: f64) -> Option<f64> {
        let unit = self.hz_per_unit?;
        let hz = frequency * unit;
        let is_of = |mains: &f64| {
            let number = (hz / mains).round();
            number >= 1.0 && (hz - number * mains).abs() <= self.step * unit + 3e-4 * hz
        };
        MAINS.into_iter().filter(|_| hz <= Self::MAINS_END).find(is_of).map(|mains| mains / unit)
    }
}

/// Bins in which a line stands that is missing, there and in the next bins, without the lines of shaft and mains.
fn beats(without_tones: Option<&Spectrum>, spectrum: &Spectrum, evidence: &[f64]) -> Vec<bool> {
    let Some(without) = without_tones else { return Vec::new() };
    let left = |k: usize| without.values.get(k).copied().unwrap_or(0.0);
    let about = |k: usize| (k.saturating_sub(BEAT_REACH)..=k + BEAT_REACH).map(left).fold(0.0, f64::max);
    let is_beat = |(k, a): (usize, &f64)| evidence[k] > BEAT_EVIDENCE && about(k) < LEFT * a;
    spectrum.values.iter().enumerate().map(is_beat).collect()
}

/// Evidence at every bin, the highest over the admitted widths.
fn line_evidence(ratio: &[f64]) -> Vec<f64> {
    let mut sums = vec![0.0; ratio.len() + 1];
    for (k, q) in ratio.iter().enumerate() {
        sums[k + 1] = sums[k] + q;
    }
    let at = |k: usize| {
        let admitted = WIDTHS
            .iter()
            .filter(|(width, from, _)| k as f64 >= *from && k >= width / 2 && k + width / 2 < ratio.len());
        admitted
            .map(|(width, _, independent)| {
                let (first, end) = (k - width / 2, k + width / 2 + 1);
                let mean = (sums[end] - sums[first]) / *width as f64;
                if mean > 1.0 { independent * (mean - 1.0 - mean.ln()) } else { 0.0 }
            })
            .fold(0.0, f64::max)
    };
    (0..ratio.len()).map(at).collect()
}

fn peaks(spectrum: &Spectrum, background: &[f64], ratio: &[f64]) -> Vec<LinePeak> {
    let values = &spectrum.values;
    let is_peak = |k: &usize| {
        let q = ratio[*k];
        values[*k] > values[k - 1]
            && values[*k] >= values[k + 1]
            && q - 1.0 - q.ln() > PEAK_EVIDENCE
            && q > 1.0
    };
    let mut found: Vec<LinePeak> = (2..values.len().saturating_sub(2))
        .filter(is_peak)
        .map(|k| {
            let peak = interpolate_peak(&spectrum.frequencies, values, k);
            LinePeak { frequency: peak.position, amplitude: peak.amplitude, background: background[k] }
        })
        .collect();
    found.sort_by(|a, b| b.amplitude.total_cmp(&a.amplitude).then(a.frequency.total_cmp(&b.frequency)));
    // A peak on the skirt of a higher one is part of that line.
    let step = spectrum.frequencies[1] - spectrum.frequencies[0];
    let mut kept: Vec<LinePeak> = Vec::new();
    for peak in found {
        let skirt = |top: &LinePeak| {
            (peak.frequency - top.frequency).abs() < (3.0 * step).max(0.008 * top.frequency)
                && top.amplitude > 2.0 * peak.amplitude
        };
        if !kept.iter().any(skirt) {
            kept.push(peak);
        }
        if kept.len() == MAX_PEAKS {
            break;
        }
    }
    kept
}
