//! The machine as points, lines and surfaces for VTK, each point with the node that it moves with.

use super::vtk::{Carrier, Grid, Part};
use rotordyn_core::element::Anchor;
use rotordyn_core::geometry::mesh::{Length, Mesh};
use rotordyn_core::geometry::scene;
use rotordyn_core::model::{BearingSite, Model};

/// Facets around the shaft and rings, a disc, and a ball.
const SECTORS: usize = 16;
const DISC_SECTORS: usize = 32;
const BALL_SECTORS: usize = 8;

impl Grid {
    /// The machine: shaft nodes joined by lines, centres of bodies, centres of the balls of every ball bearing in
    /// order; then the surfaces of shaft, discs, bodies, rings and balls.
    ///
    /// Inner rings move with the shaft, outer rings with their housing, balls with the mean of both.
    pub fn of_machine(model: &Model) -> Self {
        Self::of_machine_with(model, true)
    }

    /// The machine with the balls of its bearings, or without them, so that those in motion can be added.
    pub(super) fn of_machine_with(model: &Model, balls: bool) -> Self {
        let mut grid = Self::default();
        let nodes = model.node_z.len();
        for (node, &z) in model.node_z.iter().enumerate() {
            grid.add([0.0, 0.0, z], fixed(node, [0.0; 3]), Part::Shaft);
        }
        grid.lines = (1..nodes).map(|k| [k - 1, k]).collect();
        for (k, body) in model.bodies.iter().enumerate() {
            grid.add(body.position, fixed(nodes + k, [0.0; 3]), Part::Body);
        }
        for site in model.bearings.iter().filter(|_| balls) {
            for (centre, arm) in ball_centres(model, site) {
                grid.add(centre, between_rings(site, arm), Part::Ball);
            }
        }
        grid.add_shaft(model);
        for disc in &model.discs {
            let centre = [0.0, 0.0, model.node_z[disc.node]];
            let mesh = scene::disc_mesh(model, disc, DISC_SECTORS);
            grid.add_mesh(&mesh, Part::Disc, |p| (add(centre, p), fixed(disc.node, p)));
        }
        for (k, body) in model.bodies.iter().enumerate() {
            let (edges, turn) = scene::equivalent_box(body);
            grid.add_mesh(&Mesh::cuboid(edges), Part::Body, |p| {
                let arm: [f64; 3] = (turn * nalgebra::Vector3::from(p)).into();
                (add(body.position, arm), fixed(nodes + k, arm))
            });
        }
        for site in &model.bearings {
            grid.add_bearing(model, site, balls);
        }
        grid
    }

    /// Outer surface of the shaft with its ends; the bore is not drawn.
    fn add_shaft(&mut self, model: &Model) {
        let lengths = scene::shaft_sections(model);
        // The rigid rotor is one body, else length k is between nodes k and k + 1.
        let rotor = model.rigid_rotor.as_ref().map(|rotor| rotor.node);
        let mut rings: Vec<(usize, f64, f64)> = Vec::new();
        for (k, Length { z, outer, .. }) in lengths.iter().enumerate() {
            for end in [0, 1] {
                let ring = (rotor.unwrap_or(k + end), z[end], outer[end]);
                if rings.last() != Some(&ring) {
                    rings.push(ring);
                }
            }
        }
        let first = self.points.len();
        for &(node, z, radius) in &rings {
            for k in 0..SECTORS {
                let (sin, cos) = (std::f64::consts::TAU * k as f64 / SECTORS as f64).sin_cos();
                let at = [radius * cos, radius * sin, z];
                let from = [0.0, 0.0, model.node_z.get(node).copied().unwrap_or(z)];
                self.add(at.map(rounded), fixed(node, [0, 1, 2].map(|i| at[i] - from[i])), Part::Shaft);
            }
        }
        let at = |ring: usize, k: usize| first + ring * SECTORS + k % SECTORS;
        for ring in 1..rings.len() {
            for k in 0..SECTORS {
                let (a, b) = (at(ring - 1, k), at(ring - 1, k + 1));
                let (c, d) = (at(ring, k), at(ring, k + 1));
                self.triangles.extend([[a, b, d], [a, d, c]]);
            }
        }
        let Some(last) = rings.len().checked_sub(1) else { return };
        for k in 1..SECTORS - 1 {
            self.triangles.push([at(0, 0), at(0, k + 1), at(0, k)]);
            self.triangles.push([at(last, 0), at(last, k), at(last, k + 1)]);
        }
    }

