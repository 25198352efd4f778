//! Contacts of the cage: balls in their pockets, edges on the guiding land.

use super::input::{FreeCage, Guidance, Land, Pocket, PointContactLaw};
use super::point_contact::{LoadLaw, PointContact, PointForce};
use super::race::BallMotionState;
use super::ring::{RingFrame, V};
use super::state::CageBody;
use crate::contact::Race;
use std::f64::consts::TAU;

/// Cage prepared for evaluation.
#[derive(Clone, Debug)]
pub(super) struct CageContacts {
    pub cage: FreeCage,
    /// Radius of the circle of pocket centres \[m\].
    pub pitch_radius: f64,
    /// cos and sin of the angle of each pocket.
    pockets: Vec<[f64; 2]>,
}

/// Cage with its axes and angular velocity.
#[derive(Clone, Copy, Debug)]
pub(super) struct CageFrame {
    pub body: CageBody,
    pub axes: [V; 3],
    pub rotation: V,
}

/// A contact of the cage, and where.
#[derive(Clone, Copy, Debug)]
pub(super) struct CageContact {
    pub contact: PointForce,
    /// Place of the contact from the cage's centre \[m\].
    pub arm: V,
}

impl CageFrame {
    pub fn new(body: CageBody, cage: &FreeCage) -> Self {
        let axes = body.axes();
        let rotation = body.rotation(&axes[2], cage.polar_inertia, cage.transverse_inertia);
        Self { body, axes, rotation }
    }

    #[inline(always)]
    fn velocity_at(&self, from_centre: &V) -> V {
        self.body.velocity + self.rotation.cross(from_centre)
    }
}

impl CageContacts {
    pub fn new(cage: FreeCage, balls: usize, pitch_radius: f64) -> Self {
        let pocket = |k: usize| {
            let (sin, cos) = (TAU * k as f64 / balls as f64).sin_cos();
            [cos, sin]
        };
        Self { cage, pitch_radius, pockets: (0..balls).map(pocket).collect() }
    }

    /// Calls `visit` with each contact of a ball with its pocket; the first body is the ball.
    ///
    /// In the pocket's axes (radial u, tangential τ, axial z) the ball's centre is at d from the pocket's centre. Cylinder:
    /// δ = √(τ² + z²) + r − R; sphere: δ = |d| + r − R; closed: also δ = |u| − c.
    #[inline]
    pub fn pocket(
        &self,
        frame: &CageFrame,
        ball: &BallMotionState,
        number: usize,
        mut visit: impl FnMut(CageContact),
    ) {
        let [cos, sin] = self.pockets[number];
        let radial = cos * frame.axes[0] + sin * frame.axes[1];
        let from_cage = ball.position - frame.body.position;
        let from_pocket = from_cage - self.pitch_radius * radial;
        let radius = 0.5 * self.cage.pocket_diameter;
        let outward = from_pocket.dot(&radial);
        let off_axis = match self.cage.pocket {
            Pocket::Spherical => from_pocket,
            Pocket::Cylindrical | Pocket::Closed { .. } => from_pocket - outward * radial,
        };
        let mut press = |normal: V, depth: f64| {
            let arm = from_cage - ball.radius * normal;
            let surface = ball.velocity - ball.radius * ball.rotation.cross(&normal);
            let contact = PointContact { normal, depth, velocity: surface - frame.velocity_at(&arm) };
            visit(CageContact { contact: contact.react(&self.cage.pocket_contact, LoadLaw::Hertz), arm });
        };
        let distance = off_axis.norm();
        let depth = distance + ball.radius - radius;
        if depth > 0.0 {
            press(-off_axis / distance, depth);
        }
        if let Pocket::Closed { radial_clearance } = self.cage.pocket {
            let depth = outward.abs() - radial_clearance;
            if depth > 0.0 {
                press(-outward.signum() * radial, depth);
            }
        }
    }

    /// The guiding land and its ring.
    pub fn land(&self) -> Option<&Land> {
        match &self.cage.guidance {
            Guidance::Balls => None,
            Guidance::Land(land) => Some(land),
        }
    }

    /// Calls `visit` with the contact of each edge of the cage with its land; the first body is the cage.
    ///
    /// The centre of an edge is at e from the ring's axis, δ = |e| − c; the ring presses along −e. The inner land touches on
    /// the side of −e, the outer one on that of e.
    #[inline]
    pub fn land_contacts(
        &self,
        land: &Land,
        frame: &CageFrame,
        ring: &RingFrame,
        mut visit: impl FnMut(CageContact, V),
    ) {
        for side in [-0.5, 0.5] {
            let edge = side * land.width * frame.axes[2];
            let from_ring = frame.body.position + edge - ring.centre;
            let eccentric = from_ring - from_ring.dot(&ring.axis) * ring.axis;
            let distance = eccentric.norm();
            let depth = distance - land.clearance;
            if depth <= 0.0 {
                continue;
            }
            let normal = -eccentric / distance;
            let to_land = if land.race == Race::Inner { land.radius } else { -land.radius };
            // From the edge's centre to the ring's axis, then to the land.
            let to_contact = to_land * normal - eccentric;
            let (arm, ring_arm) = (edge + to_contact, from_ring + to_contact);
            let velocity = frame.velocity_at(&arm) - ring.velocity_at(&ring_arm);
            let contact = PointContact { normal, depth, velocity }.react(&land.contact, LoadLaw::Linear);
            visit(CageContact { contact, arm }, ring_arm);
        }
    }
}

/// Contact of two balls without cage; the first body is the first ball.
#[inline]
pub(super) fn ball_contact(
    law: &PointContactLaw,
    first: &BallMotionState,
    second: &BallMotionState,
) -> Option<(PointForce, V)> {
    let apart = first.position - second.position;
    let distance = apart.norm();
    let depth = first.radius + second.radius - distance;
    if depth <= 0.0 {
        return None;
    }
    let normal = apart / distance;
    let half = first.radius - 0.5 * depth;
    let surface = [
        first.velocity - half * first.rotation.cross(&normal),
        second.velocity + (distance - half) * second.rotation.cross(&normal),
    ];
    let contact = PointContact { normal, depth, velocity: surface[0] - surface[1] };
    Some((contact.react(law, LoadLaw::Hertz), -half * normal))
}
