//! A scene graph: meshes with their materials, and the nodes that position them.

use super::mesh::Mesh;

/// Parts to display, in metres, y up: the model's axes are those of glTF.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Scene {
    pub name: String,
    pub meshes: Vec<MaterialMesh>,
    /// Children come after their parent; nodes without a parent are the roots of the scene.
    pub nodes: Vec<Node>,
}

/// A mesh and its material (glTF).
#[derive(Clone, Debug, PartialEq)]
pub struct MaterialMesh {
    pub mesh: Mesh,
    pub material: Material,
}

/// Material: colour (linear red, green, blue, opacity), metallic share and roughness, each in 0 to 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Material {
    pub name: &'static str,
    pub colour: [f64; 4],
    pub metallic: f64,
    pub roughness: f64,
}

/// A part at its position; several nodes may use the same mesh.
#[derive(Clone, Debug, PartialEq)]
pub struct Node {
    pub name: String,
    pub mesh: Option<usize>,
    pub translation: [f64; 3],
    /// Unit quaternion x, y, z, w.
    pub rotation: [f64; 4],
    pub children: Vec<usize>,
}

impl Node {
    /// Node without rotation or children.
    pub fn translated(name: impl Into<String>, mesh: Option<usize>, translation: [f64; 3]) -> Self {
        Self { name: name.into(), mesh, translation, rotation: [0.0, 0.0, 0.0, 1.0], children: vec![] }
    }
}
