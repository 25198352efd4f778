//! Contact of ball and race: the dry Hertz law with exact elliptic integrals.

pub mod elliptic;
pub mod hertz;

pub use hertz::{EllipticContact, HertzPair};
