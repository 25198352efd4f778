//! Bearing and machine geometry as solids: overlap checks, multibody balls and cage, meshes, scenes.

pub mod mesh;
pub mod parry;
pub mod rapier;
pub mod scene;
pub mod scene_graph;
