//! Measured modes and FRFs, mapped to points of the model.

use std::f64::consts::TAU;

use super::UpdateError;
use rotordyn_core::assembly::Assembly;
use rotordyn_core::element::Anchor;
use rotordyn_core::model::Model;
use rotordyn_identify::QualityWarning;
use rotordyn_linalg::{Complex64, SparseRow};
use rotordyn_signal::Quantity;
use rotordyn_signal::record::{Analysis, Dof, Geometry, MeasuredData, Shape};

/// A measured DOF (sensor or excitation) in the model.
#[derive(Clone, Debug, PartialEq)]
pub struct Sensor {
    /// Measured point and direction: node k of the model is point k + 1.
    pub dof: Dof,
    pub anchor: Anchor,
    /// Weights on u_x u_y u_z θ_x θ_y θ_z.
    pub direction: [f64; 6],
}

impl Sensor {
    /// Output row: the point's motion over the free DOFs.
    pub fn row(&self, assembly: &Assembly) -> SparseRow {
        assembly.direction_row(&self.anchor, &self.direction)
    }

    /// Station or body with the direction, such as "disc x".
    pub fn name(&self, model: &Model) -> String {
        let axis = ["?", "x", "y", "z", "theta_x", "theta_y", "theta_z"]
            [usize::from(self.dof.direction.unsigned_abs()).min(6)];
        let sign = if self.dof.direction < 0 { "-" } else { "" };
        let shaft = model.node_z.len();
        let place = match self.anchor.node {
            None => "ground".into(),
            Some(node) if node >= shaft => model.bodies[node - shaft].name.clone(),
            Some(node) => model
                .stations
                .iter()
                .find(|s| s.node == node)
                .map_or_else(|| format!("z = {:.3} m", model.node_z[node]), |s| s.name.clone()),
        };
        let [x, y, z] = self.anchor.offset.map(|v| (1e4 * v).round() / 10.0);
        let offset = if [x, y, z] == [0.0; 3] { String::new() } else { format!(" ({x}, {y}, {z} mm)") };
        format!("{place}{offset} {sign}{axis}")
    }
}

/// A measured mode.
#[derive(Clone, Debug, PartialEq)]
pub struct TargetMode {
    /// Damped frequency Im λ / 2π \[Hz\].
    pub frequency_hz: f64,
    /// Damping ratio ζ; `None` if the file gives none.
    pub damping_ratio: Option<f64>,
    /// Standard errors \[Hz\] and of ζ; 0 if unknown.
    pub frequency_error: f64,
    pub damping_error: f64,
    /// Mode shape over the sensors.
    pub shape: Vec<Complex64>,
    /// Standard deviation of √(1 − MAC) by the error of the shape; 0 if unknown.
    pub shape_error: f64,
    /// Quality warnings of the identification.
    pub quality_warnings: Vec<QualityWarning>,
}

impl TargetMode {
    /// Quality warnings of the identification, as text; empty without doubt.
    pub fn quality_text(&self) -> String {
        self.quality_warnings.iter().map(|doubt| doubt.label()).collect::<Vec<_>>().join("; ")
    }
}

/// Measured FRFs at points of the model.
#[derive(Clone, Debug, PartialEq)]
pub struct TargetFrfs {
    /// \[Hz\].
    pub frequencies: Vec<f64>,
    pub responses: Vec<Sensor>,
    pub references: Vec<Sensor>,
    /// Quantity of every response.
    pub quantities: Vec<Quantity>,
    /// `values[response][reference][line]`, SI.
    pub values: Vec<Vec<Vec<Complex64>>>,
    /// Coherence γ² with the same indices, if measured.
    pub coherence: Option<Vec<Vec<Vec<f64>>>>,
}

impl TargetFrfs {
    /// Whether an FRF is nonzero; zero FRFs (uncoupled directions) cannot be compared.
    pub fn is_nonzero(&self, response: usize, reference: usize) -> bool {
        self.values[response][reference].iter().any(|h| h.norm_sqr() > 0.0)
    }
}

/// Measured data that a model is compared with.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Target {
    /// Speed Ω of the measurement \[rad/s\].
    pub speed: f64,
    /// Points of the shapes.
    pub sensors: Vec<Sensor>,
    /// In order of frequency.
    pub modes: Vec<TargetMode>,
    pub frfs: Option<TargetFrfs>,
}

