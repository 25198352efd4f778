//! Analytic signal, envelope and envelope spectrum.

use rustfft::FftPlanner;
use rustfft::num_complex::Complex;

use super::SignalError;
use super::error::check_record;
use super::filter::{Band, butterworth};
use super::spectrum::{Level, Spectrum, amplitude_spectrum};
use super::window::WindowKind;

/// Analytic signal x + j H{x}, by doubling the positive frequencies and dropping the negative ones.
///
/// The record is taken as one period, so that a step between its ends rings into both. Errors: empty, NaN.
/// Source: Marple, IEEE Trans. Signal Process. 47 (1999).
pub fn analytic_signal(record: &[f64]) -> Result<Vec<Complex<f64>>, SignalError> {
    check_record("record", record)?;
    let n = record.len();
    let mut planner = FftPlanner::new();
    let mut data: Vec<Complex<f64>> = record.iter().map(|&x| Complex::from(x)).collect();
    planner.plan_fft_forward(n).process(&mut data);
    let scale = 1.0 / n as f64;
    for (k, x) in data.iter_mut().enumerate() {
        let sides = if k == 0 || 2 * k == n {
            1.0
        } else if 2 * k < n {
            2.0
        } else {
            0.0
        };
        *x *= sides * scale;
    }
    planner.plan_fft_inverse(n).process(&mut data);
    Ok(data)
}

/// Envelope |x + j H{x}|; errors as [`analytic_signal`].
pub fn envelope(record: &[f64]) -> Result<Vec<f64>, SignalError> {
    Ok(analytic_signal(record)?.iter().map(|z| z.norm()).collect())
}

/// Amplitude spectrum of the envelope, its mean taken away.
///
/// `record` \[unit\], `sample_rate` \[Hz\], `band` \[Hz\] an optional pass band (Butterworth of order 4, zero phase).
/// A tone modulated by 1 + m cos ωt shows m times its amplitude at ω.
/// Errors: NaN, record too short for the filter, band not inside 0..f_s/2.
pub fn envelope_spectrum(
    record: &[f64],
    sample_rate: f64,
    band: Option<(f64, f64)>,
    window: WindowKind,
    level: Level,
) -> Result<Spectrum, SignalError> {
    let mut envelope = match band {
        Some((low, high)) => {
            let filter = butterworth(4, Band::BandPass(low, high), sample_rate)?;
            envelope(&filter.filter_zero_phase(record)?)?
        }
        None => envelope(record)?,
    };
    let mean = envelope.iter().sum::<f64>() / envelope.len() as f64;
    for e in &mut envelope {
        *e -= mean;
    }
    amplitude_spectrum(&envelope, sample_rate, window, level)
}
