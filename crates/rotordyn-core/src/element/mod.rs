//! Mechanical elements (shaft, disc, rigid body, bushing, belt, joint): data with their matrices or forces.

pub mod anchor;
pub mod belt;
pub mod bushing;
pub mod contribution;
pub mod joint;
pub mod rigid_body;
pub mod shaft;
pub mod shaft_contribution;
pub mod shaft_matrices;

pub use anchor::Anchor;
pub use belt::Belt;
pub use bushing::Bushing;
pub use contribution::{Connection, Element, ElementMatrices};
pub use joint::Joint;
pub use rigid_body::{Disc, PointMass, RigidBody};
pub use rotordyn_bearing::material::Material;
pub use shaft::{ShaftElement, ShearCoefficient};
