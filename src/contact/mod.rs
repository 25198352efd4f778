//! Contact of ball and race: the dry Hertz law with exact elliptic integrals, and traction.

pub mod elliptic;
pub mod hertz;
pub mod traction;

pub use hertz::{EllipticContact, HertzPair};
pub use traction::Traction;
