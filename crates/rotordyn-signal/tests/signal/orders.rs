//! Numerical order tracking of synthetic run-ups.

use std::f64::consts::{SQRT_2, TAU};

use rotordyn_signal::SignalError;
use rotordyn_signal::order::{OrderSettings, OrderTracker};
use rotordyn_signal::ridge::find_peaks;
use rotordyn_signal::window::WindowKind;

use crate::{assert_close, sampled};

const RATE: f64 = 5000.0;

/// 1 s at rest, a 10 s ramp to 1200 rpm, 2 s at that speed, in revolutions.
fn run_up(t: f64) -> f64 {
    match t {
        t if t < 1.0 => 0.0,
        t if t < 11.0 => (t - 1.0).powi(2),
        t => 100.0 + 20.0 * (t - 11.0),
    }
}

fn record(f: impl Fn(f64) -> f64) -> Vec<f64> {
    sampled(65_000, RATE, |t| f(TAU * run_up(t)))
}

/// 7x and 2 BPFO = 7.14x at an order resolution of 0.05: two peaks with the right amplitudes in every window.
#[test]
fn orders_7_and_2_bpfo_are_resolved() {
    const TONES: [(f64, f64); 3] = [(1.0, 1.0), (7.0, 2.0), (7.14, 1.5)];
    let theta = record(|a| a);
    let x = record(|a| 1.0 * a.cos() + 2.0 * (7.0 * a).cos() + 1.5 * (7.14 * a + 0.8).cos());
    let mut tracker = OrderTracker::new(&theta, RATE, OrderSettings::new(0.05, 20.0)).unwrap();
    let angle = tracker.resample(&[&x]).unwrap();
    let map = tracker.spectrogram(&angle[0]);
    assert_close("resolution", map.orders[1], 0.05, 1e-15);
    assert_close("highest", map.orders[map.orders.len() - 1], 20.0, 1e-12);
    assert!(map.times.len() > 20, "{} windows", map.times.len());
    for window in 0..map.times.len() {
        let peaks = find_peaks(&map.orders, map.row(window), 0.5).unwrap();
        let orders: Vec<f64> = peaks.iter().map(|p| p.position).collect();
        assert_eq!(orders.len(), 3, "{orders:?}");
        // 2.8 bins apart, the main lobes of the tones overlap: depending on their relative phase, parabolic
        // interpolation errs by up to 0.12 bins and 7.6 %.
        for (peak, (order, amplitude)) in peaks.iter().zip(TONES) {
            assert_close("order", peak.position, order, 0.15 * 0.05);
            assert_close("amplitude", peak.amplitude, amplitude, 0.08 * amplitude);
        }
    }
    // At its own order each tone is disturbed by the other's side lobe only: 0.98 % of the other's amplitude.
    for ((order, amplitude), leak) in TONES.iter().zip([0.0, 0.0098 * 1.5, 0.0098 * 2.0]) {
        for z in tracker.vector(&angle[0], *order).unwrap().amplitude {
            assert_close("amplitude at the order", z.norm(), *amplitude, leak + 2e-3);
        }
    }
    let average = map.average(300.0, 1200.0).unwrap();
    assert_eq!(find_peaks(&map.orders, &average, 0.5).unwrap().len(), 3);
}

/// Time and speed at a window's centre: window of 20 revolutions from rest, centre after 10, at f = 2 √10 rev/s.
#[test]
fn window_times_are_at_the_centre_in_angle() {
    let theta = record(|a| a);
    let tracker = OrderTracker::new(&theta, RATE, OrderSettings::new(0.05, 20.0)).unwrap();
    let angle = tracker.resample(&[&theta]).unwrap();
    let cut = tracker.vector(&angle[0], 1.0).unwrap();
    // Skipped speeds below 0.05 rev/s (0.6 mrev) and the first point of the grid shift it by 1/54 rev at most.
    assert_close("time", cut.times[0], 1.0 + 10f64.sqrt(), 1.0 / 54.0 / 6.3);
    assert_close("speed", cut.rpm[0], 120.0 * 10f64.sqrt(), 0.5);
    assert_close("hop", tracker.hop_revolutions(), 5.0, 1e-12);
    assert_eq!(tracker.skipped().len(), 1);
    assert_close("rest", tracker.skipped()[0].samples.end as f64 / RATE, 1.0, 0.03);
    // At full speed at the end.
    assert_close("last", *cut.rpm.last().unwrap(), 1200.0, 1e-6);
}

