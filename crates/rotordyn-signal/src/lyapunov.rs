//! The largest Lyapunov exponent from the growth of a perturbation.

use super::SignalError;
use super::error::{check_length, check_record, check_same_length};
use serde::{Deserialize, Serialize};

/// Maximum number of batches for the standard error.
const MAX_BATCHES: usize = 20;

/// Largest Lyapunov exponent with its standard error and convergence history.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct LyapunovExponent {
    /// λ \[1/s\].
    pub value: f64,
    /// Standard error of λ by batch means \[1/s\].
    pub standard_error: f64,
    /// End of every interval since the start \[s\].
    pub times: Vec<f64>,
    /// Running estimate of λ at those times \[1/s\].
    pub history: Vec<f64>,
}

/// Largest Lyapunov exponent λ = Σ ln(growth) / Σ Δt from the growth of a perturbation that is rescaled to a
/// small size after each interval (Benettin's method).
///
/// `log_growth` (N): ln of the perturbation's growth over each interval; `intervals` (N) \[s\]. The standard
/// error is that of the mean over up to 20 batches of successive intervals (batch means), which allows for
/// correlation over less than a batch; with fewer than four intervals it is NaN.
/// Source: Benettin, Galgani, Giorgilli and Strelcyn, Meccanica 15 (1980).
/// Errors: NaN (a perturbation that vanished), unequal lengths, no interval.
pub fn lyapunov_exponent(log_growth: &[f64], intervals: &[f64]) -> Result<LyapunovExponent, SignalError> {
    check_record("growth", log_growth)?;
    check_record("intervals", intervals)?;
    check_same_length("intervals", intervals.len(), "growth", log_growth.len())?;
    check_length("growth", log_growth.len(), 1, "an exponent")?;
    let (mut sum, mut time) = (0.0, 0.0);
    let (mut times, mut history) = (Vec::new(), Vec::new());
    for (growth, interval) in log_growth.iter().zip(intervals) {
        sum += growth;
        time += interval;
        times.push(time);
        history.push(sum / time);
    }
    let value = sum / time;
    let n = log_growth.len();
    let batches = MAX_BATCHES.min(n / 2);
    let rate = |b: usize| {
        let range = b * n / batches..(b + 1) * n / batches;
        log_growth[range.clone()].iter().sum::<f64>() / intervals[range].iter().sum::<f64>()
    };
    let standard_error = if batches < 2 {
        f64::NAN
    } else {
        let spread: f64 = (0..batches).map(|b| (rate(b) - value).powi(2)).sum();
        (spread / (batches * (batches - 1)) as f64).sqrt()
    };
    Ok(LyapunovExponent { value, standard_error, times, history })
}
