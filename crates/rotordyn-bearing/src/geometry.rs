//! Internal geometry of a ball bearing.

use serde::{Deserialize, Serialize};

/// Internal geometry of a single-row ball bearing (deep groove or angular contact), all diameters \[m\].
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct BallGeometry {
    /// Number of balls Z.
    pub balls: usize,
    /// Ball diameter D_w.
    pub ball_diameter: f64,
    /// Pitch diameter D_pw.
    pub pitch_diameter: f64,
    /// Groove radius of the inner race r_i = f_i D_w.
    pub inner_groove_radius: f64,
    /// Groove radius of the outer race r_o = f_o D_w.
    pub outer_groove_radius: f64,
    /// Diametral radial internal clearance P_d; negative for interference.
    pub radial_clearance: f64,
    /// Nominal contact angle α₀ \[rad\]; 0 for deep groove. With α₀ ≠ 0 the radial distance of the groove
    /// centres is A cos α₀ − P_d/2 and the axial one A sin α₀.
    pub contact_angle: f64,
    /// +1 when the inner ring carries thrust along +z (force on the shaft along −z), −1 for the opposite
    /// direction; no effect when α₀ = 0.
    pub thrust_direction: f64,
    /// Moment arm (radius) of the axial ball forces \[m\], to override the radius of the inner groove
    /// centres; some papers use D_pw/2.
    pub moment_arm: Option<f64>,
    /// Bore d, outside diameter D and width B, for fits, masses and drawings.
    pub bore: f64,
    pub outside_diameter: f64,
    pub width: f64,
}

impl BallGeometry {
    /// Moment arm of the axial ball forces: radius of the circle of inner groove centres
    /// R_i = D_pw/2 + (r_i − D_w/2) cos α₀ − P_d/4 \[m\], or as given.
    pub fn inner_centre_radius(&self) -> f64 {
        if let Some(arm) = self.moment_arm {
            return arm;
        }
        0.5 * self.pitch_diameter
            + (self.inner_groove_radius - 0.5 * self.ball_diameter) * self.contact_angle.cos()
            - 0.25 * self.radial_clearance
    }

    /// Cage pocket diameter if none is stated \[m\]: the ball with a clearance of 4 %, at most 40 % of the gap between
    /// neighbouring balls.
    pub fn default_cage_pocket(&self) -> f64 {
        let spacing = self.pitch_diameter * (std::f64::consts::PI / self.balls as f64).sin();
        let free = (spacing - self.ball_diameter).max(0.0);
        self.ball_diameter + (0.04 * self.ball_diameter).min(0.4 * free)
    }

    /// Bearing characteristic (defect) frequencies in orders of the inner ring speed at contact angle α,
    /// outer ring stationary.
    pub fn characteristic_orders(&self, contact_angle: f64) -> CharacteristicOrders {
        self.characteristic_orders_at(contact_angle.cos())
    }

    /// [`Self::characteristic_orders`] at a mean cos α; beyond ±1 where the two contact angles of balls with
    /// inertia give a cage speed that no common angle has.
    pub fn characteristic_orders_at(&self, mean_cos: f64) -> CharacteristicOrders {
        let gamma = self.ball_diameter * mean_cos / self.pitch_diameter;
        let z = self.balls as f64;
        CharacteristicOrders {
            ftf: 0.5 * (1.0 - gamma),
            bpfo: 0.5 * z * (1.0 - gamma),
            bpfi: 0.5 * z * (1.0 + gamma),
            bsf: 0.5 / self.ball_diameter * self.pitch_diameter * (1.0 - gamma * gamma),
        }
    }
}

/// Characteristic bearing frequencies (FTF, BPFO, BPFI, BSF) in orders of the shaft speed.
///
/// Cage ½ (1 − γ), outer race ½ Z (1 − γ), inner race ½ Z (1 + γ), ball spin (D_pw / 2 D_w)(1 − γ²) with
/// γ = D_w cos α / D_pw. Source: Cakmak & Sanliturk 2010 eq. 20-23 in orders; eq. 23 without its N_b.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct CharacteristicOrders {
    /// Cage order (fundamental train frequency, FTF).
    pub ftf: f64,
    /// Ball pass order, outer race (BPFO).
    pub bpfo: f64,
    /// Ball pass order, inner race (BPFI).
    pub bpfi: f64,
    /// Ball spin order (BSF); a ball defect strikes both races, at 2 × BSF.
    pub bsf: f64,
}
