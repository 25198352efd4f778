//! Load ratings and equivalent loads of radial ball bearings: ISO 281 (dynamic) and ISO 76 (static).

use crate::contact::{HertzPair, Race};
use crate::material::Material;
use crate::{Arrangement, BallGeometry};
use rotordyn_linalg::{Outside, piecewise};
use serde::{Deserialize, Serialize};

/// Groove radii over ball diameter, inner and outer, up to which the standards' factors hold.
pub const STANDARD_OSCULATION: [f64; 2] = [0.52, 0.53];
/// Contact stress of the static load rating \[Pa\] (ISO 76): permanent dent of 1e-4 of the ball diameter.
pub const STATIC_CONTACT_STRESS: f64 = 4.2e9;
/// Largest contact angle of a radial ball bearing \[rad\], with round-off; beyond it is a thrust bearing.
pub const LARGEST_RADIAL_ANGLE: f64 = 0.25 * std::f64::consts::PI + 1e-9;
/// Contact angle below which a bearing counts as a radial contact (deep groove) bearing \[°\].
const RADIAL_CONTACT: f64 = 0.5;
/// Young's moduli that count as bearing steel \[Pa\]; ISO 76 takes 207 GPa for all of them.
const STEEL: std::ops::RangeInclusive<f64> = 190e9..=220e9;

/// Load ratings: basic dynamic, basic static, fatigue load limit.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct LoadRating {
    /// Basic dynamic load rating C_r \[N\].
    pub dynamic: f64,
    /// Basic static load rating C_0r \[N\].
    pub static_rating: f64,
    /// Fatigue load limit C_u \[N\].
    pub fatigue: f64,
}

impl LoadRating {
    /// Ratings from the internal geometry, of a single row or of a pair as a whole.
    ///
    /// C_r = b_m f_c (i cos α)^0.7 Z^{2/3} D_w^1.8 with b_m = 1.3, D_w in mm, and beyond 25.4 mm 3.647 D_w^1.4;
    /// two radial contact rows back to back or face to face have 0.90/0.95 of it;
    /// C_0r = f_0 i Z D_w² cos α, f_0 from [`static_factor`]; C_u = C_0r/22, for pitch diameters above 100 mm times
    /// √(100 mm/D_pw) (the simple method).
    ///
    /// `ball`, `ring`: their elasticity matters if one of them is no steel. `arrangement`: `None` for a single row.
    ///
    /// Source: ISO 281 clause 5 and B.3.3; ISO 76 clause 5.
    pub fn new(g: &BallGeometry, ball: &Material, ring: &Material, arrangement: Option<Arrangement>) -> Self {
        let (rows, balls) = (if arrangement.is_some() { 2.0 } else { 1.0 }, g.balls as f64);
        let cos = g.contact_angle.cos();
        let size_mm = g.ball_diameter * 1e3;
        let size = if size_mm <= 25.4 { size_mm.powf(1.8) } else { 3.647 * size_mm.powf(1.4) };
        let double_row = is_opposed(arrangement) && is_radial_contact(g);
        let reduction = if double_row { 0.90 / 0.95 } else { 1.0 };
        let single = 1.3 * capacity_factor(g) * balls.powf(2.0 / 3.0) * size;
        let stationary = static_factor(g, ball, ring) * rows * balls * size_mm * size_mm * cos;
        let fatigue = stationary / 22.0 * (0.1 / g.pitch_diameter).sqrt().min(1.0);
        Self { dynamic: reduction * single * (rows * cos).powf(0.7), static_rating: stationary, fatigue }
    }
}

fn is_opposed(arrangement: Option<Arrangement>) -> bool {
    matches!(arrangement, Some(Arrangement::BackToBack | Arrangement::FaceToFace))
}

fn is_radial_contact(g: &BallGeometry) -> bool {
    g.contact_angle.abs().to_degrees() < RADIAL_CONTACT
}

