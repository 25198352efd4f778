//! Motion of the inner ring, as the input of every bearing evaluation.

use super::Rotation;

/// Motion of the inner ring relative to the outer one, and of the cage, at one instant.
#[derive(Clone, Copy, Debug)]
pub(super) struct RingMotion<'a> {
    /// Displacement \[m, rad\] and velocity \[m/s, rad/s\].
    pub d: &'a [f64; 6],
    pub v: &'a [f64; 6],
    pub rotation: &'a Rotation,
    /// Cage speed as motion of the contacts \[rad/s\]; 0 in statics.
    pub cage_speed: f64,
    /// Whether waviness, defects and off-size balls are included.
    pub with_defects: bool,
}

impl<'a> RingMotion<'a> {
    /// Static case: the ring at rest at a displacement, the cage speed zero.
    pub fn at_rest(d: &'a [f64; 6], rotation: &'a Rotation, with_defects: bool) -> Self {
        Self { d, v: &[0.0; 6], rotation, cage_speed: 0.0, with_defects }
    }

    /// Rotation with the surface speeds of the contacts: zero in statics.
    #[inline]
    pub fn passing(&self) -> Rotation {
        let shaft_speed = if self.cage_speed == 0.0 { 0.0 } else { self.rotation.shaft_speed };
        Rotation { cage_speed: self.cage_speed, shaft_speed, ..*self.rotation }
    }
}
