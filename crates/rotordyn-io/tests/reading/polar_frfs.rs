//! FRFs in tables as magnitude and phase, and their coherence.

use std::f64::consts::TAU;

use crate::{names, read};
use rotordyn_signal::Complex;
use rotordyn_signal::record::{Kind, MeasuredData, Values};

const COUNT: usize = 200;

/// A mode at 40 Hz: accelerance.
fn frf(k: usize) -> Complex<f64> {
    let hz = 5.0 + 0.5 * k as f64;
    let s = Complex::new(0.0, TAU * hz);
    let omega = TAU * 40.0;
    s * s / (s * s + 2.0 * 0.02 * omega * s + omega * omega)
}

fn table(head: &str, cells: impl Fn(usize, Complex<f64>) -> String) -> MeasuredData {
    let lines: String =
        (0..COUNT).map(|k| format!("{},{}\n", 5.0 + 0.5 * k as f64, cells(k, frf(k)))).collect();
    read("t.csv", format!("frequency [Hz],{head}\n{lines}").as_bytes(), None).unwrap()
}

fn check(found: &MeasuredData, name: &str, unit: &str, factor: f64) {
    assert_eq!(names(found), [name]);
    let record = &found.records[0];
    assert_eq!((record.kind, record.unit.as_str()), (Kind::Frf, unit));
    let Values::Complex(values) = &record.values else { panic!("{name}") };
    for (k, value) in values.iter().enumerate() {
        assert!((value - frf(k) * factor).norm() < 1e-6 * factor * frf(k).norm(), "{name} line {k}: {value}");
    }
}

#[test]
fn magnitude_and_phase_are_an_frf() {
    for (head, name) in [
        ("H1 magnitude [m/s^2/N],H1 phase [deg]", "H1"),
        ("H1_mag [m/s^2/N],H1_phase [deg]", "H1"),
        ("Mag(H1) [m/s^2/N],Phase(H1) [deg]", "H1"),
        ("H1 [m/s^2/N],H1_phase [deg]", "H1"),
        ("Magnitude [m/s^2/N],Phase (deg)", "Magnitude"),
    ] {
        let found = table(head, |_, h| format!("{:.9e},{:.9}", h.norm(), h.arg().to_degrees()));
        check(&found, name, "(m/s^2)/N", 1.0);
        assert!(found.notes.is_empty(), "{:?}", found.notes);
    }
    // Phases that are not wrapped, in radians, and before the magnitudes; several FRFs.
    let found = table("A phase [rad],A amplitude [g/N],B_mag [m/N],B_phase [deg]", |k, h| {
        let turns = TAU * (k / 50) as f64;
        format!("{:.9},{:.9e},1.5,-90", h.arg() - turns, h.norm())
    });
    assert_eq!(names(&found), ["A", "B"]);
    let Values::Complex(values) = &found.records[0].values else { panic!() };
    assert!((values[120] / (frf(120) * 9.80665) - 1.0).norm() < 1e-6, "{}", values[120]);
    let Values::Complex(values) = &found.records[1].values else { panic!() };
    assert!((values[3] - Complex::new(0.0, -1.5)).norm() < 1e-9, "{}", values[3]);
    // Without a unit of the magnitude, as for real and imaginary parts.
    let found = table("H1_mag,H1_phase [rad]", |_, h| format!("{:.9e},{:.9}", h.norm(), h.arg()));
    check(&found, "H1", "", 1.0);
}

#[test]
fn levels_have_a_reference() {
    for (label, unit, factor) in [
        ("dB re 1 m/s^2/N", "(m/s^2)/N", 1.0),
        ("dB re 1e-6 m/s^2/N", "(m/s^2)/N", 1e-6),
        ("dB re g/N", "(m/s^2)/N", 9.80665),
        ("dB (re 1 (m/s)/N)", "(m/s)/N", 1.0),
    ] {
        let found = table(&format!("H1 [{label}],H1 phase [deg]"), |_, h| {
            format!("{:.9},{:.9}", 20.0 * h.norm().log10(), h.arg().to_degrees())
        });
        check(&found, "H1", unit, factor);
    }
    let found =
        table("H1 [dB],H1 phase [deg]", |_, h| format!("{:.6},{:.6}", h.norm(), h.arg().to_degrees()));
    assert!(found.records.iter().all(|record| record.kind != Kind::Frf));
    assert!(found.notes.iter().any(|note| note.contains("no reference")), "{:?}", found.notes);
}

#[test]
fn what_is_no_frf_stays_apart() {
    // A phase without a unit, a magnitude alone, and a spectrum of one quantity.
    let found = table("Magnitude,Phase", |_, h| format!("{:.6},{:.6}", h.norm(), h.arg()));
    assert!(found.records.iter().all(|record| record.kind != Kind::Frf));
    assert!(found.notes.iter().any(|note| note.contains("the phase has no unit")), "{:?}", found.notes);
    for head in ["H1 [m/s^2/N],H2 [m/s^2/N]", "A mag [m/s^2],A phase [deg]"] {
        let found = table(head, |_, h| format!("{:.6},{:.6}", h.norm(), h.arg()));
        assert_eq!(found.records.len(), 2, "{head}");
        assert!(found.frf_matrix().is_err(), "{head}");
    }
}

#[test]
fn coherence_is_known_by_its_name() {
    for name in ["H1_coherence", "coh_1", "coh1", "coherence H1", "Coherence(H1)"] {
        let found = table(&format!("H1_mag [m/s^2/N],H1_phase [deg],{name}"), |_, h| {
            format!("{:.6e},{:.6},0.98", h.norm(), h.arg().to_degrees())
        });
        let kinds: Vec<Kind> = found.records.iter().map(|record| record.kind).collect();
        assert_eq!(kinds, [Kind::Frf, Kind::Coherence], "{name}");
        assert!(found.frf_matrix().unwrap().coherence.is_some(), "{name}");
    }
}

/// A mapping places the coherence of an FRF with it.
#[test]
fn coherence_is_placed_like_its_frf() {
    let mut found =
        table("H1_mag [m/N],H1_phase [deg],coh_1,H2_mag [m/N],H2_phase [deg],H2_coherence", |_, _| {
            "1,2,0.9,3,4,0.8".into()
        });
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("m.toml");
    let entry = |name: &str, at: u32| {
        format!(
            "[channel.{name}]\nstation = \"{at}\"\ndirection = \"x\"\nreference = {{ station = \"1\", direction = \"x\" }}\n"
        )
    };
    std::fs::write(&path, entry("H1", 1) + &entry("H2", 2)).unwrap();
    let mapping = rotordyn_io::measured::mapping::read(&path).unwrap();
    let warnings = mapping.apply(&mut found, &|name| name.parse().ok(), &path).unwrap();
    assert!(warnings.is_empty(), "{warnings:?}");
    let coherence = found.frf_matrix().unwrap().coherence.unwrap();
    assert_eq!((coherence[0][0][5], coherence[1][0][5]), (0.9, 0.8));
}
