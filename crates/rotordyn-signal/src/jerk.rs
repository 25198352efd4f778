//! Jerk: its jumps, at which a ball enters and leaves a defect, and detection of impulses.

use rustfft::num_complex::Complex;
use serde::{Deserialize, Serialize};

use super::SignalError;
use super::error::{check, check_length, check_rate, check_record, check_same_length};
use super::statistics::median;

/// A jump spans one bin on either side of its middle; the bin at distance `FLANK_DISTANCE` is its flank, and the bins
/// beyond, up to `BASELINE_DISTANCE`, give the baseline level of that side.
const FLANK_DISTANCE: isize = 2;
const BASELINE_DISTANCE: isize = 6;
/// Maximum deviation of a jump's flanks from the baselines, relative to the jump's mean.
const MAX_FLANK_DEVIATION: f64 = 0.3;

/// Jerk \[unit/s\] (derivative of acceleration) by central differences, one-sided at the ends.
///
/// ȧ_n = (a_{n+1} − a_{n−1}) f_s / 2. Errors: NaN, fewer than two samples.
pub fn jerk(acceleration: &[f64], sample_rate: f64) -> Result<Vec<f64>, SignalError> {
    check_record("acceleration", acceleration)?;
    check_rate(sample_rate)?;
    check_length("acceleration", acceleration.len(), 2, "a jerk")?;
    let last = acceleration.len() - 1;
    let at = |n: usize| {
        let (before, after) = (n.saturating_sub(1), (n + 1).min(last));
        (acceleration[after] - acceleration[before]) * sample_rate / (after - before) as f64
    };
    Ok((0..=last).map(at).collect())
}

/// A jump of the jerk: a kink of the acceleration.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct JerkJump {
    /// Its time \[s\] from the first sample, between samples.
    pub time: f64,
    /// Jerk after less jerk before.
    pub size: f64,
}

/// Detects jumps of the jerk above `threshold` robust standard deviations of the record.
///
/// A kink of size J between samples n and n+1 gives second differences a_{n−1} − 2a_n + a_{n+1} that sum to
/// J/f_s with their centroid at the kink; the curvature on either side is subtracted, and broader peaks are
/// rejected. `acceleration` (N), `sample_rate` \[Hz\] high enough for 8 samples between two jumps;
/// `threshold` in robust standard deviations (1.48 times the median), 8 to 12. Errors: NaN, fewer than 32
/// samples, threshold not positive.
pub fn jerk_jumps(
    acceleration: &[f64],
    sample_rate: f64,
    threshold: f64,
) -> Result<Vec<JerkJump>, SignalError> {
    check_record("acceleration", acceleration)?;
    check_rate(sample_rate)?;
    check_length("acceleration", acceleration.len(), 32, "jumps of the jerk")?;
    let kinks = second_differences(acceleration).map(Complex::from).collect::<Vec<_>>();
    let jumps = find_jumps(&kinks, threshold, false)?;
    let scale = |j: Jump| JerkJump { time: (j.place + 1.0) / sample_rate, size: j.size.re * sample_rate };
    Ok(jumps.into_iter().map(scale).collect())
}

/// a_{n−1} − 2a_n + a_{n+1} for n = 1 .. N − 2.
pub(crate) fn second_differences(record: &[f64]) -> impl Iterator<Item = f64> {
    record.windows(3).map(|w| w[0] - 2.0 * w[1] + w[2])
}

/// A spike in a profile of second differences.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Jump {
    /// Fractional position in bins.
    pub place: f64,
    /// Sum of the spike above the surrounding curvature; complex for two channels.
    pub size: Complex<f64>,
}

/// Detects spikes one to three bins wide in a profile, in order; `periodic` joins its ends.
pub(crate) fn find_jumps(
    profile: &[Complex<f64>],
    threshold: f64,
    periodic: bool,
) -> Result<Vec<Jump>, SignalError> {
    check(threshold > 0.0 && threshold.is_finite(), "threshold", "a positive number", threshold)?;
    let n = profile.len() as isize;
    let margin = if periodic { 0 } else { BASELINE_DISTANCE };
    let spikes: Vec<Spike> = (margin..n - margin).map(|k| Spike::around(profile, k)).collect();
    let spread = 1.4826 * median(spikes.iter().map(|s| s.size.norm()).collect());
    let largest = spikes.iter().map(|s| s.size.norm()).fold(0.0, f64::max);
    // Exclude rounding errors of the largest values.
    let least = (threshold * spread).max(1e-9 * largest);
    let stands_out = |spike: &Spike| spike.size.norm() > least && spike.flanks < MAX_FLANK_DEVIATION;
    let count = spikes.len() as isize;
    let place_of =
        |i: isize| if periodic { Some(i.rem_euclid(count)) } else { (0..count).contains(&i).then_some(i) };
    // Local maximum within FLANK + 1 bins; of two equal ones the first.
    let is_jump = |i: &isize| {
        let own = spikes[*i as usize].size.norm();
        let beaten_by = |at: isize, earlier: bool| {
            place_of(at).map(|r| &spikes[r as usize]).filter(|s| stands_out(s)).is_some_and(|rival| {
                let other = rival.size.norm();
                other > own || (earlier && other == own)
            })
        };
        stands_out(&spikes[*i as usize])
            && !(1..=FLANK_DISTANCE + 1).any(|d| beaten_by(i - d, true) || beaten_by(i + d, false))
    };
    let jump = |i: isize| {
        let spike = &spikes[i as usize];
        Jump { place: (i + margin) as f64 + spike.shift, size: spike.size }
    };
    Ok((0..count).filter(is_jump).map(jump).collect())
}

