//! Universal files: round trips in every variant, byte orders, malformed files of other programs.

use std::path::PathBuf;

use rotordyn::error::Error;
use rotordyn::io::budget::Limits;
use rotordyn::io::uff::{self, GeometrySets, Options};
use rotordyn::signal::Complex;
use rotordyn::signal::record::{Analysis, AxisQuantity, Kind, MeasuredData, Points, Values};

use crate::example_records::{assert_record, everything, time_records};

/// Half a unit of the last of 6 digits, over the smallest mantissa.
const SIX_DIGITS: f64 = 5e-6;
/// Half a unit of the last of 13 digits.
const THIRTEEN_DIGITS: f64 = 5e-13;
/// Half a unit of the last of 24 bits.
const F32: f64 = 6e-8;

fn read_bytes(bytes: &[u8]) -> Result<MeasuredData, Error> {
    let folder = tempfile::tempdir().unwrap();
    let path: PathBuf = folder.path().join("file.uff");
    std::fs::write(&path, bytes).unwrap();
    uff::read(&path, &Limits::default()).map(|(measured, _)| measured)
}

fn read(bytes: &[u8]) -> MeasuredData {
    read_bytes(bytes).unwrap()
}

fn message(bytes: &[u8]) -> String {
    match read_bytes(bytes) {
        Err(Error::Content { problem, advice, .. }) => format!("{problem}; {advice}"),
        other => panic!("{other:?}"),
    }
}

#[test]
fn every_variant_round_trips_to_its_precision() {
    let all = everything();
    for geometry in [GeometrySets::Classic, GeometrySets::Modern] {
        for (binary, single, precision) in [
            (false, true, SIX_DIGITS),
            (false, false, THIRTEEN_DIGITS),
            (true, true, F32),
            (true, false, 0.0),
        ] {
            let bytes = uff::to_bytes(&all, Options { binary, single, geometry }).unwrap();
            assert_eq!(bytes, uff::to_bytes(&all, Options { binary, single, geometry }).unwrap());
            let back = read(&bytes);
            assert_eq!(back.notes, Vec::<String>::new());
            assert_eq!(back.title, all.title);
            assert_eq!(back.records.len(), all.records.len());
            for (got, want) in back.records.iter().zip(&all.records) {
                assert_eq!(got.name, want.name);
                // Uniform axes are exact: the steps are inverse integers.
                let even = matches!(want.axis.points, Points::Uniform { .. });
                let axis = if even {
                    0.0
                } else if binary {
                    F32
                } else {
                    SIX_DIGITS
                };
                assert_record(got, want, precision, axis);
            }
        }
    }
}

#[test]
fn geometry_and_shapes_round_trip() {
    let all = everything();
    let write = |geometry| uff::to_bytes(&all, Options { geometry, ..Options::default() }).unwrap();
    let classic = read(&write(GeometrySets::Classic));
    assert_eq!(classic.geometry.lines, all.geometry.lines);
    assert_eq!(classic.geometry.elements, all.geometry.elements);
    let modern = read(&write(GeometrySets::Modern));
    let rods: Vec<_> = modern.geometry.elements[1..].iter().map(|e| (e.descriptor, &e.nodes[..])).collect();
    assert_eq!(rods, [(11, &[3, 12][..]), (11, &[12, 5]), (11, &[3, 7])]);
    assert_eq!(modern.geometry.elements[0], all.geometry.elements[0]);
    assert_eq!(modern.geometry.nodes, all.geometry.nodes, "17 digits are exact");
    for (got, want) in classic.geometry.nodes.iter().zip(&all.geometry.nodes) {
        assert_eq!((got.number, got.local_system), (want.number, want.local_system));
        let near =
            |k: usize| (got.position[k] - want.position[k]).abs() <= SIX_DIGITS * want.position[k].abs();
        assert!((0..3).all(near));
    }
    for back in [&classic, &modern] {
        assert_eq!(back.shapes.len(), 3);
        for (got, want) in back.shapes.iter().zip(&all.shapes) {
            assert_eq!((&got.name, got.number, got.components), (&want.name, want.number, want.components));
            assert_eq!((&got.nodes, got.complex, &got.unit), (&want.nodes, want.complex, &want.unit));
            let near = |a: Complex<f64>, b: Complex<f64>| (a - b).norm() <= SIX_DIGITS * b.norm();
            assert!(got.values.len() == want.values.len());
            assert!(got.values.iter().zip(&want.values).all(|(a, b)| near(*a, *b)));
            let (a, b) = (got.analysis.frequency_hz().unwrap(), want.analysis.frequency_hz().unwrap());
            assert!((a / b - 1.0).abs() < SIX_DIGITS);
        }
        assert_eq!(back.shapes[0].analysis, all.shapes[0].analysis);
        let Analysis::ComplexMode { eigenvalue, .. } = back.shapes[1].analysis else { panic!() };
        assert_eq!(eigenvalue, Complex::new(-2.5, 290.0));
        assert!((back.shapes[1].analysis.damping_ratio().unwrap() - 2.5 / 290.0).abs() < 1e-6);
    }
}

