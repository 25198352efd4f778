//! Assembly: from the model to a DOF map, matrices and load vectors.
//!
//! M q̈ + (C + Ω G) q̇ + (K + Ω̇ K_s + Ω K_c) q = f over the free DOFs q; q_full = T q holds six DOFs per
//! node, shaft nodes first, then bodies. θ_z of a shaft node is its twist relative to the drive's rotation.

pub mod dense_limit;
pub mod dofs;
mod elements;
mod equations;
mod error;
pub mod linear_system;
pub mod modal_damping;
pub mod rigid_body_modes;
mod spin_up;
mod standstill;

pub use dofs::DofMap;
pub use equations::{Assembly, Site, UnbalanceForce};
pub use error::PhysicsError;
pub use linear_system::LinearSystem;
pub use modal_damping::ModalDamping;
pub use spin_up::SpinUpForm;
