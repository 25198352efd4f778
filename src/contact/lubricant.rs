//! Lubricating oil at its operating temperature.

/// Oil at one temperature: what film formulae and the numerical point contact need.
#[derive(Clone, Debug, PartialEq)]
pub struct Lubricant {
    pub name: String,
    /// Dynamic viscosity η₀ at ambient pressure \[Pa s\].
    pub viscosity: f64,
    /// Pressure-viscosity coefficient α \[1/Pa\].
    pub pressure_viscosity: f64,
    /// Density ρ₀ at ambient pressure \[kg/m³\].
    pub density: f64,
}

impl Lubricant {
    /// Roelands' reference pressure p_r \[Pa\].
    const REFERENCE: f64 = 1.96e8;

    /// Roelands' exponent z = α p_r / (ln η₀ + 9.67), η₀ in Pa s.
    pub fn roelands_exponent(&self) -> f64 {
        self.pressure_viscosity * Self::REFERENCE / (self.viscosity.ln() + 9.67)
    }

    /// Viscosity ratio η/η₀ at a pressure p ≥ 0 \[Pa\]: exp((ln η₀ + 9.67) (−1 + (1 + p/p_r)^z)).
    ///
    /// Its slope at p = 0 is α. Source: Roelands 1966.
    pub fn viscosity_ratio(&self, pressure: f64) -> f64 {
        let power = (1.0 + pressure / Self::REFERENCE).powf(self.roelands_exponent());
        ((self.viscosity.ln() + 9.67) * (power - 1.0)).exp()
    }

    /// d ln η/dp \[1/Pa\] at a pressure p ≥ 0 \[Pa\]; α at p = 0.
    pub fn log_viscosity_slope(&self, pressure: f64) -> f64 {
        let power = (1.0 + pressure / Self::REFERENCE).powf(self.roelands_exponent() - 1.0);
        self.pressure_viscosity * power
    }

    /// Density ratio ρ/ρ₀ at a pressure p ≥ 0 \[Pa\]: (5.9e8 + 1.34 p) / (5.9e8 + p).
    ///
    /// Source: Dowson & Higginson 1966.
    pub fn density_ratio(&self, pressure: f64) -> f64 {
        (5.9e8 + 1.34 * pressure) / (5.9e8 + pressure)
    }

    /// d(ρ/ρ₀)/dp \[1/Pa\] at a pressure p ≥ 0 \[Pa\].
    pub fn density_slope(&self, pressure: f64) -> f64 {
        0.34 * 5.9e8 / (5.9e8 + pressure).powi(2)
    }
}
