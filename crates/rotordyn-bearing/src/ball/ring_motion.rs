//! Motion of the inner ring, as the input of every bearing evaluation.

use crate::Rotation;

/// Motion of the inner ring relative to the outer one, and of the cage, at one instant.
#[derive(Clone, Copy, Debug)]
pub(super) struct RingMotion<'a> {
    /// Displacement \[m, rad\] and velocity \[m/s, rad/s\].
    pub d: &'a [f64; 6],
    pub v: &'a [f64; 6],
    pub rotation: &'a Rotation,
    /// Cage speed as motion of the contacts \[rad/s\]; `None` while they are at rest.
    pub cage_speed: Option<f64>,
    /// Cage speed of the balls' inertial loads \[rad/s\].
    pub orbit: f64,
    /// Whether waviness, defects and off-size balls are included.
    pub with_defects: bool,
}

impl<'a> RingMotion<'a> {
    /// Static case: the ring at rest at a displacement, the contacts at rest, inertial loads at a cage speed.
    pub fn at_rest(d: &'a [f64; 6], rotation: &'a Rotation, orbit: f64, with_defects: bool) -> Self {
        Self { d, v: &[0.0; 6], rotation, cage_speed: None, orbit, with_defects }
    }

    /// The static case of this motion at a displacement.
    pub fn stopped_at<'b>(&self, d: &'b [f64; 6]) -> RingMotion<'b>
    where
        'a: 'b,
    {
        RingMotion { d, v: &[0.0; 6], cage_speed: None, ..*self }
    }

    /// Rotation with the surface speeds of the contacts: zero in statics.
    #[inline]
    pub fn passing(&self) -> Rotation {
        let shaft_speed = if self.cage_speed.is_none() { 0.0 } else { self.rotation.shaft_speed };
        Rotation { cage_speed: self.cage_speed, shaft_speed, ..*self.rotation }
    }
}
