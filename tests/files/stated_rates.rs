//! Rates and axes by every name in use, in MATLAB 5 and 7.3, NumPy and tables alike (`stated_rates.py`, scipy and h5py).

use std::path::Path;
use std::process::Command;

use rotordyn::io::budget::Limits;
use rotordyn::io::measured::{read, read_at_rate};
use rotordyn::signal::record::{AxisQuantity, MeasuredData, Points, Values};

use crate::hdf5_h5py::has_modules;

const ENDINGS: [&str; 4] = [".mat", "_73.mat", ".npz", ".csv"];

fn written() -> Option<tempfile::TempDir> {
    let python = std::env::var("ROTORDYN_PYTHON").unwrap_or_else(|_| "python3".into());
    if !has_modules(&python, "numpy, scipy, h5py") {
        return None;
    }
    let folder = tempfile::tempdir().unwrap();
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/files/stated_rates.py");
    let status = Command::new(python).arg(script).arg(folder.path()).status().unwrap();
    assert!(status.success());
    Some(folder)
}

#[track_caller]
fn assert_axis(what: &str, found: &MeasuredData, quantity: AxisQuantity, step: f64) {
    let names: Vec<&str> = found.records.iter().map(|r| r.name.as_str()).collect();
    let [record] = &found.records[..] else { panic!("{what}: {names:?}") };
    assert_eq!((record.name.as_str(), record.axis.quantity), ("acc", quantity), "{what}");
    let Points::Uniform { start, step: stated } = record.axis.points else {
        panic!("{what}: {:?}", record.axis)
    };
    // 1/0.005 and 0.2 * 1000 round once.
    assert!(start == 0.0 && (stated / step - 1.0).abs() < 1e-15, "{what}: {start} {stated}");
    let Values::Real(values) = &record.values else { panic!("{what} is complex") };
    assert_eq!(values.len(), 100, "{what}");
    let expected = |k: usize| (1e6 * (0.31 * k as f64).sin()).round() / 1e6;
    assert!(values.iter().enumerate().all(|(k, v)| (v - expected(k)).abs() < 1e-9), "{what}");
    assert!(found.left_out.is_empty(), "{what}: {:?}", found.left_out);
}

#[test]
fn names_of_rates_and_axes_in_every_format() {
    let Some(folder) = written() else { return };
    for ending in ENDINGS {
        let file = |stem: &str| {
            (format!("{stem}{ending}"), read(&folder.path().join(format!("{stem}{ending}"))).unwrap())
        };
        let rates =
            ["one_sr_True", "one_fs_True", "one_Fs_False", "one_SampleFrequency_False", "one_dt_True"];
        let times = ["time_t", "time_X_Value"];
        let texts = ["text_0", "text_1", "text_2", "text_3", "text_4", "text_step"];
        for stem in rates.into_iter().chain(times).chain(texts) {
            let (what, found) = file(stem);
            assert_axis(&what, &found, AxisQuantity::Time, 0.005);
        }
        for stem in ["frequency_freq", "frequency_Freq_domain", "frequency_f"] {
            let (what, found) = file(stem);
            assert_axis(&what, &found, AxisQuantity::Frequency, 0.5);
        }
        let (what, found) = file("count");
        assert_axis(&what, &found, AxisQuantity::Time, 0.005);
        assert!(found.notes.iter().any(|note| note.contains("states 90")), "{what}: {:?}", found.notes);
        // A text that is no rate is named, and the rate is missing.
        let (what, found) = file("no_rate");
        assert_eq!(found.records[0].axis.points, Points::Unknown, "{what}");
        assert!(found.left_out.iter().any(|text| text.contains("fast")), "{what}: {:?}", found.left_out);
    }
}

/// Two rates are an error that names both; a rate that is given settles it, with a note that names both.
#[test]
fn two_rates_are_refused_or_settled() {
    let Some(folder) = written() else { return };
    for ending in ENDINGS {
        for (stem, numbers) in [("two", ["200", "0.004"]), ("two_times", ["250 Hz", "200 Hz"])] {
            let path = folder.path().join(format!("{stem}{ending}"));
            let error = read(&path).unwrap_err().to_string();
            let names_both = |text: &str| numbers.iter().all(|number| text.contains(number));
            assert!(error.contains("two sampling rates") && names_both(&error), "{stem}{ending}: {error}");
            let found = read_at_rate(&path, &Limits::default(), Some(250.0)).unwrap();
            assert_axis(&format!("{stem}{ending}"), &found, AxisQuantity::Time, 0.004);
            let [note] = &found.notes[..] else { panic!("{stem}{ending}: {:?}", found.notes) };
            assert!(names_both(note) && note.ends_with("250 Hz is used, as given"), "{note}");
        }
        // One rate is not changed by a given one.
        let path = folder.path().join(format!("one_fs_True{ending}"));
        let found = read_at_rate(&path, &Limits::default(), Some(250.0)).unwrap();
        assert_axis(ending, &found, AxisQuantity::Time, 0.005);
    }
}

#[test]
fn attributes_of_other_types_are_named() {
    let Some(folder) = written() else { return };
    let found = read(&folder.path().join("attributes.h5")).unwrap();
    assert_eq!(found.records[0].axis.points, Points::Uniform { start: 0.0, step: 0.005 });
    let named =
        |name: &str| found.left_out.iter().any(|text| text.starts_with(name) && text.contains("attribute"));
    assert!(named("acc.colour"), "{:?}", found.left_out);
    assert!(named("acc.calibrated"), "{:?}", found.left_out);
}
