//! Rotor dynamics: a machine of flexible shafts and bodies on bearings, from its parts to the results of its studies.
//!
//! | module | contents |
//! |---|---|
//! | [`conventions`] | axes, order of DOFs, signs, symbols |
//! | [`series`] | numbers in memory or read from where they are stored |
//! | [`document`] | results as named quantities with units, for files and tables |
//! | [`warning`] | restrictions of results as data with codes |
//! | [`element`] | shaft elements, discs, bodies, bushings, joints, belts |
//! | [`model`] | the machine and its studies in SI units |
//! | [`geometry`] | bearings and machine as solids: overlaps, multibody balls and cage, meshes, scenes |
//! | [`assembly`] | degrees of freedom, system matrices, eliminated joints, rigid-body modes |
//! | [`analysis`] | equilibrium, modes, Campbell, critical speeds, FRFs, unbalance, stability |
//! | [`transient`] | model reduction, time integration, energy balance |
//! | [`results`], [`study`] | results of the studies; the studies, one method of [`study::Machine`] each |
//!
//! Imports go down this table only. No module knows files, pictures or the command line.

pub mod conventions;
pub mod document;
pub mod element;
pub mod model;
pub mod series;

pub mod geometry;

pub mod assembly;

pub mod analysis;

pub mod transient;

pub mod results;
pub mod study;
pub mod warning;
