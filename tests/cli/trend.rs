//! `trend`: several records of one machine.

use std::f64::consts::TAU;
use std::path::{Path, PathBuf};

use crate::signal::{faulty_bearing_record, measured_data};
use crate::{output_of, rotordyn};
use rotordyn::io::measured;
use rotordyn::signal::record::{MeasuredData, Record};
use serde_json::Value;

const RATE: f64 = 12_000.0;
/// Two seconds: 24 revolutions of the cage at 1800 rpm.
const SAMPLES: usize = 24_000;
/// Order of the outer race of a 6205-2RS at 1800 rpm \[Hz\].
const BPFO: f64 = 30.0 * 3.58482;

/// Uniform noise of one seed and three shaft harmonics.
fn healthy(seed: u32) -> Vec<f64> {
    let mut state = seed.wrapping_mul(2_654_435_761).wrapping_add(1);
    (0..SAMPLES)
        .map(|k| {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            let angle = TAU * 30.0 * k as f64 / RATE;
            f64::from(state) / 2f64.powi(31) - 1.0
                + 0.2 * angle.cos()
                + 0.1 * (2.0 * angle).cos()
                + 0.1 * (3.0 * angle).cos()
        })
        .collect()
}

/// The same with impacts on the outer race of some amplitude, which excite 3.5 kHz.
fn faulty(seed: u32, amplitude: f64) -> Vec<f64> {
    let [with, without] =
        [faulty_bearing_record(SAMPLES, RATE, BPFO), faulty_bearing_record(SAMPLES, RATE, 0.0)];
    let impacts = with.iter().zip(&without).map(|(a, b)| a - b);
    healthy(seed).iter().zip(impacts).map(|(x, impact)| x + 0.2 * amplitude * impact).collect()
}

fn write(folder: &Path, name: &str, samples: Vec<f64>, rate: f64) -> PathBuf {
    let mut record = Record::samples("A_ax", rate, 0.0, samples, "m/s^2");
    record.speed_rpm = Some(1800.0);
    let path = folder.join(name);
    measured::write(&path, &MeasuredData { records: vec![record], ..MeasuredData::default() }).unwrap();
    path
}

/// The document of a trend, whatever the exit code.
fn trend(paths: &[&Path], out: &Path, flags: &[&str]) -> (Value, i32) {
    let mut command = rotordyn();
    command.arg("trend").args(paths).arg("--json").arg("--quiet").arg("--out").arg(out).args(flags);
    let output = command.output().unwrap();
    let text = String::from_utf8(output.stdout).unwrap();
    let document = serde_json::from_str(&text).unwrap_or_else(|e| {
        panic!("{e}: {text}{}", String::from_utf8_lossy(&output.stderr));
    });
    (document, output.status.code().unwrap())
}

fn texts(list: &Value) -> Vec<&str> {
    list.as_array().unwrap().iter().map(|v| v.as_str().unwrap_or_default()).collect()
}

fn column<'a>(document: &'a Value, name: &str) -> Vec<&'a Value> {
    document["records"].as_array().unwrap().iter().map(|row| &row[name]).collect()
}

fn codes(document: &Value) -> Vec<&str> {
    document["warnings"].as_array().unwrap().iter().filter_map(|w| w["code"].as_str()).collect()
}

