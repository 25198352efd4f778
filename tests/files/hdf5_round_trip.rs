//! Round trips of data sets and attributes through an HDF5 store.

use nalgebra::Complex;
use rotordyn::error::Error;
use rotordyn::io::hdf5::{Attribute, Store};

#[test]
fn data_sets_and_attributes_round_trip() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("new folder/results.h5");
    let store = Store::create(&path).unwrap();
    let numbers = [0.1, -0.0, f64::MIN_POSITIVE, 1e300, f64::INFINITY, 1.0 / 3.0];
    store.write("/modes/omega", &[2, 3], &numbers, &[("unit", "rad/s".into())]).unwrap();
    let big: Vec<f64> = (0..3 * 50_000).map(|k| (k as f64 * 0.37).sin()).collect();
    store.write("/spectra/big", &[3, 50_000], &big, &[]).unwrap();
    let shapes = [Complex::new(1.0, -2.0), Complex::new(f64::EPSILON, 0.0)];
    store.write_complex("/modes/shapes", &[1, 2], &shapes, &[]).unwrap();
    let labels = ["1. Biegung vorwärts, 31,5 Hz", "torsion", ""];
    store.write_texts("/modes/label", &labels, &[]).unwrap();
    store.write("/empty", &[0, 4], &[], &[]).unwrap();
    let attributes: [(&str, Attribute); 5] = [
        ("program", "rotordyn".into()),
        ("seed", Attribute::Integer(-7)),
        ("speed", 125.66.into()),
        ("axis", (&[0.0, 0.0, 1.0][..]).into()),
        ("units", vec!["µm".to_string(), "N".into()].into()),
    ];
    for (name, value) in &attributes {
        store.set_attribute("/meta", name, value.clone()).unwrap();
    }
    let model = "[shaft]\n# Ω = 1200 rpm\n".repeat(10_000);
    store.set_attribute("/meta", "model", model.as_str()).unwrap();
    drop(store);

    let store = Store::open(&path).unwrap();
    let omega = store.read("/modes/omega").unwrap();
    assert_eq!(omega.shape, [2, 3]);
    assert_eq!(omega.data.map_bits(), numbers.to_vec().map_bits());
    let read = store.read("/spectra/big").unwrap();
    assert_eq!((read.shape, read.data), (vec![3, 50_000], big));
    assert_eq!(store.read_complex("/modes/shapes").unwrap().data, shapes);
    assert_eq!(store.read_texts("/modes/label").unwrap(), labels);
    assert_eq!(store.read("/empty").unwrap().shape, [0, 4]);
    assert_eq!(store.attribute("/modes/omega", "unit").unwrap(), Some("rad/s".into()));
    assert_eq!(store.attribute("/modes/omega", "quantity").unwrap(), None);
    for (name, value) in attributes {
        assert_eq!(store.attribute("/meta", name).unwrap(), Some(value));
    }
    assert_eq!(store.attribute("/meta", "model").unwrap(), Some(model.into()));
    assert_eq!(store.members("/modes").unwrap(), ["label", "omega", "shapes"]);
}

#[test]
fn studies_are_appended_and_replaced_in_one_file() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("results.h5");
    Store::append(&path).unwrap().write("/modes/omega", &[1], &[1.0], &[]).unwrap();
    let store = Store::append(&path).unwrap();
    store.write("/frf/f", &[2], &[1.0, 2.0], &[]).unwrap();
    assert!(store.write("/modes/omega", &[1], &[2.0], &[]).is_err());
    assert!(store.contains("/modes/omega") && !store.contains("/orders/x"));
    store.remove("/modes").unwrap();
    store.remove("/modes").unwrap();
    store.write("/modes/omega", &[1], &[2.0], &[]).unwrap();
    store.set_attribute("/modes", "speed", 1.0).unwrap();
    store.set_attribute("/modes", "speed", 2.0).unwrap();
    drop(store);

    let store = Store::open(&path).unwrap();
    assert_eq!(store.read("/modes/omega").unwrap().data, [2.0]);
    assert_eq!(store.read("/frf/f").unwrap().data, [1.0, 2.0]);
    assert_eq!(store.attribute("/modes", "speed").unwrap(), Some(2.0.into()));
}

#[test]
fn errors_state_operation_file_and_object() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("results.h5");
    let store = Store::create(&path).unwrap();
    store.write("/f", &[3], &[1.0, 2.0, 3.0], &[]).unwrap();
    store.write("/level", &[2, 2], &[0.0; 4], &[]).unwrap();
    let failures = [
        (Store::open(folder.path().join("none.h5")).map(drop), "open", "none.h5"),
        (store.write("/x", &[2, 2], &[1.0], &[]), "write", "/x: the shape [2, 2] does not fit 1 values"),
        (store.read("/missing").map(drop), "read", "/missing"),
        (
            store.attach_scale("/level", 1, "/f", "frequency"),
            "write",
            "/f of shape [3] does not fit dimension 1",
        ),
        (
            store.attach_scale("/level", 2, "/f", "frequency"),
            "write",
            "/f of shape [3] does not fit dimension 2",
        ),
        (store.set_attribute("/meta", "model", "a\0b"), "write", "/meta"),
    ];
    for (result, operation, detail) in failures {
        let error = result.unwrap_err();
        assert!(matches!(error, Error::Environment { .. }));
        let message = error.to_string();
        assert!(message.starts_with(operation) && message.contains(detail), "{message}");
    }
    std::fs::write(folder.path().join("garbage.h5"), b"no file of HDF5").unwrap();
    assert!(Store::append(folder.path().join("garbage.h5")).is_err());
}

#[test]
fn repeated_writing_gives_identical_bytes() {
    let folder = tempfile::tempdir().unwrap();
    let paths = ["a.h5", "b.h5"].map(|name| folder.path().join(name));
    for path in &paths {
        crate::hdf5_h5py::write_example(path);
        // HDF5 object times have a resolution of one second: the pause makes any stored time differ.
        std::thread::sleep(std::time::Duration::from_millis(1100));
    }
    let [a, b] = paths.map(|path| std::fs::read(path).unwrap());
    assert!(a == b, "the files differ, first at {:?}", a.iter().zip(&b).position(|(a, b)| a != b));
    let mut names: Vec<_> =
        std::fs::read_dir(folder.path()).unwrap().map(|entry| entry.unwrap().file_name()).collect();
    names.sort();
    // With the runs from which they were copied; no temporary file remains.
    assert_eq!(names, ["a.h5", "a.running", "b.h5", "b.running"]);
}

trait MapBits {
    fn map_bits(self) -> Vec<u64>;
}

impl MapBits for Vec<f64> {
    fn map_bits(self) -> Vec<u64> {
        self.into_iter().map(f64::to_bits).collect()
    }
}
