//! Ideal joint: kinematic constraints on relative motions, eliminated from the equations.

use super::anchor::Anchor;

/// Ideal joint between two anchors; the locked relative motions are eliminated (no penalty stiffness).
#[derive(Clone, Debug, PartialEq)]
pub struct Joint {
    pub name: String,
    pub a: Anchor,
    pub b: Anchor,
    /// Which of the relative u_x u_y u_z θ_x θ_y θ_z are constrained to zero.
    ///
    /// Spherical: u_x u_y u_z. Cylindrical: u_x u_y θ_x θ_y. Revolute: u_x u_y u_z θ_x θ_y. Fixed: all six.
    pub locked: [bool; 6],
}
