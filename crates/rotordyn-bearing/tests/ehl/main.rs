//! Solved lubricant films: order of convergence, identities of the solution.

#[path = "../common/ehl.rs"]
mod lubricated;

mod convergence;
mod identities;
