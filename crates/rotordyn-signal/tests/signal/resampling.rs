//! Resampling uniform in shaft angle: pass band, aliasing, standstill; and uniform in time.

use std::f64::consts::TAU;

use rotordyn_signal::SignalError;
use rotordyn_signal::resample::{AngleResampler, SkipReason, integrate_speed, to_uniform_time, uniform_rate};

use crate::{assert_close, sampled};

const RATE: f64 = 5000.0;
/// Outputs left out at the ends: 36 samples at two outputs a sample.
const ENDS: usize = 72;

/// Revolutions of a ramp from 0 to 25 rev/s in 10 s.
fn ramp(t: f64) -> f64 {
    1.25 * t * t
}

/// Largest error against `expected(turns)` away from the ends.
fn worst(resampler: &AngleResampler, record: &[f64], expected: impl Fn(f64) -> f64) -> f64 {
    let out = resampler.resample(&[record]).unwrap();
    let mut worst: f64 = 0.0;
    for (part, channels) in resampler.parts().iter().zip(&out) {
        let samples = &channels[0];
        for (k, y) in samples.iter().enumerate().take(samples.len() - ENDS).skip(ENDS) {
            let turns = (part.first + k as i64) as f64 / resampler.samples_per_revolution() as f64;
            worst = worst.max((y - expected(turns)).abs());
        }
    }
    worst
}

/// Orders up to S/2.56 pass, all through the ramp and both ways of the clock.
#[test]
fn orders_in_the_pass_band_are_kept() {
    let theta = sampled(50_000, RATE, |t| TAU * ramp(t));
    // 64 per revolution at 25 rev/s is 1600 Hz: fewer outputs than samples; 400 is 10 kHz: more.
    for (per_revolution, order) in [(64, 0.0), (64, 1.0), (64, 7.14), (64, 25.0), (400, 7.14), (400, 60.0)] {
        let resampler = AngleResampler::new(&theta, RATE, per_revolution, 0.05).unwrap();
        let x = sampled(50_000, RATE, |t| (TAU * order * ramp(t) + 0.3).cos());
        let error = worst(&resampler, &x, |turns| (TAU * order * turns + 0.3).cos());
        assert!(error < 1e-4, "order {order} at {per_revolution}: {error:e}");
    }
}

/// A shaft that slows down, reverses and speeds up the other way: both stretches are kept, in their sequence.
#[test]
fn both_senses_of_rotation_are_kept() {
    let turns = |t: f64| 20.0 * t - 2.0 * t * t - 1.0;
    for sign in [1.0, -1.0] {
        let theta = sampled(50_000, RATE, |t| sign * TAU * turns(t));
        let x = sampled(50_000, RATE, |t| (TAU * 3.0 * turns(t) + 0.4).cos());
        let resampler = AngleResampler::new(&theta, RATE, 64, 0.05).unwrap();
        let [ahead, back] = resampler.parts() else { panic!("{} parts", resampler.parts().len()) };
        assert!(
            ahead.times.last().unwrap() < &5.0 && back.times[0] > 5.0 && back.times.last().unwrap() > &9.9
        );
        let out = resampler.resample(&[&x]).unwrap();
        for (part, channels) in resampler.parts().iter().zip(&out) {
            for (time, y) in part.times.iter().zip(&channels[0]).skip(ENDS).take(part.times.len() - 2 * ENDS)
            {
                assert!((y - (TAU * 3.0 * turns(*time) + 0.4).cos()).abs() < 1e-3, "{time}");
            }
        }
        let stands: Vec<_> = resampler.skipped().iter().map(|s| s.reason).collect();
        assert_eq!(stands, [SkipReason::Standstill]);
    }
}

/// Orders above S/2 do not come back folded: 40x at 64 a revolution would fold to 24x.
#[test]
fn orders_above_nyquist_are_suppressed() {
    let theta = sampled(50_000, RATE, |t| TAU * ramp(t));
    let resampler = AngleResampler::new(&theta, RATE, 64, 0.05).unwrap();
    for order in [33.0, 40.0, 63.0, 90.0] {
        let x = sampled(50_000, RATE, |t| (TAU * order * ramp(t)).cos());
        let error = worst(&resampler, &x, |_| 0.0);
        assert!(error < 3e-5, "order {order}: {error:e}");
    }
}

/// A steady 1 kHz tone is above S/2 below 1000/32 rev/s: it must vanish over the whole ramp.
#[test]
fn steady_tone_is_suppressed_where_it_is_above_nyquist() {
    let theta = sampled(50_000, RATE, |t| TAU * ramp(t));
    let resampler = AngleResampler::new(&theta, RATE, 64, 0.05).unwrap();
    let x = sampled(50_000, RATE, |t| (TAU * 1000.0 * t).cos());
    let error = worst(&resampler, &x, |_| 0.0);
    assert!(error < 3e-5, "{error:e}");
}

