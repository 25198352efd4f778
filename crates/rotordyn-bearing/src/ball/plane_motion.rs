//! Position of a ball's groove centres in the plane of axis and ball.

use crate::Deviation;

/// Position of a ball's inner groove centre relative to the outer one, in the plane (radial, axial).
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct PlaneMotion {
    /// s \[m\].
    pub s: [f64; 2],
    /// ṡ \[m/s\].
    pub rate: [f64; 2],
    /// Surface deviation of race and ball at both contacts.
    pub deviation: Deviation,
}

impl PlaneMotion {
    /// The same position at rest.
    pub fn stopped(&self) -> Self {
        let deviation = Deviation { rate: [0.0; 2], undamped_rate: [0.0; 2], ..self.deviation };
        Self { s: self.s, rate: [0.0; 2], deviation }
    }
}
