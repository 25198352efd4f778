//! A record over the whole range of a 50 kHz sampling: a free beam with modes from 40 Hz to 15 kHz.

use std::f64::consts::{FRAC_PI_2, SQRT_2};

use rotordyn_identify::{Settings, identify};
use rotordyn_linalg::Complex64;
use rotordyn_signal::record::MeasurementNoise;

use crate::known_modes::{KnownMode, frfs, lines};
use crate::random::Random;

/// Bending shape n of a free beam at x in 0..1, modal mass 1: cos βx − sin βx + e^{−βx} ∓ e^{−β(1−x)}, β = (2n + 1)π/2.
///
/// The asymptotic form; of the exact one it differs by e^{−β}, 1 % for n = 1. Source: Blevins, Formulas for Natural
/// Frequency and Mode Shape (1979), table 8-1.
fn free_shape(n: usize, x: f64) -> f64 {
    let beta = (2 * n + 1) as f64 * FRAC_PI_2;
    let sign = if n.is_multiple_of(2) { 1.0 } else { -1.0 };
    (beta * x).cos() - (beta * x).sin() + (-beta * x).exp() - sign * (-beta * (1.0 - x)).exp()
}

fn free_beam(points: usize, seed: u64) -> Vec<KnownMode> {
    let mut random = Random::new(seed + 77);
    let place = |k: usize| k as f64 / (points as f64 - 0.7);
    let mut mode = |n: usize| {
        let hz = 40.0 * ((2 * n + 1) as f64 / 3.0).powi(2);
        let zeta = 0.002 + 0.004 * random.uniform() + 0.3 / hz;
        let shape: Vec<f64> = (0..points).map(|k| free_shape(n, place(k)) / SQRT_2).collect();
        KnownMode::real(hz, zeta, &shape, &[0])
    };
    (1..=28).map(&mut mode).collect()
}

/// (modes with a signal above noise, of these found, of these without a mark, wrong modes without a mark).
fn run(seed: u64, points: usize, step: f64, db: f64) -> [usize; 4] {
    let known = free_beam(points, seed);
    let mut made = frfs(&known, &lines(step, 25_000.0, step), 2);
    // Rigid-body motion: constant accelerance.
    made.values.iter_mut().flatten().flatten().for_each(|h| *h += Complex64::from(1.0));
    let rms = |frf: &[Complex64]| (frf.iter().map(|h| h.norm_sqr()).sum::<f64>() / frf.len() as f64).sqrt();
    let noise = 10f64.powf(-db / 20.0) / 10f64.sqrt();
    let audible: Vec<bool> = known
        .iter()
        .map(|m| {
            (0..points).any(|r| {
                let peak = m.residue(r, 0).norm() * m.pole.norm() / m.zeta();
                peak > 3.0 * noise * rms(&made.values[r][0])
            })
        })
        .collect();
    let test = MeasurementNoise { signal_to_noise_db: db, averages: 10, seed };
    let found = identify(&made.with_measurement_noise(&test).unwrap(), &Settings::default()).unwrap();
    let mut out = [0; 4];
    let near = |a: Complex64, b: Complex64| (a - b).norm() < 0.003 * b.norm();
    for k in known.iter().zip(&audible).filter(|(_, audible)| **audible).map(|(k, _)| k) {
        out[0] += 1;
        match found.modes.iter().find(|m| near(m.pole, k.pole)) {
            Some(m) => {
                out[1] += 1;
                out[2] += usize::from(m.quality_warnings.is_empty());
                if !m.quality_warnings.is_empty() {
                    println!("marked: {:.2} Hz {:?}", m.frequency_hz(), m.quality_warnings);
                }
            }
            None => println!("missing: {:.2} Hz", k.hz()),
        }
    }
    for m in &found.modes {
        if known.iter().all(|k| !near(m.pole, k.pole)) {
            out[3] += usize::from(m.quality_warnings.is_empty());
            println!(
                "wrong: {:.2} Hz, {:.2} %, {:?}",
                m.frequency_hz(),
                100.0 * m.damping_ratio(),
                m.quality_warnings
            );
        }
    }
    println!("bands {:.0?}", found.bands);
    println!("dropped {:#?}", found.dropped);
    println!("RESULT seed {seed}, step {step}, {db} dB: {out:?}");
    out
}

#[test]
fn modes_from_40_hz_to_15_khz() {
    let [audible, found, plain, wrong] = run(0, 6, 2.0, 40.0);
    assert!(audible >= 27, "{audible}");
    assert!(found * 100 >= 95 * audible && plain * 100 >= 95 * audible && wrong == 0);
}

#[test]
#[ignore = "a study of minutes"]
fn free_beams() {
    let mut sums = [0; 4];
    for seed in 20..25 {
        for db in [50.0, 30.0] {
            let own = run(seed, 8, 1.0, db);
            sums.iter_mut().zip(own).for_each(|(sum, own)| *sum += own);
        }
    }
    println!("RESULT {sums:?}");
    assert!(sums[2] * 100 >= 95 * sums[0] && sums[3] == 0);
}
