//! Channels that are dead, hold one value for a while, or have single samples that no signal has.

use std::collections::HashSet;

/// What is wrong with a channel by its samples alone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Dropout {
    /// Every sample has this value \[unit of the record\].
    Constant(f64),
    /// `samples` samples in succession, the first at `index`, have one value.
    Held { index: usize, samples: usize, value: f64 },
    /// `samples` single samples are `ratio` times as far from the median as any other; the first is at `index`.
    Spikes { index: usize, samples: usize, value: f64, ratio: f64 },
    /// `samples` samples, some in succession, have one value `ratio` times as far from the median as any other; the first
    /// is at `index`.
    FarValue { index: usize, samples: usize, value: f64, ratio: f64 },
}

/// Fewest equal samples in succession that count.
const LEAST_HELD: usize = 20;
/// Most gaps of one record; where there are more, values repeat by the nature of the signal.
const MOST_GAPS: usize = 5;
/// Length of a gap over that of the longest other run: quantised signals have runs of up to a few times the next one.
const LONGER: usize = 8;
/// Least step into or out of a gap, over the standard deviation outside: a motion comes to rest, or begins, without one.
const LEAST_STEP: f64 = 0.02;
/// The same over the smallest difference of two samples in succession, a step of the converter.
const LEAST_CONVERTER_STEPS: f64 = 2.5;
/// Distance from all other values over their range, from which a value at an end of the record is no rest.
const APART: f64 = 0.05;
/// Most single samples, and how many times as far from the median as any other they are.
const MOST_SPIKES: usize = 3;
const SPIKE_RATIO: f64 = 30.0;
/// Largest share of a record that has one value far from all others, such as −9999 for a value that is missing.
const MOST_FAR: f64 = 0.01;
/// Fewest samples among which one is absurd.
const LEAST_SAMPLES: usize = 100;

/// What is wrong with a channel; empty for one that may be right. `record` of finite values.
///
/// A run of equal values is no gap at the start (at rest, before a trigger) or at the value of the start, unless all else is
/// far from it; nor at the largest or smallest value (a limit, a square wave), unless the record ends there; nor in a signal of few levels (a tacho), where other runs are of its length (few steps of the converter), or if the
/// record leaves its value without a step (at rest).
pub fn dropouts(record: &[f64]) -> Vec<Dropout> {
    let Some(first) = record.first().filter(|_| record.len() > 1) else { return Vec::new() };
    if record.iter().all(|x| x == first) {
        return vec![Dropout::Constant(*first)];
    }
    held(record).into_iter().chain(spikes(record)).collect()
}

/// Runs of at least two equal samples: first index and length.
fn runs(record: &[f64]) -> Vec<(usize, usize)> {
    let mut found = Vec::new();
    let mut start = 0;
    for k in 1..=record.len() {
        if k == record.len() || record[k] != record[start] {
            if k - start > 1 {
                found.push((start, k - start));
            }
            start = k;
        }
    }
    found
}

/// The longest gap.
fn held(record: &[f64]) -> Option<Dropout> {
    let mut runs = runs(record);
    runs.sort_by_key(|(_, samples)| std::cmp::Reverse(*samples));
    let usual = runs.get(MOST_GAPS).map_or(1, |(_, samples)| *samples);
    let is_long = |samples: usize| samples >= LEAST_HELD.max(LONGER * usual);
    let at_start = |index: usize| index < LEAST_HELD;
    let rest = runs
        .iter()
        .find(|(index, samples)| at_start(*index) && is_long(*samples))
        .map(|(index, _)| record[*index]);
    let long: Vec<(usize, usize)> =
        runs.iter().copied().take(MOST_GAPS).filter(|(_, samples)| is_long(*samples)).collect();
    let is_outside = |k: usize| !long.iter().any(|(index, samples)| (*index..index + samples).contains(&k));
    let outside: Vec<f64> = if long.is_empty() {
        return None;
    } else {
        (0..record.len()).filter(|&k| is_outside(k)).map(|k| record[k]).collect()
    };
    // A signal of few levels switches between them.
    let repeated = outside.windows(2).filter(|pair| pair[0] == pair[1]).count();
    if 2 * repeated > outside.len() {
        return None;
    }
    let [low, high] = [f64::min, f64::max].map(|of: fn(f64, f64) -> f64| outside.iter().copied().reduce(of));
    let (low, high) = (low?, high?);
    let differences = record.windows(2).map(|pair| (pair[1] - pair[0]).abs()).filter(|d| *d > 0.0);
    let converter_step = differences.reduce(f64::min).unwrap_or(0.0);
    let step = (LEAST_STEP * deviation(&outside)).max(LEAST_CONVERTER_STEPS * converter_step);
    let is_gap = |&(index, samples): &(usize, usize)| {
        let value = record[index];
        let end = index + samples;
        let beyond = |k: Option<usize>| k.and_then(|k| record.get(k)).map_or(0.0, |x| (x - value).abs());
        let steps = beyond(index.checked_sub(1)).max(beyond(Some(end)));
        // Nothing else is near: no rest, and no limit that is reached again.
        let far = APART * (high - low);
        let is_apart = value > high + far || value < low - far;
        let alone = long.iter().filter(|(index, _)| record[*index] == value).count() == 1;
        if (at_start(index) || end == record.len()) && is_apart && alone {
            return steps > step;
        }
        // At a limit of the channel; a dead sensor of a channel with an offset is far from it.
        let at_limit = (value >= high && value <= high + 0.5 * (high - low))
            || (value <= low && value >= low - 0.5 * (high - low));
        !at_start(index) && rest != Some(value) && !at_limit && steps > step
    };
    long.iter().find(|run| is_gap(run)).map(|&(index, samples)| Dropout::Held {
        index,
        samples,
        value: record[index],
    })
}

