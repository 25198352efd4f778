//! The recorded motion of a machine for ParaView: one .vtu per frame, and the .pvd of all.

use crate::animated_scene::{AnimatedScene, Track};
use crate::atomic_file;
use crate::error::Error;
use crate::vtk::{Field, Grid, Part, Values, machine_fields, part_field, to_binary_vtu, write_pvd};
use nalgebra::{Quaternion, UnitQuaternion, Vector3};
use rotordyn_core::geometry::mesh::Mesh;
use rotordyn_core::geometry::scene;
use rotordyn_core::model::Model;
use rotordyn_core::results::{BodyMotion, Motion};
use std::path::{Path, PathBuf};

/// Facets around a ball, and around a pocket of a cage.
const BALL_SECTORS: usize = 16;
const POCKET_SECTORS: usize = 16;

type V = Vector3<f64>;

/// A ball or a cage: its points, and where it is.
struct Body<'a> {
    track: &'a Track,
    /// Motion with angular velocity and forces, of a free body.
    free: Option<&'a BodyMotion>,
    /// Number of a ball from 1; 0 for a cage.
    ball: usize,
    /// Axial place of its bearing, and place of its own in it: radius and axial position \[m\].
    bearing_z: f64,
    nominal: [f64; 2],
    first: usize,
    /// Points in its own axes.
    points: Vec<V>,
}

/// Values of the points of all bodies in a frame, behind those of the machine at rest.
struct Frame {
    displacement: Vec<[f64; 3]>,
    rotation: Vec<[f64; 3]>,
    angular_velocity: Vec<[f64; 3]>,
    /// Inner load, outer load, pocket force.
    forces: [Vec<f64>; 3],
}

/// Writes every frame as `motion/motion_<number>.vtu`, and `motion.pvd` over the time \[s\], which is returned.
///
/// Points plus `displacement` are the positions of the run, as for mode shapes: shaft, discs, rings and bodies stand where they
/// are at rest; a ball stands on the pitch circle at its own angle, a cage at the centre of its bearing, both turned.
/// `rotation` \[rad\] is that of the node, and the rotation vector of balls and cages since the first frame (cage: since
/// angle 0); free bodies have `angular_velocity` \[rad/s\], their balls `inner_load`, `outer_load` and
/// `pocket_force` \[N\]. `ball`: number of the ball from 1; `mark`: 1 on the marks that show rotation; `part` as for
/// mode shapes, and 5 for cages.
///
/// # Errors
/// A file cannot be written.
pub fn export_motion(
    motion: &Motion,
    animated: &AnimatedScene,
    model: &Model,
    folder: &Path,
) -> Result<PathBuf, Error> {
    let mut grid = Grid::of_machine_with(model, false);
    let at_rest = grid.points.len();
    let bodies = bodies(&mut grid, motion, animated, model);
    let mut still = vec![part_field(&grid), ball_numbers(&grid, &bodies), marks(&grid, &bodies)];
    let frames_folder = folder.join("motion");
    std::fs::create_dir_all(&frames_folder).map_err(Error::of_file("create folder", &frames_folder))?;
    let mut files = Vec::new();
    for (k, time) in motion.time.iter().enumerate() {
        let mut fields = machine_fields(&grid, &motion.displacement[k], &[]);
        fields.retain(|field| matches!(field.values, Values::Vectors(_)));
        let frame = Frame::of(&bodies, &mut grid, at_rest, k);
        frame.write_to(&mut fields, at_rest);
        fields.append(&mut still.clone());
        let name = format!("motion/motion_{k:05}.vtu");
        let path = folder.join(&name);
        let bytes = to_binary_vtu(&grid, &fields).map_err(Error::of_file("write", &path))?;
        atomic_file::write_derived(&path, &bytes).map_err(Error::of_file("write", &path))?;
        files.push((*time, name));
    }
    still.clear();
    let path = folder.join("motion.pvd");
    write_pvd(&path, &files)?;
    Ok(path)
}

