//! Model updating with simulated measurements of the same model with other parameters, so that the truth is known.

#[path = "../common/rig.rs"]
mod rig;

mod double_eigenvalues;
mod frf_fit;
mod frf_levels;
mod misfit_study;
mod rig_as_truth;
