//! Small machines built in code.

use rotordyn::element::{Anchor, Bushing, Disc, Joint, Material, ShaftElement, ShearCoefficient};
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

/// Jeffcott rotor: a disc on the middle (node 4) of a massless shaft of 800 mm and 20 mm on pins, without gravity; η the shaft's
/// loss factor over frequency \[s\], c an external damper at the disc \[N s/m\].
pub fn jeffcott(mass: f64, eta: f64, external: f64) -> Model {
    let mut light = element(0.1, 0.02, 0.02);
    light.material.density = 1e-3;
    light.shear = ShearCoefficient::Rigid;
    light.internal_viscous = eta;
    let mut model = shaft(vec![light; 8]);
    model.gravity = [0.0; 3];
    model.discs.push(disc(4, mass, 1e-6, 1e-6));
    for (node, axial) in [(0, true), (8, false)] {
        let locked = [true, true, axial, false, false, axial];
        model.joints.push(Joint { name: "pin".into(), a: Anchor::node(node), b: Anchor::GROUND, locked });
    }
    let mut damping = [[0.0; 6]; 6];
    (damping[0][0], damping[1][1]) = (external, external);
    let (a, b, stiffness) = (Anchor::node(4), Anchor::GROUND, [[0.0; 6]; 6]);
    model.bushings.push(Bushing { name: "external_damper".into(), a, b, stiffness, damping });
    model
}
