//! Attachment point of an element: a node of the model or ground, with an offset.

use rotordyn_linalg::SparseRow;
use serde::{Deserialize, Serialize};

/// Attachment point: a node (shaft node or body) or ground, with a rigid offset.
///
/// Nodes are numbered shaft nodes first (0 .. n_shaft), then rigid bodies in file order;
/// node `k` owns DOFs `6 k .. 6 k + 6` = u_x u_y u_z θ_x θ_y θ_z before joints are eliminated.
/// For ground (`node = None`) the offset is the position in the model's axes.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Anchor {
    pub node: Option<usize>,
    /// Offset from the node (body: from its centre of mass) \[m\] in the model's axes.
    pub offset: [f64; 3],
}

impl Anchor {
    /// Anchor at a node itself, without offset.
    pub const fn node(node: usize) -> Self {
        Self { node: Some(node), offset: [0.0; 3] }
    }

    /// Anchor on ground.
    pub const GROUND: Self = Self { node: None, offset: [0.0; 3] };

    /// Displacement of the point over all DOFs: u + θ × r and θ; no entries for ground.
    pub fn rows(&self) -> [SparseRow; 6] {
        let Some(node) = self.node else { return Default::default() };
        let [x, y, z] = self.offset;
        let at = 6 * node;
        let row = |terms: &[(usize, f64)]| {
            SparseRow(terms.iter().filter(|t| t.1 != 0.0).map(|&(i, v)| (at + i, v)).collect())
        };
        [
            row(&[(0, 1.0), (4, z), (5, -y)]),
            row(&[(1, 1.0), (3, -z), (5, x)]),
            row(&[(2, 1.0), (3, y), (4, -x)]),
            row(&[(3, 1.0)]),
            row(&[(4, 1.0)]),
            row(&[(5, 1.0)]),
        ]
    }
}
