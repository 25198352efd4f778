//! Speed from pulses.

use std::f64::consts::TAU;

use rotordyn_signal::order::{OrderSettings, OrderTracker};
use rotordyn_signal::tacho::alias::aliased_speed;
use rotordyn_signal::tacho::{PulseTrain, rising_edges};

use crate::{assert_close, noise, sampled};

/// Times at which a shaft from rest at 12 rev/s² to 40 rev/s, then steady, then braked, passes whole turns.
fn pulses() -> Vec<f64> {
    let turns = |t: f64| match t {
        t if t < 3.0 => 6.0 * t * t,
        t if t < 5.0 => 54.0 + 36.0 * (t - 3.0),
        t => 126.0 + 36.0 * (t - 5.0) - 4.0 * (t - 5.0).powi(2),
    };
    (1..=180)
        .map(|k| {
            let (mut low, mut high) = (0.0, 8.0);
            for _ in 0..80 {
                let middle: f64 = 0.5 * (low + high);
                if turns(middle) < f64::from(k) { low = middle } else { high = middle }
            }
            0.5 * (low + high)
        })
        .collect()
}

#[test]
fn all_pulses_of_a_start_from_rest_are_kept() {
    let times = pulses();
    let train = PulseTrain::new(&times, 1).unwrap();
    assert_eq!((train.missing, train.dropped), (0, 0));
    assert_eq!(train.times, times);
    assert_eq!(train.revolutions, (0..180).map(f64::from).collect::<Vec<_>>());
}

/// Gaps of one to three pulses and false pulses, on jitter of 1 % of the interval: the count of turns stays right.
#[test]
fn missing_and_false_pulses_are_corrected() {
    let times = pulses();
    let jitter = noise(17, times.len());
    let mut given = Vec::new();
    let mut truth = Vec::new();
    for (k, t) in times.iter().enumerate() {
        if [30, 55, 56, 90, 91, 92, 140].contains(&k) {
            continue;
        }
        let interval = if k > 0 { t - times[k - 1] } else { 0.2 };
        given.push(t + 0.01 * interval * jitter[k]);
        truth.push(k as f64);
        if [20, 70, 120, 121].contains(&k) {
            let next = times[k + 1] - t;
            given.push(t + [0.05, 0.5, 0.3, 0.9][k % 4] * next);
            truth.push(f64::NAN);
        }
    }
    let train = PulseTrain::new(&given, 1).unwrap();
    assert_eq!((train.missing, train.dropped), (7, 4));
    let kept: Vec<f64> = truth.into_iter().filter(|k| k.is_finite()).collect();
    assert_eq!(train.revolutions, kept);
}

#[test]
fn several_pulses_a_turn() {
    let times: Vec<f64> = (0..100).map(|k| f64::from(k) / 60.0).collect();
    let train = PulseTrain::new(&times, 4).unwrap();
    let (_, rpm) = train.speeds_rpm();
    assert!(rpm.iter().all(|v| (v - 900.0).abs() < 1e-6));
    assert_close("turns", *train.revolutions.last().unwrap(), 99.0 / 4.0, 1e-12);
}

/// Jitter of 2 % of an interval falls by the stated factor, a steady ramp is kept.
#[test]
fn smoothing() {
    let truth: Vec<f64> = (0..200).map(|k| (f64::from(k) / 50.0).sqrt() + 1.0).collect();
    let jitter = noise(3, 200);
    let shaken: Vec<f64> = truth
        .iter()
        .enumerate()
        .map(|(k, t)| if k < 2 { *t } else { t + 0.02 * (t - truth[k - 1]) * jitter[k] })
        .collect();
    let error = |train: &PulseTrain| {
        let one = |(t, r): (&f64, &f64)| (r - 50.0 * (t - 1.0).powi(2)).powi(2);
        (train.times.iter().zip(&train.revolutions).skip(20).map(one).sum::<f64>() / 180.0).sqrt()
    };
    let raw = PulseTrain::new(&shaken, 1).unwrap();
    let smooth = raw.smoothed(8).unwrap();
    let gain = error(&raw) / error(&smooth);
    assert!((2.0..4.0).contains(&gain), "{gain}");
    let exact = PulseTrain::new(&truth, 1).unwrap().smoothed(4).unwrap();
    assert!(error(&exact) < 1e-9, "{}", error(&exact));
}

/// A square pulse with noise on it gives one edge a turn; a slow slope is interpolated.
#[test]
fn edges_of_a_noisy_channel() {
    let rough = noise(2, 20_000);
    let x: Vec<f64> = sampled(20_000, 10_000.0, |t| if (t * 25.0).fract() < 0.1 { 5.0 } else { 0.0 })
        .iter()
        .zip(&rough)
        .map(|(a, b)| a + 0.4 * b)
        .collect();
    let edges = rising_edges(&x, 10_000.0, None, 0.2).unwrap();
    assert_eq!(edges.len(), 49);
    for (k, t) in edges.iter().enumerate() {
        assert_close("edge", *t, 0.04 * (k + 1) as f64, 1.01e-4);
    }
    let slope = sampled(1000, 1000.0, |t| (TAU * 5.0 * t).sin());
    for (k, t) in rising_edges(&slope, 1000.0, Some(0.0), 0.1).unwrap().iter().enumerate() {
        assert_close("zero", *t, 0.2 * (k + 1) as f64, 1e-6);
    }
}

