//! Results files of rotordyn that were changed.

use crate::{refused, run};
use hdf5::types::VarLenUnicode;
use hdf5::{File, Group, H5Type, Location};
use std::path::PathBuf;
use tempfile::TempDir;

#[derive(Clone, Copy, H5Type)]
#[repr(C)]
struct Pair {
    r: f64,
    i: f64,
}

fn text(text: &str) -> VarLenUnicode {
    text.parse().unwrap()
}

fn set_text(object: &Location, name: &str, value: &str) {
    object.new_attr::<VarLenUnicode>().create(name).unwrap().write_scalar(&text(value)).unwrap();
}

fn numbers(group: &Group, name: &str, values: &[f64]) {
    group.new_dataset_builder().with_data(values).create(name).unwrap();
}

fn texts(group: &Group, name: &str, values: &[&str]) {
    let values: Vec<VarLenUnicode> = values.iter().map(|value| text(value)).collect();
    group.new_dataset_builder().with_data(&values).create(name).unwrap();
}

/// A results file with what `add` adds to it.
fn results_with(add: impl FnOnce(&File)) -> (TempDir, PathBuf) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("results.h5");
    let file = File::create(&path).unwrap();
    let meta = file.create_group("meta").unwrap();
    for (name, value) in
        [("program", "rotordyn"), ("title", "t"), ("model", ""), ("variant", ""), ("settings", "")]
    {
        set_text(&meta, name, value);
    }
    add(&file);
    drop(meta);
    file.close().unwrap();
    (folder, path)
}

/// FRFs of two responses to one excitation at ten frequencies, of these numbers of values, units and dimensions.
fn frfs(shape: &'static [usize], units: &'static [&'static str]) -> (TempDir, PathBuf) {
    results_with(|file| {
        let frf = file.create_group("frf").unwrap();
        texts(&frf, "responses", &["a", "b"]);
        texts(&frf, "excitations", &["e"]);
        texts(&frf, "units", units);
        numbers(&frf, "frequency", &[1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0, 10.0]);
        let data = frf.new_dataset::<Pair>().shape(shape).create("response").unwrap();
        data.write_raw(&vec![Pair { r: 1.0, i: 0.0 }; shape.iter().product()]).unwrap();
    })
}

#[test]
fn frf_sets_with_a_short_axis() {
    let units = &["m/N", "m/N"];
    for (shape, units) in [
        (&[2, 1, 9][..], &units[..]),
        (&[1, 1, 10], units),
        (&[20], units),
        (&[2, 1, 10], &units[..1]),
        (&[0, 1, 10], units),
    ] {
        let (_folder, path) = frfs(shape, units);
        refused(
            &path,
            &["/frf/response of shape", "do not belong to 2 responses, 1 excitations and 10 frequencies"],
        );
        let seen = run(&["identify", path.to_str().unwrap()]);
        assert_eq!(seen.code, Some(2), "{}", seen.reported);
        crate::is_cheap(&seen);
    }
}

/// A run of 1000 samples, whose parts can be changed.
struct Run {
    rate: f64,
    channel: usize,
    state: &'static str,
}

fn run_file(run: Run) -> (TempDir, PathBuf) {
    results_with(|file| {
        let time = file.create_group("time").unwrap();
        for name in ["t", "theta", "speed"] {
            numbers(&time, name, &(0..1000).map(f64::from).collect::<Vec<_>>());
        }
        let t = time.dataset("t").unwrap();
        t.new_attr::<f64>().create("fs").unwrap().write_scalar(&run.rate).unwrap();
        t.new_attr::<f64>().create("t0").unwrap().write_scalar(&0.0).unwrap();
        set_text(&time, "run_state", run.state);
        let channels = file.create_group("channels").unwrap();
        numbers(&channels, "a", &(0..run.channel).map(|k| (k as f64).sin()).collect::<Vec<_>>());
        let a = channels.dataset("a").unwrap();
        for (name, value) in
            [("unit", "m/s2"), ("quantity", "acceleration"), ("station", "B"), ("direction", "y")]
        {
            set_text(&a, name, value);
        }
    })
}

#[test]
fn runs_whose_parts_do_not_belong_together() {
    let sound = || Run { rate: 100.0, channel: 1000, state: "complete" };
    let (_folder, path) = run_file(sound());
    let seen = run(&["signal", path.to_str().unwrap()]);
    assert_eq!(seen.code, Some(0), "{}", seen.reported);
    for rate in [f64::NAN, 0.0, -5.0, f64::INFINITY] {
        let (_folder, path) = run_file(Run { rate, ..sound() });
        refused(&path, &["a sampling rate of"]);
    }
    let (_folder, path) = run_file(Run { channel: 600, ..sound() });
    refused(&path, &["the channels of the run have different lengths"]);
    // A run that was killed between two channels is read up to there.
    let (_folder, path) = run_file(Run { channel: 600, state: "running", ..sound() });
    let seen = run(&["signal", path.to_str().unwrap()]);
    assert_eq!(seen.code, Some(0), "{}", seen.reported);
}

#[test]
fn commands_on_a_results_file_that_is_none() {
    let (_folder, path) = results_with(|file| drop(file.create_group("time/t").unwrap()));
    for command in ["spectrogram", "orders"] {
        let seen = crate::run(&[command, path.to_str().unwrap()]);
        assert_eq!(seen.code, Some(2), "{command}: {}", seen.reported);
        crate::is_cheap(&seen);
    }
}

#[test]
fn mode_shapes_of_another_number_of_modes() {
    let (_folder, path) = results_with(|file| {
        let modes = file.create_group("modes").unwrap();
        numbers(&modes, "rpm", &[0.0, 100.0]);
        let pairs = |shape: &[usize]| vec![Pair { r: -1.0, i: 100.0 }; shape.iter().product()];
        for (name, shape) in [("eigenvalue", &[2, 3][..]), ("shapes", &[2, 2, 4, 6])] {
            let data = modes.new_dataset::<Pair>().shape(shape).create(name).unwrap();
            data.write_raw(&pairs(shape)).unwrap();
        }
    });
    let model = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("models/jeffcott.toml");
    let seen = run(&["validate", model.to_str().unwrap(), "--measured", path.to_str().unwrap()]);
    assert_eq!(seen.code, Some(2), "{}", seen.reported);
    assert!(
        seen.reported.contains("does not belong to /modes/eigenvalue of shape [2, 3]"),
        "{}",
        seen.reported
    );
}
