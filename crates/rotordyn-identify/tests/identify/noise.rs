//! Noisy FRFs: all modes are found, and their standard errors match the scatter.

use rotordyn_identify::mac::mac;
use rotordyn_identify::{Settings, identify};
use rotordyn_linalg::Complex64;
use rotordyn_signal::record::{Dof, MeasurementNoise};

use crate::known_modes::{KnownMode, bending_shape, frfs, lines};

fn known(references: &[usize]) -> Vec<KnownMode> {
    let modes = [(12.0, 0.01), (31.0, 0.006), (33.0, 0.012), (61.0, 0.004), (88.0, 0.015)];
    modes
        .iter()
        .enumerate()
        .map(|(k, &(hz, zeta))| KnownMode::real(hz, zeta, &bending_shape(k + 1, 8), references))
        .collect()
}

/// RMS over seeds of the pull, (estimate − truth)/(standard error), for every mode: frequency, damping. It is 1 if the
/// standard errors are correct; over 40 seeds it scatters by 1/√80 = 11 %.
fn pulls(references: &[usize], power: i32, db: f64, step: f64, seeds: u64) -> Vec<[f64; 2]> {
    let known = known(references);
    let exact = frfs(&known, &lines(2.0, 110.0, step), power);
    let settings = Settings { max_order: Some(30), ..Settings::default() };
    let mut sums = vec![[0.0; 2]; known.len()];
    let mut bias = vec![[0.0; 2]; known.len()];
    for seed in 0..seeds {
        let test = MeasurementNoise { signal_to_noise_db: db, averages: 10, seed };
        let found = identify(&exact.with_measurement_noise(&test).unwrap(), &settings).unwrap();
        let list: Vec<f64> = found.modes.iter().map(|m| m.frequency_hz()).collect();
        assert_eq!(found.modes.len(), known.len(), "seed {seed}: {list:?}, dropped {:?}", found.dropped);
        for (k, (m, truth)) in found.modes.iter().zip(&known).enumerate() {
            let pull = [
                (m.frequency_hz() - truth.hz()) / m.frequency_error,
                (m.damping_ratio() - truth.zeta()) / m.damping_error,
            ];
            for p in 0..2 {
                sums[k][p] += pull[p] * pull[p] / seeds as f64;
                bias[k][p] += pull[p] / seeds as f64;
            }
        }
    }
    let rms = sums.iter().map(|s| s.map(f64::sqrt)).collect();
    println!("references {references:?}, power {power}, {db} dB: {rms:.2?}, mean {bias:.2?}");
    rms
}

/// Four standard deviations of the RMS of 40 pulls, 1 ± 4/√80.
const BOUNDS: [f64; 2] = [0.55, 1.45];

fn check(pulls: &[[f64; 2]]) {
    for (k, pull) in pulls.iter().enumerate() {
        assert!(pull.iter().all(|p| *p > BOUNDS[0] && *p < BOUNDS[1]), "mode {k}: {pull:.2?}");
    }
}

#[test]
fn standard_errors_match_the_scatter() {
    check(&pulls(&[0, 4], 2, 40.0, 0.1, 40));
}

#[test]
fn standard_errors_match_the_scatter_of_receptances() {
    check(&pulls(&[0], 0, 30.0, 0.1, 40));
}

#[test]
fn standard_errors_match_the_scatter_with_few_lines() {
    // The lowest mode's half-power bandwidth of 0.24 Hz is one line spacing.
    check(&pulls(&[0, 4], 2, 40.0, 0.25, 40));
}

/// RMS of √(1 − MAC) over its stated deviation, 1 if that is correct. A shape has many components, so that 10 seeds suffice
/// for the bounds; one mode is hardly excited, and its shape is tens of times worse than the others.
#[test]
fn shape_errors_match_the_scatter() {
    let mut known = known(&[0, 4]);
    known[2].participation.iter_mut().for_each(|l| *l *= 0.03);
    let exact = frfs(&known, &lines(2.0, 110.0, 0.1), 2);
    let settings = Settings { max_order: Some(30), ..Settings::default() };
    let seeds = 10;
    let (mut sums, mut stated) = (vec![0.0; known.len()], vec![0.0; known.len()]);
    for seed in 0..seeds {
        let test = MeasurementNoise { signal_to_noise_db: 40.0, averages: 10, seed };
        let found = identify(&exact.with_measurement_noise(&test).unwrap(), &settings).unwrap();
        for (k, truth) in known.iter().enumerate() {
            let near = |m: &&rotordyn_identify::Mode| (m.frequency_hz() - truth.hz()).abs() < 0.5;
            let mode = found.modes.iter().find(near).unwrap();
            sums[k] += (1.0 - mac(&mode.shape, &truth.shape)) / mode.shape_error.powi(2) / seeds as f64;
            stated[k] += mode.shape_error / seeds as f64;
        }
    }
    let rms: Vec<f64> = sums.into_iter().map(f64::sqrt).collect();
    println!("{rms:.2?}, stated {stated:?}");
    assert!(rms.iter().all(|rms| (0.5..2.0).contains(rms)), "{rms:.2?}");
    let largest =
        |of: &dyn Fn(usize) -> bool| (0..5).filter(|k| of(*k)).map(|k| stated[k]).fold(0.0, f64::max);
    assert!(stated[2] > 5.0 * largest(&|k| k != 2), "{stated:?}");
}

