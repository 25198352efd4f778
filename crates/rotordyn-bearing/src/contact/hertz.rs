//! Dry Hertzian (elliptic point) contact with exact elliptic integrals.

use super::elliptic;
use crate::material::Material;
use serde::{Deserialize, Serialize};

/// Elliptic Hertzian contact of two bodies: the load-independent quantities.
///
/// With curvature sum Σρ, curvature difference F(ρ), ellipse ratio κ = a/b ≥ 1 and integrals K, E of
/// m = 1 − κ⁻²:
/// F(ρ) = ((κ² + 1) E − 2 K) / ((κ² − 1) E),
/// Q = K_c δ^{3/2}, K_c = (2/3) Σρ E* (2 / (δ* Σρ))^{3/2}, δ* = (2 K/π) (π / (2 κ² E))^{1/3}.
///
/// Source: Harris, Rolling Bearing Analysis, ch. 6; Cakmak & Sanliturk 2010 eq. 7-19, where the second
/// integral (eq. 14) must take the power +1/2 and eq. 18 is replaced by the exact form above.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EllipticContact {
    /// Curvature sum Σρ \[1/m\].
    pub curvature_sum: f64,
    /// Radius of relative curvature along the rolling direction R_x and across it R_y \[m\].
    pub rolling_radius: f64,
    pub transverse_radius: f64,
    /// Curvature difference F(ρ) in \[0, 1).
    pub curvature_difference: f64,
    /// Ratio of the semi-axes κ = a/b ≥ 1 (a across the rolling direction).
    pub ratio: f64,
    /// Complete elliptic integrals of the first and second kind at m = 1 − κ⁻².
    pub integrals: [f64; 2],
    /// Contact modulus E*, 1/E* = (1 − ν₁²)/E₁ + (1 − ν₂²)/E₂ \[Pa\].
    pub modulus: f64,
    /// Stiffness K_c in Q = K_c δ^{3/2} \[N/m^1.5\].
    pub stiffness: f64,
}

/// Contact ellipse and maximum pressure under load.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ContactPatch {
    /// Semi-axis across the rolling direction a \[m\].
    pub semi_major: f64,
    /// Semi-axis along the rolling direction b \[m\].
    pub semi_minor: f64,
    /// Maximum pressure p₀ = 3 Q / (2 π a b) \[Pa\].
    pub maximum_pressure: f64,
    /// Mutual approach δ \[m\].
    pub deflection: f64,
}

impl EllipticContact {
    /// Contact from principal curvatures \[1/m\] along and across the rolling direction (both bodies added,
    /// convex positive), and the two materials.
    pub fn new(along: f64, across: f64, materials: [&Material; 2]) -> Self {
        let curvature_sum = along + across;
        let curvature_difference = ((along - across) / curvature_sum).abs();
        let ratio = ellipse_ratio(curvature_difference);
        let (first, second) = elliptic::complete(ratio.powi(-2));
        let compliance: f64 = materials.iter().map(|m| (1.0 - m.poisson.powi(2)) / m.young).sum();
        let modulus = 1.0 / compliance;
        let pi = std::f64::consts::PI;
        let delta_star = 2.0 * first / pi * (pi / (2.0 * ratio * ratio * second)).cbrt();
        let stiffness = 2.0 / 3.0 * curvature_sum * modulus * (2.0 / (delta_star * curvature_sum)).powf(1.5);
        Self {
            curvature_sum,
            rolling_radius: 1.0 / along,
            transverse_radius: 1.0 / across,
            curvature_difference,
            ratio,
            integrals: [first, second],
            modulus,
            stiffness,
        }
    }

    /// Semi-axes of the ellipse along and across the rolling direction \[m\] under a load Q ≥ 0 \[N\].
    ///
    /// The shorter axis lies in the direction of the larger curvature: along rolling in a ball groove.
    pub fn semi_axes(&self, load: f64) -> [f64; 2] {
        let patch = self.patch(load);
        if self.rolling_radius <= self.transverse_radius {
            [patch.semi_minor, patch.semi_major]
        } else {
            [patch.semi_major, patch.semi_minor]
        }
    }

    /// Ellipse, pressure and approach under a load Q ≥ 0 \[N\].
    pub fn patch(&self, load: f64) -> ContactPatch {
        let pi = std::f64::consts::PI;
        let scale = (1.5 * load / (self.curvature_sum * self.modulus)).cbrt();
        let semi_major = (2.0 * self.ratio.powi(2) * self.integrals[1] / pi).cbrt() * scale;
        let semi_minor = semi_major / self.ratio;
        let maximum_pressure = if load > 0.0 { 1.5 * load / (pi * semi_major * semi_minor) } else { 0.0 };
        ContactPatch {
            semi_major,
            semi_minor,
            maximum_pressure,
            deflection: (load / self.stiffness).powf(2.0 / 3.0),
        }
    }
}

