//! Attachment point of an element: a node of the model or ground, with an offset.

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
}
