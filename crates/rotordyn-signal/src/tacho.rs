//! Shaft angle and speed from the pulses of a tacho, with pulses missing, added or shaken.

pub mod alias;
mod counts;
mod marked_counts;
pub mod marks;

use std::collections::VecDeque;

use super::SignalError;
use super::error::{check, check_length, check_rate, check_record};
use super::statistics::median;
use rotordyn_linalg::pchip::Pchip;

use counts::{MOST_PITCHES, best_counts};
use marked_counts::marked_counts;
use marks::Marks;

/// Typical intervals between pulses over which a channel has its local lowest and highest value.
const ENVELOPE_INTERVALS: f64 = 4.0;
/// Change of the middle between them over the span of a pulse, above which the level follows it.
const DRIFT: f64 = 0.15;
/// Samples in the time of a pulse below which pulses are not resolved.
const MIN_SAMPLES: f64 = 3.0;
/// Median relative change of speed from one interval to the next, and share of repaired pulses, above which together pulses
/// are not those of a shaft: noise has 0.2 and 0.25, a wheel of uneven teeth changes without repairs.
const MOST_CHANGE: f64 = 0.12;
const MOST_REPAIRS: f64 = 0.15;
/// Intervals on either side of a jump of speed, highest over lowest speed of a side, and deviation of a whole factor.
const JUMP_INTERVALS: usize = 4;
const STEADY: f64 = 1.15;
const WHOLE: f64 = 0.1;

/// Times at which a tacho channel rises through a level, by linear interpolation, with hysteresis.
///
/// `record` (N), `sample_rate` \[Hz\]. `level` `None` takes the middle between the 1 % and 99 % values, or, of a channel
/// that drifts by more than 0.15 of its pulses, the middle between the local extremes; after a pulse
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
    let edges =
        crossings(record, sample_rate, level.unwrap_or(0.5 * (low + high)), hysteresis * (high - low));
    if level.is_some() {
        return Ok(edges);
    }
    Ok(match without_drift(record, sample_rate, &edges) {
        Some((steady, span)) => crossings(&steady, sample_rate, 0.0, hysteresis * span),
        None => edges,
    })
}

/// Rising passages of a level, each after a value below it by `fall`.
fn crossings(record: &[f64], sample_rate: f64, level: f64, fall: f64) -> Vec<f64> {
    let rearm = level - fall;
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
    edges
}

/// A drifting channel less the middle between its local extremes, and the span of its pulses; `None` without drift.
///
/// Extremes over four typical intervals. Where they span less than half of the usual there is no pulse, and the middle is
/// that before (or behind).
fn without_drift(record: &[f64], sample_rate: f64, edges: &[f64]) -> Option<(Vec<f64>, f64)> {
    if edges.len() < 2 {
        return None;
    }
    let interval = median(edges.windows(2).map(|w| w[1] - w[0]).collect()) * sample_rate;
    let reach = (0.5 * ENVELOPE_INTERVALS * interval).ceil() as usize;
    if 8 * reach > record.len() {
        return None;
    }
    let high = running_maximum(record, reach);
    let negative: Vec<f64> = record.iter().map(|v| -v).collect();
    let low: Vec<f64> = running_maximum(&negative, reach).iter().map(|v| -v).collect();
    let spans: Vec<f64> = high.iter().zip(&low).map(|(h, l)| h - l).collect();
    let span = median(spans.clone());
    let has_pulse = |n: usize| spans[n] > 0.5 * span;
    let mut middle: Vec<f64> = high.iter().zip(&low).map(|(h, l)| 0.5 * (h + l)).collect();
    let mut sorted: Vec<f64> = (0..record.len()).filter(|n| has_pulse(*n)).map(|n| middle[n]).collect();
    sorted.sort_by(f64::total_cmp);
    let [from, to] = [0.05, 0.95].map(|share| sorted[(share * (sorted.len() - 1) as f64) as usize]);
    if to - from <= DRIFT * span {
        return None;
    }
    let mut last = middle[(0..record.len()).find(|n| has_pulse(*n))?];
    for (n, value) in middle.iter_mut().enumerate() {
        if has_pulse(n) {
            last = *value;
        }
        *value = last;
    }
    // The extremes go in steps: their mean over as many samples does not.
    let mut sums = vec![0.0];
    for value in &middle {
        sums.push(sums[sums.len() - 1] + value);
    }
    let steady = record.iter().enumerate().map(|(n, x)| {
        let (a, b) = (n.saturating_sub(reach), (n + reach + 1).min(record.len()));
        x - (sums[b] - sums[a]) / (b - a) as f64
    });
    Some((steady.collect(), span))
}

