//! What the jitter of tacho pulses makes of a strong order at the places of weaker ones.
//!
//! With an angle that is off by δ the order A cos(νθ) becomes A cos(νθ) − A ν δ sin(νθ): δ modulates it, and what it has at
//! Δ cycles per revolution appears Δ orders beside ν. Jitter that differs from pulse to pulse is white up to half the
//! pulses per revolution.

use serde::{Deserialize, Serialize};
use std::f64::consts::TAU;

use super::order_tracks::OrderTracks;
use super::tacho::PulseTrain;
use super::tacho::marks::MarkKind;

/// Pulses on either side of a cubic that jitter is measured against, and the weight of its own pulse in it (Savitzky-Golay,
/// nine points): the share of white jitter that it follows.
const HALF_WIDTH: usize = 4;
const OWN_WEIGHT: f64 = 59.0 / 231.0;
/// Orders of the differences that jitter is measured by.
const ORDERS: std::ops::RangeInclusive<usize> = 3..=6;
/// Least pulses of a train, and runs of them without a missing one.
const MIN_PULSES: usize = 18;
const MIN_RUNS: usize = 8;
/// Noise bandwidth over −3 dB bandwidth of the two-pole filter 1/(1 + (√2 − 1) u⁴), u = 2 Δ/B:
/// ½ (√2 − 1)^(−1/4) 3π/(4 √2).
const NOISE_BANDWIDTH: f64 = 1.038_3;

/// Jitter of a shaft angle from pulses.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Jitter {
    /// Standard deviation of the angle at the pulses \[rad\].
    pub angle: f64,
    pub pulses_per_revolution: f64,
}

/// A weak order with the part of a strong one that the jitter leaves there.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct JitterLeak {
    /// Places in the list of tracks: the order, and the stronger one beside it; twice the same for what an order loses itself.
    pub track: usize,
    pub neighbour: usize,
    /// RMS over the run of the amplitude read, and of what comes from the neighbour.
    pub amplitude: f64,
    pub leak: f64,
}

/// Share of the amplitude of an order ν that an angle with white errors of deviation σ \[rad\] at the pulses leaves,
/// e^(−ν²σ²/3).
///
/// Errors of a normal distribution leave e^(−ν²σ²/2); between two pulses, where the angle is interpolated, the mean square
/// is 2/3 of that at the pulses.
pub fn amplitude_kept(order: f64, deviation: f64) -> f64 {
    (-(order * deviation).powi(2) / 3.0).exp()
}

impl Jitter {
    /// Jitter of a train, from differences of its pulse times.
    ///
    /// σ = 2π p √(mean (Δᵈt/h)² / C(2d, d)), h the mean interval of the d + 1 pulses, p turns a pulse: for white jitter the same
    /// for every d, while a speed that swings within a few turns has ever less of it: the least of d = 3 to 6 and of the deviation from cubics
    /// (times rounded to samples are not white).
    /// Of marks that are not even the times are first taken to even ones.
    /// `None` for fewer than 18 pulses or 8 runs of 7 without a missing one.
    pub fn of_pulses(train: &PulseTrain) -> Option<Self> {
        let pitch = train.pitch();
        if train.times.len() < MIN_PULSES {
            return None;
        }
        let times = even_times(train);
        let of = |order: usize| {
            let mut weights = vec![1.0];
            for k in 0..order {
                weights.push(-weights[k] * (order - k) as f64 / (k + 1) as f64);
            }
            let runs = times.windows(order + 1).zip(train.revolutions.windows(order + 1));
            let whole = runs.filter(|(_, r)| r[order] - r[0] < (order as f64 + 0.5) * pitch);
            let squares: Vec<f64> = whole
                .map(|(t, _)| {
                    let first = t[0];
                    let difference: f64 = t.iter().zip(&weights).map(|(t, w)| (t - first) * w).sum();
                    (difference * order as f64 / (t[order] - t[0])).powi(2)
                })
                .collect();
            let norm: f64 = weights.iter().map(|w| w * w).sum();
            (squares.len() >= MIN_RUNS)
                .then(|| (squares.iter().sum::<f64>() / squares.len() as f64 / norm).sqrt())
        };
        let least = ORDERS.filter_map(of).reduce(f64::min)?;
        let angle = (TAU * pitch * least).min(Self::about_cubics(train).unwrap_or(f64::INFINITY));
        Some(Self { angle, pulses_per_revolution: 1.0 / pitch })
    }

