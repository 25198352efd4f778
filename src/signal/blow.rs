//! Hammer blows in a record: where they are, and which of them are fit for use.

use super::SignalError;
use super::error::{check, check_record, check_same_length};
use super::impact::Blow;

/// How blows are found in a long record of the force.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Trigger {
    /// A blow begins where |force| passes this share of its largest value in the record.
    pub level: f64,
    /// Samples kept before that.
    pub before: usize,
    /// Samples of a blow's block.
    pub length: usize,
}

impl Trigger {
    /// Ranges of samples of every blow whose block lies whole in the record; blocks do not overlap.
    ///
    /// A second crossing within a block belongs to it: [`inspect`] tells double hits. Errors: NaN, level not
    /// between 0 and 1, no length, more samples before the blow than in the block.
    pub fn find(&self, force: &[f64]) -> Result<Vec<std::ops::Range<usize>>, SignalError> {
        check_record("force", force)?;
        check(self.level > 0.0 && self.level < 1.0, "trigger level", "between 0 and 1", self.level)?;
        check(self.length > 0, "block length", "one sample or more", self.length as f64)?;
        let fits = self.before < self.length;
        check(fits, "samples before the blow", "fewer than in the block", self.before as f64)?;
        let largest = peak(force).1;
        let mut found = Vec::new();
        let mut free = 0;
        while let Some(at) =
            force[free..].iter().position(|f| largest > 0.0 && f.abs() >= self.level * largest)
        {
            let start = (free + at).saturating_sub(self.before).max(free);
            if start + self.length > force.len() {
                break;
            }
            found.push(start..start + self.length);
            free = start + self.length;
        }
        Ok(found)
    }
}

/// What makes a blow unfit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limits {
    /// A second pulse of the hammer of more than this share of the first is a double hit. Filters ring with up to
    /// a fifth of the peak beside it, with changing sign; only the sign of the blow counts.
    pub double_hit: f64,
    /// Largest |force| and |response| that the channels can hold; `None` looks for flat tops alone.
    pub full_scale: [Option<f64>; 2],
    /// Largest share of its peak that the response may have left at the end of the block, after windows.
    pub left_over: f64,
}

impl Default for Limits {
    fn default() -> Self {
        Limits { double_hit: 0.2, full_scale: [None; 2], left_over: 0.1 }
    }
}

/// What a blow is like.
#[derive(Clone, Debug, PartialEq)]
pub struct Inspection {
    /// Sample and value of the largest force.
    pub peak: (usize, f64),
    /// Samples over a tenth of it around the peak.
    pub contact: std::ops::Range<usize>,
    /// Sample of a second hit.
    pub double_hit: Option<usize>,
    /// Sample at which force or response is beyond its range.
    pub overload: [Option<usize>; 2],
    /// RMS of the response's last twentieth over its peak; 0 where the response is 0.
    pub left_over: f64,
    /// Whether more is left over than the limits allow: a longer block or an exponential window is needed.
    pub cut_off: bool,
}

impl Inspection {
    /// Neither a double hit nor an overload.
    pub fn is_good(&self) -> bool {
        self.double_hit.is_none() && self.overload == [None; 2]
    }

    /// What is wrong, in words; empty for a good blow.
    pub fn faults(&self) -> Vec<String> {
        let mut faults = Vec::new();
        faults.extend(self.double_hit.map(|at| format!("a second hit at sample {at}: strike again")));
        for (name, overload) in ["force", "response"].iter().zip(self.overload) {
            faults.extend(overload.map(|at| {
                format!(
                    "the {name} is beyond its range at sample {at}: strike softer or choose a larger range"
                )
            }));
        }
        if self.cut_off {
            faults.push(format!(
                "{:.0} % of the response is left at the end: take longer blocks or an exponential window",
                100.0 * self.left_over
            ));
        }
        faults
    }
}

/// Looks at one blow; `response_window` \[1\] is laid over the response before what is left over is judged.
///
/// A channel without a known range counts as overloaded where it stays at its largest value for three samples or
/// more. Errors: NaN, unequal lengths, a force that is zero throughout.
pub fn inspect(
    blow: &Blow,
    limits: &Limits,
    response_window: Option<&[f64]>,
) -> Result<Inspection, SignalError> {
    check_record("force", blow.force)?;
    check_record("response", blow.response)?;
    check_same_length("response", blow.response.len(), "force", blow.force.len())?;
    if let Some(window) = response_window {
        check_same_length("window", window.len(), "response", blow.response.len())?;
    }
    let (at, size) = peak(blow.force);
    check(size > 0.0, "largest force", "more than zero", size)?;
    let sign = blow.force[at].signum();
    let level = |n: usize| sign * blow.force[n];
    let tenth = 0.1 * size;
    let start = (0..at).rev().find(|&n| level(n) < tenth).map_or(0, |n| n + 1);
    let end = (at..blow.force.len()).find(|&n| level(n) < tenth).unwrap_or(blow.force.len());
    let outside = (0..start).chain(end..blow.force.len());
    let second = outside.clone().find(|&n| level(n) > limits.double_hit * size);
    let weight = |n: usize| response_window.map_or(1.0, |w| w[n]);
    let response_peak = peak(blow.response).1;
    let last = blow.response.len() - (blow.response.len() / 20).max(1);
    let tail = (last..blow.response.len()).map(|n| (weight(n) * blow.response[n]).powi(2));
    let tail = (tail.sum::<f64>() / (blow.response.len() - last) as f64).sqrt();
    let left_over = if response_peak > 0.0 { tail / response_peak } else { 0.0 };
    Ok(Inspection {
        peak: (at, blow.force[at]),
        contact: start..end,
        double_hit: second,
        overload: [overload(blow.force, limits.full_scale[0]), overload(blow.response, limits.full_scale[1])],
        left_over,
        cut_off: left_over > limits.left_over,
    })
}

/// Sample and size of the largest |value|; (0, 0) of an empty record.
fn peak(record: &[f64]) -> (usize, f64) {
    let largest = record.iter().enumerate().map(|(n, v)| (n, v.abs()));
    largest.fold((0, 0.0), |best, here| if here.1 > best.1 { here } else { best })
}

/// First sample at the end of the range, or of three or more at the record's own extreme.
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
