//! What a vibration record or an FRF measures of a motion.

/// Quantity that a sensor or a probe measures.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quantity {
    Displacement,
    Velocity,
    Acceleration,
}
