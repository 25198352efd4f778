//! Distance of a ball from rings and cage.

use nalgebra::{Isometry3, Point3};
use parry3d_f64::math::Pose;
use parry3d_f64::query;
use parry3d_f64::shape::{Ball, Shape};

use super::convert::{pose, vector};
use super::shape::ExactShape;
use crate::geometry::{BearingShapes, Race};

impl BearingShapes {
    /// Gap between a ball and a race's ring \[m\], negative when they overlap; NaN only from non-finite
    /// input.
    ///
    /// `ring`: pose of that ring; `ball`: the ball's centre \[m\].
    pub fn race_gap(&self, race: Race, ring: &Isometry3<f64>, ball: &Point3<f64>) -> f64 {
        let shape = match race {
            Race::Inner => &self.inner,
            Race::Outer => &self.outer,
        };
        gap(&ExactShape(*shape), ring, ball, 0.5 * self.ball_diameter)
    }
}

/// Signed gap between a shape and a ball by parry's contact query: negative when they overlap.
pub(super) fn gap(shape: &dyn Shape, at: &Isometry3<f64>, centre: &Point3<f64>, radius: f64) -> f64 {
    let ball = Pose::from_translation(vector(&centre.coords));
    // Unlimited prediction distance: the contact is found for any gap.
    match query::contact(&pose(at), shape, &ball, &Ball::new(radius), f64::MAX) {
        Ok(Some(contact)) => contact.dist,
        // Only non-finite input leads here; a NaN gap is no overlap and no distance.
        _ => f64::NAN,
    }
}
