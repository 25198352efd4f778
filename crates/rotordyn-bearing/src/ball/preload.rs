//! Axial preload: rigid (displacement or force) and spring preload with a floating outer ring.

use super::preload_mechanism::PreloadMechanism;
pub use super::preload_mechanism::PreloadState;
use super::ring_motion::RingMotion;
use super::row::Row;
use crate::{Reaction, Rotation, root_finding};

/// A reaction with the load sums for the mean contact angle.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct RowReaction {
    pub reaction: Reaction,
    pub load: f64,
    pub load_cos: f64,
}

impl Row {
    /// Force on the inner ring and tangents, for any preload mechanism of the outer ring.
    pub fn row_reaction(&self, ring: &RingMotion) -> RowReaction {
        if let PreloadMechanism::Spring { stiffness, force, .. } = self.preload_mechanism {
            return self.spring_reaction(ring, stiffness, force);
        }
        let sum = self.sum_at(ring);
        let reaction = sum.reaction(self.arm, ring.cage_speed.unwrap_or(0.0));
        RowReaction { reaction, load: sum.load, load_cos: sum.load_cos }
    }

    /// Displacement e of a spring-preloaded outer ring, N(d, e) = F₀ − k e: root of an increasing function of
    /// e.
    pub fn ring_displacement(&self, ring: &RingMotion) -> f64 {
        let PreloadMechanism::Spring { stiffness, force, .. } = self.preload_mechanism else {
            return 0.0;
        };
        let still = ring.stopped_at(ring.d);
        let operating = self.operating(&still);
        root_finding::increasing_root(
            |e| {
                let d = shifted(ring.d, self.direction * e);
                let (n, slope) = self.sum(&RingMotion { d: &d, ..still }, &operating).axial();
                [self.direction * n + stiffness * e - force, slope + stiffness]
            },
            self.ring_displacement_guess(ring),
        )
    }

    /// Ring displacement of a row whose balls all follow its axial stiffness when centred and dry.
    pub fn ring_displacement_guess(&self, ring: &RingMotion) -> f64 {
        match self.preload_mechanism {
            PreloadMechanism::Spring { dry, ring_motion_ratio, .. } => {
                dry - ring_motion_ratio * self.direction * ring.d[2]
            }
            _ => 0.0,
        }
    }

    /// Where a ring on a spring is, added to its displacement.
    pub fn with_ring_displacement(&self, ring: &RingMotion) -> [f64; 6] {
        shifted(ring.d, self.direction * self.ring_displacement(ring))
    }

    /// Offset and axial force of the centred bearing with the inertial loads of a cage speed \[rad/s\].
    pub fn preload_state(&self, rotation: &Rotation, orbit: f64) -> PreloadState {
        let centred = RingMotion::at_rest(&[0.0; 6], rotation, orbit, false);
        let operating = self.operating(&centred);
        let offset = match self.preload_mechanism {
            PreloadMechanism::Fixed(offset) => offset,
            PreloadMechanism::Force { .. } => operating.preload,
            PreloadMechanism::Spring { .. } => self.ring_displacement(&centred),
        };
        let d = shifted(centred.d, self.direction * (offset - operating.preload));
        let (axial, _) = self.sum(&RingMotion { d: &d, ..centred }, &operating).axial();
        PreloadState { offset, axial_force: self.direction * axial }
    }
}

fn shifted(d: &[f64; 6], by: f64) -> [f64; 6] {
    let mut d = *d;
    d[2] += by;
    d
}
