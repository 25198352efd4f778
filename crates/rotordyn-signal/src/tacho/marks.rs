//! Marks of a tacho wheel that are not even, as their pulses show: teeth left out, or marks at uneven angles.
//!
//! Between a pulse and that of the same mark one revolution later the shaft turns once, wherever the mark is. So the
//! interval between two pulses over the time of the revolution about it is the pitch of these marks in turns, and it is
//! the same in every revolution.

use crate::statistics::median;

/// Fewest revolutions from which marks are told, most marks that are looked at.
const LEAST_REVOLUTIONS: usize = 10;
const MOST_MARKS: usize = 400;
/// Revolutions of a part, the pitches of which are medians, and the fewest parts.
const PART_REVOLUTIONS: usize = 8;
const LEAST_PARTS: usize = 5;
/// Share of the parts that must have the same pitches.
const AGREEING: f64 = 0.7;
/// Parts for each one that may be turned against the one before it: pulses are rarely missing.
const TURNED: usize = 3;
/// Deviation of a part's difference from even pitches from the common one, over that, up to which it has the same.
const DEVIATION: f64 = 0.5;
/// What pitches differ from even ones over their standard error, from which they are told.
const SIGNIFICANT: f64 = 5.0;
/// Angle of a mark from its even place \[turns\] from which it is corrected: 1°, the jitter by which 10x leaks 10 %.
const UNEVEN: f64 = 1.0 / 360.0;
/// Marks from which swings of the shaft within a turn, which are smooth, are told from marks at wrong places, which are not.
const MANY_MARKS: usize = 8;
/// Mean square difference of the deviations of neighbouring marks over their mean square: 2 where they are independent.
const INDEPENDENT: f64 = 1.0;
/// Fewest marks of a wheel with teeth left out, and the share of its intervals that may be longer.
const LEAST_TEETH: usize = 3;
const MOST_GAPS: f64 = 0.34;
/// Deviation of a pitch from a whole number of them.
const WHOLE: f64 = 0.2;
/// Most marks a turn that are looked for where one is stated, and the least relative change of their pitches.
const MOST_PER_TURN: usize = 6;
const CHANGE_PER_TURN: f64 = 0.06;

/// Marks of a wheel that are not even.
#[derive(Clone, Debug, PartialEq)]
pub struct Marks {
    /// Turns from each mark to the next, 1 in sum.
    pub pitches: Vec<f64>,
    pub kind: MarkKind,
}

/// Why marks are not even.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum MarkKind {
    /// A wheel of `pitches` pitches with `missing` teeth left out.
    TeethLeftOut { pitches: usize, missing: usize },
    /// The mark that is farthest from its even place is off by this \[turns\].
    Uneven { deviation: f64 },
}

impl Marks {
    /// The marks of a wheel whose pulses come at `times`, if they are not even; `per_revolution` is the number of its pitches
    /// or of its marks.
    ///
    /// `None` too for marks that differ smoothly over more than seven of them: that is the shaft, which swings within its turns.
    pub fn of_pulses(times: &[f64], per_revolution: usize) -> Option<Self> {
        Self::teeth_left_out(times, per_revolution).or_else(|| Self::uneven(times, per_revolution))
    }

