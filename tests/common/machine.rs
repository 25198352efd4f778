//! Small machines built in code.

use rotordyn::element::{Disc, Material, ShaftElement, ShearCoefficient};
use rotordyn::model::{Damping, Drive, Model, SpeedProfile};

pub fn steel() -> Material {
    Material { name: "steel".into(), young: 2.1e11, shear: 2.1e11 / 2.6, poisson: 0.3, density: 7850.0 }
}

/// Shaft element with outer diameters left and right.
pub fn element(length: f64, left: f64, right: f64) -> ShaftElement {
    ShaftElement {
        length,
        outer_diameter: [left, right],
        inner_diameter: [0.0, 0.0],
        material: steel(),
        shear: ShearCoefficient::Cowper,
        rotary_inertia: true,
        axial_force: 0.0,
        torque: 0.0,
        proportional_damping: [0.0, 0.0],
        internal_viscous: 0.0,
        layers: Vec::new(),
    }
}

pub fn disc(node: usize, mass: f64, polar: f64, diametral: f64) -> Disc {
    Disc {
        name: format!("disc {node}"),
        node,
        mass,
        polar_inertia: polar,
        diametral_inertia: diametral,
        outer_diameter: 0.0,
        thickness: 0.0,
    }
}

/// A bare shaft without supports (free-free).
pub fn shaft(elements: Vec<ShaftElement>) -> Model {
    let mut node_z = vec![0.0];
    for e in &elements {
        node_z.push(node_z.last().unwrap() + e.length);
    }
    Model {
        name: "machine".into(),
        title: String::new(),
        gravity: [0.0, -9.80665, 0.0],
        materials: Vec::new(),
        node_z,
        shaft: elements,
        rigid_rotor: None,
        stations: Vec::new(),
        discs: Vec::new(),
        bodies: Vec::new(),
        masses: Vec::new(),
        bushings: Vec::new(),
        joints: Vec::new(),
        bearings: Vec::new(),
        belts: Vec::new(),
        unbalances: Vec::new(),
        loads: Vec::new(),
        damping: Damping::default(),
        drive: Drive::Prescribed { node: None },
        profile: SpeedProfile::Constant { speed: 0.0, duration: 1.0 },
        probes: Vec::new(),
        studies: Default::default(),
    }
}
