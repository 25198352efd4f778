//! Channel mapping: assignment of channels to stations and directions of the model.

use std::path::{Path, PathBuf};

use rotordyn::error::Error;
use rotordyn::io::measured::mapping::{self, Mapping, direction};
use rotordyn::signal::Complex;
use rotordyn::signal::record::{Axis, AxisQuantity, Dof, Kind, MeasuredData, Points, Record, Values};

use crate::example_records::{frequency_records, time_records};

fn mapping(text: &str) -> Result<Mapping, Error> {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("mapping.toml");
    std::fs::write(&path, text).unwrap();
    mapping::read(&path)
}

/// Point number of a station of the model.
fn station(name: &str) -> Option<i64> {
    ["A", "disc", "B"].iter().position(|n| *n == name).map(|k| 10 * (k as i64 + 1))
}

fn apply(text: &str, records: &[Record]) -> Result<(MeasuredData, Vec<String>), String> {
    let mut measured = MeasuredData { records: records.to_vec(), ..MeasuredData::default() };
    let path = PathBuf::from("mapping.toml");
    match mapping(text).unwrap().apply(&mut measured, &station, &path) {
        Ok(warnings) => Ok((measured, warnings)),
        Err(error) => Err(error.to_string()),
    }
}

#[test]
fn channels_are_mapped_by_name_and_others_dropped() {
    let mut records = time_records();
    records[1].unit = String::new();
    records[1].axis.points = Points::Unknown;
    let text = r#"
        rate = "6 kHz"
        [channel.housing_B_ax]
        station = "B"
        direction = "-y"
        [channel.A_fy]
        station = "A"
        direction = "+theta_z"
        unit = "kN"
    "#;
    let (found, warnings) = apply(text, &records).unwrap();
    assert_eq!(warnings, ["1 channel is not in the mapping and left out: twist"]);
    assert_eq!(found.records.len(), 2);
    assert_eq!(found.records[0].response, Dof::new(30, -2));
    assert_eq!(found.records[0].sample_rate(), Ok(12000.0), "the rate given in the file is kept");
    let force = &found.records[1];
    assert_eq!((force.response, force.sample_rate()), (Dof::new(10, 6), Ok(6000.0)));
    let Values::Real(values) = &force.values else { panic!() };
    assert_eq!((values[0], force.unit.as_str()), (250e3, "N"));
}

#[test]
fn offset_sensors_and_hits_are_separate_points() {
    let frf = |name: &str, kind: Kind| {
        let values = Values::Complex(vec![Complex::new(1.0, 0.0); 4]);
        Record::new(name, kind, Axis::uniform(AxisQuantity::Frequency, 0.0, 1.0), values, "")
    };
    let records = [frf("a", Kind::Frf), frf("b", Kind::Frf), frf("coherence a", Kind::Coherence)];
    let text = r#"
        [channel.a]
        station = "B"
        offset = "0, 40, 0 mm"
        direction = "x"
        unit = "g/N"
        reference = { station = "disc", offset = "150, 0, 0 mm", direction = "y" }
        [channel.b]
        station = "A"
        direction = "x"
        unit = "g/N"
        reference = { station = "disc", offset = "150 0 0 mm", direction = "-y" }
    "#;
    let (found, _) = apply(text, &records).unwrap();
    let mounts = &found.geometry.attached_points;
    assert_eq!(mounts.len(), 2, "{mounts:?}");
    assert_eq!((mounts[0].carrier, mounts[0].offset), (30, [0.0, 0.04, 0.0]));
    assert_eq!((mounts[1].carrier, mounts[1].offset), (20, [0.15, 0.0, 0.0]));
    let [a, b, coherence] = &found.records[..] else { panic!() };
    assert_eq!((a.response, a.reference), (Dof::new(mounts[0].number, 1), Dof::new(mounts[1].number, 2)));
    assert_eq!((b.response, b.reference), (Dof::new(10, 1), Dof::new(mounts[1].number, -2)));
    // A coherence takes the DOFs of its FRF and has no unit.
    assert_eq!((coherence.response, coherence.reference), (a.response, a.reference));
    assert_eq!(coherence.unit, "");
    let wrong = r#"
        [channel.a]
        station = "B"
        offset = "40 mm"
        direction = "x"
        [channel.b]
        station = "B"
        offset = "1, 2, 3"
        direction = "x"
    "#;
    let message = apply(wrong, &records).unwrap_err();
    assert!(
        message.contains("offset = \"40 mm\" is not three lengths, such as \"150, 0, 0 mm\""),
        "{message}"
    );
    assert!(message.contains("offset: ") && message.contains("unit"), "{message}");
}

