//! Signal analysis: closed forms, scipy reference values, and errors for unusable records.

mod bearing_faults;
mod closed_forms;
mod defects;
mod dented_bearing;
mod impact_frfs;
mod impact_hits;
mod oracle;
mod oracle_bearing;
mod oracle_resampling;
mod oracle_trend;
mod orders;
mod refusals;
mod resampling;
mod sections;
mod smear;
mod speed_line;
mod tacho;
mod tacho_jitter;
mod tacho_marks;
mod vold_kalman;

use rotordyn_signal::Complex;

/// Uniform random numbers in −1..1 by a 32-bit linear congruential generator; `oracle.py` has the same.
pub fn noise(seed: u32, n: usize) -> Vec<f64> {
    let mut state = seed;
    (0..n)
        .map(|_| {
            state = state.wrapping_mul(1664525).wrapping_add(1013904223);
            state as f64 / 2f64.powi(31) - 1.0
        })
        .collect()
}

/// `f` at t = n / `rate`.
pub fn sampled(n: usize, rate: f64, f: impl Fn(f64) -> f64) -> Vec<f64> {
    (0..n).map(|k| f(k as f64 / rate)).collect()
}

#[track_caller]
pub fn assert_close(what: &str, got: f64, expected: f64, tolerance: f64) {
    assert!((got - expected).abs() <= tolerance, "{what}: {got} instead of {expected} ± {tolerance}");
}

#[track_caller]
pub fn assert_close_complex(what: &str, got: Complex<f64>, expected: Complex<f64>, tolerance: f64) {
    assert!((got - expected).norm() <= tolerance, "{what}: {got} instead of {expected} ± {tolerance}");
}
