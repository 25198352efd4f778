//! Spoiled measurements: the codes of commands that read files.

use crate::copies::Case;
use crate::program;
use crate::spoiled::machine;
use rotordyn::io::measured;
use rotordyn::linalg::Complex64;
use rotordyn::signal::record::{Axis, AxisQuantity, Dof, Kind, MeasuredData, Record, Values};
use rotordyn::warning::Code;
use std::f64::consts::TAU;
use std::path::Path;

pub const CASES: &[Case] = &[
    (Code::LowMac, || {
        let folder = two_discs();
        store_modes(folder.path(), "own", "material.steel.young=210 GPa");
        // Frequencies as the root of the modulus: 21 % lower.
        store_modes(folder.path(), "soft", "material.steel.young=130 GPa");
        ["own", "soft"].map(|file| validate(folder.path(), &[file]))
    }),
    (Code::FrfLevel, || {
        let folder = two_discs();
        let arguments =
            ["frf", "machine.toml", "--no-figures", "--quantity", "accelerance", "--noise", "60 dB"];
        assert!(program::codes(folder.path(), &[&arguments[..], &["--out", "test"]].concat(), 0).is_empty());
        let plain = measured::read(&folder.path().join("test/frf_noisy.uff")).unwrap();
        // In g, with the unit of before.
        let in_g = |record: Record| match (record.kind, &record.values) {
            (Kind::Frf, Values::Complex(h)) => {
                let values = Values::Complex(h.iter().map(|h| h / 9.806_65).collect());
                Record { values, ..record }
            }
            _ => record,
        };
        write(folder.path(), "plain.uff", plain.records.clone());
        write(folder.path(), "spoiled.uff", plain.records.into_iter().map(in_g).collect());
        ["plain.uff", "spoiled.uff"].map(|file| {
            let arguments = ["validate", "machine.toml", "--measured", file];
            program::codes(folder.path(), &[&arguments[..], &OUT].concat(), 0)
        })
    }),
    (Code::MeasuredData, || {
        let folder = two_discs();
        store_modes(folder.path(), "own", "shaft.element_length=15 mm");
        store_modes(folder.path(), "coarse", "shaft.element_length=40 mm");
        [validate(folder.path(), &["own", "own"]), validate(folder.path(), &["own", "coarse"])]
    }),
    (Code::ModelUpdate, || {
        let folder = two_discs();
        store_modes(folder.path(), "own", "bearing.A.k_xx=5e6 N/m");
        // Of a symmetric rotor the modes determine the sum of both stiffnesses only.
        ["bearing.A.k_xx", "bearing.A.k_xx,bearing.B.k_xx"].map(|free| {
            let arguments = ["update", "machine.toml", "--measured", "own/results.h5", "--free", free];
            program::codes(folder.path(), &[&arguments[..], &OUT].concat(), 0)
        })
    }),
    (Code::LackOfFit, || {
        let folder = two_discs();
        store_modes(folder.path(), "own", "bearing.A.k_xx=5e6 N/m");
        store_modes(folder.path(), "soft", "material.steel.young=190 GPa");
        // The stiffness that differs, and one that cannot stand for a softer shaft.
        ["own", "soft"].map(|measured| {
            let file = format!("{measured}/results.h5");
            let arguments = ["update", "machine.toml", "--measured", &file, "--free", "bearing.A.k_xx"];
            program::codes(folder.path(), &[&arguments[..], &OUT].concat(), 0)
        })
    }),
    (Code::ClippedRecord, || {
        let folder = program::folder(&[]);
        let record = shaft_at_30_hz();
        let Values::Real(values) = &record.values else { unreachable!("a record of time") };
        let highest = values.iter().copied().fold(0.0, f64::max);
        let limited = Values::Real(values.iter().map(|v| v.min(0.4 * highest)).collect());
        write(folder.path(), "plain.npz", vec![record.clone()]);
        write(folder.path(), "spoiled.npz", vec![Record { values: limited, ..record }]);
        ["plain.npz", "spoiled.npz"]
            .map(|file| program::codes(folder.path(), &[&["signal", file][..], &OUT].concat(), 0))
    }),
    (Code::DeadChannel, || spoiled_samples(|values| values.fill(0.0))),
    (Code::RecordGap, || spoiled_samples(|values| values[9000..9400].fill(0.0))),
    (Code::RecordSpike, || spoiled_samples(|values| values[9000] = 1e4)),
    (Code::Identification, || {
        let folder = program::folder(&[]);
        let frfs = [1, 2].map(frf);
        let coherences = frfs.iter().map(coherence);
        write(folder.path(), "plain.npz", frfs.iter().cloned().chain(coherences).collect());
        write(folder.path(), "spoiled.npz", frfs.to_vec());
        ["plain.npz", "spoiled.npz"]
            .map(|file| program::codes(folder.path(), &[&["identify", file][..], &OUT].concat(), 0))
    }),
    (Code::LeftOut, || {
        let folder = program::folder(&[]);
        let axis = Axis::uniform(AxisQuantity::Time, 0.0, 1.0 / 5000.0);
        let values = Values::Real((0..2000).map(|k| (0.3 * f64::from(k)).sin()).collect());
        let record = Record::new("acc", Kind::Time, axis, values, "m/s^2");
        for name in ["plain.h5", "spoiled.h5"] {
            write(folder.path(), name, vec![record.clone()]);
        }
        let file = hdf5::File::open_rw(folder.path().join("spoiled.h5")).unwrap();
        file.link_soft("/nowhere", "moved").unwrap();
        drop(file);
        ["plain.h5", "spoiled.h5"]
            .map(|file| program::codes(folder.path(), &[&["signal", file][..], &OUT].concat(), 0))
    }),
    (Code::NotImported, || {
        let text = include_str!("../data/ross/rotors/example_rotor.toml").to_string();
        let spoiled = text.replacen("gyroscopic = true", "gyroscopic = false", 1);
        let folder = program::folder(&[("plain.toml", text), ("spoiled.toml", spoiled)]);
        ["plain.toml", "spoiled.toml"].map(|file| program::codes(folder.path(), &["import", file], 0))
    }),
    (Code::SignalAnalysis, || {
        let sample = |k: u32| format!("{:.5},{:.6}\n", f64::from(k) / 5000.0, (0.3 * f64::from(k)).sin());
        let record = format!("time [s],acc [m/s^2]\n{}", (0..2000).map(sample).collect::<String>());
        let folder = program::folder(&[("record.csv", record)]);
        // The rate of the time column, and another.
        ["5 kHz", "4 kHz"].map(|rate| {
            let arguments = [&["signal", "record.csv", "--rate", rate][..], &OUT].concat();
            program::codes(folder.path(), &arguments, 0)
        })
    }),
    (Code::ShaftSpeedNotFound, || {
        let folder = program::folder(&[]);
        write(folder.path(), "record.npz", vec![shaft_at_30_hz()]);
        // The speed of the record, and one of whose harmonics only the fourth is there.
        ["1800 rpm", "1350 rpm"].map(|speed| {
            let arguments = ["signal", "record.npz", "--bearing", "6205-2RS", "--speed", speed];
            program::codes(folder.path(), &[&arguments[..], &ENVELOPE, &OUT].concat(), 0)
        })
    }),
    (Code::BearingOrdersInconsistent, || {
        let folder = program::folder(&[]);
        write(folder.path(), "record.npz", vec![shaft_at_30_hz()]);
        ["BPFO=3.585,BPFI=5.415", "BPFO=3.585,BPFI=5.46"].map(|orders| {
            let arguments = ["signal", "record.npz", "--bearing-orders", orders, "--speed", "1800 rpm"];
            program::codes(folder.path(), &[&arguments[..], &ENVELOPE, &OUT].concat(), 0)
        })
    }),
    (Code::RecordsDiffer, || {
        let folder = program::folder(&[]);
        let record = shaft_at_30_hz();
        let fast = Axis::uniform(AxisQuantity::Time, 0.0, 1.0 / 6000.0);
        write(folder.path(), "rec1.npz", vec![record.clone()]);
        write(folder.path(), "rec2.npz", vec![record.clone()]);
        write(folder.path(), "rec3.npz", vec![Record { axis: fast, ..record }]);
        ["rec2.npz", "rec3.npz"].map(|second| {
            program::codes(folder.path(), &[&["trend", "rec1.npz", second][..], &OUT].concat(), 0)
        })
    }),
    (Code::TachoJitter, || {
        let folder = program::folder(&[]);
        // A shaft at 30.37 rev/s: 7x, and a fourteenth of it beside.
        let sample = |k: u32| {
            let angle = TAU * 30.37 * f64::from(k) / 5000.0;
            10.0 * (7.0 * angle).cos() + 0.7 * (7.144 * angle).cos()
        };
        let axis = Axis::uniform(AxisQuantity::Time, 0.0, 1.0 / 5000.0);
        let values = Values::Real((0..48_000).map(sample).collect());
        write(folder.path(), "record.npz", vec![Record::new("acc", Kind::Time, axis, values, "m/s^2")]);
        // Its pulses, and as a counter of 4 kHz has them.
        [1e9, 4000.0].map(|clock: f64| {
            let pulse = |k: u32| format!("{:.9}\n", (f64::from(k) / 30.37 * clock).ceil() / clock);
            std::fs::write(folder.path().join("pulses.csv"), (0..285).map(pulse).collect::<String>())
                .unwrap();
            let arguments = [
                "signal",
                "record.npz",
                "--tacho",
                "pulses.csv",
                "--orders",
                "7,7.144",
                "--bandwidth",
                "0.15",
                "--analyses",
                "orders",
            ];
            program::codes(folder.path(), &[&arguments[..], &OUT].concat(), 0)
        })
    }),
];

