//! Arrays: times and counters among the channels, lists of frequencies, dates.

use crate::{names, rate, read, values, vibration};
use rotordyn_io::mat;
use rotordyn_io::measured::arrays::{Array, Data};
use rotordyn_io::measured::ramps::is_ramp;
use rotordyn_signal::record::{AxisQuantity, MeasuredData};

const COUNT: usize = 600;

fn vibrations() -> Vec<f64> {
    (0..COUNT).map(vibration).collect()
}

fn ramp(start: f64, step: f64) -> Vec<f64> {
    (0..COUNT).map(|k| start + step * k as f64).collect()
}

/// Columns as one array.
fn matrix(name: &str, columns: &[Vec<f64>]) -> Array {
    let data = (0..COUNT).flat_map(|k| columns.iter().map(move |column| column[k])).collect();
    Array { name: name.into(), shape: vec![COUNT, columns.len()], data: Data::Real(data) }
}

fn read_mat(arrays: &[Array], rate: Option<f64>) -> Result<MeasuredData, String> {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.mat");
    mat::write(&path, arrays).unwrap();
    read("a.mat", &std::fs::read(&path).unwrap(), rate)
}

#[test]
fn a_column_that_increases_by_the_step_of_the_sampling_is_the_time() {
    let time = ramp(0.25, 1e-3);
    let found = read_mat(&[matrix("data", &[time.clone(), vibrations()]), Array::scalar("fs", 1000.0)], None)
        .unwrap();
    assert_eq!((names(&found), rate(&found, "data[2]")), (vec!["data[2]"], 1000.0));
    assert_eq!(found.records[0].axis.start(), 0.25);
    assert!(
        found.notes.iter().any(|note| note.starts_with("`data[1]`") && note.contains("taken as the time"))
    );
    // By the rate that is given.
    let three = [matrix("a", &[time, vibrations(), vibrations()])];
    assert_eq!(names(&read_mat(&three, Some(1000.0)).unwrap()), ["a[2]", "a[3]"]);
    // It is the time of another rate than the one given.
    let found = read_mat(&three, Some(2000.0)).unwrap();
    assert!(
        found.notes.iter().any(|note| note.contains("sampled at 1000 Hz, 2000 Hz is used")),
        "{:?}",
        found.notes
    );
    assert!(is_ramp(&found.records[0]) && !is_ramp(&found.records[1]));
}

#[test]
fn a_counter_is_no_time() {
    for start in [0.0, 1.0] {
        let found = read_mat(&[matrix("a", &[ramp(start, 1.0), vibrations()])], None).unwrap();
        assert_eq!(found.records.iter().map(is_ramp).collect::<Vec<_>>(), [true, false]);
        assert!(found.records[1].sample_rate().is_err(), "a counter states no rate");
    }
    let text: String = (0..COUNT).map(|k| format!("{k},{:.3},{}\n", 1e-3 * k as f64, vibration(k))).collect();
    let found = read("t.csv", format!(",time,x\n{text}").as_bytes(), None).unwrap();
    assert_eq!(found.records.iter().map(is_ramp).collect::<Vec<_>>(), [true, false]);
    assert!(found.notes.is_empty(), "{:?}", found.notes);
    // A temperature that rises by the step of the times is none.
    let text: String = (0..COUNT)
        .map(|k| format!("{:.3},{},{}\n", 1e-3 * k as f64, 20.0 + 1e-3 * k as f64, vibration(k)))
        .collect();
    let found = read("t.csv", format!("time,T,x\n{text}").as_bytes(), None).unwrap();
    assert_eq!((names(&found), found.records[1].axis.start()), (vec!["T", "x"], 0.0));
    // A ramp alone, or with dwells, is a channel.
    let found = read_mat(&[Array::real("x", ramp(0.0, 1e-3)), Array::scalar("fs", 1000.0)], None).unwrap();
    assert_eq!(names(&found), ["x"]);
    let bent: Vec<f64> = ramp(0.0, 1.0).iter().map(|v| v + 1e-3 * v * v).collect();
    let found = read_mat(&[matrix("a", &[bent, vibrations()]), Array::scalar("fs", 1.0)], None).unwrap();
    assert!(!is_ramp(&found.records[0]));
}

#[test]
fn values_of_both_signs_lie_over_time_although_frequencies_have_their_length() {
    let frequencies = Array::real("f", ramp(0.0, 2.0));
    let amplitudes = Array::real("X", vibrations().iter().map(|v| v.abs()).collect());
    let axes = [Array::scalar("fs", 1000.0), Array::real("t", ramp(0.0, 1e-3))];
    for axis in axes {
        let arrays = [Array::real("acc", vibrations()), amplitudes.clone(), axis, frequencies.clone()];
        let found = read_mat(&arrays, None).unwrap();
        assert_eq!(rate(&found, "acc"), 1000.0);
        assert_eq!(values(&found, "acc"), vibrations());
        assert_eq!(found.record("X").unwrap().axis.quantity, AxisQuantity::Frequency);
        assert!(
            found.notes.iter().any(|note| note.contains("`acc`") && note.contains("`f`")),
            "{:?}",
            found.notes
        );
    }
    // Without a rate there is one axis; and a phase has both signs.
    let found = read_mat(&[Array::real("acc", vibrations()), frequencies.clone()], None).unwrap();
    assert_eq!(found.records[0].axis.quantity, AxisQuantity::Frequency);
    let phase = [Array::real("phase_deg", vibrations()), Array::scalar("fs", 1000.0), frequencies];
    assert_eq!(read_mat(&phase, None).unwrap().records[0].axis.quantity, AxisQuantity::Frequency);
}

