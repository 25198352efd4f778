//! Triangle meshes of bodies of revolution, boxes and cages, for viewing.

use std::f64::consts::{PI, TAU};

use super::cage::CageShape;
use super::ring::Ring;

/// Triangles with a normal at every vertex, lengths \[m\]; counter-clockwise seen from outside.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mesh {
    pub positions: Vec<[f64; 3]>,
    pub normals: Vec<[f64; 3]>,
    pub triangles: Vec<[u32; 3]>,
}

impl Mesh {
    /// Revolves smooth pieces of an outline (r, z), counter-clockwise in that plane, about z.
    pub fn revolved(pieces: &[Vec<[f64; 2]>], sectors: usize) -> Self {
        let mut mesh = Self::default();
        for piece in pieces.iter().filter(|p| p.len() > 1) {
            let normals = outline_normals(piece);
            let rows: Vec<u32> = piece
                .iter()
                .zip(&normals)
                .map(|(&[r, z], &[nr, nz])| {
                    let first = mesh.positions.len() as u32;
                    for k in 0..=sectors {
                        // The last column is bit-identical to the first.
                        let (sin, cos) = (TAU * (k % sectors) as f64 / sectors as f64).sin_cos();
                        mesh.vertex([r * cos, r * sin, z], [nr * cos, nr * sin, nz]);
                    }
                    first
                })
                .collect();
            for (i, row) in rows.windows(2).enumerate() {
                for k in 0..sectors as u32 {
                    let (a, b, c, d) = (row[0] + k, row[0] + k + 1, row[1] + k, row[1] + k + 1);
                    // On the axis one of the two triangles has no area.
                    if piece[i][0] > 0.0 {
                        mesh.triangles.push([a, b, c]);
                    }
                    if piece[i + 1][0] > 0.0 {
                        mesh.triangles.push([c, b, d]);
                    }
                }
            }
        }
        mesh
    }

    /// Ball of a given diameter about the origin.
    pub fn ball(diameter: f64, sectors: usize) -> Self {
        let rows = (sectors / 2).max(2);
        let outline = (0..=rows)
            .map(|i| {
                let angle = PI * (i as f64 / rows as f64 - 0.5);
                let on_axis = i == 0 || i == rows;
                [if on_axis { 0.0 } else { 0.5 * diameter * angle.cos() }, 0.5 * diameter * angle.sin()]
            })
            .collect();
        Self::revolved(&[outline], sectors)
    }

    /// Hollow, possibly conical body: inner and outer radius at the lower and the upper z.
    pub fn frustum(inner: [f64; 2], outer: [f64; 2], z: [f64; 2], sectors: usize) -> Self {
        let mut pieces = vec![
            vec![[inner[0], z[0]], [outer[0], z[0]]],
            vec![[outer[0], z[0]], [outer[1], z[1]]],
            vec![[outer[1], z[1]], [inner[1], z[1]]],
        ];
        if inner[0] > 0.0 || inner[1] > 0.0 {
            pieces.push(vec![[inner[1], z[1]], [inner[0], z[0]]]);
        }
        Self::revolved(&pieces, sectors)
    }

    /// Solid of revolution from lengths in a row, possibly tapered or hollow: one closed surface, smooth where
    /// lengths continue each other, with steps between different radii as faces.
    pub fn shaft(lengths: &[Length], sectors: usize) -> Self {
        let mut pieces: Vec<Vec<[f64; 2]>> = Vec::new();
        let (Some(first), Some(last)) = (lengths.first(), lengths.last()) else { return Self::default() };
        let face = |from: f64, to: f64, z: f64| vec![[from, z], [to, z]];
        pieces.push(face(first.inner[0], first.outer[0], first.z[0]));
        for (k, length) in lengths.iter().enumerate() {
            pieces.push(vec![[length.outer[0], length.z[0]], [length.outer[1], length.z[1]]]);
            if let Some(next) = lengths.get(k + 1) {
                pieces.push(face(length.outer[1], next.outer[0], length.z[1]));
            }
        }
        pieces.push(face(last.outer[1], last.inner[1], last.z[1]));
        for (k, length) in lengths.iter().enumerate().rev() {
            pieces.push(vec![[length.inner[1], length.z[1]], [length.inner[0], length.z[0]]]);
            if let Some(before) = k.checked_sub(1).map(|k| &lengths[k]) {
                pieces.push(face(length.inner[0], before.inner[1], length.z[0]));
            }
        }
        // Faces without height and bores without radius have no surface.
        pieces.retain(|p| p[0] != p[1] && p.iter().any(|point| point[0] > 0.0));
        Self::revolved(&joined_smoothly(&pieces), sectors)
    }