/// Tones at orders 1 and 3.585 of the run: sharp in order, smeared in frequency.
#[test]
fn pulses_sharpen_orders() {
    let rate = 5000.0;
    let train = PulseTrain::new(&pulses(), 1).unwrap().smoothed(3).unwrap();
    let (theta, from) = train.angle(rate, 40_000).unwrap();
    // The record is made from the true motion, not from the pulses.
    let turns = |t: f64| match t {
        t if t < 3.0 => 6.0 * t * t,
        t if t < 5.0 => 54.0 + 36.0 * (t - 3.0),
        t => 126.0 + 36.0 * (t - 5.0) - 4.0 * (t - 5.0).powi(2),
    };
    let x: Vec<f64> = (from..from + theta.len())
        .map(|n| {
            let a = TAU * turns(n as f64 / rate);
            a.cos() + (3.585 * a).cos()
        })
        .collect();
    let mut tracker = OrderTracker::new(&theta, rate, OrderSettings::new(0.05, 10.0)).unwrap();
    let angle = tracker.resample(&[&x]).unwrap();
    let average = tracker.spectrogram(&angle[0]).average(0.0, 1e5).unwrap();
    let orders = tracker.spectrogram(&angle[0]).orders;
    for (order, tolerance) in [(1.0, 0.03), (3.585, 0.1)] {
        let bin = (order / 0.05f64).round() as usize;
        let peak = average[bin - 1..=bin + 1].iter().copied().fold(0.0, f64::max);
        assert!(peak > 1.0 - tolerance - 0.15, "order {order}: {peak}");
        for (o, a) in orders.iter().zip(&average) {
            let near = (o - 1.0).abs() < 0.25 || (o - 3.585).abs() < 0.25;
            assert!(near || *a < 0.05, "order {o}: {a}");
        }
    }
}

#[test]
fn bad_input() {
    let message = |times: &[f64]| PulseTrain::new(times, 1).unwrap_err().to_string();
    assert_eq!(
        message(&[0.0, 1.0, 2.0]),
        "pulse times has 3 samples: at least 4 are needed for a speed that can be checked"
    );
    assert!(message(&[0.0, 1.0, 1.0, 2.0]).starts_with("time is not uniform"));
    assert!(message(&[0.0, 1.0, f64::NAN, 2.0]).contains("holds NaN at sample 2"));
    assert!(rising_edges(&[1.0; 50], 100.0, None, 0.1).is_err());
    let train = PulseTrain::new(&[0.0, 0.1, 0.2, 0.3, 0.4], 1).unwrap();
    assert!(train.smoothed(3).is_err());
    assert!(train.angle(1.0, 10).is_err());
}

/// A trapezoidal pulse of 1 V, a twentieth of a turn wide, over turns.
fn pulse(turns: f64) -> f64 {
    let place = (turns + 0.3).rem_euclid(1.0);
    (place.min(0.05 - place) / 0.01).clamp(0.0, 1.0)
}

/// Pulses on a drift of up to 1.5 times their height: all of them, none added, times within two samples.
#[test]
fn pulses_on_a_slow_drift() {
    let rate = 5000.0;
    let turns = |t: f64| 20.0 * t + 0.5 * t * t;
    for drift in [0.3, 0.6, 1.0, 1.5] {
        let x = sampled(100_000, rate, |t| pulse(turns(t)) + drift * (TAU * t / 20.0).sin());
        let edges = rising_edges(&x, rate, None, 0.2).unwrap();
        let steady = rising_edges(&sampled(100_000, rate, |t| pulse(turns(t))), rate, None, 0.2).unwrap();
        assert_eq!(edges.len(), steady.len(), "{drift}");
        for (a, b) in edges.iter().zip(&steady) {
            assert_close("edge", *a, *b, 2.0 / rate);
        }
        let train = PulseTrain::new(&edges, 1).unwrap();
        assert_eq!((train.missing, train.dropped, train.implausible(edges.len())), (0, 0, None));
    }
}

/// Noise has no train of pulses; a start from rest and a wheel with a missing tooth have.
#[test]
fn trains_that_no_shaft_has() {
    for seed in 1..=5 {
        let rough = noise(seed, 20_000);
        let edges = rising_edges(&rough, 2000.0, None, 0.2).unwrap();
        let found = PulseTrain::new(&edges, 1).unwrap().implausible(edges.len());
        assert!(found.is_some_and(|text| text.contains("no train of pulses")));
    }
    let start = pulses();
    assert_eq!(PulseTrain::new(&start, 1).unwrap().implausible(start.len()), None);
    let rough = noise(9, 400);
    for spread in [0.0, 0.2] {
        let uneven: Vec<f64> =
            (0..400u16).map(|k| (f64::from(k) + spread * rough[usize::from(k)]) / 600.0).collect();
        assert_eq!(PulseTrain::new(&uneven, 20).unwrap().implausible(uneven.len()), None);
    }
    let wheel: Vec<f64> = (0..400).filter(|k| k % 20 != 0).map(|k| f64::from(k) / 600.0).collect();
    assert_eq!(PulseTrain::new(&wheel, 20).unwrap().implausible(wheel.len()), None);
}

