//! Distance of the contact ellipses from the shoulders of the grooves.

use crate::contact::Race;
use crate::{BallBearing, BallGeometry, BallLoad};
use serde::{Deserialize, Serialize};

/// Shoulder height over the ball diameter where none is given.
const SHOULDER_HEIGHT: f64 = 0.2;
/// Least angle of the shoulder beyond the nominal contact angle, where none is given \[rad\].
const BEYOND_CONTACT_ANGLE: f64 = 25.0 * std::f64::consts::PI / 180.0;

/// Contact ellipse and shoulder of one race, as angles about the groove's centre from the groove's bottom.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct ShoulderMargin {
    /// Edge of the contact ellipse towards the nearer shoulder, |α| + a/r \[rad\].
    pub ellipse_angle: f64,
    /// Edge of the shoulder \[rad\].
    pub shoulder_angle: f64,
    /// Arc of the groove from the ellipse to the shoulder \[m\]; negative for an ellipse beyond the shoulder.
    pub arc: f64,
    /// Share of the ellipse's length beyond the shoulder, 0 to 1.
    pub fraction_beyond: f64,
}

impl BallGeometry {
    /// Diameter of the bottom of a groove \[m\], without clearance changes by mounting.
    ///
    /// Inner race 2 (R_i − r_i), outer race 2 (R_o + r_o): R_i = D_pw/2 + (r_i − D_w/2) cos α₀ − P_d/4 and R_o = R_i −
    /// (A cos α₀ − P_d/2) the radii of the groove centres, A = r_i + r_o − D_w.
    pub fn groove_bottom_diameter(&self, race: Race) -> f64 {
        let cos = self.contact_angle.cos();
        let centre = 0.5 * self.pitch_diameter + (self.inner_groove_radius - 0.5 * self.ball_diameter) * cos
            - 0.25 * self.radial_clearance;
        let distance = self.inner_groove_radius + self.outer_groove_radius - self.ball_diameter;
        match race {
            Race::Inner => 2.0 * (centre - self.inner_groove_radius),
            Race::Outer => {
                2.0 * (centre - distance * cos + 0.5 * self.radial_clearance + self.outer_groove_radius)
            }
        }
    }

    /// Groove radius of a race \[m\].
    pub fn groove_radius(&self, race: Race) -> f64 {
        match race {
            Race::Inner => self.inner_groove_radius,
            Race::Outer => self.outer_groove_radius,
        }
    }
}

/// Height of a race's shoulder above the bottom of its groove \[m\].
///
/// From the shoulder diameter if given; else 0.2 D_w, and at least up to 25 deg beyond the nominal contact angle: r (1 −
/// cos(α₀ + 25 deg)). The lower shoulder of an angular contact bearing is not described.
pub fn shoulder_height(bearing: &BallBearing, race: Race) -> f64 {
    let g = &bearing.geometry;
    let (given, sign) = match race {
        Race::Inner => (bearing.service.shoulder_diameters[0], 0.5),
        Race::Outer => (bearing.service.shoulder_diameters[1], -0.5),
    };
    match given {
        Some(diameter) => sign * (diameter - g.groove_bottom_diameter(race)),
        None => {
            let angle = if g.contact_angle > 0.0 { g.contact_angle + BEYOND_CONTACT_ANGLE } else { 0.0 };
            (SHOULDER_HEIGHT * g.ball_diameter).max(g.groove_radius(race) * (1.0 - angle.cos()))
        }
    }
}

/// Angle of a race's shoulder from the bottom of its groove \[rad\], arccos(1 − h/r) for a shoulder of height h.
pub fn shoulder_angle(bearing: &BallBearing, race: Race) -> f64 {
    let height = shoulder_height(bearing, race) / bearing.geometry.groove_radius(race);
    (1.0 - height).clamp(-1.0, 1.0).acos()
}

/// Contact ellipse and shoulder at the inner and outer race of a ball; without load the contact's centre alone.
///
/// The ellipse reaches from the contact angle α by its semi-axis a along the groove of radius r, to |α| + a/r; both
/// shoulders of a groove are alike.
pub fn shoulder_margin(bearing: &BallBearing, load: &BallLoad) -> [ShoulderMargin; 2] {
    let hertz = bearing.hertz();
    let races = [
        (Race::Inner, &hertz.inner, load.load, load.contact_angle),
        (Race::Outer, &hertz.outer, load.outer_load, load.outer_contact_angle),
    ];
    races.map(|(race, contact, load, angle)| {
        let semi_axis = if load > 0.0 { contact.patch(load).semi_major } else { 0.0 };
        margin(bearing.geometry.groove_radius(race), shoulder_angle(bearing, race), angle, semi_axis)
    })
}

/// Margin of an ellipse of semi-axis a \[m\] at the contact angle α \[rad\] on a groove of radius r \[m\].
pub fn margin(groove_radius: f64, shoulder_angle: f64, contact_angle: f64, semi_axis: f64) -> ShoulderMargin {
    let half = semi_axis / groove_radius;
    let ellipse_angle = contact_angle.abs() + half;
    // The ellipse may reach beyond both shoulders.
    let beyond = (ellipse_angle - shoulder_angle).clamp(0.0, 2.0 * half)
        + (half - contact_angle.abs() - shoulder_angle).clamp(0.0, 2.0 * half);
    ShoulderMargin {
        ellipse_angle,
        shoulder_angle,
        arc: groove_radius * (shoulder_angle - ellipse_angle),
        fraction_beyond: match half > 0.0 {
            true => (0.5 * beyond / half).min(1.0),
            false => f64::from(u8::from(ellipse_angle > shoulder_angle)),
        },
    }
}