/// Content of the three bins around a position above the baselines of both sides.
struct Spike {
    size: Complex<f64>,
    /// Centroid along the spike's direction, in bins from the middle.
    shift: f64,
    /// Deviation of the flanks from the baselines over the spike's mean: small for a spike.
    flanks: f64,
}

impl Spike {
    fn around(profile: &[Complex<f64>], middle: isize) -> Self {
        let bin = |k: isize| profile[(middle + k).rem_euclid(profile.len() as isize) as usize];
        let level = |sign: isize| {
            let values: Vec<_> = (FLANK_DISTANCE + 1..=BASELINE_DISTANCE).map(|k| bin(sign * k)).collect();
            let re = median(values.iter().map(|v| v.re).collect());
            Complex::new(re, median(values.iter().map(|v| v.im).collect()))
        };
        let (left, right) = (level(-1), level(1));
        // The baseline steps from one side's level to the other's at the jump.
        let above = [bin(-1) - left, bin(0) - 0.5 * (left + right), bin(1) - right];
        let size: Complex<f64> = above.iter().sum();
        let power = size.norm_sqr();
        let stray = (bin(-FLANK_DISTANCE) - left).norm() + (bin(FLANK_DISTANCE) - right).norm();
        Spike {
            size,
            shift: if power > 0.0 { ((above[2] - above[0]) * size.conj()).re / power } else { 0.0 },
            flanks: if power > 0.0 { 0.5 * stray / (size.norm() / 3.0) } else { f64::INFINITY },
        }
    }
}

/// Times of impulses \[s\]: maxima of |jerk| above a threshold, each followed by a dead time.
///
/// The magnitude of the jerk of one or two perpendicular channels is smoothed by a Gaussian and compared with
/// `fraction` of its 99.5th percentile. `accelerations` (1 or 2 records of N), `sample_rate` \[Hz\],
/// `smoothing` standard deviation and `dead_time` \[s\]. Errors: NaN, unequal lengths, settings not positive.
pub fn impulses(
    accelerations: &[&[f64]],
    sample_rate: f64,
    smoothing: f64,
    dead_time: f64,
    fraction: f64,
) -> Result<Vec<f64>, SignalError> {
    let first = accelerations.first().ok_or(SignalError::Empty { name: "list of accelerations" })?;
    check(smoothing > 0.0 && smoothing.is_finite(), "smoothing", "a positive number of seconds", smoothing)?;
    check(dead_time >= 0.0 && dead_time.is_finite(), "dead time", "0 s or more", dead_time)?;
    check(fraction > 0.0 && fraction < 1.0, "threshold fraction", "between 0 and 1", fraction)?;
    let mut power = vec![0.0; first.len()];
    for acceleration in accelerations {
        check_same_length("acceleration", acceleration.len(), "the first", first.len())?;
        for (sum, j) in power.iter_mut().zip(jerk(acceleration, sample_rate)?) {
            *sum += j * j;
        }
    }
    let size: Vec<f64> = power.iter().map(|p| p.sqrt()).collect();
    let size = gaussian_smoothed(&size, smoothing * sample_rate);
    let mut sorted = size.clone();
    sorted.sort_by(f64::total_cmp);
    let level = fraction * sorted[((sorted.len() - 1) as f64 * 0.995).round() as usize];
    let dead = (dead_time * sample_rate).round() as usize;
    let mut times = Vec::new();
    let mut free = 0;
    for n in 1..size.len().saturating_sub(1) {
        if n >= free && size[n] > level && size[n] > size[n - 1] && size[n] >= size[n + 1] {
            times.push(n as f64 / sample_rate);
            free = n + dead.max(1);
        }
    }
    Ok(times)
}

/// Gaussian smoothing: standard deviation `sigma` samples, truncated at 4 sigma, weights summing to 1.
fn gaussian_smoothed(values: &[f64], sigma: f64) -> Vec<f64> {
    let reach = (4.0 * sigma).ceil() as usize;
    let weights: Vec<f64> = (0..=reach).map(|k| (-0.5 * (k as f64 / sigma).powi(2)).exp()).collect();
    let sum = weights[0] + 2.0 * weights[1..].iter().sum::<f64>();
    let last = values.len() - 1;
    let at = |n: usize| {
        let both = |(k, w): (usize, &f64)| w * (values[n.saturating_sub(k)] + values[(n + k).min(last)]);
        (weights[0] * values[n] + weights.iter().enumerate().skip(1).map(both).sum::<f64>()) / sum
    };
    (0..values.len()).map(at).collect()
}
