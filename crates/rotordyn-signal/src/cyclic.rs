//! Cyclic spectral coherence (cyclostationary analysis): carrier and modulation frequencies.

use serde::{Deserialize, Serialize};
use std::f64::consts::PI;

use rayon::prelude::*;
use rustfft::FftPlanner;
use rustfft::num_complex::Complex;

use super::SignalError;
use super::error::{check, check_length, check_record};
use super::segment::bin_axis;
use super::spectrum::{Spectrum, Welch};
use rotordyn_linalg::dot;

/// Squared magnitude of the cyclic spectral coherence over cyclic frequency α and frequency f.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct CyclicCoherence {
    /// Cyclic frequencies α \[Hz\]: modulation frequencies.
    pub cyclic_frequencies: Vec<f64>,
    /// Carrier frequencies f \[Hz\].
    pub frequencies: Vec<f64>,
    /// |γ(α, f)|² in 0..1, row-major: a row for each α.
    pub squared: Vec<f64>,
    /// Significance threshold: value exceeded by stationary noise with probability 1 % at one (α, f).
    pub one_percent_threshold: f64,
}

/// Cyclic spectral coherence by the averaged cyclic periodogram.
///
/// S(α, f) = Σ_i Y_i(f) conj X_i(f), with Y, X the segments' transforms of x e^{−jπαt} and x e^{+jπαt}: the
/// correlation of the spectrum at f + α/2 with that at f − α/2; |γ|² = |S|²/(Σ|Y|² Σ|X|²). `record` (N),
/// `sample_rate` \[Hz\], `cyclic_frequencies` α \[Hz\] in 0..f_s; `welch` with segments whose overlap is two
/// thirds or more, so that the window does not cause spurious lines at multiples of the segment rate. The
/// resolution in α is f_s/N: space α no wider.
/// Errors: NaN, record shorter than two segments, α out of range.
/// Source: Antoni, Mech. Syst. Signal Process. 21 (2007), eq. 11-13.
pub fn cyclic_coherence(
    record: &[f64],
    sample_rate: f64,
    cyclic_frequencies: &[f64],
    welch: &Welch,
) -> Result<CyclicCoherence, SignalError> {
    check_record("record", record)?;
    check_record("cyclic frequencies", cyclic_frequencies)?;
    welch.check(record.len(), sample_rate)?;
    for &alpha in cyclic_frequencies {
        check(
            (0.0..sample_rate).contains(&alpha),
            "cyclic frequency",
            "0 to below the sampling rate",
            alpha,
        )?;
    }
    let length = welch.segment;
    let hop = length - welch.overlap;
    check_length("record", record.len(), length + hop, "two segments")?;
    let segments = (record.len() - length) / hop + 1;
    let window = welch.window.samples(length);
    let mean = if welch.remove_mean { record.iter().sum::<f64>() / record.len() as f64 } else { 0.0 };
    let fft = FftPlanner::new().plan_fft_forward(length);
    let bins = length / 2 + 1;
    let row = |&alpha: &f64| -> Vec<f64> {
        let (mut upper, mut lower) = (vec![Complex::ZERO; length], vec![Complex::ZERO; length]);
        let mut scratch = vec![Complex::ZERO; fft.get_inplace_scratch_len()];
        let (mut xx, mut yy) = (vec![0.0; bins], vec![0.0; bins]);
        let mut cross = vec![Complex::<f64>::ZERO; bins];
        let shift: Vec<Complex<f64>> = (0..length)
            .map(|n| Complex::from_polar(window[n], -PI * alpha * n as f64 / sample_rate))
            .collect();
        for segment in 0..segments {
            let start = segment * hop;
            for (n, w) in shift.iter().enumerate() {
                let x = record[start + n] - mean;
                upper[n] = x * w;
                lower[n] = x * w.conj();
            }
            fft.process_with_scratch(&mut upper, &mut scratch);
            fft.process_with_scratch(&mut lower, &mut scratch);
            // Phase of the segment's start t₀: e^{−jπα t₀} on one side, its conjugate on the other.
            let turn = Complex::from_polar(1.0, -2.0 * PI * ((alpha * start as f64 / sample_rate) % 1.0));
            for k in 0..bins {
                xx[k] += lower[k].norm_sqr();
                yy[k] += upper[k].norm_sqr();
                cross[k] += upper[k] * lower[k].conj() * turn;
            }
        }
        let ratio = |k: usize| {
            let power = xx[k] * yy[k];
            if power > 0.0 { (cross[k].norm_sqr() / power).min(1.0) } else { 0.0 }
        };
        (0..bins).map(ratio).collect()
    };
    let rows: Vec<Vec<f64>> = cyclic_frequencies.par_iter().map(row).collect();
    Ok(CyclicCoherence {
        cyclic_frequencies: cyclic_frequencies.to_vec(),
        frequencies: bin_axis(bins, length, sample_rate),
        squared: rows.concat(),
        one_percent_threshold: 1.0
            - 0.01f64.powf(1.0 / (equivalent_segments(&window, hop, segments) - 1.0).max(1.0)),
    })
}

/// Equivalent number of independent segments (without overlap): K / (1 + 2 Σ_q (1 − q/K) r_q²).
///
/// r_q is the window's autocorrelation at q hops over Σw². Source: Welch (1967).
fn equivalent_segments(window: &[f64], hop: usize, segments: usize) -> f64 {
    let power: f64 = window.iter().map(|w| w * w).sum();
    let count = segments as f64;
    let mut spread = 1.0;
    for q in 1..segments.min(window.len().div_ceil(hop)) {
        let overlap = dot(window, &window[q * hop..]);
        spread += 2.0 * (1.0 - q as f64 / count) * (overlap / power).powi(2);
    }
    count / spread
}

impl CyclicCoherence {
    /// |γ|² over the carrier frequencies at one α.
    pub fn row(&self, index: usize) -> &[f64] {
        let bins = self.frequencies.len();
        &self.squared[index * bins..(index + 1) * bins]
    }

    /// Enhanced envelope spectrum: the mean of |γ| over the carriers in a band \[Hz\], against α.
    ///
    /// Errors: a band without a carrier. Source: Abboud, Antoni et al., Mech. Syst. Signal Process. 111
    /// (2018).
    pub fn enhanced_envelope_spectrum(&self, band: (f64, f64)) -> Result<Spectrum, SignalError> {
        let first = self.frequencies.partition_point(|f| *f < band.0);
        let end = self.frequencies.partition_point(|f| *f <= band.1);
        check(first < end, "lower end of the band", "a band that contains a carrier frequency", band.0)?;
        let mean = |row: &[f64]| row[first..end].iter().map(|g| g.sqrt()).sum::<f64>() / (end - first) as f64;
        Ok(Spectrum {
            frequencies: self.cyclic_frequencies.clone(),
            values: self.squared.chunks_exact(self.frequencies.len()).map(mean).collect(),
            noise_bandwidth_hz: self.frequencies[1],
        })
    }
}
