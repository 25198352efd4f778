//! Rigid bodies (housing, bench block), discs and point masses: inertia only.

use super::anchor::Anchor;
use super::contribution::{Element, ElementMatrices};

/// Rigid body with six DOFs at its centre of mass; does not rotate with the shaft.
#[derive(Clone, Debug, PartialEq)]
pub struct RigidBody {
    pub name: String,
    /// Position of the centre of mass \[m\] in the model's axes (shaft axis: x = y = 0).
    pub position: [f64; 3],
    /// Mass along x, y and z \[kg\], equal save for the modal mass of a support.
    pub mass: [f64; 3],
    /// Inertia tensor about the centre of mass \[kg m²\], row-major, symmetric.
    pub inertia: [[f64; 3]; 3],
}

/// Rigid disc fixed to a shaft node; rotates with the shaft (gyroscopic moment).
#[derive(Clone, Debug, PartialEq)]
pub struct Disc {
    pub name: String,
    /// Shaft node that carries the disc.
    pub node: usize,
    /// Mass m \[kg\].
    pub mass: f64,
    /// Polar moment of inertia I_p about z \[kg m²\].
    pub polar_inertia: f64,
    /// Diametral moment of inertia I_d about x and y \[kg m²\].
    pub diametral_inertia: f64,
    /// Outer diameter \[m\], for drawings and impacts at the rim; 0 when the disc is given by inertia alone.
    pub outer_diameter: f64,
    /// Axial thickness \[m\], for drawings; 0 when unknown.
    pub thickness: f64,
}

/// Point mass rigidly attached to a body or station, such as an accelerometer; no rotary inertia of its own.
#[derive(Clone, Debug, PartialEq)]
pub struct PointMass {
    pub name: String,
    pub anchor: Anchor,
    /// Mass along x, y and z \[kg\], equal save for the added mass of a seal or the like.
    pub mass: [f64; 3],
}

impl Element for RigidBody {
    fn add_matrices(&self, node: usize, to: &mut ElementMatrices) {
        let at = 6 * node;
        for i in 0..3 {
            to.mass.add(at + i, at + i, self.mass[i]);
            for j in 0..3 {
                to.mass.add(at + 3 + i, at + 3 + j, self.inertia[i][j]);
            }
        }
    }
}

impl Element for Disc {
    fn add_matrices(&self, _node: usize, to: &mut ElementMatrices) {
        let at = 6 * self.node;
        let (mass, id, ip) = (self.mass, self.diametral_inertia, self.polar_inertia);
        for (i, v) in [mass, mass, mass, id, id, ip].into_iter().enumerate() {
            to.mass.add(at + i, at + i, v);
        }
        to.gyroscopic.add(at + 3, at + 4, ip);
        to.gyroscopic.add(at + 4, at + 3, -ip);
    }
}

impl Element for PointMass {
    fn add_matrices(&self, _node: usize, to: &mut ElementMatrices) {
        for (row, mass) in self.anchor.rows().into_iter().zip(self.mass) {
            to.mass.add_between_rows(&[row], &[[mass]]);
        }
    }
}