/// Groove radii over ball diameter for the ratings: closer grooves count as the standard's.
fn rated_osculation(g: &BallGeometry) -> [f64; 2] {
    let [inner, outer] = STANDARD_OSCULATION;
    [
        (g.inner_groove_radius / g.ball_diameter).max(inner),
        (g.outer_groove_radius / g.ball_diameter).max(outer),
    ]
}

/// Factor f_0 \[N/mm²\] of ISO 76: f_0 = Q/(5 D_w²) with the load Q of the ball whose contact reaches 4200 MPa first.
///
/// Grooves closer than 0.52 D_w (inner) and 0.53 D_w (outer) count as these, wider ones reduce f_0. Steel counts as
/// steel of 207 GPa and ν = 0.3, as in the standard's table 1; other materials are taken as they are.
///
/// Source: ISO 76 clause 5.1 and table 1; ISO/TR 10657.
pub fn static_factor(g: &BallGeometry, ball: &Material, ring: &Material) -> f64 {
    let standard = |material: &Material| match STEEL.contains(&material.young) {
        true => Material { young: 207e9, poisson: 0.3, ..material.clone() },
        false => material.clone(),
    };
    let grooves = rated_osculation(g).map(|osculation| osculation * g.ball_diameter);
    let hertz = HertzPair::new(
        g.ball_diameter,
        g.pitch_diameter,
        grooves,
        g.contact_angle,
        &standard(ball),
        &standard(ring),
    );
    // p₀ ∝ Q^{1/3}.
    let limit = |race| (STATIC_CONTACT_STRESS / hertz.of(race).patch(1.0).maximum_pressure).powi(3);
    0.2 * limit(Race::Inner).min(limit(Race::Outer)) / (g.ball_diameter * 1e3).powi(2)
}

/// f_c = 38.2 (1 + (1.04 Γ^1.72 ρ^0.41)^{10/3})^{−3/10} γ^0.3 (1 − γ)^1.39 (1 + γ)^{−1/3} (2f_i/(2f_i − 1))^0.41.
///
/// γ = D_w cos α/D_pw, Γ = (1 − γ)/(1 + γ), ρ = (2f_e − 1)/f_e · f_i/(2f_i − 1) over its value at 0.52 and 0.53,
/// for which this is table 2 of ISO 281 to its rounding. Closer grooves count as these, wider ones reduce f_c.
fn capacity_factor(g: &BallGeometry) -> f64 {
    let gamma = g.ball_diameter * g.contact_angle.cos() / g.pitch_diameter;
    let [inner, outer] = rated_osculation(g);
    let width = |osculation: f64| (2.0 * osculation - 1.0) / osculation;
    let [standard_inner, standard_outer] = STANDARD_OSCULATION.map(width);
    let grooves = width(outer) / standard_outer * standard_inner / width(inner);
    let rings = 1.04 * ((1.0 - gamma) / (1.0 + gamma)).powf(1.72) * grooves.powf(0.41);
    38.2 * (1.0 + rings.powf(10.0 / 3.0)).powf(-0.3) * gamma.powf(0.3) * (1.0 - gamma).powf(1.39)
        / (1.0 + gamma).cbrt()
        * (2.0 / width(inner)).powf(0.41)
}

/// Dynamic equivalent radial load with the factors it was found with.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EquivalentLoad {
    /// P = X F_r + Y F_a \[N\].
    pub load: f64,
    pub x: f64,
    pub y: f64,
    /// Limit of F_a/F_r between the two pairs of factors.
    pub e: f64,
}

