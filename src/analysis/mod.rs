//! Analyses of the linear and the static problem.
//!
//! | module | answers |
//! |---|---|
//! | [`equilibrium`] | static equilibrium on nonlinear bearings, ball loads, tangents |
//! | [`bearing_stiffness`] | equilibrium and stiffness of one bearing alone under any load |
//! | [`modal`] | natural frequencies, damping, mode shapes, kinds and labels at one speed |
//! | [`campbell`] | the same over speed, tracked by MAC |
//! | [`critical_speed`] | speeds where a mode meets an order line |
//! | [`sensitivity`] | exact derivatives of eigenvalues, shapes and FRFs by any parameter |
//! | [`stability`] | speeds where a mode's damping vanishes |
//! | [`frf`] | frequency response functions at a fixed speed |
//! | [`unbalance`] | steady response to unbalance over speed |

pub mod bearing_stiffness;
pub mod campbell;
pub mod critical_speed;
pub mod equilibrium;
pub mod frf;
pub mod modal;
pub mod mode_kind;
pub mod sensitivity;
pub mod stability;
pub mod unbalance;

pub use modal::Mode;
pub use mode_kind::{Energy, ModeKind};
