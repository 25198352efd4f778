//! Writes universal files in SI units.

use std::path::Path;

use super::field::{ascii, or_none, scientific, text};
use super::function::KINDS;
use super::geometry::BEAM_DESCRIPTORS;
use super::ordinate::{axis_label, data_type_of, split_ratio};
use crate::atomic_file;
use crate::error::Error;
use rotordyn_signal::Complex;
use rotordyn_signal::record::{
    Analysis, AxisQuantity, Geometry, Kind, MeasuredData, Points, Record, RecordError, Shape, Values,
};

/// Format options.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Options {
    /// Functions as 58b, little endian, instead of ASCII.
    pub binary: bool,
    /// Values of single precision: 6 digits in ASCII, 4 bytes in binary, instead of 13 digits and 8 bytes.
    pub single: bool,
    pub geometry: GeometrySets,
}

/// Data sets used for geometry and shapes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum GeometrySets {
    /// 15, 82 and 55, read by modal analysis programs; coordinates have 6 digits.
    #[default]
    Classic,
    /// 2411, 2412 and 2414, read by finite-element programs; lines become rods.
    Modern,
}

/// Writes a universal file.
///
/// # Errors
/// A record without a sampling rate or with NaN, or a file that cannot be written.
pub fn write(path: &Path, measured: &MeasuredData, options: Options) -> Result<(), Error> {
    let bytes = to_bytes(measured, options)?;
    atomic_file::write(path, &bytes).map_err(Error::of_file("write", path))
}

/// The bytes of a universal file; the same input gives the same bytes, dates are those of the records.
///
/// # Errors
/// A record without a sampling rate or with NaN.
pub fn to_bytes(measured: &MeasuredData, options: Options) -> Result<Vec<u8>, RecordError> {
    let mut out = Writer { bytes: Vec::new() };
    out.header(&measured.title);
    out.units();
    out.geometry(&measured.geometry, options.geometry);
    for shape in &measured.shapes {
        match options.geometry {
            GeometrySets::Classic => out.shape_55(shape),
            GeometrySets::Modern => out.shape_2414(shape),
        }
    }
    for record in &measured.records {
        out.function(record, options)?;
    }
    Ok(out.bytes)
}

struct Writer {
    bytes: Vec<u8>,
}

impl Writer {
    fn line(&mut self, content: &str) {
        self.bytes.extend(content.as_bytes());
        self.bytes.push(b'\n');
    }

    fn begin(&mut self, set: u32) {
        self.line("    -1");
        self.line(&format!("{:<80}", format!("{set:>6}")));
    }

    fn end(&mut self) {
        self.line("    -1");
    }

    /// Numbers, `per_line` on each line.
    fn numbers(&mut self, values: &[f64], per_line: usize, width: usize, digits: usize) {
        for row in values.chunks(per_line) {
            let row: String = row.iter().map(|&v| scientific(v, width, digits)).collect();
            self.line(&row);
        }
    }

    fn integers(&mut self, values: &[i64]) {
        for row in values.chunks(8) {
            self.line(&row.iter().map(|v| format!("{v:>10}")).collect::<String>());
        }
    }

    fn header(&mut self, title: &str) {
        self.begin(151);
        self.line(&text(or_none(title), 80));
        self.line(&text("NONE", 80));
        self.line(&text("rotordyn", 80));
        self.line(&format!("{:20}{:>10}{:>10}{:>10}", "", 0, 0, 0));
        self.line(&text("", 80));
        self.line(&text("rotordyn", 80));
        self.line(&text("", 80));
        self.end();
    }

    fn units(&mut self) {
        self.begin(164);
        self.line(&format!("{:>10}{:<20}{:>10}", 1, "SI: Meter (newton)", 2));
        let fortran = |v: f64| scientific(v, 25, 17).replace('E', "D");
        self.line(&[1.0, 1.0, 1.0].map(fortran).concat());
        self.line(&fortran(273.15));
        self.end();
    }

