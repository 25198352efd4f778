//! Contact of ball and race: Hertzian contact with exact elliptic integrals, EHL film, contact damping,
//! traction.

pub mod damping;
pub mod ehl;
pub mod elliptic;
pub mod film;
pub mod hertz;
pub mod law;
mod load;
pub mod lubricant;
pub mod pair;
pub mod power_law;
pub mod traction;

pub use damping::{ContactDamping, Damped};
pub use film::{FilmFormula, FilmSpring, lambda_ratio};
pub use hertz::{ContactPatch, ContactStiffness, EllipticContact, HertzPair};
pub use law::ContactLaw;
pub use lubricant::Lubricant;
pub use pair::{BallContacts, ContactLoad, Race, SpeedContacts};
pub use power_law::{PowerLaw, PowerSpring, fit_power_law};
pub use traction::Traction;
