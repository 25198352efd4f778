//! Cage as a parry shape: a plain hollow cylinder with one radial, cylindrical pocket per ball.

use std::f64::consts::TAU;

use nalgebra::Vector2;
use parry3d_f64::bounding_volume::{Aabb, BoundingSphere};
use parry3d_f64::mass_properties::MassProperties;
use parry3d_f64::math::{Real, Vector};
use parry3d_f64::query::{PointProjection, PointQuery, Ray, RayCast, RayIntersection};
use parry3d_f64::shape::{FeatureId, Shape, ShapeType, TypedShape};

use super::ring::sphere_march;
use super::solid::{RevolvedSolid, radial_hole, revolved_rectangle};

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
    /// Mass and inertia: hollow cylinder less Z radial holes (Z ≥ 3 for the symmetry); exact to rounding.
    ///
    /// Valid while the pockets lie within the width and apart from each other (see [`super::overlap`]).
    pub fn solid(&self, density: f64) -> RevolvedSolid {
        let half = 0.5 * self.width;
        let blank = revolved_rectangle(self.radii, [self.centre_z - half, self.centre_z + half], density);
        let z = self.pockets as f64;
        let [mass, polar, axial] = radial_hole(self.radii, self.pocket_radius, density).map(|m| z * m);
        blank.without(&RevolvedSolid::from_moments(mass, self.centre_z, polar, axial))
    }

    /// Angle of the pocket nearest to a point \[rad\].
    fn pocket_angle(&self, p: Vector) -> f64 {
        let pitch = TAU / self.pockets as f64;
        (p.y.atan2(p.x) / pitch).round() * pitch
    }

    /// Nearest point of a pocket's wall: straight out from the pocket's axis, within the cage's thickness.
    fn pocket_wall(&self, p: Vector) -> (Vector, bool) {
        let (sin, cos) = self.pocket_angle(p).sin_cos();
        let along = p.x * cos + p.y * sin;
        let across = Vector2::new(p.y * cos - p.x * sin, p.z - self.centre_z);
        let distance = across.norm();
        let a = self.pocket_radius;
        let wall = if distance > 0.0 { across * (a / distance) } else { Vector2::new(a, 0.0) };
        let at = |r: f64| (r * r - wall.x * wall.x).max(0.0).sqrt();
        let along_wall = along.clamp(at(self.radii[0]), at(self.radii[1]));
        let point = Vector::new(
            along_wall * cos - wall.x * sin,
            along_wall * sin + wall.x * cos,
            self.centre_z + wall.y,
        );
        (point, distance < a)
    }
}

impl PointQuery for CageShape {
    /// Exact for a point inside a pocket whose nearest wall point lies within the cage's thickness, which is
    /// where balls are; elsewhere the nearest of the nearest pocket's wall and the plain cylinder's faces.
    fn project_local_point(&self, pt: Vector, solid: bool) -> PointProjection {
        let radius = pt.x.hypot(pt.y);
        let half = 0.5 * self.width;
        let height = pt.z - self.centre_z;
        let [r1, r2] = self.radii;
        let (wall, in_pocket) = self.pocket_wall(pt);
        let inside = !in_pocket && radius >= r1 && radius <= r2 && height.abs() <= half;
        if inside && solid {
            return PointProjection::new(true, pt);
        }
        let mut best = wall;
        if !in_pocket {
            let (cos, sin) = if radius > 0.0 { (pt.x / radius, pt.y / radius) } else { (1.0, 0.0) };
            let to = |r: f64, h: f64| Vector::new(r * cos, r * sin, self.centre_z + h);
            let (r, h) = (radius.clamp(r1, r2), height.clamp(-half, half));
            for q in [to(r1, h), to(r2, h), to(r, half), to(r, -half)] {
                if (q - pt).length() < (best - pt).length() {
                    best = q;
                }
            }
        }
        PointProjection::new(inside, best)
    }

    fn project_local_point_and_get_feature(&self, pt: Vector) -> (PointProjection, FeatureId) {
        (self.project_local_point(pt, false), FeatureId::Face(0))
    }
}

impl RayCast for CageShape {
    fn cast_local_ray_and_get_normal(&self, ray: &Ray, max: Real, solid: bool) -> Option<RayIntersection> {
        sphere_march(self, ray, max, solid)
    }
}

impl Shape for CageShape {
    fn compute_local_aabb(&self) -> Aabb {
        let (r, half) = (self.radii[1], 0.5 * self.width);
        Aabb::new(Vector::new(-r, -r, self.centre_z - half), Vector::new(r, r, self.centre_z + half))
    }

    fn compute_local_bounding_sphere(&self) -> BoundingSphere {
        self.compute_local_aabb().bounding_sphere()
    }

    fn clone_dyn(&self) -> Box<dyn Shape> {
        Box::new(*self)
    }

    fn scale_dyn(&self, _scale: Vector, _subdivisions: u32) -> Option<Box<dyn Shape>> {
        None
    }

    fn mass_properties(&self, density: Real) -> MassProperties {
        self.solid(density).to_parry()
    }

    fn shape_type(&self) -> ShapeType {
        ShapeType::Custom
    }

    fn as_typed_shape(&self) -> TypedShape<'_> {
        TypedShape::Custom(self)
    }

    fn ccd_thickness(&self) -> Real {
        self.radii[1] - self.radii[0]
    }

    fn ccd_angular_thickness(&self) -> Real {
        std::f64::consts::FRAC_PI_2
    }

    /// Not convex in fact: `true` makes parry's ball queries use the point projection above.
    fn is_convex(&self) -> bool {
        true
    }
}
