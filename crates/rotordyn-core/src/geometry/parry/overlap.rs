//! Overlaps (geometric interference) of bearing parts and their depth.

use std::f64::consts::PI;
use std::fmt;

use nalgebra::{Isometry3, Vector3};
use parry3d_f64::math::Pose;
use parry3d_f64::query;
use parry3d_f64::shape::Ball;

use super::convert::vector;
use super::distance::gap;
use super::shape::ExactShape;
use crate::geometry::{BearingPose, BearingShapes, Race, Ring};

/// A part of a bearing, or a surface that cuts one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Part {
    /// Ball by number, from 0, printed from 1.
    Ball(usize),
    /// Cage pocket by number.
    Pocket(usize),
    InnerRing,
    OuterRing,
    Cage,
    /// Groove of a ring.
    Groove(Race),
    Bore,
    OutsideSurface,
    SideFace,
}

impl fmt::Display for Part {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Ball(j) => write!(f, "ball {}", j + 1),
            Self::Pocket(j) => write!(f, "cage pocket {}", j + 1),
            Self::InnerRing => f.write_str("the inner ring"),
            Self::OuterRing => f.write_str("the outer ring"),
            Self::Cage => f.write_str("the cage"),
            Self::Groove(Race::Inner) => f.write_str("the inner groove"),
            Self::Groove(Race::Outer) => f.write_str("the outer groove"),
            Self::Bore => f.write_str("the bore"),
            Self::OutsideSurface => f.write_str("the outside surface"),
            Self::SideFace => f.write_str("the side face"),
        }
    }
}

/// Two parts that share space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Overlap {
    pub first: Part,
    pub second: Part,
    /// Penetration depth \[m\], greater than 0.
    pub depth: f64,
}

impl fmt::Display for Overlap {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} and {} overlap by {:.4} mm", self.first, self.second, 1e3 * self.depth)
    }
}

impl BearingShapes {
    /// Overlaps of the parts at a placement; empty if there are none.
    ///
    /// `race_allowance` \[m\]: permitted elastic penetration of a ball into a race (interference fits and
    /// loads compress balls by micrometres). Inconsistent geometry (groove through the bore or a side face,
    /// intersecting pockets) counts as overlap of these surfaces. Rings and cage are compared with each other
    /// as coaxial cylinders with radial play less eccentricity and less half width times tilt, a bound that
    /// is conservative by R θ²/2.
    pub fn overlaps(&self, at: &BearingPose, race_allowance: f64) -> Vec<Overlap> {
        let mut found = OverlapList::default();
        self.add_inconsistent_geometry(&mut found);
        self.add_ball_to_ball_overlaps(at, &mut found);
        self.add_ball_to_ring_and_cage_overlaps(at, race_allowance, &mut found);
        self.add_ring_and_cage_overlaps(at, &mut found);
        found.0
    }

    fn add_inconsistent_geometry(&self, found: &mut OverlapList) {
        for (ring, race, seat) in
            [(&self.inner, Race::Inner, Part::Bore), (&self.outer, Race::Outer, Part::OutsideSurface)]
        {
            let groove = Part::Groove(race);
            found.add(groove, seat, groove_excess(ring));
            let half = ring.groove_half_width();
            let past = (ring.faces[0] - ring.centre_z + half).max(ring.centre_z + half - ring.faces[1]);
            found.add(groove, Part::SideFace, past);
        }
        let cage = &self.cage;
        let pocket_half_spacing = cage.radii[0] * (PI / cage.pockets as f64).sin();
        if cage.pockets > 1 {
            for j in 0..cage.pockets {
                let next = Part::Pocket((j + 1) % cage.pockets);
                found.add(Part::Pocket(j), next, 2.0 * (cage.pocket_radius - pocket_half_spacing));
            }
        }
        found.add(Part::Pocket(0), Part::SideFace, cage.pocket_radius - 0.5 * cage.width);
    }

    fn add_ball_to_ball_overlaps(&self, at: &BearingPose, found: &mut OverlapList) {
        let ball = Ball::new(0.5 * self.ball_diameter);
        for (j, first) in at.balls.iter().enumerate() {
            for (k, second) in at.balls.iter().enumerate().skip(j + 1) {
                let at = |p: &nalgebra::Point3<f64>| Pose::from_translation(vector(&p.coords));
                if let Ok(Some(contact)) = query::contact(&at(first), &ball, &at(second), &ball, 0.0) {
                    found.add(Part::Ball(j), Part::Ball(k), -contact.dist);
                }
            }
        }
    }

    fn add_ball_to_ring_and_cage_overlaps(&self, at: &BearingPose, allowance: f64, found: &mut OverlapList) {
        let radius = 0.5 * self.ball_diameter;
        for (j, ball) in at.balls.iter().enumerate() {
            for (race, part, ring) in [
                (Race::Inner, Part::InnerRing, at.inner),
                (Race::Outer, Part::OuterRing, Isometry3::identity()),
            ] {
                let depth = -self.race_gap(race, &ring, ball);
                if depth > allowance {
                    found.add(Part::Ball(j), part, depth);
                }
            }
            found.add(Part::Ball(j), Part::Cage, -gap(&ExactShape(self.cage), &at.cage, ball, radius));
        }
    }

    fn add_ring_and_cage_overlaps(&self, at: &BearingPose, found: &mut OverlapList) {
        let width = self.inner.faces[1] - self.inner.faces[0];
        let inner = self.inner.shoulder_radius;
        let outer = self.outer.shoulder_radius;
        let [cage_in, cage_out] = self.cage.radii;
        let ring_play = outer - inner - play_used(&at.inner, width);
        found.add(Part::InnerRing, Part::OuterRing, -ring_play);
        let cage_in_inner = at.inner.inv_mul(&at.cage);
        found.add(Part::InnerRing, Part::Cage, inner - cage_in + play_used(&cage_in_inner, width));
        found.add(Part::OuterRing, Part::Cage, cage_out - outer + play_used(&at.cage, width));
    }
}

/// Depth of a groove beyond its ring's seat surface \[m\]; negative: the remaining wall.
fn groove_excess(ring: &Ring) -> f64 {
    ring.sense() * (ring.groove_bottom() - ring.seat_radius)
}

/// Radial play used by a body of this pose and width at its worse end \[m\].
fn play_used(pose: &Isometry3<f64>, width: f64) -> f64 {
    let axis = pose.rotation * Vector3::z();
    pose.translation.vector.xy().norm() + 0.5 * width * axis.xy().norm()
}

#[derive(Default)]
struct OverlapList(Vec<Overlap>);

impl OverlapList {
    fn add(&mut self, first: Part, second: Part, depth: f64) {
        // Round-off of touching parts (1e-15 m) is no overlap.
        if depth > 1e-12 {
            self.0.push(Overlap { first, second, depth });
        }
    }
}
