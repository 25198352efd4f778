//! MATLAB structures, cells and version 4 files, written by scipy (`matlab_structures.py`).

use std::path::Path;

use rotordyn::io::measured;
use rotordyn::signal::record::{AxisQuantity, Kind, MeasuredData, Points, Record, Values};

fn read(name: &str) -> MeasuredData {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/arrays/structures");
    measured::read(&folder.join(name)).unwrap()
}

fn names(data: &MeasuredData) -> Vec<&str> {
    data.records.iter().map(|r| r.name.as_str()).collect()
}

#[track_caller]
fn assert_record(data: &MeasuredData, name: &str, step: f64, value: impl Fn(f64) -> f64) -> Record {
    let record = data.record(name).unwrap_or_else(|_| panic!("{name} in {:?}", names(data)));
    assert_eq!(record.axis.points, Points::Uniform { start: 0.0, step }, "{name}");
    let Values::Real(values) = &record.values else { panic!("{name} is complex") };
    assert_eq!(values.len(), 100, "{name}");
    for (k, found) in values.iter().enumerate() {
        // sin of the C library and of Rust may differ in the last bit.
        let expected = value(k as f64);
        assert!(
            (found - expected).abs() <= 2e-16 * expected.abs().max(1.0),
            "{name}[{k}]: {found} {expected}"
        );
    }
    record.clone()
}

/// The record of MFPT: the sampling rate is `sr`; `rate`, the shaft's, is a number like the load.
#[test]
fn fields_of_a_structure_are_channels_with_its_rate() {
    let data = read("mfpt.mat");
    assert_eq!(names(&data), ["bearing.gs"]);
    assert_record(&data, "bearing.gs", 1.0 / 97656.0, |k| (0.3 * k).sin());
    assert_eq!(data.scalars, [("bearing.load".to_owned(), 270.0), ("bearing.rate".to_owned(), 25.0)]);
    assert!(data.left_out.is_empty(), "{:?}", data.left_out);
}

#[test]
fn nested_structures_cells_and_arrays_of_structures_have_paths() {
    let data = read("nested.mat");
    assert_eq!(
        names(&data),
        [
            "rig.sensor.acc.data",
            "rig.slow.level",
            "rig.slow.phase",
            "outside",
            "runs(1).x",
            "runs(2).x",
            "cells{1}",
            "cells{3}"
        ]
    );
    // The rate of the structure around, and the unit beside the only record.
    let acceleration = assert_record(&data, "rig.sensor.acc.data", 0.25, |k| (k + 1.0) * 9.80665);
    assert_eq!((acceleration.unit.as_str(), acceleration.file_unit.as_str()), ("m/s^2", "g"));
    assert_record(&data, "rig.slow.level", 0.5, |k| 3.0 * k);
    assert_record(&data, "rig.slow.phase", 0.5, |k| -k);
    assert_record(&data, "outside", 1.0 / 512.0, |k| 7.0 * k);
    assert_record(&data, "runs(1).x", 1e-3, |k| k);
    assert_record(&data, "runs(2).x", 5e-4, |k| 2.0 * k);
    assert_record(&data, "cells{3}", 1.0 / 512.0, |k| 5.0 * k);
    assert_eq!(data.scalars, [("rig.sensor.temperature".to_owned(), 21.5)]);
    assert_eq!(
        data.left_out,
        [
            "sparse (a sparse matrix)",
            "runs(1).note (text \"first\")",
            "runs(2).note (text \"second\")",
            "cells{2} (text \"text\")"
        ]
    );
}

#[test]
fn responses_of_a_structure_are_over_its_frequencies() {
    let data = read("frf.mat");
    let response = data.record("test.H").unwrap();
    assert_eq!((response.kind, response.axis.quantity), (Kind::Frf, AxisQuantity::Frequency));
    assert_eq!(response.axis.points, Points::Uniform { start: 0.0, step: 0.5 });
    let Values::Complex(values) = &response.values else { panic!("{response:?}") };
    assert!(values.iter().enumerate().all(|(k, v)| (v.re, v.im) == (k as f64, 2.0 * k as f64)));
    assert_eq!(data.record("test.coh").unwrap().kind, Kind::Coherence);
}

#[test]
fn version_4_files_are_read() {
    let data = read("version_4.mat");
    assert_record(&data, "x", 1.0 / 800.0, |k| k);
    assert_record(&data, "y[1]", 1.0 / 800.0, |k| k);
    assert_record(&data, "y[2]", 1.0 / 800.0, |k| -k);
    let Values::Complex(values) = &data.record("z").unwrap().values else { panic!() };
    assert!(values.iter().enumerate().all(|(k, v)| (v.re, v.im) == (0.0, k as f64)));
}
