//! Bearing and machine geometry as solids: meshes and scenes; with the feature `shapes` exact distances and overlaps
//! (parry) and balls and cage as bodies (rapier).

pub mod bearing_shapes;
pub mod cage;
pub mod contact_surfaces;
pub mod mesh;
#[cfg(feature = "shapes")]
pub mod parry;
#[cfg(feature = "shapes")]
pub mod rapier;
pub mod ring;
pub mod scene;
pub mod scene_graph;
pub mod solid;

pub use bearing_shapes::{BearingMasses, BearingPose, BearingShapes, Race};
pub use cage::CageShape;
pub use ring::Ring;
pub use solid::{ExactSolid, RevolvedSolid};
