//! Contacts of the cage: balls in their pockets, edges on the guiding land.

use super::input::{FreeCage, Guidance, Land, PointContactLaw};
use super::point_contact::{LoadLaw, PointContact, PointForce};
use super::race::BallMotionState;
use super::ring::{RingFrame, V};
use super::state::CageBody;
use super::surfaces::{Approach, Distances, LandPlace, PocketPlace, PocketSurface};
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

    /// A ball beside its pocket.
    #[inline(always)]
    pub fn pocket_place(&self, frame: &CageFrame, position: &V, radius: f64, number: usize) -> PocketPlace {
        let [cos, sin] = self.pockets[number];
        let radial = cos * frame.axes[0] + sin * frame.axes[1];
        let from_centre = self.pitch_radius * radial;
        PocketPlace {
            number,
            radial,
            axial: frame.axes[2],
            pocket_centre: frame.body.position + from_centre,
            from_pocket: position - frame.body.position - from_centre,
            radius,
        }
    }

    /// Surface of every pocket.
    #[inline(always)]
    pub fn pocket_surface(&self) -> PocketSurface {
        PocketSurface { shape: self.cage.pocket, radius: 0.5 * self.cage.pocket_diameter }
    }

    /// Calls `visit` with each contact of a ball with its pocket; the first body is the ball.
    #[inline]
    pub fn pocket<D: Distances>(
        &self,
        distances: &D,
        frame: &CageFrame,
        ball: &BallMotionState,
        number: usize,
        mut visit: impl FnMut(CageContact),
    ) {
        let place = self.pocket_place(frame, &ball.position, ball.radius, number);
        let from_cage = ball.position - frame.body.position;
        distances.pocket(&self.pocket_surface(), &place, 0.0, |Approach { normal, depth }| {
            let arm = from_cage - ball.radius * normal;
            let surface = ball.velocity - ball.radius * ball.rotation.cross(&normal);
            let contact = PointContact { normal, depth, velocity: surface - frame.velocity_at(&arm) };
            visit(CageContact { contact: contact.react(&self.cage.pocket_contact, LoadLaw::Hertz), arm });
        });
    }

    /// The guiding land and its ring.
    pub fn land(&self) -> Option<&Land> {
        match &self.cage.guidance {
            Guidance::Balls => None,
            Guidance::Land(land) => Some(land),
        }
    }

    /// Both edges of the cage beside the land.
    #[inline(always)]
    pub fn edges<'a>(&self, land: &Land, frame: &CageFrame, ring: &'a RingFrame) -> [LandPlace<'a>; 2] {
        [-0.5, 0.5].map(|side| {
            let edge = frame.body.position + side * land.width * frame.axes[2];
            let from_ring = edge - ring.centre;
            LandPlace { ring, edge, eccentric: from_ring - from_ring.dot(&ring.axis) * ring.axis }
        })
    }

    /// Calls `visit` with the contact of each edge of the cage with its land; the first body is the cage.
    ///
    /// The centre of an edge is at e from the ring's axis, δ = |e| − c; the ring presses along −e. The inner land touches on
    /// the side of −e, the outer one on that of e.
    #[inline]
    pub fn land_contacts<D: Distances>(
        &self,
        distances: &D,
        land: &Land,
        frame: &CageFrame,
        ring: &RingFrame,
        mut visit: impl FnMut(CageContact, V),
    ) {
        for place in self.edges(land, frame, ring) {
            let Approach { normal, depth } = distances.land(land, &place);
            if depth <= 0.0 {
                continue;
            }
            let LandPlace { edge, eccentric, .. } = place;
            let to_land = if land.race == Race::Inner { land.radius } else { -land.radius };
            // From the edge's centre to the ring's axis, then to the land.
            let to_contact = to_land * normal - eccentric;
            let (arm, ring_arm) = (edge - frame.body.position + to_contact, edge - ring.centre + to_contact);
            let velocity = frame.velocity_at(&arm) - ring.velocity_at(&ring_arm);
            let contact = PointContact { normal, depth, velocity }.react(&land.contact, LoadLaw::Linear);
            visit(CageContact { contact, arm }, ring_arm);
        }
    }
}

/// Contact of two balls without cage; the first body is the first ball.
#[inline]
pub(super) fn ball_contact<D: Distances>(
    distances: &D,
    law: &PointContactLaw,
    first: &BallMotionState,
    second: &BallMotionState,
) -> Option<(PointForce, V)> {
    let Approach { normal, depth } =
        distances.balls([&first.position, &second.position], [first.radius, second.radius]);
    if depth <= 0.0 {
        return None;
    }
    let halves = [first.radius - 0.5 * depth, second.radius - 0.5 * depth];
    let surface = [
        first.velocity - halves[0] * first.rotation.cross(&normal),
        second.velocity + halves[1] * second.rotation.cross(&normal),
    ];
    let contact = PointContact { normal, depth, velocity: surface[0] - surface[1] };
    Some((contact.react(law, LoadLaw::Hertz), -halves[0] * normal))
}
