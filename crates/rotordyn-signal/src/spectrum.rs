//! Amplitude spectra, and power and cross spectral densities by Welch's method.

use rustfft::num_complex::Complex;
use serde::{Deserialize, Serialize};

use super::SignalError;
use super::error::{check, check_length, check_rate, check_record, check_same_length};
use super::segment::{SegmentTransform, bin_axis, has_mirror};
use super::window::WindowKind;

pub use super::segment::Level;

/// A one-sided spectrum: values over frequencies \[Hz\].
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Spectrum {
    pub frequencies: Vec<f64>,
    pub values: Vec<f64>,
    /// Equivalent noise bandwidth (ENBW) \[Hz\]: squared RMS amplitude over it is a spectral density.
    pub noise_bandwidth_hz: f64,
}

impl Spectrum {
    /// The part up to a frequency.
    pub fn up_to(&self, frequency: f64) -> Spectrum {
        let count = self.frequencies.partition_point(|f| *f <= frequency).max(2).min(self.frequencies.len());
        Spectrum {
            frequencies: self.frequencies[..count].to_vec(),
            values: self.values[..count].to_vec(),
            noise_bandwidth_hz: self.noise_bandwidth_hz,
        }
    }
}

/// A one-sided complex spectrum over frequencies \[Hz\].
#[derive(Clone, Debug, PartialEq)]
pub struct ComplexSpectrum {
    pub frequencies: Vec<f64>,
    pub values: Vec<Complex<f64>>,
}

/// Segments of Welch's method.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Welch {
    pub window: WindowKind,
    /// Samples of a segment.
    pub segment: usize,
    /// Overlap of neighbouring segments in samples, less than a segment.
    pub overlap: usize,
    /// Whether to subtract each segment's mean.
    pub remove_mean: bool,
}

impl Welch {
    /// Hann segments with half overlap, means removed.
    pub fn hann(segment: usize) -> Self {
        Welch { window: WindowKind::Hann, segment, overlap: segment / 2, remove_mean: true }
    }

    pub(crate) fn check(&self, length: usize, sample_rate: f64) -> Result<(), SignalError> {
        check_rate(sample_rate)?;
        check(self.segment >= 2, "segment", "two samples or more", self.segment as f64)?;
        check(self.overlap < self.segment, "overlap", "fewer samples than a segment", self.overlap as f64)?;
        check_length("record", length, self.segment, "one segment")
    }
}

/// One-sided amplitude spectrum of a whole record, A_k = s |Σ w_n x_n e^{−2πjkn/N}| / Σw.
///
/// `record` x (N) \[any unit\], `sample_rate` \[Hz\]; a tone at a bin gives its peak (s = 2) or RMS (s = √2);
/// zero frequency and Nyquist have s = 1. Errors: empty record, NaN, rate not positive.
pub fn amplitude_spectrum(
    record: &[f64],
    sample_rate: f64,
    window: WindowKind,
    level: Level,
) -> Result<Spectrum, SignalError> {
    check_record("record", record)?;
    check_rate(sample_rate)?;
    let mut transform = SegmentTransform::new(window, record.len(), record.len());
    let mut values = vec![0.0; transform.bins()];
    transform.amplitudes(record, level, &mut values);
    Ok(Spectrum {
        frequencies: bin_axis(values.len(), record.len(), sample_rate),
        values,
        noise_bandwidth_hz: transform.noise_bandwidth_bins() * sample_rate / record.len() as f64,
    })
}

/// One-sided power spectral density by Welch, S_k = s mean |X_k|² / (f_s Σw²), s = 2 (1 at 0 and Nyquist).
///
/// `record` \[unit\], `sample_rate` \[Hz\]; returns unit²/Hz. The sum of S_k Δf is the mean square when the
/// window is rectangular. Errors: NaN, record shorter than a segment, overlap not below the segment.
/// Source: Welch, IEEE Trans. Audio Electroacoust. 15 (1967).
pub fn power_spectral_density(
    record: &[f64],
    sample_rate: f64,
    welch: &Welch,
) -> Result<Spectrum, SignalError> {
    let densities = densities(record, record, sample_rate, welch)?;
    Ok(Spectrum {
        values: densities.xx,
        noise_bandwidth_hz: densities.noise_bandwidth_hz,
        frequencies: densities.frequencies,
    })
}