    fn geometry(&mut self, geometry: &Geometry, which: GeometrySets) {
        let modern = which == GeometrySets::Modern;
        if !geometry.nodes.is_empty() {
            self.begin(if modern { 2411 } else { 15 });
            for node in &geometry.nodes {
                let head = format!("{:>10}{:>10}{:>10}{:>10}", node.number, 0, node.local_system, 8);
                let places = |width, digits| node.position.map(|v| scientific(v, width, digits)).concat();
                if modern {
                    self.line(&head);
                    self.line(&places(25, 16));
                } else {
                    self.line(&(head + &places(13, 5)));
                }
            }
            self.end();
        }
        if !modern {
            for (k, line) in geometry.lines.iter().enumerate() {
                let nodes = line.strokes.join(&0);
                self.begin(82);
                self.line(&format!("{:>10}{:>10}{:>10}", k + 1, nodes.len(), 8));
                self.line(&text(or_none(&line.name), 80));
                self.integers(&nodes);
                self.end();
            }
        }
        let strokes = geometry.lines.iter().flat_map(|line| &line.strokes).filter(|_| modern);
        let last = geometry.elements.iter().map(|e| e.number).max().unwrap_or(0);
        let rods =
            strokes.flat_map(|s| s.windows(2)).zip(last + 1..).map(|(ends, number)| (number, 11, ends));
        let elements = geometry.elements.iter().map(|e| (e.number, e.descriptor, e.nodes.as_slice()));
        let all: Vec<_> = elements.chain(rods).collect();
        if all.is_empty() {
            return;
        }
        self.begin(2412);
        for (number, descriptor, nodes) in all {
            self.integers(&[number, descriptor, 1, 1, 8, nodes.len() as i64]);
            if BEAM_DESCRIPTORS.contains(&descriptor) {
                self.integers(&[0, 1, 1]);
            }
            self.integers(nodes);
        }
        self.end();
    }

    fn shape_55(&mut self, shape: &Shape) {
        self.begin(55);
        self.line(&text(or_none(&shape.name), 80));
        (0..4).for_each(|_| self.line(&text("NONE", 80)));
        let (analysis, real) = analysis_55(&shape.analysis);
        self.integers(&shape_record(shape, analysis));
        self.integers(&[2, real.len() as i64, 1, shape.number]);
        self.numbers(&real, 6, 13, 5);
        self.node_values(shape);
        self.end();
    }

    fn shape_2414(&mut self, shape: &Shape) {
        self.begin(2414);
        self.integers(&[1]);
        self.line(&text(or_none(&shape.name), 80));
        self.integers(&[1]);
        (0..5).for_each(|_| self.line(&text("NONE", 80)));
        let (analysis, _) = analysis_55(&shape.analysis);
        self.integers(&shape_record(shape, analysis));
        let response = analysis == 5;
        let (mode, frequency) = if response { (0, shape.number) } else { (shape.number, 0) };
        self.integers(&[1, 0, 1, 0, 1, mode, 0, frequency]);
        self.integers(&[0, 0]);
        let mut real = [0.0; 12];
        match shape.analysis {
            Analysis::NormalMode { frequency_hz, damping_ratio, hysteretic, modal_mass } => {
                real[1] = frequency_hz;
                real[3..6].copy_from_slice(&[modal_mass, damping_ratio, hysteretic]);
            }
            Analysis::ComplexMode { eigenvalue: l, modal_a: a, modal_b: b } => {
                real[1] = l.norm() / std::f64::consts::TAU;
                real[6..].copy_from_slice(&[l.re, l.im, a.re, a.im, b.re, b.im]);
            }
            Analysis::Transient { time } => real[0] = time,
            Analysis::FrequencyResponse { frequency_hz } => real[1] = frequency_hz,
            Analysis::Static | Analysis::Unknown => {}
        }
        self.numbers(&real, 6, 13, 5);
        self.node_values(shape);
        self.end();
    }

