//! .mat and .npz files: exchange with scipy and numpy in both directions, and damaged files.
//!
//! `tests/data/arrays` contains the files and, in `numpy.json`, the output of `read_arrays.py` for the
//! written ones. Without Python the files are compared with that; with Python the script is run again.

use std::path::{Path, PathBuf};
use std::process::Command;

use rotordyn::io::hdf5::Store;
use rotordyn::io::{measured, uff, wav};
use rotordyn::signal::record::{Kind, MeasuredData, Record, Values};
use serde_json::Value;

use crate::example_records::{everything, time_records};

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/arrays")
}

fn example() -> MeasuredData {
    let mut all = everything();
    all.scalars.push(("X105RPM".into(), 1797.0));
    all
}

fn written(file: &str) -> Vec<u8> {
    let temporary = tempfile::tempdir().unwrap();
    let path = temporary.path().join(file);
    measured::write(&path, &example()).unwrap();
    std::fs::read(path).unwrap()
}

#[test]
fn scipy_and_numpy_read_written_files() {
    let stored: Value = serde_json::from_slice(&std::fs::read(folder().join("numpy.json")).unwrap()).unwrap();
    for file in ["all.mat", "all.npz"] {
        assert!(
            std::fs::read(folder().join(file)).is_ok_and(|stored| stored == written(file)),
            "{file} has changed: set ROTORDYN_BLESS=1 to rewrite the files, then run read_arrays.py"
        );
        let numbers =
            |name: &str| -> Vec<f64> { serde_json::from_value(stored[file][name].clone()).unwrap() };
        assert_eq!(numbers("fs"), [12000.0]);
        assert_eq!(numbers("X105RPM"), [1797.0]);
        assert_eq!(stored[file]["housing_B_ax_unit"][0], "m/s^2");
        assert_eq!(stored[file]["rim_disc_y_name"][0], "rim/disc_y");
        assert_eq!(stored[file]["density_unit"][0], "(m/s^2)^2/Hz");
        for record in &example().records {
            let got = numbers(&record.name.replace('/', "_"));
            let want: Vec<f64> = match &record.values {
                Values::Real(v) => v.clone(),
                Values::Complex(v) => v.iter().flat_map(|v| [v.re, v.im]).collect(),
            };
            assert_eq!(got, want, "{}", record.name);
        }
    }
}

#[test]
fn numpy_output_matches_stored_output() {
    if std::env::var_os("ROTORDYN_BLESS").is_some() {
        std::fs::create_dir_all(folder()).unwrap();
        ["all.mat", "all.npz"].iter().for_each(|f| std::fs::write(folder().join(f), written(f)).unwrap());
    }
    let python = std::env::var("ROTORDYN_PYTHON").unwrap_or_else(|_| "python3".into());
    if !crate::hdf5_h5py::has_modules(&python, "scipy.io, numpy") {
        return;
    }
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/files/read_arrays.py");
    let output = Command::new(&python).arg(script).arg(folder()).output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let fresh: Value = serde_json::from_slice(&output.stdout).unwrap();
    let stored: Value = serde_json::from_slice(&std::fs::read(folder().join("numpy.json")).unwrap()).unwrap();
    assert!(
        fresh == stored,
        "numpy's result has changed: compare the output of read_arrays.py with numpy.json"
    );
}

fn real(found: &MeasuredData, name: &str) -> Vec<f64> {
    match &found.record(name).unwrap().values {
        Values::Real(values) => values.clone(),
        Values::Complex(_) => panic!("{name}"),
    }
}