/// Ellipse ratio κ ≥ 1 whose curvature difference is `difference` in \[0, 1).
///
/// Newton in ln κ on F(κ) = ((κ² + 1) E − 2 K)/((κ² − 1) E), bracketed; F increases from 0 to 1.
fn ellipse_ratio(difference: f64) -> f64 {
    if difference < 1e-12 {
        return 1.0;
    }
    let residual = |log_ratio: f64| {
        let k2 = (2.0 * log_ratio).exp();
        let (first, second) = elliptic::complete(1.0 / k2);
        ((k2 + 1.0) * second - 2.0 * first) / ((k2 - 1.0) * second) - difference
    };
    let (mut low, mut high) = (1e-7, 30.0);
    let mut x = (1.0339 * ((1.0 + difference) / (1.0 - difference)).powf(0.636)).ln().clamp(1e-6, 29.0);
    for _ in 0..100 {
        let r = residual(x);
        if r > 0.0 {
            high = x;
        } else {
            low = x;
        }
        let step = 1e-6 * (1.0 + x);
        let slope = (residual(x + step) - residual(x - step)) / (2.0 * step);
        let newton = x - r / slope;
        let next = if newton > low && newton < high { newton } else { 0.5 * (low + high) };
        if (next - x).abs() <= 1e-15 * (1.0 + x) {
            return next.exp();
        }
        x = next;
    }
    x.exp()
}

/// The two contacts of one ball, inner and outer race, as springs in series.
///
/// K⁻²ᐟ³ = K_i⁻²ᐟ³ + K_o⁻²ᐟ³, since both carry the same load Q = K δ^{3/2} and δ = δ_i + δ_o.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HertzPair {
    pub inner: EllipticContact,
    pub outer: EllipticContact,
    /// Series stiffness K \[N/m^1.5\].
    pub stiffness: f64,
}

impl HertzPair {
    /// Pair of contacts of a ball between grooves.
    ///
    /// Curvatures along rolling: ball 2/D_w, inner race 1/(D_pw/(2 cos α) − D_w/2), outer race
    /// −1/(D_pw/(2 cos α) + D_w/2) (Cakmak & Sanliturk 2010 eq. 1-6); across: ball 2/D_w, race −1/r.
    pub fn new(
        ball_diameter: f64,
        pitch_diameter: f64,
        groove_radii: [f64; 2],
        contact_angle: f64,
        ball: &Material,
        ring: &Material,
    ) -> Self {
        let convex = 2.0 / ball_diameter;
        let axis_distance = 0.5 * pitch_diameter / contact_angle.cos();
        let inner_race = 1.0 / (axis_distance - 0.5 * ball_diameter);
        let outer_race = -1.0 / (axis_distance + 0.5 * ball_diameter);
        let inner = EllipticContact::new(convex + inner_race, convex - 1.0 / groove_radii[0], [ball, ring]);
        let outer = EllipticContact::new(convex + outer_race, convex - 1.0 / groove_radii[1], [ball, ring]);
        Self { stiffness: in_series([inner.stiffness, outer.stiffness]), inner, outer }
    }

    /// The same contacts with a given stiffness; ellipse and pressure remain those of the curvatures.
    pub fn with_stiffness(mut self, given: ContactStiffness) -> Self {
        match given {
            ContactStiffness::Elastic => {}
            ContactStiffness::Series(stiffness) => {
                let factor = stiffness / self.stiffness;
                self.inner.stiffness *= factor;
                self.outer.stiffness *= factor;
                self.stiffness = stiffness;
            }
            ContactStiffness::Each(each) => {
                [self.inner.stiffness, self.outer.stiffness] = each;
                self.stiffness = in_series(each);
            }
        }
        self
    }
}

fn in_series(each: [f64; 2]) -> f64 {
    each.map(|k| k.powf(-2.0 / 3.0)).iter().sum::<f64>().powf(-1.5)
}

/// Source of the stiffness K of a ball's dry contacts, Q = K δ^{3/2} \[N/m^1.5\].
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub enum ContactStiffness {
    /// Computed from curvatures and elasticity (Hertz).
    #[default]
    Elastic,
    /// Given for both contacts in series; each keeps its share of the compliance.
    Series(f64),
    /// Given for inner and outer contact.
    Each([f64; 2]),
}