/// A .npy of another type than this program writes.
fn npy_of(descr: &str, data: &[u8], count: usize) -> Vec<u8> {
    let header = format!("{{'descr': '{descr}', 'fortran_order': False, 'shape': ({count},), }}");
    let header = format!("{header:<117}\n");
    let mut out = b"\x93NUMPY\x01\x00".to_vec();
    out.extend((header.len() as u16).to_le_bytes());
    out.extend(header.as_bytes());
    out.extend(data);
    out
}

#[test]
fn dates_of_numpy_are_times_or_left_out_by_name() {
    let start = 1_704_067_200_000_000_i64;
    let data: Vec<u8> = (0..COUNT as i64).flat_map(|k| (start + 500 * k).to_le_bytes()).collect();
    let archive = |times: &str, descr: &str| {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("z.npz");
        let mut archive = zip::ZipWriter::new(std::fs::File::create(&path).unwrap());
        let numbers: Vec<u8> = vibrations().iter().flat_map(|v| v.to_le_bytes()).collect();
        for (name, content) in [(times, npy_of(descr, &data, COUNT)), ("x", npy_of("<f8", &numbers, COUNT))] {
            archive.start_file(format!("{name}.npy"), zip::write::SimpleFileOptions::default()).unwrap();
            std::io::Write::write_all(&mut archive, &content).unwrap();
        }
        archive.finish().unwrap();
        read("z.npz", &std::fs::read(&path).unwrap(), None).unwrap()
    };
    for descr in ["<M8[us]", "<m8[us]"] {
        let found = archive("t", descr);
        assert_eq!((names(&found), rate(&found, "x")), (vec!["x"], 2000.0), "{descr}");
        assert_eq!(values(&found, "x"), vibrations());
    }
    for (name, descr) in [("t", "<M8[25us]"), ("stamps", "<M8[us]"), ("t", "<M8")] {
        let found = archive(name, descr);
        assert_eq!(names(&found), ["x"], "{descr}");
        assert!(found.left_out[0].contains(&format!("{name} (dates, datetime64")), "{:?}", found.left_out);
    }
}

/// Integers of netCDF stand for other values; a data set without a data space has none.
#[test]
#[cfg(feature = "hdf5")]
fn packed_integers_and_empty_data_sets_of_hdf5() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("p.h5");
    let file = hdf5::File::create(&path).unwrap();
    let stored: Vec<i16> = vibrations().iter().map(|v| (1000.0 * v) as i16).collect();
    let data = file.new_dataset_builder().with_data(&stored).create("x").unwrap();
    data.new_attr::<f64>().create("scale_factor").unwrap().write_scalar(&0.001).unwrap();
    data.new_attr::<f64>().create("add_offset").unwrap().write_scalar(&0.5).unwrap();
    file.new_dataset::<f64>().create("fs").unwrap().write_scalar(&1000.0).unwrap();
    file.new_dataset::<f64>().shape(hdf5::Extents::Null).create("e").unwrap();
    drop((data, file));
    let found = read("p.h5", &std::fs::read(&path).unwrap(), None).unwrap();
    let differ = values(&found, "x")
        .iter()
        .zip(&stored)
        .any(|(v, s)| (v - (f64::from(*s) * 0.001 + 0.5)).abs() > 1e-12);
    assert!(!differ);
    assert!(found.scalars.is_empty(), "{:?}", found.scalars);
    assert_eq!(found.left_out, ["/e (empty)"]);
}

/// A rate, a step or times beside the name of a channel hold for it alone, in whichever order the two names stand.
#[test]
fn a_rate_with_the_name_of_a_channel_is_its_own() {
    let slow: Vec<f64> = vibrations().into_iter().step_by(10).collect();
    let times: Vec<f64> = (0..slow.len()).map(|k| 0.5 + 0.01 * k as f64).collect();
    let channels =
        [Array::real("acc", vibrations()), Array::scalar("fs", 1000.0), Array::real("tacho", slow)];
    let own = [
        Array::scalar("fs_tacho", 100.0),
        Array::scalar("tacho_fs", 100.0),
        Array::scalar("sr_tacho", 100.0),
        Array::scalar("tachoRate", 100.0),
        Array::scalar("rateTacho", 100.0),
        Array::scalar("tacho_dt", 0.01),
        Array::scalar("SampleRate_tacho", 100.0),
        Array::text("fs_tacho", "0.1 kHz"),
        Array::real("t_tacho", times.clone()),
        Array::real("tacho_time", times),
    ];
    for stated in own {
        let found = read_mat(&[&channels[..], std::slice::from_ref(&stated)].concat(), None).unwrap();
        assert_eq!(names(&found), ["acc", "tacho"], "{}", stated.name);
        assert_eq!(rate(&found, "acc"), 1000.0, "{}", stated.name);
        assert!((rate(&found, "tacho") - 100.0).abs() < 1e-9, "{}", stated.name);
        assert!(found.scalars.is_empty() && found.left_out.is_empty(), "{found:?}");
    }
    // Each has its own, and of a name that is no channel's nothing is taken.
    let each = [
        &channels[..1],
        &channels[2..],
        &[Array::scalar("fs_acc", 1000.0), Array::scalar("fs_tacho", 100.0)],
    ];
    let found = read_mat(&each.concat(), None).unwrap();
    assert_eq!((rate(&found, "acc"), rate(&found, "tacho")), (1000.0, 100.0));
    let found = read_mat(&[&channels[..], &[Array::scalar("fs_pump", 100.0)]].concat(), None).unwrap();
    assert_eq!((rate(&found, "tacho"), found.scalars.len()), (1000.0, 1));
}