/// 60 pulses a turn at 30 rev/s sampled at 2 kHz look like 200 Hz; 1x of the record tells. At 20 kHz they are right.
#[test]
fn aliased_pulses_are_told_by_the_record() {
    let turns = |t: f64| 30.0 * t + 0.05 * t * t;
    let found = |pulse_rate: f64, line: f64| {
        let samples = (10.0 * pulse_rate) as usize;
        let channel =
            sampled(samples, pulse_rate, |t| if (TAU * 60.0 * turns(t)).sin() > 0.0 { 5.0 } else { 0.0 });
        let edges = rising_edges(&channel, pulse_rate, None, 0.2).unwrap();
        let train = PulseTrain::new(&edges, 60).unwrap();
        let rough = noise(5, 20_000);
        let record: Vec<f64> = rough
            .iter()
            .enumerate()
            .map(|(n, x)| (TAU * line * turns(n as f64 / 2000.0)).sin() + 0.3 * x)
            .collect();
        aliased_speed(&record, 2000.0, [&train.times, &train.revolutions], pulse_rate, 60)
    };
    for line in [1.0, 2.0] {
        let speed = found(2000.0, line).unwrap();
        assert_close("speed", speed, 30.5, 0.1);
        assert_eq!(found(20_000.0, line), None);
    }
    // No line of a shaft: nothing is known.
    assert_eq!(found(2000.0, 4.37), None);
    let train = |rate: f64| PulseTrain::new(&(0..500).map(|k| f64::from(k) / rate).collect::<Vec<_>>(), 1);
    assert!(train(900.0).unwrap().unresolved(2000.0).is_some_and(|samples| (samples - 2.22).abs() < 0.01));
    assert_eq!(train(400.0).unwrap().unresolved(2000.0), None);
}

/// Times of the pulses of a shaft of angle θ(t) = 2π(f t + a t²/2), one a turn, from its first to its last second.
fn run_up(speed: f64, acceleration: f64, duration: f64) -> Vec<f64> {
    let turns = speed * duration + 0.5 * acceleration * duration * duration;
    (0..=turns as usize)
        .map(|k| {
            let k = k as f64;
            2.0 * k / (speed + (speed * speed + 2.0 * acceleration * k).sqrt())
        })
        .collect()
}

/// Gaps of any length: the turns in them are those of the speeds on both sides.
#[test]
fn long_gaps_hold_the_turns_of_the_speeds_around_them() {
    let times = run_up(10.0, 2.0, 20.0);
    for length in [6, 8, 12, 20, 60] {
        let gap = 200..200 + length;
        let kept: Vec<f64> = (0..times.len()).filter(|k| !gap.contains(k)).map(|k| times[k]).collect();
        let train = PulseTrain::new(&kept, 1).unwrap();
        assert_eq!((train.missing, train.dropped), (length, 0));
        let turns = train.revolutions[train.revolutions.len() - 1];
        assert_eq!(turns, (times.len() - 1) as f64);
        assert_eq!(train.implausible(kept.len()), None);
        assert_eq!(train.gaps().len(), 1);
        assert_eq!(train.gaps()[0].0, [times[199], times[200 + length]]);
    }
    // A shaft that stands between two runs has lost no pulses.
    let first = run_up(20.0, -2.0, 9.9);
    let rest = 40.0;
    let mut both = first.clone();
    both.extend(first.iter().rev().map(|t| rest - t));
    let train = PulseTrain::new(&both, 1).unwrap();
    assert!(train.gaps().is_empty(), "{:?}", train.gaps());
}

/// Every second pulse missing for a time is mended; for the rest of the record, or counted twice, it is refused.
#[test]
fn pulses_lost_or_doubled_one_by_one() {
    let times = run_up(10.0, 2.0, 20.0);
    let part: Vec<f64> =
        (0..times.len()).filter(|k| k % 2 == 0 || !(200..260).contains(k)).map(|k| times[k]).collect();
    let train = PulseTrain::new(&part, 1).unwrap();
    assert_eq!((train.missing, train.dropped), (30, 0));
    assert_eq!(train.implausible(part.len()), None);
    let rest: Vec<f64> = (0..times.len()).filter(|k| k % 2 == 0 || *k < 300).map(|k| times[k]).collect();
    let reason = PulseTrain::new(&rest, 1).unwrap().implausible(rest.len()).unwrap();
    assert!(reason.contains("from one pulse to the next"), "{reason}");
    let doubled: Vec<f64> = (0..times.len() - 1)
        .flat_map(|k| {
            let half = 0.5 * (times[k] + times[k + 1]);
            if (200..300).contains(&k) { vec![times[k], half] } else { vec![times[k]] }
        })
        .collect();
    let reason = PulseTrain::new(&doubled, 1).unwrap().implausible(doubled.len()).unwrap();
    assert!(reason.contains("from one pulse to the next"), "{reason}");
}
