//! Vold-Kalman order tracking of synthetic records with known complex amplitudes.

use std::f64::consts::TAU;

use nalgebra::{DMatrix, DVector};
use rotordyn_signal::Complex;
use rotordyn_signal::SignalError;
use rotordyn_signal::order::{OrderSettings, OrderTracker};
use rotordyn_signal::vold_kalman::{Bandwidth, TrackedOrder, vold_kalman};

use crate::{assert_close, sampled};

const RATE: f64 = 4000.0;

fn tracked(orders: &[f64], bandwidth: Bandwidth) -> Vec<TrackedOrder> {
    orders.iter().map(|order| TrackedOrder { order: *order, bandwidth }).collect()
}

/// Re Σ X(t) e^{jνθ}.
fn sum_of_orders(theta: &[f64], parts: &[(f64, &dyn Fn(f64) -> Complex<f64>)]) -> Vec<f64> {
    let at = |(n, angle): (usize, &f64)| {
        let t = n as f64 / RATE;
        parts.iter().map(|(order, x)| (x(t) * Complex::from_polar(1.0, order * angle)).re).sum()
    };
    theta.iter().enumerate().map(at).collect()
}

/// Response of a mode at `natural` \[Hz\] to a harmonic force of that frequency \[Hz\], quasi-static 1.
fn mode(frequency: f64, natural: f64, zeta: f64) -> Complex<f64> {
    let ratio = frequency / natural;
    Complex::from(1.0) / Complex::new(1.0 - ratio * ratio, 2.0 * zeta * ratio)
}

/// 7x and 2 BPFO = 7.144x pass a mode at 150 Hz (5 % damping) in a run-up from 5 to 30 rev/s in 13 s: the largest errors of
/// amplitude and phase, where the amplitudes are above a tenth of their peaks, of Vold-Kalman and of the windowed cut.
///
/// What can be told apart has a limit: half the beat frequency is 1.5 Hz at the resonance, and the amplitude over time, with
/// its pole 0.05·150 Hz/(13.5 Hz/s) = 0.56 s from the real axis, has e^(−2π·1.5·0.56) = 0.5 % of its spectrum there.
#[test]
fn orders_7_and_7_144_through_a_resonance() {
    let samples = (13.0 * RATE) as usize;
    let speed = |t: f64| 5.0 + 25.0 * t / 13.0;
    let theta = sampled(samples, RATE, |t| TAU * (5.0 * t + 12.5 * t * t / 13.0));
    let amplitudes: [(f64, f64, f64); 2] = [(7.0, 1.0, 0.3), (7.144, 0.7, -1.1)];
    let exact = |k: usize, t: f64| {
        let (order, amplitude, phase) = amplitudes[k];
        mode(order * speed(t), 150.0, 0.05) * Complex::from_polar(amplitude, phase)
    };
    let record = sum_of_orders(&theta, &[(7.0, &|t| exact(0, t)), (7.144, &|t| exact(1, t))]);

    let bandwidth = Bandwidth::Orders { width: 0.25, min_hertz: 1.0 };
    let found = vold_kalman(&record, &theta, RATE, &tracked(&[7.0, 7.144], bandwidth)).unwrap();
    let mut tracker = OrderTracker::new(&theta, RATE, OrderSettings::new(0.05, 10.0)).unwrap();
    let angle = tracker.resample(&[&record]).unwrap();
    let _ = tracker.spectrogram(&angle[0]);

    for (k, (order, ..)) in amplitudes.iter().enumerate() {
        let peak = (0..samples).map(|n| exact(k, n as f64 / RATE).norm()).fold(0.0, f64::max);
        let errors = |time: f64, x: Complex<f64>| {
            let ratio = x / exact(k, time);
            ((ratio.norm() - 1.0).abs(), ratio.arg().abs().to_degrees())
        };
        let worst = |errors: Vec<(f64, f64)>| {
            errors.iter().fold((0.0f64, 0.0f64), |worst, e| (worst.0.max(e.0), worst.1.max(e.1)))
        };
        let shown = |time: f64| (1.0..12.0).contains(&time) && exact(k, time).norm() > 0.1 * peak;
        let of_kalman = worst(
            (0..samples)
                .map(|n| (n as f64 / RATE, found.orders[k].amplitude[n]))
                .filter(|(t, _)| shown(*t))
                .map(|(t, x)| errors(t, x))
                .collect(),
        );
        let cut = tracker.vector(&angle[0], *order).unwrap();
        let of_cut = worst(
            cut.times
                .iter()
                .zip(&cut.amplitude)
                .filter(|(t, _)| shown(**t))
                .map(|(t, x)| errors(*t, *x))
                .collect(),
        );
        println!("{order}x: Vold-Kalman {of_kalman:?}, cut {of_cut:?}, {} iterations", found.iterations);
        assert!(of_kalman.0 < 0.02 && of_kalman.1 < 3.0, "{order}x: {of_kalman:?}");
        assert!(of_cut.0 > 2.0 * of_kalman.0, "the windowed cut smears the resonance: {of_cut:?}");
    }
    let rms = |x: &[f64]| (x.iter().map(|v| v * v).sum::<f64>() / x.len() as f64).sqrt();
    assert!(rms(&found.remainder) < 0.01 * rms(&record), "{}", rms(&found.remainder));
}

