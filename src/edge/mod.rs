//! Edges: one owner per foreign crate or file format.
