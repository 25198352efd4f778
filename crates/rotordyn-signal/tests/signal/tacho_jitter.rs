//! What jittered tacho pulses leave of a strong order beside it.

use std::f64::consts::TAU;

use rotordyn_signal::Complex;
use rotordyn_signal::order_tracks::{OrderTrack, OrderTracks, order_tracks};
use rotordyn_signal::tacho::PulseTrain;
use rotordyn_signal::tacho_jitter::Jitter;

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
        let jitter = Jitter::of_pulses(&train).unwrap().unwrap();
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
    let jitter = Jitter::of_pulses(&PulseTrain::new(&times, 1).unwrap()).unwrap().unwrap();
    assert!(jitter.angle < 1e-9, "{jitter:?}");
    assert_eq!(Jitter::of_pulses(&PulseTrain::new(&times[..17], 1).unwrap()), Ok(None));
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
    };
    let shaken = Jitter { angle: 0.02, pulses_per_revolution: 1.0 };
    assert_eq!(shaken.leaks(&tracks([7.0, 7.2]), 0.1).len(), 1);
    assert!(shaken.leaks(&tracks([7.0, 9.0]), 0.1).is_empty());
    assert!(jitter.leaks(&tracks([7.0, 7.2]), 0.1).is_empty());
}
