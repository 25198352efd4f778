//! Tacholess speed and shaft angle, from an order line of the record.

use std::f64::consts::TAU;

use rotordyn_signal::order::{OrderSettings, OrderTracker};
use rotordyn_signal::ridge::find_peaks;
use rotordyn_signal::tacholess::{SpeedLineSettings, extract_ridge, speed_from_line};

use crate::{assert_close, noise, sampled};

const RATE: f64 = 4000.0;

/// Revolutions of a shaft from 10 to 34 rev/s with a speed fluctuation of ±0.5 rev/s.
fn turns(t: f64) -> f64 {
    10.0 * t + 1.5 * t * t + 0.5 / (TAU * 0.7) * (1.0 - (TAU * 0.7 * t).cos())
}

fn speed(t: f64) -> f64 {
    10.0 + 3.0 * t + 0.5 * (TAU * 0.7 * t).sin()
}

const LINE: SpeedLineSettings =
    SpeedLineSettings { order: 4.0, low: 30.0, high: 150.0, max_sweep_rate: 40.0, frame: 1024 };

/// A run-up with orders 4 and 7.14 and a fixed resonance line that crosses order 4; noise as strong as the tone.
fn record() -> Vec<f64> {
    let rough = noise(4, 32_000);
    sampled(32_000, RATE, |t| {
        let a = TAU * turns(t);
        2.0 * (4.0 * a).cos() + 0.5 * (7.14 * a).cos() + 0.5 * (TAU * 75.0 * t).cos()
    })
    .iter()
    .zip(&rough)
    .map(|(x, r)| x + r)
    .collect()
}

#[test]
fn angle_and_speed_follow_the_line() {
    let got = speed_from_line(&record(), RATE, &LINE).unwrap();
    assert_eq!(got.theta[0], 0.0);
    // The crossing 75 Hz line, a quarter as strong, shifts the phase by up to 1/4 rad, 0.01 revolutions.
    let offset = got.theta[4000] / TAU - turns(1.0);
    for n in (600..31_400).step_by(10) {
        let t = n as f64 / RATE;
        assert_close("turns", got.theta[n] / TAU, turns(t) + offset, 0.02);
    }
    for n in (1000..31_000).step_by(500) {
        // Mean over a tenth of a second, to average out the noise of single samples.
        let mean = got.rpm[n - 200..=n + 200].iter().sum::<f64>() / 401.0;
        assert_close("rpm", mean, 60.0 * speed(n as f64 / RATE), 20.0);
    }
}

/// Resampled by the estimated angle, the orders are sharp lines.
#[test]
fn tacholess_order_tracking() {
    let x = record();
    let got = speed_from_line(&x, RATE, &LINE).unwrap();
    let mut tracker = OrderTracker::new(&got.theta, RATE, OrderSettings::new(0.05, 10.0)).unwrap();
    let angle = tracker.resample(&[&x]).unwrap();
    let map = tracker.spectrogram(&angle[0]);
    let average = map.average(700.0, 1900.0).unwrap();
    let peaks = find_peaks(&map.orders, &average, 0.25).unwrap();
    let places: Vec<f64> = peaks.iter().map(|p| p.position).collect();
    assert_eq!(places.len(), 2, "{peaks:?}");
    assert_close("order", places[0], 4.0, 0.01);
    assert_close("order", places[1], 7.14, 0.01);
    assert_close("amplitude", peaks[0].amplitude, 2.0, 0.1);
    assert_close("amplitude", peaks[1].amplitude, 0.5, 0.06);
}

/// A short stronger line and rows without the ridge do not divert the path.
#[test]
fn ridge_by_dynamic_programming() {
    let axis: Vec<f64> = (0..60).map(f64::from).collect();
    let place = |row: usize| 10 + row;
    let mut map = vec![0.1; 40 * 60];
    for row in 0..40 {
        if ![12, 13].contains(&row) {
            map[row * 60 + place(row)] = 1.0;
        }
    }
    // Twice as high, but too far away for so short a time.
    map[20 * 60 + 50] = 2.0;
    map[21 * 60 + 50] = 2.0;
    let path = extract_ridge(&axis, &map, (5.0, 58.0), 1).unwrap();
    for (row, peak) in path.iter().enumerate() {
        assert_eq!(peak.bin, place(row), "row {row}");
    }
}

/// The height over the background tells a line from noise, and a jump tells a path over two orders.
#[test]
fn noise_and_two_orders_are_told_from_a_line() {
    let found = speed_from_line(&record(), RATE, &LINE).unwrap();
    assert!(found.over_background > 6.0 && found.jump < 1.2, "{} {}", found.over_background, found.jump);
    for seed in 1..=10 {
        for (low, high) in [(15.0, 60.0), (30.0, 150.0), (25.0, 35.0)] {
            let settings = SpeedLineSettings {
                order: 1.0,
                low,
                high,
                max_sweep_rate: high - low,
                frame: (24.0 * RATE / f64::sqrt(low * high)) as usize,
            };
            let found = speed_from_line(&noise(seed, 40_000), RATE, &settings).unwrap();
            assert!(found.over_background < 4.0, "{seed} {low}: {}", found.over_background);
        }
    }
    // 1x enters a range for 2x, and is stronger.
    let rough = noise(3, 40_000);
    let two = |first: f64, second: f64| -> Vec<f64> {
        let x = sampled(40_000, RATE, |t| {
            let a = TAU * (20.0 * t + 1.5 * t * t);
            first * a.cos() + second * (2.0 * a + 1.0).cos()
        });
        x.iter().zip(&rough).map(|(x, r)| x + 0.3 * r).collect()
    };
    let settings =
        SpeedLineSettings { order: 2.0, low: 30.0, high: 110.0, max_sweep_rate: 64.0, frame: 1671 };
    let wrong = speed_from_line(&two(2.0, 0.7), RATE, &settings).unwrap();
    assert!(wrong.jump > 1.5, "{}", wrong.jump);
    let right = speed_from_line(&two(0.7, 2.0), RATE, &settings).unwrap();
    assert!(right.jump < 1.2 && right.over_background > 10.0, "{} {}", right.jump, right.over_background);
}

#[test]
fn invalid_input_is_rejected() {
    let x = record();
    let message = |settings: SpeedLineSettings| speed_from_line(&x, RATE, &settings).unwrap_err().to_string();
    assert!(message(SpeedLineSettings { order: 0.0, ..LINE }).starts_with("order = 0 is out of range"));
    assert!(message(SpeedLineSettings { high: 20.0, ..LINE }).starts_with("upper end of the line [Hz] = 20"));
    assert!(
        message(SpeedLineSettings { low: f64::NAN, ..LINE }).starts_with("lower end of the line [Hz] = NaN")
    );
    assert!(message(SpeedLineSettings { frame: 50_000, ..LINE }).starts_with("record has 32000 samples"));
    let mut bad = x.clone();
    bad[7] = f64::NAN;
    assert!(speed_from_line(&bad, RATE, &LINE).is_err());
}
