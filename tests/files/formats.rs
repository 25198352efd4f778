//! Round trips round_trip every format, and format detection.

use std::path::Path;

use rotordyn::error::Error;
use rotordyn::io::measured::{self, Format};
use rotordyn::io::{csv, uff, wav};
use rotordyn::signal::record::{Kind, MeasuredData, Record, Values};

use crate::example_records::{assert_record, everything, frequency_records, time_records};

fn measured_of(records: Vec<Record>) -> MeasuredData {
    MeasuredData { records, ..MeasuredData::default() }
}

fn round_trip(measured: &MeasuredData, file: &str) -> MeasuredData {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join(file);
    measured::write(&path, measured).unwrap();
    let first = std::fs::read(&path).unwrap();
    measured::write(&path, measured).unwrap();
    assert!(first == std::fs::read(&path).unwrap(), "{file}: the same input must give the same bytes");
    measured::read(&path).unwrap()
}

/// Compares in the order of the records or, with `names`, sorted by name (HDF5 sorts by name).
fn assert_same(got: &MeasuredData, want: &MeasuredData, relative: f64, names: bool) {
    assert_eq!(got.records.len(), want.records.len());
    let (mut got, mut want) = (got.clone(), want.clone());
    if names {
        got.records.sort_by(|a, b| a.name.cmp(&b.name));
        want.records.sort_by(|a, b| a.name.cmp(&b.name));
    }
    for (got, want) in got.records.iter().zip(&want.records) {
        assert!(!names || got.name == want.name, "{} {}", got.name, want.name);
        assert_record(got, want, relative, 0.0);
    }
}

#[test]
fn array_formats_round_trip_exactly() {
    let mut all = everything();
    all.scalars = vec![("X105RPM".into(), 1797.0), ("load_hp".into(), 0.0)];
    for file in ["all.mat", "all.npz", "all.h5"] {
        let back = round_trip(&all, file);
        assert_same(&back, &all, 0.0, true);
        assert_eq!(back.title, all.title);
        let mut scalars = back.scalars.clone();
        scalars.sort_by(|a, b| a.0.cmp(&b.0));
        assert_eq!(scalars, [("X105RPM".to_string(), 1797.0), ("load_hp".to_string(), 0.0)]);
        assert_eq!(back.notes, Vec::<String>::new(), "{file}");
        // As many time samples as spectral lines.
        let mut mixed =
            measured_of([time_records()[..1].to_vec(), frequency_records()[..1].to_vec()].concat());
        mixed.records[0].values = Values::Real((0..17).map(f64::from).collect());
        assert_same(&round_trip(&mixed, file), &mixed, 0.0, true);
        // A common axis is stored once; coherence is assigned to its FRF.
        let matrix = round_trip(&measured_of(frequency_records()[..1].to_vec()), file).frf_matrix().unwrap();
        assert_eq!((matrix.frequencies.len(), matrix.frequencies[16]), (17, 2.0));
    }
}

#[test]
fn names_not_allowed_by_a_format_round_trip() {
    let mut long = time_records()[0].clone();
    long.name = "2 Gehäuse B, a_x (links) ".repeat(5).trim_end().into();
    let mut second = long.clone();
    second.name += "2";
    for file in ["a.mat", "a.npz", "a.h5"] {
        let both = measured_of(vec![long.clone(), second.clone()]);
        assert_same(&round_trip(&both, file), &both, 0.0, true);
    }
}

#[test]
fn csv_round_trip_is_exact() {
    let mut time = measured_of(time_records());
    time.records.iter_mut().for_each(|r| {
        r.speed_rpm = None;
        (r.response, r.reference) = Default::default();
    });
    assert_same(&round_trip(&time, "a.csv"), &time, 0.0, true);
    let mut lines = measured_of(frequency_records()[..4].to_vec());
    lines.records.iter_mut().for_each(|r| (r.response, r.reference) = Default::default());
    let back = round_trip(&lines, "a.csv");
    // A slash is not allowed in a column name.
    let names: Vec<&str> = back.records.iter().map(|r| r.name.as_str()).collect();
    assert_eq!(names, ["rim_disc_y", "rim_disc_twist", "coherence", "density"]);
    // Tables do not store the kind of a record: the density is read as a spectrum.
    lines.records[3].kind = Kind::Spectrum;
    assert_same(&back, &lines, 0.0, false);
    let folder = tempfile::tempdir().unwrap();
    let mixed: Vec<Record> = [time_records(), frequency_records()].concat();
    let all: Vec<&Record> = mixed.iter().collect();
    let error = csv::write_records(&folder.path().join("a.csv"), &all).unwrap_err().to_string();
    assert!(
        error.contains("the axes of `housing_B_ax` and `rim/disc_y` differ: 25 points from 0.25 s"),
        "{error}"
    );
}

