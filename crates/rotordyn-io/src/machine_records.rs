//! Machine, runs, FRFs and modes as records, geometry and shapes for measurement programs.
//!
//! Node k of the machine is point k + 1: shaft nodes first, then bodies. Directions x y z are 1 2 3,
//! rotations about them 4 5 6.

use std::f64::consts::TAU;

use crate::error::Error;
use crate::measured::mapping::direction;
use rotordyn_core::element::Anchor;
use rotordyn_core::model::Model;
use rotordyn_core::results::{FrfResult, History, ModalResult};
use rotordyn_core::series::SeriesError;
use rotordyn_core::study::Machine;
use rotordyn_signal::record::{
    Analysis, Axis, AxisQuantity, Dof, Geometry, Kind, MeasuredData, MeasurementNoise, Node, Points,
    Polyline, Record, Shape, Values,
};
use rotordyn_update::target::node_position;

/// Channels of a run, at their points, with the shaft's angle and speed \[rpm\], all in memory.
///
/// # Errors
/// Stored samples that cannot be read.
pub fn run_records(history: &History, model: &Model) -> Result<MeasuredData, SeriesError> {
    let start = history.time.at(0)?.unwrap_or(0.0);
    let axis = Axis::uniform(AxisQuantity::Time, start, 1.0 / history.sample_rate);
    let record = |name: &str, unit: &str, values: Vec<f64>| {
        Record::new(name, Kind::Time, axis.clone(), Values::Real(values), unit)
    };
    let mut geometry = geometry(model);
    let mut offset_points = Vec::new();
    let mut records = Vec::new();
    for c in &history.channels {
        let response = match model.probes.iter().find(|p| p.name == c.name) {
            Some(probe) => point_of(&probe.at, &probe.direction, model, &mut geometry, &mut offset_points),
            None => {
                Dof::new(point_number(model, &c.station).unwrap_or(0), direction(&c.direction).unwrap_or(0))
            }
        };
        records.push(Record { response, ..record(&c.name, &c.unit, c.values.all()?.into_owned()) });
    }
    records.push(record("shaft_angle", "rad", history.angle.all()?.into_owned()));
    let rpm = history.speed.all()?.iter().map(|speed| speed * 60.0 / TAU).collect();
    records.push(record("shaft_speed", "rpm", rpm));
    let title = model.title.clone();
    Ok(MeasuredData { title, records, geometry, ..MeasuredData::default() })
}

/// Point number of a station, bearing or body; the prefixes of `housing.A`, `body.block`, `disc.main` and
/// `station.B` resolve names that are used more than once.
pub fn point_number(model: &Model, place: &str) -> Option<i64> {
    let station = |name: &str| model.stations.iter().find(|s| s.name == name).map(|s| s.node);
    let bearing = |name: &str| model.bearings.iter().find(|b| b.name == name).map(|b| b.node);
    let disc = |name: &str| model.rotating_inertias().find(|d| d.name == name).map(|d| d.node);
    let body = |name: &str| model.bodies.iter().position(|b| b.name == name).map(|k| model.node_z.len() + k);
    let node = match place.split_once('.') {
        Some(("housing" | "body", name)) => body(name),
        Some(("disc", name)) => disc(name),
        Some(("station", name)) => station(name),
        Some(("bearing", name)) => bearing(name),
        _ => station(place).or_else(|| bearing(place)).or_else(|| body(place)),
    };
    node.map(|node| node as i64 + 1)
}

/// Computed FRFs between excitation and response points, at the requested frequencies.
pub fn frf_records(found: &FrfResult, machine: &Machine) -> MeasuredData {
    let model = &machine.model;
    let Some(study) = &model.studies.frf else { return MeasuredData::default() };
    // Measurement programs expect equally spaced lines where those were requested.
    let found = &found.at_requested();
    let mut geometry = geometry(model);
    let mut offset_points = Vec::new();
    let axis = Axis::from_points(AxisQuantity::Frequency, found.frf.frequencies.clone());
    let mut records = Vec::new();
    for (r, probe) in study.responses.iter().enumerate() {
        for (e, excitation) in study.excitations.iter().enumerate() {
            let values = Values::Complex(found.frf.values[r][e].clone());
            let name = format!("{}/{}", probe.name, excitation.name);
            records.push(Record {
                response: point_of(&probe.at, &probe.direction, model, &mut geometry, &mut offset_points),
                reference: point_of(
                    &excitation.at,
                    &excitation.direction,
                    model,
                    &mut geometry,
                    &mut offset_points,
                ),
                speed_rpm: Some(found.speed * 60.0 / TAU),
                ..Record::new(&name, Kind::Frf, axis.clone(), values, &found.units[r][e])
            });
        }
    }
    MeasuredData { title: model.title.clone(), records, geometry, ..MeasuredData::default() }
}

