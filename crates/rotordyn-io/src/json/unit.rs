//! Units of the JSON output.

pub(super) const TO_RPM: f64 = 60.0 / std::f64::consts::TAU;
