//! Speed of identification: 74 responses to 3 references, 1600 lines, orders up to 60.

use std::f64::consts::TAU;
use std::hint::black_box;

use criterion::{Criterion, criterion_group, criterion_main};
use rotordyn::identify::{Settings, identify};
use rotordyn::linalg::Complex64;
use rotordyn::signal::record::{Dof, FrfMatrix, MeasurementNoise};

/// Thirteen modes of a plate-like structure from 18 to 170 Hz, with noise 40 dB below and ten averages.
fn measured() -> FrfMatrix {
    let frequencies: Vec<f64> = (0..1600).map(|k| 5.0 + 0.11 * f64::from(k)).collect();
    let modes: Vec<(Complex64, usize)> = (0..13)
        .map(|m| {
            let omega = TAU * (18.0 + 12.3 * m as f64 + f64::from(m as u32 % 3) * 1.7);
            let zeta = 0.002 + 0.0004 * (m % 5) as f64;
            (Complex64::new(-zeta * omega, omega), m)
        })
        .collect();
    let shape = |m: usize, p: usize| ((m as f64 + 0.6) * (0.11 * p as f64 + 0.3)).sin() + 0.2;
    let value = |r: usize, e: usize, hz: f64| {
        let s = Complex64::new(0.0, TAU * hz);
        let sum: Complex64 = modes
            .iter()
            .map(|(pole, m)| {
                let a = shape(*m, r) * shape(*m, 25 * e + 3) / (Complex64::i() * 2.0 * pole.im);
                a / (s - pole) + a.conj() / (s - pole.conj())
            })
            .sum();
        sum * s * s
    };
    let curve = |r, e| frequencies.iter().map(|hz| value(r, e, *hz)).collect();
    let exact = FrfMatrix {
        values: (0..74).map(|r| (0..3).map(|e| curve(r, e)).collect()).collect(),
        responses: (0..74).map(|r| Dof::new(r + 1, 3)).collect(),
        references: (0..3).map(|e| Dof::new(25 * e + 4, 3)).collect(),
        units: vec![vec!["(m/s^2)/N".into(); 3]; 74],
        coherence: None,
        frequencies,
    };
    let test = MeasurementNoise { signal_to_noise_db: 40.0, averages: 10, seed: 1 };
    exact.with_measurement_noise(&test).expect("a valid test")
}

fn poles(c: &mut Criterion) {
    let frfs = measured();
    let found = identify(&frfs, &Settings::default()).expect("there are modes");
    assert_eq!(found.modes.len(), 13);
    c.bench_function("identify, 222 FRFs, 1600 lines, order 60", |b| {
        b.iter(|| identify(black_box(&frfs), &Settings::default()));
    });
}

criterion_group! { name = benches; config = Criterion::default().sample_size(10); targets = poles }
criterion_main!(benches);
