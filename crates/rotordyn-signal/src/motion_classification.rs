//! Classification of a steady motion from its Poincaré section: period k, quasi-periodic or chaotic.

use serde::{Deserialize, Serialize};
use std::f64::consts::PI;

use super::SignalError;
use super::error::{check, check_length, check_record, check_same_length};
use super::settling::Sections;

/// Frequencies c tried by the 0–1 test, and the number retained: those of the smallest mean displacement.
const TRIED_FREQUENCIES: usize = 100;
const RETAINED_FREQUENCIES: usize = 70;
/// K of the 0–1 test from which a section is classified as chaotic.
const CHAOS_THRESHOLD: f64 = 0.5;
/// Ratio of the second half's to the first half's recurrence error below which the motion counts as decaying.
const MAX_DECAY_RATIO: f64 = 0.3;
/// Section points from which the 0–1 test tells quasi-periodic from chaotic motion.
const FEWEST_TESTED: usize = 100;
/// Motion relative to the largest value below which a channel counts as at rest.
const ROUND_OFF: f64 = 1e-12;

/// Type of a steady motion sampled once per forcing period.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Motion {
    /// Repeats after this number of forcing periods.
    Periodic(usize),
    /// Not settled: transient towards a motion of this period.
    Settling(usize),
    /// Not settled: still changing, towards a motion that the section does not show.
    Unsettled,
    /// Neither periodic nor still changing, but with too few points to tell quasi-periodic from chaotic motion.
    Aperiodic,
    /// Regular but not periodic: incommensurate frequencies (or a period longer than the longest tried).
    QuasiPeriodic,
    /// Chaotic (irregular, by the 0–1 test).
    Chaotic,
}

impl Motion {
    /// "period 2", "quasi-periodic", ...
    pub fn name(&self) -> String {
        match self {
            Self::Periodic(k) => format!("period {k}"),
            Self::Settling(k) => format!("not settled, towards period {k}"),
            Self::Unsettled => "not settled".into(),
            Self::Aperiodic => "not periodic (100 periods tell which)".into(),
            Self::QuasiPeriodic => "quasi-periodic".into(),
            Self::Chaotic => "chaotic".into(),
        }
    }

    /// Whether the transient has decayed.
    pub fn is_settled(&self) -> bool {
        !matches!(self, Self::Settling(_) | Self::Unsettled)
    }

    /// Period in forcing periods, if periodic.
    pub fn period(&self) -> Option<usize> {
        match self {
            Self::Periodic(k) => Some(*k),
            _ => None,
        }
    }
}

/// A classified motion with the criteria values.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Classification {
    pub motion: Motion,
    /// Recurrence error: largest change over one period of the motion, relative to the size of the orbit; of
    /// the best period tried if none is within the tolerance.
    pub recurrence: f64,
    /// K of the 0–1 test, near 0 for regular, near 1 for chaotic motion; NaN if not tested (periodic motion).
    pub zero_one_k: f64,
    /// Estimated distance of the last section points from the motion they tend to, relative to the size of the
    /// orbit; infinite if the changes do not decay, NaN for quasi-periodic and chaotic motions.
    pub residual: f64,
    /// Factor per forcing period by which the changes of a motion that tends to a periodic one decay, the
    /// modulus of its largest Floquet multiplier; NaN without changes above round-off.
    pub decay_factor: f64,
    /// Number of points after which a quasi-periodic or chaotic motion returns nearest to itself, the mean square of
    /// its changes over them relative to the size of the orbit, and the logarithm of the change of that mean
    /// square from the first to the second half; 0 and NaN for periodic motions.
    pub nearest_return: usize,
    pub mean_square_change: f64,
    pub amplitude_trend: f64,
}

impl Classification {
    /// Forcing periods after the section until the motion is within `tolerance` of the one it tends to,
    /// ln(tolerance/residual)/ln ρ; `None` if its decay ρ is not known.
    pub fn periods_to_settle(&self, tolerance: f64) -> Option<f64> {
        let periods = (tolerance / self.residual).ln() / self.decay_factor.ln();
        (periods.is_finite() && periods > 0.0).then_some(periods)
    }
}

