//! Universal files of other programs (from pyuff's test data).

use rotordyn::io::budget::Limits;
use rotordyn::io::uff;
use rotordyn::signal::record::{Analysis, AxisQuantity, Kind, MeasuredData, Values};

use crate::measured_data::measured;

fn read(file: &str) -> Option<MeasuredData> {
    measured(&format!("uff/{file}")).map(|path| uff::read(&path, &Limits::default()).unwrap().0)
}

#[test]
fn ascii_and_binary_microphone_records_agree() {
    let (Some(ascii), Some(binary)) = (read("Sample_UFF58_ascii.uff"), read("Sample_UFF58b_bin.uff")) else {
        return;
    };
    let (a, b) = (&ascii.records[0], &binary.records[0]);
    for record in [a, b] {
        assert_eq!((record.name.as_str(), record.kind, record.unit.as_str()), ("Mic 01", Kind::Time, "Pa"));
        assert_eq!(record.values.len(), 79292);
        // The header's step is 1.52588E-05, six digits of 1/65536 s.
        assert_eq!(record.sample_rate(), Ok(65536.0));
        assert_eq!(record.date, "18-Apr-16 13:49:58");
    }
    let largest = a
        .time_samples()
        .unwrap()
        .iter()
        .zip(b.time_samples().unwrap())
        .map(|(a, b)| (a - b).abs())
        .fold(0.0, f64::max);
    assert!(largest > 0.0 && largest <= 5e-7, "{largest:e}");
    assert!(ascii.notes.is_empty() && binary.notes.is_empty());
}

#[test]
fn psd_with_latin1_characters_in_its_unit() {
    let Some(file) = read("sample_dataset58_psd.uff") else { return };
    let record = &file.records[0];
    assert_eq!((record.name.as_str(), record.kind), ("Pilot 1", Kind::Psd));
    assert_eq!((record.file_unit.as_str(), record.unit.as_str()), ("g²/Hz", "(m/s^2)^2/Hz"));
    assert_eq!(record.axis.quantity, AxisQuantity::Frequency);
    let frequencies = record.axis.points(3201).unwrap();
    assert_eq!((frequencies[1], frequencies[3200]), (1.0, 3200.0));
    // Stored as complex numbers without imaginary parts.
    let Values::Complex(values) = &record.values else { panic!() };
    assert!((values[1].re / (1.255863e-6 * 9.80665 * 9.80665) - 1.0).abs() < 1e-12);
    assert!(values.iter().all(|v| v.im == 0.0));
    assert_eq!(values.len(), 3201);
}

#[test]
fn geometry_of_testlab() {
    let Some(file) = read("TestLab_161_164_18_15_82.uff") else { return };
    assert_eq!(file.title, "AME_Test");
    assert_eq!(file.geometry.nodes.len(), 36);
    assert_eq!(file.geometry.nodes[8].position, [-1.55, 0.0, 1.4]);
    let lines = &file.geometry.lines;
    let names: Vec<&str> = lines.iter().map(|l| l.name.as_str()).collect();
    assert_eq!(names, ["Massif", "Stator", "Dalle"]);
    assert_eq!(lines[0].strokes, [vec![2, 5, 6, 3, 4, 1, 2, 3]]);
    assert_eq!(lines[1].strokes.len(), 8);
    assert_eq!(lines[2].strokes, [vec![34, 33, 36, 35, 32, 31, 34], vec![33, 32]]);
    assert_eq!(file.notes, ["directions at 36 nodes are in local coordinate systems, which are not applied"]);
    assert_eq!(file.left_out, ["data sets 18"]);
}

#[test]
fn finite_element_model_in_millimetres() {
    let Some(file) = read("heat_engine_housing.uff") else { return };
    assert_eq!(file.geometry.nodes.len(), 10);
    assert!((file.geometry.nodes[0].position[0] + 0.171_175_567_626_953_1).abs() < 1e-16);
    let elements = &file.geometry.elements;
    assert_eq!(elements.len(), 8);
    assert_eq!((elements[4].descriptor, &elements[4].nodes[..]), (91, &[1, 2, 4][..]));
    let shape = &file.shapes[0];
    assert_eq!((shape.name.as_str(), shape.analysis, shape.components), ("Temperature", Analysis::Static, 1));
    assert_eq!((shape.nodes.len(), shape.values[6].re), (10, 24.9976));
    assert_eq!(file.notes, ["converted to SI by set 164: lengths divided by 1000, forces by 1000"]);
}

#[test]
fn mode_shapes_with_adjacent_numbers() {
    let Some(file) = read("uff55_sample_record10.uff") else { return };
    let shape = &file.shapes[0];
    assert_eq!((shape.nodes.as_slice(), shape.components, shape.complex), (&[111_111, 60_101][..], 3, true));
    let Analysis::ComplexMode { eigenvalue, modal_b, .. } = shape.analysis else { panic!() };
    assert_eq!((eigenvalue.re, eigenvalue.im, modal_b.im), (-0.1111111, 41.11111, -211_111.0));
    assert_eq!(
        (shape.values[2].im, shape.values[5].re, shape.values[5].im),
        (4.111111e-3, -4.111111e-2, -1.111111e-2)
    );
    assert_eq!(shape.values.len(), 6);

    let Some(file) = read("uff55_translation_rotation.uff") else { return };
    let shape = &file.shapes[0];
    assert_eq!((shape.components, shape.complex, shape.unit.as_str()), (6, false, "m"));
    assert!((shape.analysis.frequency_hz().unwrap() - 97.013).abs() < 1e-12);
    assert_eq!(shape.values[0].re, 5.3569e-2);
    assert_eq!(shape.values.len(), 6 * shape.nodes.len());
}
