//! Rating lives of radial ball bearings after ISO 281 and ISO/TS 16281.
//!
//! Lives are in millions of revolutions at 90 % reliability (L10) unless stated otherwise.

use crate::BallGeometry;
use crate::contact::Race;
use rotordyn_linalg::{Outside, piecewise};

/// Ratio of inner to outer ring capacity up to a constant factor: ((1 − γ)/(1 + γ))^1.72 ρ^0.41.
fn ring_ratio(gamma: f64, inner: f64, outer: f64) -> f64 {
    let grooves = inner * (2.0 * outer - 1.0) / (outer * (2.0 * inner - 1.0));
    ((1.0 - gamma) / (1.0 + gamma)).powf(1.72) * grooves.powf(0.41)
}

/// Basic rating life L₁₀ = (C/P)³; infinite without load. Source: ISO 281 eq. 4.
pub fn basic_life(dynamic_rating: f64, load: f64) -> f64 {
    (dynamic_rating / load).powi(3)
}

/// A life \[10⁶ revolutions\] in hours at a speed Ω \[rad/s\].
pub fn hours(life: f64, speed: f64) -> f64 {
    life * 1e6 * std::f64::consts::TAU / speed.abs() / 3600.0
}

/// Reference viscosity ν₁ \[m²/s\] at a speed Ω \[rad/s\], of the viscosity ratio κ = ν/ν₁.
///
/// 45000 n^−0.83 D_pw^−0.5 mm²/s below 1000 rpm, 4500 n^−0.5 D_pw^−0.5 above, n in rpm, D_pw in mm.
/// Source: ISO 281 eq. 28 and 29.
pub fn reference_viscosity(pitch_diameter: f64, speed: f64) -> f64 {
    let rpm = speed.abs() * 30.0 / std::f64::consts::PI;
    let viscosity = if rpm < 1000.0 { 45_000.0 * rpm.powf(-0.83) } else { 4_500.0 * rpm.powf(-0.5) };
    viscosity * (pitch_diameter * 1e3).powf(-0.5) * 1e-6
}

/// Life modification factor a_ISO of radial ball bearings; L_nm = a₁ a_ISO L₁₀.
///
/// a_ISO = 0.1 (1 − (2.5671 − c κ^−m)^0.83 (e_C C_u/P)^{1/3})^{−9.3} up to 50, with c, m = 2.2649, 0.054381 for
/// κ < 0.4, 1.9987, 0.19087 for κ < 1, and 1.9987, 0.071739 above; κ is limited to 4.
///
/// `viscosity_ratio` κ, `contamination` e_C from 0 (very severe) to 1 (extreme cleanliness), `fatigue_limit` C_u \[N\],
/// `load` P \[N\]. `None` for κ < 0.1, outside the standard. Source: ISO 281 eq. 31-33.
pub fn life_modification(
    viscosity_ratio: f64,
    contamination: f64,
    fatigue_limit: f64,
    load: f64,
) -> Option<f64> {
    let kappa = viscosity_ratio.min(4.0);
    let (c, m) = match kappa {
        k if k < 0.4 => (2.2649, 0.054381),
        k if k < 1.0 => (1.9987, 0.19087),
        _ => (1.9987, 0.071739),
    };
    let lubrication = (2.5671 - c * kappa.powf(-m)).max(0.0).powf(0.83);
    let stress = 1.0 - lubrication * (contamination * fatigue_limit / load).cbrt();
    // The standard limits a_ISO to 50; stress ≤ 0 means no fatigue.
    let factor = if stress > 0.0 { (0.1 * stress.powf(-9.3)).min(50.0) } else { 50.0 };
    (viscosity_ratio >= 0.1).then_some(factor)
}