    /// Ring of a bearing, its groove in `rows` rows of facets.
    pub fn ring(ring: &Ring, sectors: usize, rows: usize) -> Self {
        let arc = ring.groove_arc(rows + 1);
        let (back, shoulder) = (ring.seat_radius, ring.shoulder_radius);
        let [low, high] = ring.faces;
        let (start, end) = (arc[0], arc[arc.len() - 1]);
        // Counter-clockwise for an inner ring, whose groove faces outwards.
        let mut pieces = vec![
            vec![[back, low], [shoulder, low]],
            vec![[shoulder, low], start],
            arc,
            vec![end, [shoulder, high]],
            vec![[shoulder, high], [back, high]],
            vec![[back, high], [back, low]],
        ];
        if ring.sense() > 0.0 {
            pieces.iter_mut().for_each(|p| p.reverse());
        }
        Self::revolved(&pieces, sectors)
    }

    /// The triangles whose centre is in a part of space, and the others.
    pub fn split(&self, is_inside: impl Fn([f64; 3]) -> bool) -> [Self; 2] {
        let mut parts = [Self::default(), Self::default()];
        let mut index = [vec![None; self.positions.len()], vec![None; self.positions.len()]];
        for corners in &self.triangles {
            let at = |i: usize| corners.iter().map(|&k| self.positions[k as usize][i]).sum::<f64>() / 3.0;
            let side = usize::from(!is_inside([at(0), at(1), at(2)]));
            let (part, index) = (&mut parts[side], &mut index[side]);
            let triangle = corners.map(|k| {
                let k = k as usize;
                *index[k].get_or_insert_with(|| {
                    part.vertex(self.positions[k], self.normals[k]);
                    part.positions.len() as u32 - 1
                })
            });
            part.triangles.push(triangle);
        }
        parts
    }