/// Dynamic equivalent radial load P = X F_r + Y F_a of a single row or of a pair as a whole.
///
/// Single and tandem: X = 1, Y = 0 where F_a ≤ e F_r, else X, Y of one row at the relative axial load
/// F_a/(i Z D_w²). Back to back and face to face: X = 1, Y = Y_1 where F_a ≤ e F_r, else X_2, Y_2, at F_a/(Z D_w²),
/// and for radial contact at F_a/(2 Z D_w²). Interpolated between the angles 0, 5, 10, 15, 20 ... 45° of the table and
/// between its relative axial loads; 5° has the factors of radial contact in a single row.
///
/// `radial`, `axial`: F_r, F_a of all rows \[N\]. NaN beyond a contact angle of 45°.
/// Source: ISO 281 clause 6 and table 3; its derivation in ISO/TR 1281-1 clause 7.
pub fn equivalent_load(
    g: &BallGeometry,
    arrangement: Option<Arrangement>,
    radial: f64,
    axial: f64,
) -> EquivalentLoad {
    let (radial, axial) = (radial.abs(), axial.abs());
    let relative = axial / (g.balls as f64 * (g.ball_diameter * 1e3).powi(2));
    let angle = angle_of_table(g);
    let opposed = is_opposed(arrangement);
    let [_, e, x_1, y_1, x_2, y_2] = if opposed {
        piecewise(&opposed_rows(relative), angle, Outside::Constant)
    } else {
        let share = if arrangement.is_some() { 0.5 * relative } else { relative };
        piecewise(&single_row(share), angle, Outside::Constant)
    };
    let [x, y] = if axial <= e * radial { [x_1, y_1] } else { [x_2, y_2] };
    EquivalentLoad { load: x * radial + y * axial, x, y, e }
}

/// Contact angle \[°\] for the tables; NaN for a thrust bearing.
fn angle_of_table(g: &BallGeometry) -> f64 {
    let angle = g.contact_angle.abs();
    if angle > LARGEST_RADIAL_ANGLE { f64::NAN } else { angle.to_degrees() }
}

/// Relative axial loads F_a/(Z D_w²) \[N/mm²\] of table 3.
const RELATIVE_LOADS: [f64; 9] = [0.172, 0.345, 0.689, 1.03, 1.38, 2.07, 3.45, 5.17, 6.89];
/// Y of a single row at 0 and 5°, 10°, 15°.
const Y_0: [f64; 9] = [2.30, 1.99, 1.71, 1.55, 1.45, 1.31, 1.15, 1.04, 1.00];
const Y_10: [f64; 9] = [1.88, 1.71, 1.52, 1.41, 1.34, 1.23, 1.10, 1.01, 1.00];
const Y_15: [f64; 9] = [1.47, 1.40, 1.30, 1.23, 1.19, 1.12, 1.02, 1.00, 1.00];
/// e at 0°, at 5° (double row), 10° and 15°.
const E_0: [f64; 9] = [0.19, 0.22, 0.26, 0.28, 0.30, 0.34, 0.38, 0.42, 0.44];
const E_5: [f64; 9] = [0.23, 0.26, 0.30, 0.34, 0.36, 0.40, 0.45, 0.50, 0.52];
const E_10: [f64; 9] = [0.29, 0.32, 0.36, 0.38, 0.40, 0.44, 0.49, 0.54, 0.54];
const E_15: [f64; 9] = [0.38, 0.40, 0.43, 0.46, 0.47, 0.50, 0.55, 0.56, 0.56];
/// Y_1 and Y_2 of a double row at 5°, 10°, 15°.
const Y1_5: [f64; 9] = [2.78, 2.40, 2.07, 1.87, 1.75, 1.58, 1.39, 1.26, 1.21];
const Y2_5: [f64; 9] = [3.74, 3.23, 2.78, 2.52, 2.36, 2.13, 1.87, 1.69, 1.63];
const Y1_10: [f64; 9] = [2.18, 1.98, 1.76, 1.63, 1.55, 1.42, 1.27, 1.17, 1.16];
const Y2_10: [f64; 9] = [3.06, 2.78, 2.47, 2.29, 2.18, 2.00, 1.79, 1.64, 1.63];
const Y1_15: [f64; 9] = [1.65, 1.57, 1.46, 1.38, 1.34, 1.26, 1.14, 1.12, 1.12];
const Y2_15: [f64; 9] = [2.39, 2.28, 2.11, 2.00, 1.93, 1.82, 1.66, 1.63, 1.63];

/// A column of table 3 at a relative axial load.
fn at(column: &[f64; 9], relative: f64) -> f64 {
    let table: [[f64; 2]; 9] = std::array::from_fn(|k| [RELATIVE_LOADS[k], column[k]]);
    let [_, value] = piecewise(&table, relative, Outside::Constant);
    value
}