/// A binary file of one record, and where its data begins and ends.
fn binary_example(options: Options) -> (Vec<u8>, usize, usize) {
    let one = MeasuredData { records: time_records()[..1].to_vec(), ..MeasuredData::default() };
    let bytes = uff::to_bytes(&one, Options { binary: true, ..options }).unwrap();
    let end = bytes.len() - b"    -1\n".len();
    let size = 25 * if options.single { 4 } else { 8 };
    (bytes, end - size, end)
}

fn values(measured: &MeasuredData) -> &[f64] {
    match &measured.records[0].values {
        Values::Real(values) => values,
        Values::Complex(_) => panic!(),
    }
}

#[test]
fn binary_data_of_both_byte_orders() {
    for single in [false, true] {
        let (mut bytes, start, end) = binary_example(Options { single, ..Options::default() });
        let little = read(&bytes);
        bytes[start..end].chunks_mut(if single { 4 } else { 8 }).for_each(<[u8]>::reverse);
        let at = bytes.windows(13).position(|w| w == b"    58b     1").unwrap();
        bytes[at + 12] = b'2';
        assert_eq!(values(&read(&bytes)), values(&little));
        assert_eq!(values(&little).len(), 25);
    }
}

#[test]
fn binary_block_without_line_end_and_with_exact_byte_count() {
    let (bytes, start, end) = binary_example(Options::default());
    assert_eq!(&bytes[end..], b"    -1\n");
    assert_eq!(bytes[start - 1], b'\n');
    let header = String::from_utf8_lossy(&bytes[..start]).into_owned();
    let header: Vec<&str> = header.lines().collect();
    let first = header.iter().position(|l| l.starts_with("    58b")).unwrap();
    assert_eq!(
        header[first],
        "    58b     1     2          11         200     0     0           0           0"
    );
    assert_eq!(header.len() - first, 12);
    assert!(header[first + 1..first + 6].iter().all(|line| line.len() == 80), "ID lines");
}

#[test]
fn wrong_byte_counts_and_stray_line_ends_are_tolerated() {
    let (bytes, start, end) = binary_example(Options::default());
    let good = values(&read(&bytes)).to_vec();
    let with_count = |count: &str| {
        let mut other = bytes.clone();
        let at = other.windows(12).position(|w| w == b"         200").unwrap();
        other[at..at + 12].copy_from_slice(format!("{count:>12}").as_bytes());
        other
    };
    // pyuff states half the bytes of complex data; others state none.
    for count in ["100", "0", "400"] {
        assert_eq!(values(&read(&with_count(count))), good, "{count}");
    }
    let insert = |what: &[u8]| [&bytes[..end], what, &bytes[end..]].concat();
    for stray in [&b"\n"[..], b"\r\n", &[0; 56], b"\0\0\0\r\n"] {
        assert_eq!(values(&read(&insert(stray))), good, "{stray:?}");
    }
    // No -1 at the end of the file.
    assert_eq!(values(&read(&bytes[..end])), good);
    // A short block is reported.
    let short = [&bytes[..end - 16], &bytes[end..]].concat();
    let back = read(&short);
    assert_eq!(values(&back), &good[..23]);
    assert_eq!(back.notes, ["`housing_B_ax` has 23 values, its header states 25"]);
    // Cut off in the middle.
    let text = message(&bytes[..start + 57]);
    assert!(text.contains("the binary data is cut off: 25 values need 200 bytes, 57 are left"), "{text}");
    assert!(text.contains("copy or export it again"), "{text}");
}