    /// Rings of a ball bearing, and its balls.
    fn add_bearing(&mut self, model: &Model, site: &BearingSite, balls: bool) {
        let Some(ball) = site.bearing.ball() else { return };
        let z = model.node_z[site.node];
        for (offset, shapes) in scene::row_shapes(ball) {
            let arm = |p: [f64; 3]| add(p, [0.0, 0.0, offset]);
            let centre = [0.0, 0.0, z];
            self.add_mesh(&Mesh::ring(&shapes.inner, SECTORS, 3), Part::Ring, |p| {
                (add(centre, arm(p)), fixed(site.node, arm(p)))
            });
            self.add_mesh(&Mesh::ring(&shapes.outer, SECTORS, 3), Part::Ring, |p| {
                (add(centre, arm(p)), on_housing(&site.housing, arm(p), 1.0).into_iter().collect())
            });
        }
        if !balls {
            return;
        }
        let sphere = Mesh::ball(ball.geometry.ball_diameter, BALL_SECTORS);
        for (centre, arm) in ball_centres(model, site) {
            // A ball is displaced as a whole.
            self.add_mesh(&sphere, Part::Ball, |p| (add(centre, p), between_rings(site, arm)));
        }
    }

    pub(super) fn add_mesh(
        &mut self,
        mesh: &Mesh,
        part: Part,
        place: impl Fn([f64; 3]) -> ([f64; 3], Vec<Carrier>),
    ) {
        // Poles of a mesh of revolution have corners without a triangle.
        let mut index = vec![None; mesh.positions.len()];
        for corners in &mesh.triangles {
            let mut point = |k: u32| {
                let k = k as usize;
                *index[k].get_or_insert_with(|| {
                    let (at, carriers) = place(mesh.positions[k]);
                    self.add(at.map(rounded), carriers, part);
                    self.points.len() - 1
                })
            };
            let triangle = corners.map(&mut point);
            self.triangles.push(triangle);
        }
    }

    pub(super) fn add(&mut self, at: [f64; 3], carriers: Vec<Carrier>, part: Part) {
        self.points.push(at);
        self.carriers.push(carriers);
        self.parts.push(part);
    }
}

/// Centres of the balls of every row \[m\], and from the bearing's station.
fn ball_centres(model: &Model, site: &BearingSite) -> Vec<([f64; 3], [f64; 3])> {
    let Some(ball) = site.bearing.ball() else { return Vec::new() };
    let z = model.node_z[site.node];
    let rows = scene::row_shapes(ball).into_iter();
    rows.flat_map(|(offset, shapes)| {
        let centres = shapes.centred(ball.cage_angle).balls;
        centres.into_iter().map(move |c| ([c.x, c.y, z + offset + c.z], [c.x, c.y, offset + c.z]))
    })
    .collect()
}

/// On the shaft or a body: the whole motion of a node.
fn fixed(node: usize, arm: [f64; 3]) -> Vec<Carrier> {
    vec![Carrier { node, arm, weight: 1.0 }]
}

/// At an arm from the bearing's centre on its housing; nothing on the ground.
fn on_housing(housing: &Anchor, arm: [f64; 3], weight: f64) -> Option<Carrier> {
    Some(Carrier { node: housing.node?, arm: add(housing.offset, arm), weight })
}

/// Half with the shaft, half with the housing.
fn between_rings(site: &BearingSite, arm: [f64; 3]) -> Vec<Carrier> {
    let shaft = Carrier { node: site.node, arm, weight: 0.5 };
    std::iter::once(shaft).chain(on_housing(&site.housing, arm, 0.5)).collect()
}

fn add(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [0, 1, 2].map(|i| a[i] + b[i])
}

/// Seven significant digits, to keep the files small.
pub(super) fn rounded(x: f64) -> f64 {
    format!("{x:.6e}").parse().unwrap_or(x)
}
