//! 3D scenes for viewers: one bearing, or the whole machine of a model.

use nalgebra::{Isometry3, Matrix3, Rotation3, UnitQuaternion};

use super::bearing_shapes::{BearingPose, BearingShapes};
use super::mesh::{Length, Mesh};
use super::scene_graph::{Material, MaterialMesh, Node, Scene};
use crate::element::{Disc, RigidBody, ShaftElement};
use crate::model::Model;
use rotordyn_bearing::{BallBearing, BallGeometry};

/// Facets around a body of revolution.
const SECTORS: usize = 96;

const SHAFT: Material =
    Material { name: "shaft", colour: [0.36, 0.40, 0.46, 1.0], metallic: 0.7, roughness: 0.45 };
const DISC: Material =
    Material { name: "disc", colour: [0.10, 0.25, 0.50, 1.0], metallic: 0.4, roughness: 0.5 };
const INNER: Material =
    Material { name: "inner ring", colour: [0.30, 0.42, 0.60, 1.0], metallic: 0.7, roughness: 0.4 };
const OUTER: Material =
    Material { name: "outer ring", colour: [0.50, 0.52, 0.55, 1.0], metallic: 0.7, roughness: 0.4 };
const CAGE: Material =
    Material { name: "cage", colour: [0.70, 0.42, 0.12, 1.0], metallic: 0.6, roughness: 0.5 };
const BALL: Material =
    Material { name: "ball", colour: [0.85, 0.86, 0.88, 1.0], metallic: 0.9, roughness: 0.15 };
const BODY: Material =
    Material { name: "body", colour: [0.45, 0.50, 0.45, 0.35], metallic: 0.1, roughness: 0.8 };

impl Scene {
    /// One row of balls at a placement: nodes "inner ring", "outer ring", "cage", "ball 1" to "ball Z".
    pub fn of_bearing(name: &str, shapes: &BearingShapes, at: &BearingPose) -> Self {
        let mut scene = Self { name: name.into(), ..Self::default() };
        scene.add_row(name, [0.0; 3], shapes, at);
        scene
    }

    /// A ball bearing at rest with all its rows, its station at the origin.
    pub fn of_ball_bearing(name: &str, bearing: &BallBearing) -> Self {
        let mut scene = Self { name: name.into(), ..Self::default() };
        scene.add_bearing(name, 0.0, bearing);
        scene
    }

    /// The machine at rest: shaft, discs, ball bearings, rigid bodies, each one node with one mesh; the parts of
    /// a ball bearing are under a node with its name, those of a pair under "row 1" and "row 2" of it.
    ///
    /// A disc given by inertia alone is drawn as the cylinder, a body as the box that has its mass and
    /// inertias. Linear bearings, bushings and belts have no shape.
    pub fn of_machine(model: &Model) -> Self {
        let mut scene = Self { name: model.name.clone(), ..Self::default() };
        let shaft = Mesh::shaft(&shaft_sections(model), SECTORS);
        if !shaft.triangles.is_empty() {
            scene.part("shaft".into(), shaft, SHAFT, &Isometry3::identity());
        }
        for disc in &model.discs {
            let mesh = disc_mesh(model, disc, SECTORS);
            let at = Isometry3::translation(0.0, 0.0, model.node_z[disc.node]);
            scene.part(disc.name.clone(), mesh, DISC, &at);
        }
        for body in &model.bodies {
            let (edges, turn) = equivalent_box(body);
            let [x, y, z] = body.position;
            let at = Isometry3::from_parts([x, y, z].into(), turn);
            scene.part(body.name.clone(), Mesh::cuboid(edges), BODY, &at);
        }
        for site in &model.bearings {
            if let Some(ball) = site.bearing.ball() {
                scene.add_bearing(&site.name, model.node_z[site.node], ball);
            }
        }
        scene
    }

    fn add_bearing(&mut self, name: &str, z: f64, bearing: &BallBearing) {
        let rows = row_shapes(bearing);
        if let [(_, shapes)] = &rows[..] {
            self.add_row(name, [0.0, 0.0, z], shapes, &shapes.centred(bearing.cage_angle));
            return;
        }
        let parent = self.nodes.len();
        self.nodes.push(Node::translated(name, None, [0.0, 0.0, z]));
        for (k, (offset, shapes)) in rows.iter().enumerate() {
            let row = self.nodes.len();
            let at = shapes.centred(bearing.cage_angle);
            self.add_row(&format!("row {}", k + 1), [0.0, 0.0, *offset], shapes, &at);
            self.nodes[parent].children.push(row);
        }
    }