const OUT: [&str; 3] = ["--no-figures", "--out", "out"];

const ENVELOPE: [&str; 2] = ["--analyses", "envelope"];

/// Five seconds of 1x, 2x and 3x of 30 rev/s in noise.
fn shaft_at_30_hz() -> Record {
    let axis = Axis::uniform(AxisQuantity::Time, 0.0, 1.0 / 5000.0);
    let mut state = 1u32;
    let sample = |k: u32| {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        let noise = f64::from(state) / f64::from(u32::MAX) - 0.5;
        let angle = TAU * 30.0 * f64::from(k) / 5000.0;
        noise + 0.3 * angle.cos() + 0.2 * (2.0 * angle).cos() + 0.2 * (3.0 * angle).cos()
    };
    Record::new("acc", Kind::Time, axis, Values::Real((0..25_000).map(sample).collect()), "m/s^2")
}

/// Codes of a record as measured, and with its samples spoiled.
fn spoiled_samples(spoil: fn(&mut [f64])) -> [std::collections::BTreeSet<String>; 2] {
    let folder = program::folder(&[]);
    let record = shaft_at_30_hz();
    let Values::Real(mut values) = record.values.clone() else { unreachable!("a record of time") };
    spoil(&mut values);
    write(folder.path(), "plain.npz", vec![record.clone()]);
    write(folder.path(), "spoiled.npz", vec![Record { values: Values::Real(values), ..record }]);
    let analyses = ["--analyses", "spectrum"];
    ["plain.npz", "spoiled.npz"]
        .map(|file| program::codes(folder.path(), &[&["signal", file][..], &analyses, &OUT].concat(), 0))
}

