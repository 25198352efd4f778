//! The laws by which a contact carries load.

use super::ehl::EhlLaw;
use super::{Lubricant, PowerLaw};

/// How the two contacts of a ball carry load, as chosen for a bearing.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum ContactLaw {
    /// Dry elastic contact.
    #[default]
    Hertz,
    /// Hertz contact behind a film of Hamrock-Dowson central thickness.
    Film { lubricant: Lubricant, speed_factor: f64 },
    /// Fitted Q = K δⁿ + ΔQ of both contacts together.
    PowerLaw(PowerLaw),
    /// Film solved numerically over loads and speeds, before the machine is computed.
    Ehl(EhlLaw),
}
