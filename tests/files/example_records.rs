//! One record of every kind, with geometry and shapes, for round trips through files.

use rotordyn::signal::Complex;
use rotordyn::signal::record::{
    Analysis, Axis, AxisQuantity, Dof, Element, Geometry, Kind, MeasuredData, Node, Polyline, Record, Shape,
    Values,
};

fn real(count: usize, f: impl Fn(f64) -> f64) -> Values {
    Values::Real((0..count).map(|k| f(k as f64)).collect())
}

fn complex(count: usize, f: impl Fn(f64) -> Complex<f64>) -> Values {
    Values::Complex((0..count).map(|k| f(k as f64)).collect())
}

/// Channels of a run on two bearings: uniform time axis, names longer than the ten characters of a universal
/// file.
pub fn time_records() -> Vec<Record> {
    let axis = Axis::uniform(AxisQuantity::Time, 0.25, 1.0 / 12000.0);
    let record = |name: &str, node, direction, unit, values| Record {
        response: Dof::new(node, direction),
        speed_rpm: Some(1797.0),
        ..Record::new(name, Kind::Time, axis.clone(), values, unit)
    };
    vec![
        record("housing_B_ax", 7, 1, "m/s^2", real(25, |k| 9.81 * (0.7 * k).sin() + 1e-3 * k)),
        record("A_fy", 3, -2, "N", real(25, |k| 250.0 - k / 3.0)),
        record("twist", 5, 6, "rad", real(25, |k| -1e-7 * k * k)),
    ]
}

/// FRFs, their coherence, a spectral density, spectra on a non-uniform axis.
pub fn frequency_records() -> Vec<Record> {
    let axis = Axis::uniform(AxisQuantity::Frequency, 0.0, 0.125);
    let uneven: Vec<f64> = (0..9).map(|k| 1.0 + 0.5 * f64::from(k * k)).collect();
    let uneven = Axis::from_points(AxisQuantity::Frequency, uneven);
    let at = |record: Record, node, direction, reference| Record {
        response: Dof::new(node, direction),
        reference,
        ..record
    };
    let pole = |k: f64| Complex::new(1.0, 0.0) / Complex::new(4.0 - k * k, 0.3 * k);
    let force = Dof::new(12, -3);
    let frf = |name: &str, unit: &str| Record::new(name, Kind::Frf, axis.clone(), complex(17, pole), unit);
    vec![
        at(frf("rim/disc_y", "(m/s^2)/N"), 12, 2, force),
        at(frf("rim/disc_twist", "rad/(N m)"), 12, 6, Dof::new(4, 4)),
        at(
            Record::new("coherence", Kind::Coherence, axis.clone(), real(17, |k| 1.0 - 1e-4 * k), "1"),
            12,
            2,
            force,
        ),
        Record::new("density", Kind::Psd, axis, real(17, |k| 1e-6 * (k + 1.0)), "(m/s^2)^2/Hz"),
        Record::new("lines", Kind::Spectrum, uneven.clone(), real(9, |k| k.exp()), "m/s"),
        Record::new("phasors", Kind::Spectrum, uneven, complex(9, |k| pole(k) * 1e3), "m"),
    ]
}

pub fn geometry() -> Geometry {
    let node = |number, x, y, z| Node { number, position: [x, y, z], local_system: 0 };
    Geometry {
        nodes: vec![
            node(3, 0.0, 0.0, 0.12),
            node(7, 0.0, -0.05, 0.12),
            node(12, 0.1, 1.0 / 3.0, 0.56),
            node(5, 0.0, 0.0, 0.625),
        ],
        lines: vec![Polyline { name: "shaft".into(), strokes: vec![vec![3, 12, 5], vec![3, 7]] }],
        elements: vec![Element { number: 9, descriptor: 91, nodes: vec![3, 7, 12] }],
        ..Geometry::default()
    }
}

pub fn shapes() -> Vec<Shape> {
    let values = |count: usize, im: f64| {
        (0..count).map(|k| Complex::new(0.1 * k as f64 - 0.3, im * (1.0 - k as f64))).collect()
    };
    vec![
        Shape {
            name: "1st bending".into(),
            analysis: Analysis::NormalMode {
                frequency_hz: 46.25,
                damping_ratio: 0.01,
                hysteretic: 0.0,
                modal_mass: 2.5,
            },
            number: 1,
            components: 3,
            nodes: vec![3, 12, 5],
            values: values(9, 0.0),
            complex: false,
            unit: "m".into(),
        },
        Shape {
            name: "backward whirl".into(),
            analysis: Analysis::ComplexMode {
                eigenvalue: Complex::new(-2.5, 290.0),
                modal_a: Complex::new(0.0, 580.0),
                modal_b: Complex::new(-168200.0, 1450.0),
            },
            number: 2,
            components: 6,
            nodes: vec![3, 12],
            values: values(12, 0.25),
            complex: true,
            unit: "m".into(),
        },
        Shape {
            name: "operating deflection".into(),
            analysis: Analysis::FrequencyResponse { frequency_hz: 20.0 },
            number: 4,
            components: 3,
            nodes: vec![3, 5],
            values: values(6, -0.5),
            complex: true,
            unit: "m/s^2".into(),
        },
    ]
}

/// All records, geometry and shapes.
pub fn everything() -> MeasuredData {
    MeasuredData {
        title: "overhung rig".into(),
        records: [time_records(), frequency_records()].concat(),
        scalars: Vec::new(),
        axis_sources: Vec::new(),
        geometry: geometry(),
        shapes: shapes(),
        notes: Vec::new(),
        left_out: Vec::new(),
    }
}

fn pairs(values: &Values) -> Vec<[f64; 2]> {
    match values {
        Values::Real(v) => v.iter().map(|v| [*v, 0.0]).collect(),
        Values::Complex(v) => v.iter().map(|v| [v.re, v.im]).collect(),
    }
}

/// Asserts that a record survives a round trip: metadata equal, numbers within the tolerance `relative`.
pub fn assert_record(got: &Record, want: &Record, relative: f64, axis_relative: f64) {
    let metadata =
        |r: &Record| (r.kind, r.axis.quantity, r.unit.clone(), r.response, r.reference, r.speed_rpm);
    assert_eq!(metadata(got), metadata(want), "{}", want.name);
    let count = want.values.len();
    assert_eq!(got.values.len(), count, "{}", want.name);
    let (a, b) = (got.axis.points(count).unwrap(), want.axis.points(count).unwrap());
    for (a, b) in a.iter().zip(&b) {
        assert!((a - b).abs() <= axis_relative * b.abs(), "axis of {}: {a} {b}", want.name);
    }
    assert_eq!(std::mem::discriminant(&got.values), std::mem::discriminant(&want.values), "{}", want.name);
    for (a, b) in pairs(&got.values).iter().zip(pairs(&want.values)) {
        for (a, b) in a.iter().zip(b) {
            assert!((a - b).abs() <= relative * b.abs(), "{}: {a} {b}", want.name);
        }
    }
}