/// Point and direction of a probe or an excitation. A location at an offset from a node gets its own point after those
/// of the model.
fn point_of(
    at: &Anchor,
    weights: &[f64; 6],
    model: &Model,
    geometry: &mut Geometry,
    offset_points: &mut Vec<Anchor>,
) -> Dof {
    let direction = single_direction(weights);
    let Some(node) = at.node else { return Dof::new(0, direction) };
    if at.offset == [0.0; 3] {
        return Dof::new(node as i64 + 1, direction);
    }
    let place = offset_points.iter().position(|known| known == at).unwrap_or_else(|| {
        offset_points.push(*at);
        offset_points.len() - 1
    });
    let number = (model.node_count() + 1 + place) as i64;
    if !geometry.nodes.iter().any(|n| n.number == number) {
        let ([x, y, z], [a, b, c]) = (node_position(model, node), at.offset);
        geometry.nodes.push(Node { number, position: [x + a, y + b, z + c], local_system: 0 });
    }
    Dof::new(number, direction)
}

/// Number of a direction along one axis, with its sign; 0 for any other.
fn single_direction(weights: &[f64; 6]) -> i8 {
    let mut along = weights.iter().enumerate().filter(|(_, w)| **w != 0.0);
    match (along.next(), along.next()) {
        (Some((k, w)), None) => (k as i8 + 1) * w.signum() as i8,
        _ => 0,
    }
}

/// Damped modes at every speed, as complex shapes over all points.
pub fn mode_shapes(found: &[ModalResult], machine: &Machine) -> MeasuredData {
    let model = &machine.model;
    let mut shapes = Vec::new();
    for at in found {
        for (k, mode) in at.modes.iter().enumerate() {
            shapes.push(Shape {
                name: format!("{:.0} rpm {}", at.speed * 60.0 / TAU, mode.label),
                analysis: Analysis::ComplexMode {
                    eigenvalue: mode.eigenvalue,
                    modal_a: 0.0.into(),
                    modal_b: 0.0.into(),
                },
                number: k as i64 + 1,
                components: 6,
                nodes: (1..=model.node_count() as i64).collect(),
                values: mode.full_shape.clone(),
                complex: true,
                unit: "m".into(),
            });
        }
    }
    MeasuredData { title: model.title.clone(), shapes, geometry: geometry(model), ..MeasuredData::default() }
}

/// Points of shaft and bodies; lines along the shaft and from every bearing to its housing.
fn geometry(model: &Model) -> Geometry {
    let shaft = model.node_z.iter().map(|&z| [0.0, 0.0, z]);
    let places = shaft.chain(model.bodies.iter().map(|b| b.position));
    let nodes =
        places.zip(1..).map(|(position, number)| Node { number, position, local_system: 0 }).collect();
    let mut lines =
        vec![Polyline { name: "shaft".into(), strokes: vec![(1..=model.node_z.len() as i64).collect()] }];
    for site in &model.bearings {
        if let Some(body) = site.housing.node {
            let stroke = vec![site.node as i64 + 1, body as i64 + 1];
            lines.push(Polyline { name: format!("bearing {}", site.name), strokes: vec![stroke] });
        }
    }
    Geometry { nodes, lines, ..Geometry::default() }
}

/// Records named as in the CWRU bearing data: `X<number>_<name>_time`, with `X<number>RPM`, the mean speed.
///
/// `number` is written with three digits.
pub fn with_cwru_names(measured: &MeasuredData, number: u32) -> MeasuredData {
    let mut out = measured.clone();
    let speed = measured.record("shaft_speed").ok().and_then(|r| r.time_samples().ok());
    if let Some(rpm) = speed.filter(|rpm| !rpm.is_empty()) {
        let mean = rpm.iter().sum::<f64>() / rpm.len() as f64;
        out.scalars.push((format!("X{number:03}RPM"), mean));
    }
    for record in &mut out.records {
        record.name = format!("X{number:03}_{}_time", record.name);
    }
    out
}

/// Whether a record is a vibration signal: uniformly sampled acceleration, velocity, displacement or force.
pub fn is_vibration(record: &Record) -> bool {
    let even = matches!(record.axis.points, Points::Uniform { .. });
    even && matches!(record.unit.as_str(), "m" | "m/s" | "m/s^2" | "N")
}

/// FRFs of a simulated test with measurement noise, each with its coherence.
///
/// # Errors
/// Records that do not form an FRF matrix, zero averages, a signal-to-noise ratio that is not finite.
pub fn with_measurement_noise(exact: &MeasuredData, test: &MeasurementNoise) -> Result<MeasuredData, Error> {
    let matrix = exact.frf_matrix()?.with_measurement_noise(test)?;
    let mut out = exact.clone();
    let mut coherences = Vec::new();
    for record in out.records.iter_mut().filter(|r| r.kind == Kind::Frf) {
        let response = matrix.responses.iter().position(|dof| *dof == record.response);
        let reference = matrix.references.iter().position(|dof| *dof == record.reference);
        let (Some(r), Some(e)) = (response, reference) else { continue };
        record.values = Values::Complex(matrix.values[r][e].clone());
        if let Some(coherence) = &matrix.coherence {
            let values = Values::Real(coherence[r][e].clone());
            coherences.push(Record {
                response: record.response,
                reference: record.reference,
                speed_rpm: record.speed_rpm,
                ..Record::new(
                    &format!("coherence {}", record.name),
                    Kind::Coherence,
                    record.axis.clone(),
                    values,
                    "1",
                )
            });
        }
    }
    out.records.extend(coherences);
    Ok(out)
}
