//! Origins of periodic families that are not of the bearing.

use serde::{Deserialize, Serialize};

/// Mains frequencies \[Hz\].
pub(super) const MAINS: [f64; 2] = [50.0, 60.0];

/// Origin of a family that is not of the bearing.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum RivalKind {
    Shaft,
    Mains,
    /// Any other rate, found in the record.
    Periodic,
}
