//! Shaft angle and speed from the pulses of a tacho, with pulses missing, added or shaken.

use super::SignalError;
use super::error::{check, check_length, check_rate, check_record};
use rotordyn_linalg::pchip::Pchip;

/// Most pitches of the pulse wheel that one interval may hold, and most pulses dropped in a row.
const MOST_PITCHES: usize = 6;
const MOST_DROPPED: usize = 2;
/// Cost of n pitches in one interval over ln n: a gap within a run saves 2 ln n, a start from rest would save ln n.
const MISSING_COST: f64 = 1.3;
/// Cost of dropping a pulse: one in the middle of an interval saves 2 ln 2.
const DROPPED_COST: f64 = 1.0;

/// Times at which a tacho channel rises through a level, by linear interpolation, with hysteresis.
///
/// `record` (N), `sample_rate` \[Hz\]. `level` `None` takes the middle between the 1 % and 99 % values; after a pulse
/// the channel must fall `hysteresis` (a fraction of that span) below the level before the next counts.
/// Errors: NaN, a channel that does not move, hysteresis not in 0..0.5.
pub fn rising_edges(
    record: &[f64],
    sample_rate: f64,
    level: Option<f64>,
    hysteresis: f64,
) -> Result<Vec<f64>, SignalError> {
    check_record("tacho channel", record)?;
    check_rate(sample_rate)?;
    check((0.0..0.5).contains(&hysteresis), "hysteresis", "0 to below 0.5", hysteresis)?;
    let mut sorted = record.to_vec();
    sorted.sort_by(f64::total_cmp);
    let last = sorted.len() - 1;
    // Narrow pulses are rarer than 1 % of the samples: then the ends themselves are the span.
    let (mut low, mut high) = (sorted[last / 100], sorted[last - last / 100]);
    if high - low < 0.1 * (sorted[last] - sorted[0]) {
        (low, high) = (sorted[0], sorted[last]);
    }
    check(high > low, "span of the tacho channel", "more than zero", high - low)?;
    let level = level.unwrap_or(0.5 * (low + high));
    let rearm = level - hysteresis * (high - low);
    let mut armed = record[0] < level;
    let mut edges = Vec::new();
    for (n, pair) in record.windows(2).enumerate() {
        armed |= pair[0] < rearm;
        if armed && pair[0] < level && pair[1] >= level {
            let fraction = (level - pair[0]) / (pair[1] - pair[0]);
            edges.push((n as f64 + fraction) / sample_rate);
            armed = false;
        }
    }
    Ok(edges)
}

/// Pulses of a tacho with the turns of the shaft at each.
#[derive(Clone, Debug, PartialEq)]
pub struct PulseTrain {
    /// Times of the pulses kept \[s\].
    pub times: Vec<f64>,
    /// Revolutions since the first pulse kept.
    pub revolutions: Vec<f64>,
    /// Pulses that were found missing and counted.
    pub missing: usize,
    /// Pulses that were found to be none and dropped.
    pub dropped: usize,
}

impl PulseTrain {
    /// Counts the shaft's turns from pulse times, with missing pulses added and false ones dropped.
    ///
    /// Of all ways to keep pulses and to give each interval a whole number n ≤ 6 of pitches, the one of least
    /// Σ |ln v_k/v_{k−1}| + 1.3 Σ ln n + dropped pulses, v = n/Δt: a gap within a run is bridged, a start from rest,
    /// whose first intervals halve from one to the next, is not. `times` \[s\] increasing, `per_revolution` pulses.
    /// Errors: NaN, times that do not increase, fewer than four pulses.
    pub fn new(times: &[f64], per_revolution: usize) -> Result<Self, SignalError> {
        check_record("pulse times", times)?;
        check_length("pulse times", times.len(), 4, "a speed that can be checked")?;
        check(per_revolution >= 1, "pulses per revolution", "one or more", per_revolution as f64)?;
        if let Some(index) = times.windows(2).position(|w| w[1] <= w[0]) {
            let expected = (times[times.len() - 1] - times[0]) / (times.len() - 1) as f64;
            return Err(SignalError::NonUniform { index, expected, given: times[index + 1] - times[index] });
        }
        let (kept, counts) = best_counts(times);
        let mut revolutions = vec![0.0];
        let mut total = 0;
        for count in &counts {
            total += count;
            revolutions.push(total as f64 / per_revolution as f64);
        }
        Ok(PulseTrain {
            missing: total - counts.len(),
            dropped: times.len() - kept.len(),
            times: kept.iter().map(|&k| times[k]).collect(),
            revolutions,
        })
    }

    /// Mean speed over each interval \[rpm\], and the interval's middle \[s\].
    pub fn speeds_rpm(&self) -> (Vec<f64>, Vec<f64>) {
        let intervals = self.times.windows(2).zip(self.revolutions.windows(2));
        intervals.map(|(t, r)| (0.5 * (t[0] + t[1]), 60.0 * (r[1] - r[0]) / (t[1] - t[0]))).unzip()
    }

