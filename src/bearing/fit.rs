//! Fits, temperatures and speed: what changes a mounted bearing's clearance.

/// Mounting and operating conditions of the rings.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Fit {
    /// Diametral interference of shaft and bore \[m\]; 0 for a loose fit.
    pub shaft_interference: f64,
    /// Bore of a hollow shaft \[m\]; 0 for a solid one.
    pub shaft_bore: f64,
    /// Diametral interference of outer ring and housing \[m\]; 0 for a loose fit.
    pub housing_interference: f64,
    /// Outside diameter of the housing \[m\]; 0 for a rigid, infinitely thick one.
    pub housing_diameter: f64,
    /// Temperatures of inner ring with shaft and of outer ring with housing above assembly \[K\].
    pub inner_temperature_rise: f64,
    pub outer_temperature_rise: f64,
    /// Coefficient of thermal expansion \[1/K\].
    pub expansion: f64,
    /// Whether the inner ring grows by its own rotation.
    pub speed_growth: bool,
}