/// Maps measured points to the model: point k + 1 is node k unless the file's geometry places it elsewhere; a
/// point with coordinates is attached rigidly to the shaft node nearest along z, such as one on a disc's rim.
///
/// Rotations are weighted by the radius of the largest disc (motion of its rim).
///
/// # Errors
/// Points that are neither in the model nor have coordinates, and records without point or direction, all at
/// once.
pub fn sensors(dofs: &[Dof], geometry: &Geometry, model: &Model) -> Result<Vec<Sensor>, UpdateError> {
    let nodes = model.node_count();
    let mut unmapped: Vec<String> = Vec::new();
    let mut missing_direction = false;
    let radius = rotation_radius(model);
    // Points are numbered from 1; a file may state any number.
    let node_of = |number: i64| {
        let place = usize::try_from(number.checked_sub(1)?).ok();
        place.filter(|k| *k < nodes)
    };
    let place = |number: i64| -> Option<Anchor> {
        let own = node_of(number);
        if let Some(mount) = geometry.attached_points.iter().find(|m| m.number == number) {
            return Some(Anchor { node: Some(node_of(mount.carrier)?), offset: mount.offset });
        }
        let stated = geometry.nodes.iter().find(|n| n.number == number).map(|n| n.position);
        match (own, stated) {
            (Some(node), None) => Some(Anchor::node(node)),
            (Some(node), Some(position)) if is_at(model, node, position) => Some(Anchor::node(node)),
            (_, Some(position)) => {
                model_point(model, position).or_else(|| nearest_shaft_node(model, position))
            }
            (None, None) => None,
        }
    };
    let mut out = Vec::new();
    for &dof in dofs {
        let axis = usize::from(dof.direction.unsigned_abs());
        if dof.node == 0 || !(1..=6).contains(&axis) {
            missing_direction = true;
            continue;
        }
        let Some(at) = place(dof.node) else {
            let name = dof.node.to_string();
            if !unmapped.contains(&name) {
                unmapped.push(name);
            }
            continue;
        };
        let mut direction = [0.0; 6];
        direction[axis - 1] = f64::from(dof.direction.signum()) * if axis > 3 { radius } else { 1.0 };
        out.push(Sensor { dof, anchor: at, direction });
    }
    if missing_direction {
        return Err(UpdateError::new(
            "the measured file does not state point and direction of all its records",
            "give the station and direction of each channel with --mapping",
        ));
    }
    if !unmapped.is_empty() {
        let more = if unmapped.len() > 8 { ", ..." } else { "" };
        unmapped.truncate(8);
        return Err(UpdateError::new(
            {
                let (are, points) = if unmapped.len() == 1 {
                    ("is not a point", "point")
                } else {
                    ("are not points", "points")
                };
                format!("the measured {points} {}{more} {are} of the model", unmapped.join(", "))
            },
            "give the station of each point with --mapping",
        ));
    }
    Ok(out)
}

/// Radius at which rotations are compared with translations \[m\].
pub fn rotation_radius(model: &Model) -> f64 {
    let largest = model.discs.iter().map(|d| 0.5 * d.outer_diameter).fold(0.0, f64::max);
    let length = model.node_z.last().unwrap_or(&1.0) - model.node_z.first().unwrap_or(&0.0);
    if largest > 0.0 { largest } else { 0.1 * length }
}

/// Tolerance for coordinates with the digits of a universal file \[m\].
const POSITION_TOLERANCE: f64 = 1e-5;

fn is_at(model: &Model, node: usize, position: [f64; 3]) -> bool {
    is_near(node_position(model, node), position)
}

/// A point defined in the model at this position: a probe, or a response or excitation of its FRF study.
fn model_point(model: &Model, position: [f64; 3]) -> Option<Anchor> {
    let frf = model.studies.frf.iter();
    let ends = frf.flat_map(|f| f.responses.iter().map(|p| p.at).chain(f.excitations.iter().map(|e| e.at)));
    let mut places = model.probes.iter().map(|p| p.at).chain(ends);
    places.find(|at| {
        at.node.is_some_and(|node| {
            let [a, b, c] = at.offset;
            let [x, y, z] = node_position(model, node);
            is_near([x + a, y + b, z + c], position)
        })
    })
}

