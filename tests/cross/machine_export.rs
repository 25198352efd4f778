//! Export of a whole machine for viewers: the overhung rig's main dimensions (reconstructed), in glTF and
//! VTK.

use crate::agree;
use rotordyn::bearing::Bearing;
use rotordyn::element::{Anchor, Disc, RigidBody, ShaftElement, ShearCoefficient};
use rotordyn::geometry::mesh::Mesh;
use rotordyn::geometry::scene_graph::{Node, Scene};
use rotordyn::io::export_3d::export_modes;
use rotordyn::io::gltf;
use rotordyn::io::vtk::{Field, Grid, Part, Values, machine_fields, to_vtu};
use rotordyn::model::{BearingSite, Damping, Drive, Model, Options, SpeedProfile, load};
use rotordyn::results::Results;
use rotordyn::study::Machine;

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
        layers: Vec::new(),
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
        mass: [1.5; 3],
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
    // The shaft, 2 discs, 2 housings, 2 bearings of 3 parts and 9 balls under one node.
    assert_eq!(names.len(), 1 + 2 + 2 + 2 * (1 + 3 + 9));
    for name in ["shaft", "disc", "pulley", "housing B", "A", "ball 9"] {
        assert!(names.contains(&name), "{name}");
    }
    // The pulley, given by inertia alone: R = √(2 I_p/m) = 60 mm, t = √(12 I_d/m − 3 R²) = 30 mm.
    let node = scene.nodes.iter().find(|n| n.name == "pulley").unwrap();
    let highest = |k: usize| {
        scene.meshes[node.mesh.unwrap()].mesh.positions.iter().map(|p| p[k]).fold(f64::MIN, f64::max)
    };
    agree::absolute("height of the machine along x [m]", highest(0), 0.06, 1e-12);
    agree::absolute("height of the machine along z [m]", highest(2), 0.015, 1e-12);
    // The housing's box: a² = 6 I/m with all moments equal.
    let node = scene.nodes.iter().find(|n| n.name == "housing A").unwrap();
    let corner = scene.meshes[node.mesh.unwrap()].mesh.positions[0];
    agree::absolute(
        "side of a body of given mass and inertia [m]",
        2.0 * corner[0].abs(),
        (6.0f64 * 3e-3 / 1.5).sqrt(),
        1e-12,
    );

    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("rig.glb");
    gltf::write(&path, &scene).unwrap();
    assert_eq!(std::fs::read(path).unwrap(), gltf::to_glb(&scene));
}

/// A stepped, tapered and partly hollow shaft with a pair in a block, from a file.
const SPINDLE: &str = r#"
[model]
name = "spindle"
[material.steel]
young = "210 GPa"
poisson = 0.3
density = "7850 kg/m^3"
[shaft]
material = "steel"
element_length = "20 mm"
section = [
    { length = "80 mm", outer_diameter = "30 mm", inner_diameter = "12 mm" },
    { length = "100 mm", outer_diameter = "30 mm", outer_diameter_end = "50 mm", inner_diameter = "12 mm" },
    { length = "90 mm", outer_diameter = "50 mm" },
    { length = "60 mm", outer_diameter = "40 mm", inner_diameter = "20 mm" },
]
[station]
front = "40 mm"
wheel = "220 mm"
rear = "310 mm"
[disc.wheel]
station = "wheel"
mass = "6 kg"
polar_inertia = "0.02 kg m^2"
diametral_inertia = "0.011 kg m^2"
outer_diameter = "160 mm"
thickness = "30 mm"
[body.block]
station = "front"
offset = "0, -100, 0 mm"
mass = "40 kg"
inertia = "0.4, 0.3, 0.5 kg m^2"
[bushing.feet]
between = ["body.block", "ground"]
k_x = "1e6 N/m"
k_y = "4e6 N/m"
k_z = "2e6 N/m"
k_txtx = "2e5 N m/rad"
k_tyty = "2e5 N m/rad"
k_tztz = "2e5 N m/rad"
[bearing.front]
station = "front"
housing = "body.block"
model = "ball"
designation = "7206B"
arrangement = "back_to_back"
row_spacing = "16 mm"
preload = { force = "150 N" }
[bearing.rear]
station = "rear"
model = "linear"
k_xx = "4e7 N/m"
k_yy = "4e7 N/m"
[drive]
kind = "prescribed"
station = "rear"
[study.modal]
speeds = "3000 rpm"
modes = 10
"#;

fn spindle() -> Model {
    load("spindle.toml", SPINDLE, &Options::default()).unwrap_or_else(|e| panic!("{e}")).model
}

type Position = [f64; 3];

/// Volume enclosed by a closed mesh, by the divergence theorem.
fn volume(mesh: &Mesh) -> f64 {
    let corner = |k: u32| nalgebra::Vector3::from(mesh.positions[k as usize]);
    mesh.triangles.iter().map(|&[a, b, c]| corner(a).dot(&corner(b).cross(&corner(c))) / 6.0).sum()
}

