//! Settings of a modal identification.

use rotordyn_linalg::StopRequest;
use rotordyn_signal::Quantity;

/// Residual terms of the fit: what modes outside the band contribute to the FRFs inside it.
///
/// A structure on the ground has no rigid-body modes, and with a band from its lowest mode on no lower residual; a free one
/// has both.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ResidualTerms {
    /// Upper and lower residual.
    #[default]
    Both,
    /// Upper residual U alone: stiffness of the modes above the band.
    Upper,
    /// Lower residual V/s² alone: mass of the modes below the band, rigid-body modes among them.
    Lower,
    /// No residual: the modes in the band are all.
    None,
}

impl ResidualTerms {
    pub fn has_upper(self) -> bool {
        matches!(self, Self::Both | Self::Upper)
    }

    pub fn has_lower(self) -> bool {
        matches!(self, Self::Both | Self::Lower)
    }

    /// These terms, with the upper or the lower one added.
    pub(super) fn with(self, upper: bool, lower: bool) -> Self {
        match (self.has_upper() || upper, self.has_lower() || lower) {
            (true, true) => Self::Both,
            (true, false) => Self::Upper,
            (false, true) => Self::Lower,
            (false, false) => Self::None,
        }
    }
}

/// Settings of modal identification.
#[derive(Clone, Debug, PartialEq)]
pub struct Settings {
    /// Frequency band \[Hz\]; all measured lines if `None`.
    pub band: Option<[f64; 2]>,
    /// Highest model order (of the denominator); 60, or the maximum for the number of lines, if `None`.
    pub max_order: Option<usize>,
    /// Quantity of the FRFs, if not given by their unit; accelerance if `None`.
    pub quantity: Option<Quantity>,
    pub residual_terms: ResidualTerms,
    /// Largest damping ratio of a mode.
    pub largest_damping: f64,
    /// Decay rate added to all poles by an exponential window \[1/s\], corrected in the result.
    pub added_decay: f64,
    /// Ends the identification from another thread.
    pub stop: StopRequest,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            band: None,
            max_order: None,
            quantity: None,
            residual_terms: ResidualTerms::Both,
            largest_damping: 0.5,
            added_decay: 0.0,
            stop: StopRequest::default(),
        }
    }
}