    /// Deviation of the pulses' angles \[rad\] from a cubic through each and its four neighbours on either side,
    /// √(Σδ²/N / (1 − 59/231)).
    fn about_cubics(train: &PulseTrain) -> Option<f64> {
        let smooth = train.smoothed(HALF_WIDTH).ok()?;
        let inner = HALF_WIDTH..train.times.len() - HALF_WIDTH;
        let squares = inner.clone().map(|k| (train.revolutions[k] - smooth.revolutions[k]).powi(2));
        let mean = squares.sum::<f64>() / inner.len() as f64;
        Some(TAU * (mean / (1.0 - OWN_WEIGHT)).sqrt())
    }

    /// Standard deviation of the angle \[rad\] after smoothing by a cubic over `half_width` pulses on either side.
    ///
    /// σ √w with the weight w = 3 (3m² + 3m − 1)/((2m − 1)(2m + 1)(2m + 3)) of its own pulse in a cubic over 2m + 1 pulses
    /// (Savitzky-Golay), for white jitter.
    pub fn smoothed_angle(&self, half_width: usize) -> f64 {
        let m = half_width as f64;
        let weight =
            3.0 * (3.0 * m * m + 3.0 * m - 1.0) / ((2.0 * m - 1.0) * (2.0 * m + 1.0) * (2.0 * m + 3.0));
        self.angle * weight.min(1.0).sqrt()
    }

    /// RMS of what an order ν of RMS amplitude A leaves in a band of `width` orders beside it, ν A σ √(1.04 width/pulses).
    pub fn leak(&self, order: f64, amplitude: f64, width: f64) -> f64 {
        order * amplitude * self.angle * (NOISE_BANDWIDTH * width / self.pulses_per_revolution).sqrt()
    }

    /// For every order the most that another leaves there, if that is more than `share` of the amplitude read.
    ///
    /// Only orders within half the pulses per revolution of each other: the angle between pulses changes slowly.
    pub fn leaks(&self, found: &OrderTracks, share: f64) -> Vec<JitterLeak> {
        let rms: Vec<f64> = found
            .tracks
            .iter()
            .map(|track| {
                let squares: f64 = track.amplitude.iter().map(|a| a * a).sum();
                (squares / track.amplitude.len().max(1) as f64).sqrt()
            })
            .collect();
        let worst = |k: usize| {
            let order = found.tracks[k].order;
            let near = |&n: &usize| {
                n != k && (found.tracks[n].order - order).abs() <= 0.5 * self.pulses_per_revolution
            };
            let leaks = (0..rms.len()).filter(near).map(|n| JitterLeak {
                track: k,
                neighbour: n,
                amplitude: rms[k],
                leak: self.leak(found.tracks[n].order, rms[n], found.bandwidth),
            });
            leaks.reduce(|worst, other| if other.leak > worst.leak { other } else { worst })
        };
        let all = (0..rms.len()).filter_map(worst);
        all.filter(|found| found.leak > share * found.amplitude).collect()
    }
}

/// Pulse times \[s\] as they were at even marks: each moved by its mark's deviation at the mean speed of the revolution about it.
fn even_times(train: &PulseTrain) -> Vec<f64> {
    let uneven = train.marks.as_ref().filter(|marks| matches!(marks.kind, MarkKind::Uneven { .. }));
    let Some(marks) = uneven else { return train.times.clone() };
    let count = marks.pitches.len();
    let places: Vec<f64> = (0..=count).map(|mark| marks.turns(0, mark)).collect();
    let last = train.times.len() - 1;
    let moved = |k: usize| {
        let (from, to) = (k.saturating_sub(count.div_ceil(2)), (k + count.div_ceil(2)).min(last));
        let seconds =
            (train.times[to] - train.times[from]) / (train.revolutions[to] - train.revolutions[from]);
        let turn = train.revolutions[k].rem_euclid(1.0);
        let mark = (0..=count).min_by(|a, b| (places[*a] - turn).abs().total_cmp(&(places[*b] - turn).abs()));
        let mark = mark.unwrap_or(0);
        train.times[k] + (mark as f64 / count as f64 - places[mark]) * seconds
    };
    (0..=last).map(moved).collect()
}
