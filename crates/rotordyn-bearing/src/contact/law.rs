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

impl ContactLaw {
    /// Lubricant of the law; `None` for a dry one.
    pub fn lubricant(&self) -> Option<&Lubricant> {
        match self {
            Self::Film { lubricant, .. } => Some(lubricant),
            Self::Ehl(law) => Some(&law.lubricant),
            Self::Hertz | Self::PowerLaw(_) => None,
        }
    }

    /// Whether the law has no film, so that loads do not depend on speed.
    pub fn is_dry(&self) -> bool {
        self.lubricant().is_none()
    }

    /// Whether inner and outer contact have a law each, and not only both in series.
    pub fn has_separate_contacts(&self) -> bool {
        match self {
            Self::PowerLaw(_) => false,
            Self::Hertz | Self::Film { .. } | Self::Ehl(_) => true,
        }
    }

    /// Whether the film is that of the formula, which film damping needs.
    pub fn has_film_formula(&self) -> bool {
        match self {
            Self::Film { .. } => true,
            Self::Hertz | Self::Ehl(_) | Self::PowerLaw(_) => false,
        }
    }

    /// Whether the law is based on a Hertz stiffness that may be given.
    pub fn takes_contact_stiffness(&self) -> bool {
        match self {
            Self::Hertz | Self::Film { .. } => true,
            Self::Ehl(_) | Self::PowerLaw(_) => false,
        }
    }
}
