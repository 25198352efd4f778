//! Transfer path from an impact to the sensor, and signals sent through it.

use std::f64::consts::TAU;

use rotordyn_signal::Complex;

use super::clock::Clock;
use super::random::Random;
use super::{RATE, SAMPLES, SECONDS};

/// Damped modes between the contact and the sensor.
pub struct TransferPath(Vec<Mode>);

struct Mode {
    gain: f64,
    /// e^(s Δt) with s = −ζω + jω √(1 − ζ²).
    step: Complex<f64>,
    pole: Complex<f64>,
}

impl TransferPath {
    /// One to four modes at 0.8 to 5.4 kHz, damping ratio 1 to 8 %, the first the strongest.
    pub fn draw(random: &mut Random) -> Self {
        let modes = random.integer(1, 4);
        let mode = |k: usize, random: &mut Random| {
            let omega = TAU * random.range(800.0, 5400.0);
            let damping = random.log_range(0.01, 0.08);
            let pole = Complex::new(-damping * omega, omega * (1.0 - damping * damping).sqrt());
            let gain = if k == 0 { 1.0 } else { random.range(0.1, 0.8) };
            Mode { gain, step: (pole / RATE).exp(), pole }
        };
        TransferPath((0..modes).map(|k| mode(k, random)).collect())
    }

    /// Response to impacts (time on the machine's clock \[s\], strength); arrivals between samples are exact.
    pub fn impacts(&self, impacts: &[(f64, f64)], clock: &Clock) -> Vec<f64> {
        let mut out = vec![0.0; SAMPLES];
        let impacts: Vec<(f64, f64)> = impacts.iter().map(|(time, a)| (clock.real(*time), *a)).collect();
        for mode in &self.0 {
            let mut state = Complex::new(0.0, 0.0);
            let mut next = impacts.iter().filter(|(time, _)| (0.0..SECONDS).contains(time)).peekable();
            for (n, value) in out.iter_mut().enumerate() {
                state *= mode.step;
                let now = n as f64 / RATE;
                while let Some((time, strength)) = next.next_if(|(time, _)| *time <= now) {
                    state += (mode.pole * (now - time)).exp() * *strength;
                }
                *value += mode.gain * state.im;
            }
        }
        out
    }

    /// Response to a force sampled like the record.
    pub fn force(&self, force: &[f64]) -> Vec<f64> {
        let mut out = vec![0.0; SAMPLES];
        for mode in &self.0 {
            let mut state = Complex::new(0.0, 0.0);
            for (value, f) in out.iter_mut().zip(force) {
                state = state * mode.step + f;
                *value += mode.gain * state.im;
            }
        }
        out
    }
}

/// Arrival times \[s\] at a mean rate \[Hz\]; each interval has a relative random part (it accumulates).
pub fn arrivals(random: &mut Random, rate: f64, jitter: f64) -> Vec<f64> {
    let mut time = random.unit() / rate;
    let mut times = Vec::new();
    while time < SECONDS {
        times.push(time);
        time += (1.0 + jitter * random.normal()).max(0.1) / rate;
    }
    times
}

pub fn white(random: &mut Random) -> Vec<f64> {
    (0..SAMPLES).map(|_| random.normal()).collect()
}

/// Noise through a transfer path, over white noise.
pub fn coloured(random: &mut Random) -> Vec<f64> {
    let force = white(random);
    let shaped = scaled_to(TransferPath::draw(random).force(&force), 1.0);
    let share = random.range(0.1, 0.7);
    sum(&shaped, &white(random), share)
}

/// Σ a_k cos(2π f_k t + φ_k).
pub fn tones(lines: &[(f64, f64, f64)]) -> Vec<f64> {
    machine_tones(lines, &Clock::STEADY)
}

/// Σ a_k cos(2π f_k τ + φ_k) with the machine's clock τ.
pub fn machine_tones(lines: &[(f64, f64, f64)], clock: &Clock) -> Vec<f64> {
    let mut out = vec![0.0; SAMPLES];
    for (frequency, amplitude, phase) in lines.iter().filter(|(f, ..)| *f < 0.48 * RATE) {
        for (n, value) in out.iter_mut().enumerate() {
            *value += amplitude * (TAU * frequency * clock.machine(n as f64 / RATE) + phase).cos();
        }
    }
    out
}

pub fn power(record: &[f64]) -> f64 {
    record.iter().map(|x| x * x).sum::<f64>() / record.len() as f64
}

/// The record scaled to a mean square.
pub fn scaled_to(mut record: Vec<f64>, mean_square: f64) -> Vec<f64> {
    let scale = (mean_square / power(&record).max(f64::MIN_POSITIVE)).sqrt();
    record.iter_mut().for_each(|x| *x *= scale);
    record
}

/// a + factor b.
pub fn sum(a: &[f64], b: &[f64], factor: f64) -> Vec<f64> {
    a.iter().zip(b).map(|(a, b)| a + factor * b).collect()
}
