//! A model held against measurements: of itself with other numbers, where the truth is known.

#[path = "../common/rig.rs"]
mod rig;

mod double_eigenvalues;
mod frf_fit;
mod rig_as_truth;