/// A line δ Hz from a tracked order passes as 1/(1 + (√2 − 1) (δ/(B/2))⁴): −3 dB at half the bandwidth.
#[test]
fn the_bandwidth_is_between_the_half_power_points() {
    let theta = sampled(40_000, RATE, |t| TAU * 25.0 * t);
    for (bandwidth, offset) in [(4.0, 2.0), (4.0, 1.0), (4.0, 4.0), (10.0, 5.0), (1.0, 0.5)] {
        let record = sampled(40_000, RATE, |t| (TAU * (250.0 + offset) * t + 0.2).cos());
        let found =
            vold_kalman(&record, &theta, RATE, &tracked(&[10.0], Bandwidth::Hertz(bandwidth))).unwrap();
        // The middle, away from both ends.
        let amplitude = found.orders[0].amplitude[20_000].norm();
        let ratio: f64 = offset / (0.5 * bandwidth);
        let expected = 1.0 / (1.0 + (2f64.sqrt() - 1.0) * ratio.powi(4));
        // Twice the order's frequency passes as (B/1000 Hz)⁴; (2 − 2 cos x) is x² to (x²/12 = 1e-6).
        assert_close("pass band", amplitude, expected, 2e-4);
    }
}

/// Orders that cross a fixed frequency and a slow mean are told apart; at the crossing only the phases differ.
#[test]
fn a_crossing_fixed_frequency_and_a_mean_are_separated() {
    let samples = 48_000;
    // 10 to 34 rev/s in 12 s: 3x crosses 60 Hz at t = 5 s.
    let theta = sampled(samples, RATE, |t| TAU * (10.0 * t + t * t));
    let record: Vec<f64> = theta
        .iter()
        .enumerate()
        .map(|(n, angle)| {
            let t = n as f64 / RATE;
            2.0 * (3.0 * angle + 0.5).cos() + 0.5 + 0.1 * t + 0.8 * (angle - 1.0).cos()
        })
        .collect();
    let orders = tracked(&[3.0, 0.0, 1.0], Bandwidth::Hertz(2.0));
    let found = vold_kalman(&record, &theta, RATE, &orders).unwrap();
    for n in (4000..44_000).step_by(997) {
        let [third, mean, first] = [0, 1, 2].map(|k| found.orders[k].amplitude[n]);
        // Constant amplitudes and a linear mean have no second differences: nothing is lost but round-off.
        assert_close("3x", third.norm(), 2.0, 1e-5);
        assert_close("3x phase", third.arg(), 0.5, 1e-5);
        assert_close("1x", (first - Complex::from_polar(0.8, -1.0)).norm(), 0.0, 1e-5);
        assert_close("mean", mean.re, 0.5 + 0.1 * n as f64 / RATE, 1e-5);
        assert_eq!(mean.im, 0.0);
    }
    let largest = found.remainder.iter().fold(0.0f64, |m, v| m.max(v.abs()));
    assert!(largest < 1e-4, "{largest}");
}

/// Reversing time and the sense of rotation conjugates the amplitudes.
#[test]
fn a_record_played_backwards_has_conjugate_amplitudes() {
    let samples = 8000;
    let theta = sampled(samples, RATE, |t| TAU * (8.0 * t + 3.0 * t * t));
    let mut state = 1u64;
    let mut noise = || {
        state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (state >> 11) as f64 / (1u64 << 53) as f64 - 0.5
    };
    let record: Vec<f64> = theta.iter().map(|a| (2.0 * a).cos() + noise()).collect();
    let orders = tracked(&[2.0, 3.5], Bandwidth::Hertz(3.0));
    let forward = vold_kalman(&record, &theta, RATE, &orders).unwrap();
    let backwards = |x: &[f64]| -> Vec<f64> { x.iter().rev().copied().collect() };
    // A record in reversed time whose angle falls: cos(νθ + φ) = cos(ν(−θ) − φ).
    let reversed_angle: Vec<f64> = theta.iter().rev().map(|a| -a).collect();
    let backward = vold_kalman(&backwards(&record), &reversed_angle, RATE, &orders).unwrap();
    for n in (0..samples).step_by(53) {
        for k in 0..2 {
            let [a, b] = [forward.orders[k].amplitude[n], backward.orders[k].amplitude[samples - 1 - n]];
            // The iteration ends at 1e-9 of the energy norm.
            assert_close("conjugate", (a - b.conj()).norm(), 0.0, 1e-6);
        }
    }
}

