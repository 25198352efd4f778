//! Bushing: linear 6 × 6 spring-damper between two anchors.

use super::anchor::Anchor;

/// Linear spring-damper between two anchors.
///
/// With d = (displacement and rotation of `a`'s point) − (those of `b`'s point), the force on `a` is
/// f_a = −K d − C ḋ and the force on `b` is −f_a (moved to each node through the offsets).
#[derive(Clone, Debug, PartialEq)]
pub struct Bushing {
    pub name: String,
    pub a: Anchor,
    pub b: Anchor,
    /// Stiffness K \[N/m, N/rad, N m/m, N m/rad\], order u_x u_y u_z θ_x θ_y θ_z.
    pub stiffness: [[f64; 6]; 6],
    /// Damping C, same order \[N s/m ...\].
    pub damping: [[f64; 6]; 6],
}
