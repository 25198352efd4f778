//! Which parts of a bearing touch or come near each other.

use super::cage::CageFrame;
use super::forces::Parts;
use super::ring::{RingFrame, V};
use super::state::cage_at;
use super::surfaces::{Approach, Distances, GroovePlace};
use crate::contact::Race;

/// A part that contacts: ball, race, pocket by number, or a land and the ring that carries it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum ContactPart {
    Ball(usize),
    InnerRace,
    OuterRace,
    Pocket(usize),
    /// Edge of the cage, by number, on its land.
    CageEdge(usize),
    InnerLand,
    OuterLand,
}

/// Two parts near each other.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Proximity {
    pub parts: [ContactPart; 2],
    pub approach: Approach,
}

impl Parts {
    /// All pairs whose distance is below `margin` \[m\]: cage or balls among each other, then balls and races.
    pub fn proximities<D: Distances>(
        &self,
        distances: &D,
        values: &[f64],
        rings: &[RingFrame; 2],
        margin: f64,
    ) -> Vec<Proximity> {
        let mut found = Vec::new();
        let mut add = |first: ContactPart, second: ContactPart, approach: Approach| {
            if approach.depth > -margin {
                found.push(Proximity { parts: [first, second], approach });
            }
        };
        let balls = self.balls.len();
        if let Some(contacts) = &self.cage {
            let frame = CageFrame::new(cage_at(values, balls), &contacts.cage);
            for j in 0..balls {
                let ball = self.motion(values, j);
                let place = contacts.pocket_place(&frame, &ball.position, ball.radius, j);
                distances.pocket(&contacts.pocket_surface(), &place, margin, |approach| {
                    add(ContactPart::Ball(j), ContactPart::Pocket(j), approach);
                });
            }
            if let Some(land) = contacts.land() {
                let (ring, part) = match land.race {
                    Race::Inner => (&rings[0], ContactPart::InnerLand),
                    Race::Outer => (&rings[1], ContactPart::OuterLand),
                };
                for (k, place) in contacts.edges(land, &frame, ring).iter().enumerate() {
                    add(ContactPart::CageEdge(k), part, distances.land(land, place));
                }
            }
        } else if balls > 1 {
            for first in 0..if balls > 2 { balls } else { 1 } {
                let second = (first + 1) % balls;
                let [one, other] = [first, second].map(|ball| self.motion(values, ball));
                let approach = distances.balls([&one.position, &other.position], [one.radius, other.radius]);
                add(ContactPart::Ball(first), ContactPart::Ball(second), approach);
            }
        }
        for j in 0..balls {
            let ball = self.motion(values, j);
            for (groove, ring) in self.grooves.iter().zip(rings) {
                let from_ring = ball.position - ring.centre;
                let height = from_ring.dot(&ring.axis);
                let radial: V = from_ring - height * ring.axis;
                let rho = radial.norm();
                let outward = radial / rho;
                let to_circle = [groove.torus.centre_radius - rho, groove.torus.axial - height];
                let place =
                    GroovePlace { ring, centre: ball.position, radius: ball.radius, outward, to_circle };
                let ([radial, axial], depth) = distances.groove(&groove.torus, &place);
                let part = match groove.torus.race {
                    Race::Inner => ContactPart::InnerRace,
                    Race::Outer => ContactPart::OuterRace,
                };
                let normal = radial * outward + axial * ring.axis;
                add(ContactPart::Ball(j), part, Approach { normal, depth });
            }
        }
        found
    }
}

/// The first contact of the cage with a ball or its land, or of two balls, in words, with its depth \[m\].
pub(super) fn first_overlap(contacts: &[Proximity]) -> Option<(String, f64)> {
    contacts.iter().find_map(|Proximity { parts, approach }| {
        let what = match *parts {
            [ContactPart::Ball(j), ContactPart::Pocket(_)] => format!("the cage touches ball {j}"),
            [ContactPart::Ball(j), ContactPart::Ball(_)] => format!("ball {j} touches the next ball"),
            [_, ContactPart::InnerLand] => "the cage touches the inner ring".into(),
            [_, ContactPart::OuterLand] => "the cage touches the outer ring".into(),
            // Balls are pressed between the races.
            _ => return None,
        };
        Some((what, approach.depth))
    })
}
