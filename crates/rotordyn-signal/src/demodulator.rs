//! Envelopes of many bands of one record, each at the lowest rate that holds it.

use rustfft::FftPlanner;
use rustfft::num_complex::Complex;

/// The spectrum of a record, from which bands are demodulated.
pub(crate) struct Demodulator {
    /// Bins 0 to N/2 of the transform over N.
    bins: Vec<Complex<f64>>,
    samples: usize,
    sample_rate: f64,
}

impl Demodulator {
    pub fn new(record: &[f64], sample_rate: f64) -> Self {
        let samples = record.len();
        let mut bins: Vec<Complex<f64>> = record.iter().map(|&x| Complex::from(x)).collect();
        FftPlanner::new().plan_fft_forward(samples).process(&mut bins);
        bins.truncate(samples / 2 + 1);
        let scale = 1.0 / samples as f64;
        for (k, bin) in bins.iter_mut().enumerate() {
            *bin *= if k == 0 || 2 * k == samples { scale } else { 2.0 * scale };
        }
        Demodulator { bins, samples, sample_rate }
    }

    /// Envelope |z| of a band \[Hz\] and its sampling rate, at least twice the band's width.
    ///
    /// Shifting the band to zero frequency leaves |z| as it is, so the inverse transform needs only the
    /// band's bins; it has the record's duration, so that envelope spectra have the record's bins.
    pub fn envelope(&self, band: (f64, f64)) -> (Vec<f64>, f64) {
        let step = self.sample_rate / self.samples as f64;
        let bin_at = |f: f64| ((f / step * (1.0 - 1e-12)).ceil() as usize).min(self.bins.len());
        let (first, mut end) = (bin_at(band.0), bin_at(band.1));
        if band.1 >= 0.5 * self.sample_rate * (1.0 - 1e-12) {
            end = self.bins.len();
        }
        let width = end.saturating_sub(first).max(1);
        let length = smooth_length(2 * width).min(self.samples.max(width));
        let mut data = vec![Complex::ZERO; length];
        for (value, bin) in data.iter_mut().zip(&self.bins[first.min(end)..end]) {
            *value = *bin;
        }
        FftPlanner::new().plan_fft_inverse(length).process(&mut data);
        let rate = length as f64 * self.sample_rate / self.samples as f64;
        (data.iter().map(|z| z.norm()).collect(), rate)
    }
}

/// The smallest product of 2, 3 and 5 that is not below `least`: a length with a fast transform.
fn smooth_length(least: usize) -> usize {
    let is_smooth = |n: &usize| {
        let mut rest = *n;
        for prime in [2, 3, 5] {
            while rest.is_multiple_of(prime) {
                rest /= prime;
            }
        }
        rest == 1
    };
    (least.max(1)..).find(is_smooth).unwrap_or(least)
}
