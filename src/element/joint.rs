//! Ideal joint: relative motions that are exactly zero, eliminated from the equations.

use super::anchor::Anchor;

/// Ideal joint between two anchors; the locked relative motions are eliminated, not penalised.
#[derive(Clone, Debug, PartialEq)]
pub struct Joint {
    pub name: String,
    pub a: Anchor,
    pub b: Anchor,
    /// Which of the relative u_x u_y u_z θ_x θ_y θ_z are held at zero.
    ///
    /// Spherical: u_x u_y u_z. Cylindrical: u_x u_y θ_x θ_y. Revolute: u_x u_y u_z θ_x θ_y. Fixed: all six.
    pub locked: [bool; 6],
}
