//! A figure with the name of its file.

use crate::Figure;

/// rpm per rad/s.
pub(super) const TO_RPM: f64 = 60.0 / std::f64::consts::TAU;

/// A figure with its file name (without extension).
pub(super) type Named = (String, Figure);
