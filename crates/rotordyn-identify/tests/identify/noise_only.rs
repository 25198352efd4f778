//! FRFs of which half are noise alone: motion along x and y of a rotor at rest does not couple.

use rotordyn_identify::{Settings, identify};
use rotordyn_linalg::Complex64;

use crate::known_modes::{KnownMode, frfs, lines};
use crate::random::Random;

/// Damped frequencies \[Hz\] and damping ratios along x and along y: the highest ones overlap.
const X: [[f64; 2]; 5] = [[34.9, 9e-4], [120.4, 6.4e-3], [297.0, 0.044], [396.7, 0.055], [486.1, 0.0355]];
const Y: [[f64; 2]; 5] = [[35.2, 7e-4], [122.9, 5e-3], [313.5, 0.0406], [426.4, 0.0477], [501.4, 0.0418]];

#[test]
fn modes_are_found_where_half_of_the_frfs_are_noise() {
    for seed in 0..3 {
        let mut random = Random::new(seed);
        // Four points along x, then along y; hits at the first two points along x and y.
        let references = [0, 1, 4, 5];
        let mut known = Vec::new();
        for (first, list) in [(0, X), (4, Y)] {
            for [hz, zeta] in list {
                let mut shape = [0.0; 8];
                shape[first..first + 4].iter_mut().for_each(|v| *v = random.gaussian() * hz / 35.0);
                known.push(KnownMode::real(hz, zeta, &shape, &references));
            }
        }
        let mut made = frfs(&known, &lines(10.0, 520.0, 0.25), 0);
        let rms =
            |frf: &Vec<Complex64>| (frf.iter().map(|h| h.norm_sqr()).sum::<f64>() / frf.len() as f64).sqrt();
        let largest = made.values.iter().flatten().map(rms).fold(0.0, f64::max);
        for frf in made.values.iter_mut().flatten() {
            let size = rms(frf).hypot(0.1 * largest) * 10f64.powf(-50.0 / 20.0) / 2f64.sqrt();
            frf.iter_mut().for_each(|h| *h += Complex64::new(random.gaussian(), random.gaussian()) * size);
        }
        let found = identify(&made, &Settings::default()).unwrap();
        for known in &known {
            let near = found.modes.iter().find(|m| (m.pole - known.pole).norm() < 0.3 * known.pole.re.abs());
            let near =
                near.unwrap_or_else(|| panic!("{seed}: {} Hz, dropped {:?}", known.hz(), found.dropped));
            assert!(near.frequency_error < 0.002 * known.hz(), "{}: {}", known.hz(), near.frequency_error);
        }
        assert_eq!(found.modes.len(), known.len(), "{seed}");
    }
}
