//! Edges: one owner per foreign crate or file format.

pub mod parry;
