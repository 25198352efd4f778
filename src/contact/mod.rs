//! Contact of ball and race: the dry Hertz law with exact elliptic integrals, and traction.

pub mod damping;
pub mod elliptic;
pub mod hertz;
pub mod law;
pub mod lubricant;
pub mod pair;
pub mod traction;

pub use damping::ContactDamping;
pub use hertz::{EllipticContact, HertzPair};
pub use law::{ContactLaw, PowerLaw};
pub use lubricant::Lubricant;
pub use pair::{BallContacts, Loaded, Race, SpeedContacts};
pub use traction::Traction;
