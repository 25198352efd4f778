//! Envelope spectra of many bands of one record, each from an envelope at the lowest rate that holds it.

use std::ops::Range;
use std::sync::{Arc, Mutex, PoisonError};

use realfft::RealFftPlanner;
use rustfft::num_complex::Complex;
use rustfft::{Fft, FftPlanner};

use super::segment::{bin_axis, has_mirror};
use super::spectrum::Spectrum;

/// Equivalent noise bandwidth of a Hann window in bins.
const HANN_NOISE_BANDWIDTH: f64 = 1.5;

/// Power of lines over that of all else in a band below which their beats are lost in it.
const LEAST_TONES: f64 = 1e-4;

/// The spectrum of a record, from which bands are demodulated.
pub(crate) struct Demodulator {
    /// Bins 0 to N/2 of the transform over N.
    bins: Vec<Complex<f64>>,
    samples: usize,
    sample_rate: f64,
    /// Plans of the lengths met so far, shared by the bands.
    plans: Mutex<(FftPlanner<f64>, RealFftPlanner<f64>)>,
}

impl Demodulator {
    pub fn new(record: &[f64], sample_rate: f64) -> Self {
        let samples = record.len();
        let mut bins: Vec<Complex<f64>> = record.iter().map(|&x| Complex::from(x)).collect();
        // The plan of the whole record, as large as its transform, is not kept.
        FftPlanner::new().plan_fft_forward(samples).process(&mut bins);
        bins.truncate(samples / 2 + 1);
        bins.shrink_to_fit();
        let scale = 1.0 / samples as f64;
        for (k, bin) in bins.iter_mut().enumerate() {
            *bin *= if has_mirror(k, samples) { 2.0 * scale } else { scale };
        }
        Demodulator {
            bins,
            samples,
            sample_rate,
            plans: Mutex::new((FftPlanner::new(), RealFftPlanner::new())),
        }
    }

    fn inverse(&self, length: usize) -> Arc<dyn Fft<f64>> {
        self.plans.lock().unwrap_or_else(PoisonError::into_inner).0.plan_fft_inverse(length)
    }

    /// Envelope |z| of a band \[Hz\] and its sampling rate, at least twice the band's width.
    ///
    /// Shifting the band to zero frequency leaves |z| as it is, so the inverse transform needs only the
    /// band's bins; it has the record's duration, so that envelope spectra have the record's bins.
    pub fn envelope(&self, band: (f64, f64)) -> (Vec<f64>, f64) {
        let bins = self.bins_of(band);
        let mut data = vec![Complex::ZERO; self.length(&bins)];
        data[..bins.len()].copy_from_slice(&self.bins[bins]);
        self.inverse(data.len()).process(&mut data);
        (data.iter().map(|z| z.norm_sqr().sqrt()).collect(), self.rate(data.len()))
    }

    /// Bins of a band.
    fn bins_of(&self, band: (f64, f64)) -> Range<usize> {
        let step = self.sample_rate / self.samples as f64;
        let bin_at = |f: f64| ((f / step * (1.0 - 1e-12)).ceil() as usize).min(self.bins.len());
        let (first, mut end) = (bin_at(band.0), bin_at(band.1));
        if band.1 >= 0.5 * self.sample_rate * (1.0 - 1e-12) {
            end = self.bins.len();
        }
        first.min(end)..end
    }

    /// Length of the envelope of a band's bins.
    fn length(&self, bins: &Range<usize>) -> usize {
        let width = bins.len().max(1);
        smooth_length(2 * width).min(self.samples.max(width))
    }

    /// Sampling rate of an envelope of that length, which has the record's duration.
    fn rate(&self, length: usize) -> f64 {
        length as f64 * self.sample_rate / self.samples as f64
    }

    /// Amplitude spectrum (Hann, peak) of the band's envelope minus its mean, up to a frequency \[Hz\].
    ///
    /// The window is applied to the bins: X_k/2 − (X_{k−1} + X_{k+1})/4.
    pub fn envelope_spectrum(&self, band: (f64, f64), end: f64) -> Spectrum {
        let (values, rate) = self.envelope(band);
        self.deviation_spectrum(values, rate, end)
    }