/// Classifies a motion from its Poincaré section.
///
/// `sections`: per channel its N section values; `sizes`: per channel the size of the whole orbit (peak to
/// peak, not of the section: that of a motion of period 1 is a point); `tolerance` relative to the size;
/// `longest` period tried, N/2 at most. The criterion, in this order:
///
/// 1. k is the smallest number with |x_{n+mk} − x_n| ≤ tolerance · size for every n, m and channel; periodic(k) if
///    also the distance from the limit, extrapolated from the decay of the changes, is within the tolerance, else
///    not settled;
/// 2. not settled, towards period k: k is the smallest whose error over the second half of the section is below a
///    tenth of the size and below 0.3 of the error over the first half (a decaying transient);
/// 3. not settled if the changes over any k points are within the tolerance but add up to more;
/// 4. of fewer than 100 points aperiodic, or not settled as in 5; chaotic when the 0–1 test ([`zero_one_test`]) gives K ≥ 0.5 for any channel whose section is wider than the
///    tolerance;
/// 5. not settled if the changes over the points after which the motion returns nearest to itself grow or decay
///    steadily, else quasi-periodic.
///
/// A slow spiral towards a point passes near its own points after some number of turns: without the
/// extrapolation it would count as a motion of that period.
/// Errors: NaN, unequal lengths, no channel, fewer than eight points.
pub fn classify_motion(
    sections: &[&[f64]],
    sizes: &[f64],
    tolerance: f64,
    longest: usize,
) -> Result<Classification, SignalError> {
    check_same_length("sizes", sizes.len(), "the list of sections", sections.len())?;
    check(tolerance > 0.0 && tolerance.is_finite(), "tolerance", "a positive number", tolerance)?;
    check_length("list of sections", sections.len(), 1, "a period")?;
    let n = sections[0].len();
    for section in sections {
        check_record("section", section)?;
        check_same_length("section", section.len(), "the first section", n)?;
    }
    check_length("section", n, 8, "a period")?;
    check_record("sizes", sizes)?;

    let largest = |s: &[f64]| s.iter().fold(0.0, |m: f64, v| m.max(v.abs()));
    let moves = |s: &[f64], size: f64| size > ROUND_OFF * largest(s);
    let channels =
        sections.iter().zip(sizes).filter(|(s, size)| moves(s, **size)).map(|(s, size)| (*s, *size));
    let moving = Sections { channels: channels.collect(), length: n };
    let longest = longest.clamp(1, n / 2);
    let mut found = Classification {
        motion: Motion::Unsettled,
        recurrence: f64::INFINITY,
        zero_one_k: f64::NAN,
        residual: f64::NAN,
        decay_factor: f64::NAN,
        nearest_return: 0,
        mean_square_change: f64::NAN,
        amplitude_trend: f64::NAN,
    };
    let tends_to = |k: usize, recurrence: f64| {
        let (residual, factor) = moving.residual(k, tolerance);
        let motion = match residual {
            r if r.is_finite() => Motion::Settling(moving.limit_period(k)),
            _ => Motion::Unsettled,
        };
        let decay_factor = factor.unwrap_or(f64::NAN);
        Classification { motion, recurrence, residual, decay_factor, ..found }
    };
    let recurrences: Vec<f64> = (1..=longest).map(|k| moving.change(k, 0..n - k)).collect();
    let repeats = |k: &usize| recurrences[k - 1] <= tolerance;
    if let Some(k) = (1..=longest).filter(repeats).find(|k| moving.spread(*k) <= tolerance) {
        // Points of a small spiral return near themselves only after several periods of its limit.
        let k = if moving.residual(k, tolerance).1.is_some() { moving.limit_period(k) } else { k };
        let tending = tends_to(k, recurrences[k - 1]);
        let settled = tending.residual <= tolerance;
        return Ok(if settled { Classification { motion: Motion::Periodic(k), ..tending } } else { tending });
    }
    // A half must contain the period at least once.
    let half = n / 2;
    let late = (1..=longest.min(half / 2)).map(|k| (k, moving.change(k, half..n - k)));
    let mut decays =
        late.filter(|(k, error)| *error < 0.1 && *error < MAX_DECAY_RATIO * moving.change(*k, 0..half - k));
    if let Some((k, error)) = decays.next() {
        let limit = moving.limit_period(k);
        return Ok(Classification { motion: Motion::Settling(limit), ..tends_to(k, error) });
    }
    if let Some(k) = (1..=longest).find(repeats) {
        return Ok(tends_to(k, recurrences[k - 1]));
    }
    found.recurrence = recurrences.iter().copied().fold(f64::INFINITY, f64::min);
    for (section, size) in &moving.channels {
        let (low, high) = section.iter().fold((f64::MAX, f64::MIN), |(l, h), v| (v.min(l), v.max(h)));
        if high - low > tolerance * size {
            found.zero_one_k = zero_one_test(section)?.max(found.zero_one_k);
        }
    }
    // Of at most a quarter of the section, so that its two halves can be compared.
    let nearest = (0..longest.min((n / 4).max(1)))
        .min_by(|a, b| recurrences[*a].total_cmp(&recurrences[*b]))
        .map_or(1, |k| k + 1);
    let (trend, is_trend) = moving.amplitude_trend(nearest);
    found.nearest_return = nearest;
    found.mean_square_change = moving.mean_square_change(nearest, 0, n - nearest);
    found.amplitude_trend = trend;
    found.motion = match found.zero_one_k {
        k if k >= CHAOS_THRESHOLD && n >= FEWEST_TESTED => Motion::Chaotic,
        _ if is_trend => Motion::Unsettled,
        _ if n < FEWEST_TESTED => Motion::Aperiodic,
        _ => Motion::QuasiPeriodic,
    };
    Ok(found)
}

