//! Changed input for every reader of text and files: seeds are mutated, run in a worker process with limits, and what
//! crashes, panics, takes too much time or memory is kept.
//!
//! CONTRIBUTING.md says how to run it. The same seed gives the same inputs and findings.

pub mod corpus;
pub mod dictionary;
pub mod engine;
pub mod feature;
pub mod finding;
pub mod folders;
pub mod hdf5_reader;
pub mod limits;
pub mod mutator;
pub mod outcome;
pub mod targets;
pub mod worker;
