//! The overhung rig as data, for tests that want it without the model file.
#![allow(dead_code)]

use crate::bearing::{rig_6205, steel};
use rotordyn::bearing::Bearing;
use rotordyn::element::*;
use rotordyn::model::study::Studies;
use rotordyn::model::*;

const NODES: usize = 51;

fn diagonal(values: [f64; 6]) -> [[f64; 6]; 6] {
    let mut m = [[0.0; 6]; 6];
    for k in 0..6 {
        m[k][k] = values[k];
    }
    m
}

fn node_at(z: &[f64], at: f64) -> usize {
    z.iter().position(|v| (v - at).abs() < 1e-9).expect("a node at every station")
}

/// The rig's three bearing models of the paper.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Supports {
    /// Joints straight to ground, free to tilt; no housings, no belt stiffness.
    Spherical,
    /// Joints straight to ground that hold the tilt too.
    Cylindrical,
    /// Two 6205 in housings on springs, with the belt.
    BallBearings,
}

/// The rig of tests/data/rig.json with one of its bearing models.
pub fn rig(supports: Supports) -> Model {
    let mut model = with_ball_bearings();
    if supports == Supports::BallBearings {
        return model;
    }
    let tilt = supports == Supports::Cylindrical;
    model.joints = model
        .bearings
        .iter()
        .map(|site| Joint {
            name: site.name.clone(),
            a: Anchor::node(site.node),
            b: Anchor { node: None, offset: [0.0, 0.0, model.node_z[site.node]] },
            locked: [true, true, site.name == "B", tilt, tilt, false],
        })
        .collect();
    model.bearings.clear();
    model.bodies.clear();
    model.bushings.retain(|b| b.name == "disc damper");
    for belt in &mut model.belts {
        belt.stiffness = [0.0; 3];
        belt.damping = [0.0; 3];
    }
    model.probes.retain(|p| p.name.starts_with("disc"));
    model
}

/// Shaft, disc, pulley, belt, two 6205 in spring-mounted housings.
fn with_ball_bearings() -> Model {
    let mut node_z: Vec<f64> = (0..NODES).map(|k| 0.0125 * k as f64).collect();
    let stations = [("A", 0.03), ("pulley", 0.308), ("B", 0.38), ("disc", 0.6), ("end", 0.625)];
    for (_, z) in stations {
        if !node_z.iter().any(|v| (v - z).abs() < 1e-9) {
            node_z.push(z);
        }
    }
    node_z.sort_by(f64::total_cmp);
    let shaft = node_z
        .windows(2)
        .map(|w| ShaftElement {
            length: w[1] - w[0],
            outer_diameter: [0.025; 2],
            inner_diameter: [0.0; 2],
            material: steel(),
            shear: ShearCoefficient::Cowper,
            rotary_inertia: true,
            axial_force: 0.0,
            torque: 0.0,
            proportional: [0.0, 2e-5],
            internal_viscous: 0.0,
        })
        .collect();
    let at = |z: f64| node_at(&node_z, z);
    let shaft_nodes = node_z.len();
    let housing = |name: &str, z: f64| RigidBody {
        name: name.into(),
        position: [0.0, 0.0, z],
        mass: 1.5,
        inertia: [[0.003, 0.0, 0.0], [0.0, 0.003, 0.0], [0.0, 0.0, 0.003]],
    };
    let mount = |name: &str, body: usize| Bushing {
        name: name.into(),
        a: Anchor::node(shaft_nodes + body),
        b: Anchor::GROUND,
        stiffness: diagonal([6e6, 15e6, 20e6, 1e5, 1e5, 1e6]),
        damping: diagonal([300.0, 600.0, 300.0, 0.0, 0.0, 0.0]),
    };
    let site = |name: &str, z: f64, body: usize| BearingSite {
        name: name.into(),
        node: at(z),
        housing: Anchor::node(shaft_nodes + body),
        bearing: Bearing::Ball(rig_6205()),
    };
    let probe = |name: &str, node: usize, k: usize, quantity| Probe {
        name: name.into(),
        at: Anchor::node(node),
        direction: std::array::from_fn(|i| f64::from(i == k)),
        quantity,
    };
    Model {
        name: "overhung_rig".into(),
        title: "Overhung rig".into(),
        gravity: [0.0, -9.80665, 0.0],
        materials: vec![steel()],
        stations: stations
            .iter()
            .map(|(name, z)| Station { name: (*name).into(), node: at(*z), z: *z })
            .collect(),
        discs: vec![
            Disc {
                name: "disc".into(),
                node: at(0.6),
                mass: 11.097676048805946,
                polar_inertia: 0.12484885554906688,
                diametral_inertia: 0.06279435030949364,
                outer_diameter: 0.3,
                thickness: 0.02,
            },
            Disc {
                name: "pulley".into(),
                node: at(0.308),
                mass: 1.0,
                polar_inertia: 0.0018,
                diametral_inertia: 0.000975,
                outer_diameter: 0.12,
                thickness: 0.03,
            },
        ],
        bodies: vec![housing("housing A", 0.03), housing("housing B", 0.38)],
        masses: vec![],
        bushings: vec![
            mount("mount A", 0),
            mount("mount B", 1),
            Bushing {
                name: "disc damper".into(),
                a: Anchor::node(at(0.6)),
                b: Anchor::GROUND,
                stiffness: [[0.0; 6]; 6],
                damping: diagonal([12.0, 12.0, 20.0, 0.0, 0.0, 0.3]),
            },
        ],
        joints: vec![],
        bearings: vec![site("A", 0.03, 0), site("B", 0.38, 1)],
        belts: vec![Belt {
            name: "drive".into(),
            node: at(0.308),
            pull: [250.0, 0.0],
            constant_pull: false,
            stiffness: [4e5, 2e4, 0.0],
            damping: [60.0, 0.0, 0.0],
        }],
        unbalances: vec![Unbalance {
            name: "residual".into(),
            node: at(0.6),
            magnitude: 0.00056,
            phase: 0.0,
        }],
        loads: vec![],
        damping: Damping::default(),
        drive: Drive::Prescribed { node: Some(at(0.308)) },
        profile: SpeedProfile::Ramp {
            from: 0.0,
            to: 40.0 * std::f64::consts::PI,
            settle: 1.0,
            ramp: 10.0,
            hold: 2.0,
        },
        probes: vec![
            probe("B_ax", shaft_nodes + 1, 0, Quantity::Acceleration),
            probe("B_ay", shaft_nodes + 1, 1, Quantity::Acceleration),
            probe("disc_x", at(0.6), 0, Quantity::Displacement),
            probe("disc_y", at(0.6), 1, Quantity::Displacement),
        ],
        studies: Studies::default(),
        shaft,
        node_z,
    }
}