/// Largest value within `reach` samples on either side.
fn running_maximum(values: &[f64], reach: usize) -> Vec<f64> {
    // Places of values that are the largest of what follows, falling.
    let mut queue: VecDeque<usize> = VecDeque::new();
    let mut next = 0;
    (0..values.len())
        .map(|n| {
            while next < values.len().min(n + reach + 1) {
                while queue.back().is_some_and(|&k| values[k] <= values[next]) {
                    queue.pop_back();
                }
                queue.push_back(next);
                next += 1;
            }
            while queue.front().is_some_and(|&k| k + reach < n) {
                queue.pop_front();
            }
            queue.front().map_or(values[n], |&k| values[k])
        })
        .collect()
}

/// Whether pulse times \[s\] lie on the grid of the samples: steps that a channel sampled at this rate \[Hz\] shows no better.
///
/// The mean of e^(2πj f_s t) over the pulses, 1 on a grid and 1/√N without one, is above 0.9.
pub fn lie_on_the_grid(times: &[f64], sample_rate: f64) -> bool {
    let turn = |t: &f64| (std::f64::consts::TAU * (t * sample_rate).rem_euclid(1.0)).sin_cos();
    let [sine, cosine] = times.iter().map(turn).fold([0.0, 0.0], |sum, (s, c)| [sum[0] + s, sum[1] + c]);
    times.len() > 10 && sine.hypot(cosine) > 0.9 * times.len() as f64
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
    /// The marks of the wheel from that of the first pulse kept on, where they are not even.
    pub marks: Option<Marks>,
}

