//! Static and linear (small-vibration) analyses.
//!
//! | module | result |
//! |---|---|
//! | [`equilibrium`] | static equilibrium on nonlinear bearings, ball loads, tangent stiffness and damping |
//! | [`equilibrium_path`] | tangents of the bearings at many speeds from the equilibria at some |
//! | [`preload`] | axial force of preloaded bearings in the machine; preload stated by that force |
//! | [`bearing_stiffness`] | load-displacement relation and stiffness matrix of a single bearing |
//! | [`modal`] | natural frequencies, damping, mode shapes, kinds and labels at one speed |
//! | [`campbell`] | modes over speed (Campbell diagram), tracked by MAC |
//! | [`critical_speed`] | critical speeds: intersections of modes with order lines |
//! | [`critical_map`] | undamped critical speeds over the stiffness of the bearings |
//! | [`torsional`] | undamped torsional modes |
//! | [`sensitivity`] | derivatives of eigenvalues, mode shapes and FRFs with respect to any parameter |
//! | [`poles`] | poles of FRFs and of the unbalance response |
//! | [`peaks`] | resonance peaks over speed: amplification factor, separation margin |
//! | [`separation`] | critical speeds with separation margins from the operating speeds |
//! | [`refine`](mod@refine) | grids refined around poles |
//! | [`section_loads`] | shear force, bending moment, axial force and torque along the shaft |
//! | [`shaft_loads`] | deflection and section loads along the shaft, at rest and under unbalance |
//! | [`support_forces`](mod@support_forces) | forces of the supports on the shaft |
//! | [`stability`] | stability thresholds: speeds where a mode's damping vanishes |
//! | [`frf`] | frequency response functions at a fixed speed |
//! | [`harmonic`] | steady harmonic response of a linear system, the common solver of FRF and unbalance |
//! | [`synchronous`] | dynamic stiffness of synchronous motion at several speeds at once |
//! | [`table_range`] | speeds beyond the tables of bearings |
//! | [`unbalance`] | steady-state (synchronous) response to unbalance over speed |

pub mod ball_inertia;
mod bearing_state;
pub mod bearing_stiffness;
pub mod belt_pull;
pub mod campbell;
pub mod critical_map;
pub mod critical_speed;
pub mod divergence;
pub mod equilibrium;
pub mod equilibrium_path;
pub mod frf;
pub mod harmonic;
pub mod modal;
mod mode;
pub mod mode_kind;
mod mounted_preload;
pub mod peaks;
pub mod poles;
pub mod preload;
pub mod refine;
pub mod section_loads;
pub mod sensitivity;
pub mod separation;
pub mod shaft_loads;
pub mod stability;
pub mod support_forces;
pub mod synchronous;
pub mod table_range;
pub mod torsional;
pub mod unbalance;

pub use modal::Mode;
pub(crate) use mode::log_decrement;
pub use mode_kind::{Energy, ModeKind};
