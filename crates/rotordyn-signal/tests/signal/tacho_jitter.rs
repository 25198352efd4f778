//! What jittered tacho pulses leave of a strong order beside it.

use std::f64::consts::{SQRT_2, TAU};

use rotordyn_signal::Complex;
use rotordyn_signal::order::{OrderSettings, OrderTracker};
use rotordyn_signal::order_tracks::{OrderTrack, OrderTracks, order_tracks};
use rotordyn_signal::tacho::{PulseTrain, lie_on_the_grid, rising_edges};
use rotordyn_signal::tacho_jitter::{Jitter, amplitude_kept};

use crate::{noise, sampled};

/// An order of 0.7 beside one of 10 over the angle of jittered pulses: what is read there is wrong by the leak that the
/// jitter of the pulses themselves tells, over many trains.
#[test]
fn leak_of_a_strong_order_by_tacho_jitter() {
    let (rate, speed, seconds) = (2000.0, 25.0, 12.0);
    let count = (rate * seconds) as usize;
    let angle = |n: usize| TAU * speed * n as f64 / rate;
    let record: Vec<f64> =
        (0..count).map(|n| 10.0 * (7.0 * angle(n)).cos() + 0.7 * (7.144 * angle(n) + 1.0).cos()).collect();
    let (mut squares, mut predicted, mut points) = (0.0, 0.0, 0.0);
    for seed in 1..=8 {
        // Uniform within ± 100 us: 0.00907 rad.
        let times: Vec<f64> = crate::noise(seed, (speed * seconds) as usize)
            .iter()
            .enumerate()
            .map(|(k, v)| (k as f64 + 0.5) / speed + 1e-4 * v)
            .collect();
        let train = PulseTrain::new(&times, 1).unwrap();
        let jitter = Jitter::of_pulses(&train).unwrap();
        let expected = TAU * speed * 1e-4 / 3f64.sqrt();
        // Of 300 pulses: ± 4 % (one standard deviation).
        assert!((jitter.angle / expected - 1.0).abs() < 0.16, "{jitter:?} {expected}");
        assert_eq!(jitter.pulses_per_revolution, 1.0);
        let (theta, first) = train.angle(rate, count).unwrap();
        let part = &record[first..first + theta.len()];
        let found = order_tracks(part, &theta, rate, &[7.0, 7.144], 0.15).unwrap();
        let leaks = jitter.leaks(&found, 0.1);
        assert_eq!(leaks.len(), 1, "{leaks:?}");
        assert_eq!((leaks[0].track, leaks[0].neighbour), (1, 0));
        predicted += leaks[0].leak.powi(2);
        // Against the phase that the first pulse leaves: its own jitter turns all.
        let weak = &found.tracks[1];
        let values: Vec<Complex<f64>> =
            weak.amplitude.iter().zip(&weak.phase).map(|(a, p)| Complex::from_polar(*a, *p)).collect();
        let mean = values.iter().sum::<Complex<f64>>() / values.len() as f64;
        squares += values.iter().map(|z| (z - mean).norm_sqr()).sum::<f64>() / values.len() as f64;
        points += 1.0;
    }
    let (read, predicted_rms) = ((squares / points).sqrt(), (predicted / points).sqrt());
    // The neighbour's own band takes a part, and the density of eight trains in 0.15 orders has few degrees of freedom.
    assert!((0.7..1.4).contains(&(read / predicted_rms)), "read {read}, predicted {predicted_rms}");
    println!("leak of 10 at 0.144 orders: read {read:.3}, predicted {predicted_rms:.3}");
}