    /// Box of given edge lengths about the origin.
    pub fn cuboid(edges: [f64; 3]) -> Self {
        let mut mesh = Self::default();
        for axis in 0..3 {
            for sign in [-1.0, 1.0] {
                let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
                let first = mesh.positions.len() as u32;
                for (a, b) in [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)] {
                    let mut p = [0.0; 3];
                    p[axis] = 0.5 * sign * edges[axis];
                    p[u] = 0.5 * sign * a * edges[u];
                    p[v] = 0.5 * b * edges[v];
                    let mut n = [0.0; 3];
                    n[axis] = sign;
                    mesh.vertex(p, n);
                }
                mesh.triangles.push([first, first + 1, first + 2]);
                mesh.triangles.push([first, first + 2, first + 3]);
            }
        }
        mesh
    }

    /// Cage: per pocket a sector of the wall with a round hole, `around` (a multiple of 8) facets round it in
    /// `rings` rings out to the sector's border.
    pub fn cage(cage: &CageShape, around: usize, rings: usize) -> Self {
        let mut mesh = Self::default();
        for j in 0..cage.pockets {
            mesh.cage_sector(cage, TAU * j as f64 / cage.pockets as f64, [around, rings]);
        }
        mesh
    }

    fn cage_sector(&mut self, cage: &CageShape, middle: f64, [around, rings]: [usize; 2]) {
        let half_sector = PI / cage.pockets as f64;
        let a = cage.pocket_radius;
        let angle = |k: usize| TAU * (k % around) as f64 / around as f64;
        // (φ, z) on a cylinder of radius r: level 0 is the hole's edge, the last one the sector's border.
        let wall = |r: f64, level: usize, k: usize| {
            let (sin, cos) = angle(k).sin_cos();
            let share = level as f64 / rings as f64;
            let largest = cos.abs().max(sin.abs());
            let hole = [(a * cos / r).asin(), a * sin];
            let border = [half_sector * cos / largest, 0.5 * cage.width * sin / largest];
            let at = |i: usize| hole[i] + share * (border[i] - hole[i]);
            (middle + at(0), cage.centre_z + at(1))
        };
        let on = |r: f64, (phi, z): (f64, f64)| [r * phi.cos(), r * phi.sin(), z];
        for (r, side) in [(cage.radii[1], 1.0), (cage.radii[0], -1.0)] {
            let first = self.positions.len() as u32;
            for level in 0..=rings {
                for k in 0..=around {
                    let at = wall(r, level, k);
                    self.vertex(on(r, at), [side * at.0.cos(), side * at.0.sin(), 0.0]);
                }
            }
            self.grid(first, rings, around, side < 0.0);
        }
        let first = self.positions.len() as u32;
        for r in cage.radii {
            for k in 0..=around {
                let (sin, cos) = angle(k).sin_cos();
                self.vertex(on(r, wall(r, 0, k)), [cos * middle.sin(), -cos * middle.cos(), -sin]);
            }
        }
        self.grid(first, 1, around, false);
        for k in 0..around {
            let sides = [angle(k), angle(k + 1)]
                .map(|t| if t.sin().abs() >= t.cos().abs() - 1e-12 { t.sin().signum() } else { 0.0 });
            if sides[0] == 0.0 || sides[0] != sides[1] {
                continue;
            }
            let first = self.positions.len() as u32;
            for r in cage.radii {
                for k in [k, k + 1] {
                    self.vertex(on(r, wall(r, rings, k)), [0.0, 0.0, sides[0]]);
                }
            }
            self.grid(first, 1, 1, true);
        }
    }

    /// Triangles between `rows + 1` rows of `columns + 1` vertices each, row after row from `first`.
    fn grid(&mut self, first: u32, rows: usize, columns: usize, flip: bool) {
        let stride = columns as u32 + 1;
        for row in 0..rows as u32 {
            for k in 0..columns as u32 {
                let a = first + row * stride + k;
                let (b, c, d) = (a + stride, a + stride + 1, a + 1);
                if flip {
                    self.triangles.extend([[a, c, b], [a, d, c]]);
                } else {
                    self.triangles.extend([[a, b, c], [a, c, d]]);
                }
            }
        }
    }

    fn vertex(&mut self, position: [f64; 3], normal: [f64; 3]) {
        self.positions.push(position);
        self.normals.push(normal);
    }
}

/// A length of shaft, possibly tapered or hollow \[m\].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Length {
    /// Axial positions of the ends.
    pub z: [f64; 2],
    /// Outer and inner radius at the two ends.
    pub outer: [f64; 2],
    pub inner: [f64; 2],
}

/// Largest change of direction that is drawn smooth \[rad\]; larger ones are edges.
const SMOOTH: f64 = 0.15;

/// Straight pieces of an outline joined where they continue each other with little change of direction.
fn joined_smoothly(pieces: &[Vec<[f64; 2]>]) -> Vec<Vec<[f64; 2]>> {
    let direction = |a: [f64; 2], b: [f64; 2]| (b[1] - a[1]).atan2(b[0] - a[0]);
    let mut out: Vec<Vec<[f64; 2]>> = Vec::new();
    for piece in pieces {
        if let Some(line) = out.last_mut()
            && let [.., a, b] = line[..]
            && b == piece[0]
        {
            let turn = (direction(piece[0], piece[1]) - direction(a, b)).rem_euclid(TAU);
            let turn = turn.min(TAU - turn);
            // Round-off apart, a straight continuation needs no point.
            if turn < 1e-9 {
                line.pop();
            }
            if turn < SMOOTH {
                line.push(piece[1]);
                continue;
            }
        }
        out.push(piece.clone());
    }
    out
}

/// Unit normals (n_r, n_z) of a smooth outline, to the right of its direction.
fn outline_normals(piece: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let last = piece.len() - 1;
    (0..=last)
        .map(|i| {
            let (a, b) = (piece[i.saturating_sub(1)], piece[(i + 1).min(last)]);
            let (dr, dz) = (b[0] - a[0], b[1] - a[1]);
            let length = dr.hypot(dz);
            if length > 0.0 { [dz / length, -dr / length] } else { [0.0, 1.0] }
        })
        .collect()
}
