//! Real and power cepstrum, and liftering: a family of equally spaced lines (harmonics) is one peak.

use rustfft::FftPlanner;
use rustfft::num_complex::Complex;
use serde::{Deserialize, Serialize};

use super::SignalError;
use super::error::{check, check_rate, check_record};
use super::segment::bin_axis;
use super::spectrum::Spectrum;

/// A cepstrum: values over quefrency \[s\], 0 to half the record.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Cepstrum {
    pub quefrencies: Vec<f64>,
    pub values: Vec<f64>,
}

/// Lifter: the part of the cepstrum that is kept.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Lifter {
    /// Quefrencies up to this \[s\]: the smooth spectrum, resonances.
    LowTime(f64),
    /// Quefrencies beyond this \[s\]: harmonics and side bands.
    HighTime(f64),
    /// All but a half-width around every multiple of a quefrency \[s\]: removes the harmonics of its inverse.
    Comb { quefrency: f64, half_width: f64 },
}

impl Lifter {
    fn keeps(self, quefrency: f64) -> bool {
        match self {
            Lifter::LowTime(limit) => quefrency <= limit,
            Lifter::HighTime(limit) => quefrency > limit,
            Lifter::Comb { quefrency: tooth, half_width } => {
                let nearest = (quefrency / tooth).round();
                nearest < 1.0 || (quefrency - nearest * tooth).abs() > half_width
            }
        }
    }

    fn check(self) -> Result<(), SignalError> {
        let (name, value) = match self {
            Lifter::LowTime(limit) | Lifter::HighTime(limit) => ("quefrency limit", limit),
            Lifter::Comb { quefrency, half_width } => {
                check(
                    half_width >= 0.0 && half_width.is_finite(),
                    "half width of the comb",
                    "0 s or more",
                    half_width,
                )?;
                ("quefrency of the comb", quefrency)
            }
        };
        check(value > 0.0 && value.is_finite(), name, "a positive number of seconds", value)
    }
}

/// Real cepstrum c = F⁻¹{ln |F{x}|}.
///
/// `record` x (N), `sample_rate` \[Hz\]. A family of lines Δf apart gives peaks at multiples of 1/Δf, an echo
/// after τ of strength a gives a/2 at τ. Bins without power are set to the rounding error of the largest bin.
/// Errors: NaN, a record of zeros. Source: Randall, Mech. Syst. Signal Process. 97 (2017).
pub fn real_cepstrum(record: &[f64], sample_rate: f64) -> Result<Cepstrum, SignalError> {
    let (_, cepstrum) = spectrum_and_cepstrum(record, sample_rate)?;
    Ok(positive_quefrencies(&cepstrum, sample_rate))
}

/// Power cepstrum |F⁻¹{ln |F{x}|²}|², that is 4 c²; arguments and errors as [`real_cepstrum`].
///
/// Source: Bogert, Healy and Tukey, Proc. Symp. Time Series Analysis (1963).
pub fn power_cepstrum(record: &[f64], sample_rate: f64) -> Result<Cepstrum, SignalError> {
    let mut cepstrum = real_cepstrum(record, sample_rate)?;
    cepstrum.values.iter_mut().for_each(|c| *c = 4.0 * *c * *c);
    Ok(cepstrum)
}

/// Cepstral editing: the record with its liftered log magnitude and its original phase.
///
/// A comb at the shaft period removes the shaft harmonics and leaves the random part of a bearing signal. The
/// mean level (quefrency 0) is kept by every lifter. Errors as [`real_cepstrum`], quefrency not positive.
/// Source: Randall and Sawalhi, Sound and Vibration 45 (2011).
pub fn lifter(record: &[f64], sample_rate: f64, lifter: Lifter) -> Result<Vec<f64>, SignalError> {
    let (spectrum, log_magnitude) = liftered_log(record, sample_rate, lifter)?;
    let edited = spectrum.iter().zip(&log_magnitude).map(|(x, level)| {
        let size = x.norm();
        if size > 0.0 { x / size * level.exp() } else { Complex::ZERO }
    });
    let mut data: Vec<Complex<f64>> = edited.collect();
    FftPlanner::new().plan_fft_inverse(data.len()).process(&mut data);
    Ok(data.iter().map(|z| z.re / data.len() as f64).collect())
}

/// The liftered magnitude spectrum e^{F{lifter · c}}, not scaled by the length; smooth for a low-time lifter.
///
/// Errors as [`lifter`].
pub fn liftered_spectrum(record: &[f64], sample_rate: f64, lifter: Lifter) -> Result<Spectrum, SignalError> {
    let (_, log_magnitude) = liftered_log(record, sample_rate, lifter)?;
    let n = log_magnitude.len();
    Ok(Spectrum {
        frequencies: bin_axis(n / 2 + 1, n, sample_rate),
        values: log_magnitude[..n / 2 + 1].iter().map(|level| level.exp()).collect(),
        noise_bandwidth_hz: sample_rate / n as f64,
    })
}

/// The record's transform and its liftered log magnitude at each bin.
fn liftered_log(
    record: &[f64],
    sample_rate: f64,
    lifter: Lifter,
) -> Result<(Vec<Complex<f64>>, Vec<f64>), SignalError> {
    lifter.check()?;
    let (spectrum, cepstrum) = spectrum_and_cepstrum(record, sample_rate)?;
    let n = cepstrum.len();
    let kept = |k: usize| k == 0 || lifter.keeps(k.min(n - k) as f64 / sample_rate);
    let mut data: Vec<Complex<f64>> = cepstrum
        .iter()
        .enumerate()
        .map(|(k, c)| if kept(k) { Complex::from(*c) } else { Complex::ZERO })
        .collect();
    FftPlanner::new().plan_fft_forward(n).process(&mut data);
    Ok((spectrum, data.iter().map(|z| z.re).collect()))
}

/// F{x} and the two-sided real cepstrum.
fn spectrum_and_cepstrum(
    record: &[f64],
    sample_rate: f64,
) -> Result<(Vec<Complex<f64>>, Vec<f64>), SignalError> {
    check_record("record", record)?;
    check_rate(sample_rate)?;
    let n = record.len();
    let mut planner = FftPlanner::new();
    let mut spectrum: Vec<Complex<f64>> = record.iter().map(|&x| Complex::from(x)).collect();
    planner.plan_fft_forward(n).process(&mut spectrum);
    let largest = spectrum.iter().map(|z| z.norm()).fold(0.0, f64::max);
    check(largest > 0.0, "largest spectral line", "more than zero, for its logarithm", largest)?;
    let floor = f64::EPSILON * largest;
    let mut data: Vec<Complex<f64>> =
        spectrum.iter().map(|z| Complex::from(z.norm().max(floor).ln())).collect();
    planner.plan_fft_inverse(n).process(&mut data);
    Ok((spectrum, data.iter().map(|z| z.re / n as f64).collect()))
}

fn positive_quefrencies(cepstrum: &[f64], sample_rate: f64) -> Cepstrum {
    let half = cepstrum.len() / 2 + 1;
    Cepstrum {
        quefrencies: (0..half).map(|k| k as f64 / sample_rate).collect(),
        values: cepstrum[..half].to_vec(),
    }
}