/// The 0–1 test for chaos: K near 0 for regular, near 1 for chaotic motion.
///
/// p(n) = Σ_{j≤n} (x_j − x̄) cos jc, q(n) likewise with sin jc; the mean square displacement M_c(n) of (p, q)
/// over n steps is bounded for regular and grows linearly for chaotic motion. K_c is the correlation of
/// M_c(n) with n = 1 .. N/3 for 100 values of c in (π/5, 4π/5), spread by the golden ratio; K is the median
/// over the 70 of them with the smallest mean M_c. (Subtracting the mean x̄ replaces the source's term in
/// x̄².) The source takes n up to N/10. A spectral line at ν makes (p, q) drift over 1/|c − ν| steps, so that
/// with 100 points and 10 steps most tori look chaotic; a longer n and discarding the c near a line
/// (resonances) separate them: of 150 tori of one and two frequencies with harmonics none is above 0.5 at N =
/// 100, and of 45 chaotic maps none is below (with N/10 and all c, half of the tori are above).
/// Validity: samples once per period of the forcing (densely sampled records look regular), 100 or more of
/// them.
/// Source: Gottwald and Melbourne, SIAM J. Appl. Dyn. Syst. 8 (2009), §2 and §3.
/// Errors: NaN, fewer than eight samples.
pub fn zero_one_test(record: &[f64]) -> Result<f64, SignalError> {
    check_record("record", record)?;
    check_length("record", record.len(), 8, "the 0-1 test")?;
    let n = record.len();
    let spread = (n / 3).max(4);
    let used = n - spread;
    let mean = record.iter().sum::<f64>() / n as f64;
    let golden = 0.5 * (5f64.sqrt() - 1.0);
    let (mut p, mut q, mut growth) = (vec![0.0; n], vec![0.0; n], vec![0.0; spread]);
    // Per c the mean displacement and K_c.
    let mut found: Vec<(f64, f64)> = (0..TRIED_FREQUENCIES)
        .map(|k| {
            let c = PI * (0.2 + 0.6 * ((k + 1) as f64 * golden).fract());
            let (mut a, mut b) = (0.0, 0.0);
            for (j, x) in record.iter().enumerate() {
                let (sin, cos) = ((j + 1) as f64 * c).sin_cos();
                a += (x - mean) * cos;
                b += (x - mean) * sin;
                (p[j], q[j]) = (a, b);
            }
            for (m, value) in growth.iter_mut().enumerate() {
                let m = m + 1;
                let square = |j: usize| (p[j + m] - p[j]).powi(2) + (q[j + m] - q[j]).powi(2);
                *value = (0..used).map(square).sum::<f64>() / used as f64;
            }
            (growth.iter().sum::<f64>(), correlation_with_index(&growth))
        })
        .collect();
    found.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut counted: Vec<f64> = found[..RETAINED_FREQUENCIES].iter().map(|(_, k)| *k).collect();
    counted.sort_by(f64::total_cmp);
    Ok(0.5 * (counted[RETAINED_FREQUENCIES / 2 - 1] + counted[RETAINED_FREQUENCIES / 2]))
}

/// Correlation coefficient of values with 1, 2, 3, ...; 0 if all values are equal.
fn correlation_with_index(values: &[f64]) -> f64 {
    let n = values.len() as f64;
    let middle = 0.5 * (n - 1.0);
    let mean = values.iter().sum::<f64>() / n;
    let (mut both, mut own) = (0.0, 0.0);
    for (k, v) in values.iter().enumerate() {
        both += (k as f64 - middle) * (v - mean);
        own += (v - mean) * (v - mean);
    }
    let of_index = n * (n * n - 1.0) / 12.0;
    if own > 0.0 { both / (own * of_index).sqrt() } else { 0.0 }
}