impl PulseTrain {
    /// Counts the shaft's turns from pulse times, with missing pulses added and false ones dropped.
    ///
    /// Of all ways to keep pulses and to give each interval a whole number n of pitches (up to 6, or what the speeds on both
    /// sides of a long gap make of it), the one of least Σ |ln v_k/v_{k−1}| + 1.3 Σ ln n + dropped pulses, v = n/Δt: a gap
    /// within a run is bridged, a start from rest, whose first intervals halve from one to the next, is not; where the same
    /// n > 1 goes on (every second pulse missing for a time), only its first interval costs 1.3 ln n. Marks that are not even in the same way in every revolution, as of a wheel with teeth
    /// left out, are counted where they are ([`Marks`]). `times` \[s\] increasing, `per_revolution` pulses, or pitches of such a wheel.
    /// Errors: NaN, times that do not increase, fewer than four pulses.
    pub fn new(times: &[f64], per_revolution: usize) -> Result<Self, SignalError> {
        check_record("pulse times", times)?;
        check_length("pulse times", times.len(), 4, "a speed that can be checked")?;
        check(per_revolution >= 1, "pulses per revolution", "one or more", per_revolution as f64)?;
        if let Some(index) = times.windows(2).position(|w| w[1] <= w[0]) {
            let expected = (times[times.len() - 1] - times[0]) / (times.len() - 1) as f64;
            return Err(SignalError::NonUniform { index, expected, given: times[index + 1] - times[index] });
        }
        let marked = Marks::of_pulses(times, per_revolution)
            .and_then(|marks| marked_counts(times, &marks).map(|found| (found, marks)));
        if let Some((found, mut marks)) = marked {
            marks.pitches.rotate_left(found.first_mark);
            let mut turned = 0;
            let mut revolutions = vec![0.0];
            for count in &found.counts {
                turned += count;
                revolutions.push(marks.turns(0, turned));
            }
            return Ok(PulseTrain {
                missing: turned - found.counts.len(),
                dropped: times.len() - found.kept.len(),
                times: found.kept.iter().map(|&k| times[k]).collect(),
                revolutions,
                marks: Some(marks),
            });
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
            marks: None,
        })
    }

    /// Why these are not the pulses of a shaft; `None` if they may be. `given`: pulses before repair.
    ///
    /// A speed that changes by a whole factor from one interval to the next. Repairs of more than half the pulses; or of more than a seventh with a speed that changes by 12 % from one interval to
    /// the next on the median: a start from rest does so over a few intervals only.
    pub fn implausible(&self, given: usize) -> Option<String> {
        let repairs = (self.missing + self.dropped) as f64 / given.max(1) as f64;
        let (_, speeds) = self.speeds_rpm();
        let mut changes: Vec<f64> = speeds.windows(2).map(|w| (w[1] / w[0]).ln().abs()).collect();
        changes.sort_by(f64::total_cmp);
        let change = changes.get(changes.len() / 2).copied().unwrap_or(0.0);
        if repairs <= 0.5 && (repairs <= MOST_REPAIRS || change <= MOST_CHANGE) {
            let (time, [before, after]) = self.whole_jump()?;
            return Some(format!(
                "its speed would change from {before:.0} to {after:.0} rpm from one pulse to the next at {time:.4} s: on one side \
                 pulses are missing one by one, or counted more than once; cut the record there, or mend the channel"
            ));
        }
        Some(format!(
            "of {given} pulses {} would be false and {} missing, and the speed would change by {:.0} % from one to the next: \
             this is no train of pulses of a shaft",
            self.dropped,
            self.missing,
            100.0 * change.exp_m1()
        ))
    }

    /// Time \[s\] and speeds \[rpm\] where the speed changes by a factor of two or another whole one (or its reciprocal) from one
    /// interval to the next, between parts of steady speed: no shaft does, but a train that loses every second pulse.
    fn whole_jump(&self) -> Option<(f64, [f64; 2])> {
        let (times, speeds) = self.speeds_rpm();
        let around = JUMP_INTERVALS..(speeds.len() + 1).saturating_sub(JUMP_INTERVALS);
        around.into_iter().find_map(|k| {
            let part = |speeds: &[f64]| {
                let [least, most] = [f64::min, f64::max].map(|of| speeds.iter().copied().reduce(of));
                let (least, most) = (least?, most?);
                (most < STEADY * least).then_some((least * most).sqrt())
            };
            let [before, after] =
                [part(&speeds[k - JUMP_INTERVALS..k])?, part(&speeds[k..k + JUMP_INTERVALS])?];
            let factor = (after / before).max(before / after);
            let whole = factor.round();
            (whole >= 2.0 && (factor / whole - 1.0).abs() < WHOLE)
                .then_some((0.5 * (times[k - 1] + times[k]), [before, after]))
        })
    }

    /// Times \[s\] between which pulses are missing for more than six pitches, and the turns between them.
    pub fn gaps(&self) -> Vec<([f64; 2], f64)> {
        let pitch = self.pitch();
        let pairs = self.times.windows(2).zip(self.revolutions.windows(2));
        let all = pairs.map(|(t, r)| ([t[0], t[1]], r[1] - r[0]));
        all.filter(|(_, turns)| *turns > (MOST_PITCHES as f64 + 0.5) * pitch).collect()
    }

    /// Turns from one pulse to the next.
    pub(super) fn pitch(&self) -> f64 {
        if let Some(marks) = &self.marks {
            return marks.pitch();
        }
        // Missing pulses make pitches of several.
        self.revolutions.windows(2).map(|w| w[1] - w[0]).fold(f64::INFINITY, f64::min)
    }

    /// Samples of a tacho channel in the time of a pulse, if so few that its pulses are not resolved: below 3 on the median.
    pub fn unresolved(&self, sample_rate: f64) -> Option<f64> {
        let pitch = self.pitch();
        let pairs = self.times.windows(2).zip(self.revolutions.windows(2));
        let mut samples: Vec<f64> =
            pairs.map(|(t, r)| (t[1] - t[0]) * sample_rate * pitch / (r[1] - r[0])).collect();
        samples.sort_by(f64::total_cmp);
        samples.get(samples.len() / 2).copied().filter(|samples| *samples < MIN_SAMPLES)
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