    fn node_values(&mut self, shape: &Shape) {
        for (node, values) in shape.nodes.iter().zip(shape.values.chunks(shape.components.max(1))) {
            self.integers(&[*node]);
            let parts = |v: &Complex<f64>| if shape.complex { vec![v.re, v.im] } else { vec![v.re] };
            let row: Vec<f64> = values.iter().flat_map(parts).collect();
            self.numbers(&row, 6, 13, 5);
        }
    }

    fn function(&mut self, record: &Record, options: Options) -> Result<(), RecordError> {
        let complex = matches!(record.values, Values::Complex(_));
        let (start, step, listed) = match &record.axis.points {
            Points::Uniform { start, step } => (*start, *step, None),
            Points::NonUniform(points) => (0.0, 0.0, Some(points)),
            Points::Unknown => return Err(RecordError::NoRate { channel: record.name.clone() }),
        };
        if let Some((_, index)) = record.values.not_finite() {
            return Err(RecordError::NotFinite { channel: record.name.clone(), index });
        }
        let form = match (complex, options.single) {
            (false, true) => 2,
            (false, false) => 4,
            (true, true) => 5,
            (true, false) => 6,
        };
        let size = if options.single { 4 } else { 8 };
        let count = record.values.len();
        // The abscissa is always of single precision.
        let value_bytes = size * (1 + usize::from(complex));
        let bytes = count * (value_bytes + if listed.is_some() { 4 } else { 0 });
        self.line("    -1");
        if options.binary {
            let fields = format!("{:>6}{:>6}{:>12}{bytes:>12}{:>6}{:>6}{:>12}{:>12}", 1, 2, 11, 0, 0, 0, 0);
            self.line(&format!("    58b{fields}"));
        } else {
            self.line(&format!("{:<80}", "    58"));
        }
        for line in [&record.name, "", &record.date, "", ""] {
            self.line(&text(or_none(line), 80));
        }
        let kind = KINDS.iter().find(|k| k.1 == record.kind).map_or(0, |k| k.0);
        let entity: String = ascii(&record.name).chars().take(10).collect();
        let end = |name: &str, node: i64, way: i8| format!(" {:<10}{node:>10}{way:>4}", or_none(name));
        let (at, from) = (record.response, record.reference);
        self.line(&format!(
            "{kind:>5}{:>10}{:>5}{:>10}{}{}",
            0,
            0,
            0,
            end(&entity, at.node, at.direction),
            end("NONE", from.node, from.direction)
        ));
        let z = record.speed_rpm;
        let limits = [start, step, z.unwrap_or(0.0)].map(|v| scientific(v, 13, 5)).concat();
        let even = i32::from(listed.is_none());
        self.line(&format!("{form:>10}{count:>10}{even:>10}{limits}"));
        for line in characteristics(record) {
            self.line(&line);
        }
        let values = Rows { record, listed };
        match options.binary {
            true => values.write_binary(options.single, &mut self.bytes),
            false => values.write_ascii(options.single, self),
        }
        self.end();
        Ok(())
    }
}

/// Records 8 to 11: abscissa, ordinate, its denominator, z axis.
fn characteristics(record: &Record) -> [String; 4] {
    let line = |kind: i64, label: &str, unit: &str| {
        let field = |content: &str| text(&ascii(or_none(content)), 20);
        format!("{kind:>10}{:>5}{:>5}{:>5} {} {}", 0, 0, 0, field(label), field(unit))
    };
    let quantity = record.axis.quantity;
    let abscissa = match quantity {
        AxisQuantity::Time => 17,
        AxisQuantity::Frequency => 18,
        AxisQuantity::Speed => 19,
        AxisQuantity::Order => 20,
        AxisQuantity::Unknown => 0,
    };
    // An unknown unit is written as stated by its source file.
    let unit = if record.unit.is_empty() { &record.file_unit } else { &record.unit };
    let unit = if unit == "1" { "" } else { unit.as_str() };
    let (over, under) = match record.kind {
        Kind::Frf | Kind::Transmissibility => split_ratio(unit),
        _ => (unit, ""),
    };
    let (over_kind, under_kind) = (data_type_of(over), data_type_of(under));
    let z = if record.speed_rpm.is_some() { (19, "RPM", "rpm") } else { (0, "", "") };
    [
        line(abscissa, axis_label(abscissa), quantity.unit()),
        line(over_kind, axis_label(over_kind), over),
        line(under_kind, axis_label(under_kind), under),
        line(z.0, z.1, z.2),
    ]
}