    fn teeth_left_out(times: &[f64], per_revolution: usize) -> Option<Self> {
        let counts = times.len().checked_sub(1).filter(|count| *count >= 2 * LEAST_REVOLUTIONS)?;
        let long = mean_count(times);
        let real = (per_revolution as f64 / long).round() as usize;
        let candidates = [real, per_revolution];
        let wheel = |marks: usize| {
            if !(LEAST_TEETH..=MOST_MARKS).contains(&marks) || marks > counts {
                return None;
            }
            let found = pattern(times, marks)?;
            let pitches = match marks < per_revolution {
                true => per_revolution,
                false => (1.0 / median(found.clone())).round() as usize,
            };
            let counts: Vec<f64> = found.iter().map(|pitch| (pitch * pitches as f64).round()).collect();
            let deviation = |(pitch, count): (&f64, &f64)| (pitch * pitches as f64 - count).abs();
            let are_whole = found.iter().zip(&counts).all(|pair| deviation(pair) < WHOLE);
            let gaps = counts.iter().filter(|count| **count > 1.0).count();
            let is_wheel = are_whole
                && counts.iter().sum::<f64>() == pitches as f64
                && gaps > 0
                && gaps as f64 <= MOST_GAPS * marks as f64;
            is_wheel.then(|| Marks {
                pitches: counts.iter().map(|count| count / pitches as f64).collect(),
                kind: MarkKind::TeethLeftOut { pitches, missing: pitches - marks },
            })
        };
        candidates.into_iter().filter(|_| long > 1.0).find_map(wheel)
    }

    fn uneven(times: &[f64], marks: usize) -> Option<Self> {
        if !(2..=MOST_MARKS).contains(&marks) {
            return None;
        }
        let pitches = pattern(times, marks)?;
        // Places of the marks from even ones, which are about them.
        let mut place = 0.0;
        let mut off = Vec::with_capacity(marks);
        for (k, pitch) in pitches.iter().enumerate() {
            off.push(place - k as f64 / marks as f64);
            place += pitch;
        }
        let mean = off.iter().sum::<f64>() / marks as f64;
        let deviation = off.iter().map(|d| (d - mean).abs()).fold(0.0, f64::max);
        let squares: f64 = off.iter().map(|d| (d - mean).powi(2)).sum();
        let steps: f64 = (0..marks).map(|k| (off[(k + 1) % marks] - off[k]).powi(2)).sum();
        let is_shaft = marks >= MANY_MARKS && steps < INDEPENDENT * squares;
        (deviation >= UNEVEN && !is_shaft).then_some(Marks { pitches, kind: MarkKind::Uneven { deviation } })
    }

    /// Mean turns from one pulse to the next, those between two teeth where teeth are left out.
    pub(super) fn pitch(&self) -> f64 {
        match self.kind {
            MarkKind::TeethLeftOut { pitches, .. } => 1.0 / pitches as f64,
            MarkKind::Uneven { .. } => 1.0 / self.pitches.len() as f64,
        }
    }

    /// Turns from mark `from` over `count` marks.
    pub fn turns(&self, from: usize, count: usize) -> f64 {
        let marks = self.pitches.len();
        let rest: f64 = (0..count % marks).map(|k| self.pitches[(from + k) % marks]).sum();
        (count / marks) as f64 + rest
    }
}

/// How many marks a turn pulses have that are stated to be one a turn, if their intervals alternate by more than 6 %.
pub fn marks_per_turn(times: &[f64]) -> Option<usize> {
    (2..=MOST_PER_TURN).find(|marks| {
        let change = |pitch: &f64| (pitch * *marks as f64 - 1.0).abs();
        pattern(times, *marks)
            .is_some_and(|pitches| pitches.iter().map(change).fold(0.0, f64::max) > CHANGE_PER_TURN)
    })
}

/// Mean of the intervals in whole numbers of those around them.
fn mean_count(times: &[f64]) -> f64 {
    let intervals: Vec<f64> = times.windows(2).map(|w| w[1] - w[0]).collect();
    let count = |k: usize| {
        let around = k.saturating_sub(4)..(k + 5).min(intervals.len());
        (intervals[k] / median(intervals[around].to_vec())).round().max(1.0)
    };
    (0..intervals.len()).map(count).sum::<f64>() / intervals.len() as f64
}

