//! Probes: what a study records.

use crate::element::Anchor;
pub use rotordyn_signal::Quantity;
use serde::{Deserialize, Serialize};

/// A probe (virtual sensor): one direction at one point.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Probe {
    pub name: String,
    pub at: Anchor,
    /// Weights on u_x u_y u_z θ_x θ_y θ_z of the point; unit vector for a translation.
    pub direction: [f64; 6],
    pub quantity: Quantity,
}
