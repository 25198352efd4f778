//! What the jitter of tacho pulses makes of a strong order at the places of weaker ones.
//!
//! With an angle that is off by δ the order A cos(νθ) becomes A cos(νθ) − A ν δ sin(νθ): δ modulates it, and what it has at
//! Δ cycles per revolution appears Δ orders beside ν. Jitter that differs from pulse to pulse is white up to half the
//! pulses per revolution.

use serde::{Deserialize, Serialize};
use std::f64::consts::TAU;

use super::SignalError;
use super::order_tracks::OrderTracks;
use super::tacho::PulseTrain;

/// Pulses on either side of the cubic that the jitter is measured against.
const HALF_WIDTH: usize = 4;
/// Weight of its own pulse in that cubic (Savitzky-Golay, nine points): the share of white jitter that it follows.
const OWN_WEIGHT: f64 = 59.0 / 231.0;
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
    /// Jitter of a train: its pulses against a cubic through each and its four neighbours on either side.
    ///
    /// σ = √(Σδ²/N / (1 − 59/231)) for white jitter; a speed that changes within four pulses counts as jitter too.
    /// `None` for fewer than 18 pulses. Errors: those of [`PulseTrain::smoothed`].
    pub fn of_pulses(train: &PulseTrain) -> Result<Option<Self>, SignalError> {
        let count = train.revolutions.len();
        if count < 4 * HALF_WIDTH + 2 {
            return Ok(None);
        }
        let smooth = train.smoothed(HALF_WIDTH)?;
        let inner = HALF_WIDTH..count - HALF_WIDTH;
        let squares = inner.clone().map(|k| (train.revolutions[k] - smooth.revolutions[k]).powi(2));
        let mean = squares.sum::<f64>() / inner.len() as f64;
        // Missing pulses make pitches of several.
        let pitch = train.revolutions.windows(2).map(|w| w[1] - w[0]).fold(f64::INFINITY, f64::min);
        Ok(Some(Self { angle: TAU * (mean / (1.0 - OWN_WEIGHT)).sqrt(), pulses_per_revolution: 1.0 / pitch }))
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