/// Position of a node of the shaft or of a body.
pub fn node_position(model: &Model, node: usize) -> [f64; 3] {
    match node.checked_sub(model.node_z.len()) {
        None => [0.0, 0.0, model.node_z[node]],
        Some(body) => model.bodies[body].position,
    }
}

fn is_near(a: [f64; 3], b: [f64; 3]) -> bool {
    a.iter().zip(b).all(|(a, b)| (a - b).abs() < POSITION_TOLERANCE)
}

/// The shaft node nearest along z, with the offset to the position; `None` beyond the shaft's ends.
fn nearest_shaft_node(model: &Model, [x, y, z]: [f64; 3]) -> Option<Anchor> {
    let distance = |k: &usize| (model.node_z[*k] - z).abs();
    let node = (0..model.node_z.len()).min_by(|a, b| distance(a).total_cmp(&distance(b)))?;
    let reach = model.node_z.windows(2).map(|w| w[1] - w[0]).fold(0.0, f64::max);
    let on_shaft = distance(&node) <= reach.max(1e-3);
    on_shaft.then(|| Anchor { node: Some(node), offset: [x, y, z - model.node_z[node]] })
}

/// Modes of a measured file (shapes) with their DOFs; `None` if there are none.
///
/// Directions with zero motion are omitted. Of several speeds, given by names such as "1200 rpm 1st bending",
/// the one nearest to `rpm`, else the first, is taken and returned.
pub fn modes_of(
    measured: &MeasuredData,
    rpm: Option<f64>,
) -> Option<(Vec<Dof>, Vec<TargetMode>, Option<f64>)> {
    let speed = |s: &Shape| s.name.split_once(" rpm").and_then(|(n, _)| n.trim().parse::<f64>().ok());
    let is_mode =
        |s: &&Shape| matches!(s.analysis, Analysis::NormalMode { .. } | Analysis::ComplexMode { .. });
    let all: Vec<&Shape> = measured.shapes.iter().filter(is_mode).collect();
    let near = |s: &&&Shape| match (speed(s), rpm) {
        (Some(own), Some(rpm)) => (own - rpm).abs(),
        _ => 0.0,
    };
    let taken = all.iter().min_by(|a, b| near(a).total_cmp(&near(b))).and_then(|s| speed(s));
    let modes: Vec<&Shape> = all.into_iter().filter(|s| speed(s) == taken).collect();
    let first = modes.first()?;
    let components = first.components;
    let moves = |component: usize| {
        let of =
            |s: &&&Shape| s.values.iter().skip(component).step_by(components).any(|v| v.norm_sqr() > 0.0);
        modes.iter().any(|s| s.components == components && of(&s))
    };
    let moving: Vec<usize> = (0..components).filter(|&c| moves(c)).collect();
    let same_group: Vec<_> =
        modes.iter().filter(|s| s.nodes == first.nodes && s.components == components).collect();
    let dofs = first
        .nodes
        .iter()
        .flat_map(|&node| {
            moving.iter().map(move |&c| Dof::new(node, if components == 1 { 0 } else { c as i8 + 1 }))
        })
        .collect();
    let mode = |s: &&&Shape| {
        let shape =
            (0..s.nodes.len()).flat_map(|n| moving.iter().map(move |&c| s.values[n * components + c]));
        let damping = s.analysis.damping_ratio();
        let natural = s.analysis.frequency_hz()?;
        let frequency_hz = match s.analysis {
            Analysis::ComplexMode { eigenvalue, .. } => eigenvalue.im.abs() / TAU,
            _ => natural * (1.0 - damping.unwrap_or(0.0).powi(2)).max(0.0).sqrt(),
        };
        (frequency_hz > 0.0).then(|| TargetMode {
            frequency_hz,
            // Programs without a damping estimate write zero.
            damping_ratio: damping.filter(|zeta| *zeta != 0.0),
            frequency_error: 0.0,
            damping_error: 0.0,
            shape: shape.collect(),
            shape_error: 0.0,
            quality_warnings: Vec::new(),
        })
    };
    let mut found: Vec<TargetMode> = same_group.iter().filter_map(mode).collect();
    found.sort_by(|a, b| a.frequency_hz.total_cmp(&b.frequency_hz));
    Some((dofs, found, taken))
}
