//! Friction torque of a ball bearing: load and viscous part after Palmgren, and the spinning of the balls.

pub use crate::ball::lubrication::{Lubrication, SLIDING_FRICTION};
use crate::{BallGeometry, BallMotion};
use serde::{Deserialize, Serialize};

/// Friction torque of a bearing at one operating point \[N m\], and its heat.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct FrictionTorque {
    /// Part that grows with the load, M_l.
    pub load: f64,
    /// Part of the lubricant, M_v; 0 without a lubricant.
    pub viscous: f64,
    /// Part of the spinning balls: its power over the shaft's speed.
    pub spin: f64,
    /// Power lost by all parts \[W\].
    pub heat: f64,
    /// Factors they were found with: f_1 of the load part, f_0 of the viscous part (NaN without a lubricant), sliding
    /// friction coefficient μ of the spinning balls.
    pub load_factor: f64,
    pub viscous_factor: f64,
    pub sliding_friction: f64,
}

impl FrictionTorque {
    /// Sum of the parts \[N m\].
    pub fn total(&self) -> f64 {
        self.load + self.viscous + self.spin
    }
}

/// Load part of the friction torque M_l = f_1 F_β D_pw \[N m\], with its factor f_1.
///
/// f_1 = z (F_s/C_s)^y with z = 5e-4, y = 0.55 for deep groove bearings and z = 1e-3, y = 0.33 for angular contact;
/// F_s = max(F_r, 0.6 F_r + 0.5 F_a) for deep groove and max(F_r, 0.5 F_r + Y_s F_a), Y_s after ISO 76, for angular
/// contact; F_β = max(0.9 F_a cot α − 0.1 F_r, F_r), for deep groove max(3 F_a − 0.1 F_r, F_r).
///
/// `radial` and `axial`: magnitudes of the load \[N\]; `static_rating`: C_s \[N\]. Source: Palmgren 1959; Harris, Rolling
/// Bearing Analysis, ch. 14 (eq. 14.1 and 14.2, table 14.1 and 14.2).
pub fn load_torque(g: &BallGeometry, static_rating: f64, radial: f64, axial: f64) -> [f64; 2] {
    let (radial, axial) = (radial.abs(), axial.abs());
    let angular = g.contact_angle > 0.0;
    let equivalent = if angular {
        (0.5 * radial + static_axial_factor(g.contact_angle) * axial).max(radial)
    } else {
        (0.6 * radial + 0.5 * axial).max(radial)
    };
    let [factor, power] = if angular { [1e-3, 0.33] } else { [5e-4, 0.55] };
    let thrust = if angular { 0.9 * axial / g.contact_angle.tan() } else { 3.0 * axial };
    let force = (thrust - 0.1 * radial).max(radial);
    let load_factor = factor * (equivalent / static_rating).powf(power);
    [load_factor * force * g.pitch_diameter, load_factor]
}

/// Y_0 of a single angular contact row over the contact angle (ISO 76), linear between the tabulated angles.
fn static_axial_factor(angle: f64) -> f64 {
    const TABLE: [[f64; 2]; 9] = [
        [5.0, 0.52],
        [10.0, 0.5],
        [15.0, 0.46],
        [20.0, 0.42],
        [25.0, 0.38],
        [30.0, 0.33],
        [35.0, 0.29],
        [40.0, 0.26],
        [45.0, 0.22],
    ];
    let degrees = angle.to_degrees().clamp(5.0, 45.0);
    let k = TABLE.partition_point(|row| row[0] < degrees).clamp(1, TABLE.len() - 1);
    let ([x0, y0], [x1, y1]) = (TABLE[k - 1], TABLE[k]);
    y0 + (y1 - y0) * (degrees - x0) / (x1 - x0)
}

/// Viscous part of the friction torque M_v \[N m\].
///
/// 1e-7 f_0 (ν n)^{2/3} D_pw³ N mm with ν in mm²/s, n in rpm, D_pw in mm for ν n ≥ 2000, else 160e-7 f_0 D_pw³. 0 at rest.
///
/// `factor`: f_0 ([`Lubrication::viscous_factor`]); `viscosity`: kinematic ν \[m²/s\], of a grease that of its base oil;
/// `speed` \[rad/s\]. Source: Palmgren 1959; Harris, Rolling Bearing Analysis, ch. 14 (eq. 14.4, table 14.3).
pub fn viscous_torque(g: &BallGeometry, factor: f64, viscosity: f64, speed: f64) -> f64 {
    let rpm = speed.abs() * 60.0 / std::f64::consts::TAU;
    if rpm == 0.0 {
        return 0.0;
    }
    let product = 1e6 * viscosity * rpm;
    let rise = if product >= 2000.0 { 1e-7 * product.powf(2.0 / 3.0) } else { 160e-7 };
    1e-3 * factor * rise * (1e3 * g.pitch_diameter).powi(3)
}

/// Torque on the shaft by the spinning balls \[N m\]: Σ M_s |ω_s|/Ω with M_s = (3/8) μ Q a E.
///
/// `friction`: μ; `speed` Ω \[rad/s\]; 0 at rest.
pub fn spin_torque<'a>(motions: impl IntoIterator<Item = &'a BallMotion>, friction: f64, speed: f64) -> f64 {
    let power: f64 = motions.into_iter().map(|ball| ball.spin_power(friction)).sum();
    if speed == 0.0 { 0.0 } else { power / speed.abs() }
}
