//! Trend of a quantity over time or load: Mann-Kendall test and Theil-Sen slope, which outliers hardly move.
//!
//! Both assume records that are independent of each other: a slow change of load or temperature is a trend too.

use serde::{Deserialize, Serialize};

use super::SignalError;
use super::error::{check_record, check_same_length};
use super::statistics::median;

/// Largest number of points without ties whose test is exact; above, S is normal to better than its own rounding.
const EXACT_POINTS: usize = 50;
/// Quantile 0.975 of the normal distribution.
const NORMAL_97_5: f64 = 1.959_963_984_540_054;

/// Monotonic trend of y over x.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Trend {
    /// Number of points.
    pub count: usize,
    /// Kendall's τ_b, −1 to 1: 1 if every later value is higher.
    pub tau: f64,
    /// Two-sided probability of a |S| as large without a trend (Mann-Kendall).
    pub p_value: f64,
    /// Median slope of all pairs of points (Theil-Sen) \[y/x\].
    pub slope: f64,
    /// Its 95 % confidence interval (Sen 1968).
    pub slope_interval: [f64; 2],
    /// Medians of y over the first and the last fifth of the points, with those at the same x.
    pub ends: [f64; 2],
    /// Number of points of each end.
    pub end_counts: [usize; 2],
}

/// Trend of values over their positions; `None` with fewer than three points, or if all x or all y are equal.
///
/// S = Σ_{i<j} sgn(x_j − x_i) sgn(y_j − y_i); without ties and with at most 50 points its exact distribution
/// (Kendall 1970), otherwise z = (|S| − 1)/√var S with the variance for ties in x and y. The slope's interval
/// are the order statistics (N ∓ 1.96 √var)/2 of its N pairs (Sen 1968, eq. 2.6).
/// `x`, `y`: any units, in any order. Errors: NaN, different lengths.
pub fn trend(x: &[f64], y: &[f64]) -> Result<Option<Trend>, SignalError> {
    check_same_length("values of a trend", y.len(), "the positions", x.len())?;
    if x.len() < 3 {
        return Ok(None);
    }
    check_record("position", x)?;
    check_record("value", y)?;
    let mut points: Vec<(f64, f64)> = x.iter().copied().zip(y.iter().copied()).collect();
    points.sort_by(|a, b| a.0.total_cmp(&b.0));
    let n = points.len();
    let (mut s, mut slopes) = (0i64, Vec::with_capacity(n * (n - 1) / 2));
    for (i, a) in points.iter().enumerate() {
        for b in &points[i + 1..] {
            if b.0 > a.0 {
                s += i64::from(b.1 > a.1) - i64::from(b.1 < a.1);
                slopes.push((b.1 - a.1) / (b.0 - a.0));
            }
        }
    }
    let ties = [ties(points.iter().map(|p| p.0)), ties(points.iter().map(|p| p.1))];
    let count = n as f64;
    let pairs = 0.5 * count * (count - 1.0);
    let untied = |groups: &[f64]| pairs - groups.iter().map(|t| 0.5 * t * (t - 1.0)).sum::<f64>();
    let [in_x, in_y] = [untied(&ties[0]), untied(&ties[1])];
    if in_x == 0.0 || in_y == 0.0 {
        return Ok(None);
    }
    let has_ties = ties.iter().any(|groups| !groups.is_empty());
    let p_value = match has_ties || n > EXACT_POINTS {
        false => exact_probability(n, s.unsigned_abs()),
        true => {
            let z = (s.unsigned_abs() as f64 - 1.0).max(0.0) / variance(count, &ties).sqrt();
            libm::erfc(z / std::f64::consts::SQRT_2)
        }
    };
    let linear = |groups: &[f64]| groups.iter().map(|t| t * (t - 1.0) * (2.0 * t + 5.0)).sum::<f64>();
    let spread = (count * (count - 1.0) * (2.0 * count + 5.0) - linear(&ties[0]) - linear(&ties[1])) / 18.0;
    let half = NORMAL_97_5 * spread.max(0.0).sqrt();
    let pairs = slopes.len() as f64;
    let low = (0.5 * (pairs - half)).round_ties_even() as i64 - 1;
    let high = (0.5 * (pairs + half)).round_ties_even() as i64;
    // Thousands of records have millions of pairs: their order statistics are selected, not sorted.
    let last = slopes.len() - 1;
    let mut at = |k: i64| {
        let k = k.clamp(0, last as i64) as usize;
        *slopes.select_nth_unstable_by(k, f64::total_cmp).1
    };
    let slope_interval = [at(low), at(high)];
    let middle = 0.5 * last as f64;
    let slope = 0.5 * (at(middle.floor() as i64) + at(middle.ceil() as i64));
    let fifth = n.div_ceil(5);
    let [early, late] = [points[fifth - 1].0, points[n - fifth].0];
    let end = |within: &dyn Fn(f64) -> bool| {
        let values: Vec<f64> = points.iter().filter(|p| within(p.0)).map(|p| p.1).collect();
        let count = values.len();
        (median(values), count)
    };
    let (first, last) = (end(&|x| x <= early), end(&|x| x >= late));
    Ok(Some(Trend {
        count: n,
        tau: s as f64 / (in_x * in_y).sqrt(),
        p_value,
        slope,
        slope_interval,
        ends: [first.0, last.0],
        end_counts: [first.1, last.1],
    }))
}

/// Sizes of the groups of two or more equal values.
fn ties(values: impl Iterator<Item = f64>) -> Vec<f64> {
    let mut sorted: Vec<f64> = values.collect();
    sorted.sort_by(f64::total_cmp);
    sorted.chunk_by(|a, b| a == b).filter(|group| group.len() > 1).map(|group| group.len() as f64).collect()
}

/// Variance of S with ties in both quantities (Kendall 1970, eq. 4.4).
fn variance(n: f64, [x, y]: &[Vec<f64>; 2]) -> f64 {
    let sum = |groups: &[f64], of: fn(f64) -> f64| groups.iter().map(|t| of(*t)).sum::<f64>();
    let v0 = n * (n - 1.0) * (2.0 * n + 5.0);
    let linear: fn(f64) -> f64 = |t| t * (t - 1.0) * (2.0 * t + 5.0);
    let pairs: fn(f64) -> f64 = |t| t * (t - 1.0);
    let triples: fn(f64) -> f64 = |t| t * (t - 1.0) * (t - 2.0);
    (v0 - sum(x, linear) - sum(y, linear)) / 18.0
        + sum(x, pairs) * sum(y, pairs) / (2.0 * n * (n - 1.0))
        + sum(x, triples) * sum(y, triples) / (9.0 * n * (n - 1.0) * (n - 2.0))
}

/// Probability of |S| ≥ s of n points in random order, from the numbers of permutations by their inversions.
fn exact_probability(n: usize, s: u64) -> f64 {
    let pairs = n * (n - 1) / 2;
    // Shares instead of counts: 50! does not fit.
    let mut shares = vec![0.0; pairs + 1];
    shares[0] = 1.0;
    for k in 2..=n {
        let reach = k * (k - 1) / 2;
        let before = shares.clone();
        for (inversions, share) in shares.iter_mut().enumerate().take(reach + 1) {
            let first = (inversions + 1).saturating_sub(k);
            *share = before[first..=inversions].iter().sum::<f64>() / k as f64;
        }
    }
    // S = pairs − 2 inversions.
    let most = (pairs as u64 - s) / 2;
    let tail: f64 = shares[..=most as usize].iter().sum();
    if s == 0 { 1.0 } else { (2.0 * tail).min(1.0) }
}
