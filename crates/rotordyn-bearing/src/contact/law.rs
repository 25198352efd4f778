//! Contact laws: load versus approach.

use super::ehl::EhlLaw;
use super::{Lubricant, PowerLaw};
use serde::{Deserialize, Serialize};

/// Contact law of a ball's two contacts, as selected for a bearing.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub enum ContactLaw {
    /// Dry elastic Hertzian contact.
    #[default]
    Hertz,
    /// Hertzian contact in series with a film of Hamrock-Dowson central thickness.
    Film { lubricant: Lubricant, speed_factor: f64 },
    /// Fitted power law Q = K δⁿ + ΔQ of both contacts in series.
    PowerLaw(PowerLaw),
    /// Numerical EHL film, tabulated over loads and speeds before the machine is computed.
    Ehl(EhlLaw),
}