    /// Envelope spectrum of a band whose lines in some bins (`tones`) are replaced by their mean power: amplitude spectrum
    /// of √(|z|² + p), z the band's analytic signal without them, p the mean of their |z|², up to a frequency \[Hz\].
    ///
    /// Beats of these lines, with each other and with others, are missing in it; modulation of all else is not weaker than
    /// in [`Self::envelope_spectrum`]. `None` if the band has none of them or next to no power in them.
    pub fn spectrum_without(&self, tones: &[Range<usize>], band: (f64, f64), end: f64) -> Option<Spectrum> {
        let bins = self.bins_of(band);
        let mut data = vec![Complex::ZERO; self.length(&bins)];
        data[..bins.len()].copy_from_slice(&self.bins[bins.clone()]);
        let mut power = 0.0;
        for tone in tones {
            let inside = tone.start.max(bins.start)..tone.end.min(bins.end);
            for k in inside {
                power += data[k - bins.start].norm_sqr();
                data[k - bins.start] = Complex::ZERO;
            }
        }
        let rest = data.iter().map(Complex::norm_sqr).sum::<f64>();
        if power <= LEAST_TONES * rest {
            return None;
        }
        self.inverse(data.len()).process(&mut data);
        let envelope = data.iter().map(|z| (z.norm_sqr() + power).sqrt()).collect();
        Some(self.deviation_spectrum(envelope, self.rate(data.len()), end))
    }

    /// Amplitude spectrum (Hann, peak) of values minus their mean, up to a frequency \[Hz\].
    fn deviation_spectrum(&self, mut values: Vec<f64>, rate: f64, end: f64) -> Spectrum {
        let length = values.len();
        let mean = values.iter().sum::<f64>() / length as f64;
        values.iter_mut().for_each(|e| *e -= mean);
        let plan = self.plans.lock().unwrap_or_else(PoisonError::into_inner).1.plan_fft_forward(length);
        let mut bins = plan.make_output_vec();
        plan.process(&mut values, &mut bins).expect("the buffers have the lengths of this plan");
        let count = ((end * length as f64 / rate) as usize + 2).min(bins.len());
        let at = |k: usize| bins[k.min(bins.len() - 1)];
        // 2 for both halves of the spectrum, over the window's mean of a half.
        let scale = |k: usize| if has_mirror(k, length) { 4.0 } else { 2.0 } / length as f64;
        let amplitude = |k: usize| {
            let before = if k == 0 { at(1).conj() } else { at(k - 1) };
            let after = if k + 1 == bins.len() { at(k - 1).conj() } else { at(k + 1) };
            scale(k) * (at(k) * 0.5 - (before + after) * 0.25).norm_sqr().sqrt()
        };
        Spectrum {
            frequencies: bin_axis(count, length, rate),
            values: (0..count).map(amplitude).collect(),
            noise_bandwidth_hz: HANN_NOISE_BANDWIDTH * rate / length as f64,
        }
    }
}

/// The smallest even product of 2, 3 and 5 that is not below `least`: a length with a fast transform.
fn smooth_length(least: usize) -> usize {
    let is_smooth = |n: &usize| {
        let mut rest = *n;
        for prime in [2, 3, 5] {
            while rest.is_multiple_of(prime) {
                rest /= prime;
            }
        }
        rest == 1 && n.is_multiple_of(2)
    };
    (least.max(2)..).find(is_smooth).unwrap_or(least)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::envelope::band_analytic_signal;
    use crate::spectrum::{Level, amplitude_spectrum};
    use crate::window::WindowKind;

    /// The same as the envelope at the full rate. Its lines are alike to the share of the envelope's power above
    /// twice the band's width, which the lower rate folds back.
    #[test]
    fn bands_at_a_lower_rate_have_the_same_lines() {
        let rate = 1000.0;
        let wave = |t: f64, f: f64| (std::f64::consts::TAU * f * t).cos();
        let x: Vec<f64> = (0..4000)
            .map(|k| k as f64 / rate)
            .map(|t| (1.0 + 0.5 * wave(t, 7.0)) * wave(t, 310.0) + 3.0 * wave(t, 120.0))
            .collect();
        let band = (260.0, 360.0);
        let got = Demodulator::new(&x, rate).envelope_spectrum(band, 30.0);
        let mut full: Vec<f64> =
            band_analytic_signal(&x, rate, band).unwrap().iter().map(|z| z.norm()).collect();
        let mean = full.iter().sum::<f64>() / full.len() as f64;
        full.iter_mut().for_each(|e| *e -= mean);
        let expected = amplitude_spectrum(&full, rate, WindowKind::Hann, Level::Peak).unwrap();
        assert!((got.values[28] - 0.5).abs() < 1e-9, "{}", got.values[28]);
        for (k, value) in got.values.iter().enumerate() {
            assert!((got.frequencies[k] - expected.frequencies[k]).abs() < 1e-9);
            assert!((value - expected.values[k]).abs() < 1e-9, "{k}: {value} {}", expected.values[k]);
        }
    }
}
