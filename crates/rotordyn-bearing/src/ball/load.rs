//! Load of one ball.

use crate::bearing_contact::BearingContact;

/// Contact of the bearing that is a ball.
pub type BallLoad = BearingContact;
