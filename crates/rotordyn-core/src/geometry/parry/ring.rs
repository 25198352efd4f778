//! Bearing ring as an exact parry shape: a rectangle revolved about z with a circular groove cut out of it.

use nalgebra::Vector2;
use parry3d_f64::bounding_volume::{Aabb, BoundingSphere};
use parry3d_f64::mass_properties::MassProperties;
use parry3d_f64::math::{Pose, Real, Vector};
use parry3d_f64::query::{self, PointProjection, PointQuery, Ray, RayCast, RayIntersection};
use parry3d_f64::shape::{Ball, FeatureId, Shape, ShapeType, TypedShape};

use super::solid::{RevolvedSolid, revolved_rectangle, revolved_segment};

/// Section of a ring in the half plane (r, z), all lengths \[m\]; z along the bearing's axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ring {
    /// Radius of the seat: half the bore (inner ring) or half the outside diameter (outer ring).
    pub seat_radius: f64,
    /// Radius of the shoulders next to the groove.
    pub shoulder_radius: f64,
    /// Radius of the circle of groove centres R_c and its axial position z_c.
    pub centre_radius: f64,
    pub centre_z: f64,
    /// Groove radius r.
    pub groove_radius: f64,
    /// Axial positions of the two side faces, increasing.
    pub faces: [f64; 2],
}

impl Ring {
    /// +1 for an outer ring (material outside its shoulder), −1 for an inner one.
    pub fn sense(&self) -> f64 {
        (self.seat_radius - self.shoulder_radius).signum()
    }

    /// Distance of the groove's chord (the shoulder line) from the groove centre, at most the groove radius.
    fn chord(&self) -> f64 {
        (self.sense() * (self.shoulder_radius - self.centre_radius))
            .clamp(-self.groove_radius, self.groove_radius)
    }

    /// Half the axial width of the groove at the shoulder \[m\].
    pub fn groove_half_width(&self) -> f64 {
        let h = self.chord();
        (self.groove_radius * self.groove_radius - h * h).sqrt()
    }

    /// Radius of the groove's deepest point \[m\].
    pub fn groove_bottom(&self) -> f64 {
        self.centre_radius + self.sense() * self.groove_radius
    }

    /// Points (r, z) of the groove arc from the lower to the higher z, `count` ≥ 2 of them.
    pub fn groove_arc(&self, count: usize) -> Vec<[f64; 2]> {
        let half = (self.chord() / self.groove_radius).acos();
        (0..count)
            .map(|k| {
                let angle = half * (2.0 * k as f64 / (count - 1) as f64 - 1.0);
                [
                    self.centre_radius + self.sense() * self.groove_radius * angle.cos(),
                    self.centre_z + self.groove_radius * angle.sin(),
                ]
            })
            .collect()
    }

    /// Mass, centre and inertia: rectangle less circular segment, both revolved; exact.
    ///
    /// Valid while the groove lies between the side faces and leaves a wall (see [`super::overlap`]).
    pub fn solid(&self, density: f64) -> RevolvedSolid {
        let [low, high] = self.faces;
        let (r1, r2) =
            (self.seat_radius.min(self.shoulder_radius), self.seat_radius.max(self.shoulder_radius));
        let blank = revolved_rectangle([r1, r2], [low, high], density);
        let groove = revolved_segment(
            self.centre_radius,
            self.sense(),
            self.groove_radius,
            self.chord(),
            self.centre_z,
            density,
        );
        blank.without(&groove)
    }

    fn contains(&self, p: Vector2<f64>) -> bool {
        let between = (p.x - self.seat_radius) * (p.x - self.shoulder_radius) <= 0.0
            && p.y >= self.faces[0]
            && p.y <= self.faces[1];
        between && (p - self.centre()).norm_squared() >= self.groove_radius * self.groove_radius
    }

    fn centre(&self) -> Vector2<f64> {
        Vector2::new(self.centre_radius, self.centre_z)
    }

