//! Data of mode shape figures.

use super::campbell::Whirl;
use super::symbols::SupportSymbol;
use super::vector::cross;

/// Simplified machine drawn in the panels.
#[derive(Clone, Debug, Default)]
pub struct Rotor {
    /// Axial positions of the shaft nodes \[m\], ascending.
    pub z: Vec<f64>,
    pub discs: Vec<RotorDisc>,
    pub supports: Vec<RotorSupport>,
    pub bodies: Vec<BodyBox>,
    /// Nodes whose orbits are drawn; empty for an even selection.
    pub orbit_nodes: Vec<usize>,
}

/// A disc on a shaft node.
#[derive(Clone, Copy, Debug)]
pub struct RotorDisc {
    pub node: usize,
    /// Radius \[m\].
    pub radius: f64,
}

/// A support of the shaft on the ground; one in a body is drawn as its body.
#[derive(Clone, Copy, Debug)]
pub struct RotorSupport {
    /// Axial position \[m\].
    pub z: f64,
    pub symbol: SupportSymbol,
}

/// A body (housing, block, foundation), drawn as a box.
#[derive(Clone, Debug)]
pub struct BodyBox {
    pub name: String,
    /// Centre of mass \[m\].
    pub centre: [f64; 3],
    /// Vectors from the centre to the middle of three faces \[m\].
    pub half_edges: [[f64; 3]; 3],
    /// Spring and damper to the ground.
    pub to_ground: (bool, bool),
}

impl BodyBox {
    /// Corners \[m\].
    pub(super) fn corners(&self) -> impl Iterator<Item = [f64; 3]> {
        self.arms().map(|r| [0, 1, 2].map(|i| self.centre[i] + r[i]))
    }

    /// Corners from the centre \[m\].
    pub(super) fn arms(&self) -> impl Iterator<Item = [f64; 3]> {
        let [a, b, c] = self.half_edges;
        (0..8).map(move |k| {
            let sign = |bit: usize| if k >> bit & 1 == 0 { -1.0 } else { 1.0 };
            [0, 1, 2].map(|i| sign(0) * a[i] + sign(1) * b[i] + sign(2) * c[i])
        })
    }
}

/// Motion of a body in a mode: complex displacement \[re, im\] of its centre and rotation, in x, y, z, with the
/// scale of the mode.
#[derive(Clone, Copy, Debug, Default)]
pub struct BodyMotion {
    pub u: [[f64; 2]; 3],
    pub theta: [[f64; 2]; 3],
}

impl BodyMotion {
    /// Displacement of the point at `r` \[m\] from the centre, u + θ × r.
    pub(super) fn at(&self, r: [f64; 3]) -> [[f64; 2]; 3] {
        let turn = [0, 1].map(|part| cross(self.theta.map(|t| t[part]), r));
        [0, 1, 2].map(|i| [self.u[i][0] + turn[0][i], self.u[i][1] + turn[1][i]])
    }
}

/// One mode; complex amplitudes \[re, im\] at every node, motion Re(u e^{iωt}), arbitrary common scale.
#[derive(Clone, Debug)]
pub struct ModeShape {
    /// E.g. "27.1 Hz, 1st bending, forward".
    pub title: String,
    pub whirl: Whirl,
    pub u_x: Vec<[f64; 2]>,
    pub u_y: Vec<[f64; 2]>,
    /// Axial displacement; may be empty.
    pub u_z: Vec<[f64; 2]>,
    /// Tilts and twist \[rad\]; may be empty.
    pub theta_x: Vec<[f64; 2]>,
    pub theta_y: Vec<[f64; 2]>,
    pub theta_z: Vec<[f64; 2]>,
    /// One for every body of the rotor.
    pub bodies: Vec<BodyMotion>,
}
