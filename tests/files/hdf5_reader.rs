//! Files read in a process of their own are those read in this one, value by value.

use nalgebra::Complex;
use rotordyn::error::Error;
use rotordyn::io::budget::Limits;
use rotordyn::io::hdf5::{self, Attribute, Channel, LinkTarget, ObjectKind, RunFormat, Store};

use crate::hdf5_stream;

fn limits(memory: Option<u64>) -> Limits {
    Limits { memory, hdf5_program: Some(env!("CARGO_BIN_EXE_rotordyn").into()) }
}

/// A file with every kind of object that we write.
fn example() -> (tempfile::TempDir, std::path::PathBuf) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.h5");
    let store = Store::create(&path).unwrap();
    let values: Vec<f64> =
        (0..20_000).map(|k| f64::from_bits((k as u64).wrapping_mul(0x9e37_79b9_7f4a_7c15))).collect();
    store.write("/g/values", &[100, 200], &values, &[("unit", "m".into()), ("x", 2.5.into())]).unwrap();
    let complex: Vec<_> = values[..600].chunks(2).map(|v| Complex::new(v[0], v[1])).collect();
    store.write_complex("/g/complex", &[300], &complex, &[("list", (&[1.0, 2.0][..]).into())]).unwrap();
    let texts: Vec<String> = (0..200).map(|k| format!("text {k} ²")).collect();
    store.write_texts("/g/texts", &texts, &[("names", vec!["a".to_string(), "".into()].into())]).unwrap();
    store.write_text_array("/g/grid", &[2, 2], &["a", "b", "c", "d"], &[("k", 3_i64.into())]).unwrap();
    store.create_group("/empty").unwrap();
    let channel = |name: &str| Channel {
        name: name.into(),
        unit: "m/s2".into(),
        quantity: "acceleration".into(),
        station: "B".into(),
        direction: "y".into(),
    };
    let channels = [channel("c"), channel("a")];
    let format = RunFormat { channels: &channels, sample_rate: 100.0, start: 0.5 };
    let recorded = folder.path().join("run.h5");
    let mut stream = hdf5_stream::begin(&recorded, "/run", &format, 6000);
    (0..5000).for_each(|k| stream.push(f64::from(k), 0.1, 0.2, &[f64::from(k), -f64::from(k)]).unwrap());
    hdf5_stream::end(stream, &recorded, "/run", "complete", &store);
    (folder, path)
}

fn bits(values: &[f64]) -> Vec<u64> {
    values.iter().map(|v| v.to_bits()).collect()
}

#[test]
fn a_process_of_its_own_reads_the_same() {
    let (_folder, path) = example();
    let here = hdf5::open_reader(&path, &Limits::default()).unwrap();
    let there = hdf5::open_reader(&path, &limits(None)).unwrap();
    let both = [&here, &there];
    assert_eq!(here.memory(), there.memory());
    for group in ["/", "/g", "/empty", "/run/channels"] {
        let [a, b] = both.map(|file| (file.links(group).unwrap(), file.members(group).unwrap()));
        assert_eq!(a, b);
        let names: Vec<&str> = a.0.links.iter().map(|link| link.name.as_str()).collect();
        assert_eq!(names, a.1);
    }
    let kinds: Vec<LinkTarget> =
        here.links("/g").unwrap().links.into_iter().map(|link| link.target).collect();
    let set = LinkTarget::DataSet;
    assert_eq!(
        kinds,
        [
            set(ObjectKind::Complex(vec![300])),
            set(ObjectKind::Text(vec![2, 2])),
            set(ObjectKind::Text(vec![200])),
            set(ObjectKind::Real(vec![100, 200]))
        ]
    );
    let [a, b] = both.map(|file| file.read("/g/values").unwrap());
    assert_eq!((a.shape, bits(&a.data)), (b.shape, bits(&b.data)));
    let [a, b] = both.map(|file| file.read_complex("/g/complex").unwrap());
    let flat = |z: &[Complex<f64>]| bits(&z.iter().flat_map(|z| [z.re, z.im]).collect::<Vec<_>>());
    assert_eq!((a.shape, flat(&a.data)), (b.shape, flat(&b.data)));
    for name in ["/g/texts", "/g/grid"] {
        let [a, b] = both.map(|file| file.read_texts(name).unwrap());
        assert_eq!(a, b);
    }
    assert_eq!(there.read_texts("/g/texts").unwrap()[199], "text 199 ²");
    for object in ["/g/values", "/g/complex", "/g/texts", "/g/grid", "/empty", "/run/time"] {
        let [a, b] = both.map(|file| file.attributes(object).unwrap());
        assert_eq!(a, b);
        for (name, value) in a {
            assert_eq!(there.attribute(object, &name).unwrap(), Some(value));
        }
    }
    assert_eq!(there.attribute("/g/grid", "k").unwrap(), Some(Attribute::Integer(3)));
    assert_eq!(there.attribute("/g/grid", "none").unwrap(), None);
    let [a, b] = both.map(|file| file.read_range("/run/channels/a", 4090..4100).unwrap());
    assert_eq!(a, b);
    assert_eq!(a[0], -4090.0);
    assert!(there.read_range("/run/channels/a", 4990..5001).is_err());
    let [a, b] = both.map(|file| hdf5::read_recording(&**file, "/run").unwrap());
    assert_eq!(a, b);
    // An answer that is no does not end the process.
    for file in both {
        assert!(!file.contains("/g/nothing").unwrap() && file.contains("/g/values").unwrap());
        assert!(file.read("/g/nothing").is_err() && file.read("/g/texts").is_err());
        assert!(file.members("/g/values").is_err());
        assert_eq!(file.read_texts("/g/grid").unwrap().len(), 4);
    }
}

#[test]
fn a_stated_limit_holds_in_both() {
    let (_folder, path) = example();
    let small = Limits { memory: Some(100_000), hdf5_program: None };
    for limits in [small, limits(Some(100_000))] {
        let file = hdf5::open_reader(&path, &limits).unwrap();
        let error = file.read("/g/values").unwrap_err();
        assert!(matches!(error, Error::Content { .. }), "{error}");
        let text = error.to_string();
        assert!(text.contains("/g/values would need 160 kB, more than the 100 kB allowed"), "{text}");
        assert!(text.contains("--read-limit 200kB"), "{text}");
        assert_eq!(file.read_complex("/g/complex").unwrap().data.len(), 300);
    }
}

#[test]
fn a_program_that_cannot_be_started_or_is_another_is_an_error() {
    let (folder, path) = example();
    let with = |program: &str| Limits { memory: None, hdf5_program: Some(program.into()) };
    let missing = hdf5::open_reader(&path, &with("/nowhere/rotordyn")).unwrap_err();
    assert!(matches!(missing, Error::Environment { .. }), "{missing}");
    let other = hdf5::open_reader(&path, &with("/bin/true")).unwrap_err();
    assert!(matches!(other, Error::Content { .. }), "{other}");
    let no_file = hdf5::open_reader(folder.path().join("none.h5"), &limits(None)).unwrap_err();
    assert!(matches!(no_file, Error::Environment { .. }), "{no_file}");
}
