//! Internal geometry of a ball bearing.

/// Internal geometry of a single-row ball bearing (deep groove or angular contact), all diameters \[m\].
#[derive(Clone, Debug, PartialEq)]
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
    /// +1 when the inner ring carries thrust along +z (force on the shaft along −z), −1 for the other way;
    /// of no effect when α₀ = 0.
    pub thrust_direction: f64,
    /// Bore d, outside diameter D and width B, for shapes, masses and pictures.
    pub bore: f64,
    pub outside_diameter: f64,
    pub width: f64,
}