#[test]
fn unsupported_binary_formats_are_rejected() {
    let (bytes, ..) = binary_example(Options::default());
    let at = bytes.windows(7).position(|w| w == b"    58b").unwrap();
    let with = |field: &str| {
        let mut other = bytes.clone();
        other[at + 7..at + 19].copy_from_slice(field.as_bytes());
        message(&other)
    };
    assert!(with("     1     1").contains("binary floats of format 1 (1 is DEC, 3 is IBM) are not read"));
    assert!(with("     3     2").contains("byte order 3"));
    assert!(with("     x     2").contains("the header of binary set 58b is"));
}

/// An ASCII file of one function: records 6 and 7, units of the ordinate, values.
fn ascii(record_7: &str, ordinate: &str, values: &str) -> String {
    format!(
        "    -1\n    58\nid\nNONE\nNONE\nNONE\nNONE\n    1         0    0         0 ch                 4   3 \
         NONE               0   0\n{record_7}\n        17    0    0    0 Time                 s\n{ordinate}\n         0    \
         0    0    0 NONE                 NONE\n         0    0    0    0 NONE                 NONE\n{values}\n    -1\n"
    )
}

const ACCELERATION: &str = "        12    0    0    0 Acceleration         m/s^2               ";

#[test]
fn short_padded_and_adjacent_values_are_read() {
    let even =
        |count: usize| format!("         2{count:>10}         1  0.00000E+00  1.00000E-03  0.00000E+00");
    let adjacent = " 1.00000E+00-2.00000E+00-3.00000E+00 4.00000E+00";
    let back = read(ascii(&even(4), ACCELERATION, adjacent).as_bytes());
    assert_eq!(values(&back), [1.0, -2.0, -3.0, 4.0]);
    assert_eq!(back.records[0].sample_rate(), Ok(1000.0));
    let padded = read(ascii(&even(3), ACCELERATION, adjacent).as_bytes());
    assert_eq!(values(&padded), [1.0, -2.0, -3.0]);
    assert_eq!(padded.notes, ["`ch` has 4 values, its header states 3"]);
    let short = read(ascii(&even(9), ACCELERATION, adjacent).as_bytes());
    assert_eq!(values(&short).len(), 4);
    assert_eq!(short.notes.len(), 1);
    // With Windows line ends and blanks behind the marks.
    let windows = ascii(&even(4), ACCELERATION, adjacent).replace('\n', "   \r\n");
    assert_eq!(values(&read(windows.as_bytes())), values(&back));
    // Cut off: no end mark.
    let whole = ascii(&even(9), ACCELERATION, adjacent);
    let cut = whole.strip_suffix("    -1\n").unwrap();
    assert!(message(cut.as_bytes()).contains("`ch` is cut off: 4 of 9 values"));
}

