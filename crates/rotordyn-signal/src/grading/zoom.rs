//! Hann-windowed spectrum of a record between its bins, near one frequency.

use std::f64::consts::TAU;

use rustfft::num_complex::Complex;

use super::super::window::WindowKind;

/// Sums that stand for the record; each spans so little that a line two bins off loses 1e-4 of its power in it.
const BLOCKS: usize = 256;
/// Spacing of the trials for a peak \[bins\], within which ln |X|² of a Hann window is a parabola.
const TRIAL: f64 = 0.1;

/// A record times a Hann window.
pub(super) struct WindowedRecord {
    values: Vec<f64>,
    /// Sum of the window.
    sum: f64,
}

impl WindowedRecord {
    pub fn new(record: &[f64]) -> Self {
        let window = WindowKind::Hann.samples(record.len());
        let values = record.iter().zip(&window).map(|(x, w)| x * w).collect();
        WindowedRecord { values, sum: window.iter().sum() }
    }

    /// The spectrum about `centre` \[bins\].
    pub fn zoom(&self, centre: f64) -> Zoom {
        let samples = self.values.len();
        let blocks = BLOCKS.min(samples);
        let rate = -TAU * centre / samples as f64;
        let turn = Complex::from_polar(1.0, rate);
        let edge = |b: usize| b * samples / blocks;
        let block = |b: usize| {
            let (first, end) = (edge(b), edge(b + 1));
            // Each block starts from its exact phase, so that rounding does not add up.
            let mut phase = Complex::from_polar(1.0, rate * first as f64);
            let mut sum = Complex::ZERO;
            for value in &self.values[first..end] {
                sum += phase * *value;
                phase *= turn;
            }
            (0.5 * (first + end - 1) as f64 / samples as f64, sum)
        };
        Zoom { centre, blocks: (0..blocks).map(block).collect(), scale: 2.0 / self.sum }
    }
}

/// The record shifted by a frequency to zero, as sums of short blocks with their times over the record's length.
pub(super) struct Zoom {
    centre: f64,
    blocks: Vec<(f64, Complex<f64>)>,
    scale: f64,
}

impl Zoom {
    /// Amplitude at a frequency \[bins\] within two bins of the centre.
    pub fn amplitude(&self, bin: f64) -> f64 {
        let rate = -TAU * (bin - self.centre);
        let at = |(time, sum): &(f64, Complex<f64>)| sum * Complex::from_polar(1.0, rate * time);
        self.scale * self.blocks.iter().map(at).sum::<Complex<f64>>().norm()
    }

    /// The highest maximum within ± `reach` bins of the centre: its place \[bins\] and amplitude; `None` on a slope.
    pub fn peak(&self, reach: f64) -> Option<(f64, f64)> {
        let count = (reach / TRIAL).ceil() as i64;
        let place = |k: i64| self.centre + k as f64 * TRIAL;
        let levels: Vec<f64> =
            (-count - 1..=count + 1).map(|k| self.amplitude(place(k)).max(f64::MIN_POSITIVE).ln()).collect();
        let best = (1..levels.len() - 1).max_by(|&a, &b| levels[a].total_cmp(&levels[b]))?;
        let (low, mid, high) = (levels[best - 1], levels[best], levels[best + 1]);
        let curvature = low - 2.0 * mid + high;
        if mid < low || mid < high || curvature >= 0.0 {
            return None;
        }
        let shift = 0.5 * (low - high) / curvature;
        let level = mid - 0.25 * (low - high) * shift;
        Some((place(best as i64 - count - 1) + shift * TRIAL, level.exp()))
    }
}
