//! Load, contact angles and patches of one contact of a bearing.

use crate::contact::{ContactPatch, HertzPair};
use serde::{Deserialize, Serialize};

/// Load of one contact between the rings, a ball or roller with its inner and outer side, or a pad, whose sides are equal:
/// loads, contact angles, deflection, film thickness.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct BearingContact {
    /// Row of a matched pair: 0 towards −z, 1 towards +z; 0 in a single row.
    pub row: usize,
    /// Angular position ψ_j \[rad\] from +x towards +y.
    pub position: f64,
    /// Normal load of the inner contact Q_i \[N\].
    pub load: f64,
    /// Contact angle at the inner race α_i \[rad\].
    pub contact_angle: f64,
    /// Approach of the races δ_i + δ_o \[m\]; negative for a gap.
    pub deflection: f64,
    /// Normal load Q_o \[N\] and contact angle α_o \[rad\] at the outer race; equal to those of the inner
    /// race for a massless ball.
    pub outer_load: f64,
    pub outer_contact_angle: f64,
    /// Central film thickness at the inner and outer race \[m\]; 0 if dry or unloaded.
    pub film: [f64; 2],
}

impl BearingContact {
    /// Contact ellipse and maximum Hertzian pressure at the inner and outer race.
    pub fn patches(&self, contacts: &HertzPair) -> [ContactPatch; 2] {
        [contacts.inner.patch(self.load), contacts.outer.patch(self.outer_load)]
    }
}
