//! Faults of single channels of measured FRFs beside computed ones: factors, signs, exchanged and dead responses.

use std::f64::consts::TAU;

use rotordyn::linalg::Complex64;
use rotordyn::update::frf_levels::{FrfFault, FrfGroup, FrfLevels, log_ratio};

type Frfs = Vec<Vec<Vec<Complex64>>>;

/// Shapes over five responses; the forces act at the first and the fourth.
const SHAPES: [[f64; 5]; 3] =
    [[0.3, 0.8, 1.0, 0.6, -0.2], [0.9, 0.2, -0.7, -0.6, 0.5], [-0.5, 0.9, -0.3, 0.8, 0.4]];
const REFERENCES: [usize; 2] = [0, 3];

fn frequencies() -> Vec<f64> {
    (1..400).map(|k| 0.5 * f64::from(k)).collect()
}

/// Accelerances of three modes with natural frequencies and damping off by these factors.
fn frfs(frequency: f64, damping: f64) -> Frfs {
    let modes = [(31.0, 0.01), (77.0, 0.006), (142.0, 0.015)];
    let value = |r: usize, e: usize, f: f64| {
        let s = Complex64::new(0.0, TAU * f);
        let of = |(k, (hz, zeta)): (usize, &(f64, f64))| {
            let omega = TAU * hz * frequency;
            s * s * SHAPES[k][r] * SHAPES[k][REFERENCES[e]]
                / (s * s + s * 2.0 * zeta * damping * omega + omega * omega)
        };
        modes.iter().enumerate().map(of).sum::<Complex64>()
    };
    let row = |r: usize| (0..2).map(|e| frequencies().iter().map(|f| value(r, e, *f)).collect()).collect();
    (0..5).map(row).collect()
}

fn faults(measured: &Frfs) -> Vec<FrfFault> {
    FrfLevels::new(measured, &frfs(1.0, 1.0)).faults(1.0)
}

/// FRFs measured on a structure that differs a little from the model.
fn measured() -> Frfs {
    frfs(1.002, 1.2)
}

fn scaled(of: impl Fn(usize, usize) -> f64) -> Frfs {
    let mut all = measured();
    for (r, row) in all.iter_mut().enumerate() {
        for (e, frf) in row.iter_mut().enumerate() {
            frf.iter_mut().for_each(|h| *h *= of(r, e));
        }
    }
    all
}

#[test]
fn a_model_with_errors_has_no_fault() {
    for (frequency, damping) in [(1.0, 1.0), (1.002, 1.2), (0.995, 0.6), (1.05, 2.0), (1.3, 1.0)] {
        let found = faults(&frfs(frequency, damping));
        assert!(found.is_empty(), "{frequency} {damping}: {found:?}");
    }
}

#[test]
fn factor_of_one_channel_is_named() {
    let found = faults(&scaled(|r, _| if r == 2 { 2.0 } else { 1.0 }));
    let [FrfFault::Factor { of: FrfGroup::Response(2), factor }] = found[..] else { panic!("{found:?}") };
    assert!((factor - 0.5).abs() < 0.02, "{factor}");
    let found = faults(&scaled(|_, e| if e == 1 { 2.0 } else { 1.0 }));
    let [FrfFault::Factor { of: FrfGroup::Reference(1), factor }] = found[..] else { panic!("{found:?}") };
    assert!((factor - 0.5).abs() < 0.02, "{factor}");
    // All of them have none of their own.
    assert_eq!(faults(&scaled(|_, _| 1.5)), []);
    assert_eq!(faults(&scaled(|_, _| 0.1)), []);
}

#[test]
fn signs_points_and_sensors_are_named() {
    let found = faults(&scaled(|r, _| if r == 1 { -1.0 } else { 1.0 }));
    assert_eq!(found, [FrfFault::Reversed { of: FrfGroup::Response(1) }]);
    let found = faults(&scaled(|_, e| if e == 1 { -1.0 } else { 1.0 }));
    assert_eq!(found, [FrfFault::Reversed { of: FrfGroup::Reference(1) }]);
    assert_eq!(faults(&scaled(|_, _| -1.0)), [FrfFault::Reversed { of: FrfGroup::All }]);
    let mut exchanged = measured();
    exchanged.swap(1, 4);
    assert_eq!(faults(&exchanged), [FrfFault::Exchanged { responses: [1, 4] }]);
    let mut dead = measured();
    let noise = |k: usize| Complex64::new((0.7 * (k * k) as f64).sin(), (1.3 * (k * k) as f64).cos());
    dead[3].iter_mut().for_each(|frf| frf.iter_mut().enumerate().for_each(|(k, h)| *h = 1e-4 * noise(k)));
    assert_eq!(faults(&dead), [FrfFault::Dead { response: 3 }]);
}

/// The level is that of the factor, whatever the damping and noise between the resonances.
#[test]
fn level_is_independent_of_damping() {
    let computed = frfs(1.0, 1.0);
    let found = log_ratio(&frfs(1.0, 3.0)[0][0], &computed[0][0]).unwrap();
    assert!(found.abs() < 0.05, "{found}");
    assert_eq!(log_ratio(&[Complex64::ZERO; 9], &computed[0][0][..9]), None);
}
