//! What a vibration record or an FRF measures of a motion.

use serde::{Deserialize, Serialize};

/// Quantity that a sensor or a probe measures.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Quantity {
    Displacement,
    Velocity,
    Acceleration,
}
