//! The linear part of a machine in the elements of ROSS, and what they cannot have.
//!
//! Nodes of ROSS are those of the shaft, then one for each body. Its bearings and supports have the three displacements
//! only, and its supports do not rotate.

use pyo3::prelude::*;
use rotordyn::bearing::{Bearing, LinearElement, SiteTangent};
use rotordyn::element::{Anchor, ShaftElement, ShearCoefficient};
use rotordyn::model::{Drive, Model};
use rotordyn::study::Machine;
use rotordyn::units::{self, SPEED};
use serde_json::{Value, json};

use crate::cli::failure::Failure;
use crate::failure::{Stop, detached};
use crate::source::Source;

/// Spring of ROSS for a direction that a joint holds \[N/m\].
const RIGID: f64 = 1e14;

/// Elements, and the parts that are not carried over with the reason.
struct Writer<'m> {
    model: &'m Model,
    lost: Vec<(String, String)>,
}

/// A machine as elements of ROSS, in JSON; bearings as they are at the speeds.
#[pyfunction]
pub fn ross_elements(py: Python<'_>, source: &Source, speeds: Vec<String>) -> PyResult<String> {
    detached(py, || {
        let speed = |text: &String| {
            units::parse(text, SPEED).map_err(|error| Stop::from(Failure::Input(format!("speeds: {error}"))))
        };
        let speeds = speeds.iter().map(speed).collect::<Result<Vec<f64>, Stop>>()?;
        let model = &source.loaded.model;
        let tangents =
            speeds.iter().map(|speed| tangents(model, *speed)).collect::<Result<Vec<_>, Stop>>()?;
        let mut writer = Writer { model, lost: Vec::new() };
        Ok(writer.elements(&speeds, &tangents)?.to_string())
    })
}

/// Tangents of the bearings at a speed; those of linear bearings need no equilibrium.
fn tangents(model: &Model, speed: f64) -> Result<Vec<SiteTangent>, Stop> {
    let linear = model.bearings.iter().map(|site| match &site.bearing {
        Bearing::Linear(bearing) => Some(LinearElement::new(bearing).tangent(speed)),
        _ => None,
    });
    if let Some(all) = linear.collect::<Option<Vec<_>>>() {
        return Ok(all);
    }
    let machine = Machine::new(model.clone())?;
    machine.check_tables("modal", &[speed])?;
    Ok(machine.tangents(speed, true)?)
}

