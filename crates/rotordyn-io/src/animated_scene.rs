//! The scene of a machine in motion: nodes with their places over time.

use nalgebra::{Isometry3, Quaternion, Translation3, UnitQuaternion, Vector3};
use rotordyn_core::geometry::scene_graph::{Material, MaterialMesh, Node, Scene};
use rotordyn_core::model::{BearingSite, Model};
use rotordyn_core::results::{BearingMotion, BodyMotion, Motion};

/// Marks that show rotation.
const MARK: Material =
    Material { name: "mark", colour: [0.55, 0.04, 0.03, 1.0], metallic: 0.0, roughness: 0.6 };
/// Metallic share of balls: a mirror would show its surroundings instead of the marks.
const BALL_METALLIC: f64 = 0.2;
/// Half the angle of the mark of rings, cage and shaft \[rad\].
const MARK_HALF_ANGLE: f64 = 0.09;
/// Opacity of outer rings, behind which balls and cage are seen.
const OUTER_OPACITY: f64 = 0.25;

/// A scene whose nodes move.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct AnimatedScene {
    pub scene: Scene,
    /// Times \[s\] of the places.
    pub time: Vec<f64>,
    pub tracks: Vec<Track>,
}

/// Places of a node over time, relative to its parent.
#[derive(Clone, Debug, PartialEq)]
pub struct Track {
    pub node: usize,
    /// \[m\].
    pub translation: Vec<[f64; 3]>,
    /// Unit quaternions x, y, z, w, each on the side of the one before.
    pub rotation: Vec<[f64; 4]>,
}

impl AnimatedScene {
    /// The machine in a recorded motion, with the names of [`Scene::of_machine`] and marks that show rotation: the shaft
    /// turns as a rigid body; discs and rings move with their nodes; cages and balls as free bodies, or with a cage that
    /// rolls. Rigid bodies around the shaft, such as housings, are left out.
    pub fn of_motion(model: &Model, motion: &Motion) -> Self {
        let mut scene = Scene::of_machine(&Model { bodies: Vec::new(), ..model.clone() });
        for MaterialMesh { material, .. } in &mut scene.meshes {
            match material.name {
                "outer ring" => material.colour[3] = OUTER_OPACITY,
                "ball" => material.metallic = BALL_METALLIC,
                _ => {}
            }
        }
        add_marks(&mut scene);
        let mut out = Self { scene, time: motion.time.clone(), tracks: Vec::new() };
        let frames = 0..motion.time.len();
        let spin = |frame: usize| about_z(motion.shaft_angle[frame]);
        if let Some(shaft) = out.root("shaft") {
            out.track(
                shaft,
                frames.clone().map(|k| Isometry3::from_parts(Translation3::identity(), spin(k))),
            );
        }
        let on_node = |node: usize, frame: usize| displaced(&motion.displacement[frame], node, [0.0; 3]);
        for disc in &model.discs {
            let Some(node) = out.root(&disc.name) else { continue };
            let z = model.node_z[disc.node];
            let place = |k: usize| Translation3::new(0.0, 0.0, z) * on_node(disc.node, k) * spin(k);
            out.track(node, frames.clone().map(place));
        }
        for site in &model.bearings {
            let (Some(parent), Some(recorded)) = (out.root(&site.name), motion.bearing(&site.name)) else {
                continue;
            };
            let rows: Vec<usize> = match out.child(parent, "row 1") {
                None => vec![parent],
                Some(_) => out.scene.nodes[parent].children.clone(),
            };
            for row in rows {
                out.bearing(row, site, recorded, motion);
            }
        }
        out
    }

    /// Tracks of the parts of one row of a bearing.
    fn bearing(&mut self, row: usize, site: &BearingSite, recorded: &BearingMotion, motion: &Motion) {
        let frames = 0..motion.time.len();
        let inner = |k: usize| displaced(&motion.displacement[k], site.node, [0.0; 3]);
        let outer = |k: usize| match site.housing.node {
            Some(node) => displaced(&motion.displacement[k], node, site.housing.offset),
            None => Isometry3::identity(),
        };
        if let Some(node) = self.child(row, "inner ring") {
            self.track(node, frames.clone().map(|k| inner(k) * about_z(motion.shaft_angle[k])));
        }
        if let Some(node) = self.child(row, "outer ring") {
            self.track(node, frames.clone().map(outer));
        }
        let balls: Vec<usize> = (1..).map_while(|j| self.child(row, &format!("ball {j}"))).collect();
        let cage = self.child(row, "cage");
        if recorded.bodies.len() >= balls.len() {
            for (node, body) in balls.iter().zip(&recorded.bodies) {
                self.track(*node, frames.clone().map(|k| place(body, k)));
            }
            match (cage, recorded.bodies.get(balls.len())) {
                // The mesh of the cage stands in the plane of the balls, its body has its centre there.
                (Some(cage), Some(body)) => {
                    let ball = balls.first().map_or(0.0, |ball| self.scene.nodes[*ball].translation[2]);
                    let down = Translation3::new(0.0, 0.0, -ball);
                    self.track(cage, frames.map(|k| place(body, k) * down));
                }
                (Some(cage), None) => self.hide(cage, row),
                _ => {}
            }
            return;
        }
        // At rest they stand at the cage angle of the model; the balls move with the mean of both rings.
        let start = site.bearing.ball().map_or(0.0, |ball| ball.cage_angle);
        let turned = |k: usize| {
            let centre = 0.5 * (inner(k).translation.vector + outer(k).translation.vector);
            Translation3::from(centre) * about_z(recorded.cage_angle[k] - start)
        };
        let at_rest = |node: usize| isometry(&self.scene.nodes[node]);
        let rolling: Vec<(usize, Isometry3<f64>)> =
            balls.iter().chain(&cage).map(|node| (*node, at_rest(*node))).collect();
        for (node, rest) in rolling {
            self.track(node, frames.clone().map(|k| turned(k) * rest));
        }
    }

