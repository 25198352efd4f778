//! Forward and backward whirl close in frequency, measured with one reference: two modes, and no mark where they are well apart.

use rotordyn_identify::{QualityWarning, Settings, identify};
use rotordyn_linalg::Complex64;
use rotordyn_signal::record::{Dof, FrfMatrix, MeasurementNoise};

use crate::known_modes::{KnownMode, frfs, lines};
use crate::random::Random;

/// Circular whirl backward and forward at four points, x then y, under a force along x: shapes (1, ∓j) s, of which the
/// motion along y is the difference of two nearly equal terms.
fn whirl_pair(hz: [f64; 2], zeta: [f64; 2]) -> Vec<KnownMode> {
    let shape = [0.9, -0.5, 0.7, 0.4];
    let turned = |turn: Complex64| shape.iter().map(|v| *v * turn).collect::<Vec<_>>();
    let mode = |k: usize, turn: Complex64| {
        let all = [turned(1.0.into()), turned(turn)].concat();
        let mut mode = KnownMode::new(hz[k], zeta[k], all, Vec::new());
        mode.participation = vec![shape[0] / (2.0 * Complex64::i() * mode.pole.im)];
        mode
    };
    vec![mode(0, -Complex64::i()), mode(1, Complex64::i())]
}

fn noisy(modes: &[KnownMode], frequencies: &[f64], db: f64) -> FrfMatrix {
    let test = MeasurementNoise { signal_to_noise_db: db, averages: 10, seed: 3 };
    frfs(modes, frequencies, 0).with_measurement_noise(&test).unwrap()
}

#[test]
fn whirl_pairs_of_one_reference_are_found() {
    // The last is 0.1 % apart, a third of its bandwidth.
    for (hz, zeta) in
        [([59.85, 60.15], [0.01, 0.012]), ([59.7, 60.3], [0.01, 0.012]), ([59.97, 60.03], [0.003, 0.0036])]
    {
        let known = whirl_pair(hz, zeta);
        let mut made = noisy(&known, &lines(20.0, 200.0, 0.125), 40.0);
        made.responses = (0..8).map(|k| Dof::new(k % 4 + 1, if k < 4 { 1 } else { 2 })).collect();
        let found = identify(&made, &Settings::default()).unwrap();
        let list: Vec<_> =
            found.modes.iter().map(|m| (m.frequency_hz(), m.whirl, &m.quality_warnings)).collect();
        assert_eq!(found.modes.len(), 2, "{hz:?}: {list:?}, dropped {:?}", found.dropped);
        for (mode, known) in found.modes.iter().zip(&known) {
            assert!((mode.pole - known.pole).norm() < 0.1 * (known.pole.re.abs()), "{hz:?}: {list:?}");
            assert!(mode.quality_warnings.is_empty(), "{list:?}");
        }
        assert!(found.modes[0].whirl.unwrap() > 0.95 && found.modes[1].whirl.unwrap() < -0.95, "{list:?}");
        assert!(found.total_error < 0.05, "{hz:?}: fit error {}", found.total_error);
    }
}

/// Modes 9 Hz apart, one of 3 % and one of 0.7 %: closer than the larger bandwidth, but each is seen in tens of lines.
#[test]
fn modes_of_unlike_damping_are_not_taken_for_one() {
    for seed in 0..3 {
        let mut random = Random::new(seed);
        let mut shape = || (0..8).map(|_| random.gaussian()).collect::<Vec<f64>>();
        let known = [
            KnownMode::real(317.0, 0.03, &shape(), &[0]),
            KnownMode::real(325.0, 0.007, &shape(), &[0]),
            KnownMode::real(120.0, 0.003, &shape(), &[0]),
        ];
        let found = identify(&noisy(&known, &lines(5.0, 400.0, 0.25), 30.0), &Settings::default()).unwrap();
        for known in &known {
            let near = found.modes.iter().find(|m| (m.pole - known.pole).norm() < 0.1 * known.pole.re.abs());
            let near = near.unwrap_or_else(|| panic!("{}: not found", known.hz()));
            let marks = &near.quality_warnings;
            assert!(!marks.contains(&QualityWarning::MaybeOne), "{} Hz: {marks:?}", known.hz());
            let off = (near.frequency_hz() - known.hz()).abs();
            assert!(off < 4.0 * near.frequency_error && near.frequency_error < 0.2, "{off}");
        }
    }
}

/// Modes 1.3 decay rates apart with shapes of MAC 0.8, as of a shaft turning in anisotropic bearings, beside two more such modes:
/// one pole for each FRF explains far less than the two.
#[test]
fn heavily_damped_modes_of_alike_shapes_are_two() {
    let mut random = Random::new(11);
    let mut shape =
        || (0..12).map(|_| Complex64::new(random.gaussian(), random.gaussian())).collect::<Vec<_>>();
    let [first, other, third] = [shape(), shape(), shape()];
    let mixed: Vec<Complex64> = first.iter().zip(&other).map(|(a, b)| a + 0.45 * b).collect();
    let mode = |hz: f64, zeta: f64, shape: &[Complex64]| {
        let mut mode = KnownMode::new(hz, zeta, shape.to_vec(), Vec::new());
        mode.participation = [0, 4, 7, 9].map(|k| shape[k] / (2.0 * Complex64::i() * mode.pole.im)).to_vec();
        mode
    };
    let known = [
        mode(259.0, 0.044, &third),
        mode(311.7, 0.031, &other),
        mode(339.5, 0.044, &first),
        mode(358.5, 0.023, &mixed),
        mode(566.0, 0.06, &third),
    ];
    for (band, db) in [([200.0, 420.0], 80.0), ([10.0, 700.0], 50.0)] {
        let found =
            identify(&noisy(&known, &lines(band[0], band[1], 0.5), db), &Settings::default()).unwrap();
        let list: Vec<_> = found.modes.iter().map(|m| (m.frequency_hz(), m.damping_ratio())).collect();
        for known in known.iter().filter(|known| known.hz() < 0.9 * band[1]) {
            let near = found.modes.iter().find(|m| (m.pole - known.pole).norm() < 0.1 * known.pole.re.abs());
            assert!(near.is_some(), "{} Hz in {band:?}: {list:?}, dropped {:?}", known.hz(), found.dropped);
        }
    }
}
