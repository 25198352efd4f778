//! Samples that stand at a limit of their channel (clipping, overload).

use super::dropout::without_far_samples;

/// Heights below the largest value, over the range of the record, within which samples count as at the limit: the
/// highest admits noise behind the limit.
const HEIGHTS: [f64; 4] = [1e-4, 1e-3, 3e-3, 1e-2];
/// Share of the samples within four heights that are within one: half of a sine's are, nearly all of a clipped one's.
const SHARE: f64 = 0.8;
/// Largest share of the samples at a limit: with values far from all others the range is theirs, and all samples together are
/// near one end of it.
const MOST_AT_LIMIT: f64 = 0.75;
/// Least number of times that the record is at the limit, and of samples there each time.
const LEAST_TIMES: usize = 5;
const SAMPLES_EACH: usize = 3;
/// Least number of times where it stays there for fewer samples, and the least scatter of the samples before, over the
/// range: sampled in step with its period, a record has its maximum again and again too, but after the same samples.
const LEAST_SHORT_TIMES: usize = 12;
const SCATTER_BEFORE: f64 = 0.02;
/// Depth over the range to which a record falls between two times at the limit.
const LEAVES: f64 = 0.25;

/// A limit that a record does not exceed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Clipping {
    /// Value at which samples stand \[unit of the record\].
    pub limit: f64,
    pub samples: usize,
    /// How many times the record is at the limit.
    pub times: usize,
}

/// The limit of a channel, if its samples stand there again and again.
///
/// Near its maximum a smooth signal has n(h) ∝ √h samples within a height h, so that n(h)/n(4h) = ½; of a clipped one
/// both are the samples at the limit. `record` (N) of finite values. `None` for a record that is not clipped, or too
/// coarse (fewer than 200 steps of its converter) to tell.
pub fn clipping(record: &[f64]) -> Option<Clipping> {
    let plain = without_far_samples(record);
    let record = plain.as_deref().unwrap_or(record);
    let mut sorted = record.to_vec();
    sorted.sort_by(f64::total_cmp);
    let range = sorted.last()? - sorted.first()?;
    let gaps = sorted.windows(2).map(|w| w[1] - w[0]).filter(|gap| *gap > 1e-9 * range);
    // The largest values of a coarse converter are equal without being clipped.
    let step = gaps.fold(f64::INFINITY, f64::min);
    let heights = HEIGHTS.map(|h| h * range).into_iter().filter(|h| *h >= 2.0 * step);
    heights.into_iter().find_map(|height| {
        at_limit(record, &sorted, height, range, 1.0)
            .or_else(|| at_limit(record, &sorted, height, range, -1.0))
    })
}

/// Clipping at the largest value (`sign` 1) or the smallest (−1).
fn at_limit(record: &[f64], sorted: &[f64], height: f64, range: f64, sign: f64) -> Option<Clipping> {
    let limit = if sign > 0.0 { *sorted.last()? } else { *sorted.first()? };
    let below = |x: f64| sign * (limit - x);
    let within = |h: f64| match sign > 0.0 {
        true => sorted.len() - sorted.partition_point(|x| below(*x) > h),
        false => sorted.partition_point(|x| below(*x) <= h),
    };
    let samples = within(height);
    let is_most = samples as f64 > MOST_AT_LIMIT * sorted.len() as f64;
    if is_most || (samples as f64) < SHARE * within(4.0 * height) as f64 {
        return None;
    }
    let (mut before, mut armed) = (Vec::new(), true);
    for (k, x) in record.iter().enumerate() {
        if below(*x) > LEAVES * range {
            armed = true;
        } else if armed && below(*x) <= height {
            before.push(record[k.saturating_sub(1)]);
            armed = false;
        }
    }
    let times = before.len();
    let stays = times >= LEAST_TIMES && samples >= SAMPLES_EACH * times;
    let enough = stays || times >= LEAST_SHORT_TIMES && deviation(&before) > SCATTER_BEFORE * range;
    enough.then_some(Clipping { limit, samples, times })
}