#[test]
fn malformed_content_errors_state_the_line() {
    let even = "         2         4         1  0.00000E+00  1.00000E-03  0.00000E+00";
    let numbers = " 1.0 2.0 3.0 4.0";
    let bad = message(ascii(even, ACCELERATION, " 1.0 2.0 x 4.0").as_bytes());
    assert_eq!(bad, "line 14: `x` is expected to be a number; the file is damaged: copy or export it again");
    let no_rate = "         2         4         1  0.00000E+00  0.00000E+00  0.00000E+00";
    let text = message(ascii(no_rate, ACCELERATION, numbers).as_bytes());
    assert!(text.contains("a step of 0; export it with its sampling rate"), "{text}");
    let kind = "         3         4         1  0.00000E+00  1.00000E-03  0.00000E+00";
    assert!(message(ascii(kind, ACCELERATION, numbers).as_bytes()).contains("none of 2, 4, 5, 6"));
    let back = "         2         2         0  0.00000E+00  0.00000E+00  0.00000E+00";
    let text = message(ascii(back, ACCELERATION, " 2.0 1.0 1.0 2.0").as_bytes());
    assert!(text.contains("the abscissae of `ch` do not increase"), "{text}");
    assert!(
        message(b"    -1\nhello\n    -1\n").contains("`hello` is expected to be the number of a data set")
    );
    assert!(message(b"    -1\n    58\nid\n").contains("data set 58 ends after 1 lines"));
    // Non-finite values are kept and reported by `not_finite`.
    let nan = read(ascii(even, ACCELERATION, " 1.0 NaN ************* 4.0").as_bytes());
    assert_eq!(nan.records[0].values.not_finite(), Some((2, 1)));
}

#[test]
fn units_are_converted_to_si_by_label_or_set_164() {
    let even = "         2         1         1  0.00000E+00  1.00000E-03  0.00000E+00";
    let record = |system: &str, ordinate: &str| {
        read((system.to_owned() + &ascii(even, ordinate, " 2.0")).as_bytes()).records.remove(0)
    };
    let label = |kind: i64, unit: &str| format!("{kind:>10}    0    0    0 {:20} {unit:20}", "label");
    let check = |record: &rotordyn::signal::record::Record, value: f64, unit: &str| {
        let Values::Real(values) = &record.values else { panic!() };
        assert!((values[0] / value - 1.0).abs() < 1e-14, "{values:?} {value}");
        assert_eq!(record.unit, unit);
    };
    check(&record("", &label(12, "g")), 2.0 * 9.80665, "m/s^2");
    check(&record("", &label(8, "mm")), 2e-3, "m");
    check(&record("", &label(12, "NONE")), 2.0, "m/s^2");
    check(&record("", &label(1, "kPa")), 2000.0, "Pa");
    // Millimetres and newtons, by the file's own divisors; the label takes precedence.
    let mm = "    -1\n   164\n         5mm (milli-newton)            2\n  1.0D+03  1.0D+03  1.0D+00\n  2.7315D+02\n    -1\n";
    check(&record(mm, &label(12, "NONE")), 2e-3, "m/s^2");
    check(&record(mm, &label(13, "NONE")), 2e-3, "N");
    check(&record(mm, &label(15, "NONE")), 2e-3 * 1e6, "Pa");
    check(&record(mm, &label(12, "m/s^2")), 2.0, "m/s^2");
    // Neither: the value is kept, and `si_unit` returns an error with a hint.
    let unknown = record("", &label(12, "EU"));
    check(&unknown, 2.0, "");
    assert_eq!(unknown.file_unit, "EU");
    let text = unknown.si_unit().unwrap_err().to_string();
    assert_eq!(text, "the unit of `ch` is unknown (the file gives \"EU\"); state it, such as \"m/s^2\"");
    let zero = "    -1\n   164\n         5mm\n  0.0D+00  1.0D+03  1.0D+00\n  2.7315D+02\n    -1\n";
    assert!(message(zero.as_bytes()).contains("set 164 are not positive"));
    assert_eq!(unknown.axis.quantity, AxisQuantity::Time);
    assert_eq!(unknown.kind, Kind::Time);
}

#[test]
fn unwritable_values_are_rejected() {
    let mut one = MeasuredData { records: time_records()[..1].to_vec(), ..MeasuredData::default() };
    one.records[0].values = Values::Real(vec![1.0, f64::NAN]);
    let text = uff::to_bytes(&one, Options::default()).unwrap_err().to_string();
    assert!(text.contains("`housing_B_ax` is NaN or infinite at value 1"), "{text}");
    one.records[0].axis.points = Points::Unknown;
    let text = uff::to_bytes(&one, Options::default()).unwrap_err().to_string();
    assert!(text.contains("does not state its sampling rate; give it"), "{text}");
}