    fn add_row(&mut self, name: &str, centre: [f64; 3], shapes: &BearingShapes, at: &BearingPose) {
        let parent = self.nodes.len();
        self.nodes.push(Node::translated(name, None, centre));
        let inner = self.part("inner ring".into(), Mesh::ring(&shapes.inner, SECTORS, 24), INNER, &at.inner);
        let still = Isometry3::identity();
        let outer = self.part("outer ring".into(), Mesh::ring(&shapes.outer, SECTORS, 24), OUTER, &still);
        let cage = self.part("cage".into(), Mesh::cage(&shapes.cage, 48, 4), CAGE, &at.cage);
        let ball = self.meshes.len();
        self.meshes.push(MaterialMesh { mesh: Mesh::ball(shapes.ball_diameter, 48), material: BALL });
        let mut children = vec![inner, outer, cage];
        for (j, centre) in at.balls.iter().enumerate() {
            children.push(self.nodes.len());
            self.nodes.push(Node::translated(format!("ball {}", j + 1), Some(ball), centre.coords.into()));
        }
        self.nodes[parent].children = children;
    }

    fn part(&mut self, name: String, mesh: Mesh, look: Material, at: &Isometry3<f64>) -> usize {
        let mut node = Node::translated(name, Some(self.meshes.len()), at.translation.vector.into());
        let q = at.rotation.coords;
        node.rotation = [q.x, q.y, q.z, q.w];
        self.meshes.push(MaterialMesh { mesh, material: look });
        self.nodes.push(node);
        self.nodes.len() - 1
    }
}

/// Axial offset \[m\] and shapes of every row of a ball bearing.
pub fn row_shapes(bearing: &BallBearing) -> Vec<(f64, BearingShapes)> {
    let shapes = |(offset, thrust_direction): (f64, f64)| {
        let geometry = BallGeometry { thrust_direction, ..bearing.geometry.clone() };
        (offset, BearingShapes::new(&geometry, bearing.cage_pocket_diameter))
    };
    bearing.rows().into_iter().map(shapes).collect()
}

/// Sections of the shaft; a rigid rotor is drawn as its cylinder, turned down to the bores of its ball
/// bearings.
pub fn shaft_sections(model: &Model) -> Vec<Length> {
    // of layers what is seen: the outermost surface and the innermost one
    let radius =
        |e: &ShaftElement, end: usize, pick: fn(f64, f64) -> f64, of: fn(&ShaftElement) -> [f64; 2]| {
            0.5 * e.layers.iter().fold(of(e)[end], |d, layer| pick(d, of(layer)[end]))
        };
    let elastic = model.shaft.iter().zip(model.node_z.windows(2)).map(|(e, z)| Length {
        z: [z[0], z[1]],
        outer: [0, 1].map(|end| radius(e, end, f64::max, |e| e.outer_diameter)),
        inner: [0, 1].map(|end| radius(e, end, f64::min, |e| e.inner_diameter)),
    });
    match &model.rigid_rotor {
        None => elastic.collect(),
        Some(rotor) => rigid_sections(model, rotor),
    }
}

fn rigid_sections(model: &Model, rotor: &Disc) -> Vec<Length> {
    let (radius, length) = disc_size(rotor);
    let centre = model.node_z[rotor.node];
    // It extends over every node, even if the length given or derived from its inertia is shorter.
    let start = model.node_z.iter().copied().fold(centre - 0.5 * length, f64::min);
    let end = model.node_z.iter().copied().fold(centre + 0.5 * length, f64::max);
    let seats: Vec<([f64; 2], f64)> = ball_seats(model).filter(|seat| seat.1 < radius).collect();
    let mut cuts: Vec<f64> =
        seats.iter().flat_map(|seat| seat.0).filter(|z| *z > start && *z < end).collect();
    cuts.extend([start, end]);
    cuts.sort_by(f64::total_cmp);
    cuts.dedup();
    let section = |z: &[f64]| {
        let middle = 0.5 * (z[0] + z[1]);
        let at = |seat: &&([f64; 2], f64)| seat.0[0] < middle && middle < seat.0[1];
        let outer = seats.iter().filter(at).map(|seat| seat.1).fold(radius, f64::min);
        Length { z: [z[0], z[1]], outer: [outer; 2], inner: [0.0; 2] }
    };
    cuts.windows(2).map(section).collect()
}

