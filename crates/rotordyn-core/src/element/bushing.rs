//! Bushing: linear 6 × 6 spring-damper between two anchors.

use super::anchor::Anchor;
use super::contribution::{Connection, Element, ElementMatrices, relative_rows};

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

impl Element for Bushing {
    fn add_matrices(&self, _node: usize, to: &mut ElementMatrices) {
        let rows = relative_rows(&self.a, &self.b);
        to.stiffness.add_between_rows(&rows, &self.stiffness);
        to.damping.add_between_rows(&rows, &self.damping);
        to.support_damping.add_between_rows(&rows, &self.damping);
    }

    fn connection(&self) -> Option<Connection> {
        let k = &self.stiffness;
        let found = Connection {
            name: format!("bushing.{}", self.name),
            ends: [self.a, self.b],
            stiff: std::array::from_fn(|i| k[i][i] != 0.0),
        };
        k.iter().flatten().any(|v| *v != 0.0).then_some(found)
    }
}