/// Standard deviation.
fn deviation(values: &[f64]) -> f64 {
    let count = values.len().max(1) as f64;
    let mean = values.iter().sum::<f64>() / count;
    (values.iter().map(|v| (v - mean).powi(2)).sum::<f64>() / count).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    /// A sine of 0.37 periods per 10 samples whose amplitude grows, with uniform noise of ± `noise`.
    fn growing_sine(noise: f64) -> Vec<f64> {
        let mut state = 7u64;
        let mut uniform = || {
            state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            (state >> 11) as f64 / (1u64 << 52) as f64 - 1.0
        };
        let sample = |k: usize| (1.0 + k as f64 / 2e4) * (TAU * 0.037 * k as f64).sin();
        (0..20_000).map(|k| sample(k) + noise * uniform()).collect()
    }

    fn limited(record: &[f64], low: f64, high: f64) -> Vec<f64> {
        record.iter().map(|x| x.clamp(low, high)).collect()
    }

    #[test]
    fn limit_on_either_side_is_found() {
        for noise in [0.0, 0.05] {
            let record = growing_sine(noise);
            assert_eq!(clipping(&record), None);
            let found = clipping(&limited(&record, -9.0, 1.5)).unwrap();
            assert!(found.limit == 1.5 && found.times > 200 && found.samples > 3 * found.times, "{found:?}");
            assert_eq!(clipping(&limited(&record, -1.6, 9.0)).unwrap().limit, -1.6);
        }
    }

    /// Excursions of one or two samples: white noise and a tone near the Nyquist frequency in noise. Not clipped, none of
    /// a hundred records of noise is named.
    #[test]
    fn limit_of_short_excursions_is_found() {
        let mut state = 3u64;
        let mut uniform = || {
            state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            (state >> 11) as f64 / (1u64 << 53) as f64
        };
        let mut normal = move || (-2.0 * uniform().max(1e-12).ln()).sqrt() * (TAU * uniform()).cos();
        for tone in [0.0, 3.0] {
            for _ in 0..50 {
                let record: Vec<f64> =
                    (0..10_000).map(|k| tone * (TAU * 0.41 * k as f64).sin() + 0.5 * normal()).collect();
                assert_eq!(clipping(&record), None);
                let mut sorted = record.clone();
                sorted.sort_by(f64::total_cmp);
                let largest = sorted[9_970];
                let found = clipping(&limited(&record, -1e9, largest)).unwrap();
                assert!(found.limit == largest && found.samples < 3 * found.times, "{found:?}");
            }
        }
    }

    /// A periodic record sampled in step with its period has one sample at its maximum each time.
    #[test]
    fn maxima_in_step_with_the_sampling_are_no_limit() {
        let periodic = |k: usize| {
            let angle = TAU * k as f64 / 12.0;
            angle.cos() + 0.4 * (3.0 * angle).cos() + 0.2 * (5.0 * angle).cos()
        };
        assert_eq!(clipping(&(0..20_000).map(periodic).collect::<Vec<_>>()), None);
        let pulses: Vec<f64> =
            (0..20_000usize).map(|k| if k.is_multiple_of(97) { 5.0 } else { 0.0 }).collect();
        assert_eq!(clipping(&pulses), None);
    }

    /// Noise that a recorder adds behind an amplifier at its limit.
    #[test]
    fn limit_before_noise_is_found() {
        let noise = growing_sine(0.004);
        let clean = growing_sine(0.0);
        let soft: Vec<f64> = clean.iter().zip(&noise).map(|(x, n)| x.clamp(-9.0, 1.5) + n - x).collect();
        assert!((clipping(&soft).unwrap().limit - 1.5).abs() < 0.01);
    }

    /// Values for missing samples, and others far away, make no limit and hide none.
    #[test]
    fn values_far_from_all_others_are_no_limit() {
        for (runs, length) in [(4, 1), (20, 1), (5, 2), (12, 8)] {
            for value in [9999.0, -9999.0] {
                for limit in [9.0, 1.5] {
                    let mut record = limited(&growing_sine(0.01), -9.0, limit);
                    (0..runs).for_each(|run| record[900 * run + 300..900 * run + 300 + length].fill(value));
                    let found = clipping(&record).map(|found| found.limit);
                    assert_eq!(found, (limit == 1.5).then_some(limit), "{runs} {length} {value}");
                }
            }
        }
        let mut record = growing_sine(0.01);
        (0..20).for_each(|run| record[900 * run + 300] = 1000.0 + 50.0 * run as f64);
        assert_eq!(clipping(&record), None);
    }

    /// Quantised, steady and finely sampled sines have many equal largest values; so has a shaft at rest at its highest
    /// place. Noise has one largest value.
    #[test]
    fn equal_largest_values_are_no_limit() {
        for bits in [8, 12, 16, 24] {
            for period in [7.3, 41.9, 1203.0, 9876.5] {
                let full = f64::from(1 << (bits - 1));
                let record: Vec<f64> =
                    (0..100_000).map(|k| (0.9 * full * (TAU * k as f64 / period).sin()).round()).collect();
                assert_eq!(clipping(&record), None, "{bits} bits, {period}");
            }
        }
        let rest = (0..9000)
            .map(|k| if k < 5000 { 1.0 } else { 0.9 * (0.1 * f64::from(k)).sin() })
            .collect::<Vec<_>>();
        assert_eq!(clipping(&rest), None);
        let square: Vec<f64> = growing_sine(0.3).iter().map(|x| x * x).collect();
        assert_eq!(clipping(&square), None);
        assert_eq!(clipping(&[2.0; 50]), None);
        assert_eq!(clipping(&[]), None);
    }
}
