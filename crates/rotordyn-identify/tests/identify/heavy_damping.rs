//! Heavily damped modes: found, or named where they are left out for their damping.

use rotordyn_identify::{IdentifyError, Settings, identify};
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

/// A record of more than a decade and a half is identified in bands: each names its own poles, once.
#[test]
fn bands_of_a_wide_record_name_what_they_leave_out() {
    let shape = [[0.9, -0.4, 0.7, 0.3], [0.5, 0.8, -0.6, 0.4], [0.2, 0.7, 0.9, -0.5]];
    let known: Vec<KnownMode> = [4.0, 60.0, 280.0]
        .iter()
        .zip(&shape)
        .map(|(hz, of)| KnownMode::real(*hz, 0.02, of, &[0, 2]))
        .collect();
    let made = frfs(&known, &lines(1.0, 400.0, 0.125), 0);
    let settings = Settings { largest_damping: 0.01, ..Settings::default() };
    let IdentifyError::NoMode { dropped, .. } = identify(&made, &settings).unwrap_err() else {
        panic!("another error")
    };
    let named = dropped.iter().filter(|pole| pole.reason.contains("damping above the limit of 1 %"));
    let found: Vec<f64> = named.map(|pole| pole.value.norm() / std::f64::consts::TAU).collect();
    assert_eq!(found.len(), 3, "{dropped:?}");
    for (found, known) in found.iter().zip([4.0, 60.0, 280.0]) {
        assert!((found / known - 1.0).abs() < 1e-3, "{found} Hz for {known}");
    }
    let error = identify(&made, &settings).unwrap_err().to_string();
    assert_eq!(error.matches("left out").count(), 1, "{error}");
}