/// Each interval over the time of the revolution about it, of those with a revolution about them.
fn shares(times: &[f64], marks: usize) -> Vec<f64> {
    let revolution = |first: usize| times[first + marks] - times[first];
    // An even number of marks has no interval in its middle: the mean of both windows takes a steady change of speed out.
    let half = marks / 2;
    (half..times.len().saturating_sub(half + 1))
        .filter_map(|k| {
            let first = k - half;
            let last = if marks.is_multiple_of(2) { first + 1 } else { first };
            (last + marks < times.len())
                .then(|| (times[k + 1] - times[k]) / (0.5 * (revolution(first) + revolution(last))))
        })
        .collect()
}

/// Turns from each of `marks` marks to the next, if they are not even and the same in nearly all of the record.
///
/// Medians of parts of the record; a pulse that is missing or false turns the marks of the parts behind it, so that each part
/// is turned to fit the one of least scatter. `None` where fewer than 70 % fit, where they turn again and again, or where the
/// difference from even marks is below five standard errors.
fn pattern(times: &[f64], marks: usize) -> Option<Vec<f64>> {
    let shares = shares(times, marks);
    let revolutions = shares.len() / marks;
    if revolutions < LEAST_REVOLUTIONS {
        return None;
    }
    let length = (revolutions / LEAST_PARTS).min(PART_REVOLUTIONS) * marks;
    let of_part = |part: &[f64]| {
        let at = |j: usize| median(part.iter().skip(j).step_by(marks).copied().collect());
        let pitches: Vec<f64> = (0..marks).map(at).collect();
        let scatter: f64 = part.iter().enumerate().map(|(k, share)| (share - pitches[k % marks]).abs()).sum();
        (pitches, scatter)
    };
    let parts: Vec<(Vec<f64>, f64)> = shares.chunks_exact(length).map(of_part).collect();
    let (reference, _) = parts.iter().min_by(|a, b| a.1.total_cmp(&b.1))?;
    let even = 1.0 / marks as f64;
    let square: f64 = reference.iter().map(|pitch| (pitch - even).powi(2)).sum();
    // Share of the reference's difference from even marks that a part has, turned by some marks.
    let share = |pitches: &[f64], turned: usize| -> f64 {
        let both = reference.iter().enumerate();
        both.map(|(j, r)| (pitches[(j + turned) % marks] - even) * (r - even)).sum::<f64>() / square
    };
    let fit = |(pitches, _): &(Vec<f64>, f64)| {
        let all = (0..marks).map(|turned| (share(pitches, turned), turned));
        let (most, turned) = all.max_by(|a, b| a.0.total_cmp(&b.0))?;
        ((most - 1.0).abs() < DEVIATION)
            .then(|| (turned, (0..marks).map(|j| pitches[(j + turned) % marks]).collect::<Vec<f64>>()))
    };
    let fitted: Vec<(usize, Vec<f64>)> = parts.iter().filter_map(fit).collect();
    let turns = fitted.windows(2).filter(|pair| pair[0].0 != pair[1].0).count();
    if (fitted.len() as f64) < AGREEING * parts.len() as f64 || turns > (fitted.len() / TURNED).max(1) {
        return None;
    }
    let of_mark = |j: usize| fitted.iter().map(|(_, pitches)| pitches[j]).collect::<Vec<f64>>();
    let mut pitches: Vec<f64> = (0..marks).map(|j| median(of_mark(j))).collect();
    let error = |j: usize| {
        let deviations = of_mark(j).iter().map(|pitch| (pitch - pitches[j]).abs()).collect();
        (1.4826 * median(deviations)).powi(2) / fitted.len() as f64
    };
    let errors = (0..marks).map(error).sum::<f64>().sqrt();
    let difference = pitches.iter().map(|pitch| (pitch - even).powi(2)).sum::<f64>().sqrt();
    // Rounding of the times themselves is no difference.
    if difference <= SIGNIFICANT * errors || difference < 1e-9 {
        return None;
    }
    let sum: f64 = pitches.iter().sum();
    pitches.iter_mut().for_each(|pitch| *pitch /= sum);
    Some(pitches)
}
