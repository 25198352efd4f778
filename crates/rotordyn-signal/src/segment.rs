//! The windowed real Fourier transform of one segment, with plan and buffers reused.

use serde::{Deserialize, Serialize};
use std::sync::Arc;

use realfft::{RealFftPlanner, RealToComplex};
use rustfft::num_complex::Complex;

use super::window::{WindowKind, noise_bandwidth};

/// Amplitude convention: a tone a cos ωt has peak a and RMS a/√2.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Level {
    Peak,
    Rms,
}

/// Windowed FFT of segments of one length; nothing is allocated after construction.
pub struct SegmentTransform {
    window: Vec<f64>,
    fft: Arc<dyn RealToComplex<f64>>,
    input: Vec<f64>,
    output: Vec<Complex<f64>>,
    scratch: Vec<Complex<f64>>,
}

impl SegmentTransform {
    /// A transform of segments of `length` ≥ 1 samples, padded with zeros to `fft_length` ≥ `length`.
    pub fn new(window: WindowKind, length: usize, fft_length: usize) -> Self {
        let fft = RealFftPlanner::new().plan_fft_forward(fft_length);
        SegmentTransform {
            window: window.samples(length),
            input: fft.make_input_vec(),
            output: fft.make_output_vec(),
            scratch: fft.make_scratch_vec(),
            fft,
        }
    }

    /// Samples of a segment.
    pub fn length(&self) -> usize {
        self.window.len()
    }

    /// Number of one-sided bins, ⌊N_fft/2⌋ + 1.
    pub fn bins(&self) -> usize {
        self.output.len()
    }

    /// Length of the transform, padding included.
    pub fn fft_length(&self) -> usize {
        self.input.len()
    }

    /// The window's samples.
    pub fn window(&self) -> &[f64] {
        &self.window
    }

    /// Equivalent noise bandwidth in bins of the padded transform.
    pub fn noise_bandwidth_bins(&self) -> f64 {
        noise_bandwidth(&self.window) * self.fft_length() as f64 / self.length() as f64
    }

    /// X_k = Σ_n w_n (x_n − offset) e^{−2πjkn/N_fft}; `segment` has [`Self::length`] samples.
    pub fn transform(&mut self, segment: &[f64], offset: f64) -> &[Complex<f64>] {
        let length = self.window.len();
        for ((value, x), w) in self.input[..length].iter_mut().zip(segment).zip(&self.window) {
            *value = w * (x - offset);
        }
        self.input[length..].fill(0.0);
        self.fft
            .process_with_scratch(&mut self.input, &mut self.output, &mut self.scratch)
            .expect("the buffers were allocated by this plan");
        &self.output
    }

    /// Writes the one-sided amplitudes of a segment, A_k = s |X_k| / Σw, of as many bins as `out` has.
    ///
    /// s = 2 (peak) or √2 (RMS); s = 1 for either at zero frequency and at Nyquist of an even length, which
    /// have no negative-frequency counterpart.
    pub fn amplitudes(&mut self, segment: &[f64], level: Level, out: &mut [f64]) {
        let sum: f64 = self.window.iter().sum();
        let both = match level {
            Level::Peak => 2.0 / sum,
            Level::Rms => 2.0_f64.sqrt() / sum,
        };
        let length = self.fft_length();
        for (k, (a, x)) in out.iter_mut().zip(self.transform(segment, 0.0)).enumerate() {
            let scale = if has_mirror(k, length) { both } else { 1.0 / sum };
            // Three times as fast as hypot, whose range nothing measured needs.
            *a = scale * x.norm_sqr().sqrt();
        }
    }
}

/// Whether bin k of a one-sided transform of `length` points also represents a negative frequency.
pub(crate) fn has_mirror(k: usize, length: usize) -> bool {
    k != 0 && 2 * k != length
}

/// Bin frequencies k f_s / N.
pub(crate) fn bin_axis(bins: usize, length: usize, rate: f64) -> Vec<f64> {
    (0..bins).map(|k| k as f64 * rate / length as f64).collect()
}
