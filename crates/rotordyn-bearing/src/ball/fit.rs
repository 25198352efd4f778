//! Change of radial internal clearance by interference fits, temperature and centrifugal ring growth.

use crate::BallGeometry;
use crate::material::Material;
use serde::{Deserialize, Serialize};

/// Mounting and operating conditions of the rings.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Fit {
    /// Diametral interference of shaft and bore \[m\]; 0 for a clearance fit.
    pub shaft_interference: f64,
    /// Bore of a hollow shaft \[m\]; 0 for a solid one.
    pub shaft_bore: f64,
    /// Diametral interference of outer ring and housing \[m\]; 0 for a clearance fit.
    pub housing_interference: f64,
    /// Outside diameter of the housing \[m\]; 0 for a rigid, infinitely thick one.
    pub housing_diameter: f64,
    /// Temperatures of inner ring with shaft and of outer ring with housing above assembly \[K\].
    pub inner_temperature_rise: f64,
    pub outer_temperature_rise: f64,
    /// Coefficient of thermal expansion \[1/K\].
    pub expansion: f64,
    /// Whether centrifugal growth of the inner ring is included.
    pub speed_growth: bool,
}

/// Materials of ring, shaft and housing.
#[derive(Clone, Copy, Debug)]
pub struct FitMaterials<'a> {
    pub ring: &'a Material,
    pub shaft: &'a Material,
    pub housing: &'a Material,
}

impl<'a> FitMaterials<'a> {
    /// Shaft and housing of the rings' material.
    pub fn all(ring: &'a Material) -> Self {
        Self { ring, shaft: ring, housing: ring }
    }
}

impl Fit {
    /// Change of the diametral clearance P_d \[m\] by fits, temperatures and the shaft's speed Ω \[rad/s\].
    ///
    /// ΔP_d = −2 u_i − 2 u_o + α D_pw (ΔT_o − ΔT_i): u_i expansion of the inner race by fit pressure and
    /// rotation, u_o contraction of the outer race by fit pressure; balls at the rings' mean temperature,
    /// shaft and housing at the temperature and with the expansion of their ring. Races at D_pw ∓ D_w cos α₀.
    ///
    /// Rings, shaft and housing are thick rings in plane stress (Lamé). Limits: a solid shaft of the rings' material
    /// grows the race by I d/F, d bore and F race diameter; equal temperature rises cause no change.
    /// Source: Harris, Rolling Bearing Analysis, ch. 3; Timoshenko, Strength of Materials II, art. 41-44.
    pub fn clearance_change(&self, geometry: &BallGeometry, materials: &FitMaterials, speed: f64) -> f64 {
        let ring = Ring::inner(geometry);
        let pressure = self.shaft_pressure(geometry, materials, speed);
        let fit_expansion = ring.outer_by_inside(pressure, materials.ring);
        let centrifugal_growth =
            if self.speed_growth { ring.outer_by_rotation(speed, materials.ring) } else { 0.0 };
        let fit_contraction = Ring::outer(geometry)
            .inner_by_outside(self.housing_pressure(geometry, materials), materials.ring);
        let thermal_change = self.expansion
            * geometry.pitch_diameter
            * (self.outer_temperature_rise - self.inner_temperature_rise);
        thermal_change - 2.0 * (fit_expansion + centrifugal_growth - fit_contraction)
    }

    /// Fit pressure between shaft and bore \[Pa\] at a speed Ω \[rad/s\]; 0 after loosening by rotation.
    pub fn shaft_pressure(&self, geometry: &BallGeometry, materials: &FitMaterials, speed: f64) -> f64 {
        let [shaft, ring] = self.seat(geometry);
        let compliance =
            ring.inner_by_inside(1.0, materials.ring) - shaft.outer_by_outside(1.0, materials.shaft);
        (0.5 * self.interference_left(geometry, materials, speed) / compliance).max(0.0)
    }

    /// Diametral interference of shaft and bore that rotation at a speed Ω \[rad/s\] leaves \[m\]; negative for play.
    pub fn interference_left(&self, geometry: &BallGeometry, materials: &FitMaterials, speed: f64) -> f64 {
        let [shaft, ring] = self.seat(geometry);
        let centrifugal_opening = if self.speed_growth {
            ring.inner_by_rotation(speed, materials.ring) - shaft.outer_by_rotation(speed, materials.shaft)
        } else {
            0.0
        };
        self.shaft_interference - 2.0 * centrifugal_opening
    }