#[test]
fn frfs_are_mapped_by_points_and_rotated_to_model_axes() {
    // The file's x, y, z are the model's -z, x, -y.
    let text = r#"
        axes = ["-z", "x", "-y"]
        [point.12]
        station = "disc"
        [point.4]
        station = "A"
    "#;
    let (found, warnings) = apply(text, &frequency_records()).unwrap();
    let dofs: Vec<(Dof, Dof)> = found.records.iter().map(|r| (r.response, r.reference)).collect();
    // 12:+y from 12:-z; 12:+Rz from 4:+Rx; the coherence.
    let first = (Dof::new(20, 1), Dof::new(20, 2));
    assert_eq!(dofs, [first, (Dof::new(20, -5), Dof::new(10, -6)), first]);
    assert!(warnings[0].starts_with("3 channels are not in the mapping"), "{warnings:?}");

    let text = "[channel.\"rim/disc_y\"]\nstation = \"B\"\ndirection = \"x\"\nreference = { station = \"disc\", direction = \"-x\" }";
    let (found, _) = apply(text, &frequency_records()).unwrap();
    assert_eq!((found.records[0].response, found.records[0].reference), (Dof::new(30, 1), Dof::new(20, -1)));
}

#[test]
fn all_mapping_errors_are_reported_together() {
    let text = r#"
        rate = "12 mm"
        frequency_step = "0 Hz"
        axes = ["x", "x", "z"]
        [channel.housing_B_ay]
        station = "B"
        [channel.A_fy]
        station = "C"
        direction = "up"
        unit = "mm"
        [point.77]
        station = "A"
    "#;
    let error = apply(text, &time_records()).unwrap_err();
    for part in [
        "mapping.toml: rate: `mm` is a unit of length",
        "frequency_step = \"0 Hz\" is not positive",
        "axes = [\"x\", \"x\", \"z\"] are not x, y, z in some order",
        "there is no channel `housing_B_ay`, but `housing_B_ax`",
        "there is no record at point 77",
        "`A_fy` is in N according to its file, not in \"mm\"",
        "direction \"up\" is none of x, y, z",
        "the model has no station, bearing or body `C`",
        "correct the mapping",
    ] {
        assert!(error.contains(part), "{part} is not in\n{error}");
    }
    let mirrored = apply("axes = [\"x\", \"z\", \"y\"]", &time_records()).unwrap_err();
    assert!(mirrored.contains("are left-handed: change the sign of one"), "{mirrored}");
    let scalar = "[channel.lines]\nstation = \"A\"";
    assert!(apply(scalar, &frequency_records()).unwrap_err().contains("`lines` has no direction"));
    let unknown = mapping("[channel.a]\nplace = \"B\"").unwrap_err().to_string();
    assert!(unknown.contains("line 2") && unknown.contains("unknown field `place`"), "{unknown}");
    assert!(mapping::read(Path::new("nowhere/mapping.toml")).is_err());
}

#[test]
fn directions_are_parsed() {
    for (word, number) in [("x", 1), ("+y", 2), ("-z", -3), ("theta_x", 4), ("-theta_z", -6), ("Ry", 5)] {
        assert_eq!(direction(word), Some(number));
    }
    for word in ["", "-", "up", "xy", "é"] {
        assert_eq!(direction(word), None, "{word}");
    }
}