#[test]
fn wav_round_trip_within_sample_precision() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("run.wav");
    let records = time_records();
    let channels: Vec<&Record> = records.iter().collect();
    for (samples, step) in [
        (wav::SampleFormat::Float, None),
        (wav::SampleFormat::Pcm { bits: 16, full_scale: 256.0 }, Some(256.0 / 32768.0)),
        (wav::SampleFormat::Pcm { bits: 24, full_scale: 256.0 }, Some(256.0 / 8_388_608.0)),
        (wav::SampleFormat::Pcm { bits: 32, full_scale: 256.0 }, Some(256.0 / 2_147_483_648.0)),
    ] {
        wav::write(&path, &channels, samples).unwrap();
        let back = measured::read(&path).unwrap();
        assert_eq!(back.records.len(), 3);
        assert_eq!((back.records[1].name.as_str(), back.records[1].sample_rate()), ("run_2", Ok(12000.0)));
        assert!(back.records[1].si_unit().is_err());
        let scale = if step.is_some() { 256.0 } else { 1.0 };
        for (got, want) in back.records.iter().zip(&records) {
            for (a, b) in got.time_samples().unwrap().iter().zip(want.time_samples().unwrap()) {
                let tolerance = step.map_or(6e-8 * b.abs(), |step| 0.5 * step * (1.0 + 1e-12));
                assert!((scale * a - b).abs() <= tolerance, "{a} {b}");
            }
        }
    }
    let too_loud = wav::write(&path, &channels, wav::SampleFormat::Pcm { bits: 16, full_scale: 100.0 });
    let text = too_loud.unwrap_err().to_string();
    assert!(
        text.contains("`A_fy` reaches 250 at sample 0, full scale is 100; choose a larger full scale"),
        "{text}"
    );
    // One channel is named after the file.
    wav::write(&path, &channels[..1], wav::SampleFormat::Float).unwrap();
    assert_eq!(measured::read(&path).unwrap().records[0].name, "run");
    let mut odd = records[0].clone();
    odd.axis = rotordyn::signal::record::Axis::uniform(odd.axis.quantity, 0.0, 0.003);
    let text = wav::write(&path, &[&odd], wav::SampleFormat::Float).unwrap_err().to_string();
    assert!(text.contains("a WAV file needs an integer sampling rate in Hz, not 333.3"), "{text}");
}

#[test]
fn universal_file_is_detected_by_content() {
    let all = everything();
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("measured.dat");
    uff::write(&path, &all, uff::Options { binary: true, ..uff::Options::default() }).unwrap();
    let back = measured::read(&path).unwrap();
    assert_eq!(back.records.len(), 9);
    assert_eq!((back.shapes.len(), back.geometry.nodes.len(), back.title), (3, 4, all.title));
}

#[test]
fn run_results_are_read_as_records() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("results.h5");
    crate::hdf5_h5py::write_example(&path);
    let back = measured::read(&path).unwrap();
    let names: Vec<&str> = back.records.iter().map(|r| r.name.as_str()).collect();
    assert_eq!(names, ["B ay", "theta", "speed"]);
    let channel = &back.records[0];
    assert_eq!(
        (channel.unit.as_str(), channel.sample_rate(), channel.response.direction),
        ("m/s^2", Ok(1000.0), 2)
    );
    assert_eq!(channel.axis.points(2).unwrap(), [0.25, 0.251]);
    assert_eq!(channel.time_samples().unwrap()[4999], 4999.0);
}

#[test]
fn formats_are_detected_by_content() {
    let detect = |head: &[u8]| Format::of_content(head);
    assert_eq!(detect(b"\x89HDF\r\n\x1a\n\0\0"), Some(Format::Hdf5));
    let mut matlab_73 = vec![b' '; 512];
    matlab_73.extend(b"\x89HDF\r\n\x1a\n");
    assert_eq!(detect(&matlab_73), Some(Format::Hdf5));
    assert_eq!(detect(b"\n    -1\r\n   151\n"), Some(Format::Universal));
    assert_eq!(detect(b"time_s,ax\n-1,2\n"), Some(Format::Table));
    assert_eq!(detect(b"\x93NUMPY\x01\0"), Some(Format::Numpy));
    assert_eq!(detect(b"PK\x03\x04"), Some(Format::Numpy));
    assert_eq!(detect(b"RIFF\0\0\0\0WAVEfmt "), Some(Format::Wav));
    assert_eq!(detect(b"%PDF-1.4\n\x01\x02"), None);
    assert_eq!(Format::of_extension(Path::new("A.UNV")), Some(Format::Universal));
    assert_eq!(Format::of_extension(Path::new("a.xlsx")), None);
}

#[test]
fn unknown_extension_is_rejected_on_writing() {
    let error = measured::write(Path::new("a.xlsx"), &everything()).unwrap_err();
    assert!(matches!(error, Error::Content { .. }));
    assert!(error.to_string().ends_with("use .uff, .unv, .mat, .npz, .wav, .csv or .h5"), "{error}");
    // A universal file cannot store non-finite values.
    let mut one = time_records()[0].clone();
    one.values = Values::Real(vec![f64::INFINITY]);
    let folder = tempfile::tempdir().unwrap();
    let error = measured::write(&folder.path().join("a.uff"), &measured_of(vec![one])).unwrap_err();
    assert!(error.to_string().contains("is NaN or infinite at value 0"), "{error}");
}