    /// Shaft and inner ring.
    fn seat(&self, geometry: &BallGeometry) -> [Ring; 2] {
        let ring = Ring::inner(geometry);
        [Ring { inside: 0.5 * self.shaft_bore, outside: ring.inside }, ring]
    }

    /// Fit pressure between outer ring and housing \[Pa\].
    pub fn housing_pressure(&self, geometry: &BallGeometry, materials: &FitMaterials) -> f64 {
        let ring = Ring::outer(geometry);
        let housing_compliance = if self.housing_diameter > geometry.outside_diameter {
            let housing = Ring { inside: ring.outside, outside: 0.5 * self.housing_diameter };
            housing.inner_by_inside(1.0, materials.housing)
        } else {
            0.0
        };
        (0.5 * self.housing_interference / (housing_compliance - ring.outer_by_outside(1.0, materials.ring)))
            .max(0.0)
    }
}

/// A thick ring (Lamé) of radii a < b \[m\] in plane stress; a = 0 for a disc. Displacements u are positive
/// outwards.
#[derive(Clone, Copy, Debug)]
struct Ring {
    inside: f64,
    outside: f64,
}

impl Ring {
    /// Inner ring, from bore to race.
    fn inner(g: &BallGeometry) -> Self {
        Self {
            inside: 0.5 * g.bore,
            outside: 0.5 * (g.pitch_diameter - g.ball_diameter * g.contact_angle.cos()),
        }
    }

    /// Outer ring, from race to outside diameter.
    fn outer(g: &BallGeometry) -> Self {
        Self {
            inside: 0.5 * (g.pitch_diameter + g.ball_diameter * g.contact_angle.cos()),
            outside: 0.5 * g.outside_diameter,
        }
    }

    /// a², b² and b² − a².
    fn squares(&self) -> [f64; 3] {
        let (a, b) = (self.inside * self.inside, self.outside * self.outside);
        [a, b, b - a]
    }

    /// u(a) = (p a/E) ((b² + a²)/(b² − a²) + ν) under internal pressure.
    fn inner_by_inside(&self, pressure: f64, m: &Material) -> f64 {
        let [a, b, wall] = self.squares();
        pressure * self.inside / m.young * ((b + a) / wall + m.poisson)
    }

    /// u(b) = (p b/E) 2 a²/(b² − a²) under internal pressure.
    fn outer_by_inside(&self, pressure: f64, m: &Material) -> f64 {
        let [a, _, wall] = self.squares();
        pressure * self.outside / m.young * 2.0 * a / wall
    }

    /// u(b) = −(p b/E) ((b² + a²)/(b² − a²) − ν) under external pressure.
    fn outer_by_outside(&self, pressure: f64, m: &Material) -> f64 {
        let [a, b, wall] = self.squares();
        -pressure * self.outside / m.young * ((b + a) / wall - m.poisson)
    }

    /// u(a) = −(p a/E) 2 b²/(b² − a²) under external pressure.
    fn inner_by_outside(&self, pressure: f64, m: &Material) -> f64 {
        let [_, b, wall] = self.squares();
        -pressure * self.inside / m.young * 2.0 * b / wall
    }

    /// u(b) = (ρ Ω² b/4E) ((1 − ν) b² + (3 + ν) a²) under rotation.
    fn outer_by_rotation(&self, speed: f64, m: &Material) -> f64 {
        let [a, b, _] = self.squares();
        m.density * speed * speed * self.outside / (4.0 * m.young)
            * ((1.0 - m.poisson) * b + (3.0 + m.poisson) * a)
    }

    /// u(a) = (ρ Ω² a/4E) ((1 − ν) a² + (3 + ν) b²) under rotation.
    fn inner_by_rotation(&self, speed: f64, m: &Material) -> f64 {
        let [a, b, _] = self.squares();
        m.density * speed * speed * self.inside / (4.0 * m.young)
            * ((1.0 - m.poisson) * a + (3.0 + m.poisson) * b)
    }
}
