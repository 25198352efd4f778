//! One output of which the FRFs were measured at another time: its pole differs, and there is no second mode.

use rotordyn_identify::{Settings, identify};
use rotordyn_signal::record::MeasurementNoise;

use crate::known_modes::{KnownMode, frfs, lines};
use crate::random::Random;

#[test]
fn an_output_measured_at_another_time_gives_no_mode() {
    for seed in 0..4 {
        let mut random = Random::new(seed);
        let mut shape = || (0..12).map(|_| random.gaussian()).collect::<Vec<f64>>();
        let shapes = [shape(), shape(), shape()];
        let modes = |hz: f64, zeta: f64| -> Vec<KnownMode> {
            let places = [[40.0, 0.01], [hz, zeta], [130.0, 0.006]];
            let all = places.iter().zip(&shapes);
            all.map(|([hz, zeta], of)| KnownMode::real(*hz, *zeta, of, &[0, 1, 2])).collect()
        };
        let frequencies = lines(10.0, 180.0, 0.125);
        let mut made = frfs(&modes(90.0, 0.004), &frequencies, 0);
        // 0.3 Hz lower, and damped twice as much.
        made.values[7] = frfs(&modes(89.7, 0.008), &frequencies, 0).values[7].clone();
        let test = MeasurementNoise { signal_to_noise_db: 40.0, averages: 10, seed };
        let found = identify(&made.with_measurement_noise(&test).unwrap(), &Settings::default()).unwrap();
        let list: Vec<f64> = found.modes.iter().map(|mode| mode.frequency_hz()).collect();
        assert_eq!(list.len(), 3, "{seed}: {list:?}");
        assert!((list[1] - 90.0).abs() < 0.1, "{seed}: {list:?}");
    }
}
