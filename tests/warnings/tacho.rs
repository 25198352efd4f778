//! What is said of tachos: rates that are assumed, wheels with teeth left out, uneven marks; and of orders in the band of another.

use crate::program;
use assert_cmd::Command;
use rotordyn::io::mat;
use rotordyn::io::measured::{self, arrays::Array};
use rotordyn::signal::record::{Axis, AxisQuantity, Kind, MeasuredData, Record, Values};
use std::f64::consts::TAU;
use std::path::Path;

const RATE: f64 = 5_000.0;
const SAMPLES: usize = 60_000;

/// Turns of a shaft from 20 to 26 rev/s.
fn turns(t: f64) -> f64 {
    20.0 * t + 0.25 * t * t
}

fn time_record(name: &str, rate: f64, values: Vec<f64>, unit: &str) -> Record {
    let axis = Axis::uniform(AxisQuantity::Time, 0.0, 1.0 / rate);
    Record::new(name, Kind::Time, axis, Values::Real(values), unit)
}

/// A vibration of 1x, 3x and noise, and pulses of marks at `places`, sampled at a fraction of its rate.
fn write(folder: &Path, places: &[f64], fraction: usize) {
    let mut state = 1u32;
    let sample = |k: usize| {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        let angle = TAU * turns(k as f64 / RATE);
        0.05 * (f64::from(state) / f64::from(u32::MAX) - 0.5) + angle.cos() + 0.5 * (3.0 * angle).sin()
    };
    let vibration: Vec<f64> = (0..SAMPLES).map(sample).collect();
    let at_mark = |k: usize| {
        let turn = turns((k * fraction) as f64 / RATE).fract();
        let pulse = 0.4 / places.len() as f64;
        5.0 * f64::from(places.iter().any(|place| (turn - place).rem_euclid(1.0) < pulse))
    };
    let pulses: Vec<f64> = (0..SAMPLES / fraction).map(at_mark).collect();
    let records = vec![time_record("acc", RATE, vibration, "m/s^2"), time_record("tacho", RATE, pulses, "V")];
    measured::write(&folder.join("run.mat"), &MeasuredData { records, ..MeasuredData::default() }).unwrap();
}

fn signal(folder: &Path, arguments: &[&str]) -> String {
    let output = Command::cargo_bin("rotordyn")
        .unwrap()
        .args(["signal", "run.mat", "--no-figures", "--out", "out", "--channel", "acc", "--tacho", "tacho"])
        .args(["--analyses", "orders"])
        .args(arguments)
        .current_dir(folder)
        .output()
        .unwrap();
    let text =
        [output.stdout, output.stderr].map(|bytes| String::from_utf8_lossy(&bytes).into_owned()).concat();
    assert_eq!(output.status.code(), Some(0), "{text}");
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

#[test]
fn wheel_with_teeth_left_out_is_counted_and_said() {
    let folder = program::folder(&[]);
    let teeth: Vec<f64> = (0..22).map(|tooth| f64::from(tooth) / 24.0).collect();
    write(folder.path(), &teeth, 1);
    for stated in ["24", "22"] {
        let text = signal(folder.path(), &["--pulses-per-rev", stated]);
        assert!(text.contains("a wheel of 24 pitches with 2 teeth missing, 22 per revolution"), "{text}");
        assert!(!text.contains("missing pulses added") && !text.contains("warning["), "{text}");
    }
}

#[test]
fn uneven_marks_and_more_than_one_are_said() {
    let folder = program::folder(&[]);
    write(folder.path(), &[0.0, 0.26, 0.49, 0.755], 1);
    let text = signal(folder.path(), &["--pulses-per-rev", "4"]);
    assert!(text.contains("warning[tacho-jitter]") && text.contains("its 4 marks are up to"), "{text}");
    write(folder.path(), &[0.0, 0.45], 1);
    let text = signal(folder.path(), &[]);
    assert!(text.contains("more than one mark per turn") && text.contains("--pulses-per-rev 2"), "{text}");
    write(folder.path(), &[0.0, 0.25, 0.5, 0.75], 1);
    let text = signal(folder.path(), &["--pulses-per-rev", "4"]);
    assert!(!text.contains("warning["), "{text}");
}

#[test]
fn rate_of_a_shorter_tacho_is_not_assumed_silently() {
    let folder = program::folder(&[]);
    write(folder.path(), &[0.0], 5);
    // Written with a rate for each channel: here with one for the file.
    let path = folder.path().join("run.mat");
    let data = measured::read(&path).unwrap();
    let array = |record: &Record| Array::real(&record.name, record.time_samples().unwrap().to_vec());
    let mut arrays: Vec<Array> = data.records.iter().map(array).collect();
    arrays.push(Array::scalar("fs", RATE));
    mat::write(&path, &arrays).unwrap();
    let text = signal(folder.path(), &[]);
    assert!(text.contains("warning[measured-data]") && text.contains("1/5 of the 60000 of `acc`"), "{text}");
    assert!(text.contains("its rate is 1000.00 Hz"), "{text}");
}

#[test]
fn harmonic_in_the_band_of_another_order_is_said() {
    let folder = program::folder(&[]);
    write(folder.path(), &[0.0], 1);
    let text = signal(folder.path(), &["--orders", "1,3.03"]);
    assert!(text.contains("warning[orders-in-one-band]") && text.contains("is the line of 3x"), "{text}");
    let text = signal(folder.path(), &["--orders", "1,3,2.03,4.02,3.3"]);
    assert!(!text.contains("orders-in-one-band"), "{text}");
    let text = signal(folder.path(), &["--orders", "1,3.2", "--bandwidth", "0.5"]);
    assert!(text.contains("tracked for 3.2x") && text.contains("is the line of 3x"), "{text}");
}

#[test]
fn limit_of_a_channel_is_said_in_a_trend() {
    let folder = program::folder(&[]);
    write(folder.path(), &[0.0], 1);
    let data = measured::read(&folder.path().join("run.mat")).unwrap();
    for (name, limit) in [("a.npz", 9.0), ("b.npz", 1.1), ("c.npz", 9.0)] {
        let mut record = data.records[0].clone();
        let Values::Real(values) = &mut record.values else { unreachable!() };
        values.iter_mut().for_each(|x| *x = x.clamp(-limit, limit));
        measured::write(
            &folder.path().join(name),
            &MeasuredData { records: vec![record], ..MeasuredData::default() },
        )
        .unwrap();
    }
    let output = Command::cargo_bin("rotordyn")
        .unwrap()
        .args(["trend", "a.npz", "b.npz", "c.npz", "--no-figures", "--out", "trend"])
        .current_dir(folder.path())
        .output()
        .unwrap();
    let text = String::from_utf8_lossy(&output.stderr).split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(text.contains("warning[clipped-record]") && text.contains("b.npz: `acc` is clipped"), "{text}");
}
