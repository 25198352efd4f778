//! Pulses sampled too slowly, told by the record that they belong to.
//!
//! Pulses at a rate p sampled at f_s look the same as pulses at |m f_s ± p|: a square wave sampled without a filter shows no
//! trace of it. The record of the same shaft does: it has 1x to 3x of the true speed, not of the apparent one.

use rotordyn_linalg::pchip::Pchip;
use rustfft::num_complex::Complex;
use std::f64::consts::TAU;

/// Samples of the record that are used, and the least number of apparent turns.
const SAMPLES: usize = 1 << 16;
const MIN_TURNS: f64 = 20.0;
/// Power in 1x to 3x of another speed over that between the orders, and over that of the apparent speed, for an alias.
const OVER_BACKGROUND: f64 = 200.0;
const OVER_APPARENT: f64 = 20.0;

/// Mean speed \[rev/s\] of which the pulses are an alias, if the record has the shaft orders of one, and none of the apparent.
///
/// `record` at `rate` \[Hz\]; pulses at `times` \[s\] from its first sample at `revolutions`, read from a channel sampled at
/// `pulse_rate` \[Hz\], `per_revolution` of them. Speeds up to a pulse rate of 2.5 `pulse_rate` are tried.
pub fn aliased_speed(
    record: &[f64],
    rate: f64,
    [times, revolutions]: [&[f64]; 2],
    pulse_rate: f64,
    per_revolution: usize,
) -> Option<f64> {
    let turns = Pchip::new(times, revolutions)?;
    let (start, end) = (*times.first()?, *times.last()?);
    let first = (start * rate).ceil().max(0.0) as usize;
    let last = ((end * rate).floor().max(0.0) as usize).min(record.len()).min(first.saturating_add(SAMPLES));
    let samples = record.get(first..last)?;
    let seconds = samples.len() as f64 / rate;
    let shown: Vec<f64> = (first..last).map(|n| turns.evaluate(n as f64 / rate)[0]).collect();
    if *shown.last()? - shown[0] < MIN_TURNS {
        return None;
    }
    let mean = samples.iter().sum::<f64>() / samples.len() as f64;
    let count = samples.len() as f64;
    let windowed: Vec<f64> = samples
        .iter()
        .enumerate()
        .map(|(n, x)| (x - mean) * (1.0 - (TAU * (n as f64 + 0.5) / count).cos()))
        .collect();
    let power = |turns: &[f64], order: f64| {
        let pairs = windowed.iter().zip(turns);
        pairs.map(|(x, turn)| Complex::from_polar(*x, -TAU * order * turn)).sum::<Complex<f64>>().norm_sqr()
    };
    // 1x to 3x over the median of what lies between the orders.
    let score = |turns: &[f64]| {
        let between = [0.41, 0.57, 0.68, 1.29, 1.44, 1.63, 2.31, 2.43, 2.58, 2.71, 3.33];
        let mut background: Vec<f64> = between.iter().map(|order| power(turns, *order)).collect();
        background.sort_by(f64::total_cmp);
        let lines: f64 = [1.0, 2.0, 3.0].iter().map(|order| power(turns, *order)).sum();
        lines / background[background.len() / 2].max(f64::MIN_POSITIVE)
    };
    let apparent = score(&shown);
    let other = |(multiple, sign): (f64, f64)| {
        let added = multiple * pulse_rate / per_revolution as f64;
        let turned =
            shown.iter().enumerate().map(|(n, turn)| added * n as f64 / rate + sign * (turn - shown[0]));
        let turned: Vec<f64> = turned.collect();
        let speed = turned.last()? / seconds;
        // Its orders up to the third must be in the record.
        if speed * 3.0 > 0.4 * rate || speed <= 0.0 {
            return None;
        }
        Some((score(&turned), speed))
    };
    let all = [(1.0, -1.0), (1.0, 1.0), (2.0, -1.0), (2.0, 1.0)].into_iter().filter_map(other);
    let (best, speed) = all.max_by(|a, b| a.0.total_cmp(&b.0))?;
    (best > OVER_BACKGROUND && best > OVER_APPARENT * apparent).then_some(speed)
}
