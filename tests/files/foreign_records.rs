//! Records as other programs store them: rate, names, units and 100 samples of each, as `foreign_records.py` states them
//! independently.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::Command;

use rotordyn::io::budget::Limits;
use rotordyn::io::measured;
use rotordyn::signal::record::{Axis, AxisQuantity, MeasuredData, Points, Record, Values};
use serde_json::Value;

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/arrays/foreign")
}

fn expected() -> BTreeMap<String, Value> {
    let text = std::fs::read_to_string(folder().join("expected.json")).unwrap();
    serde_json::from_str(&text).unwrap()
}

/// The files of one extension; none would be a test of nothing.
fn files_ending(endings: &[&str]) -> Vec<(String, Value)> {
    let of_kind = |name: &String| endings.iter().any(|ending| name.ends_with(ending));
    let found: Vec<_> = expected().into_iter().filter(|(name, _)| of_kind(name)).collect();
    assert!(found.len() >= 3, "{endings:?}");
    found
}

#[track_caller]
fn assert_numbers(what: &str, found: &[f64], expected: &[f64]) {
    assert_eq!(found.len(), expected.len(), "{what}");
    for (k, (a, b)) in found.iter().zip(expected).enumerate() {
        // The conversion to SI rounds once here and once there.
        assert!((a - b).abs() <= 2.0 * f64::EPSILON * b.abs(), "{what}[{k}]: {a} {b}");
    }
}

fn flat(values: &Value) -> Vec<f64> {
    let number = |v: &Value| match v {
        Value::Array(pair) => pair.iter().map(|v| v.as_f64().unwrap()).collect(),
        v => vec![v.as_f64().unwrap()],
    };
    values.as_array().unwrap().iter().flat_map(number).collect()
}

fn assert_record(what: &str, record: &Record, expected: &Value) {
    let found = match &record.values {
        Values::Real(values) => values.clone(),
        Values::Complex(values) => values.iter().flat_map(|z| [z.re, z.im]).collect(),
    };
    assert_eq!(record.values.len(), 100, "{what}");
    assert_numbers(what, &found, &flat(&expected["values"]));
    assert_eq!(record.unit, expected["unit"].as_str().unwrap(), "{what}");
    assert_eq!(record.file_unit, expected["file_unit"].as_str().unwrap(), "{what}");
    assert_eq!(record.speed_rpm, expected["speed"].as_f64(), "{what}");
    // Times printed with six digits give their rate to that.
    let close = |a: f64, b: f64| (a - b).abs() <= 1e-9 * b.abs();
    match (&record.axis, expected["rate"].as_f64(), &expected["frequency"]) {
        (Axis { quantity: AxisQuantity::Time, points: Points::Uniform { start, .. } }, Some(rate), _) => {
            assert!(
                close(record.sample_rate().unwrap(), rate),
                "{what}: {:?}, not {rate}",
                record.sample_rate()
            );
            assert!(close(*start, expected["start"].as_f64().unwrap()), "{what}: starts at {start}");
        }
        (Axis { quantity, points: Points::Uniform { start, step } }, None, Value::Array(line)) => {
            assert_eq!(*quantity, AxisQuantity::Frequency, "{what}");
            assert_eq!([*start, *step], [line[0].as_f64().unwrap(), line[1].as_f64().unwrap()], "{what}");
        }
        (Axis { points: Points::Unknown, .. }, None, Value::Null) => {}
        (axis, ..) => panic!("{what}: {axis:?}, expected {expected}"),
    }
}

fn texts(value: &Value) -> Vec<&str> {
    value.as_array().unwrap().iter().map(|v| v.as_str().unwrap()).collect()
}

fn assert_contents(file: &str, found: &MeasuredData, expected: &Value) {
    let channels = expected["channels"].as_object().unwrap();
    let mut names: Vec<&str> = found.records.iter().map(|r| r.name.as_str()).collect();
    names.sort_unstable();
    let mut wanted: Vec<&str> = channels.keys().map(String::as_str).collect();
    wanted.sort_unstable();
    assert_eq!(names, wanted, "{file}");
    for record in &found.records {
        assert_record(&format!("{file}, {}", record.name), record, &channels[&record.name]);
    }
    assert_eq!(found.left_out, texts(&expected["left_out"]), "{file}");
    assert_eq!(found.notes, texts(&expected["notes"]), "{file}");
    let scalars: BTreeMap<&str, f64> =
        found.scalars.iter().map(|(name, value)| (name.as_str(), *value)).collect();
    let wanted = expected["scalars"].as_object().unwrap();
    let wanted: BTreeMap<&str, f64> =
        wanted.iter().map(|(name, v)| (name.as_str(), v.as_f64().unwrap())).collect();
    assert_eq!(scalars, wanted, "{file}");
    for source in texts(&expected["sources"]) {
        assert!(
            found.axis_sources.iter().any(|(_, text)| text == source),
            "{file}: {:?}",
            found.axis_sources
        );
    }
}

