//! Surfaces of grooves, pockets and lands, and the distances of balls and cage from them.
//!
//! The closed forms are the default methods of [`Distances`]; the forces are compiled for each source of distances, so
//! that another source costs the closed forms nothing.

use super::input::{Land, Pocket};
use super::ring::{RingFrame, RingState, V};
use crate::contact::Race;

/// Centre \[m\] and axes of a body in the bearing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Placement {
    pub centre: V,
    pub axes: [V; 3],
}

/// Where two bodies touch or would touch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Approach {
    /// Unit vector along the force on the first body.
    pub normal: V,
    /// Approach δ \[m\]; negative: the distance.
    pub depth: f64,
}

/// Groove of a race: centre circle of radius R_g in the plane at z_g of the ring, groove radius r_g, up to its shoulders.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GrooveSurface {
    pub race: Race,
    /// +1 for the inner race, −1 for the outer.
    pub side: f64,
    /// R_g, z_g and r_g \[m\].
    pub centre_radius: f64,
    pub axial: f64,
    pub radius: f64,
    /// cos and sin of the shoulder's angle from the bottom of the groove.
    pub shoulder: [f64; 2],
}

/// A ball beside a groove.
#[derive(Clone, Copy, Debug)]
pub struct GroovePlace<'a> {
    pub(super) ring: &'a RingFrame,
    /// Centre \[m\] and radius \[m\] of the ball.
    pub centre: V,
    pub radius: f64,
    /// Radial direction at the ball.
    pub outward: V,
    /// From the ball's centre to the centre circle, radially and axially \[m\].
    pub to_circle: [f64; 2],
}

impl GroovePlace<'_> {
    /// The ring.
    pub fn ring(&self) -> Placement {
        placement(self.ring)
    }

    /// Radial and axial part of a vector.
    pub fn in_section(&self, vector: &V) -> [f64; 2] {
        [vector.dot(&self.outward), vector.dot(&self.ring.axis)]
    }
}

/// Pocket of the cage.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PocketSurface {
    pub shape: Pocket,
    /// Radius of the pocket \[m\].
    pub radius: f64,
}

/// A ball in its pocket.
#[derive(Clone, Copy, Debug)]
pub struct PocketPlace {
    /// Number of the ball and its pocket.
    pub number: usize,
    /// Axis of the pocket and of the cage.
    pub radial: V,
    pub axial: V,
    /// Centre of the pocket, from there to the ball's centre \[m\], and the ball's radius \[m\].
    pub pocket_centre: V,
    pub from_pocket: V,
    pub radius: f64,
}

/// An edge of the cage beside its land.
#[derive(Clone, Copy, Debug)]
pub struct LandPlace<'a> {
    pub(super) ring: &'a RingFrame,
    /// Centre of the edge's circle \[m\].
    pub edge: V,
    /// From the ring's axis to that centre \[m\].
    pub eccentric: V,
}

impl LandPlace<'_> {
    /// The ring with the land.
    pub fn ring(&self) -> Placement {
        placement(self.ring)
    }
}

/// Source of the distances between balls, races, pockets, land.
pub trait Distances {
    /// Direction of a race's force on a ball, radial and axial, and approach \[m\].
    #[inline(always)]
    fn groove(&self, groove: &GrooveSurface, place: &GroovePlace) -> ([f64; 2], f64) {
        groove.approach(place.to_circle, place.radius)
    }

    /// Calls `visit` with each wall of a pocket that is nearer to its ball than `margin` \[m\]; the first body is the ball.
    #[inline(always)]
    fn pocket(&self, pocket: &PocketSurface, place: &PocketPlace, margin: f64, visit: impl FnMut(Approach)) {
        pocket.approach(place, margin, visit);
    }

    /// Edge of the cage and land; the first body is the cage, the ring presses along −e.
    #[inline(always)]
    fn land(&self, land: &Land, place: &LandPlace) -> Approach {
        let distance = place.eccentric.norm();
        Approach { normal: -place.eccentric / distance, depth: distance - land.clearance }
    }

    /// Two balls at their centres with their radii \[m\].
    #[inline(always)]
    fn balls(&self, centres: [&V; 2], radii: [f64; 2]) -> Approach {
        let apart = centres[0] - centres[1];
        let distance = apart.norm();
        Approach { normal: apart / distance, depth: radii[0] + radii[1] - distance }
    }
}

/// The closed forms.
#[derive(Clone, Copy, Debug, Default)]
pub struct ClosedForms;

impl Distances for ClosedForms {}

impl GrooveSurface {
    /// Direction of the force on the ball, radial and axial, and approach without waviness, from the vector x.
    #[inline(always)]
    fn approach(&self, to_circle: [f64; 2], ball_radius: f64) -> ([f64; 2], f64) {
        let [radial, axial] = to_circle;
        let length = (radial * radial + axial * axial).sqrt();
        let [cos, sin] = self.shoulder;
        if self.side * radial >= cos * length {
            let inverse = 1.0 / length;
            return ([radial * inverse, axial * inverse], length - (self.radius - ball_radius));
        }
        let edge = [radial - self.side * self.radius * cos, axial - (self.radius * sin).copysign(axial)];
        let distance = (edge[0] * edge[0] + edge[1] * edge[1]).sqrt();
        (edge.map(|to_edge| -to_edge / distance), ball_radius - distance)
    }
}

impl PocketSurface {
    /// In the pocket's axes (radial u, tangential τ, axial z) the ball's centre is at d from the pocket's centre. Cylinder:
    /// δ = √(τ² + z²) + r − R; sphere: δ = |d| + r − R; closed: also δ = |u| − c.
    #[inline(always)]
    fn approach(&self, place: &PocketPlace, margin: f64, mut visit: impl FnMut(Approach)) {
        let PocketPlace { radial, from_pocket, radius, .. } = *place;
        let outward = from_pocket.dot(&radial);
        let off_axis = match self.shape {
            Pocket::Spherical => from_pocket,
            Pocket::Cylindrical | Pocket::Closed { .. } => from_pocket - outward * radial,
        };
        let distance = off_axis.norm();
        let depth = distance + radius - self.radius;
        if depth > -margin && distance > 0.0 {
            visit(Approach { normal: -off_axis / distance, depth });
        }
        if let Pocket::Closed { radial_clearance } = self.shape {
            let depth = outward.abs() - radial_clearance;
            if depth > -margin {
                visit(Approach { normal: -outward.signum() * radial, depth });
            }
        }
    }
}

fn placement(ring: &RingFrame) -> Placement {
    Placement { centre: ring.centre, axes: [ring.across, ring.axis.cross(&ring.across), ring.axis] }
}

impl RingState {
    /// The ring's centre and axes, tilted, not turned about its axis.
    pub fn placement(&self) -> Placement {
        placement(&self.frame())
    }
}
