//! Mass, centre and inertia of bodies of revolution, in closed form.

use std::f64::consts::PI;

use nalgebra::Vector3;

/// A solid about z whose surface is known exactly.
pub trait ExactSolid {
    /// Whether a point is in the material, and the nearest point of the surface.
    fn project(&self, p: &Vector3<f64>) -> (bool, Vector3<f64>);

    /// Largest radius and the axial extent \[m\].
    fn extent(&self) -> (f64, [f64; 2]);

    /// Least radial thickness \[m\].
    fn wall(&self) -> f64;

    /// Mass, centre and inertia at a density \[kg/m³\].
    fn solid(&self, density: f64) -> RevolvedSolid;
}

/// Mass properties of a rigid body symmetric about z, such as a bearing part.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct RevolvedSolid {
    /// Mass m \[kg\].
    pub mass: f64,
    /// Axial position of the centre of mass \[m\].
    pub centre_z: f64,
    /// Moment of inertia about z I_p \[kg m²\].
    pub polar: f64,
    /// Moment of inertia about x or y through the centre of mass I_d \[kg m²\].
    pub diametral: f64,
}

impl RevolvedSolid {
    /// Homogeneous ball: m = ρ π D³/6, I = m D²/10.
    pub fn ball(diameter: f64, density: f64) -> Self {
        let mass = density * PI * diameter.powi(3) / 6.0;
        let inertia = 0.1 * mass * diameter * diameter;
        Self { mass, centre_z: 0.0, polar: inertia, diametral: inertia }
    }

    /// From integrals over the body: m, I_p and ∫ (z − z_c)² dm; I_d = ½ I_p + ∫ (z − z_c)² dm.
    pub(super) fn from_moments(mass: f64, centre_z: f64, polar: f64, axial: f64) -> Self {
        Self { mass, centre_z, polar, diametral: 0.5 * polar + axial }
    }

    /// This body with another one cut out of it (parallel-axis theorem).
    pub fn without(&self, cut: &Self) -> Self {
        let mass = self.mass - cut.mass;
        let centre_z = (self.mass * self.centre_z - cut.mass * cut.centre_z) / mass;
        let about = |s: &Self| s.diametral + s.mass * (s.centre_z - centre_z).powi(2);
        Self { mass, centre_z, polar: self.polar - cut.polar, diametral: about(self) - about(cut) }
    }
}

/// Hollow cylinder between two radii and two axial positions.
pub(super) fn revolved_rectangle(radii: [f64; 2], faces: [f64; 2], density: f64) -> RevolvedSolid {
    let [r1, r2] = radii;
    let width = faces[1] - faces[0];
    let mass = density * PI * (r2 * r2 - r1 * r1) * width;
    let polar = 0.5 * mass * (r2 * r2 + r1 * r1);
    RevolvedSolid::from_moments(mass, 0.5 * (faces[0] + faces[1]), polar, mass * width * width / 12.0)
}

/// Circular segment t ≥ h of a circle of radius a about (R, z_c), t = ±(r − R), revolved about z.
///
/// With M_n = ∫ tⁿ dA, Z_n = ∫ tⁿ ζ² dA over the segment (ζ = z − z_c) and r = R ± t:
/// m = 2πρ (R M₀ ± M₁), I_p = 2πρ (R³ M₀ ± 3 R² M₁ + 3 R M₂ ± M₃), ∫ ζ² dm = 2πρ (R Z₀ ± Z₁).
pub(super) fn revolved_segment(
    r: f64,
    sense: f64,
    a: f64,
    h: f64,
    centre_z: f64,
    density: f64,
) -> RevolvedSolid {
    let w = (a * a - h * h).sqrt();
    let angle = w.atan2(h);
    let (a2, h2, w3) = (a * a, h * h, w * w * w);
    let m0 = a2 * angle - h * w;
    let m1 = 2.0 / 3.0 * w3;
    let m2 = 0.25 * (a2 * a2 * angle - h * (2.0 * h2 - a2) * w);
    let m3 = w3 * (2.0 / 3.0 * a2 - 0.4 * w * w);
    let z0 = 0.25 * a2 * a2 * angle - h * (5.0 * a2 - 2.0 * h2) * w / 12.0;
    let z1 = 2.0 / 15.0 * w3 * w * w;
    let scale = 2.0 * PI * density;
    RevolvedSolid::from_moments(
        scale * (r * m0 + sense * m1),
        centre_z,
        scale * (r.powi(3) * m0 + sense * (3.0 * r * r * m1 + m3) + 3.0 * r * m2),
        scale * (r * z0 + sense * z1),
    )
}

/// One radial hole of radius a through a wall between two radii: mass, I_p and ∫ z² dm.
///
/// The hole's length at distance t from its axis plane is √(R₂² − t²) − √(R₁² − t²); the remaining
/// integral over t has weight √(a² − t²): Gauss-Chebyshev with 24 points, exact to rounding for a < R₁/2.
pub(super) fn radial_hole(radii: [f64; 2], a: f64, density: f64) -> [f64; 3] {
    const POINTS: usize = 24;
    let mut moments = [0.0; 3];
    for k in 1..=POINTS {
        let (sin, cos) = (PI * k as f64 / (POINTS + 1) as f64).sin_cos();
        let t2 = a * a * cos * cos;
        let s1 = (radii[0] * radii[0] - t2).max(0.0).sqrt();
        let s2 = (radii[1] * radii[1] - t2).max(0.0).sqrt();
        let weight = 2.0 * density * a * a * PI / (POINTS + 1) as f64 * sin * sin;
        moments[0] += weight * (s2 - s1);
        moments[1] += weight * ((s2.powi(3) - s1.powi(3)) / 3.0 + t2 * (s2 - s1));
        moments[2] += weight * (a * a - t2) / 3.0 * (s2 - s1);
    }
    moments
}