#[test]
fn shaft_is_one_closed_solid_of_its_volume() {
    let model = spindle();
    let scene = Scene::of_machine(&model);
    let shafts: Vec<_> = scene.nodes.iter().filter(|n| n.name.starts_with("shaft")).collect();
    assert_eq!(shafts.len(), 1);
    let mesh = &scene.meshes[shafts[0].mesh.unwrap()].mesh;

    // Closed: with corners at one position joined, every edge is in two triangles, once in each direction.
    // Plus zero: −0 is 0.
    let key = |p: Position| p.map(|x| (x + 0.0).to_bits());
    let mut edges = std::collections::HashMap::new();
    for t in &mesh.triangles {
        for (a, b) in [(0, 1), (1, 2), (2, 0)] {
            let [a, b] = [a, b].map(|k| key(mesh.positions[t[k] as usize]));
            *edges.entry((a, b)).or_insert(0) += 1;
        }
    }
    assert!(edges.iter().all(|((a, b), count)| *count == 1 && edges.get(&(*b, *a)) == Some(&1)));

    // Frusta by hand, on a polygon of 96 corners instead of a circle.
    let frustum = |d0: f64, d1: f64, l: f64| std::f64::consts::PI * l / 12.0 * (d0 * d0 + d0 * d1 + d1 * d1);
    let solid = frustum(0.03, 0.03, 0.08)
        + frustum(0.03, 0.05, 0.1)
        + frustum(0.05, 0.05, 0.09)
        + frustum(0.04, 0.04, 0.06);
    let bores = frustum(0.012, 0.012, 0.18) + frustum(0.02, 0.02, 0.06);
    let polygon = 96.0 / std::f64::consts::TAU * (std::f64::consts::TAU / 96.0).sin();
    agree::relative("volume of a part as meshed [m³]", volume(mesh), (solid - bores) * polygon, 1e-9);

    // Normals: smooth along the cone, whose elements have no seams; edges at steps.
    let radius = |p: Position| p[0].hypot(p[1]);
    let outside = |z: f64, r: f64| {
        let at = move |p: &Position| (p[2] - z).abs() < 1e-9 && (radius(*p) - r).abs() < 1e-9;
        (0..mesh.positions.len())
            .filter(move |&k| at(&mesh.positions[k]))
            .map(|k| mesh.normals[k][2])
            .collect::<Vec<_>>()
    };
    // Inside the cone there is no ring of corners: its elements are one piece.
    assert!(outside(0.12, 0.019).is_empty() && !outside(0.18, 0.025).is_empty());
    // At the step from 50 to 40 mm the corner has the normals of both faces.
    let step = outside(0.27, 0.025);
    for exact in [1.0, 0.0] {
        let nearest = step.iter().copied().min_by(|a, b| (a - exact).abs().total_cmp(&(b - exact).abs()));
        agree::absolute("axial part of a normal at a step", nearest.unwrap(), exact, 1e-9);
    }

    // Rigid rotor, turned down to the bores of its bearings: one solid as well.
    let scene = Scene::of_machine(&rigid());
    assert_eq!(scene.nodes.iter().filter(|n| n.name == "shaft").count(), 1);
}

fn rigid() -> Model {
    let text = include_str!("../../models/bal_2022.toml");
    load("bal_2022.toml", text, &Options::default()).unwrap_or_else(|e| panic!("{e}")).model
}

#[test]
fn both_rows_of_a_pair_are_in_the_scene() {
    let scene = Scene::of_machine(&spindle());
    let node = |name: &str| scene.nodes.iter().find(|n| n.name == name).unwrap();
    let (pair, rows) = (node("front"), [node("row 1"), node("row 2")]);
    assert_eq!(pair.children.len(), 2);
    let distance = rows[1].translation[2] - rows[0].translation[2];
    agree::absolute("distance of the rows of a pair [m]", distance, 0.016, 1e-12);
    let balls = scene.nodes.iter().filter(|n| n.name.starts_with("ball ")).count();
    assert_eq!(balls % 2, 0);
    // Rows with opposite thrust: the outer rings' grooves are offset to opposite sides of the balls.
    let ball_z = |row: &Node| scene.nodes[row.children[3]].translation[2];
    agree::absolute(
        "balls of both rows about the middle of the pair [m]",
        ball_z(rows[0]),
        -ball_z(rows[1]),
        1e-12,
    );
    assert!(ball_z(rows[0]) != 0.0);
}

#[test]
fn vtk_contains_nodes_bodies_and_balls() {
    let grid = Grid::of_machine(&rig());
    // Nodes, bodies and balls' centres come first; surfaces follow.
    let first = 51 + 2 + 18;
    assert!(grid.points.len() > first + 1000 && grid.lines.len() == 50 && grid.triangles.len() > 1000);
    let corners: std::collections::HashSet<usize> = grid.triangles.iter().flatten().copied().collect();
    assert!(corners.iter().all(|k| *k >= first) && corners.len() == grid.points.len() - first);
    let q: Vec<f64> = (0..6 * 53).map(|k| 1e-6 * f64::from(k)).collect();
    let loads: Vec<f64> = (0..18).map(f64::from).collect();
    let text = to_vtu(&grid, &machine_fields(&grid, &q, &loads)).unwrap();
    let cells = 50 + grid.triangles.len() + 2 + 18;
    assert!(text.contains(&format!("NumberOfPoints=\"{}\" NumberOfCells=\"{cells}\"", grid.points.len())));
}

