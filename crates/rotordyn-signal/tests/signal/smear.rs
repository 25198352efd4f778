//! Maxima of orders that a window or a bandwidth lowers.

use std::f64::consts::TAU;

use rotordyn_signal::Complex;
use rotordyn_signal::order::{OrderSettings, OrderTracker};
use rotordyn_signal::order_tracks::order_tracks;

use crate::{noise, sampled};

const RATE: f64 = 2000.0;

/// Shaft from 20 to 50 rev/s in `seconds`: its angle.
fn shaft(seconds: f64) -> Vec<f64> {
    sampled((seconds * RATE) as usize, RATE, |t| TAU * (20.0 * t + 15.0 * t * t / seconds))
}

/// 1x as large as the dynamic magnification at 35 Hz with this quality factor.
fn resonance(theta: &[f64], seconds: f64, quality: f64) -> (Vec<f64>, f64) {
    let amplitude = |n: usize| {
        let ratio = (20.0 + 30.0 * n as f64 / RATE / seconds) / 35.0;
        Complex::new(1.0 - ratio * ratio, ratio / quality).inv()
    };
    let record = theta.iter().enumerate();
    let highest = (0..theta.len()).map(|n| amplitude(n).norm()).fold(0.0, f64::max);
    (record.map(|(n, a)| (amplitude(n) * Complex::from_polar(1.0, *a)).re).collect(), highest)
}

/// Loss of the cut of `order` at its maximum against `highest`, and the loss named.
fn cut(theta: &[f64], record: &[f64], order: f64, resolution: f64, highest: f64) -> (f64, Option<f64>) {
    let mut tracker = OrderTracker::new(theta, RATE, OrderSettings::new(resolution, 10.0)).unwrap();
    let angle = tracker.resample(&[record]).unwrap();
    let cut = tracker.spectrogram(&angle[0]).cut(order, resolution).unwrap();
    let found = tracker.smear(&angle[0], &cut);
    let reached = 2f64.sqrt() * cut.rms.iter().copied().fold(0.0, f64::max);
    (1.0 - reached / highest, found.map(|found| found.loss))
}

/// Passages from slow to fast: named where the window takes more than 12 %, not where it takes less than 8 %, and by no more
/// than it is.
#[test]
fn a_window_that_is_too_long_for_a_resonance_is_named() {
    for seconds in [10.0, 30.0] {
        let theta = shaft(seconds);
        for quality in [5.0, 10.0, 20.0, 30.0, 50.0, 100.0, 200.0] {
            let (record, highest) = resonance(&theta, seconds, quality);
            for resolution in [0.05, 0.1, 0.2] {
                let (loss, named) = cut(&theta, &record, 1.0, resolution, highest);
                let text = format!("{seconds} s, Q {quality}, {resolution}: {loss} {named:?}");
                assert!(named.is_some() || loss < 0.12, "{text}");
                assert!(named.is_none_or(|_| loss > 0.08), "{text}");
                assert!(named.is_none_or(|named| named < loss + 0.03), "{text}");
            }
        }
    }
}

/// The same by a Vold-Kalman filter, where the loss is told to 0.05.
#[test]
fn a_bandwidth_that_is_too_narrow_for_a_resonance_is_named() {
    for quality in [10.0, 30.0, 100.0] {
        let theta = shaft(20.0);
        let (record, highest) = resonance(&theta, 20.0, quality);
        for bandwidth in [0.02, 0.05, 0.1, 0.3] {
            let found = order_tracks(&record, &theta, RATE, &[1.0], bandwidth).unwrap();
            let reached = found.tracks[0].amplitude.iter().copied().fold(0.0, f64::max);
            let (loss, named) = (1.0 - reached / highest, found.smeared.first().map(|s| s.loss));
            let text = format!("Q {quality}, {bandwidth}: {loss} {named:?}");
            assert!(named.is_some() || loss < 0.11, "{text}");
            assert!(named.is_none_or(|named| (named - loss).abs() < 0.05), "{text}");
            assert!(found.smeared.iter().all(|s| (s.rpm - 2100.0).abs() < 60.0), "{text}");
        }
    }
}

/// Constant and growing orders, a neighbouring line, one off its order, and noise lose nothing by their window.
#[test]
fn smooth_runs_neighbours_and_noise_are_not_named() {
    let theta = shaft(20.0);
    let quiet = |x: &[f64], order: f64, text: &str| {
        assert_eq!(cut(&theta, x, order, 0.05, 1.0).1, None, "{text}");
        let found = order_tracks(x, &theta, RATE, &[order], 0.1).unwrap();
        assert_eq!(found.smeared, [], "{text}");
    };
    let of = |f: &dyn Fn(f64, f64) -> f64| -> Vec<f64> {
        theta.iter().enumerate().map(|(n, a)| f(n as f64 / theta.len() as f64, *a)).collect()
    };
    quiet(&of(&|_, a| a.cos()), 1.0, "constant");
    quiet(&of(&|u, a| (20.0 + 30.0 * u).powi(2) * a.cos()), 1.0, "growing");
    quiet(&of(&|_, a| (7.0 * a).cos() + 0.5 * (7.144 * a).cos()), 7.0, "neighbour");
    quiet(&of(&|_, a| 0.05 * (7.0 * a).cos() + (7.144 * a).cos()), 7.0, "strong neighbour");
    assert_eq!(cut(&theta, &of(&|_, a| (3.575 * a).cos()), 3.55, 0.05, 1.0).1, None);
    for seed in 1..=30 {
        let rough = noise(seed, theta.len());
        for level in [0.0, 0.1, 1.0] {
            let x: Vec<f64> = theta.iter().zip(&rough).map(|(a, n)| level * a.cos() + n).collect();
            quiet(&x, 1.0, &format!("noise {seed} {level}"));
        }
    }
}
