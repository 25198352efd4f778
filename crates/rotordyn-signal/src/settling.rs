//! Whether a motion sampled once per forcing period has settled: decay of its changes, estimate of the limit.

use std::ops::Range;

/// Share of the tolerance below which changes count as round-off, without a trend; and that for sections too short
/// to distinguish changes to and fro from a trend.
const ROUND_OFF_SHARE: f64 = 1e-5;
const SMALL_SHARE: f64 = 1e-3;
/// Ratio of the distance of points to the length of their path below which they go to and fro, and the smallest
/// number of periods of the motion in the section that shows it.
const TO_AND_FRO: f64 = 0.6;
const REPETITIONS: usize = 4;
/// Share of the decay rate of the changes over some periods from which those over fewer periods decay to zero too.
const COMPARABLE_RATE: f64 = 0.25;
/// Relative change of the mean square change over half a section above which a steady trend counts as not settled.
const AMPLITUDE_TREND: f64 = 0.05;

/// Section values of the moving channels, each with the size of its whole orbit.
#[derive(Clone, Debug)]
pub(super) struct Sections<'a> {
    pub channels: Vec<(&'a [f64], f64)>,
    /// Number of points.
    pub length: usize,
}

/// Decay of the changes |x_{n+k} − x_n| along a section.
#[derive(Clone, Copy, Debug)]
struct Decay {
    /// Largest changes in the first and in the last third.
    early: f64,
    late: f64,
    /// Factor per forcing period, from the largest changes in the first and the last third.
    factor: f64,
}

impl Sections<'_> {
    /// Largest relative change over k points from points of a range.
    pub fn change(&self, k: usize, from: Range<usize>) -> f64 {
        let of = |(s, size): &(&[f64], f64)| {
            from.clone().map(|i| (s[i + k] - s[i]).abs() / size).fold(0.0, f64::max)
        };
        self.channels.iter().map(of).fold(0.0, f64::max)
    }

    /// Of the points of a range that are multiples of k apart, the largest relative distance of two and the length
    /// of the path from each to the next, for the channel and start with the largest distance.
    fn path(&self, k: usize, from: usize) -> (f64, f64) {
        let mut found = (0.0, 0.0);
        for (s, size) in &self.channels {
            for start in from..(from + k).min(self.length) {
                let points = || s[start..].iter().step_by(k);
                let [low, high] =
                    points().fold([f64::INFINITY, f64::NEG_INFINITY], |[l, h], v| [v.min(l), v.max(h)]);
                if (high - low) / size > found.0 {
                    let length = points().zip(points().skip(1)).map(|(a, b)| (b - a).abs()).sum::<f64>();
                    found = ((high - low) / size, length / size);
                }
            }
        }
        found
    }

    /// Largest relative distance of two points any multiple of k apart.
    pub fn spread(&self, k: usize) -> f64 {
        self.path(k, 0).0
    }

    /// Decay of the changes over k points.
    fn decay(&self, k: usize) -> Decay {
        let changes = self.length - k;
        let third = (changes / 3).max(1);
        let early = self.change(k, 0..third);
        let late = self.change(k, changes - third..changes);
        let apart = (changes - third).max(1) as f64;
        let factor = if late == early { 1.0 } else { (late / early).powf(1.0 / apart) };
        Decay { early, late, factor }
    }

    /// Estimated distance of the last points from the limit of period k, and the decay per forcing period if there is
    /// one above round-off; infinite if the changes grow.
    ///
    /// Points that go to and fro are around their limit: the distance is at most their spread over the second half
    /// of the section. Points that go one way are extrapolated, Σ_j e ρ^{jk} = e ρᵏ/(1 − ρᵏ) with the late change e
    /// and its factor ρ per forcing period.
    pub fn residual(&self, k: usize, tolerance: f64) -> (f64, Option<f64>) {
        let Decay { early, late, factor } = self.decay(k);
        let repeats = self.length >= REPETITIONS * k;
        if late <= tolerance * if repeats { ROUND_OFF_SHARE } else { SMALL_SHARE } {
            return (late, None);
        }
        let (spread, length) = self.path(k, 0);
        if repeats && spread <= TO_AND_FRO * length && late < 2.0 * early {
            return (self.path(k, self.length / 2).0, Some(factor).filter(|f| *f < 1.0));
        }
        let over_period = factor.powi(i32::try_from(k).unwrap_or(i32::MAX));
        let rest = if over_period < 1.0 { late * over_period / (1.0 - over_period) } else { f64::INFINITY };
        (rest, Some(factor))
    }

    /// Smallest period the motion may tend to, given that the changes over k points decay: that of the smallest
    /// number of points over which the changes decay at a comparable rate.
    pub fn limit_period(&self, k: usize) -> usize {
        let wanted = COMPARABLE_RATE * self.decay(k).factor.ln();
        (1..k).find(|j| self.decay(*j).factor.ln() <= wanted).unwrap_or(k)
    }

    /// Weighted mean square of the changes over k points relative to the sizes, of `length` changes from `start`,
    /// summed over the channels.
    ///
    /// The weights exp(−1/(t(1 − t))) make means over a regular motion converge faster than any power of the
    /// length. Source: Das, Saiki, Sander and Yorke, Nonlinearity 30 (2017), "weighted Birkhoff average".
    pub fn mean_square_change(&self, k: usize, start: usize, length: usize) -> f64 {
        let weight = |i: usize| {
            let t = (i + 1) as f64 / (length + 1) as f64;
            (-1.0 / (t * (1.0 - t))).exp()
        };
        let weights: Vec<f64> = (0..length).map(weight).collect();
        let total: f64 = weights.iter().sum();
        let of = |(s, size): &(&[f64], f64)| {
            let change = |i: usize| ((s[start + i + k] - s[start + i]) / size).powi(2);
            weights.iter().enumerate().map(|(i, w)| w * change(i)).sum::<f64>() / total
        };
        self.channels.iter().map(of).sum()
    }

    /// Logarithmic change of the mean square change over k points from the first to the second half, and whether it
    /// is a trend: the same in both steps over three overlapping halves, and larger than a regular motion shows.
    pub fn amplitude_trend(&self, k: usize) -> (f64, bool) {
        let changes = self.length - k;
        let half = changes / 2;
        let starts = [0, (changes - half) / 2, changes - half];
        let [a, b, c] = starts.map(|start| self.mean_square_change(k, start, half));
        let change = (c / a).ln();
        let even = ((b / a).ln() - (c / b).ln()).abs() <= 0.5 * change.abs();
        (change, even && change.abs() > AMPLITUDE_TREND)
    }
}
