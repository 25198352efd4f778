//! What the evaluation of a row depends on.

use super::Rotation;

/// Motion of the inner ring relative to the outer one at one instant, and what else moves the contacts.
#[derive(Clone, Copy, Debug)]
pub(super) struct RingMotion<'a> {
    /// Displacement \[m, rad\] and velocity \[m/s, rad/s\].
    pub d: &'a [f64; 6],
    pub v: &'a [f64; 6],
    pub rotation: &'a Rotation,
    /// Cage speed that counts as motion of the contacts \[rad/s\]; 0 in statics, where nothing passes.
    pub cage_speed: f64,
    /// Whether waves, defects and off-size balls count.
    pub with_defects: bool,
}

impl<'a> RingMotion<'a> {
    /// A ring held at a displacement, with nothing that passes.
    pub fn at_rest(d: &'a [f64; 6], rotation: &'a Rotation, with_defects: bool) -> Self {
        Self { d, v: &[0.0; 6], rotation, cage_speed: 0.0, with_defects }
    }

    /// The rotation by which surfaces pass: without speeds where the cage's does not count.
    #[inline]
    pub fn passing(&self) -> Rotation {
        let shaft_speed = if self.cage_speed == 0.0 { 0.0 } else { self.rotation.shaft_speed };
        Rotation { cage_speed: self.cage_speed, shaft_speed, ..*self.rotation }
    }
}
