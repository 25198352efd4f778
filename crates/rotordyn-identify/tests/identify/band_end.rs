//! Modes near the end of the band with a larger mode just beyond it: no residual term stands for it.

use rotordyn_identify::{Settings, identify};
use rotordyn_signal::record::MeasurementNoise;

use crate::known_modes::{KnownMode, bending_shape, frfs, lines};

const POINTS: usize = 8;
/// Motion of the modes beyond the band over that of those in it.
const LARGER: f64 = 4.0;
/// Largest error over its standard error: without the error of truncation 1.95, however small the noise.
const MAX_PULL: f64 = 1.5;

#[test]
fn errors_of_a_mode_below_a_mode_beyond_the_band() {
    let hz = [31.0, 58.0, 96.0, 108.0, 115.0 * 1.05, 150.0];
    let mode = |(k, hz): (usize, &f64)| {
        let size = if k < 4 { 1.0 } else { LARGER };
        let shape: Vec<f64> = bending_shape(k + 1, POINTS).iter().map(|v| v * size).collect();
        KnownMode::real(*hz, 0.02, &shape, &[1])
    };
    let known: Vec<KnownMode> = hz.iter().enumerate().map(mode).collect();
    let exact = frfs(&known, &lines(4.0, 115.0, 0.1), 2);
    for (seed, db) in [80.0, 60.0, 40.0].into_iter().enumerate() {
        let test = MeasurementNoise { signal_to_noise_db: db, averages: 10, seed: seed as u64 };
        let found = identify(&exact.with_measurement_noise(&test).unwrap(), &Settings::default()).unwrap();
        let truth = &known[3];
        let distance = |m: &&rotordyn_identify::Mode| (m.pole - truth.pole).norm();
        let m = found.modes.iter().min_by(|a, b| distance(a).total_cmp(&distance(b))).unwrap();
        let pull = [
            (m.frequency_hz() - truth.hz()) / m.frequency_error,
            (m.damping_ratio() - truth.zeta()) / m.damping_error,
        ];
        println!("{db} dB: {pull:.2?}");
        assert!(pull.iter().all(|pull| pull.abs() < MAX_PULL), "{db} dB: {pull:.2?}");
    }
}
