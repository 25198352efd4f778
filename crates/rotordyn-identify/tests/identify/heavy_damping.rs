//! Heavily damped modes: found, or named where they are left out for their damping.

use rotordyn_identify::{Settings, identify};
use rotordyn_signal::record::MeasurementNoise;

use crate::known_modes::{KnownMode, frfs, lines};

fn modes(zeta: f64) -> [KnownMode; 2] {
    let shape = [[0.9, -0.4, 0.7, 0.3], [0.5, 0.8, -0.6, 0.4]];
    [KnownMode::real(60.0, zeta, &shape[0], &[0, 2]), KnownMode::real(180.0, 0.01, &shape[1], &[0, 2])]
}

#[test]
fn heavily_damped_modes_are_found() {
    for zeta in [0.15, 0.25, 0.4] {
        let known = modes(zeta);
        let test = MeasurementNoise { signal_to_noise_db: 50.0, averages: 10, seed: 1 };
        let made = frfs(&known, &lines(2.0, 300.0, 0.25), 0).with_measurement_noise(&test).unwrap();
        let found = identify(&made, &Settings::default()).unwrap();
        assert_eq!(found.modes.len(), 2, "{zeta}: {:?}, dropped {:?}", found.modes, found.dropped);
        for (mode, known) in found.modes.iter().zip(&known) {
            assert!((mode.pole - known.pole).norm() < 0.02 * known.pole.norm(), "{zeta}: {:?}", mode.pole);
            assert!(mode.quality_warnings.is_empty(), "{zeta}: {:?}", mode.quality_warnings);
        }
    }
}

#[test]
fn a_mode_above_the_limit_is_named() {
    let made = frfs(&modes(0.25), &lines(2.0, 300.0, 0.25), 0);
    let settings = Settings { largest_damping: 0.2, ..Settings::default() };
    let found = identify(&made, &settings).unwrap();
    let named = found.dropped.iter().find(|pole| pole.reason.contains("damping above the limit of 20 %"));
    let named = named.unwrap_or_else(|| panic!("{:?}", found.dropped));
    assert!((named.value - modes(0.25)[0].pole).norm() < 1e-3 * named.value.norm(), "{named}");
    // Where none is left, the error names it.
    let made = frfs(&modes(0.25)[..1], &lines(2.0, 300.0, 0.25), 0);
    let error = identify(&made, &settings).unwrap_err().to_string();
    assert!(error.contains("damping above the limit of 20 %"), "{error}");
}