/// Adds the points of balls and cages to a grid, at their centre.
fn bodies<'a>(
    grid: &mut Grid,
    motion: &'a Motion,
    animated: &'a AnimatedScene,
    model: &Model,
) -> Vec<Body<'a>> {
    let mut bodies = Vec::new();
    for site in &model.bearings {
        let (Some(ball), Some(recorded)) = (site.bearing.ball(), motion.bearing(&site.name)) else {
            continue;
        };
        // Rows of a pair have no free balls; they are drawn by the rings alone.
        let [(_, shapes)] = &scene::row_shapes(ball)[..] else { continue };
        let [radius, z] = shapes.ball_centre;
        let mut add = |name: &str, number: usize, part: Part, mesh: &Mesh, nominal: [f64; 2], down: f64| {
            let Some(track) = animated.track_of(&site.name, name) else { return };
            let first = grid.points.len();
            // A point at the centre, for glyphs.
            grid.add([0.0; 3], Vec::new(), part);
            grid.add_mesh(mesh, part, |p| (p, Vec::new()));
            let points = grid.points[first..].iter().map(|p| V::from(*p) + V::new(0.0, 0.0, down)).collect();
            let free = recorded.bodies.get(if number > 0 { number - 1 } else { recorded.balls });
            let free = free.filter(|_| !recorded.bodies.is_empty());
            let bearing_z = model.node_z[site.node];
            bodies.push(Body { track, free, ball: number, bearing_z, nominal, first, points });
        };
        let sphere = Mesh::ball(shapes.ball_diameter, BALL_SECTORS);
        for j in 1..=shapes.balls {
            add(&format!("ball {j}"), j, Part::Ball, &sphere, [radius, z], 0.0);
        }
        add("cage", 0, Part::Cage, &Mesh::cage(&shapes.cage, POCKET_SECTORS, 1), [0.0, 0.0], 0.0);
    }
    bodies
}

fn ball_numbers(grid: &Grid, bodies: &[Body]) -> Field {
    let mut numbers = vec![0.0; grid.points.len()];
    for body in bodies {
        numbers[body.first..body.first + body.points.len()].fill(body.ball as f64);
    }
    Field { name: "ball".into(), values: Values::Scalars(numbers) }
}

/// 1 in every other octant of a ball and in a sector of a cage.
fn marks(grid: &Grid, bodies: &[Body]) -> Field {
    let mut marks = vec![0.0; grid.points.len()];
    for body in bodies {
        for (mark, p) in marks[body.first..].iter_mut().zip(&body.points) {
            let marked = match body.ball {
                0 => p.y.atan2(p.x).abs() < 0.1,
                _ => p.x * p.y * p.z > 0.0,
            };
            *mark = f64::from(u8::from(marked));
        }
    }
    Field { name: "mark".into(), values: Values::Scalars(marks) }
}

impl Frame {
    /// Values of frame `k`; the points of the bodies are written to the grid.
    fn of(bodies: &[Body], grid: &mut Grid, at_rest: usize, k: usize) -> Self {
        let count = grid.points.len() - at_rest;
        let zeros = || vec![[0.0; 3]; count];
        let mut out = Self {
            displacement: zeros(),
            rotation: zeros(),
            angular_velocity: zeros(),
            forces: std::array::from_fn(|_| vec![0.0; count]),
        };
        for body in bodies {
            let centre = V::from(body.track.translation[k]);
            let [x, y, z, w] = body.track.rotation[k];
            let turn = UnitQuaternion::new_normalize(Quaternion::new(w, x, y, z));
            let [radius, height] = body.nominal;
            let outward = V::new(centre.x, centre.y, 0.0);
            let nominal = match outward.norm() {
                distance if radius > 0.0 && distance > 0.0 => outward * (radius / distance),
                _ => V::zeros(),
            } + V::new(0.0, 0.0, height);
            let own = body.first - at_rest..body.first - at_rest + body.points.len();
            for (k, point) in own.clone().zip(&body.points) {
                let place = nominal + turn * point + V::new(0.0, 0.0, body.bearing_z);
                grid.points[at_rest + k] = place.into();
            }
            out.displacement[own.clone()].fill((centre - nominal).into());
            out.rotation[own.clone()].fill(turn.scaled_axis().into());
            let Some(free) = body.free else { continue };
            out.angular_velocity[own.clone()].fill(free.rotation[k]);
            for (field, force) in out.forces.iter_mut().zip(free.forces[k]) {
                field[own.clone()].fill(force);
            }
        }
        out
    }

    /// Writes the values behind those of the machine at rest, in fields of all points.
    fn write_to(self, fields: &mut Vec<Field>, at_rest: usize) {
        let before = |count: usize| vec![0.0; count];
        for (field, own) in fields.iter_mut().zip([self.displacement, self.rotation]) {
            if let Values::Vectors(values) = &mut field.values {
                values.truncate(at_rest);
                values.extend(own);
            }
        }
        let mut angular_velocity = vec![[0.0; 3]; at_rest];
        angular_velocity.extend(self.angular_velocity);
        fields.push(Field { name: "angular_velocity".into(), values: Values::Vectors(angular_velocity) });
        for (name, own) in ["inner_load", "outer_load", "pocket_force"].into_iter().zip(self.forces) {
            let mut values = before(at_rest);
            values.extend(own);
            fields.push(Field { name: name.into(), values: Values::Scalars(values) });
        }
    }
}