    /// The same train with its jitter smoothed: each pulse's angle from a cubic through `2 half_width + 1` of them.
    ///
    /// Least squares over the pulses k − half_width .. k + half_width (fewer at the ends). White jitter of the angle
    /// falls by about √(0.44 (2 half_width + 1)). Errors: half width below 2 or a train too short for it.
    pub fn smoothed(&self, half_width: usize) -> Result<PulseTrain, SignalError> {
        check(half_width >= 2, "half width of the smoothing", "2 pulses or more", half_width as f64)?;
        check_length("pulse train", self.times.len(), 2 * half_width + 1, "this smoothing")?;
        let revolutions = (0..self.times.len()).map(|k| {
            let first = k.saturating_sub(half_width).min(self.times.len() - 2 * half_width - 1);
            let range = first..first + 2 * half_width + 1;
            let span = self.times[range.end - 1] - self.times[range.start];
            let mut normal = nalgebra::Matrix4::zeros();
            let mut right = nalgebra::Vector4::zeros();
            for i in range {
                let t = (self.times[i] - self.times[k]) / span;
                let row = nalgebra::Vector4::new(1.0, t, t * t, t * t * t);
                normal += row * row.transpose();
                right += row * (self.revolutions[i] - self.revolutions[k]);
            }
            // Five or more distinct times determine a cubic.
            let shift = normal.cholesky().map_or(0.0, |c| c.solve(&right)[0]);
            self.revolutions[k] + shift
        });
        Ok(PulseTrain { revolutions: revolutions.collect(), ..self.clone() })
    }

    /// Shaft angle \[rad\] at the samples of a record that lie between the first and the last pulse, and the first of them.
    ///
    /// Monotone cubic through the pulses' angles (PCHIP), 0 at the first pulse. `sample_rate` \[Hz\], `samples` of the
    /// record. Errors: no sample between the pulses.
    pub fn angle(&self, sample_rate: f64, samples: usize) -> Result<(Vec<f64>, usize), SignalError> {
        check_rate(sample_rate)?;
        let (first, last) = (self.times[0], self.times[self.times.len() - 1]);
        let from = (first * sample_rate).ceil().max(0.0) as usize;
        let end = ((last * sample_rate).floor() as usize + 1).min(samples);
        if last < 0.0 || from + 2 > end {
            let purpose = "a shaft angle between the first and the last pulse";
            return Err(SignalError::TooShort { name: "record", needed: from + 2, given: samples, purpose });
        }
        let turns = Pchip::new(&self.times, &self.revolutions).expect("the times of a train increase");
        let angle = (from..end).map(|n| std::f64::consts::TAU * turns.evaluate(n as f64 / sample_rate)[0]);
        Ok((angle.collect(), from))
    }
}

/// Pulses kept and the pitches between them: the cheapest path through intervals (Viterbi).
fn best_counts(times: &[f64]) -> (Vec<usize>, Vec<usize>) {
    // A state is the interval that ends at a pulse: how many pulses back it began, and how many pitches it holds.
    let states: Vec<(usize, usize)> =
        (1..=MOST_DROPPED + 1).flat_map(|back| (1..=MOST_PITCHES).map(move |count| (back, count))).collect();
    let repair =
        |(back, count): (usize, usize)| MISSING_COST * (count as f64).ln() + DROPPED_COST * (back - 1) as f64;
    let speed =
        |pulse: usize, (back, count): (usize, usize)| count as f64 / (times[pulse] - times[pulse - back]);
    // Cost of the best path to each state and the state before it; a path may drop the first pulses.
    let mut best: Vec<Vec<(f64, Option<usize>)>> = vec![Vec::new(); times.len()];
    for pulse in 0..times.len() {
        let mut row = vec![(f64::INFINITY, None); states.len()];
        for (entry, &state) in row.iter_mut().zip(&states) {
            let Some(before) = pulse.checked_sub(state.0) else { continue };
            if before <= MOST_DROPPED {
                *entry = (repair(state) + DROPPED_COST * before as f64, None);
            }
            let now = speed(pulse, state);
            for (index, &previous) in states.iter().enumerate() {
                let so_far = best[before][index].0;
                if so_far.is_infinite() {
                    continue;
                }
                let total = so_far + (now / speed(before, previous)).ln().abs() + repair(state);
                if total < entry.0 {
                    *entry = (total, Some(index));
                }
            }
        }
        best[pulse] = row;
    }
    // The last pulses may be dropped too.
    let ends = (0..=MOST_DROPPED).filter_map(|dropped| {
        let pulse = times.len().checked_sub(1 + dropped)?;
        let (state, (cost, _)) = best[pulse].iter().enumerate().min_by(|a, b| a.1.0.total_cmp(&b.1.0))?;
        Some((cost + DROPPED_COST * dropped as f64, pulse, state))
    });
    let (_, mut pulse, state) =
        ends.min_by(|a, b| a.0.total_cmp(&b.0)).expect("there is a last pulse, with states");
    let (mut kept, mut counts) = (vec![pulse], Vec::new());
    let mut next = Some(state);
    while let Some(state) = next {
        let (back, count) = states[state];
        next = best[pulse][state].1;
        pulse -= back;
        kept.push(pulse);
        counts.push(count);
    }
    kept.reverse();
    counts.reverse();
    (kept, counts)
}