/// Without jitter, and with orders further apart than pulses can tell, nothing leaks.
#[test]
fn no_leak_without_jitter() {
    let times: Vec<f64> = (0..40).map(|k| k as f64 / 25.0).collect();
    let jitter = Jitter::of_pulses(&PulseTrain::new(&times, 1).unwrap()).unwrap();
    assert!(jitter.angle < 1e-9, "{jitter:?}");
    assert_eq!(Jitter::of_pulses(&PulseTrain::new(&times[..17], 1).unwrap()), None);
    let tracks = |orders: [f64; 2]| OrderTracks {
        times: vec![0.0],
        rpm: vec![1500.0],
        tracks: [10.0, 0.1]
            .into_iter()
            .zip(orders)
            .map(|(a, order)| OrderTrack { order, amplitude: vec![a], phase: vec![0.0] })
            .collect(),
        bandwidth: 0.1,
        min_bandwidth_hz: 1.0,
        rms: [1.0, 0.0],
        smeared: Vec::new(),
    };
    let shaken = Jitter { angle: 0.02, pulses_per_revolution: 1.0 };
    assert_eq!(shaken.leaks(&tracks([7.0, 7.2]), 0.1).len(), 1);
    assert!(shaken.leaks(&tracks([7.0, 9.0]), 0.1).is_empty());
    assert!(jitter.leaks(&tracks([7.0, 7.2]), 0.1).is_empty());
}

/// A run-up with 10x whose pulses are known to a sample of 2, 1 and 0.5 ms: the loss of the cut is that stated, and smoothing
/// over four pulses takes four fifths of it back.
#[test]
fn a_coarse_tacho_lowers_high_orders() {
    let turns = |t: f64| 20.0 * t + 1.5 * t * t;
    let record = sampled(50_000, 5000.0, |t| SQRT_2 * (10.0 * TAU * turns(t)).cos());
    for tacho_rate in [500.0, 1000.0, 2000.0] {
        let pulse = |t: f64| if turns(t).fract() < 0.2 { 5.0 } else { 0.0 };
        let channel = sampled((10.0 * tacho_rate) as usize, tacho_rate, pulse);
        let train = PulseTrain::new(&rising_edges(&channel, tacho_rate, None, 0.2).unwrap(), 1).unwrap();
        assert!(lie_on_the_grid(&train.times, tacho_rate));
        let jitter = Jitter::of_pulses(&train).unwrap();
        let kept = |train: &PulseTrain| {
            let (angle, first) = train.angle(5000.0, record.len()).unwrap();
            let mut tracker = OrderTracker::new(&angle, 5000.0, OrderSettings::new(0.05, 12.0)).unwrap();
            let over_angle = tracker.resample(&[&record[first..first + angle.len()]]).unwrap();
            let cut = tracker.spectrogram(&over_angle[0]).cut(10.0, 0.05).unwrap();
            (cut.rms.iter().map(|v| v * v).sum::<f64>() / cut.rms.len() as f64).sqrt()
        };
        let raw = kept(&train);
        // Nearly white errors: within a twelfth.
        let stated = amplitude_kept(10.0, jitter.angle);
        assert!((stated / raw - 1.0).abs() < 0.08, "{tacho_rate}: {raw}, stated {stated}");
        let smooth = kept(&train.smoothed(4).unwrap());
        assert!(1.0 - smooth < 0.22 * (1.0 - raw), "{tacho_rate}: {raw} {smooth}");
    }
    // Pulses of a sine are interpolated.
    let sine = sampled(5000, 500.0, |t| (TAU * turns(t)).sin());
    assert!(!lie_on_the_grid(&rising_edges(&sine, 500.0, None, 0.2).unwrap(), 500.0));
}

/// A speed that swings by 10 % with a period of eight turns is no jitter of the pulses; jitter on it is found as without it.
#[test]
fn a_swinging_speed_is_no_jitter() {
    let angle = |t: f64| {
        25.0 * t - 25.0 * 0.1 / (std::f64::consts::TAU * 3.0) * (std::f64::consts::TAU * 3.0 * t).cos()
    };
    let deviation = 0.08;
    let random = noise(11, 600);
    let rms = (random.iter().map(|v| v * v).sum::<f64>() / 600.0).sqrt();
    for jitter in [0.0, deviation] {
        let times: Vec<f64> = (1..500)
            .map(|k| {
                let goal = k as f64 + random[k] * jitter / std::f64::consts::TAU;
                let mut t = goal / 25.0;
                (0..60).for_each(|_| t -= (angle(t) - goal) / 25.0);
                t
            })
            .collect();
        let found = Jitter::of_pulses(&PulseTrain::new(&times, 1).unwrap()).unwrap();
        assert!((found.angle - rms * jitter).abs() < 0.12 * deviation, "{jitter}: {}", found.angle);
    }
}