/// Standard deviation.
fn deviation(values: &[f64]) -> f64 {
    let count = values.len().max(1) as f64;
    let mean = values.iter().sum::<f64>() / count;
    (values.iter().map(|v| (v - mean).powi(2)).sum::<f64>() / count).sqrt()
}

/// Samples far from all others, the farthest first, and how many times as far from the median as those.
///
/// Up to three, or more of one value.
struct Far {
    samples: Vec<usize>,
    ratio: f64,
}

fn far_samples(record: &[f64]) -> Option<Far> {
    if record.len() < LEAST_SAMPLES {
        return None;
    }
    let mut sorted = record.to_vec();
    let (_, median, _) = sorted.select_nth_unstable_by(record.len() / 2, f64::total_cmp);
    let median = *median;
    let distance = |k: usize| (record[k] - median).abs();
    let most = ((MOST_FAR * record.len() as f64) as usize).max(MOST_SPIKES);
    let mut far: Vec<usize> = (0..record.len()).collect();
    let farther = |a: &usize, b: &usize| distance(*b).total_cmp(&distance(*a));
    far.select_nth_unstable_by(most, farther);
    far.truncate(most + 1);
    far.sort_by(farther);
    (1..=most).find_map(|count| {
        let next = distance(far[count]);
        let ratio = distance(far[count - 1]) / next;
        let samples = &far[..count];
        let is_one = || samples.iter().all(|k| record[*k] == record[samples[0]]);
        // A record that is zero but for pulses of one sample is made so.
        let found = next > 0.0 && ratio >= SPIKE_RATIO && (count <= MOST_SPIKES || is_one());
        found.then(|| Far { samples: samples.to_vec(), ratio })
    })
}

/// Single samples far from all others, or samples of one value. Pulses last several samples, and shocks ring.
fn spikes(record: &[f64]) -> Option<Dropout> {
    let Far { samples: far, ratio } = far_samples(record)?;
    let index = far.iter().copied().min()?;
    let (samples, value) = (far.len(), record[index]);
    let are_single = || far.iter().all(|k| far.iter().all(|other| k.abs_diff(*other) != 1));
    if samples <= MOST_SPIKES && are_single() {
        return Some(Dropout::Spikes { index, samples, value, ratio });
    }
    let is_one = far.iter().all(|k| record[*k] == value);
    is_one.then_some(Dropout::FarValue { index, samples, value, ratio })
}

