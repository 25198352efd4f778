//! A figure with the name of its file.

use crate::Figure;
use rotordyn_core::warning::Warning;

/// rpm per rad/s.
pub(super) const TO_RPM: f64 = 60.0 / std::f64::consts::TAU;

/// A figure with its file name (without extension).
pub type Named = (String, Figure);

/// A figure with the warnings that stand below it.
pub type WithWarnings = (Named, Vec<Warning>);