/// Axial extent \[m\] and radius \[m\] of the seat of every ball bearing.
fn ball_seats(model: &Model) -> impl Iterator<Item = ([f64; 2], f64)> {
    model.bearings.iter().filter_map(|site| {
        let ball = site.bearing.ball()?;
        let (z, half) = (model.node_z[site.node], 0.5 * ball.geometry.width);
        Some(([z - half, z + half], 0.5 * ball.geometry.bore))
    })
}

/// Outer diameter of the shaft at a node \[m\], the larger of its two sides.
pub fn shaft_diameter(model: &Model, node: usize) -> f64 {
    if model.rigid_rotor.is_some() {
        let z = model.node_z[node];
        let sections = shaft_sections(model);
        let at = sections.iter().filter(|s| s.z[0] <= z && z <= s.z[1]);
        return at.map(|s| 2.0 * s.outer[0]).fold(0.0, f64::max);
    }
    let at = |k: Option<usize>, end: usize| {
        let layers = k.and_then(|k| model.shaft.get(k)).into_iter().flat_map(ShaftElement::with_layers);
        layers.map(|e| e.outer_diameter[end]).fold(0.0, f64::max)
    };
    at(node.checked_sub(1), 1).max(at(Some(node), 0))
}

/// Radius and thickness as given, else of the solid cylinder with I_p = m R²/2, I_d = m (3 R² + t²)/12.
pub fn disc_size(disc: &Disc) -> (f64, f64) {
    let given = |length: f64, other: f64| if length > 0.0 { length } else { other };
    let radius2 = 2.0 * disc.polar_inertia / disc.mass;
    let thickness2 = 12.0 * disc.diametral_inertia / disc.mass - 3.0 * radius2;
    let radius = radius2.max(0.0).sqrt();
    // A thin disc's inertias may give no thickness; a tenth of the radius is then drawn.
    (given(0.5 * disc.outer_diameter, radius), given(disc.thickness, thickness2.max(0.01 * radius2).sqrt()))
}

/// A disc about its centre, with the shaft's diameter as its bore.
pub fn disc_mesh(model: &Model, disc: &Disc, sectors: usize) -> Mesh {
    let (radius, thickness) = disc_size(disc);
    let bore = 0.5 * shaft_diameter(model, disc.node);
    let inner = if bore < radius { bore } else { 0.0 };
    Mesh::frustum([inner; 2], [radius; 2], [-0.5 * thickness, 0.5 * thickness], sectors)
}

/// Edges and orientation of the homogeneous box with the body's mass and inertias:
/// a² = 6 (I_b + I_c − I_a)/m.
pub fn equivalent_box(body: &RigidBody) -> ([f64; 3], UnitQuaternion<f64>) {
    let tensor = Matrix3::from_fn(|i, j| body.inertia[i][j]);
    let diagonal = tensor.diagonal();
    let off = (tensor - Matrix3::from_diagonal(&diagonal)).amax();
    // A diagonal tensor keeps the model's axes; eigenvectors of equal moments would be arbitrary.
    let (moments, turn) = if off <= 1e-9 * diagonal.amax() {
        (diagonal, UnitQuaternion::identity())
    } else {
        let eigen = tensor.symmetric_eigen();
        let mut axes = eigen.eigenvectors;
        if axes.determinant() < 0.0 {
            axes.column_mut(2).neg_mut();
        }
        (eigen.eigenvalues, UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(axes)))
    };
    let trace = moments.sum();
    let mass = body.mass.iter().sum::<f64>() / 3.0;
    // A point mass, or a body with physically impossible inertias, is drawn with edges of 10 mm.
    let edge = |k: usize| (6.0 * (trace - 2.0 * moments[k]) / mass).max(1e-4).sqrt();
    ([edge(0), edge(1), edge(2)], turn)
}
