//! The laws by which a contact carries load.

use super::Lubricant;

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
}

/// Q = K δⁿ + ΔQ between the two races, fitted over a range of loads.
///
/// Source: Zhang 2016 eq. 11.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PowerLaw {
    /// K \[N/mⁿ\].
    pub stiffness: f64,
    /// n.
    pub exponent: f64,
    /// ΔQ \[N\].
    pub offset: f64,
    /// Loads over which the fit was made \[N\]; outside a warning is due.
    pub range: [f64; 2],
}
