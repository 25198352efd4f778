//! Modes that the identification cannot separate: what it says of their errors.

use rotordyn_identify::mac::mac;
use rotordyn_identify::{Settings, identify};
use rotordyn_signal::record::MeasurementNoise;

use crate::known_modes::{KnownMode, frfs, lines};

/// Modes of an overhung fan of which the last two in the band, closer than a third of their bandwidth, are found as one.
fn known() -> Vec<KnownMode> {
    let modes: [(f64, f64, [f64; 6]); 6] = [
        (122.4, 0.005, [1.0, 0.1, 0.6, 0.05, 0.3, 0.02]),
        (141.3, 0.0024, [0.1, 1.0, 0.04, 0.7, 0.03, 0.4]),
        (237.0, 0.0072, [0.9, 0.0, -0.6, 0.1, -0.8, 0.0]),
        (444.1, 0.036, [0.15, -0.02, 0.1, -0.4, 0.7, 0.3]),
        (449.3, 0.035, [0.12, 0.05, -0.6, 0.2, 0.1, -0.5]),
        (617.4, 0.02, [0.8, 0.1, -0.5, 0.0, 0.9, -0.1]),
    ];
    modes.iter().map(|(hz, zeta, shape)| KnownMode::real(*hz, *zeta, shape, &[0])).collect()
}

#[test]
fn shape_of_two_modes_found_as_one_has_its_error() {
    let known = known();
    let exact = frfs(&known, &lines(5.0, 500.0, 0.5), 2);
    let mut merged = 0;
    for seed in 0..6 {
        for db in [40.0, 60.0] {
            let test = MeasurementNoise { signal_to_noise_db: db, averages: 10, seed };
            let found =
                identify(&exact.with_measurement_noise(&test).unwrap(), &Settings::default()).unwrap();
            for m in &found.modes {
                let distance = |k: &KnownMode| (m.pole - k.pole).norm();
                let Some(near) = known.iter().min_by(|a, b| distance(a).total_cmp(&distance(b))) else {
                    continue;
                };
                let off = (1.0 - mac(&m.shape, &near.shape)).sqrt();
                println!(
                    "{seed} {db} dB: {:.2} +- {:.2} Hz of {:.2}, shape {off:.4} +- {:.4} {:?}",
                    m.frequency_hz(),
                    m.frequency_error,
                    near.hz(),
                    m.shape_error,
                    m.quality_warnings
                );
                merged += usize::from(off > 0.3);
                assert!(off < 3.0 * m.shape_error.max(0.01), "{off} +- {}", m.shape_error);
            }
        }
    }
    assert!(merged > 0, "the modes are separated: the test tests nothing");
}
