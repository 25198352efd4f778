//! Interface of all elements: their part of the matrices and loads, and what it connects.

use super::anchor::Anchor;
use super::shaft_matrices::ConeRule;
use rotordyn_linalg::{SparseRow, Triplets};

/// Matrices over all DOFs (six per node), to which the elements add their parts.
#[derive(Debug)]
pub struct ElementMatrices {
    /// Mass M.
    pub mass: Triplets,
    /// Stiffness K.
    pub stiffness: Triplets,
    /// Stiffness against deviations from the equilibrium, without effect in statics.
    pub deviation_stiffness: Triplets,
    /// Damping C.
    pub damping: Triplets,
    /// The part of C between the rotating shaft and its supports, which brakes the rotation.
    pub support_damping: Triplets,
    /// Gyroscopic matrix G, per rad/s.
    pub gyroscopic: Triplets,
    /// Circulatory stiffness K_c, per rad/s.
    pub circulatory: Triplets,
    /// Integration of conical shaft elements.
    pub cone_rule: ConeRule,
}

impl ElementMatrices {
    /// Empty matrices over n DOFs.
    pub fn new(n: usize, cone_rule: ConeRule) -> Self {
        let [mass, stiffness, deviation_stiffness, damping, support_damping, gyroscopic, circulatory] =
            std::array::from_fn(|_| Triplets::new(n, n));
        Self {
            mass,
            stiffness,
            deviation_stiffness,
            damping,
            support_damping,
            gyroscopic,
            circulatory,
            cone_rule,
        }
    }
}

/// Two points that an element holds together by stiffness.
#[derive(Clone, Debug, PartialEq)]
pub struct Connection {
    /// As in the model file: "bushing.mount".
    pub name: String,
    pub ends: [Anchor; 2],
    /// Directions u_x u_y u_z θ_x θ_y θ_z with stiffness.
    pub stiff: [bool; 6],
}

/// An element: everything that assembly and checks need to know of it.
pub trait Element {
    /// Adds the element's part of the matrices; `node`: the left node of a shaft element, the own node of a body.
    fn add_matrices(&self, node: usize, to: &mut ElementMatrices);

    /// Adds its constant load, beside gravity on its mass, over all DOFs \[N, N m\].
    fn add_load(&self, _to: &mut [f64]) {}

    /// The points it connects by stiffness; `None` for an inertia, the shaft, or without stiffness.
    fn connection(&self) -> Option<Connection> {
        None
    }
}

/// Displacement of the point of `a` relative to that of `b` over all DOFs.
pub fn relative_rows(a: &Anchor, b: &Anchor) -> [SparseRow; 6] {
    let (mut rows, other) = (a.rows(), b.rows());
    for (row, b) in rows.iter_mut().zip(&other) {
        row.add_scaled(-1.0, b);
    }
    rows
}
