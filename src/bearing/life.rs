//! Load ratings and rating lives of radial ball bearings after ISO 281 and ISO/TS 16281.
//!
//! Lives are in millions of revolutions at 90 % reliability (L10) unless stated otherwise.

use super::BallGeometry;
use crate::contact::{HertzPair, Race};
use crate::linalg::{Outside, piecewise};

/// Load ratings: basic dynamic, basic static, fatigue load limit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LoadRating {
    /// Basic dynamic load rating C_r \[N\].
    pub dynamic: f64,
    /// Basic static load rating C_0r \[N\].
    pub static_rating: f64,
    /// Fatigue load limit C_u \[N\].
    pub fatigue: f64,
}

impl LoadRating {
    /// Ratings from the internal geometry, for use without catalogue values; i rows of Z balls.
    ///
    /// C_r = b_m f_c (i cos α)^0.7 Z^{2/3} D_w^1.8 with b_m = 1.3, D_w in mm, and beyond 25.4 mm 3.647 D_w^1.4;
    /// C_0r = (1/5) i Z Q₄₂₀₀ cos α with the load Q₄₂₀₀ of a ball at 4200 MPa; C_u = C_0r/22, for pitch diameters
    /// above 100 mm times √(100 mm/D_pw).
    ///
    /// Source: ISO 281 clause 5 and annex B; ISO 76 with the actual groove radii instead of its factor f₀.
    pub fn new(g: &BallGeometry, hertz: &HertzPair, rows: usize) -> Self {
        let (rows, balls) = (rows as f64, g.balls as f64);
        let cos = g.contact_angle.cos();
        let size = g.ball_diameter * 1e3;
        let size = if size <= 25.4 { size.powf(1.8) } else { 3.647 * size.powf(1.4) };
        let dynamic = 1.3 * capacity_factor(g) * (rows * cos).powf(0.7) * balls.powf(2.0 / 3.0) * size;
        // p₀ ∝ Q^{1/3}.
        let limit = |race| (4.2e9 / hertz.of(race).patch(1.0).maximum_pressure).powi(3);
        let stationary = 0.2 * rows * balls * limit(Race::Inner).min(limit(Race::Outer)) * cos;
        let fatigue = stationary / 22.0 * (0.1 / g.pitch_diameter).sqrt().min(1.0);
        Self { dynamic, static_rating: stationary, fatigue }
    }
}

/// f_c = 38.2 (1 + (1.04 Γ^1.72 ρ^0.41)^{10/3})^{−3/10} γ^0.3 (1 − γ)^1.39 (1 + γ)^{−1/3} (2f_i/(2f_i − 1))^0.41.
///
/// γ = D_w cos α/D_pw, Γ = (1 − γ)/(1 + γ), ρ = f_i (2f_e − 1)/(f_e (2f_i − 1)). With f_i = f_e = 0.52 this is
/// table 2 of ISO 281 to its rounding; smaller grooves count as 0.52 D_w (inner) and 0.53 D_w (outer), as
/// there.
fn capacity_factor(g: &BallGeometry) -> f64 {
    let gamma = g.ball_diameter * g.contact_angle.cos() / g.pitch_diameter;
    let inner = (g.inner_groove_radius / g.ball_diameter).max(0.52);
    let outer = g.outer_groove_radius / g.ball_diameter;
    // 0.53 within round-off counts as 0.53.
    let outer = if outer <= 0.53 + 1e-9 { inner } else { outer };
    let rings = 1.04 * ring_ratio(gamma, inner, outer);
    38.2 * (1.0 + rings.powf(10.0 / 3.0)).powf(-0.3) * gamma.powf(0.3) * (1.0 - gamma).powf(1.39)
        / (1.0 + gamma).cbrt()
        * (2.0 * inner / (2.0 * inner - 1.0)).powf(0.41)
}

/// Ratio of inner to outer ring capacity up to a constant factor: ((1 − γ)/(1 + γ))^1.72 ρ^0.41.
fn ring_ratio(gamma: f64, inner: f64, outer: f64) -> f64 {
    let grooves = inner * (2.0 * outer - 1.0) / (outer * (2.0 * inner - 1.0));
    ((1.0 - gamma) / (1.0 + gamma)).powf(1.72) * grooves.powf(0.41)
}

/// Dynamic equivalent radial load P = X F_r + Y F_a \[N\], or F_r where F_a/F_r ≤ e, of i rows in tandem.
///
/// X, Y, e from the contact angle and, up to 20°, the relative axial load F_a/(i Z D_w²), interpolated
/// between the rows of the table. Source: ISO 281 table 3, single-row bearings.
pub fn equivalent_load(g: &BallGeometry, rows: usize, radial: f64, axial: f64) -> f64 {
    let (radial, axial) = (radial.abs(), axial.abs());
    let size = (g.ball_diameter * 1e3).powi(2) * (rows * g.balls) as f64;
    let [x, y, e] = load_factors(g.contact_angle.abs().to_degrees(), axial / size);
    if axial <= e * radial { radial } else { x * radial + y * axial }
}

/// X, Y, e at a contact angle \[°\] and a relative axial load \[N/mm²\].
fn load_factors(angle: f64, relative: f64) -> [f64; 3] {
    // Relative axial load, Y and e.
    const DEEP_GROOVE: [[f64; 3]; 9] = [
        [0.172, 2.30, 0.19],
        [0.345, 1.99, 0.22],
        [0.689, 1.71, 0.26],
        [1.03, 1.55, 0.28],
        [1.38, 1.45, 0.30],
        [2.07, 1.31, 0.34],
        [3.45, 1.15, 0.38],
        [5.17, 1.04, 0.42],
        [6.89, 1.00, 0.44],
    ];
    const ANGULAR_CONTACT_15: [[f64; 3]; 9] = [
        [0.172, 1.47, 0.38],
        [0.345, 1.40, 0.40],
        [0.689, 1.30, 0.43],
        [1.03, 1.23, 0.46],
        [1.38, 1.19, 0.47],
        [2.07, 1.12, 0.50],
        [3.45, 1.02, 0.55],
        [5.17, 1.00, 0.56],
        [6.89, 1.00, 0.56],
    ];
    let [_, y0, e0] = piecewise(&DEEP_GROOVE, relative, Outside::Constant);
    let [_, y15, e15] = piecewise(&ANGULAR_CONTACT_15, relative, Outside::Constant);
    // Angle, X, Y, e.
    let table = [
        [0.0, 0.56, y0, e0],
        [15.0, 0.44, y15, e15],
        [20.0, 0.43, 1.00, 0.57],
        [25.0, 0.41, 0.87, 0.68],
        [30.0, 0.39, 0.76, 0.80],
        [35.0, 0.37, 0.66, 0.95],
        [40.0, 0.35, 0.57, 1.14],
        [45.0, 0.33, 0.50, 1.34],
    ];
    let [_, x, y, e] = piecewise(&table, angle, Outside::Constant);
    [x, y, e]
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
/// Q_ci = C_r/(0.407 Z cos^0.7 α) (1 + x^{10/3})^{3/10}, Q_ce = C_r/(0.389 Z cos^0.7 α) (1 + x^{−10/3})^{3/10},
/// x = 1.044 ((1 − γ)/(1 + γ))^1.72 (f_i (2f_e − 1)/(f_e (2f_i − 1)))^0.41;
/// Q_e = (Σ Q_j³/Z)^{1/3} on the ring that rotates relative to the load, (Σ Q_j^{10/3}/Z)^{3/10} on the
/// stationary one.
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
    let share = dynamic_rating / (balls * g.contact_angle.cos().powf(0.7));
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
