//! Contact of ball and race: the dry Hertz law with exact elliptic integrals, and traction.

pub mod elliptic;
pub mod hertz;
pub mod lubricant;
pub mod traction;

pub use hertz::{EllipticContact, HertzPair};
pub use lubricant::Lubricant;
pub use traction::Traction;
