//! Time-domain statistics of a record: RMS, peak, crest factor, skewness, kurtosis.

use super::SignalError;
use super::envelope::band_analytic_signal;
use super::error::check_record;
use serde::{Deserialize, Serialize};

/// Statistics of a record of N samples with mean μ and central moments m_k = Σ(x−μ)ᵏ / N.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Statistics {
    pub mean: f64,
    /// √m₂, with divisor N.
    pub standard_deviation: f64,
    /// √(Σx²/N), the mean included.
    pub rms: f64,
    /// max |x|, the mean included.
    pub peak: f64,
    /// max x − min x.
    pub peak_to_peak: f64,
    /// Peak over RMS; √2 for a sine, `None` for a record of zeros.
    pub crest_factor: Option<f64>,
    /// Σ|x|/N.
    pub mean_absolute: f64,
    /// RMS over mean absolute; π/√8 for a sine, `None` for a record of zeros.
    pub shape_factor: Option<f64>,
    /// Peak over mean absolute; π/2 for a sine, `None` for a record of zeros.
    pub impulse_factor: Option<f64>,
    /// Peak over (Σ√|x|/N)²; `None` for a record of zeros.
    pub clearance_factor: Option<f64>,
    /// m₃ / m₂^{3/2}; `None` for a constant record.
    pub skewness: Option<f64>,
    /// m₄ / m₂², Pearson's, without −3: 3 for a normal distribution, 1.5 for a sine; `None` for a constant
    /// record.
    pub kurtosis: Option<f64>,
}

/// RMS of a record in a band, the mean excluded: the band is cut out of its Fourier transform.
///
/// `record` \[unit\], `sample_rate` \[Hz\], `band` \[Hz\] in 0..f_s/2. Bands side by side add up in power to the
/// variance. Errors: as [`band_analytic_signal`].
pub fn band_rms(record: &[f64], sample_rate: f64, band: (f64, f64)) -> Result<f64, SignalError> {
    let mean = record.iter().sum::<f64>() / record.len().max(1) as f64;
    let deviation: Vec<f64> = record.iter().map(|v| v - mean).collect();
    let signal = band_analytic_signal(&deviation, sample_rate, band)?;
    let power = signal.iter().map(|z| z.re * z.re).sum::<f64>() / signal.len() as f64;
    Ok(power.sqrt())
}

/// Computes the statistics of a record; errors: empty, NaN.
pub fn statistics(record: &[f64]) -> Result<Statistics, SignalError> {
    check_record("record", record)?;
    let n = record.len() as f64;
    let mean = record.iter().sum::<f64>() / n;
    let (mut m2, mut m3, mut m4, mut square) = (0.0, 0.0, 0.0, 0.0);
    let (mut absolute, mut root) = (0.0, 0.0);
    let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
    for &x in record {
        let d = x - mean;
        m2 += d * d;
        m3 += d * d * d;
        m4 += d * d * d * d;
        square += x * x;
        absolute += x.abs();
        root += x.abs().sqrt();
        low = low.min(x);
        high = high.max(x);
    }
    (m2, m3, m4) = (m2 / n, m3 / n, m4 / n);
    (absolute, root) = (absolute / n, root / n);
    let rms = (square / n).sqrt();
    let peak = high.max(-low);
    // The spread of a constant record is rounding error of its mean: no skewness or kurtosis.
    let varies = m2.sqrt() > 4.0 * f64::EPSILON * peak;
    Ok(Statistics {
        mean,
        standard_deviation: m2.sqrt(),
        rms,
        peak,
        peak_to_peak: high - low,
        crest_factor: (rms > 0.0).then(|| peak / rms),
        mean_absolute: absolute,
        shape_factor: (absolute > 0.0).then(|| rms / absolute),
        impulse_factor: (absolute > 0.0).then(|| peak / absolute),
        clearance_factor: (absolute > 0.0).then(|| peak / (root * root)),
        skewness: varies.then(|| m3 / (m2 * m2.sqrt())),
        kurtosis: varies.then(|| m4 / (m2 * m2)),
    })
}

/// Median of values: the middle one in order of size, the mean of both middle ones of an even count; 0 of an empty list.
pub fn median(mut values: Vec<f64>) -> f64 {
    let (count, middle) = (values.len(), values.len() / 2);
    if count == 0 {
        return 0.0;
    }
    let (below, upper, _) = values.select_nth_unstable_by(middle, f64::total_cmp);
    let lower = if count.is_multiple_of(2) {
        below.iter().copied().fold(f64::NEG_INFINITY, f64::max)
    } else {
        *upper
    };
    0.5 * (lower + *upper)
}
