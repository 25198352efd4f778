//! Export of a whole machine for viewers: the overhung rig's main dimensions (reconstructed), in glTF and
//! VTK.

use rotordyn::bearing::Bearing;
use rotordyn::element::{Anchor, Disc, RigidBody, ShaftElement, ShearCoefficient};
use rotordyn::geometry::scene_graph::Scene;
use rotordyn::io::gltf;
use rotordyn::io::vtk::{Grid, machine_fields, to_vtu};
use rotordyn::model::{BearingSite, Damping, Drive, Model, SpeedProfile};

use crate::bearing::{rig_6205, steel};

/// Shaft of 25 mm in elements of 12.5 mm, bearings at 0.025 m and 0.375 m, disc of 300 mm at 0.6 m.
fn rig() -> Model {
    let element = ShaftElement {
        length: 0.0125,
        outer_diameter: [0.025; 2],
        inner_diameter: [0.0; 2],
        material: steel(),
        shear: ShearCoefficient::Cowper,
        rotary_inertia: true,
        axial_force: 0.0,
        torque: 0.0,
        proportional_damping: [0.0; 2],
        internal_viscous: 0.0,
    };
    let disc = |name: &str, node, mass, polar_inertia, diametral_inertia, size: [f64; 2]| Disc {
        name: name.into(),
        node,
        mass,
        polar_inertia,
        diametral_inertia,
        outer_diameter: size[0],
        thickness: size[1],
    };
    let housing = |name: &str, z| RigidBody {
        name: name.into(),
        position: [0.0, 0.0, z],
        mass: 1.5,
        inertia: [[3e-3, 0.0, 0.0], [0.0, 3e-3, 0.0], [0.0, 0.0, 3e-3]],
    };
    let site = |name: &str, node, body| BearingSite {
        name: name.into(),
        node,
        housing: Anchor::node(body),
        bearing: Bearing::Ball(rig_6205()),
    };
    Model {
        name: "overhung rig".into(),
        title: String::new(),
        gravity: [0.0, -9.80665, 0.0],
        materials: vec![],
        node_z: (0..=50).map(|k| f64::from(k) / 80.0).collect(),
        shaft: vec![element; 50],
        rigid_rotor: None,
        stations: vec![],
        discs: vec![
            disc("disc", 48, 11.0977, 0.124849, 0.0627944, [0.3, 0.02]),
            disc("pulley", 25, 1.0, 1.8e-3, 9.75e-4, [0.0; 2]),
        ],
        bodies: vec![housing("housing A", 0.025), housing("housing B", 0.375)],
        masses: vec![],
        bushings: vec![],
        joints: vec![],
        bearings: vec![site("A", 2, 51), site("B", 30, 52)],
        belts: vec![],
        unbalances: vec![],
        loads: vec![],
        damping: Damping::default(),
        drive: Drive::Prescribed { node: None },
        profile: SpeedProfile::Constant { speed: 0.0, duration: 1.0 },
        probes: vec![],
        studies: Default::default(),
    }
}

#[test]
fn gltf_contains_every_part() {
    let scene = Scene::of_machine(&rig());
    let names: Vec<&str> = scene.nodes.iter().map(|n| n.name.as_str()).collect();
    // 50 shaft sections, 2 discs, 2 housings, 2 bearings of 3 parts and 9 balls under one node.
    assert_eq!(names.len(), 50 + 2 + 2 + 2 * (1 + 3 + 9));
    for name in ["shaft 50", "disc", "pulley", "housing B", "A", "ball 9"] {
        assert!(names.contains(&name), "{name}");
    }
    // The pulley, given by inertia alone: R = √(2 I_p/m) = 60 mm, t = √(12 I_d/m − 3 R²) = 30 mm.
    let node = scene.nodes.iter().find(|n| n.name == "pulley").unwrap();
    let highest = |k: usize| {
        scene.meshes[node.mesh.unwrap()].mesh.positions.iter().map(|p| p[k]).fold(f64::MIN, f64::max)
    };
    assert!((highest(0) - 0.06).abs() < 1e-12 && (highest(2) - 0.015).abs() < 1e-12);
    // The housing's box: a² = 6 I/m with all moments equal.
    let node = scene.nodes.iter().find(|n| n.name == "housing A").unwrap();
    let corner = scene.meshes[node.mesh.unwrap()].mesh.positions[0];
    assert!((2.0 * corner[0].abs() - (6.0f64 * 3e-3 / 1.5).sqrt()).abs() < 1e-12);

    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("rig.glb");
    gltf::write(&path, &scene).unwrap();
    assert_eq!(std::fs::read(path).unwrap(), gltf::to_glb(&scene));
}

#[test]
fn vtk_contains_nodes_bodies_and_balls() {
    let grid = Grid::of_machine(&rig());
    assert_eq!((grid.points.len(), grid.lines.len()), (51 + 2 + 18, 50));
    let q: Vec<f64> = (0..6 * 53).map(|k| 1e-6 * f64::from(k)).collect();
    let loads: Vec<f64> = (0..18).map(f64::from).collect();
    let text = to_vtu(&grid, &machine_fields(&grid, &q, &loads)).unwrap();
    assert!(text.contains("NumberOfPoints=\"71\" NumberOfCells=\"70\""));
}
