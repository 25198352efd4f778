//! results.h5 of the rig: compared with the JSON results in h5py, read back, written again.

use std::path::Path;
use std::process::Command;

use rotordyn::io::budget::Limits;
use rotordyn::io::hdf5::{Attribute, RunFormat, Store};
use rotordyn::io::json::to_json;
use rotordyn::io::results_file::{
    Meta, SCHEMA, channels_of, read_history, remove_run, schema, write_meta, write_study,
};

use crate::hdf5_stream::{begin, end};
use crate::rig_results::RIG;

/// Streams the run and writes every study, as the program does.
fn write_all(path: &Path) {
    let (machine, results) = &*RIG;
    let store = Store::append(path).unwrap();
    let settings = ["speed.ramp = 0.9 s".to_string()];
    let meta = Meta { model: "[model]", title: &machine.model.title, variant: "", settings: &settings };
    write_meta(&store, &meta).unwrap();
    remove_run(&store).unwrap();
    let history = &results.run_up.as_ref().unwrap().history;
    let (running, channels) = (path.with_extension("running"), channels_of(history));
    let format = RunFormat { channels: &channels, sample_rate: history.sample_rate, start: 0.0 };
    let mut stream = begin(&running, "", &format, history.time.len());
    for k in 0..history.time.len() {
        let row: Vec<f64> = history.channels.iter().map(|c| c.values.at(k).unwrap().unwrap()).collect();
        let at = [&history.time, &history.angle, &history.speed].map(|of| of.at(k).unwrap().unwrap());
        stream.push(at[0], at[1], at[2], &row).unwrap();
    }
    end(stream, &running, "", "complete", &store);
    write_study(&store, results, machine).unwrap();
}

#[test]
fn h5py_results_equal_json_results() {
    let python = std::env::var("ROTORDYN_PYTHON").unwrap_or_else(|_| "python3".into());
    if !crate::hdf5_h5py::has_h5py(&python) {
        return;
    }
    let folder = tempfile::tempdir().unwrap();
    let (file, json) = (folder.path().join("results.h5"), folder.path().join("results.json"));
    write_all(&file);
    let (machine, results) = &*RIG;
    std::fs::write(&json, to_json(results, machine).to_string()).unwrap();
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/files/read_study.py");
    let output = Command::new(&python).arg(script).arg(&file).arg(&json).output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
}

#[test]
fn stored_run_round_trip_and_study_replacement() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("results.h5");
    let (machine, results) = &*RIG;
    write_all(&path);
    // Again, as a second call of the program on the same folder.
    write_all(&path);
    let history = &results.run_up.as_ref().unwrap().history;
    assert_eq!(&read_history(&path, &Limits::default()).unwrap(), history);
    let groups = Store::open(&path).unwrap().members("/").unwrap();
    let expected = [
        "bearings",
        "campbell",
        "channels",
        "critical_speeds",
        "equilibrium",
        "frf",
        "labels",
        "meta",
        "modes",
        "run_up",
        "spectra",
        "time",
        "unbalance",
        "warnings",
    ];
    assert_eq!(groups, expected);
    assert_eq!(schema(&Store::open(&path).unwrap()).unwrap(), SCHEMA);

    // Writing one study replaces it and leaves the others.
    let mut fewer = results.clone();
    fewer.modal.truncate(1);
    (fewer.campbell, fewer.frf, fewer.run_up) = (None, None, None);
    let store = Store::append(&path).unwrap();
    write_study(&store, &fewer, machine).unwrap();
    assert_eq!(store.read("/modes/omega").unwrap().shape[0], 1);
    assert!(store.contains("/campbell/frequency") && store.contains("/frf/response"));
    assert_eq!(store.attribute("/run_up", "end").unwrap(), Some(Attribute::from("complete")));
}

#[test]
fn file_without_run_error_message() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("results.h5");
    let store = Store::create(&path).unwrap();
    assert_eq!(schema(&store).unwrap(), 1, "files without the attribute");
    drop(store);
    let message = read_history(&path, &Limits::default()).unwrap_err().to_string();
    assert!(message.contains("results.h5") && message.contains("/time/t"), "{message}");
}