/// One-sided cross spectral density, S_xy = s mean conj(X_k) Y_k / (f_s Σw²): the phase of y relative to x.
///
/// Scaling and errors as [`power_spectral_density`]; also records of unequal length.
pub fn cross_spectral_density(
    x: &[f64],
    y: &[f64],
    sample_rate: f64,
    welch: &Welch,
) -> Result<ComplexSpectrum, SignalError> {
    let densities = densities(x, y, sample_rate, welch)?;
    Ok(ComplexSpectrum { frequencies: densities.frequencies, values: densities.xy })
}

/// Magnitude-squared coherence, γ² = |S_xy|² / (S_xx S_yy), 0..1; it is 1 by definition with one segment.
///
/// 0 at a bin where either record has no power. Errors as [`cross_spectral_density`].
pub fn coherence(x: &[f64], y: &[f64], sample_rate: f64, welch: &Welch) -> Result<Spectrum, SignalError> {
    let d = densities(x, y, sample_rate, welch)?;
    let values = (0..d.xx.len()).map(|k| d.coherence(k)).collect();
    Ok(Spectrum { frequencies: d.frequencies, values, noise_bandwidth_hz: d.noise_bandwidth_hz })
}

/// Level 20 log₁₀(amplitude / reference) \[dB\]; zero amplitude gives −∞.
pub fn decibel(amplitude: f64, reference: f64) -> f64 {
    20.0 * (amplitude / reference).log10()
}

/// Auto and cross densities of two records from the same segments.
pub(crate) struct Densities {
    pub frequencies: Vec<f64>,
    pub xx: Vec<f64>,
    pub yy: Vec<f64>,
    pub xy: Vec<Complex<f64>>,
    pub noise_bandwidth_hz: f64,
}

impl Densities {
    pub fn coherence(&self, k: usize) -> f64 {
        let power = self.xx[k] * self.yy[k];
        if power > 0.0 { (self.xy[k].norm_sqr() / power).min(1.0) } else { 0.0 }
    }
}

pub(crate) fn densities(
    x: &[f64],
    y: &[f64],
    sample_rate: f64,
    welch: &Welch,
) -> Result<Densities, SignalError> {
    check_record("record", x)?;
    check_record("second record", y)?;
    check_same_length("second record", y.len(), "the first", x.len())?;
    welch.check(x.len(), sample_rate)?;
    let length = welch.segment;
    let hop = length - welch.overlap;
    let segments = (x.len() - length) / hop + 1;
    let mut transform = SegmentTransform::new(welch.window, length, length);
    let mut first = vec![Complex::ZERO; transform.bins()];
    let (mut xx, mut yy) = (vec![0.0; first.len()], vec![0.0; first.len()]);
    let mut xy = vec![Complex::ZERO; first.len()];
    let offset = |s: &[f64]| if welch.remove_mean { s.iter().sum::<f64>() / s.len() as f64 } else { 0.0 };
    let same = std::ptr::eq(x, y);
    for segment in 0..segments {
        let range = segment * hop..segment * hop + length;
        let (sx, sy) = (&x[range.clone()], &y[range]);
        first.copy_from_slice(transform.transform(sx, offset(sx)));
        for (sum, a) in xx.iter_mut().zip(&first) {
            *sum += a.norm_sqr();
        }
        if same {
            continue;
        }
        let second = transform.transform(sy, offset(sy));
        for (k, (a, b)) in first.iter().zip(second).enumerate() {
            yy[k] += b.norm_sqr();
            xy[k] += a.conj() * b;
        }
    }
    if same {
        yy.copy_from_slice(&xx);
        for (cross, power) in xy.iter_mut().zip(&xx) {
            *cross = Complex::from(*power);
        }
    }
    let power: f64 = transform.window().iter().map(|w| w * w).sum();
    for k in 0..xx.len() {
        let sides = if has_mirror(k, length) { 2.0 } else { 1.0 };
        let scale = sides / (sample_rate * power * segments as f64);
        xx[k] *= scale;
        yy[k] *= scale;
        xy[k] *= scale;
    }
    Ok(Densities {
        frequencies: bin_axis(xx.len(), length, sample_rate),
        xx,
        yy,
        xy,
        noise_bandwidth_hz: transform.noise_bandwidth_bins() * sample_rate / length as f64,
    })
}
