//! Settings of a modal identification.

use rotordyn_signal::Quantity;

/// Settings of modal identification.
#[derive(Clone, Debug, PartialEq)]
pub struct Settings {
    /// Frequency band \[Hz\]; all measured lines if `None`.
    pub band: Option<[f64; 2]>,
    /// Highest model order (of the denominator); 60, or the maximum for the number of lines, if `None`.
    pub max_order: Option<usize>,
    /// Quantity of the FRFs, if not given by their unit; accelerance if `None`.
    pub quantity: Option<Quantity>,
    /// Largest damping ratio of a mode.
    pub largest_damping: f64,
    /// Decay rate added to all poles by an exponential window \[1/s\], corrected in the result.
    pub added_decay: f64,
}

impl Default for Settings {
    fn default() -> Self {
        Self { band: None, max_order: None, quantity: None, largest_damping: 0.2, added_decay: 0.0 }
    }
}