/// Analysis type and real parameters of set 55.
fn analysis_55(analysis: &Analysis) -> (i64, Vec<f64>) {
    match *analysis {
        Analysis::Unknown => (0, vec![0.0]),
        Analysis::Static => (1, vec![0.0]),
        Analysis::NormalMode { frequency_hz, damping_ratio, hysteretic, modal_mass } => {
            (2, vec![frequency_hz, modal_mass, damping_ratio, hysteretic])
        }
        Analysis::ComplexMode { eigenvalue: l, modal_a: a, modal_b: b } => {
            (3, vec![l.re, l.im, a.re, a.im, b.re, b.im])
        }
        Analysis::Transient { time } => (4, vec![time]),
        Analysis::FrequencyResponse { frequency_hz } => (5, vec![frequency_hz]),
    }
}

/// Record 6 of set 55, record 9 of set 2414.
fn shape_record(shape: &Shape, analysis: i64) -> [i64; 6] {
    let characteristic = match shape.components {
        1 => 1,
        3 => 2,
        6 => 3,
        _ => 0,
    };
    let quantity = match shape.unit.as_str() {
        "N" => 9,
        unit => data_type_of(unit),
    };
    [1, analysis, characteristic, quantity, if shape.complex { 5 } else { 2 }, shape.components as i64]
}

/// The values of a record with their abscissae, if they are listed.
struct Rows<'a> {
    record: &'a Record,
    listed: Option<&'a Vec<f64>>,
}

impl Rows<'_> {
    /// Calls `each` with abscissa and parts of every value.
    fn for_each(&self, mut each: impl FnMut(Option<f64>, &[f64])) {
        let x = |k: usize| self.listed.and_then(|points| points.get(k)).copied();
        match &self.record.values {
            Values::Real(values) => values.iter().enumerate().for_each(|(k, v)| each(x(k), &[*v])),
            Values::Complex(values) => {
                values.iter().enumerate().for_each(|(k, v)| each(x(k), &[v.re, v.im]));
            }
        }
    }

    fn write_binary(&self, single: bool, out: &mut Vec<u8>) {
        self.for_each(|x, parts| {
            out.extend(x.into_iter().flat_map(|x| (x as f32).to_le_bytes()));
            for v in parts {
                match single {
                    true => out.extend((*v as f32).to_le_bytes()),
                    false => out.extend(v.to_le_bytes()),
                }
            }
        });
    }

    /// `6E13.5`, `4E20.12`, `2(E13.5,E20.12)` or `E13.5,2E20.12`.
    fn write_ascii(&self, single: bool, out: &mut Writer) {
        let (width, digits) = if single { (13, 5) } else { (20, 12) };
        let complex = matches!(self.record.values, Values::Complex(_));
        let fields_per_row = usize::from(self.listed.is_some()) + 1 + usize::from(complex);
        let per_line = match (single, self.listed.is_some(), complex) {
            (true, _, _) => 6 / fields_per_row,
            (false, false, _) => 4 / fields_per_row,
            (false, true, false) => 2,
            (false, true, true) => 1,
        };
        let (mut line, mut rows) = (String::new(), 0);
        self.for_each(|x, parts| {
            line.extend(x.map(|x| scientific(x, 13, 5)));
            line.extend(parts.iter().map(|&v| scientific(v, width, digits)));
            rows += 1;
            if rows == per_line {
                out.line(&line);
                line.clear();
                rows = 0;
            }
        });
        if rows > 0 {
            out.line(&line);
        }
    }
}
