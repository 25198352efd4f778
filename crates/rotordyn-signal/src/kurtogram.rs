//! Spectral kurtosis and fast kurtogram: frequency bands in which a record is impulsive.

use rustfft::num_complex::Complex;
use serde::{Deserialize, Serialize};

use super::SignalError;
use super::error::{check, check_length, check_record};
use super::filter_bank::{BankLevel, SubBand, filter_bank};
use super::segment::{SegmentTransform, bin_axis, has_mirror};
use super::spectrum::{Spectrum, Welch};

/// Kurtogram: a value for every band of a binary-ternary filter bank, starting with the whole record.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Kurtogram {
    /// Levels by their number of bands, 1, 2, 3, 4, 6, 8 …
    pub levels: Vec<BankLevel>,
    /// Upper end of the frequency axis, half the sampling rate \[Hz\].
    pub max_frequency: f64,
}

/// A band of a [`Kurtogram`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BandChoice {
    pub low: f64,
    pub high: f64,
    pub level: f64,
    pub value: f64,
}

impl Kurtogram {
    /// All bands, level by level.
    pub fn bands(&self) -> impl Iterator<Item = BandChoice> {
        self.levels.iter().flat_map(|level| {
            let width = self.max_frequency / level.values.len() as f64;
            level.values.iter().enumerate().map(move |(i, value)| BandChoice {
                low: i as f64 * width,
                high: (i + 1) as f64 * width,
                level: level.level,
                value: *value,
            })
        })
    }

    /// Band of the highest value; among equal ones the widest.
    pub fn best(&self) -> BandChoice {
        let first = self.bands().next().expect("a kurtogram has the whole record as its first band");
        self.bands().fold(first, |best, band| if band.value > best.value { band } else { best })
    }
}

/// Fast kurtogram: kurtosis ⟨|z|⁴⟩/⟨|z|²⟩² − 2 of the complex envelope z in each band of [`filter_bank`].
///
/// 0 for Gaussian noise, −1 for a tone, large for impulsive bands; the whole record (level 0) is real and has
/// −3 in place of −2. A band without any signal has 0. `record` \[any unit\], `sample_rate` \[Hz\], `depth`
/// halvings (see [`super::filter_bank::max_depth`]); a band must be wider than the repetition rate of the
/// pulses to resolve them.
/// Errors: NaN, record too short for the depth. Source: Antoni, Mech. Syst. Signal Process. 21 (2007).
pub fn fast_kurtogram(record: &[f64], sample_rate: f64, depth: usize) -> Result<Kurtogram, SignalError> {
    let bands = filter_bank(record, sample_rate, depth, |band| envelope_kurtosis(band.signal))?;
    let whole: Vec<Complex<f64>> = record.iter().map(|x| Complex::from(*x)).collect();
    Ok(prepend_full_band(envelope_kurtosis(&whole) - 1.0, bands, sample_rate))
}

/// The filter bank of [`fast_kurtogram`] with another score, such as the level of bearing lines.
///
/// `value` is also evaluated for the whole record's analytic signal, as the band 0..f_s/2. Errors as
/// [`fast_kurtogram`].
pub fn scored_bands(
    record: &[f64],
    sample_rate: f64,
    depth: usize,
    value: impl Fn(SubBand) -> f64 + Sync,
) -> Result<Kurtogram, SignalError> {
    let bands = filter_bank(record, sample_rate, depth, &value)?;
    let whole = super::envelope::analytic_signal(record)?;
    let whole = value(SubBand { low: 0.0, high: 0.5 * sample_rate, signal: &whole, rate: sample_rate });
    Ok(prepend_full_band(whole, bands, sample_rate))
}

fn prepend_full_band(value: f64, bands: Vec<BankLevel>, sample_rate: f64) -> Kurtogram {
    let mut levels = vec![BankLevel { level: 0.0, values: vec![value] }];
    levels.extend(bands);
    Kurtogram { levels, max_frequency: 0.5 * sample_rate }
}

/// ⟨|z|⁴⟩/⟨|z|²⟩² − 2 about the mean; 0 for a zero signal.
fn envelope_kurtosis(signal: &[Complex<f64>]) -> f64 {
    let n = signal.len() as f64;
    let mean = signal.iter().sum::<Complex<f64>>() / n;
    let (mut square, mut fourth) = (0.0, 0.0);
    for z in signal {
        let power = (z - mean).norm_sqr();
        square += power;
        fourth += power * power;
    }
    if square > 0.0 { n * fourth / (square * square) - 2.0 } else { 0.0 }
}

/// Spectral kurtosis by the short-time transform, K(f) = ⟨|X|⁴⟩/⟨|X|²⟩² − 2 over segments; −1 more at 0 and
/// Nyquist.
///
/// 0 for stationary Gaussian noise with standard deviation 2/√segments, −1 for a tone; 0 at a bin without
/// power. Segments should be shorter than the time between pulses and longer than a pulse. Errors: NaN, fewer
/// than two segments. Source: Antoni, Mech. Syst. Signal Process. 20 (2006), eq. 20.
pub fn spectral_kurtosis(record: &[f64], sample_rate: f64, welch: &Welch) -> Result<Spectrum, SignalError> {
    check_record("record", record)?;
    welch.check(record.len(), sample_rate)?;
    let hop = welch.segment - welch.overlap;
    check_length("record", record.len(), welch.segment + hop, "two segments")?;
    let segments = (record.len() - welch.segment) / hop + 1;
    let mut transform = SegmentTransform::new(welch.window, welch.segment, welch.segment);
    let bins = transform.bins();
    let (mut square, mut fourth) = (vec![0.0; bins], vec![0.0; bins]);
    for segment in 0..segments {
        let samples = &record[segment * hop..segment * hop + welch.segment];
        let mean = if welch.remove_mean { samples.iter().sum::<f64>() / samples.len() as f64 } else { 0.0 };
        for (k, x) in transform.transform(samples, mean).iter().enumerate() {
            let power = x.norm_sqr();
            square[k] += power;
            fourth[k] += power * power;
        }
    }
    let kurtosis = |k: usize| {
        let normal = if has_mirror(k, welch.segment) { 2.0 } else { 3.0 };
        if square[k] > 0.0 { segments as f64 * fourth[k] / (square[k] * square[k]) - normal } else { 0.0 }
    };
    Ok(Spectrum {
        frequencies: bin_axis(bins, welch.segment, sample_rate),
        values: (0..bins).map(kurtosis).collect(),
        noise_bandwidth_hz: transform.noise_bandwidth_bins() * sample_rate / welch.segment as f64,
    })
}

/// Greatest kurtogram depth (≥ 1) with bands at least `width` \[Hz\] wide that the record's length allows.
///
/// Errors: a width above f_s/4, a record too short for any depth.
pub fn depth_for_width(samples: usize, sample_rate: f64, width: f64) -> Result<usize, SignalError> {
    super::error::check_rate(sample_rate)?;
    check(
        width > 0.0 && width <= 0.25 * sample_rate,
        "band width",
        "positive, a quarter of the sampling rate at most",
        width,
    )?;
    check_length("record", samples, 256, "a filter bank")?;
    let by_width = (0.5 * sample_rate / width).log2().floor() as usize;
    Ok(by_width.min(super::filter_bank::max_depth(samples)).max(1))
}
