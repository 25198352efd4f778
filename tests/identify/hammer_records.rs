//! FRFs from a recorder's time records: three blows to a mode at 40 Hz, one of them double.

use std::f64::consts::{PI, TAU};

use rotordyn::identify::{Settings, identify};
use rotordyn::signal::hammer::{HammerTest, frfs};
use rotordyn::signal::record::{Dof, Measured, Record};

const RATE: f64 = 1024.0;

/// Hammer and two responses, the second -0.6 of the first.
fn records(w: f64, zeta: f64) -> Measured {
    let (n, block) = (3 * 4096, 4096);
    let mut force = vec![0.0; n];
    for (blow, size) in [60.0, 80.0, 50.0].into_iter().enumerate() {
        for k in 0..4 {
            force[blow * block + 40 + k] = size * (PI * (k as f64 + 0.5) / 4.0).sin();
        }
    }
    force[2 * block + 400] = 45.0;
    // Impulse invariant: each sample's force is an impulse f/rate.
    let wd = w * (1.0f64 - zeta * zeta).sqrt();
    let mut first = vec![0.0; n];
    for (at, f) in force.iter().enumerate().filter(|(_, f)| **f != 0.0) {
        for (k, value) in first[at..].iter_mut().enumerate() {
            let t = k as f64 / RATE;
            *value += f / RATE * (-zeta * w * t).exp() * (wd * t).sin() / wd;
        }
    }
    let second = first.iter().map(|v| -0.6 * v).collect();
    let mut list = vec![Record::samples("hammer", RATE, 0.0, force, "N")];
    for (k, values) in [first, second].into_iter().enumerate() {
        let mut own = Record::samples(&format!("x{k}"), RATE, 0.0, values, "m");
        own.response = Dof::new(k as i64 + 1, 2);
        list.push(own);
    }
    Measured { records: list, ..Measured::default() }
}

#[test]
fn good_blows_give_the_mode_and_the_double_one_is_told() {
    let (w, zeta) = (TAU * 40.0, 0.01);
    let (found, warnings) = frfs(&records(w, zeta), &HammerTest::default()).unwrap();
    assert!(warnings.iter().any(|w| w.contains("blow 3") && w.contains("a second hit")), "{warnings:?}");
    let measured = Measured { records: found, ..Measured::default() };
    let matrix = measured.frf_matrix().unwrap();
    assert!(matrix.coherence.is_some());
    assert_eq!(matrix.units[0][0], "m/N");
    let settings = Settings { band: Some([5.0, 120.0]), ..Settings::default() };
    let found = identify(&matrix, &settings).unwrap();
    let natural = |m: &rotordyn::identify::Mode| m.pole.norm() / w - 1.0;
    let near = found.modes.iter().min_by(|a, b| natural(a).abs().total_cmp(&natural(b).abs())).unwrap();
    // Blocks of 4 s: e^{-2.5 rad/s 4 s} = 5e-5 of the response is cut off.
    assert!(natural(near).abs() < 1e-4, "{near:?}");
    assert!((near.damping_ratio() / zeta - 1.0).abs() < 1e-2, "{near:?}");
    assert!((near.shape[1] / near.shape[0] + 0.6).norm() < 1e-3, "{near:?}");
}

#[test]
fn no_force_no_frf() {
    let mut unknown = records(TAU * 40.0, 0.01);
    unknown.records[0].unit = String::new();
    let text = frfs(&unknown, &HammerTest::default()).unwrap_err().to_string();
    assert!(text.contains("no force is known") && text.contains("name its channel"), "{text}");
}
