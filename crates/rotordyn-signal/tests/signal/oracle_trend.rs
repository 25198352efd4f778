//! Trends: scipy reference values (oracle_trend.py, stored in tests/data/scipy_trend.json), closed forms, refusals.

use rotordyn_signal::SignalError;
use rotordyn_signal::trend::{Trend, trend};
use serde_json::Value;

use crate::noise;

fn found(x: &[f64], y: &[f64]) -> Trend {
    trend(x, y).unwrap().expect("positions and values differ")
}

fn index(n: usize) -> Vec<f64> {
    (0..n).map(|k| k as f64).collect()
}

/// Rounding of a few operations on values of order one.
const ROUNDING: f64 = 1e-12;

#[test]
fn trends_are_those_of_scipy() {
    let oracle: Value = serde_json::from_str(include_str!("../data/scipy_trend.json")).unwrap();
    let sum = |values: Vec<f64>, slope: f64| -> Vec<f64> {
        values.iter().enumerate().map(|(k, v)| slope * k as f64 + v).collect()
    };
    let mut times = vec![0.0];
    for v in noise(3, 60) {
        times.push(times[times.len() - 1] + 1.0 + 0.5 * v);
    }
    let times = &times[1..];
    let loads: Vec<f64> = (0..40).map(|k| f64::from(k / 10)).collect();
    let rounded = sum(noise(8, 40), 0.03).iter().map(|v| (10.0 * v).round_ties_even() / 10.0).collect();
    for (name, x, y) in [
        ("exact", times[..12].to_vec(), sum(noise(5, 12), 0.2)),
        ("none", index(9), noise(6, 9)),
        ("normal", times.to_vec(), sum(noise(7, 60), 0.02)),
        ("ties", loads, rounded),
    ] {
        let (case, found) = (&oracle[name], found(&x, &y));
        let [low, high] = found.slope_interval;
        for (key, value) in
            [("tau", found.tau), ("p", found.p_value), ("slope", found.slope), ("low", low), ("high", high)]
        {
            let expected = case[key].as_f64().unwrap();
            assert!((value - expected).abs() <= ROUNDING, "{name} {key}: {value} {expected}");
        }
    }
}

/// Of n! orders two are monotonic; outliers do not move slope and ends.
#[test]
fn monotonic_values_and_outliers() {
    for (n, factorial) in [(3, 6.0), (4, 24.0), (6, 720.0), (8, 40_320.0)] {
        let rising: Vec<f64> = index(n).iter().map(|x| 2.0 + 0.5 * x * x).collect();
        let rising = found(&index(n), &rising);
        assert!((rising.p_value - 2.0 / factorial).abs() < ROUNDING && rising.tau == 1.0, "{rising:?}");
        let falling: Vec<f64> = index(n).iter().map(|x| -x).collect();
        assert_eq!(found(&index(n), &falling).tau, -1.0);
    }
    let mut line: Vec<f64> = index(20).iter().map(|x| 3.0 + 0.25 * x).collect();
    (line[2], line[15]) = (1e6, -1e6);
    let found = found(&index(20), &line);
    assert_eq!((found.slope, found.ends, found.end_counts), (0.25, [3.5, 7.375], [4, 4]));
    assert!(found.p_value < 1e-4 && found.slope_interval[0] > 0.0, "{found:?}");
}

/// The order of the points does not matter, not for a single bit.
#[test]
fn any_order_of_points() {
    let (x, y) = (noise(1, 30), noise(2, 30));
    let reversed = |values: &[f64]| values.iter().rev().copied().collect::<Vec<_>>();
    assert_eq!(trend(&x, &y), trend(&reversed(&x), &reversed(&y)));
}

/// At the level of 5 % four to six of a hundred series of noise have a trend: binomial, ± 3 standard deviations.
#[test]
fn noise_has_a_trend_as_often_as_the_test_says() {
    for n in [12, 60] {
        let values = noise(77, 1000 * n);
        let count = values.chunks(n).filter(|y| found(&index(n), y).p_value < 0.05).count();
        assert!((30..=71).contains(&count), "{n} points: {count} of 1000");
    }
}

#[test]
fn without_a_trend_or_refused() {
    assert_eq!(trend(&index(2), &[1.0, 2.0]), Ok(None));
    assert_eq!(trend(&[1.0; 5], &index(5)), Ok(None));
    assert_eq!(trend(&index(5), &[1.0; 5]), Ok(None));
    assert!(matches!(trend(&index(3), &[0.0; 4]), Err(SignalError::LengthMismatch { .. })));
    assert!(matches!(trend(&index(3), &[0.0, f64::NAN, 1.0]), Err(SignalError::NotFinite { index: 1, .. })));
    assert!(matches!(trend(&[0.0, 1.0, f64::INFINITY], &[0.0; 3]), Err(SignalError::NotFinite { .. })));
}
