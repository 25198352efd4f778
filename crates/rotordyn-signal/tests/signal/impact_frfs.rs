//! FRF estimates of a one-mass oscillator and of noisy channels, against the closed form.

use std::f64::consts::TAU;

use rotordyn_signal::impact::{Hit, ImpactWindows, frf_from_hits, frf_from_random};
use rotordyn_signal::spectrum::Welch;
use rotordyn_signal::{Complex, SignalError};

use crate::{assert_close, assert_close_complex, noise};

const RATE: f64 = 4000.0;
const FREQUENCY: f64 = 100.0;
const DAMPING: f64 = 0.01;

/// Response of ẍ + 2ζω ẋ + ω² x = f to a unit impulse at the sample `start`, force f_s for one sample.
fn hit(n: usize, start: usize) -> (Vec<f64>, Vec<f64>) {
    let omega = TAU * FREQUENCY;
    let damped = omega * (1.0 - DAMPING * DAMPING).sqrt();
    let mut force = vec![0.0; n];
    force[start] = RATE;
    let response = (0..n)
        .map(|k| {
            let t = (k as f64 - start as f64) / RATE;
            if t < 0.0 { 0.0 } else { (-DAMPING * omega * t).exp() * (damped * t).sin() / damped }
        })
        .collect();
    (force, response)
}

/// Sampled impulse response: Σ_n h(n/f_s) e^{−sn/f_s} / f_s in closed form, aliasing and all.
fn sampled_receptance(s: Complex<f64>) -> Complex<f64> {
    let omega = TAU * FREQUENCY;
    let damped = omega * (1.0 - DAMPING * DAMPING).sqrt();
    let z = (-s / RATE).exp();
    let radius = (-DAMPING * omega / RATE).exp();
    let turn = damped / RATE;
    let numerator = z * radius * turn.sin();
    numerator / (1.0 - z * (2.0 * radius * turn.cos()) + z * z * (radius * radius)) / (damped * RATE)
}

/// A record that holds the whole decay (e^{−2π·100·0.01·8} = 1e-22) gives the receptance exactly.
#[test]
fn one_hit_gives_the_receptance() {
    let (force, response) = hit(32_000, 10);
    let estimate =
        frf_from_hits(&[Hit { force: &force, response: &response }], RATE, ImpactWindows::default()).unwrap();
    let omega = TAU * FREQUENCY;
    let peak = 1.0 / (2.0 * DAMPING * omega * omega);
    for (k, f) in estimate.frequencies.iter().enumerate().step_by(37) {
        let s = Complex::new(0.0, TAU * f);
        assert_close_complex("H1", estimate.h1[k], sampled_receptance(s), 1e-12 * peak);
        assert_close_complex("H2", estimate.h2[k], estimate.h1[k], 1e-10 / (omega * omega));
        assert_close("coherence", estimate.coherence[k], 1.0, 1e-9);
    }
    // And the sampled form is the continuous one near resonance, up to aliasing of relative size (ω/ω_s)².
    let at = (FREQUENCY * 8.0) as usize;
    let exact = Complex::new(0.0, -peak);
    assert_close_complex("continuous", estimate.h1[at], exact, 1e-3 * peak);
}

/// With the exponential window the estimate is H(jω + 1/τ): a truncated decay without leakage, and more damping.
#[test]
fn exponential_window_and_its_correction() {
    let tau = 0.05;
    let (force, response) = hit(8_000, 0);
    let windows = ImpactWindows { force_length: Some(40), time_constant: Some(tau) };
    let estimate = frf_from_hits(&[Hit { force: &force, response: &response }], RATE, windows).unwrap();
    for (k, f) in estimate.frequencies.iter().enumerate().step_by(11) {
        let shifted = sampled_receptance(Complex::new(1.0 / tau, TAU * f));
        // The window leaves e^{−2 s (1/τ + ζω)} = 1e-23 at the record's end.
        assert_close_complex("H1", estimate.h1[k], shifted, 1e-15);
    }
    let measured = DAMPING + 1.0 / (tau * TAU * FREQUENCY);
    let pole = Complex::new(-DAMPING - 1.0 / tau, 5.0);
    assert_close_complex("pole", estimate.true_pole(pole), Complex::new(-DAMPING, 5.0), 1e-14);
    assert_close("damping", estimate.true_damping_ratio(measured, FREQUENCY), DAMPING, 1e-14);
}

/// Noise in the response: H1 unbiased, H2 too high by 1/γ²; noise in the force: the other way round.
#[test]
fn noise_bias_of_h1_and_h2() {
    let n = 200_000;
    let (force, dirt) = (noise(1, n), noise(77, n));
    let response: Vec<f64> = force.iter().zip(&dirt).map(|(f, d)| 2.0 * f + d).collect();
    let estimate = frf_from_random(&force, &response, RATE, &Welch::hann(512)).unwrap();
    let mean = |v: &[Complex<f64>]| v[5..250].iter().map(|z| z.re).sum::<f64>() / 245.0;
    // 780 averages in each of 245 bins: the standard error of the mean is about 2e-3.
    assert_close("H1", mean(&estimate.h1), 2.0, 0.01);
    assert_close("H2", mean(&estimate.h2), 2.0 * 1.25, 0.02);
    let coherence = estimate.coherence[5..250].iter().sum::<f64>() / 245.0;
    assert_close("coherence", coherence, 0.8, 0.005);
}

/// Equal noise on force and response: H1 is low and H2 high by the same factor, Hv is unbiased.
#[test]
fn hv_is_unbiased_for_equal_noise_on_both_channels() {
    let n = 200_000;
    let (source, first, second) = (noise(1, n), noise(77, n), noise(123, n));
    let force: Vec<f64> = source.iter().zip(&first).map(|(f, d)| f + 0.5 * d).collect();
    let response: Vec<f64> = source.iter().zip(&second).map(|(f, d)| -2.0 * f + d).collect();
    let estimate = frf_from_random(&force, &response, RATE, &Welch::hann(512)).unwrap();
    let mean = |v: &[Complex<f64>]| v[5..250].iter().map(|z| z.re).sum::<f64>() / 245.0;
    // As above: standard errors of 2e-3.
    assert_close("H1", mean(&estimate.h1), -2.0 / 1.25, 0.01);
    assert_close("H2", mean(&estimate.h2), -2.0 * 1.25, 0.02);
    assert_close("Hv", mean(&estimate.hv), -2.0, 0.01);
}

#[test]
fn silent_bins_are_zero_not_nan() {
    let silent = [0.0; 16];
    let estimate =
        frf_from_hits(&[Hit { force: &silent, response: &silent }], RATE, ImpactWindows::default()).unwrap();
    assert!(estimate.h1.iter().chain(&estimate.h2).chain(&estimate.hv).all(|h| h.norm() == 0.0));
    assert!(estimate.coherence.iter().all(|c| *c == 0.0));
}

#[test]
fn no_hit_is_an_error() {
    let error = frf_from_hits(&[], RATE, ImpactWindows::default()).unwrap_err();
    assert_eq!(error, SignalError::Empty { name: "list of hits" });
}