#[test]
fn same_seed_same_frfs() {
    let exact = frfs(&known(&[0, 4]), &lines(2.0, 110.0, 0.5), 2);
    let test = MeasurementNoise { signal_to_noise_db: 40.0, averages: 10, seed: 3 };
    let noisy = exact.with_measurement_noise(&test).unwrap();
    assert_eq!(noisy, exact.with_measurement_noise(&test).unwrap());
    assert_ne!(noisy, exact.with_measurement_noise(&MeasurementNoise { seed: 4, ..test }).unwrap());
    // 40 dB, ten averages: the response noise alone is 1e-2/√10 of the RMS.
    let (mut off, mut size) = (0.0, 0.0);
    for (a, b) in noisy.values.iter().flatten().flatten().zip(exact.values.iter().flatten().flatten()) {
        off += (a - b).norm_sqr();
        size += b.norm_sqr();
    }
    let ratio: f64 = off / size;
    // Force and response noise contribute 1e-4/10 each; the force noise acts on the few lines of the resonances.
    assert!((ratio / 2e-5 - 1.0).abs() < 0.25, "{ratio:.3e}");
    let coherence = noisy.coherence.unwrap();
    assert!(coherence.iter().flatten().flatten().all(|c| (0.0..=1.0).contains(c)));
}

/// Additional responses that contain only noise: no mode is lost and no standard error grows.
#[test]
fn noise_only_responses_do_not_change_the_modes() {
    let known = known(&[0, 4]);
    let exact = frfs(&known, &lines(2.0, 110.0, 0.1), 2);
    let test = MeasurementNoise { signal_to_noise_db: 40.0, averages: 10, seed: 3 };
    let settings = Settings { max_order: Some(30), ..Settings::default() };
    let good = exact.with_measurement_noise(&test).unwrap();
    let alone = identify(&good, &settings).unwrap();
    let largest = good.values[0][0].iter().map(|h| h.norm()).fold(0.0, f64::max);
    // Sensor noise floor, a thousandth of the largest response, and round-off.
    for floor in [1e-3 * largest, 1e-14 * largest] {
        let mut state = 99_u64;
        let mut noise = || {
            state ^= state << 13;
            state ^= state >> 7;
            state ^= state << 17;
            floor * ((state >> 11) as f64 / (1u64 << 52) as f64 - 1.0)
        };
        let mut frfs = good.clone();
        for k in 0..4 {
            let own = |noise: &mut dyn FnMut() -> f64| {
                good.frequencies.iter().map(|_| Complex64::new(noise(), noise())).collect::<Vec<_>>()
            };
            frfs.responses.push(Dof::new(20 + k, 1));
            frfs.values.push(vec![own(&mut noise), own(&mut noise)]);
            frfs.units.push(good.units[0].clone());
            if let Some(coherence) = &mut frfs.coherence {
                coherence.push(vec![vec![0.1; good.frequencies.len()]; 2]);
            }
        }
        let found = identify(&frfs, &settings).unwrap();
        assert_eq!(found.modes.len(), alone.modes.len(), "{:?}", found.dropped);
        for (with, without) in found.modes.iter().zip(&alone.modes) {
            let (a, b) = (with.frequency_error, without.frequency_error);
            println!("{floor:.1e}: {:.4} Hz +- {a:.1e}, without +- {b:.1e}", with.frequency_hz());
            assert!(a < 1.5 * b, "{a} {b}");
            assert!((with.frequency_hz() - without.frequency_hz()).abs() < 3.0 * b);
        }
    }
}
