//! Short-time Fourier transform (STFT): spectrogram over time, and over rpm with a speed signal.

use super::SignalError;
use super::error::{check, check_length, check_rate, check_record};
use super::segment::{Level, SegmentTransform, bin_axis};
use super::window::WindowKind;
use serde::{Deserialize, Serialize};

/// Settings of a short-time Fourier transform.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StftSettings {
    pub window: WindowKind,
    /// Samples of a frame.
    pub length: usize,
    /// Samples from one frame to the next.
    pub hop: usize,
    /// FFT length; if longer than a frame, zero padding interpolates between bins.
    pub fft_length: usize,
    pub level: Level,
}

impl StftSettings {
    /// Frames of `length` samples with `overlap` (a fraction 0..1), no padding, peak amplitudes.
    ///
    /// The hop is rounded to whole samples, at least one.
    pub fn new(window: WindowKind, length: usize, overlap: f64) -> Result<Self, SignalError> {
        check((0.0..1.0).contains(&overlap), "overlap", "a fraction from 0 to below 1", overlap)?;
        let hop = ((length as f64 * (1.0 - overlap)).round() as usize).max(1);
        Ok(StftSettings { window, length, hop, fft_length: length, level: Level::Peak })
    }
}

/// Amplitudes over time and frequency.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Spectrogram<A = Vec<f64>> {
    /// Centre of each frame \[s\] from the record's first sample.
    pub times: Vec<f64>,
    /// Bin frequencies \[Hz\].
    pub frequencies: Vec<f64>,
    /// Amplitudes, row-major: a row for each time, a column for each frequency.
    pub amplitude: A,
    /// Equivalent noise bandwidth in bins.
    pub noise_bandwidth_bins: f64,
    pub level: Level,
}

impl Spectrogram {
    /// Amplitudes of one frame over the frequencies.
    pub fn row(&self, frame: usize) -> &[f64] {
        let bins = self.frequencies.len();
        &self.amplitude[frame * bins..(frame + 1) * bins]
    }
}

impl<A> Spectrogram<A> {
    /// The same with amplitudes in another form, such as stored ones.
    ///
    /// # Errors
    /// That of `form`.
    pub fn try_map_amplitude<B, E>(self, form: impl FnOnce(A) -> Result<B, E>) -> Result<Spectrogram<B>, E> {
        let Self { times, frequencies, amplitude, noise_bandwidth_bins, level } = self;
        let amplitude = form(amplitude)?;
        Ok(Spectrogram { times, frequencies, amplitude, noise_bandwidth_bins, level })
    }

    /// Speed at each frame's centre, by linear interpolation of a speed sampled like the record.
    ///
    /// `speed` (any unit, e.g. rpm) has the record's `sample_rate` \[Hz\]. Errors: NaN, too short a speed
    /// signal.
    pub fn speed_at_frames(&self, speed: &[f64], sample_rate: f64) -> Result<Vec<f64>, SignalError> {
        check_record("speed", speed)?;
        check_rate(sample_rate)?;
        let last = self.times.last().map_or(0, |t| (t * sample_rate).ceil() as usize);
        check_length("speed", speed.len(), last, "the last frame's centre")?;
        Ok(self.times.iter().map(|t| interpolate_at(speed, t * sample_rate)).collect())
    }
}

/// Linear interpolation at a fractional index, constant beyond the ends; `values` is not empty.
pub(crate) fn interpolate_at(values: &[f64], position: f64) -> f64 {
    let position = position.clamp(0.0, (values.len() - 1) as f64);
    let low = position as usize;
    let high = (low + 1).min(values.len() - 1);
    values[low] + (position - low as f64) * (values[high] - values[low])
}

/// A planned short-time Fourier transform, reusable for any number of channels.
pub struct Stft {
    settings: StftSettings,
    sample_rate: f64,
    transform: SegmentTransform,
}

impl Stft {
    /// Plans the transform; `sample_rate` \[Hz\]. Errors: no samples in a frame, no hop, padding below a
    /// frame.
    pub fn new(settings: StftSettings, sample_rate: f64) -> Result<Self, SignalError> {
        check_rate(sample_rate)?;
        check(settings.length >= 2, "frame length", "two samples or more", settings.length as f64)?;
        check(settings.hop >= 1, "hop", "one sample or more", settings.hop as f64)?;
        check(
            settings.fft_length >= settings.length,
            "transform length",
            "at least the frame length",
            settings.fft_length as f64,
        )?;
        let transform = SegmentTransform::new(settings.window, settings.length, settings.fft_length);
        Ok(Stft { settings, sample_rate, transform })
    }

    /// Spectrogram of a record; frames lie inside it, a frame's time is its centre, L/2 samples in.
    ///
    /// Amplitudes are scaled like [`super::spectrum::amplitude_spectrum`]. Errors: NaN, record shorter than a
    /// frame.
    pub fn spectrogram(&mut self, record: &[f64]) -> Result<Spectrogram, SignalError> {
        self.spectrogram_up_to(record, f64::INFINITY)
    }

    /// The same without the bins above a frequency \[Hz\]; at least one is kept.
    ///
    /// # Errors
    /// As [`Self::spectrogram`].
    pub fn spectrogram_up_to(&mut self, record: &[f64], limit: f64) -> Result<Spectrogram, SignalError> {
        check_record("record", record)?;
        let StftSettings { length, hop, level, fft_length, .. } = self.settings;
        check_length("record", record.len(), length, "one frame")?;
        let frames = (record.len() - length) / hop + 1;
        let bins = self.transform.bins();
        let mut frequencies = bin_axis(bins, fft_length, self.sample_rate);
        frequencies.truncate(frequencies.partition_point(|f| *f <= limit).max(1));
        let kept = frequencies.len();
        let mut amplitude = vec![0.0; frames * kept];
        for (frame, row) in amplitude.chunks_exact_mut(kept).enumerate() {
            self.transform.amplitudes(&record[frame * hop..frame * hop + length], level, row);
        }
        let centre = |frame: usize| ((frame * hop) as f64 + length as f64 / 2.0) / self.sample_rate;
        Ok(Spectrogram {
            times: (0..frames).map(centre).collect(),
            frequencies,
            amplitude,
            noise_bandwidth_bins: self.transform.noise_bandwidth_bins(),
            level,
        })
    }
}
