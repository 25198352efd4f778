//! Quality of a hit: double hit, overload, truncated response.

use super::decay::left_at_end;
use super::{Hit, peak};
use crate::SignalError;
use crate::error::{check, check_record, check_same_length};

/// Limits of a usable hit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limits {
    /// A second force pulse above this fraction of the first is a double hit. Filter ringing near the peak reaches
    /// a fifth of it with alternating sign; only pulses with the sign of the hit count.
    pub double_hit: f64,
    /// Full scale of the force and response channels; `None`: only flat tops are detected.
    pub full_scale: [Option<f64>; 2],
    /// Largest residual response at the end of the block, as a fraction of its peak and of each strong frequency, after windows.
    pub residual: f64,
}

impl Default for Limits {
    fn default() -> Self {
        Limits { double_hit: 0.2, full_scale: [None; 2], residual: 0.1 }
    }
}

/// Quality of one hit.
#[derive(Clone, Debug, PartialEq)]
pub struct HitQuality {
    /// Sample and value of the largest force.
    pub peak: (usize, f64),
    /// Contact: the samples around the peak above a tenth of it.
    pub contact: std::ops::Range<usize>,
    /// Sample of a second hit.
    pub double_hit: Option<usize>,
    /// Sample at which force or response is beyond its range.
    pub overload: [Option<usize>; 2],
    /// RMS of the last twentieth of the response over its peak, or the amplitude at the end over that after the hit of a strong
    /// frequency, if larger; 0 for a zero response.
    pub residual: f64,
    /// Whether the residual exceeds the limit: a longer block or an exponential window is needed.
    pub truncated: bool,
}

impl HitQuality {
    /// Neither a double hit nor an overload.
    pub fn is_good(&self) -> bool {
        self.double_hit.is_none() && self.overload == [None; 2]
    }

    /// Faults as messages; empty for a usable hit.
    pub fn faults(&self) -> Vec<String> {
        let mut faults = Vec::new();
        faults.extend(
            self.double_hit.map(|at| format!("a double hit, the second at sample {at}: repeat the hit")),
        );
        for (name, overload) in ["force", "response"].iter().zip(self.overload) {
            faults.extend(overload.map(|at| {
                format!("overload of the {name} at sample {at}: hit more softly or choose a larger range")
            }));
        }
        if self.truncated {
            faults.push(format!(
                "the response is truncated, {:.0} % of it is left: take longer blocks or an exponential window",
                100.0 * self.residual
            ));
        }
        faults
    }
}

/// Quality of one hit; the residual is computed for the response times `response_window` \[1\].
///
/// A channel without a known range is overloaded if it stays at its largest value for three or more samples. Errors: NaN, unequal lengths, a force that is zero throughout.
pub fn inspect(
    hit: &Hit,
    limits: &Limits,
    response_window: Option<&[f64]>,
) -> Result<HitQuality, SignalError> {
    check_record("force", hit.force)?;
    check_record("response", hit.response)?;
    check_same_length("response", hit.response.len(), "force", hit.force.len())?;
    if let Some(window) = response_window {
        check_same_length("window", window.len(), "response", hit.response.len())?;
    }
    let (at, size) = peak(hit.force);
    check(size > 0.0, "largest force", "more than zero", size)?;
    let sign = hit.force[at].signum();
    let level = |n: usize| sign * hit.force[n];
    let tenth = 0.1 * size;
    let start = (0..at).rev().find(|&n| level(n) < tenth).map_or(0, |n| n + 1);
    let end = (at..hit.force.len()).find(|&n| level(n) < tenth).unwrap_or(hit.force.len());
    let outside = (0..start).chain(end..hit.force.len());
    let second = outside.clone().find(|&n| level(n) > limits.double_hit * size);
    let weight = |n: usize| response_window.map_or(1.0, |w| w[n]);
    let response_peak = peak(hit.response).1;
    let last = hit.response.len() - (hit.response.len() / 20).max(1);
    let tail = (last..hit.response.len()).map(|n| (weight(n) * hit.response[n]).powi(2));
    let tail = (tail.sum::<f64>() / (hit.response.len() - last) as f64).sqrt();
    let after: Vec<f64> = (end..hit.response.len()).map(|n| weight(n) * hit.response[n]).collect();
    let residual = if response_peak > 0.0 { (tail / response_peak).max(left_at_end(&after)) } else { 0.0 };
    Ok(HitQuality {
        peak: (at, hit.force[at]),
        contact: start..end,
        double_hit: second,
        overload: [overload(hit.force, limits.full_scale[0]), overload(hit.response, limits.full_scale[1])],
        residual,
        truncated: residual > limits.residual,
    })
}

/// First sample at full scale, or the first of three or more equal samples at the extreme of the record.
fn overload(record: &[f64], full_scale: Option<f64>) -> Option<usize> {
    if let Some(limit) = full_scale {
        return record.iter().position(|v| v.abs() >= limit);
    }
    let (high, low) = record.iter().fold((0.0, 0.0), |(h, l): (f64, f64), &v| (h.max(v), l.min(v)));
    record.windows(3).position(|w| {
        let extreme = w[0] == high || w[0] == low;
        w[0] != 0.0 && extreme && w[1] == w[0] && w[2] == w[0]
    })
}