/// A fault that grows from nothing: found from some record on, statistics and its line rise, and nothing else is named.
#[test]
fn run_to_failure() {
    let folder = tempfile::tempdir().unwrap();
    let records = folder.path().join("run");
    std::fs::create_dir(&records).unwrap();
    for k in 0..12u32 {
        // Six healthy records, then impacts of 0.3 to 5 times the noise's span, 1.75 from one to the next.
        let amplitude = if k < 6 { 0.0 } else { 0.3 * 1.75f64.powi(k as i32 - 6) };
        // Every two hours, over midnight.
        let (day, hour) = (12 + (20 + 2 * k) / 24, (20 + 2 * k) % 24);
        let name = format!("2004.02.{day}.{hour:02}.32.39.h5");
        write(&records, &name, faulty(k + 1, amplitude), RATE);
    }
    let out = folder.path().join("out");
    let (found, code) = trend(&[&records], &out, &["--bearing", "6205-2RS", "--csv"]);
    assert_eq!(code, 0, "{}", found["warnings"]);
    assert_eq!(found["schema"], "rotordyn-trend-1");
    assert_eq!((&found["axis"]["name"], &found["axis"]["unit"]), (&"time".into(), &"h".into()));
    assert!(
        found["axis"]["source"].as_str().unwrap().contains("from 2004-02-12 20:32:39"),
        "{}",
        found["axis"]
    );
    let positions: Vec<f64> = column(&found, "position").iter().map(|v| v.as_f64().unwrap()).collect();
    assert!(positions.iter().enumerate().all(|(k, t)| (t - 2.0 * k as f64).abs() < 1e-9), "{positions:?}");
    let named = column(&found, "diagnosis");
    assert!(named[..6].iter().all(|part| part.is_null()), "{named:?}");
    assert!(named.iter().all(|part| part.is_null() || **part == "outer race"), "{named:?}");
    assert!(named[9..].iter().all(|part| **part == "outer race"), "{named:?}");
    let statements = texts(&found["statements"]);
    let says = |words: &[&str]| statements.iter().any(|s| words.iter().all(|word| s.contains(word)));
    assert!(says(&["outer race named from record", ") on"]), "{statements:?}");
    assert!(says(&["BPFO amplitude rises from 0 to"]), "{statements:?}");
    assert!(says(&["RMS rises from 0.6", "per h, 95 %"]), "{statements:?}");
    let probability: Vec<f64> = column(&found, "probability").iter().map(|v| v.as_f64().unwrap()).collect();
    assert!(probability[11] > 0.9 && probability[..6].iter().all(|p| *p < 0.5), "{probability:?}");
    for file in ["trend.h5", "trend.svg", "trend.png", "csv"] {
        assert!(out.join(file).exists(), "{file}");
    }
    // The same bits on one thread.
    let (single, _) =
        trend(&[&records], &folder.path().join("one"), &["--bearing", "6205-2RS", "--threads", "1"]);
    for key in ["records", "changes", "statements"] {
        assert_eq!(single[key], found[key], "{key}");
    }
}

/// Records of one healthy machine: no trend, no part; in the natural order of their names.
#[test]
fn healthy_machine() {
    let folder = tempfile::tempdir().unwrap();
    let records = folder.path().join("healthy");
    std::fs::create_dir(&records).unwrap();
    for k in 1..=12u32 {
        write(&records, &format!("rec{k}.h5"), healthy(100 + k), RATE);
    }
    let (found, code) =
        trend(&[&records], &folder.path().join("out"), &["--bearing", "6205-2RS", "--no-figures"]);
    assert_eq!(code, 0);
    let names: Vec<&str> = column(&found, "name").iter().map(|v| v.as_str().unwrap()).collect();
    let expected: Vec<String> = (1..=12).map(|k| format!("rec{k}.h5")).collect();
    assert_eq!(names, expected);
    assert_eq!(
        (&found["axis"]["name"], &found["axis"]["source"]),
        (&"rec".into(), &"the number in the names".into())
    );
    let statements = texts(&found["statements"]);
    assert_eq!(
        statements,
        [
            "no quantity has a significant trend over rec (12 records, Mann-Kendall test at 5 % for all together)",
            "no part is named in 12 judged records"
        ]
    );
    assert!(codes(&found).is_empty(), "{}", found["warnings"]);
}

