//! Time-synchronous average (TSA): periodic part of a record, and the residual.

use super::SignalError;
use super::error::{check, check_length, check_record};
use serde::{Deserialize, Serialize};

/// Average over whole periods of a record that is uniform in angle.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SynchronousAverage {
    /// Mean at each sample of the period.
    pub mean: Vec<f64>,
    /// Standard deviation there over the periods, divisor M.
    pub deviation: Vec<f64>,
    /// Number M of whole periods averaged.
    pub periods: usize,
}

/// Averages the whole periods of a record, y_k = (1/M) Σ_r x_{k + rS}.
///
/// `record` (N) uniform in shaft angle (see [`super::resample::AngleResampler`]) or in time at constant
/// speed, starting at phase zero; `samples_per_period` S. Non-periodic parts are reduced by 1/√M. Errors:
/// NaN, fewer than two periods.
/// Source: Braun, Acustica 32 (1975).
pub fn synchronous_average(
    record: &[f64],
    samples_per_period: usize,
) -> Result<SynchronousAverage, SignalError> {
    check_record("record", record)?;
    check(samples_per_period >= 1, "samples per period", "one or more", samples_per_period as f64)?;
    check_length("record", record.len(), 2 * samples_per_period, "an average of two periods")?;
    let periods = record.len() / samples_per_period;
    let mut mean = vec![0.0; samples_per_period];
    for period in record.chunks_exact(samples_per_period) {
        mean.iter_mut().zip(period).for_each(|(sum, x)| *sum += x);
    }
    mean.iter_mut().for_each(|sum| *sum /= periods as f64);
    let mut deviation = vec![0.0; samples_per_period];
    for period in record.chunks_exact(samples_per_period) {
        for ((sum, x), m) in deviation.iter_mut().zip(period).zip(&mean) {
            *sum += (x - m) * (x - m);
        }
    }
    deviation.iter_mut().for_each(|sum| *sum = (*sum / periods as f64).sqrt());
    Ok(SynchronousAverage { mean, deviation, periods })
}

impl SynchronousAverage {
    /// Residual signal: the record minus its periodic part (shaft and gear lines removed); errors: NaN.
    pub fn residual(&self, record: &[f64]) -> Result<Vec<f64>, SignalError> {
        check_record("record", record)?;
        Ok(record.iter().zip(self.mean.iter().cycle()).map(|(x, m)| x - m).collect())
    }
}