    /// Track of a child of the top node `parent`, by their names.
    pub fn track_of(&self, parent: &str, child: &str) -> Option<&Track> {
        let node = self.child(self.root(parent)?, child)?;
        self.tracks.iter().find(|track| track.node == node)
    }

    fn root(&self, name: &str) -> Option<usize> {
        self.scene.nodes.iter().position(|node| node.name == name)
    }

    fn child(&self, parent: usize, name: &str) -> Option<usize> {
        let children = &self.scene.nodes[parent].children;
        children.iter().copied().find(|child| self.scene.nodes[*child].name == name)
    }

    /// A full complement of balls has no cage.
    fn hide(&mut self, node: usize, parent: usize) {
        self.scene.nodes[parent].children.retain(|child| *child != node);
        self.scene.nodes[node].mesh = None;
        self.scene.nodes[node].children.clear();
    }

    fn track(&mut self, node: usize, places: impl Iterator<Item = Isometry3<f64>>) {
        let mut track = Track { node, translation: Vec::new(), rotation: Vec::new() };
        for place in places {
            track.translation.push(place.translation.vector.into());
            let q = place.rotation.coords;
            let q = [q.x, q.y, q.z, q.w];
            let same_side = track.rotation.last().is_none_or(|last| dot(last, &q) >= 0.0);
            track.rotation.push(if same_side { q } else { q.map(|part| -part) });
        }
        self.tracks.push(track);
    }
}

/// Marks as children of the nodes whose mesh they were cut out of: every other octant of a ball, a sector of the
/// inner ring, the cage and the shaft.
fn add_marks(scene: &mut Scene) {
    for number in 0..scene.meshes.len() {
        let MaterialMesh { mesh, material } = &scene.meshes[number];
        let [mark, rest] = match material.name {
            "ball" => mesh.split(|[x, y, z]| x * y * z > 0.0),
            "inner ring" | "cage" | "shaft" | "disc" => {
                mesh.split(|[x, y, _]| y.atan2(x).abs() < MARK_HALF_ANGLE)
            }
            _ => continue,
        };
        if mark.triangles.is_empty() || rest.triangles.is_empty() {
            continue;
        }
        scene.meshes[number].mesh = rest;
        let mark_number = scene.meshes.len();
        scene.meshes.push(MaterialMesh { mesh: mark, material: MARK });
        for node in 0..scene.nodes.len() {
            if scene.nodes[node].mesh == Some(number) {
                let child = scene.nodes.len();
                scene.nodes.push(Node::translated("mark", Some(mark_number), [0.0; 3]));
                scene.nodes[node].children.push(child);
            }
        }
    }
}

fn about_z(angle: f64) -> UnitQuaternion<f64> {
    UnitQuaternion::from_axis_angle(&Vector3::z_axis(), angle)
}

/// Displacement of a point at an arm from a node, by six displacements per node.
fn displaced(displacement: &[f64], node: usize, arm: [f64; 3]) -> Isometry3<f64> {
    let Some(&[x, y, z, a, b, c]) = displacement.get(6 * node..).and_then(|q| q.first_chunk()) else {
        return Isometry3::identity();
    };
    let tilt = Vector3::new(a, b, c);
    let moved = Vector3::new(x, y, z) + tilt.cross(&Vector3::from(arm));
    Isometry3::new(moved, tilt)
}

fn place(body: &BodyMotion, frame: usize) -> Isometry3<f64> {
    let [w, x, y, z] = body.orientation[frame];
    let turn = UnitQuaternion::new_normalize(Quaternion::new(w, x, y, z));
    Isometry3::from_parts(Translation3::from(body.position[frame]), turn)
}

fn isometry(node: &Node) -> Isometry3<f64> {
    let [x, y, z, w] = node.rotation;
    let turn = UnitQuaternion::new_normalize(Quaternion::new(w, x, y, z));
    Isometry3::from_parts(Translation3::from(node.translation), turn)
}

fn dot(a: &[f64; 4], b: &[f64; 4]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}