fn two_discs() -> tempfile::TempDir {
    program::folder(&[("machine.toml", machine("two_discs_soft").text())])
}

/// Modes of the machine with one other value, as if they were measured.
fn store_modes(folder: &Path, name: &str, set: &str) {
    let arguments = ["modal", "machine.toml", "--no-figures", "--out", name, "--set", set];
    assert!(program::codes(folder, &arguments, 0).is_empty());
}

/// Codes of the comparison of the machine with stored modes.
fn validate(folder: &Path, files: &[&str]) -> std::collections::BTreeSet<String> {
    let paths: Vec<String> = files.iter().map(|file| format!("{file}/results.h5")).collect();
    let measured = paths.iter().flat_map(|path| ["--measured", path]);
    let arguments: Vec<&str> = ["validate", "machine.toml"].into_iter().chain(measured).chain(OUT).collect();
    program::codes(folder, &arguments, 0)
}

/// Accelerance of a structure with two modes, 5 to 110 Hz, at the driving point and another.
fn frf(point: i64) -> Record {
    let accelerance = |hz: f64| -> Complex64 {
        let s = Complex64::new(0.0, TAU * hz);
        let mode = |natural: f64, zeta: f64| {
            let omega = TAU * natural;
            s * s / (s * s + 2.0 * zeta * omega * s + omega * omega)
        };
        mode(21.0, 0.006) + mode(48.0, 0.009) * if point == 1 { 1.0 } else { -0.6 }
    };
    let values = (0..421).map(|k| accelerance(5.0 + 0.25 * f64::from(k))).collect();
    let axis = Axis::uniform(AxisQuantity::Frequency, 5.0, 0.25);
    let mut record =
        Record::new(&format!("y{point}/f1"), Kind::Frf, axis, Values::Complex(values), "(m/s^2)/N");
    (record.response, record.reference) = (Dof::new(point, 2), Dof::new(1, 2));
    record
}

fn coherence(frf: &Record) -> Record {
    let values = Values::Real(vec![0.999; frf.values.len()]);
    let record =
        Record::new(&format!("coherence {}", frf.name), Kind::Coherence, frf.axis.clone(), values, "1");
    Record { response: frf.response, reference: frf.reference, ..record }
}

fn write(folder: &Path, name: &str, records: Vec<Record>) {
    measured::write(&folder.join(name), &MeasuredData { records, ..MeasuredData::default() }).unwrap();
}
