//! Units of axes and sampling rates.

use std::f64::consts::TAU;

use crate::{rate, read, vibration};
use rotordyn_io::hdf5::{Attribute, Store};
use rotordyn_io::mat;
use rotordyn_io::measured::{self, arrays::Array};
use rotordyn_signal::Complex;
use rotordyn_signal::record::{Axis, AxisQuantity, Kind, MeasuredData, Record, Values};

const COUNT: usize = 300;

fn vibrations() -> Vec<f64> {
    (0..COUNT).map(vibration).collect()
}

/// 5 Hz to 154.5 Hz.
fn frequencies(factor: f64) -> Vec<f64> {
    (0..COUNT).map(|k| (5.0 + 0.5 * k as f64) * factor).collect()
}

fn frf() -> Vec<Complex<f64>> {
    (0..COUNT).map(|k| Complex::new(vibration(k), 0.5)).collect()
}

const FREQUENCY_UNITS: [(&str, f64); 8] = [
    ("Hz", 1.0),
    ("kHz", 1e-3),
    ("MHz", 1e-6),
    ("rad/s", TAU),
    ("rpm", 60.0),
    ("cpm", 60.0),
    ("1/min", 60.0),
    ("1/s", 1.0),
];
const TIME_UNITS: [(&str, f64); 6] =
    [("s", 1.0), ("ms", 1e3), ("us", 1e6), ("µs", 1e6), ("min", 1.0 / 60.0), ("h", 1.0 / 3600.0)];

fn check_frequencies(found: &MeasuredData, what: &str) {
    let record = found.records.iter().find(|r| r.kind == Kind::Frf).unwrap_or_else(|| panic!("{what}"));
    let points = record.axis.points(COUNT).unwrap();
    for (k, expected) in frequencies(1.0).into_iter().enumerate() {
        assert!((points[k] / expected - 1.0).abs() < 1e-6, "{what}: {} for {expected}", points[k]);
    }
    assert_eq!(record.axis.quantity, AxisQuantity::Frequency, "{what}");
}

/// A data set with its axis, whose unit is an attribute.
fn read_hdf5(axis: (&str, &[f64]), unit: (&str, &str), complex: bool) -> Result<MeasuredData, String> {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.h5");
    let store = Store::replace(&path).unwrap();
    store
        .write(&format!("/{}", axis.0), &[axis.1.len()], axis.1, &[(unit.0, Attribute::from(unit.1))])
        .unwrap();
    match complex {
        true => store.write_complex("/H", &[COUNT], &frf(), &[]).unwrap(),
        false => store.write("/acc", &[COUNT], &vibrations(), &[]).unwrap(),
    }
    store.commit().unwrap();
    measured::read(&path).map_err(|error| error.to_string())
}

#[test]
fn attributes_of_axes_in_hdf5() {
    for (unit, factor) in FREQUENCY_UNITS {
        for name in ["unit", "units", "Unit"] {
            let found = read_hdf5(("frequency", &frequencies(factor)), (name, unit), true).unwrap();
            check_frequencies(&found, unit);
            assert!(found.left_out.is_empty(), "{:?}", found.left_out);
        }
    }
    for (unit, factor) in TIME_UNITS {
        let times: Vec<f64> = (0..COUNT).map(|k| k as f64 / 5120.0 * factor).collect();
        let found = read_hdf5(("time", &times), ("units", unit), false).unwrap();
        assert!((rate(&found, "acc") / 5120.0 - 1.0).abs() < 1e-9, "{unit}");
        assert!(found.left_out.is_empty(), "{:?}", found.left_out);
    }
    for (axis, unit) in [("frequency", "furlong"), ("time", "kX"), ("time", "Hz"), ("frequency", "ms")] {
        let error = read_hdf5((axis, &frequencies(1.0)), ("unit", unit), axis == "frequency").unwrap_err();
        assert!(error.contains(&format!("the unit `{unit}` of `{axis}`")), "{error}");
    }
    // `f` in N is a force, which may increase.
    let found = read_hdf5(("f", &frequencies(1.0)), ("unit", "N"), false).unwrap();
    assert_eq!(found.record("f").unwrap().unit, "N");
    // No unit at all.
    check_frequencies(&read_hdf5(("frequency", &frequencies(1.0)), ("unit", ""), true).unwrap(), "none");
}

fn read_mat(arrays: &[Array], given: Option<f64>) -> Result<MeasuredData, String> {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.mat");
    mat::write(&path, arrays).unwrap();
    read("a.mat", &std::fs::read(&path).unwrap(), given)
}

