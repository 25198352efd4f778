//! rotordyn: a multibody rotor-bearing simulator with a flexible shaft.

#![forbid(unsafe_code)]

pub mod conventions;
pub mod material;
pub mod units;

pub mod linalg;
pub mod signal;

pub mod contact;

pub mod bearing;
pub mod element;

pub mod model;

pub mod assembly;

pub mod analysis;

pub mod transient;

pub mod results;
pub mod study;

pub mod edge;
pub mod error;