/// The record without samples that are far from all others.
pub(crate) fn without_far_samples(record: &[f64]) -> Option<Vec<f64>> {
    let far: HashSet<usize> = far_samples(record)?.samples.into_iter().collect();
    Some((0..record.len()).filter(|k| !far.contains(k)).map(|k| record[k]).collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    fn uniform(seed: u64) -> impl FnMut() -> f64 {
        let mut state = seed;
        move || {
            state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            (state >> 11) as f64 / (1u64 << 52) as f64 - 1.0
        }
    }

    fn noise(count: usize) -> Vec<f64> {
        let mut random = uniform(3);
        (0..count).map(|k| random() + (0.3 * k as f64).sin()).collect()
    }

    /// A record with one value from `from` for `samples` samples.
    fn with_gap(from: usize, samples: usize, value: f64) -> Vec<f64> {
        let mut record = noise(20_000);
        record[from..from + samples].fill(value);
        record
    }

    #[test]
    fn dead_channels_are_constant() {
        for value in [0.0, 3.0, -1e-9] {
            assert_eq!(dropouts(&[value; 500]), [Dropout::Constant(value)]);
        }
        for too_short in [&[][..], &[1.0]] {
            assert_eq!(dropouts(too_short), []);
        }
    }

    #[test]
    fn gaps_are_found() {
        let last = noise(20_000)[7000];
        for (from, samples, value) in [
            (7000, 2000, 0.0),
            (7000, 2000, last),
            (10_000, 10_000, 0.0),
            (100, 19_900, 0.0),
            (500, 25, 0.0),
            (900, 60, 40.0),
        ] {
            let found = dropouts(&with_gap(from, samples, value));
            let [Dropout::Held { index, samples: count, value: of }] = found[..] else {
                panic!("{from}: {found:?}")
            };
            assert!(index.abs_diff(from) <= 1 && count.abs_diff(samples) <= 1 && of == value, "{found:?}");
        }
        // The second of two gaps is the longer; of a channel with an offset zero lies below all values.
        let mut two = with_gap(7000, 200, 0.0);
        two[9000..9300].fill(0.5);
        assert!(matches!(dropouts(&two)[..], [Dropout::Held { index: 9000, samples: 300, .. }]));
        let mut offset: Vec<f64> = noise(20_000).iter().map(|x| x + 10.0).collect();
        offset[9000..9300].fill(0.0);
        assert!(matches!(dropouts(&offset)[..], [Dropout::Held { index: 9000, .. }]));
    }

    #[test]
    fn spikes_are_found() {
        for places in [&[3000][..], &[100, 9000], &[5, 50, 500]] {
            let mut record = noise(20_000);
            places.iter().for_each(|&k| record[k] = if k == 100 { -1e4 } else { 1e4 });
            let found = dropouts(&record);
            let [Dropout::Spikes { index, samples, ratio, .. }] = found[..] else { panic!("{found:?}") };
            assert!(index == places[0] && samples == places.len() && ratio > 1000.0, "{found:?}");
        }
        // Pulses of a hammer, of one sample and more, and a few large shocks that ring.
        let pulse = |width: f64| {
            (0..4000).map(|k| (-((f64::from(k) - 500.0) / width).powi(2)).exp()).collect::<Vec<_>>()
        };
        for record in [pulse(1.5), pulse(10.0), pulse(0.01)] {
            assert_eq!(dropouts(&record), []);
        }
        let mut random = uniform(9);
        let shocks: Vec<f64> = (0..8000)
            .map(|k| {
                0.02 * random() + 500.0 * (-0.02 * f64::from(k % 3000)).exp() * (1.3 * f64::from(k)).sin()
            })
            .collect();
        assert_eq!(dropouts(&shocks), []);
    }

    /// One value far from all others, in runs of a few samples and in more than three places. A tacho has two levels, a
    /// hammer's pulse at its limit has flanks.
    #[test]
    fn values_for_missing_samples_are_found() {
        for (runs, length) in [(1, 2), (1, 3), (1, 8), (4, 1), (20, 1), (5, 2), (3, 17)] {
            let mut record = noise(20_000);
            (0..runs).for_each(|run| record[700 * run + 300..700 * run + 300 + length].fill(-9999.0));
            let found = dropouts(&record);
            let [Dropout::FarValue { index: 300, samples, value: -9999.0, ratio }] = found[..] else {
                panic!("{runs} {length}: {found:?}")
            };
            assert!(samples == runs * length && ratio > 1000.0, "{found:?}");
        }
        let mut random = uniform(3);
        let pulses: Vec<f64> =
            (0..20_000).map(|k| if k % 4000 < 60 { 5.0 } else { 0.0 } + 0.01 * random()).collect();
        assert_eq!(dropouts(&pulses), []);
        let hit: Vec<f64> = (0..4000)
            .map(|k| (90.0 - (f64::from(k) - 500.0).powi(2)).clamp(0.0, 60.0) + 0.001 * random())
            .collect();
        assert_eq!(dropouts(&hit), []);
    }

    /// A channel that comes late or ends early at a value that the signal does not reach.
    #[test]
    fn gaps_at_the_ends_are_found() {
        for (from, samples, value) in
            [(0, 2000, 5.0), (0, 2000, -3.0), (18_000, 2000, 2.5), (15_000, 5000, -2.5)]
        {
            let found = dropouts(&with_gap(from, samples, value));
            assert_eq!(found, [Dropout::Held { index: from, samples, value }], "{from}");
        }
        // At rest at a limit: it begins and ends without a step.
        let lift: Vec<f64> = (0..9000)
            .map(|k| {
                if k < 2000 {
                    -4.0
                } else {
                    -4.0 * (-0.01 * f64::from(k - 2000)).exp() + 0.3 * (0.3 * f64::from(k - 2000)).sin()
                }
            })
            .collect();
        let dropped: Vec<f64> = lift.iter().rev().copied().collect();
        for record in [lift, dropped] {
            assert!(!matches!(dropouts(&record)[..], [Dropout::Held { .. }]));
        }
    }

    /// A vibration that decays into the last step of the converter, behind a first sample at another value too.
    #[test]
    fn decays_into_the_last_step_of_the_converter_are_no_gap() {
        for counts in [20.0, 100.0, 200.0, 400.0] {
            let decay = |k: usize| match k {
                0 => 1.0,
                1..2000 => 0.0,
                _ => (counts * (-0.002 * (k - 2000) as f64).exp() * (0.5 * k as f64).sin()).round(),
            };
            let record: Vec<f64> = (0..16_000).map(decay).collect();
            assert_eq!(dropouts(&record), [], "{counts}");
        }
    }

    /// Few steps of the converter, limits, square waves, doubled samples, pulses of a tacho.
    #[test]
    fn values_that_repeat_by_nature_are_no_gap() {
        for bits in [3, 4, 6, 8, 12] {
            for period in [7.3, 41.9, 1203.0, 9876.5] {
                let full = f64::from(1 << (bits - 1));
                let mut random = uniform(5);
                let record: Vec<f64> = (0..60_000)
                    .map(|k| (0.9 * full * (TAU * k as f64 / period).sin() + 0.05 * random()).round())
                    .collect();
                assert_eq!(dropouts(&record), [], "{bits} bits, {period}");
                let clean: Vec<f64> =
                    (0..60_000).map(|k| (0.9 * full * (TAU * k as f64 / period).sin()).round()).collect();
                assert_eq!(dropouts(&clean), [], "{bits} bits, {period}");
            }
        }
        let square: Vec<f64> = (0..9000).map(|k| if (k / 1300) % 2 == 0 { 1.0 } else { -1.0 }).collect();
        assert_eq!(dropouts(&square), []);
        let limited: Vec<f64> =
            (0..20_000).map(|k| (3.0 * (TAU * k as f64 / 5000.0).sin()).clamp(-1.0, 1.0)).collect();
        assert_eq!(dropouts(&limited), []);
        let doubled: Vec<f64> = noise(9000).iter().flat_map(|x| [*x; 30]).collect();
        assert_eq!(dropouts(&doubled), []);
        let tacho: Vec<f64> = (0..20_000).map(|k| if k % 4100 < 60 { 5.0 } else { 0.02 }).collect();
        assert_eq!(dropouts(&tacho), []);
    }

    /// At rest at the start, at rest again, and a stop in between: a motion begins and ends without a step.
    #[test]
    fn rest_is_no_gap() {
        let swing = |k: i32, from: i32| {
            0.001 * f64::from(k - from).powi(2).min(1000.0) * (0.2 * f64::from(k - from)).sin()
        };
        let start: Vec<f64> =
            (0..9000).map(|k| if k < 3000 { 0.25 } else { 0.25 + swing(k, 3000) }).collect();
        assert_eq!(dropouts(&start), []);
        let stop: Vec<f64> = (0..9000)
            .map(|k| match k {
                0..3000 => swing(3000, k),
                3000..5000 => 0.0,
                _ => swing(k, 5000),
            })
            .collect();
        assert_eq!(dropouts(&stop), []);
        // A force before and after a hit, and an answer that begins with one.
        let hit: Vec<f64> =
            (0..4000).map(|k| if (900..930).contains(&k) { f64::from(k - 890) } else { 0.0 }).collect();
        assert_eq!(dropouts(&hit), []);
        let answer: Vec<f64> =
            (0..4000).map(|k| if k < 900 { 0.0 } else { (0.3 * f64::from(k)).cos() }).collect();
        assert_eq!(dropouts(&answer), []);
    }
}