/// The two records of Case Western Reserve University over a load that is given: each keeps its diagnosis.
#[test]
fn measured_records_over_a_given_axis() {
    let paths = ["cwru/105_IR007_0hp_12k.mat", "cwru/130_OR007at6_0hp_12k.mat"].map(measured_data::measured);
    let [Some(inner), Some(outer)] = paths else { return };
    let folder = tempfile::tempdir().unwrap();
    let flags =
        ["--rate", "12 kHz", "--bearing", "6205-2RS", "--over", "wear=7,7.5 mil", "--channel", "DE_time"];
    let (found, code) = trend(&[&inner, &outer], folder.path(), &flags);
    assert_eq!(code, 0, "{}", found["errors"]);
    assert_eq!((&found["axis"]["name"], &found["axis"]["unit"]), (&"wear".into(), &"mil".into()));
    for (row, part, channel, rms, kurtosis) in
        [(0, "inner race", "X105_DE_time", 0.29153, 5.396), (1, "outer race", "X130_DE_time", 0.66951, 7.649)]
    {
        let record = &found["records"][row];
        assert_eq!((&record["diagnosis"], &record["channel"]), (&part.into(), &channel.into()));
        // The digits of their description.
        assert!((record["rms"].as_f64().unwrap() - rms).abs() < 1e-5, "{record}");
        assert!((record["kurtosis"].as_f64().unwrap() - kurtosis).abs() < 1e-3, "{record}");
        assert!((record["speed_rpm"].as_f64().unwrap() - 1797.0).abs() < 20.0, "{record}");
    }
    assert!(texts(&found["statements"])[0].starts_with("2 records: too few"), "{}", found["statements"]);
    // The channels differ by the number of the record only.
    assert!(!codes(&found).contains(&"records-differ"), "{}", found["warnings"]);
}

/// What is no record of a folder is named; what cannot be read or judged is a row, and an exit code.
#[test]
fn junk_and_damaged_records() {
    let folder = tempfile::tempdir().unwrap();
    let records = folder.path().join("mixed");
    std::fs::create_dir(&records).unwrap();
    for k in 1..=3u32 {
        write(&records, &format!("rec{k}.h5"), healthy(k), RATE);
    }
    let mut hole = healthy(4);
    hole[1000] = f64::NAN;
    write(&records, "rec4.h5", hole, RATE);
    write(&records, "rec5.h5", healthy(5)[..3000].to_vec(), RATE);
    std::fs::write(records.join("rec6.h5"), b"\x89HDF\r\n\x1a\nno file").unwrap();
    std::fs::write(records.join("README.txt"), "These are records of a pump.\n").unwrap();
    std::fs::write(records.join("photo.jpg"), b"\xff\xd8\xff\xe0\0\x10JFIF").unwrap();
    std::fs::create_dir(records.join("notes")).unwrap();
    let out = folder.path().join("out");
    let (found, code) = trend(&[&records], &out, &["--bearing", "6205-2RS"]);
    assert_eq!(code, 2);
    let problems: Vec<String> =
        column(&found, "problem").iter().map(|v| v.as_str().unwrap_or_default().to_string()).collect();
    assert!(problems[..3].iter().all(String::is_empty), "{problems:?}");
    assert!(problems[3].contains("NaN or infinite") && problems[3].contains("1000"), "{problems:?}");
    assert!(problems[4].contains("ten revolutions of the cage"), "{problems:?}");
    assert!(!problems[5].is_empty(), "{problems:?}");
    // The short one has its statistics.
    assert!(found["records"][4]["rms"].is_f64() && found["records"][3]["rms"].is_null());
    assert_eq!(found["errors"].as_array().unwrap().len(), 3, "{}", found["errors"]);
    let left_out = found["warnings"].to_string();
    for name in ["README.txt", "photo.jpg", "notes"] {
        assert!(left_out.contains(name), "{name}: {left_out}");
    }
    assert!(out.join("trend.svg").exists());
}

