//! HDF5 files read by h5py, with the types that a Python user expects.

use nalgebra::Complex;
use rotordyn::io::hdf5::{Channel, RunFormat, Store};
use std::path::Path;
use std::process::Command;

use crate::hdf5_stream::{begin, end};

/// One object of every kind; `read_results.py` expects these values.
pub fn write_example(path: &Path) {
    let store = Store::create(path).unwrap();
    store.set_attribute("/meta", "program", "rotordyn").unwrap();
    store.set_attribute("/meta", "seed", 42_i64).unwrap();
    store.set_attribute("/meta", "gravity", &[0.0, -9.80665, 0.0][..]).unwrap();
    store.set_attribute("/meta", "stations", vec!["disc".to_string(), "Lager µ".into()]).unwrap();
    let modes: Vec<_> = (0..6).map(|k| Complex::new(k as f64, -0.5 * k as f64)).collect();
    store.write_complex("/modes/shapes", &[2, 3], &modes, &[("unit", "m".into())]).unwrap();
    store.write_texts("/modes/label", &["bending 1 ↺", "torsion 1"], &[]).unwrap();
    let frequency: Vec<f64> = (0..64).map(|k| 2.5 * k as f64).collect();
    let rpm: Vec<f64> = (0..40).map(|k| 30.0 * k as f64).collect();
    let level: Vec<f64> = (0..64 * 40).map(f64::from).collect();
    store.write("/spectra/frequency", &[64], &frequency, &[("unit", "Hz".into())]).unwrap();
    store.write("/spectra/rpm", &[40], &rpm, &[("unit", "rpm".into())]).unwrap();
    for name in ["/spectra/B_x", "/spectra/B_y"] {
        store.write(name, &[40, 64], &level, &[("unit", "dB re 1 m/s2".into())]).unwrap();
        store.attach_scale(name, 0, "/spectra/rpm", "rpm").unwrap();
        store.attach_scale(name, 1, "/spectra/frequency", "frequency").unwrap();
    }
    let channel = Channel {
        name: "B ay".into(),
        unit: "m/s2".into(),
        quantity: "acceleration".into(),
        station: "B".into(),
        direction: "y".into(),
    };
    let running = path.with_extension("running");
    let format = RunFormat { channels: &[channel], sample_rate: 1000.0, start: 0.25 };
    let mut stream = begin(&running, "", &format, 5000);
    for k in 0..5000 {
        let t = 0.25 + k as f64 / 1000.0;
        stream.push(t, 2.0 * t, 2.0, &[k as f64]).unwrap();
    }
    end(stream, &running, "", "complete", &store);
}

/// Whether this Python has h5py; if not, the test is skipped, or fails with `CI` set.
pub fn has_h5py(python: &str) -> bool {
    has_modules(python, "h5py, numpy")
}

/// Whether this Python has modules, as [`has_h5py`].
pub fn has_modules(python: &str, modules: &str) -> bool {
    let import = Command::new(python).args(["-c", &format!("import {modules}")]).output();
    if import.is_ok_and(|output| output.status.success()) {
        return true;
    }
    let message = format!("{python} with {modules} not found");
    let must_run = std::env::var_os("CI").is_some() && std::env::var_os("ROTORDYN_ALLOW_SKIP").is_none();
    assert!(!must_run, "{message}; set ROTORDYN_ALLOW_SKIP to skip the test");
    eprintln!("SKIPPED: {message}");
    false
}

#[test]
fn h5py_reads_everything() {
    let python = std::env::var("ROTORDYN_PYTHON").unwrap_or_else(|_| "python3".into());
    if !has_h5py(&python) {
        return;
    }
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("results.h5");
    write_example(&path);
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/files/read_results.py");
    let output = Command::new(&python).arg(script).arg(&path).output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
}
