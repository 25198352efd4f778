//! Friction laws of the contact of ball and race: local shear stress over slip and pressure.

use crate::contact::{FilmFormula, Lubricant, Traction};

/// Friction law of balls and races.
#[derive(Clone, Debug, PartialEq)]
pub enum FrictionLaw {
    /// Regularised Coulomb, τ = μ p v/√(v² + v₀²).
    Coulomb(Traction),
    /// Traction curve of an EHL contact.
    Curve(TractionCurve),
    /// Shear of the bearing's lubricant film.
    Film(FilmShear),
}

/// EHL traction curve μ(v) = (A + B v) e^{−C v} + D with A = −D, so that μ(0) = 0.
///
/// Slope at rest B + C D; μ → D at large slip; with B = 0 no maximum. Source: Gupta, Advanced Dynamics of Rolling
/// Elements, 1984 (regression of measured curves).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TractionCurve {
    /// D \[-\].
    pub limit: f64,
    /// B \[s/m\].
    pub slope: f64,
    /// C \[s/m\].
    pub decay: f64,
}

/// Shear of a lubricant film of central thickness h: τ_E asinh(s v/τ_E) with s = η(p)/h, limited to Λ p.
///
/// τ = τ_v/√(1 + (τ_v/(Λ p))²), τ_v the above. s is limited to Λ p/v₀, so that without film (no entrainment) the law is
/// dry friction with the coefficient Λ. h by Hamrock & Dowson at the contact's entrainment speed, η(p) by Roelands.
/// Source: Johnson & Tevaarwerk 1977 (Eyring stress), Bair & Winer 1979 (limiting stress).
#[derive(Clone, Debug, PartialEq)]
pub struct FilmShear {
    pub lubricant: Lubricant,
    /// Eyring stress τ_E \[Pa\].
    pub eyring_stress: f64,
    /// Λ, limiting shear stress over pressure \[-\].
    pub limit: f64,
    /// v₀ \[m/s\].
    pub slip_speed: f64,
}

/// Shear stress over pressure and slip, g = τ/(p v) \[s/m\], finite at v = 0.
pub(super) trait SlipLaw {
    /// `slip_squared`: v² \[m²/s²\]; `pressure`: p > 0 \[Pa\].
    fn over_slip(&self, slip_squared: f64, pressure: f64) -> f64;
}

/// Regularised Coulomb with v₀² at hand.
#[derive(Clone, Copy, Debug)]
pub(super) struct CoulombSlip {
    pub friction: f64,
    pub slip_speed_squared: f64,
}

/// Film shear in one contact.
#[derive(Clone, Copy, Debug)]
pub(super) struct FilmSlip<'a> {
    pub law: &'a FilmShear,
    pub viscosity: &'a ViscosityTable,
    /// Film thickness h \[m\]; 0 without entrainment.
    pub thickness: f64,
}

impl From<&Traction> for CoulombSlip {
    fn from(law: &Traction) -> Self {
        Self { friction: law.friction, slip_speed_squared: law.slip_speed * law.slip_speed }
    }
}

impl SlipLaw for CoulombSlip {
    #[inline(always)]
    fn over_slip(&self, slip_squared: f64, _: f64) -> f64 {
        self.friction / (slip_squared + self.slip_speed_squared).sqrt()
    }
}

impl SlipLaw for &TractionCurve {
    #[inline(always)]
    fn over_slip(&self, slip_squared: f64, _: f64) -> f64 {
        let exponent = self.decay * slip_squared.sqrt();
        // (1 − e^{−x})/x → 1 − x/2 without cancellation.
        let share = if exponent > 1e-8 { -(-exponent).exp_m1() / exponent } else { 1.0 - 0.5 * exponent };
        self.limit * self.decay * share + self.slope * (-exponent).exp()
    }
}

impl SlipLaw for FilmSlip<'_> {
    #[inline(always)]
    fn over_slip(&self, slip_squared: f64, pressure: f64) -> f64 {
        let FilmShear { eyring_stress, limit, slip_speed, .. } = *self.law;
        let highest = limit * pressure;
        let newtonian = self.viscosity.at(pressure) / self.thickness.max(f64::MIN_POSITIVE);
        let slope = newtonian.min(highest / slip_speed);
        let x = slope * slip_squared.sqrt() / eyring_stress;
        let viscous = slope * asinh_over(x);
        let ratio = viscous * slip_squared.sqrt() / highest;
        viscous / (1.0 + ratio * ratio).sqrt() / pressure
    }
}

/// Friction law prepared for one race: with its film formula and viscosity over pressure.
#[derive(Clone, Debug)]
pub(super) enum PreparedLaw {
    Coulomb(CoulombSlip),
    Curve(TractionCurve),
    Film { law: FilmShear, film: FilmFormula, viscosity: ViscosityTable },
}

/// η(p) after Roelands, linear between tabulated pressures: within (α Δp)²/8, 5e-5 for α = 2e-8/Pa.
#[derive(Clone, Debug)]
pub(super) struct ViscosityTable {
    /// η at pressures `STEP` apart \[Pa s\].
    values: Vec<f64>,
}

impl ViscosityTable {
    /// Pressure step \[Pa\] and number of steps; beyond 5 GPa the last value holds.
    const STEP: f64 = 1e6;
    const STEPS: usize = 5000;

    pub fn new(lubricant: &Lubricant) -> Self {
        let value = |k| lubricant.viscosity * lubricant.viscosity_ratio(Self::STEP * k as f64);
        Self { values: (0..=Self::STEPS).map(value).collect() }
    }

    #[inline(always)]
    fn at(&self, pressure: f64) -> f64 {
        let x = (pressure * (1.0 / Self::STEP)).min(Self::STEPS as f64 - 0.5);
        let k = x as usize;
        self.values[k] + (x - k as f64) * (self.values[k + 1] - self.values[k])
    }
}

/// asinh(x)/x for x ≥ 0; by its series below 0.03, with an error of 4e-11.
#[inline(always)]
fn asinh_over(x: f64) -> f64 {
    if x < 0.03 {
        let square = x * x;
        return 1.0 - square * (1.0 / 6.0 - square * (3.0 / 40.0));
    }
    (x + (x * x + 1.0).sqrt()).ln() / x
}