/// A single record, different rates and channels, an axis of the files, speeds per record.
#[test]
fn other_sets_of_records() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("out");
    let one = write(folder.path(), "one.h5", healthy(1), RATE);
    let (found, code) = trend(&[&one], &out, &["--bearing", "6205-2RS"]);
    assert_eq!((code, found["records"].as_array().unwrap().len()), (0, 1));
    assert!(texts(&found["statements"])[0].starts_with("1 record: too few"), "{}", found["statements"]);

    let fast = write(folder.path(), "fast.h5", healthy(2), 2.0 * RATE);
    let flags = ["--bearing", "6205-2RS", "--speed", "1800, 3600 rpm", "--over", "speed", "--no-figures"];
    let (found, _) = trend(&[&one, &fast], &out, &flags);
    let differ = codes(&found).iter().filter(|code| **code == "records-differ").count();
    // Sampling rates; and durations, half as long.
    assert_eq!(differ, 2, "{}", found["warnings"]);
    assert!(found["warnings"].to_string().contains("24000 Hz (fast.h5)"), "{}", found["warnings"]);
    let positions: Vec<f64> = column(&found, "position").iter().map(|v| v.as_f64().unwrap()).collect();
    assert!((positions[0] - 1800.0).abs() < 20.0 && (positions[1] - 3600.0).abs() < 40.0, "{positions:?}");

    // A number that the files state, here in a structure.
    let loaded = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/arrays/structures/mfpt.mat");
    let (found, code) = trend(&[&loaded], &out, &["--over", "load", "--no-figures"]);
    assert_eq!((code, &found["records"][0]["position"]), (0, &270.0.into()));
    assert_eq!(found["records"][0]["channel"], "bearing.gs");
    assert!(found["axis"]["source"].as_str().unwrap().contains("`load`"), "{}", found["axis"]);

    for (flags, part) in [
        (["--over", "load=1,2,3"], "3 values for 2 records"),
        (["--over", "lood"], "states no number of this name"),
        (["--over", "time"], "neither all files nor all names state a date"),
        (["--speed", "1,2,3 rpm"], "3 speeds for 2 records"),
        (["--rms-bands", "2 kHz"], "expected a range"),
    ] {
        let (found, code) = trend(&[&one, &fast], &out, &flags);
        assert_eq!(code, 2, "{flags:?}");
        assert!(found["errors"].to_string().contains(part), "{flags:?}: {}", found["errors"]);
    }
    let (none, code) = trend(&[&folder.path().join("missing.h5")], &out, &[]);
    assert_eq!(code, 4, "{}", none["errors"]);
}

/// RMS values of two bands side by side add up in power to that of the record without its mean.
#[test]
fn bands_of_rms() {
    let folder = tempfile::tempdir().unwrap();
    let one = write(folder.path(), "one.h5", healthy(1), RATE);
    let flags = ["--rms-bands", "0 Hz .. 1 kHz,1 kHz .. 6 kHz", "--no-figures"];
    let (found, code) = trend(&[&one], folder.path(), &flags);
    assert_eq!(code, 0, "{}", found["errors"]);
    let record = &found["records"][0];
    let bands: Vec<f64> =
        record["band_rms"].as_array().unwrap().iter().map(|v| v.as_f64().unwrap()).collect();
    let of = |name: &str| record[name].as_f64().unwrap();
    let power = of("rms").powi(2) - of("mean").powi(2);
    assert!((bands.iter().map(|b| b * b).sum::<f64>() / power - 1.0).abs() < 1e-12, "{bands:?} {power}");
    // White noise of variance 1/3 and the shaft's lines, both mostly where they belong.
    let noise = 1.0 / 3.0;
    assert!((bands[0].powi(2) / (noise / 6.0 + 0.03) - 1.0).abs() < 0.05, "{bands:?}");
}

/// The table in the terminal.
#[test]
fn table_of_the_terminal() {
    let folder = tempfile::tempdir().unwrap();
    let [first, second] = [1, 2].map(|k| write(folder.path(), &format!("rec{k}.h5"), healthy(k), RATE));
    let text = output_of(
        rotordyn()
            .arg("trend")
            .args([&first, &second])
            .args(["--bearing", "6205-2RS", "--no-figures", "--out"])
            .arg(folder.path().join("out")),
    );
    let text = text.replace(&folder.path().display().to_string(), "FOLDER");
    insta::assert_snapshot!("table_of_a_trend", text);
}
