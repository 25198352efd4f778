//! Cage: a plain hollow cylinder with one radial, cylindrical pocket per ball.

use std::f64::consts::TAU;

use nalgebra::{Vector2, Vector3};

use super::solid::{ExactSolid, RevolvedSolid, radial_hole, revolved_rectangle};

/// Cage with pocket j at angle 2πj/Z from +x towards +y in its own axes, all lengths \[m\].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CageShape {
    /// Inner and outer radius of the wall.
    pub radii: [f64; 2],
    /// Axial position of the pockets' centres and width of the cage.
    pub centre_z: f64,
    pub width: f64,
    /// Pocket radius a.
    pub pocket_radius: f64,
    /// Number of pockets Z.
    pub pockets: usize,
}

impl CageShape {
    /// Angle of the pocket nearest to a point \[rad\].
    fn pocket_angle(&self, p: &Vector3<f64>) -> f64 {
        let pitch = TAU / self.pockets as f64;
        (p.y.atan2(p.x) / pitch).round() * pitch
    }

    /// Nearest point of a pocket's wall: straight out from the pocket's axis, within the cage's thickness.
    fn pocket_wall(&self, p: &Vector3<f64>) -> (Vector3<f64>, bool) {
        let (sin, cos) = self.pocket_angle(p).sin_cos();
        let along = p.x * cos + p.y * sin;
        let across = Vector2::new(p.y * cos - p.x * sin, p.z - self.centre_z);
        let distance = across.norm();
        let a = self.pocket_radius;
        let wall = if distance > 0.0 { across * (a / distance) } else { Vector2::new(a, 0.0) };
        let at = |r: f64| (r * r - wall.x * wall.x).max(0.0).sqrt();
        let along_wall = along.clamp(at(self.radii[0]), at(self.radii[1]));
        let point = Vector3::new(
            along_wall * cos - wall.x * sin,
            along_wall * sin + wall.x * cos,
            self.centre_z + wall.y,
        );
        (point, distance < a)
    }
}

impl ExactSolid for CageShape {
    /// Whether a point is in the material, and the nearest point of the surface.
    ///
    /// Exact for a point inside a pocket whose nearest wall point lies within the cage's thickness, which is
    /// where balls are; elsewhere the nearest of the nearest pocket's wall and the plain cylinder's faces.
    fn project(&self, p: &Vector3<f64>) -> (bool, Vector3<f64>) {
        let radius = p.x.hypot(p.y);
        let half = 0.5 * self.width;
        let height = p.z - self.centre_z;
        let [r1, r2] = self.radii;
        let (mut best, in_pocket) = self.pocket_wall(p);
        if in_pocket {
            return (false, best);
        }
        let (cos, sin) = if radius > 0.0 { (p.x / radius, p.y / radius) } else { (1.0, 0.0) };
        let to = |r: f64, h: f64| Vector3::new(r * cos, r * sin, self.centre_z + h);
        let (r, h) = (radius.clamp(r1, r2), height.clamp(-half, half));
        for q in [to(r1, h), to(r2, h), to(r, half), to(r, -half)] {
            if (q - p).norm() < (best - p).norm() {
                best = q;
            }
        }
        (radius >= r1 && radius <= r2 && height.abs() <= half, best)
    }

    fn extent(&self) -> (f64, [f64; 2]) {
        let half = 0.5 * self.width;
        (self.radii[1], [self.centre_z - half, self.centre_z + half])
    }

    fn wall(&self) -> f64 {
        self.radii[1] - self.radii[0]
    }

    /// Mass and inertia: hollow cylinder less Z radial holes (Z ≥ 3 for the symmetry); exact to rounding.
    ///
    /// Valid while the pockets lie within the width and apart from each other (see
    /// `BearingShapes::overlaps`).
    fn solid(&self, density: f64) -> RevolvedSolid {
        let half = 0.5 * self.width;
        let blank = revolved_rectangle(self.radii, [self.centre_z - half, self.centre_z + half], density);
        let z = self.pockets as f64;
        let [mass, polar, axial] = radial_hole(self.radii, self.pocket_radius, density).map(|m| z * m);
        blank.without(&RevolvedSolid::from_moments(mass, self.centre_z, polar, axial))
    }
}