#[test]
fn units_of_rates_in_arrays() {
    let acc = Array::real("acc", vibrations());
    for (unit, value) in
        [("kHz", 5.12), ("Hz", 5120.0), ("kS/s", 5.12), ("MHz", 0.00512), ("samples/s", 5120.0)]
    {
        for name in ["fs_unit", "fs_units"] {
            let arrays = [acc.clone(), Array::scalar("fs", value), Array::text(name, unit)];
            let found = read_mat(&arrays, None).unwrap();
            assert!((rate(&found, "acc") / 5120.0 - 1.0).abs() < 1e-12, "{unit}");
        }
        let arrays = [acc.clone(), Array::text("fs", &format!("{value} {unit}"))];
        assert!((rate(&read_mat(&arrays, None).unwrap(), "acc") / 5120.0 - 1.0).abs() < 1e-12, "{unit}");
    }
    let arrays = [acc, Array::scalar("fs", 5.12), Array::text("fs_unit", "kX/s")];
    let error = read_mat(&arrays, None).unwrap_err();
    assert!(error.contains("`kX/s` of `fs`") && error.contains("--rate"), "{error}");
    assert!(read_mat(&arrays, Some(5120.0)).is_ok());
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.h5");
    let store = Store::replace(&path).unwrap();
    let attributes =
        [("sampling_rate", Attribute::Number(5.12)), ("sampling_rate_unit", Attribute::from("kHz"))];
    store.write("/acc", &[COUNT], &vibrations(), &attributes).unwrap();
    store.commit().unwrap();
    let found = measured::read(&path).unwrap();
    assert!((rate(&found, "acc") / 5120.0 - 1.0).abs() < 1e-12);
    assert!(found.left_out.is_empty(), "{:?}", found.left_out);
}

#[test]
fn units_of_frequencies_beside_arrays() {
    let axis = Array::real("freq", frequencies(TAU));
    let data = rotordyn_io::measured::arrays::Data::Complex(frf());
    let arrays =
        [axis, Array::text("freq_unit", "rad/s"), Array { name: "H".into(), shape: vec![COUNT], data }];
    check_frequencies(&read_mat(&arrays, None).unwrap(), "freq_unit");
}

#[test]
fn units_of_frequencies_in_tables() {
    for (unit, factor) in FREQUENCY_UNITS {
        for head in [format!("Frequency [{unit}]"), format!("frequency ({unit})")] {
            let axis = frequencies(factor);
            let line = |k: usize| format!("{:.9e},{:.6},0.5\n", axis[k], vibration(k));
            let text = format!("{head},H_re,H_im\n{}", (0..COUNT).map(line).collect::<String>());
            check_frequencies(&read("t.csv", text.as_bytes(), None).unwrap(), &head);
        }
    }
    let line = |k: usize| format!("{},{:.6},0.5\n", k + 5, vibration(k));
    let text = format!("Frequency [kX],H_re,H_im\n{}", (0..COUNT).map(line).collect::<String>());
    let error = read("t.csv", text.as_bytes(), None).unwrap_err();
    assert!(error.contains("the unit `kX` of `Frequency`"), "{error}");
}

#[test]
fn units_of_rates_in_lines_of_tables() {
    let table = |head: &str, given| {
        let numbers: String = (0..COUNT).map(|k| format!("{:.6}\n", vibration(k))).collect();
        read("t.csv", format!("{head}\nx\n{numbers}").as_bytes(), given)
    };
    for head in [
        "Sampling rate [kS/s]: 5.12",
        "Sample rate: 5.12 kS/s",
        "Sample rate: 5.12 kSa/s",
        "Sample rate: 5.12 ksps",
        "Sample rate [MS/s]: 0.00512",
        "Sample Rate: 5120 S/s",
        "Samplerate [1/s]: 5120",
        "Sampling rate: 5.12 kilohertz",
        "Sampling frequency: 307200 rpm",
        "Sample interval [s/1000]: 0.1953125",
        "Sample Interval: 195312.5 ns",
    ] {
        let found = table(head, None).unwrap();
        assert!((rate(&found, "x") / 5120.0 - 1.0).abs() < 1e-9, "{head}: {}", rate(&found, "x"));
    }
    let error = table("Sampling rate [kX/s]: 5.12", None).unwrap_err();
    assert!(error.contains("`kX/s`") && error.contains("--rate"), "{error}");
    let found = table("Sampling rate [kX/s]: 5.12", Some(5120.0)).unwrap();
    assert!(found.notes.iter().any(|note| note.contains("5120 Hz is used, as given")), "{:?}", found.notes);
}

#[test]
fn abscissa_units_of_universal_files() {
    let with = |unit: &str, factor: f64| {
        let axis = Axis::uniform(AxisQuantity::Frequency, 5.0 * factor, 0.5 * factor);
        let record = Record::new("H", Kind::Frf, axis, Values::Complex(frf()), "(m/s^2)/N");
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.uff");
        measured::write(&path, &MeasuredData { records: vec![record], ..MeasuredData::default() }).unwrap();
        let text = std::fs::read_to_string(&path).unwrap();
        let label = format!("{:<20}", "Hz");
        assert!(text.contains(&label), "{text}");
        read("a.uff", text.replace(&label, &format!("{unit:<20}")).as_bytes(), None)
    };
    for (unit, factor) in FREQUENCY_UNITS.into_iter().filter(|(unit, _)| *unit != "1/s") {
        let found = with(unit, factor).unwrap();
        let points = found.records[0].axis.points(COUNT).unwrap();
        for (k, expected) in frequencies(1.0).into_iter().enumerate() {
            assert!((points[k] / expected - 1.0).abs() < 2e-5, "{unit}: {} for {expected}", points[k]);
        }
    }
    let error = with("furlong", 1.0).unwrap_err();
    assert!(error.contains("the unit `furlong` of the abscissa"), "{error}");
}
