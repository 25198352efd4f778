//! Forces of the supports on the shaft, from the equilibrium of its nodes.

use super::section_loads::SectionLoad;
use crate::document::{Rows, named};
use crate::element::Anchor;
use crate::model::Model;
use serde::{Deserialize, Serialize};

/// Force and moment of what holds or pulls the shaft at a node: bearings, joints, bushings, belts.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SupportForce {
    /// As in the model file, such as "bearing.A"; several at one node with " + " between them.
    pub name: String,
    /// Axial position \[m\].
    pub z: f64,
    /// F_x F_y F_z M_x M_y M_z on the shaft \[N, N m\].
    pub force: [f64; 6],
}

/// Forces of all supports on the shaft at rest, by node: the loads of the sections beside it less the loads on it.
///
/// They are independent of the laws of the bearings: their sum balances weight and loads. Empty for a rigid rotor.
pub fn support_forces(model: &Model, sections: &[SectionLoad]) -> Vec<SupportForce> {
    let nodes = model.node_z.len();
    let mut force = vec![[0.0; 6]; nodes];
    for pair in sections.chunks_exact(2) {
        for (section, sign) in pair.iter().zip([1.0, -1.0]) {
            let [vx, vy] = section.shear.map(|v| v.re);
            let [mx, my] = section.moment.map(|m| m.re);
            let own = [vx, vy, -section.axial.re, my, -mx, -section.torque.re];
            force[section.node].iter_mut().zip(own).for_each(|(sum, f)| *sum += sign * f);
        }
    }
    let mut add = |at: &Anchor, load: [f64; 6]| {
        let Some(node) = at.node.filter(|node| *node < nodes) else { return };
        for (i, row) in at.rows().iter().enumerate() {
            row.0.iter().for_each(|&(dof, v)| force[node][dof % 6] -= v * load[i]);
        }
    };
    let weight = |mass: [f64; 3]| {
        let [x, y, z] = std::array::from_fn(|i| mass[i] * model.gravity[i]);
        [x, y, z, 0.0, 0.0, 0.0]
    };
    model.rotating_inertias().for_each(|disc| add(&Anchor::node(disc.node), weight([disc.mass; 3])));
    model.masses.iter().for_each(|mass| add(&mass.anchor, weight(mass.mass)));
    model.loads.iter().filter(|load| load.factor.is_constant()).for_each(|load| add(&load.at, load.force));
    let mut names: Vec<Vec<String>> = vec![Vec::new(); nodes];
    let mut name = |at: &Anchor, text: String| {
        at.node.and_then(|node| names.get_mut(node)).into_iter().for_each(|names| names.push(text.clone()));
    };
    for site in &model.bearings {
        name(&Anchor::node(site.node), format!("bearing.{}", site.name));
    }
    for joint in &model.joints {
        [&joint.a, &joint.b].into_iter().for_each(|end| name(end, format!("joint.{}", joint.name)));
    }
    for bushing in &model.bushings {
        [&bushing.a, &bushing.b].into_iter().for_each(|end| name(end, format!("bushing.{}", bushing.name)));
    }
    for belt in &model.belts {
        name(&Anchor::node(belt.node), format!("belt.{}", belt.name));
    }
    let held = names.iter().enumerate().filter(|(_, names)| !names.is_empty() && !sections.is_empty());
    held.map(|(node, names)| SupportForce {
        name: names.join(" + "),
        z: model.node_z[node],
        force: force[node],
    })
    .collect()
}

impl SupportForce {
    /// What is written to files, one row a support.
    pub fn columns(found: &[Self]) -> Rows<'static, '_, Self> {
        Rows::of(found).text("support", |r| &r.name).number(named("z_m", "z"), "m", |r| r.z).numbers(
            "force",
            "N, N m",
            &[6],
            |r| r.force,
        )
    }
}