/// Life adjustment factor a₁ for a reliability from 0.9 to 0.999. Source: ISO 281 table 12, interpolated.
pub fn reliability_factor(reliability: f64) -> f64 {
    const TABLE: [[f64; 2]; 9] = [
        [0.90, 1.0],
        [0.95, 0.64],
        [0.96, 0.55],
        [0.97, 0.47],
        [0.98, 0.37],
        [0.99, 0.25],
        [0.995, 0.175],
        [0.999, 0.093],
        [0.9995, 0.077],
    ];
    let [_, factor] = piecewise(&TABLE, reliability, Outside::Constant);
    factor
}

/// Basic reference rating life (ISO/TS 16281) with its intermediate results.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ReferenceLife {
    /// Basic reference rating life L_10r.
    pub life: f64,
    /// Dynamic equivalent reference load P_ref = C_r/L_10r^{1/3} \[N\], for a_ISO.
    pub load: f64,
    /// Dynamic ball load ratings of the inner and outer ring, Q_ci and Q_ce \[N\].
    pub ratings: [f64; 2],
    /// Dynamic equivalent ball loads on the inner and outer ring, Q_ei and Q_ee \[N\].
    pub equivalents: [f64; 2],
}

/// Basic reference rating life of one row from the loads of its balls.
///
/// L_10r = ((Q_ci/Q_ei)^{−10/3} + (Q_ce/Q_ee)^{−10/3})^{−9/10};
/// Q_ci = C_r/(0.407 Z cos α) (1 + x^{10/3})^{3/10}, Q_ce = C_r/(0.389 Z cos α) (1 + x^{−10/3})^{3/10},
/// x = 1.044 ((1 − γ)/(1 + γ))^1.72 (f_i (2f_e − 1)/(f_e (2f_i − 1)))^0.41;
/// Q_e = (Σ Q_j³/Z)^{1/3} on the ring that rotates relative to the load, (Σ Q_j^{10/3}/Z)^{3/10} on the
/// stationary one. With cos α, not its power 0.7, a half-loaded row has L_10r = L_10: C_r = 0.407 Q_ci Z cos α (...) and
/// Q_ci ∝ (γ/cos α)^0.3 of Lundberg and Palmgren give the (cos α)^0.7 of C_r.
///
/// `dynamic_rating` C_r of the row \[N\]; `inner`, `outer`: loads on the rings, one per ball \[N\]; `rotating_ring`: the
/// ring rotating relative to the load. Zero load gives infinite life. Source: ISO/TS 16281 eq. 19-29.
pub fn reference_life(
    g: &BallGeometry,
    dynamic_rating: f64,
    inner: &[f64],
    outer: &[f64],
    rotating_ring: Race,
) -> ReferenceLife {
    let (balls, size) = (g.balls as f64, g.ball_diameter);
    let gamma = size * g.contact_angle.cos() / g.pitch_diameter;
    let x = 1.044 * ring_ratio(gamma, g.inner_groove_radius / size, g.outer_groove_radius / size);
    let share = dynamic_rating / (balls * g.contact_angle.cos());
    let ratings = [
        share / 0.407 * (1.0 + x.powf(10.0 / 3.0)).powf(0.3),
        share / 0.389 * (1.0 + x.powf(-10.0 / 3.0)).powf(0.3),
    ];
    let mean = |loads: &[f64], power: f64| {
        (loads.iter().map(|q| q.max(0.0).powf(power)).sum::<f64>() / balls).powf(1.0 / power)
    };
    let (by_inner, by_outer) = match rotating_ring {
        Race::Inner => (3.0, 10.0 / 3.0),
        Race::Outer => (10.0 / 3.0, 3.0),
    };
    let equivalents = [mean(inner, by_inner), mean(outer, by_outer)];
    let life = combined_life(&[0, 1].map(|ring| (ratings[ring] / equivalents[ring]).powi(3)));
    ReferenceLife { life, load: dynamic_rating / life.cbrt(), ratings, equivalents }
}

/// System life of parts that fail independently (rings, rows): L = (Σ L_k^{−10/9})^{−9/10} (Weibull slope
/// 10/9).
pub fn combined_life(lives: &[f64]) -> f64 {
    lives.iter().map(|life| life.powf(-10.0 / 9.0)).sum::<f64>().powf(-0.9)
}