/// Stand 1 s, ramp 2 s, stand 1 s, turn steadily 2 s: two parts, two standstills.
#[test]
fn standstill_is_skipped_and_reported() {
    let speed = sampled(30_000, RATE, |t| match t {
        t if t < 1.0 => 0.0,
        t if t < 3.0 => TAU * 5.0 * (t - 1.0),
        t if t < 4.0 => 0.0,
        _ => TAU * 10.0,
    });
    let theta = integrate_speed(&speed, RATE, 0.4).unwrap();
    let resampler = AngleResampler::new(&theta, RATE, 32, 0.05).unwrap();
    assert_eq!(resampler.parts().len(), 2);
    let reasons: Vec<_> = resampler.skipped().iter().map(|s| s.reason).collect();
    assert_eq!(reasons, vec![SkipReason::Standstill; 2]);
    let standing = &resampler.skipped()[1].samples;
    assert_close("stop", standing.start as f64 / RATE, 3.0, 1e-3);
    assert_close("go", standing.end as f64 / RATE, 4.0, 1e-3);
    // The grid keeps its phase against the shaft across the standstill.
    let x: Vec<f64> = theta.iter().map(|a| (3.0 * a).cos()).collect();
    let error = worst(&resampler, &x, |turns| (3.0 * TAU * turns).cos());
    assert!(error < 1e-4, "{error:e}");
}

#[test]
fn a_shaft_turning_backwards_is_tracked() {
    let theta = sampled(10_000, RATE, |t| -TAU * 20.0 * t);
    let resampler = AngleResampler::new(&theta, RATE, 32, 0.05).unwrap();
    let x: Vec<f64> = theta.iter().map(|a| (2.0 * a).cos()).collect();
    assert!(worst(&resampler, &x, |turns| (2.0 * TAU * turns).cos()) < 1e-4);
}

#[test]
fn oscillating_shaft_angle_is_an_error() {
    let theta = sampled(5000, RATE, |t| (TAU * 3.0 * t).sin());
    let error = AngleResampler::new(&theta, RATE, 32, 0.05).err().unwrap();
    assert!(matches!(error, SignalError::TooFewRevolutions { given, .. } if given < 0.4), "{error}");
}

#[test]
fn several_channels_equal_single_channels() {
    let theta = sampled(5000, RATE, |t| TAU * 20.0 * t);
    let resampler = AngleResampler::new(&theta, RATE, 32, 0.05).unwrap();
    let (a, b) = (crate::noise(1, 5000), crate::noise(2, 5000));
    let both = resampler.resample(&[&a, &b]).unwrap();
    assert_eq!(both[0][1], resampler.resample(&[&b]).unwrap()[0][0]);
}

/// The spline's error falls with the fourth power of the step, fitted over a halving, and a line is exact.
#[test]
fn uneven_times_by_cubic_spline() {
    let error = |n: usize| {
        let time: Vec<f64> = (0..=n)
            .map(|k| k as f64 / n as f64)
            .map(|s| s + 0.2 / n as f64 * (TAU * 3.0 * s * n as f64 / 10.0).sin())
            .collect();
        // sin has zero curvature at both ends, as the natural spline assumes.
        let x: Vec<f64> = time.iter().map(|t| (TAU * t).sin()).collect();
        let out = to_uniform_time(&time, &x, 997.0).unwrap();
        let errors =
            out.iter().enumerate().map(|(k, y)| (y - (TAU * (time[0] + k as f64 / 997.0)).sin()).abs());
        errors.fold(0.0, f64::max)
    };
    let order = (error(40) / error(80)).log2();
    assert!((3.6..4.6).contains(&order), "order {order}");
    let line = to_uniform_time(&[0.0, 0.3, 1.0, 1.5], &[1.0, 1.6, 3.0, 4.0], 4.0).unwrap();
    assert_eq!(line.len(), 7);
    for (k, y) in line.iter().enumerate() {
        assert_close("line", *y, 1.0 + 0.5 * k as f64, 1e-14);
    }
}

#[test]
fn rate_of_a_time_axis() {
    assert_close("rate", uniform_rate(&sampled(100, 51_200.0, |t| 3.0 + t)).unwrap(), 51_200.0, 1e-4);
    let error = uniform_rate(&[0.0, 0.1, 0.2, 0.35]).unwrap_err();
    assert!(matches!(error, SignalError::NonUniform { .. }), "{error}");
}