/// Angle \[°\], e, X and Y up to e (1, 0), X and Y beyond e, for single rows.
fn single_row(relative: f64) -> [[f64; 6]; 10] {
    let row = |angle: f64, e: f64, x: f64, y: f64| [angle, e, 1.0, 0.0, x, y];
    [
        row(0.0, at(&E_0, relative), 0.56, at(&Y_0, relative)),
        row(5.0, at(&E_0, relative), 0.56, at(&Y_0, relative)),
        row(10.0, at(&E_10, relative), 0.46, at(&Y_10, relative)),
        row(15.0, at(&E_15, relative), 0.44, at(&Y_15, relative)),
        row(20.0, 0.57, 0.43, 1.00),
        row(25.0, 0.68, 0.41, 0.87),
        row(30.0, 0.80, 0.39, 0.76),
        row(35.0, 0.95, 0.37, 0.66),
        row(40.0, 1.14, 0.35, 0.57),
        row(45.0, 1.34, 0.33, 0.50),
    ]
}

/// Angle \[°\], e, X (1) and Y_1 up to e, X_2 and Y_2 beyond e, for double rows of opposed thrust direction.
fn opposed_rows(relative: f64) -> [[f64; 6]; 10] {
    let row = |angle: f64, e: f64, y_1: f64, x_2: f64, y_2: f64| [angle, e, 1.0, y_1, x_2, y_2];
    [
        row(0.0, at(&E_0, 0.5 * relative), 0.0, 0.56, at(&Y_0, 0.5 * relative)),
        row(5.0, at(&E_5, relative), at(&Y1_5, relative), 0.78, at(&Y2_5, relative)),
        row(10.0, at(&E_10, relative), at(&Y1_10, relative), 0.75, at(&Y2_10, relative)),
        row(15.0, at(&E_15, relative), at(&Y1_15, relative), 0.72, at(&Y2_15, relative)),
        row(20.0, 0.57, 1.09, 0.70, 1.63),
        row(25.0, 0.68, 0.92, 0.67, 1.41),
        row(30.0, 0.80, 0.78, 0.63, 1.24),
        row(35.0, 0.95, 0.66, 0.60, 1.07),
        row(40.0, 1.14, 0.55, 0.57, 0.93),
        row(45.0, 1.34, 0.47, 0.54, 0.81),
    ]
}

/// Static equivalent radial load P_0 = max(X_0 F_r + Y_0 F_a, F_r) \[N\] of a single row or of a pair as a whole.
///
/// `radial`, `axial`: F_r, F_a of all rows \[N\]. NaN beyond a contact angle of 45°. Source: ISO 76 clause 5.3, table 3.
pub fn static_equivalent_load(
    g: &BallGeometry,
    arrangement: Option<Arrangement>,
    radial: f64,
    axial: f64,
) -> f64 {
    // Angle, X_0 and Y_0 of a single row; opposed rows have twice these from 5° on.
    const TABLE: [[f64; 3]; 10] = [
        [0.0, 0.6, 0.50],
        [5.0, 0.5, 0.52],
        [10.0, 0.5, 0.50],
        [15.0, 0.5, 0.46],
        [20.0, 0.5, 0.42],
        [25.0, 0.5, 0.38],
        [30.0, 0.5, 0.33],
        [35.0, 0.5, 0.29],
        [40.0, 0.5, 0.26],
        [45.0, 0.5, 0.22],
    ];
    let rows = if is_opposed(arrangement) { 2.0 } else { 1.0 };
    let table =
        TABLE.map(|[angle, x, y]| if angle == 0.0 { [angle, x, y] } else { [angle, rows * x, rows * y] });
    let angle = angle_of_table(g);
    let [_, x, y] = piecewise(&table, angle, Outside::Constant);
    let load = x * radial.abs() + y * axial.abs();
    if angle.is_nan() { f64::NAN } else { load.max(radial.abs()) }
}
