//! Channels that are no vibration: dead ones are not judged, counters and times not chosen; what repeats or rests by nature
//! is no gap.

use crate::program;
use assert_cmd::Command;
use rotordyn::io::measured;
use rotordyn::signal::record::{Axis, AxisQuantity, Kind, MeasuredData, Record, Values};
use std::f64::consts::TAU;
use std::path::Path;

const RATE: f64 = 12_000.0;
const SAMPLES: usize = 36_000;

fn write(folder: &Path, name: &str, values: Vec<f64>) {
    let axis = Axis::uniform(AxisQuantity::Time, 0.0, 1.0 / RATE);
    let records = vec![Record::new("acc", Kind::Time, axis, Values::Real(values), "m/s^2")];
    measured::write(&folder.join(name), &MeasuredData { records, ..MeasuredData::default() }).unwrap();
}

/// Shaft harmonics of 24.7 rev/s in noise.
fn vibration() -> Vec<f64> {
    let mut state = 1u32;
    let mut sample = |k: usize| {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        let angle = TAU * 24.7 * k as f64 / RATE;
        f64::from(state) / f64::from(u32::MAX) - 0.5 + 0.5 * angle.cos() + 0.3 * (2.0 * angle).cos()
    };
    (0..SAMPLES).map(&mut sample).collect()
}

fn run(folder: &Path, arguments: &[&str]) -> (String, Option<i32>) {
    let output = Command::cargo_bin("rotordyn")
        .unwrap()
        .args(arguments)
        .args(["--no-figures", "--out", "out", "--speed", "1482 rpm", "--bearing", "6205-2RS"])
        .current_dir(folder)
        .output()
        .unwrap();
    let text = [output.stdout, output.stderr].map(|bytes| String::from_utf8_lossy(&bytes).into_owned());
    (text.concat(), output.status.code())
}

#[test]
fn dead_channels_are_not_diagnosed() {
    let folder = program::folder(&[]);
    let mut mostly = vibration();
    mostly[100..].fill(0.0);
    for (name, values, code) in [
        ("zeros.npz", vec![0.0; SAMPLES], "dead-channel"),
        ("const.npz", vec![3.0; SAMPLES], "dead-channel"),
        ("mostly.npz", mostly, "record-gap"),
    ] {
        write(folder.path(), name, values);
        let (text, exit) = run(folder.path(), &["signal", name]);
        assert_eq!(exit, Some(0), "{text}");
        assert!(!text.contains("no bearing fault"), "{text}");
        assert!(
            text.contains("no bearing diagnosis") && text.contains(&format!("warning[{code}]")),
            "{text}"
        );
    }
    write(folder.path(), "alive.npz", vibration());
    let (text, _) = run(folder.path(), &["signal", "alive.npz"]);
    assert!(text.contains("no bearing fault") && !text.contains("warning[record-"), "{text}");
    // The second record of a comparison.
    let (text, _) = run(folder.path(), &["signal", "alive.npz", "--compare-with", "mostly.npz"]);
    assert!(text.contains("warning[record-gap]") && text.contains("mostly.npz: `acc`"), "{text}");
}

#[test]
fn a_dead_record_of_a_trend_is_a_failure() {
    let folder = program::folder(&[]);
    for k in 1..=4 {
        let values = if k == 3 { vec![0.0; SAMPLES] } else { vibration() };
        write(folder.path(), &format!("rec{k}.npz"), values);
    }
    let (text, exit) = run(folder.path(), &["trend", "rec1.npz", "rec2.npz", "rec3.npz", "rec4.npz"]);
    assert_ne!(exit, Some(0), "{text}");
    assert!(text.contains("rec3.npz") && text.contains("the sensor is dead"), "{text}");
    assert_eq!(text.matches("no bearing fault").count(), 3, "{text}");
}

/// The pulse of a hammer behind noise, under a force window.
#[test]
fn a_force_window_is_no_gap() {
    let folder = program::folder(&[]);
    let force = |k: usize| match k {
        0..60 => 0.01 * vibration()[k],
        60..80 => 50.0 * (0.15 * (k - 60) as f64).sin(),
        _ => 0.0,
    };
    let axis = Axis::uniform(AxisQuantity::Time, 0.0, 1.0 / RATE);
    let values = Values::Real((0..6000).map(force).collect());
    let records = vec![Record::new("force", Kind::Time, axis, values, "N")];
    measured::write(&folder.path().join("hit.npz"), &MeasuredData { records, ..MeasuredData::default() })
        .unwrap();
    let codes =
        program::codes(folder.path(), &["signal", "hit.npz", "--no-figures", "--analyses", "spectrum"], 0);
    assert!(!codes.contains("record-gap"), "{codes:?}");
}

/// A converter of 16 steps, an amplifier at its limit, and a start from rest.
#[test]
fn repeated_values_of_a_sound_channel_are_not_named() {
    let folder = program::folder(&[]);
    let smooth = |k: usize| (TAU * 24.7 * k as f64 / RATE).sin();
    let records: [(&str, Vec<f64>); 4] = [
        ("coarse.npz", (0..SAMPLES).map(|k| (8.0 * smooth(k)).round()).collect()),
        ("limited.npz", (0..SAMPLES).map(|k| (3.0 * smooth(k)).clamp(-1.0, 1.0)).collect()),
        ("square.npz", (0..SAMPLES).map(|k| smooth(k).signum()).collect()),
        (
            "rest.npz",
            (0..SAMPLES).map(|k| smooth(k) * (k.saturating_sub(9000) as f64 / 1e4).powi(2)).collect(),
        ),
    ];
    for (name, values) in records {
        write(folder.path(), name, values);
        let (text, _) = run(folder.path(), &["signal", name]);
        assert!(
            !text.contains("record-gap") && !text.contains("record-spike") && !text.contains("dead-channel"),
            "{text}"
        );
    }
}

#[test]
fn a_counter_is_not_the_default_channel() {
    let table = |head: &str| {
        let lines = vibration()
            .iter()
            .take(2000)
            .enumerate()
            .map(|(k, x)| format!("{k};{x:.5}\n"))
            .collect::<String>();
        format!("{head}\n{lines}")
    };
    let folder = program::folder(&[
        ("counter.csv", table("Sample;Accel")),
        ("spectrum.csv", table("Frequency [Hz];X")),
    ]);
    let signal = |arguments: &[&str]| {
        let mut command = Command::cargo_bin("rotordyn").unwrap();
        command.arg("signal").args(arguments).args(["--no-figures", "--out", "out", "--json", "--quiet"]);
        command.current_dir(folder.path()).output().unwrap()
    };
    let output = signal(&["counter.csv", "--rate", "12 kHz"]);
    let document: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(document["channels"][0]["channel"], "Accel", "{document}");
    assert!(document["warnings"].as_array().unwrap().is_empty(), "{}", document["warnings"]);
    for channel in [&[][..], &["--channel", "all"]] {
        let output = signal(&[&["spectrum.csv"], channel].concat());
        let text = String::from_utf8_lossy(&output.stderr).into_owned();
        assert!(!output.status.success() && text.contains("contains no time record"), "{text}");
    }
}