#[test]
fn compressed_scipy_and_numpy_files_are_read() {
    let wave: Vec<f64> = (0..12).map(|k| (0.3 * f64::from(k)).sin()).collect();
    for file in ["scipy_compressed.mat", "numpy_compressed.npz"] {
        let found = measured::read(&folder().join(file)).unwrap();
        assert!(found.scalars.contains(&("X7RPM".into(), 1797.0)), "{file}");
        // sin of the C library and of Rust may differ in the last bit.
        assert!(real(&found, "X7_DE_time").iter().zip(&wave).all(|(a, b)| (a - b).abs() < 2e-16));
        assert_eq!(found.record("X7_DE_time").unwrap().speed_rpm, Some(1797.0));
        let matrix = found.frf_matrix().unwrap();
        assert_eq!((matrix.responses.len(), matrix.references.len(), matrix.frequencies[11]), (3, 2, 5.5));
        assert_eq!((matrix.values[2][1][7].re, matrix.values[2][1][7].im), (127.0, 7.0));
        assert_eq!(matrix.coherence.unwrap()[0][0][0], 0.5);
    }
    let matlab = measured::read(&folder().join("scipy_compressed.mat")).unwrap();
    assert_eq!(matlab.title, "test");
    assert!(matlab.scalars.contains(&("s.a".into(), 1.0)), "{:?}", matlab.scalars);
    assert_eq!(matlab.left_out, ["e (empty)"]);
    let numpy = measured::read(&folder().join("numpy_compressed.npz")).unwrap();
    let count: Vec<f64> = (0..12).map(f64::from).collect();
    assert!(real(&numpy, "big").iter().zip(&wave).all(|(a, b)| (a - b).abs() < 2e-16));
    assert!(real(&numpy, "small").iter().zip(&wave).all(|(a, b)| (a - b).abs() < 6e-8));
    let short = numpy.record("short").unwrap();
    assert_eq!((real(&numpy, "short"), short.unit.as_str()), (count.clone(), "m/s^2"));
    assert_eq!(real(&numpy, "flags")[5..7], [0.0, 1.0]);
    assert_eq!(real(&numpy, "fortran[2]"), count.iter().map(|k| 2.0 * k).collect::<Vec<_>>());
    assert_eq!(numpy.left_out, ["objects (Python objects or a structured type)"]);
    assert!(numpy.records.iter().all(|r| r.kind != Kind::General));
}

/// Files of earlier versions have the record's name as `name_is`.
#[test]
fn earlier_name_arrays_are_read() {
    let temporary = tempfile::tempdir().unwrap();
    let path = temporary.path().join("earlier.h5");
    let store = Store::create(&path).unwrap();
    store.write("/fs", &[1], &[100.0], &[]).unwrap();
    store.write("/rim_disc_y", &[3], &[1.0, 2.0, 3.0], &[]).unwrap();
    store.write_texts("/rim_disc_y_is", &["rim/disc_y"], &[]).unwrap();
    drop(store);
    let found = measured::read(&path).unwrap();
    assert_eq!(found.records.len(), 1);
    assert_eq!(real(&found, "rim/disc_y"), [1.0, 2.0, 3.0]);
}

/// Every format, truncated or with changed bytes, is read or rejected with an error, never with a panic.
#[test]
fn damaged_files_do_not_panic() {
    let temporary = tempfile::tempdir().unwrap();
    let path = temporary.path().join("file");
    let records: Vec<Record> = time_records();
    let wav_file = temporary.path().join("a.wav");
    wav::write(
        &wav_file,
        &records.iter().collect::<Vec<_>>(),
        wav::SampleFormat::Pcm { bits: 24, full_scale: 300.0 },
    )
    .unwrap();
    let small = MeasuredData { records: example().records[..5].to_vec(), ..example() };
    let binary = uff::to_bytes(&small, uff::Options { binary: true, ..uff::Options::default() }).unwrap();
    let ascii = uff::to_bytes(
        &small,
        uff::Options { single: true, geometry: uff::GeometrySets::Modern, binary: false },
    );
    let mut refused = 0;
    for bytes in [
        std::fs::read(folder().join("scipy_compressed.mat")).unwrap(),
        std::fs::read(folder().join("numpy_compressed.npz")).unwrap(),
        written("all.mat"),
        std::fs::read(wav_file).unwrap(),
        binary,
        ascii.unwrap(),
    ] {
        let mut try_read = |bytes: &[u8]| {
            std::fs::write(&path, bytes).unwrap();
            refused += usize::from(measured::read(&path).is_err());
        };
        let step = bytes.len() / 100 + 1;
        (0..bytes.len()).step_by(step).for_each(|end| try_read(&bytes[..end]));
        for at in (0..bytes.len()).step_by(step / 2 + 1) {
            let mut damaged = bytes.clone();
            // A different bit pattern per position, including high bits.
            damaged[at] ^= [0x01, 0x80, 0xff, 0x10][at % 4];
            try_read(&damaged);
        }
    }
    assert!(refused > 300, "{refused}");
}