#[test]
fn matlab_numpy_and_hdf5() {
    for (name, expected) in files_ending(&[".mat", ".npz", ".h5"]) {
        let path = folder().join(&name);
        assert_contents(&name, &measured::read(&path).unwrap(), &expected);
        // HDF5 is read by a process of its own in the command line.
        let limits = Limits { memory: None, hdf5_program: Some(env!("CARGO_BIN_EXE_rotordyn").into()) };
        assert_contents(&name, &measured::read_within(&path, &limits).unwrap(), &expected);
    }
}

#[test]
fn tables_and_labview() {
    for (name, expected) in files_ending(&[".csv", ".txt", ".lvm"]) {
        assert_contents(&name, &measured::read(&folder().join(&name)).unwrap(), &expected);
    }
}

#[test]
fn waves() {
    for (name, expected) in files_ending(&[".wav"]) {
        assert_contents(&name, &measured::read(&folder().join(&name)).unwrap(), &expected);
    }
}

/// The command states rate, unit, where the rate was found and what was not read.
#[test]
fn the_command_reads_every_format() {
    let all = expected();
    for name in [
        "struct.mat",
        "struct_array.mat",
        "cells.mat",
        "version_4.mat",
        "struct_73.mat",
        "cells_73.mat",
        "names.npz",
        "attributes.h5",
        "iso.csv",
        "utf16_be_bare.csv",
        "segments.lvm",
        "double.wav",
    ] {
        let temporary = tempfile::tempdir().unwrap();
        let mut command = Command::new(env!("CARGO_BIN_EXE_rotordyn"));
        command.arg("signal").arg(folder().join(name)).args([
            "--json",
            "--no-figures",
            "--analyses",
            "spectrum",
        ]);
        let output = command.arg("--out").arg(temporary.path().join("out")).output().unwrap();
        assert!(output.status.success(), "{name}: {}", String::from_utf8_lossy(&output.stderr));
        let document: Value = serde_json::from_slice(&output.stdout).unwrap();
        let contents = &document["contents"];
        let channels = contents["channels"].as_array().unwrap();
        assert_eq!(channels.len(), all[name]["channels"].as_object().unwrap().len(), "{name}");
        for channel in channels {
            let wanted = &all[name]["channels"][channel["name"].as_str().unwrap()];
            let (found, rate) = (channel["sample_rate"].as_f64().unwrap(), wanted["rate"].as_f64().unwrap());
            assert!((found / rate - 1.0).abs() < 1e-9, "{name}: {channel}");
            assert_eq!(
                (&channel["unit"], &channel["unit_in_file"]),
                (&wanted["unit"], &wanted["file_unit"]),
                "{name}"
            );
            assert_eq!(channel["axis_stated_by"].is_string(), !name.ends_with(".wav"), "{name}: {channel}");
        }
        assert_eq!(contents["not_read"], all[name]["left_out"], "{name}");
    }
}

#[test]
fn rates_that_contradict_each_other_are_refused_naming_both() {
    let folder = tempfile::tempdir().unwrap();
    let refused = |name: &str, text: &str| {
        let path = folder.path().join(name);
        std::fs::write(&path, text).unwrap();
        measured::read(&path).unwrap_err().to_string()
    };
    let both = refused("a.csv", "fs: 12 kHz\ndt: 1 ms\nx\n1\n2\n3\n");
    assert!(both.contains("`fs` (12) is 12000 Hz, `dt` (1) is 1000 Hz"), "{both}");
    let column = refused("b.csv", "fs = 500 Hz\ntime,x\n0,1\n0.001,2\n0.002,4\n");
    assert!(column.contains("`fs` (500) is 500 Hz, the column `time` is 1000 Hz"), "{column}");
    let dates = "1/2/2026 0:00,1\n1/3/2026 0:00,2\n1/4/2026 0:00,3\n";
    let open = refused("c.csv", dates);
    assert!(open.contains("`01/02/2026` may be month and day or day and month"), "{open}");
    assert!(open.contains("write the dates as year-month-day"), "{open}");
    // A rate that is the same within the digits of the other is none.
    let path = folder.path().join("d.csv");
    std::fs::write(&path, "fs: 12 kHz\ndt: 8.33e-5\nx\n1\n2\n3\n").unwrap();
    assert_eq!(measured::read(&path).unwrap().records[0].sample_rate(), Ok(12_000.0));
}

#[test]
fn tdms_is_refused_with_the_way_round() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.tdms");
    std::fs::write(&path, b"TDSm\x0e\0\0\0\x69\x12\0\0").unwrap();
    let error = measured::read(&path).unwrap_err().to_string();
    assert!(
        error.contains("it is a TDMS file") && error.contains("npTDMS") && error.contains(".lvm"),
        "{error}"
    );
}
