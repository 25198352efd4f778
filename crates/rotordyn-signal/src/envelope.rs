//! Analytic signal (Hilbert transform), envelope and envelope spectrum (demodulation) of a record or band.

use rustfft::FftPlanner;
use rustfft::num_complex::Complex;

use super::SignalError;
use super::error::{check, check_rate, check_record};
use super::filter::{Band, butterworth};
use super::spectrum::{Level, Spectrum, amplitude_spectrum};
use super::window::WindowKind;

/// Analytic signal x + j H{x} (H: Hilbert transform): positive frequencies doubled, negative ones zeroed.
///
/// The record is treated as periodic: a step between its ends causes ringing at both.
/// Errors: empty, NaN.
/// Source: Marple, IEEE Trans. Signal Process. 47 (1999).
pub fn analytic_signal(record: &[f64]) -> Result<Vec<Complex<f64>>, SignalError> {
    check_record("record", record)?;
    Ok(analytic(record, |_| true))
}

/// Analytic signal of one band: the positive frequencies low ≤ f < high doubled, all others set to zero.
///
/// `record` \[unit\], `sample_rate` \[Hz\], `band` \[Hz\] in 0..f_s/2 (an upper end of f_s/2 includes
/// Nyquist). Adjacent bands add up to [`analytic_signal`] exactly. The record is treated as periodic.
/// Errors: empty, NaN, band not in 0..f_s/2 or without a bin.
pub fn band_analytic_signal(
    record: &[f64],
    sample_rate: f64,
    band: (f64, f64),
) -> Result<Vec<Complex<f64>>, SignalError> {
    check_record("record", record)?;
    check_rate(sample_rate)?;
    let (low, high) = band;
    let half = 0.5 * sample_rate;
    check(low >= 0.0 && low < half, "lower end of the band", "0 to below half the sampling rate", low)?;
    check(
        high > low && high <= half * (1.0 + 1e-12),
        "upper end of the band",
        "above the lower, up to half the sampling rate",
        high,
    )?;
    // Bins are multiples of the step up to rounding: a band edge on a bin belongs to the band above.
    let step = sample_rate / record.len() as f64;
    let bin_at = |f: f64| (f / step * (1.0 - 1e-12)).ceil() as usize;
    let end = if high >= half * (1.0 - 1e-12) { record.len() / 2 + 1 } else { bin_at(high) };
    let bins = bin_at(low)..end;
    check(!bins.is_empty(), "band width", "at least one bin of the record", high - low)?;
    Ok(analytic(record, |k| bins.contains(&k)))
}

fn analytic(record: &[f64], keeps: impl Fn(usize) -> bool) -> Vec<Complex<f64>> {
    let n = record.len();
    let mut planner = FftPlanner::new();
    let mut data: Vec<Complex<f64>> = record.iter().map(|&x| Complex::from(x)).collect();
    planner.plan_fft_forward(n).process(&mut data);
    let scale = 1.0 / n as f64;
    for (k, x) in data.iter_mut().enumerate() {
        let sides = if 2 * k > n || !keeps(k) {
            0.0
        } else if k == 0 || 2 * k == n {
            1.0
        } else {
            2.0
        };
        *x *= sides * scale;
    }
    planner.plan_fft_inverse(n).process(&mut data);
    data
}

/// Envelope |x + j H{x}|; errors as [`analytic_signal`].
pub fn envelope(record: &[f64]) -> Result<Vec<f64>, SignalError> {
    Ok(analytic_signal(record)?.iter().map(|z| z.norm()).collect())
}

/// Envelope spectrum: amplitude spectrum of the envelope minus its mean.
///
/// `record` \[unit\], `sample_rate` \[Hz\], `band` \[Hz\] an optional pass band (Butterworth of order 4, zero
/// phase). A tone amplitude-modulated by 1 + m cos ωt gives m times its amplitude at ω.
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
    subtract_mean(&mut envelope);
    amplitude_spectrum(&envelope, sample_rate, window, level)
}

/// Squared envelope spectrum (SES): amplitude spectrum of |z|² of a band minus its mean \[unit²\].
///
/// `band` \[Hz\] with sharp edges as in [`band_analytic_signal`]; `None` is the whole record. A tone of
/// amplitude a modulated by 1 + m cos ωt gives 2 m a² at ω, m² a²/2 at 2ω and no further harmonics (unlike
/// the magnitude for m > 1).
/// Errors as [`band_analytic_signal`]. Source: Randall and Antoni, Mech. Syst. Signal Process. 25 (2011).
pub fn squared_envelope_spectrum(
    record: &[f64],
    sample_rate: f64,
    band: Option<(f64, f64)>,
    window: WindowKind,
    level: Level,
) -> Result<Spectrum, SignalError> {
    let signal = match band {
        Some(band) => band_analytic_signal(record, sample_rate, band)?,
        None => analytic_signal(record)?,
    };
    let mut power: Vec<f64> = signal.iter().map(|z| z.norm_sqr()).collect();
    subtract_mean(&mut power);
    amplitude_spectrum(&power, sample_rate, window, level)
}

fn subtract_mean(record: &mut [f64]) {
    let mean = record.iter().sum::<f64>() / record.len() as f64;
    for value in record {
        *value -= mean;
    }
}