    /// Nearest point of the section's outline: the groove arc, or one of its straight sides.
    fn nearest(&self, p: Vector2<f64>) -> Vector2<f64> {
        let from_centre = p - self.centre();
        let distance = from_centre.norm();
        let depth = self.sense() * from_centre.x;
        let mut best = None;
        let mut shortest = f64::INFINITY;
        // On the arc the distance is ||p − c| − r|, computed without the nearest point: no cancellation.
        if distance > 0.0 && depth >= self.chord() * (distance / self.groove_radius) {
            shortest = (distance - self.groove_radius).abs();
            best = Some(self.centre() + from_centre * (self.groove_radius / distance));
        }
        let edge = self.groove_half_width();
        let [low, high] = self.faces;
        let (back, shoulder) = (self.seat_radius, self.shoulder_radius);
        let sides = [
            [[shoulder, low], [shoulder, self.centre_z - edge]],
            [[shoulder, self.centre_z + edge], [shoulder, high]],
            [[back, low], [back, high]],
            [[back, low], [shoulder, low]],
            [[back, high], [shoulder, high]],
        ];
        for [a, b] in sides {
            let (a, b) = (Vector2::from(a), Vector2::from(b));
            let side = b - a;
            let length2 = side.norm_squared();
            let t = if length2 > 0.0 { ((p - a).dot(&side) / length2).clamp(0.0, 1.0) } else { 0.0 };
            let q = a + side * t;
            let d = (p - q).norm();
            if d < shortest {
                shortest = d;
                best = Some(q);
            }
        }
        best.unwrap_or(p)
    }
}

impl PointQuery for Ring {
    fn project_local_point(&self, pt: Vector, solid: bool) -> PointProjection {
        let radius = pt.x.hypot(pt.y);
        let section = Vector2::new(radius, pt.z);
        let inside = self.contains(section);
        if inside && solid {
            return PointProjection::new(true, pt);
        }
        let q = self.nearest(section);
        let (cos, sin) = if radius > 0.0 { (pt.x / radius, pt.y / radius) } else { (1.0, 0.0) };
        PointProjection::new(inside, Vector::new(q.x * cos, q.x * sin, q.y))
    }

    fn project_local_point_and_get_feature(&self, pt: Vector) -> (PointProjection, FeatureId) {
        (self.project_local_point(pt, false), FeatureId::Face(0))
    }
}

impl RayCast for Ring {
    fn cast_local_ray_and_get_normal(&self, ray: &Ray, max: Real, solid: bool) -> Option<RayIntersection> {
        sphere_march(self, ray, max, solid)
    }
}

impl Shape for Ring {
    fn compute_local_aabb(&self) -> Aabb {
        let r = self.seat_radius.max(self.shoulder_radius);
        Aabb::new(Vector::new(-r, -r, self.faces[0]), Vector::new(r, r, self.faces[1]))
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
        (self.seat_radius - self.groove_bottom()).abs()
    }

    fn ccd_angular_thickness(&self) -> Real {
        std::f64::consts::FRAC_PI_2
    }

    /// Not convex in fact: `true` makes parry's ball queries use the exact point projection above.
    fn is_convex(&self) -> bool {
        true
    }
}

/// First hit of a ray by sphere marching on the distance to the surface, to 1e-12 m or 10 000 steps.
pub(super) fn sphere_march(
    shape: &impl PointQuery,
    ray: &Ray,
    max: Real,
    solid: bool,
) -> Option<RayIntersection> {
    let speed = ray.dir.length();
    if speed == 0.0 {
        return None;
    }
    let mut t = 0.0;
    for _ in 0..10_000 {
        let p = ray.point_at(t);
        let projection = shape.project_local_point(p, solid);
        let away = p - projection.point;
        let distance = away.length();
        if distance < 1e-12 {
            let back = ray.point_at((t - 1e-9 / speed).max(0.0));
            let normal = (back - shape.project_local_point(back, false).point).normalize_or_zero();
            return Some(RayIntersection::new(t, normal, FeatureId::Face(0)));
        }
        t += distance / speed;
        if t > max {
            return None;
        }
    }
    None
}

/// Signed gap between a shape and a ball by parry's contact query: negative when they overlap.
pub(super) fn gap(shape: &dyn Shape, pose: &Pose, centre: Vector, radius: f64) -> f64 {
    // Unlimited prediction distance: the contact is found for any gap.
    let prediction = f64::MAX;
    match query::contact(pose, shape, &Pose::from_translation(centre), &Ball::new(radius), prediction) {
        Ok(Some(contact)) => contact.dist,
        // Only non-finite input leads here; a NaN gap is no overlap and no distance.
        _ => f64::NAN,
    }
}
