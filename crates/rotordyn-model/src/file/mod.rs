//! From text to a tree of values with source spans, overridden by variants and `--set`, and typed access to
//! it.
//!
//! The whole file is kept as a tree of spanned values instead of being deserialised into structs: a derived
//! deserialiser stops at its first error and loses the spans of tagged enums, while a reader of the tree
//! continues and so reports all problems of a file at once, each with its exact span.

pub(crate) mod diagnostic;
pub(crate) mod given;
pub(crate) mod items;
pub mod key;
pub(crate) mod overlay;
pub(crate) mod quantities;
pub(crate) mod reader;
pub(crate) mod renamed;
mod synonyms;
pub(crate) mod tree;

pub use diagnostic::{DefaultValue, Diagnostic, Kind, ModelErrors, Source};
pub use given::GivenValue;
