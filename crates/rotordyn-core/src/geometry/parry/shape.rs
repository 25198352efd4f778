//! Ring and cage as parry shapes with exact distances.

use nalgebra::Vector3;
use parry3d_f64::bounding_volume::{Aabb, BoundingSphere};
use parry3d_f64::mass_properties::MassProperties;
use parry3d_f64::math::{Real, Vector};
use parry3d_f64::query::{PointProjection, PointQuery, Ray, RayCast, RayIntersection};
use parry3d_f64::shape::{FeatureId, Shape, ShapeType, TypedShape};

use super::convert::vector;
use crate::geometry::{ExactSolid, RevolvedSolid};

/// An exact solid as a shape of parry.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ExactShape<S>(pub S);

/// Mass properties in parry's form.
pub(crate) fn to_parry(solid: RevolvedSolid) -> MassProperties {
    MassProperties::new(
        Vector::new(0.0, 0.0, solid.centre_z),
        solid.mass,
        Vector::new(solid.diametral, solid.diametral, solid.polar),
    )
}

impl<S: ExactSolid + Copy + Send + Sync + 'static> PointQuery for ExactShape<S> {
    fn project_local_point(&self, pt: Vector, solid: bool) -> PointProjection {
        let (inside, nearest) = self.0.project(&Vector3::new(pt.x, pt.y, pt.z));
        let at = if inside && solid { pt } else { vector(&nearest) };
        PointProjection::new(inside, at)
    }

    fn project_local_point_and_get_feature(&self, pt: Vector) -> (PointProjection, FeatureId) {
        (self.project_local_point(pt, false), FeatureId::Face(0))
    }
}

impl<S: ExactSolid + Copy + Send + Sync + 'static> RayCast for ExactShape<S> {
    /// First hit by sphere marching on the distance to the surface, to 1e-12 m or 10 000 steps.
    fn cast_local_ray_and_get_normal(&self, ray: &Ray, max: Real, solid: bool) -> Option<RayIntersection> {
        let speed = ray.dir.length();
        if speed == 0.0 {
            return None;
        }
        let mut t = 0.0;
        for _ in 0..10_000 {
            let p = ray.point_at(t);
            let distance = (p - self.project_local_point(p, solid).point).length();
            if distance < 1e-12 {
                let back = ray.point_at((t - 1e-9 / speed).max(0.0));
                let normal = (back - self.project_local_point(back, false).point).normalize_or_zero();
                return Some(RayIntersection::new(t, normal, FeatureId::Face(0)));
            }
            t += distance / speed;
            if t > max {
                return None;
            }
        }
        None
    }
}

impl<S: ExactSolid + Copy + Send + Sync + 'static> Shape for ExactShape<S> {
    fn compute_local_aabb(&self) -> Aabb {
        let (r, [low, high]) = self.0.extent();
        Aabb::new(Vector::new(-r, -r, low), Vector::new(r, r, high))
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
        to_parry(self.0.solid(density))
    }

    fn shape_type(&self) -> ShapeType {
        ShapeType::Custom
    }

    fn as_typed_shape(&self) -> TypedShape<'_> {
        TypedShape::Custom(self)
    }

    fn ccd_thickness(&self) -> Real {
        self.0.wall()
    }

    fn ccd_angular_thickness(&self) -> Real {
        std::f64::consts::FRAC_PI_2
    }

    /// Not convex in fact: `true` makes parry's ball queries use the exact point projection above.
    fn is_convex(&self) -> bool {
        true
    }
}