/// Band RMS is that of the tone, whose amplitude increases with speed; the order vector has amplitude and phase.
#[test]
fn order_cuts_follow_the_amplitude() {
    let theta = record(|a| a);
    let speed = |t: f64| if t < 1.0 { 0.0 } else { (2.0 * (t - 1.0)).min(20.0) };
    let x = sampled(65_000, RATE, |t| 0.1 * speed(t) * (3.0 * TAU * run_up(t) + 0.6).cos() + 5.0);
    let mut tracker = OrderTracker::new(&theta, RATE, OrderSettings::new(0.1, 10.0)).unwrap();
    let angle = tracker.resample(&[&x]).unwrap();
    let map = tracker.spectrogram(&angle[0]);
    let cut = map.cut(3.0, 0.4).unwrap();
    let vector = tracker.vector(&angle[0], 3.0).unwrap();
    for (k, rpm) in cut.rpm.iter().enumerate().skip(2) {
        let amplitude = 0.1 * rpm / 60.0;
        // The amplitude is nonlinear over a window of 10 revolutions, by less than 1 % from the third window on.
        assert_close("rms", cut.rms[k], amplitude / SQRT_2, 0.01 * amplitude);
        assert_close("vector", vector.amplitude[k].norm(), amplitude, 0.01 * amplitude);
        assert_close("phase", vector.amplitude[k].arg(), 0.6, 1e-3);
    }
    let steady = cut.rms.len() - 1;
    assert_close("steady rms", cut.rms[steady], 2.0 / SQRT_2, 1e-4);
    assert_close("mean", map.cut(0.0, 0.2).unwrap().rms[steady], 5.0, 1e-3);
}

/// A pure line has its level in the cut of its order for every window, resolution and place between the bins.
#[test]
fn cuts_have_the_level_of_a_line_between_bins() {
    use WindowKind::*;
    let theta = sampled(30_000, RATE, |t| TAU * 25.0 * t);
    for window in [Rectangular, Hann, Hamming, Blackman, FlatTop] {
        for (resolution, order) in [0.05, 0.02]
            .into_iter()
            .flat_map(|r| [4.0, 4.009, 4.0125, 4.02, 4.024, 4.026, 4.03].map(|o| (r, o)))
        {
            let x: Vec<f64> = theta.iter().map(|a| SQRT_2 * (order * a + 0.4).cos()).collect();
            let settings = OrderSettings { window, ..OrderSettings::new(resolution, 6.0) };
            let mut tracker = OrderTracker::new(&theta, RATE, settings).unwrap();
            let angle = tracker.resample(&[&x]).unwrap();
            let map = tracker.spectrogram(&angle[0]);
            for half_band in [resolution, 3.0 * resolution] {
                for (k, rms) in map.cut(order, half_band).unwrap().rms.iter().enumerate() {
                    // The mirrored line, with side lobes of the rectangular window. The first and last windows have the ends
                    // of the interpolation.
                    let tolerance = if window == Rectangular { 5e-3 } else { 1e-3 };
                    assert_close(&format!("{window:?} {resolution} {order} {k}"), *rms, 1.0, tolerance);
                }
            }
        }
    }
}

/// A line that slips by half a bin within the band of a Hann cut keeps its level to 1 %.
#[test]
fn a_line_beside_its_order_keeps_its_level() {
    let theta = sampled(30_000, RATE, |t| TAU * 25.0 * t);
    for order in [4.0, 4.0124, 4.0249] {
        for slip in [-0.025, -0.012, 0.012, 0.025] {
            let x: Vec<f64> = theta.iter().map(|a| SQRT_2 * ((order + slip) * a).cos()).collect();
            let mut tracker = OrderTracker::new(&theta, RATE, OrderSettings::new(0.05, 6.0)).unwrap();
            let angle = tracker.resample(&[&x]).unwrap();
            let cut = tracker.spectrogram(&angle[0]).cut(order, 0.05).unwrap();
            // At the edge of the band, one bin from the middle one, a quarter of the power is out of it.
            let low = if (order + slip - 4.0).abs() > 0.026 { 0.09 } else { 0.011 };
            for rms in &cut.rms {
                assert!((1.0 - low..1.011).contains(rms), "{order} {slip}: {rms}");
            }
        }
    }
}

/// Resolution, overlap and highest order are kept for values that are not round, too.
#[test]
fn settings_that_are_not_round() {
    let theta = record(|a| a);
    let settings = OrderSettings { overlap: 0.0, ..OrderSettings::new(0.03, 13.7) };
    let mut tracker = OrderTracker::new(&theta, RATE, settings).unwrap();
    let angle = tracker.resample(&[&theta]).unwrap();
    let map = tracker.spectrogram(&angle[0]);
    assert_close("resolution", map.orders[1], 0.03, 3e-5);
    assert_close("highest", *map.orders.last().unwrap(), 13.7, 0.03);
    assert_close("hop", tracker.hop_revolutions(), 1.0 / 0.03, 0.05);
}

#[test]
fn orders_beyond_the_sampling_rate_are_refused() {
    let theta = record(|a| a);
    // 100 orders at 20 rev/s are 2000 Hz, which need 5120 Hz.
    let error = OrderTracker::new(&theta, RATE, OrderSettings::new(0.05, 100.0)).err().unwrap();
    assert!(
        matches!(error, SignalError::RateTooLow { needed, .. } if (needed - 5120.0).abs() < 1.0),
        "{error}"
    );
}

#[test]
fn too_few_revolutions_are_refused() {
    let theta = sampled(5000, RATE, |t| TAU * 10.0 * t);
    let error = OrderTracker::new(&theta, RATE, OrderSettings::new(0.05, 10.0)).err().unwrap();
    assert_eq!(
        error.to_string(),
        "the shaft turns 10.000 revolutions without stopping or reversing: 20.000 are needed for one \
         window of this order resolution"
    );
}