#[test]
fn settings_that_cannot_work_are_refused() {
    let theta = sampled(4000, RATE, |t| TAU * 25.0 * t);
    let record = sampled(4000, RATE, |t| (TAU * 25.0 * t).cos());
    let run = |orders: &[f64], bandwidth| vold_kalman(&record, &theta, RATE, &tracked(orders, bandwidth));
    let refused = |found: Result<_, SignalError>| found.map(drop).unwrap_err().to_string();
    expect_part(&refused(run(&[], Bandwidth::Hertz(5.0))), "number of orders");
    expect_part(&refused(run(&[1.0, 1.0], Bandwidth::Hertz(5.0))), "every order once");
    expect_part(&refused(run(&[1.0], Bandwidth::Hertz(0.1))), "bandwidth [Hz] = 0.1");
    expect_part(&refused(run(&[1.0], Bandwidth::Hertz(3000.0))), "below a quarter");
    expect_part(&refused(run(&[100.0], Bandwidth::Hertz(5.0))), "at least 5000.0 Hz");
    expect_part(&refused(run(&[-1.0], Bandwidth::Hertz(5.0))), "0 or more");
    expect_part(&refused(run(&[f64::NAN], Bandwidth::Hertz(5.0))), "0 or more");
    let rest = vec![0.3; 4000];
    let stopped = vold_kalman(&record, &rest, RATE, &tracked(&[1.0], Bandwidth::Hertz(5.0)));
    expect_part(&refused(stopped), "a shaft that turns");
}

fn expect_part(message: &str, part: &str) {
    assert!(message.contains(part), "{message:?} does not contain {part:?}");
}

/// The minimum of the sum of squares itself: all rows of the problem stacked and solved by QR.
#[test]
fn amplitudes_minimise_the_sum_of_squares() {
    const SAMPLES: usize = 120;
    const WIDTH: f64 = 150.0;
    let theta = sampled(SAMPLES, RATE, |t| TAU * (60.0 * t + 400.0 * t * t) + 0.7);
    let record = crate::noise(5, SAMPLES);
    let orders = [1.0, 1.4];
    let found = vold_kalman(&record, &theta, RATE, &tracked(&orders, Bandwidth::Hertz(WIDTH))).unwrap();
    // −3 dB of a single order at half the bandwidth: ½ = r² |2 − 2 cos(π B/f_s)|² / (√2 − 1).
    let second = (2.0 - 2.0 * (std::f64::consts::PI * WIDTH / RATE).cos()).powi(2);
    let r = ((2f64.sqrt() - 1.0) / (2.0 * second)).sqrt();
    let unknown = |order: usize, part: usize, n: usize| (2 * order + part) * SAMPLES + n;
    let rows = SAMPLES + 4 * (SAMPLES - 2);
    let mut matrix = DMatrix::zeros(rows, 4 * SAMPLES);
    let mut right = DVector::zeros(rows);
    for n in 0..SAMPLES {
        right[n] = record[n];
        for (k, order) in orders.iter().enumerate() {
            let carrier = Complex::from_polar(1.0, order * theta[n]);
            matrix[(n, unknown(k, 0, n))] = carrier.re;
            matrix[(n, unknown(k, 1, n))] = -carrier.im;
        }
    }
    let mut row = SAMPLES;
    for (k, part) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
        for n in 1..SAMPLES - 1 {
            matrix[(row, unknown(k, part, n - 1))] = r;
            matrix[(row, unknown(k, part, n))] = -2.0 * r;
            matrix[(row, unknown(k, part, n + 1))] = r;
            row += 1;
        }
    }
    let qr = matrix.qr();
    let exact = qr.r().solve_upper_triangular(&(qr.q().transpose() * right)).unwrap();
    for (k, envelope) in found.orders.iter().enumerate() {
        for (n, x) in envelope.amplitude.iter().enumerate() {
            let expected = Complex::new(exact[unknown(k, 0, n)], exact[unknown(k, 1, n)]);
            // 1e-9 of the energy norm.
            assert_close("amplitude", (x - expected).norm(), 0.0, 1e-7);
        }
    }
}

/// At rest nothing tells the real part of an order from its imaginary part: constant amplitudes go on from where the shaft
/// turned, without loss.
#[test]
fn a_run_up_from_rest_keeps_constant_amplitudes() {
    // 1 s at rest, then 2 rev/s².
    let theta = sampled(24_000, RATE, |t| TAU * (t - 1.0).max(0.0).powi(2));
    let orders = [1.0, 2.0, 3.572];
    let record: Vec<f64> = theta.iter().map(|a| orders.iter().map(|o| (o * a + 0.3).cos()).sum()).collect();
    let bandwidth = Bandwidth::Orders { width: 0.25, min_hertz: 1.0 };
    let found = vold_kalman(&record, &theta, RATE, &tracked(&orders, bandwidth)).unwrap();
    for envelope in &found.orders {
        for x in envelope.amplitude.iter().step_by(101) {
            assert_close("amplitude", (x - Complex::from_polar(1.0, 0.3)).norm(), 0.0, 1e-3);
        }
    }
}