/// Points of a part and their displacements.
fn moved(grid: &Grid, fields: &[Field], part: Part) -> Vec<(Position, Position)> {
    let Values::Vectors(moves) = &fields[0].values else { panic!() };
    assert_eq!(fields[0].name, "displacement");
    let of_part = (0..grid.points.len()).filter(|&k| grid.parts[k] == part);
    of_part.map(|k| (grid.points[k], moves[k])).collect()
}

#[test]
fn vtk_surfaces_move_as_rigid_bodies_with_their_nodes() {
    let model = spindle();
    let grid = Grid::of_machine(&model);
    let nodes = model.node_z.len();
    // Small rotation about one node: u = θ × r with r from that node, by hand for every direction.
    let rotated = |node: usize, centre: Position, part: Part, wanted: &dyn Fn(Position) -> bool| {
        for axis in 0..3 {
            let mut q = vec![0.0; 6 * model.node_count()];
            q[6 * node + 3 + axis] = 1e-3;
            let mut theta = [0.0; 3];
            theta[axis] = 1e-3;
            let all = moved(&grid, &machine_fields(&grid, &q, &[]), part);
            let points: Vec<_> = all.into_iter().filter(|(p, _)| wanted(*p)).collect();
            assert!(points.len() >= 24, "{part:?}: {} points", points.len());
            for (p, u) in points {
                let r = nalgebra::Vector3::from(p) - nalgebra::Vector3::from(centre);
                let exact = nalgebra::Vector3::from(theta).cross(&r);
                let off = (nalgebra::Vector3::from(u) - exact).norm();
                agree::absolute(format_args!("motion of a point of {part:?} off θ × r [m]"), off, 0.0, 1e-9);
            }
        }
    };
    let disc = model.discs[0].node;
    rotated(disc, [0.0, 0.0, model.node_z[disc]], Part::Disc, &|_| true);
    rotated(nodes, model.bodies[0].position, Part::Body, &|_| true);
    // Outer rings are in the block; the rings below a radius of 0.02 m are the inner ones.
    let outer = |p: Position| p[0].hypot(p[1]) > 0.028;
    rotated(nodes, model.bodies[0].position, Part::Ring, &outer);
    let inner = |p: Position| p[0].hypot(p[1]) < 0.019;
    let site = model.bearings[0].node;
    rotated(site, [0.0, 0.0, model.node_z[site]], Part::Ring, &inner);
    // Balls: half of a displacement of the block, half of one of the shaft.
    for node in [nodes, site] {
        let mut q = vec![0.0; 6 * model.node_count()];
        q[6 * node + 1] = 1e-3;
        let balls = moved(&grid, &machine_fields(&grid, &q, &[]), Part::Ball);
        assert!(balls.len() > 100);
        for (_, u) in balls {
            agree::absolute("balls move by half of 1 mm [m]", u[1], 0.5e-3, 1e-15);
        }
    }
}

#[test]
fn exported_modes_have_the_parts_and_their_size() {
    let machine = Machine::new(spindle()).unwrap();
    let modal = machine.modal(machine.model.studies.modal.as_ref().unwrap()).unwrap();
    let results = Results { modal, ..Results::default() };
    let folder = tempfile::tempdir().unwrap();
    export_modes(&results, &machine, folder.path()).unwrap();
    let grid = Grid::of_machine(&machine.model);
    let numbers = |text: &str, name: &str| -> Vec<f64> {
        let body = text.split(&format!("Name=\"{name}\"")).nth(1).unwrap();
        let body = &body[body.find('>').unwrap() + 1..];
        body[..body.find('<').unwrap()].split_whitespace().map(|x| x.parse().unwrap()).collect()
    };
    for k in 1..=10 {
        let text = std::fs::read_to_string(folder.path().join(format!("modes_3000rpm_{k:02}.vtu"))).unwrap();
        let parts = numbers(&text, "part");
        assert_eq!(parts.len(), grid.points.len());
        // All five kinds of part have surfaces.
        for part in 0..5 {
            assert!(parts.iter().filter(|p| **p == f64::from(part)).count() > 20, "part {part}");
        }
        let size = |name: &str| {
            numbers(&text, name).chunks(3).map(|u| u.iter().map(|x| x * x).sum::<f64>()).collect::<Vec<_>>()
        };
        let both: Vec<f64> = size("displacement")
            .iter()
            .zip(size("displacement_quarter"))
            .map(|(a, b)| (a + b).sqrt())
            .collect();
        let largest = both.iter().copied().fold(0.0, f64::max);
        // A tenth of the shaft's length of 0.33 m, less where a rotation of 1 rad comes first.
        assert!(largest < 0.033 * 1.000_001 && largest > 0.003, "mode {k}: {largest}");
        assert!(text.len() < 1_500_000, "{} bytes", text.len());
    }
}
