//! Universal files: exchange with pyuff in both directions.
//!
//! `tests/data/uff` contains the files and, in `pyuff.json`, the output of `read_uff.py` for them (pyuff
//! 2.5.8). Without Python the files are compared with that; with Python the script is run again.

use std::path::Path;
use std::process::Command;

use rotordyn::io::budget::Limits;
use rotordyn::io::uff::{self, GeometrySets, Options};
use rotordyn::signal::record::{AxisQuantity, Kind, MeasuredData, Points, Values};
use serde_json::Value;

use crate::example_records::{assert_record, everything};

fn folder() -> std::path::PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/uff")
}

/// Every stored file with its bytes as written now.
///
/// pyuff reads only complex shapes of three components, and double-precision data only with a double
/// abscissa.
fn files() -> Vec<(&'static str, Vec<u8>)> {
    let mut readable = everything();
    readable.shapes.retain(|shape| shape.components == 3);
    readable.records.retain(|record| record.axis.quantity == AxisQuantity::Time || record.name != "phasors");
    let mut even = MeasuredData { records: readable.records.clone(), ..MeasuredData::default() };
    even.records.retain(|record| record.name != "lines");
    let write = |measured, binary, geometry| {
        uff::to_bytes(measured, Options { binary, single: false, geometry }).unwrap()
    };
    vec![
        ("ascii_classic.uff", write(&readable, false, GeometrySets::Classic)),
        ("ascii_modern.uff", write(&readable, false, GeometrySets::Modern)),
        ("binary.uff", write(&even, true, GeometrySets::Classic)),
    ]
}

#[test]
fn pyuff_reads_written_files() {
    let stored: Value = serde_json::from_slice(&std::fs::read(folder().join("pyuff.json")).unwrap()).unwrap();
    let all = everything();
    for (name, bytes) in files() {
        assert!(
            std::fs::read(folder().join(name)).is_ok_and(|stored| stored == bytes),
            "{name} has changed: set ROTORDYN_BLESS=1 to rewrite the files, then run read_uff.py"
        );
        let precision = if name == "binary.uff" { 0.0 } else { 5e-13 };
        let sets = stored[name].as_array().unwrap();
        let functions: Vec<&Value> = sets.iter().filter(|s| s["type"] == 58).collect();
        assert!(functions.len() >= 7);
        for function in functions {
            let id = function["id1"].as_str().unwrap();
            let want = all.records.iter().find(|r| r.name == id).unwrap();
            assert_eq!(function["rsp_node"], want.response.node);
            assert_eq!(function["rsp_dir"], want.response.direction);
            assert_eq!(function["ref_node"], want.reference.node);
            let parts: Vec<f64> = match &want.values {
                Values::Real(v) => v.clone(),
                Values::Complex(v) => v.iter().flat_map(|v| [v.re, v.im]).collect(),
            };
            let got: Vec<f64> = serde_json::from_value(function["data"].clone()).unwrap();
            assert_eq!(got.len(), parts.len(), "{name} {id}");
            for (a, b) in got.iter().zip(&parts) {
                assert!((a - b).abs() <= precision * b.abs(), "{name} {id}: {a} {b}");
            }
            let x: Vec<f64> = serde_json::from_value(function["x"].clone()).unwrap();
            let points = want.axis.points(want.values.len()).unwrap();
            // pyuff takes the step as printed, with 6 digits.
            assert!(x.iter().zip(&points).all(|(a, b)| (a - b).abs() <= 5e-6 * b.abs()), "{name} {id}");
        }
        let shapes: Vec<&Value> = sets.iter().filter(|s| s["type"] == 55 || s["type"] == 2414).collect();
        assert_eq!(shapes.len(), if name == "binary.uff" { 0 } else { 2 });
        for (shape, want) in shapes.iter().zip(all.shapes.iter().filter(|s| s.components == 3)) {
            let nodes: Vec<f64> = serde_json::from_value(shape["nodes"].clone()).unwrap();
            assert!(nodes.iter().zip(&want.nodes).all(|(a, b)| *a == *b as f64));
            let values: Vec<f64> = serde_json::from_value(shape["values"].clone()).unwrap();
            let parts = want.values.iter().flat_map(|v| [v.re, v.im]);
            assert_eq!(values.len(), 2 * want.values.len());
            assert!(values.iter().zip(parts).all(|(a, b)| (a - b).abs() <= 5e-6 * b.abs()));
        }
    }
}

/// Files written by pyuff: complex values with a wrong byte count, non-uniform abscissae of 8 bytes.
#[test]
fn pyuff_files_are_read() {
    for name in ["pyuff_ascii.uff", "pyuff_binary.uff"] {
        let file = uff::read(&folder().join(name), &Limits::default()).unwrap().0;
        let all = everything();
        let wanted = ["rim/disc_y", "lines", "phasors", "A_fy"];
        assert_eq!(file.records.len(), wanted.len(), "{name}");
        for (got, wanted) in file.records.iter().zip(wanted) {
            let mut want = all.records.iter().find(|r| r.name == wanted).unwrap().clone();
            assert_eq!(got.name, want.name);
            want.speed_rpm = None;
            // pyuff cannot write spectra as such.
            if want.kind == Kind::Spectrum {
                want.kind = Kind::General;
            }
            // Python's division and exp differ in the last bit; pyuff's ASCII has 12 digits, 6 for
            // non-uniform abscissae.
            let (values, axis) = if name == "pyuff_binary.uff" { (4e-16, 0.0) } else { (5e-12, 5e-6) };
            let even = matches!(want.axis.points, Points::Uniform { .. });
            assert_record(got, &want, values, if even { 1e-15 } else { axis });
        }
        assert_eq!(file.geometry.nodes.len(), 4);
        assert_eq!(file.geometry.lines[0].strokes, all.geometry.lines[0].strokes);
        assert_eq!(file.shapes[0].nodes, [3, 12, 5]);
    }
}

#[test]
fn pyuff_output_matches_stored_output() {
    let python = std::env::var("ROTORDYN_PYTHON").unwrap_or_else(|_| "python3".into());
    if std::env::var_os("ROTORDYN_BLESS").is_some() {
        std::fs::create_dir_all(folder()).unwrap();
        files().iter().for_each(|(name, bytes)| std::fs::write(folder().join(name), bytes).unwrap());
    }
    if !crate::hdf5_h5py::has_modules(&python, "pyuff, numpy") {
        return;
    }
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/files/read_uff.py");
    let output = Command::new(&python).arg(script).arg(folder()).output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let fresh: Value = serde_json::from_slice(&output.stdout).unwrap();
    let stored: Value = serde_json::from_slice(&std::fs::read(folder().join("pyuff.json")).unwrap()).unwrap();
    assert!(fresh == stored, "pyuff's result has changed: compare the output of read_uff.py with pyuff.json");
}
