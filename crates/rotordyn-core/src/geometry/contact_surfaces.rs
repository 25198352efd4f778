//! Surfaces that balls and cage touch, with the nearest point of each: groove, pocket, end walls, land.

use super::solid::{ExactSolid, RevolvedSolid};
use nalgebra::{Vector2, Vector3};
use rotordyn_bearing::free_ball::GrooveSurface;

/// Thickness of material behind a pocket or land over its radius, for bounding boxes alone.
const WALL_RATIO: f64 = 0.25;

/// Groove of a race in the axes of its ring: the arc between the shoulders, revolved about z.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GrooveSolid(pub GrooveSurface);

/// Hole of circular section along z: cylindrical pocket or the land of an outer ring.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CylindricalHole {
    /// Radius and half the length \[m\]; the wall goes on beyond it, the bounding box ends there.
    pub radius: f64,
    pub half_length: f64,
}

/// Spherical pocket.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SphericalHole {
    pub radius: f64,
}

/// The two walls across z that close a pocket.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EndWalls {
    /// Distance of each wall from the pocket's centre and radius of the pocket \[m\].
    pub distance: f64,
    pub radius: f64,
}

impl ExactSolid for GrooveSolid {
    fn project(&self, p: &Vector3<f64>) -> (bool, Vector3<f64>) {
        let GrooveSurface { side, centre_radius, axial, radius, shoulder: [cos, sin], .. } = self.0;
        let rho = p.x.hypot(p.y);
        let outward = if rho > 0.0 { p.xy() / rho } else { Vector2::x() };
        // In the section: towards the bottom of the groove, and axially.
        let from_circle = Vector2::new(side * (centre_radius - rho), p.z - axial);
        let distance = from_circle.norm();
        let on_arc = from_circle.x >= cos * distance;
        let to_surface = match on_arc {
            true if distance > 0.0 => from_circle * (radius / distance),
            true => Vector2::new(radius, 0.0),
            false => Vector2::new(radius * cos, (radius * sin).copysign(from_circle.y)),
        };
        let ring_radius = centre_radius - side * to_surface.x;
        let nearest = Vector3::new(outward.x * ring_radius, outward.y * ring_radius, axial + to_surface.y);
        (on_arc && distance > radius, nearest)
    }

    fn extent(&self) -> (f64, [f64; 2]) {
        let GrooveSurface { centre_radius, axial, radius, .. } = self.0;
        (centre_radius + radius, [axial - radius, axial + radius])
    }

    fn wall(&self) -> f64 {
        WALL_RATIO * self.0.radius
    }

    fn solid(&self, _: f64) -> RevolvedSolid {
        RevolvedSolid::default()
    }
}

impl ExactSolid for CylindricalHole {
    fn project(&self, p: &Vector3<f64>) -> (bool, Vector3<f64>) {
        let distance = p.x.hypot(p.y);
        let wall =
            if distance > 0.0 { p.xy() * (self.radius / distance) } else { Vector2::new(self.radius, 0.0) };
        (distance > self.radius, Vector3::new(wall.x, wall.y, p.z))
    }

    fn extent(&self) -> (f64, [f64; 2]) {
        (self.radius + self.wall(), [-self.half_length, self.half_length])
    }

    fn wall(&self) -> f64 {
        WALL_RATIO * self.radius
    }

    fn solid(&self, _: f64) -> RevolvedSolid {
        RevolvedSolid::default()
    }
}

impl ExactSolid for SphericalHole {
    fn project(&self, p: &Vector3<f64>) -> (bool, Vector3<f64>) {
        let distance = p.norm();
        let wall = if distance > 0.0 { p * (self.radius / distance) } else { Vector3::x() * self.radius };
        (distance > self.radius, wall)
    }

    fn extent(&self) -> (f64, [f64; 2]) {
        let reach = self.radius + self.wall();
        (reach, [-reach, reach])
    }

    fn wall(&self) -> f64 {
        WALL_RATIO * self.radius
    }

    fn solid(&self, _: f64) -> RevolvedSolid {
        RevolvedSolid::default()
    }
}

impl ExactSolid for EndWalls {
    fn project(&self, p: &Vector3<f64>) -> (bool, Vector3<f64>) {
        (p.z.abs() > self.distance, Vector3::new(p.x, p.y, self.distance.copysign(p.z)))
    }

    fn extent(&self) -> (f64, [f64; 2]) {
        let reach = self.distance + self.wall();
        (self.radius, [-reach, reach])
    }

    fn wall(&self) -> f64 {
        WALL_RATIO * self.radius
    }

    fn solid(&self, _: f64) -> RevolvedSolid {
        RevolvedSolid::default()
    }
}
