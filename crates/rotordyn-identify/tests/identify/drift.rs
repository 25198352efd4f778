//! A weak mode next to a strong one that differs from row to row: refinement draws its pole to the misfit of the strong
//! one. The stable pole stays, with a mark.

use std::f64::consts::TAU;

use rotordyn_identify::{QualityWarning, Settings, identify};
use rotordyn_linalg::Complex64;
use rotordyn_signal::record::{Dof, FrfMatrix, MeasurementNoise};

use crate::known_modes::lines;
use crate::random::Random;

const POINTS: usize = 7;
const WEAK_HZ: f64 = 968.0;

/// Mobilities: a mode at 700 Hz, the weak one, and a strong one near 1040 Hz whose frequency scatters by 1 %.
fn measured(seed: u64, share: f64, scatter: f64) -> FrfMatrix {
    let mut random = Random::new(seed + 300);
    let frequencies = lines(600.0, 1200.0, 1.0);
    let shapes: Vec<[f64; 3]> =
        (0..POINTS).map(|_| [random.gaussian(), share * random.gaussian(), random.gaussian()]).collect();
    let rows: Vec<f64> = (0..POINTS).map(|_| 1.0 + scatter * random.gaussian()).collect();
    let curve = |r: usize| {
        let value = |f: &f64| {
            let omega = TAU * f;
            let modes = [(700.0, 0.006), (WEAK_HZ, 0.008), (1040.0 * rows[r], 0.01)];
            let sum: Complex64 = modes
                .iter()
                .zip(shapes[r])
                .map(|((hz, zeta), shape)| {
                    let natural = TAU * hz;
                    let damped =
                        Complex64::new(natural * natural - omega * omega, 2.0 * zeta * natural * omega);
                    shape / damped
                })
                .sum();
            Complex64::new(0.0, omega) * sum
        };
        vec![frequencies.iter().map(value).collect()]
    };
    FrfMatrix {
        responses: (0..POINTS).map(|k| Dof::new(k as i64 + 1, 3)).collect(),
        references: vec![Dof::new(1, 3)],
        values: (0..POINTS).map(curve).collect(),
        units: vec![vec!["(m/s)/N".into()]; POINTS],
        coherence: None,
        frequencies,
    }
}

#[test]
fn a_stable_pole_is_kept() {
    let (mut kept, mut held, mut far, mut count) = (0, 0, 0, 0);
    for seed in 0..8 {
        let test = MeasurementNoise { signal_to_noise_db: 50.0, averages: 10, seed };
        let made = measured(seed, 0.02, 0.01).with_measurement_noise(&test).unwrap();
        let found = identify(&made, &Settings::default()).unwrap();
        let own = found.modes.iter().find(|m| (m.frequency_hz() / WEAK_HZ - 1.0).abs() < 0.01);
        count += 1;
        kept += usize::from(own.is_some());
        held += usize::from(own.is_some_and(|m| m.quality_warnings.contains(&QualityWarning::Held)));
        far +=
            found.modes.iter().filter(|m| m.quality_warnings.is_empty() && m.damping_ratio() > 0.05).count();
        let list: Vec<String> = found
            .modes
            .iter()
            .map(|m| {
                format!(
                    "{:.1} Hz {:.2} % {:?}",
                    m.frequency_hz(),
                    100.0 * m.damping_ratio(),
                    m.quality_warnings
                )
            })
            .collect();
        let dropped: Vec<String> = found.dropped.iter().map(ToString::to_string).collect();
        println!("{seed}: {}; dropped {}", list.join(", "), dropped.join("; "));
    }
    println!("RESULT kept {kept}, held {held} of {count}, broad without a mark {far}");
    // Without holding stable poles the weak mode is dropped in two of the eight.
    assert!(kept == count && held > 0 && far == 0);
}
