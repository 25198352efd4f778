//! Lubricant properties at operating temperature: viscosity, pressure-viscosity coefficient, density; ISO VG
//! grades.

use serde::{Deserialize, Serialize};

/// Lubricating oil at one temperature, for film formulae and the numerical EHL contact.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Lubricant {
    pub name: String,
    /// Dynamic viscosity η₀ at ambient pressure \[Pa s\].
    pub viscosity: f64,
    /// Pressure-viscosity coefficient α \[1/Pa\].
    pub pressure_viscosity: f64,
    /// Density ρ₀ at ambient pressure \[kg/m³\].
    pub density: f64,
}

/// ISO VG grades of mineral oil with a viscosity index of 95: kinematic viscosity at 40 and 100 °C \[mm²/s\] and
/// density at 15 °C \[kg/m³\].
///
/// At 40 °C by definition (ISO 3448); at 100 °C from the viscosity index of 95 (ASTM D2270); densities
/// typical of commercial oils, within 2 %.
const GRADES: [(&str, [f64; 3]); 12] = [
    ("ISO VG 10", [10.0, 2.637, 850.0]),
    ("ISO VG 15", [15.0, 3.381, 858.0]),
    ("ISO VG 22", [22.0, 4.254, 866.0]),
    ("ISO VG 32", [32.0, 5.290, 873.0]),
    ("ISO VG 46", [46.0, 6.644, 877.0]),
    ("ISO VG 68", [68.0, 8.530, 882.0]),
    ("ISO VG 100", [100.0, 11.067, 887.0]),
    ("ISO VG 150", [150.0, 14.544, 893.0]),
    ("ISO VG 220", [220.0, 18.749, 897.0]),
    ("ISO VG 320", [320.0, 23.952, 901.0]),
    ("ISO VG 460", [460.0, 30.340, 905.0]),
    ("ISO VG 680", [680.0, 39.056, 912.0]),
];

/// Temperatures of the two viscosities of a grade, and of its density \[K\].
const VISCOSITY_TEMPERATURE_40: f64 = 313.15;
const VISCOSITY_TEMPERATURE_100: f64 = 373.15;
const DENSITY_TEMPERATURE_15: f64 = 288.15;

impl Lubricant {
    /// Temperatures for which a grade's properties hold \[K\]: −10 to 130 °C.
    pub const GRADE_TEMPERATURES: [f64; 2] = [263.15, 403.15];

    /// Names of the grades supported by [`Lubricant::grade`].
    pub fn grades() -> impl Iterator<Item = &'static str> {
        GRADES.iter().map(|(name, _)| *name)
    }

    /// Mineral oil of an ISO VG grade, such as `"ISO VG 68"`, at a temperature T \[K\].
    ///
    /// log₁₀ log₁₀(ν + 0.7) = A − B log₁₀ T with ν in mm²/s (Walther equation, ASTM D341);
    /// ρ = ρ₁₅ (1 − 6.5e−4 (T − 288.15 K)); η₀ = ρ ν; α = (0.6 + 0.965 log₁₀ η₀) · 1e−8 1/Pa with η₀ in mPa s.
    ///
    /// `None` for an unknown grade or a temperature outside [`Lubricant::GRADE_TEMPERATURES`]. Commercial
    /// oils differ: by 10 % in ν at 40 °C, by their viscosity index at other temperatures, by 15 % and more
    /// in α.
    ///
    /// Source: ISO 3448, ASTM D341 and D2270; Wooster's rule for α of mineral oils.
    pub fn grade(name: &str, temperature: f64) -> Option<Self> {
        let [coldest, hottest] = Self::GRADE_TEMPERATURES;
        let (name, [warm, hot, density]) = GRADES.iter().find(|(grade, _)| *grade == name)?;
        if !(coldest..=hottest).contains(&temperature) {
            return None;
        }
        let line = |viscosity: f64| (viscosity + 0.7).log10().log10();
        let fall =
            (line(*warm) - line(*hot)) / (VISCOSITY_TEMPERATURE_100 / VISCOSITY_TEMPERATURE_40).log10();
        let kinematic = 10f64
            .powf(10f64.powf(line(*warm) - fall * (temperature / VISCOSITY_TEMPERATURE_40).log10()))
            - 0.7;
        let density = density * (1.0 - 6.5e-4 * (temperature - DENSITY_TEMPERATURE_15));
        let viscosity = density * kinematic * 1e-6;
        let pressure_viscosity = (0.6 + 0.965 * (1e3 * viscosity).log10()) * 1e-8;
        Some(Self { name: (*name).into(), viscosity, pressure_viscosity, density })
    }

    /// Kinematic viscosity ν = η₀/ρ₀ \[m²/s\].
    pub fn kinematic_viscosity(&self) -> f64 {
        self.viscosity / self.density
    }

    /// Roelands' reference pressure p_r \[Pa\].
    pub(super) const ROELANDS_PRESSURE: f64 = 1.96e8;

    /// ln η₀ + this is ln(η₀/η_p), η_p = 6.315e-5 Pa s.
    pub(super) const ROELANDS_LOG_VISCOSITY: f64 = 9.67;

    /// Roelands' exponent z = α p_r / (ln η₀ + 9.67), η₀ in Pa s.
    pub fn roelands_exponent(&self) -> f64 {
        self.pressure_viscosity * Self::ROELANDS_PRESSURE / (self.viscosity.ln() + 9.67)
    }

    /// Viscosity ratio η/η₀ at a pressure p ≥ 0 \[Pa\]: exp((ln η₀ + 9.67) (−1 + (1 + p/p_r)^z)).
    ///
    /// Its slope at p = 0 is α. Source: Roelands 1966.
    pub fn viscosity_ratio(&self, pressure: f64) -> f64 {
        let power = (1.0 + pressure / Self::ROELANDS_PRESSURE).powf(self.roelands_exponent());
        ((self.viscosity.ln() + 9.67) * (power - 1.0)).exp()
    }

    /// d ln η/dp \[1/Pa\] at a pressure p ≥ 0 \[Pa\]; α at p = 0.
    pub fn log_viscosity_slope(&self, pressure: f64) -> f64 {
        let power = (1.0 + pressure / Self::ROELANDS_PRESSURE).powf(self.roelands_exponent() - 1.0);
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