impl Writer<'_> {
    fn lose(&mut self, item: impl Into<String>, why: impl Into<String>) {
        self.lost.push((item.into(), why.into()));
    }

    fn elements(&mut self, speeds: &[f64], tangents: &[Vec<SiteTangent>]) -> Result<Value, Failure> {
        let model = self.model;
        if model.rigid_rotor.is_some() {
            let text = "a rotor without a shaft ([rotor]) has no counterpart in ROSS; give it a shaft";
            return Err(Failure::Input(text.into()));
        }
        let shaft: Vec<Value> = self.shaft();
        let discs: Vec<Value> = model
            .discs
            .iter()
            .map(|disc| {
                json!({ "n": disc.node, "m": disc.mass, "Id": disc.diametral_inertia, "Ip": disc.polar_inertia,
                        "tag": disc.name })
            })
            .collect();
        let (supports, masses) = self.masses();
        let mut bearings = self.bearings(tangents);
        let (springs, couplings) = self.bushings();
        bearings.extend(springs);
        bearings.extend(self.belts());
        bearings.extend(self.joints());
        self.rest();
        Ok(json!({
            "title": model.title, "speeds": speeds, "shaft_nodes": model.node_z.len(),
            "alpha": model.damping.proportional[0], "beta": model.damping.proportional[1],
            "shaft": shaft, "discs": discs, "supports": supports, "masses": masses, "bearings": bearings, "couplings": couplings,
            "lost": self.lost,
        }))
    }

    fn shaft(&mut self) -> Vec<Value> {
        let mut out = Vec::new();
        for (n, element) in self.model.shaft.iter().enumerate() {
            for part in element.with_layers().filter(|part| part.material.density > 0.0) {
                let method = self.shear(n, part);
                if part.internal_viscous != 0.0 {
                    self.lose(format!("shaft element {n}"), "rotating (internal) damping of the shaft");
                }
                let [il, ir] = part.inner_diameter;
                let [ol, or] = part.outer_diameter;
                if il / ol != ir / or {
                    self.lose(
                        format!("shaft element {n}"),
                        "torsion and axial stiffness of a cone: the mean of both ends in ROSS",
                    );
                }
                out.push(json!({
                    "n": n, "L": part.length, "idl": il, "odl": ol, "idr": ir, "odr": or,
                    "material": { "name": part.material.name, "E": part.material.young, "G_s": part.material.shear,
                                  "rho": part.material.density },
                    "axial_force": part.axial_force, "torque": part.torque,
                    "shear_effects": method.is_some(), "shear_method_calc": method.unwrap_or("cowper"),
                    "rotary_inertia": part.rotary_inertia,
                    "alpha": part.proportional_damping[0], "beta": part.proportional_damping[1],
                }));
            }
        }
        out
    }

    /// Name of the shear coefficient in ROSS; `None` without shear.
    fn shear(&mut self, n: usize, part: &ShaftElement) -> Option<&'static str> {
        match part.shear {
            ShearCoefficient::Rigid => None,
            ShearCoefficient::Cowper => Some("cowper"),
            ShearCoefficient::Hutchinson => {
                self.lose(
                    format!("shaft element {n}"),
                    "Hutchinson's shear coefficient: ROSS lacks a factor 1 + nu",
                );
                Some("hutchinson")
            }
            ShearCoefficient::Value(kappa) if agree(kappa, hutchinson_of_ross(part)) => Some("hutchinson"),
            ShearCoefficient::Value(kappa) => {
                let text = format!("shear coefficient {kappa}: Cowper's is taken");
                self.lose(format!("shaft element {n}"), text);
                Some("cowper")
            }
        }
    }

    /// Bodies, with the masses on them, as point masses; masses on the shaft, which ROSS has in bearings.
    fn masses(&mut self) -> (Vec<Value>, Vec<Value>) {
        let (model, shaft) = (self.model, self.model.node_z.len());
        let (mut supports, mut on_shaft) = (Vec::new(), Vec::new());
        for (k, body) in model.bodies.iter().enumerate() {
            if !(3..6).all(|axis| self.is_held(shaft + k, axis)) {
                self.lose(format!("body {}", body.name), "rotations: supports of ROSS do not rotate");
            }
            supports.push((shaft + k, body.mass, body.name.clone()));
        }
        for mass in &model.masses {
            let name = format!("sensor.{}", mass.name);
            if mass.anchor.offset != [0.0; 3] {
                self.lose(&name, "its offset from the node");
            }
            match mass.anchor.node {
                Some(node) if node >= shaft => {
                    (0..3).for_each(|axis| supports[node - shaft].1[axis] += mass.mass[axis]);
                }
                Some(node) => on_shaft.push((node, mass.mass, name)),
                None => {}
            }
        }
        let point = |(n, [mx, my, mz], tag): (usize, [f64; 3], String)| json!({ "n": n, "mx": mx, "my": my, "mz": mz, "tag": tag });
        (supports.into_iter().map(point).collect(), on_shaft.into_iter().map(point).collect())
    }

    /// Whether a joint to ground holds a direction of a node.
    fn is_held(&self, node: usize, axis: usize) -> bool {
        self.model.joints.iter().any(|joint| {
            joint.locked[axis]
                && match (joint.a.node, joint.b.node) {
                    (Some(one), None) | (None, Some(one)) => one == node,
                    _ => false,
                }
        })
    }

    fn bearings(&mut self, tangents: &[Vec<SiteTangent>]) -> Vec<Value> {
        let mut out = Vec::new();
        for (k, site) in self.model.bearings.iter().enumerate() {
            let name = format!("bearing.{}", site.name);
            match &site.bearing {
                Bearing::Linear(linear) if !linear.whirl.is_empty() => {
                    self.lose(
                        &name,
                        "coefficients over whirl frequency: those of synchronous motion at each speed",
                    );
                }
                Bearing::Linear(_) => {}
                _ => self.lose(&name, "its contacts: linear coefficients at its equilibrium at each speed"),
            }
            let of = |matrix: fn(&SiteTangent) -> &[[f64; 6]; 6]| -> Vec<[[f64; 6]; 6]> {
                tangents.iter().map(|sites| *matrix(&sites[k])).collect()
            };
            let (stiffness, damping) = (of(|tangent| &tangent.stiffness), of(|tangent| &tangent.damping));
            self.link(&mut out, &name, site.node, &site.housing, &stiffness, &damping);
        }
        out
    }

    /// A bearing of ROSS between a node and an anchor, with the displacements alone.
    fn link(
        &mut self,
        out: &mut Vec<Value>,
        name: &str,
        node: usize,
        to: &Anchor,
        stiffness: &[[[f64; 6]; 6]],
        damping: &[[[f64; 6]; 6]],
    ) {
        let any = |lost: fn(usize, usize) -> bool| {
            let in_one = |m: &[[f64; 6]; 6]| (0..6).any(|a| (0..6).any(|b| lost(a, b) && m[a][b] != 0.0));
            stiffness.iter().chain(damping).any(in_one)
        };
        if any(|a, b| a > 2 || b > 2) {
            self.lose(name, "stiffness and damping of tilts: bearings of ROSS have displacements only");
        }
        if any(|a, b| a.max(b) == 2 && a != b) {
            self.lose(name, "coupling of radial and axial displacements");
        }
        if to.node.is_some_and(|body| body >= self.model.node_z.len())
            && to.offset != [0.0; 3]
            && !(3..6).all(|axis| to.node.is_some_and(|body| self.is_held(body, axis)))
        {
            self.lose(name, "its offset from the centre of mass of what holds it");
        }
        let part = |all: &[[[f64; 6]; 6]]| -> Vec<Vec<Vec<f64>>> {
            all.iter().map(|m| (0..3).map(|a| m[a][..3].to_vec()).collect()).collect()
        };
        out.push(
            json!({ "n": node, "n_link": to.node, "tag": name, "k": part(stiffness), "c": part(damping) }),
        );
    }

    /// Springs as bearings, and those across a gap of the shaft as couplings.
    fn bushings(&mut self) -> (Vec<Value>, Vec<Value>) {
        let (mut springs, mut couplings) = (Vec::new(), Vec::new());
        for bushing in &self.model.bushings {
            let name = format!("bushing.{}", bushing.name);
            let is_gap = |a: usize, b: usize| {
                b == a + 1 && self.model.shaft.get(a).is_some_and(|element| element.material.density == 0.0)
            };
            match (bushing.a.node, bushing.b.node) {
                (Some(a), Some(b)) if is_gap(a, b) => {
                    let diagonal = |m: &[[f64; 6]; 6]| -> Vec<f64> { (0..6).map(|k| m[k][k]).collect() };
                    let coupled =
                        |m: &[[f64; 6]; 6]| (0..6).any(|a| (0..6).any(|b| a != b && m[a][b] != 0.0));
                    if coupled(&bushing.stiffness) || coupled(&bushing.damping) {
                        self.lose(&name, "coupling between directions");
                    }
                    couplings.push(json!({
                        "n": a, "tag": name, "k": diagonal(&bushing.stiffness), "c": diagonal(&bushing.damping),
                        "L": self.model.shaft[a].length, "o_d": self.model.shaft[a].outer_diameter[0],
                    }));
                }
                (Some(node), other) | (other @ None, Some(node)) => {
                    let to = if other.is_some() || bushing.b.node.is_none() { bushing.b } else { bushing.a };
                    let (stiffness, damping) = (
                        self.without_held(node, &bushing.stiffness),
                        self.without_held(node, &bushing.damping),
                    );
                    self.link(&mut springs, &name, node, &to, &[stiffness], &[damping]);
                }
                (None, None) => {}
            }
        }
        (springs, couplings)
    }

    /// Stiffness without the rotations of a node that joints hold.
    fn without_held(&self, node: usize, matrix: &[[f64; 6]; 6]) -> [[f64; 6]; 6] {
        let held: Vec<bool> = (0..6).map(|axis| axis > 2 && self.is_held(node, axis)).collect();
        let mut out = *matrix;
        for a in 0..6 {
            for b in 0..6 {
                if held[a] || held[b] {
                    out[a][b] = 0.0;
                }
            }
        }
        out
    }

    fn belts(&mut self) -> Vec<Value> {
        let mut out = Vec::new();
        for belt in &self.model.belts {
            let name = format!("belt.{}", belt.name);
            let spring = |[x, y, twist]: [f64; 3]| {
                let mut m = [[0.0; 6]; 6];
                (m[0][0], m[1][1], m[5][5]) = (x, y, twist);
                m
            };
            self.link(
                &mut out,
                &name,
                belt.node,
                &Anchor::GROUND,
                &[spring(belt.stiffness)],
                &[spring(belt.damping)],
            );
        }
        out
    }

    /// Joints that hold a node as stiff springs.
    fn joints(&mut self) -> Vec<Value> {
        let mut out = Vec::new();
        for joint in &self.model.joints {
            let name = format!("joint.{}", joint.name);
            let (node, to) = match (joint.a.node, joint.b.node) {
                (Some(node), _) => (node, joint.b),
                (None, Some(node)) => (node, joint.a),
                (None, None) => continue,
            };
            let is_support = node >= self.model.node_z.len() && to.node.is_none();
            if joint.locked[3..].contains(&true) && !is_support {
                self.lose(&name, "held rotations");
            }
            if joint.locked[..3].contains(&true) {
                let mut stiffness = [[0.0; 6]; 6];
                (0..3).filter(|axis| joint.locked[*axis]).for_each(|axis| stiffness[axis][axis] = RIGID);
                self.link(&mut out, &name, node, &to, &[stiffness], &[[[0.0; 6]; 6]]);
            }
        }
        out
    }

    /// What ROSS takes with each study, or has not at all.
    fn rest(&mut self) {
        let model = self.model;
        if !model.damping.modal.is_empty() {
            self.lose("damping.modal", "modal damping over frequency; ROSS has it by mode number");
        }
        for unbalance in &model.unbalances {
            let text = format!(
                "give it to run_unbalance_response: node={}, unbalance_magnitude={:e}, unbalance_phase={:.6}",
                unbalance.node, unbalance.magnitude, unbalance.phase
            );
            self.lose(format!("unbalance.{}", unbalance.name), text);
        }
        for load in &model.loads {
            self.lose(format!("load.{}", load.name), "loads belong to the runs of ROSS");
        }
        if matches!(model.drive, Drive::Torque { .. }) {
            self.lose("drive", "a drive torque over speed");
        }
    }
}

/// κ of Hutchinson as ROSS computes it.
fn hutchinson_of_ross(part: &ShaftElement) -> f64 {
    let nu = part.material.young / (2.0 * part.material.shear) - 1.0;
    let mean = |[left, right]: [f64; 2]| 0.5 * (left + right);
    let m2 = (mean(part.inner_diameter) / mean(part.outer_diameter)).powi(2);
    let a = (1.0 + m2).powi(2);
    6.0 * a * (1.0 + nu)
        / (a * (7.0 + 12.0 * nu + 4.0 * nu * nu) + 4.0 * m2 * (5.0 + 6.0 * nu + 2.0 * nu * nu))
}

fn agree(a: f64, b: f64) -> bool {
    (a - b).abs() <= 1e-9 * b.abs()
}
