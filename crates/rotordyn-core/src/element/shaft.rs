//! Two-node Timoshenko shaft element: data and section properties; matrices in [`shaft_matrices`](super::shaft_matrices).

use rotordyn_bearing::material::Material;
use std::f64::consts::PI;

/// Formula for the shear coefficient κ of a section.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ShearCoefficient {
    /// No shear deformation (Rayleigh, or Euler-Bernoulli without rotary inertia).
    Rigid,
    /// Cowper 1966.
    Cowper,
    /// Hutchinson 2001, hollow circle.
    Hutchinson,
    /// Given value of κ.
    Value(f64),
}

/// Two-node shaft element, possibly tapered and hollow, 12 DOFs.
#[derive(Clone, Debug, PartialEq)]
pub struct ShaftElement {
    /// Length L \[m\].
    pub length: f64,
    /// Outer diameter at the left and right node \[m\].
    pub outer_diameter: [f64; 2],
    /// Inner diameter at the left and right node \[m\].
    pub inner_diameter: [f64; 2],
    pub material: Material,
    pub shear: ShearCoefficient,
    /// Whether the mass matrix has rotary inertia.
    pub rotary_inertia: bool,
    /// Axial force \[N\], positive in tension.
    pub axial_force: f64,
    /// Torque \[N m\] transmitted along +z.
    pub torque: f64,
    /// Proportional (Rayleigh) damping C = α M + β K: α \[1/s\], β \[s\] (non-rotating, of the element).
    pub proportional_damping: [f64; 2],
    /// Internal (rotating) viscous damping coefficient η_v \[s\]: C_i = η_v K_e, with circulatory stiffness Ω η_v K_c.
    pub internal_viscous: f64,
    /// Further sections between the same two nodes, such as a sleeve; each has its own shape functions, and their matrices
    /// are added.
    pub layers: Vec<ShaftElement>,
}

impl ShaftElement {
    /// The element itself, then its layers.
    pub fn with_layers(&self) -> impl Iterator<Item = &Self> {
        std::iter::once(self).chain(&self.layers)
    }

    /// Outer and inner diameter at ξ = z/L \[m\].
    fn diameters(&self, xi: f64) -> (f64, f64) {
        let at = |d: [f64; 2]| d[0] + xi * (d[1] - d[0]);
        (at(self.outer_diameter), at(self.inner_diameter))
    }

    /// Cross-section area A(ξ) \[m²\].
    pub fn area(&self, xi: f64) -> f64 {
        let (o, i) = self.diameters(xi);
        PI / 4.0 * (o * o - i * i)
    }

    /// Second moment of area I(ξ) about a diameter \[m⁴\]; the polar one is twice this.
    pub fn second_moment(&self, xi: f64) -> f64 {
        let (o, i) = self.diameters(xi);
        PI / 64.0 * (o.powi(4) - i.powi(4))
    }

    /// Shear coefficient κ, with ν = E/2G − 1 and m the ratio of mean diameters; `None` when rigid in shear.
    ///
    /// Cowper 1966: κ = 6(1+ν)(1+m²)² / ((7+6ν)(1+m²)² + (20+12ν)m²).
    /// Hutchinson 2001: κ = 6(1+ν)²(1+m²)² / ((7+12ν+4ν²)(1+m²)² + 4(5+6ν+2ν²)m²); ROSS 3.1.0 lacks one 1 + ν.
    pub fn shear_coefficient(&self) -> Option<f64> {
        let nu = self.material.young / (2.0 * self.material.shear) - 1.0;
        let (o, i) = self.diameters(0.5);
        let m2 = (i / o).powi(2);
        let a = (1.0 + m2).powi(2);
        match self.shear {
            ShearCoefficient::Rigid => None,
            ShearCoefficient::Value(kappa) => Some(kappa),
            ShearCoefficient::Cowper => {
                Some(6.0 * (1.0 + nu) * a / ((7.0 + 6.0 * nu) * a + (20.0 + 12.0 * nu) * m2))
            }
            ShearCoefficient::Hutchinson => Some(
                6.0 * (1.0 + nu).powi(2) * a
                    / ((7.0 + 12.0 * nu + 4.0 * nu * nu) * a + 4.0 * (5.0 + 6.0 * nu + 2.0 * nu * nu) * m2),
            ),
        }
    }

    /// Shear parameter φ = 12 E I / (κ G A L²) of the middle section; 0 when rigid in shear.
    pub fn shear_parameter(&self) -> f64 {
        self.shear_coefficient().map_or(0.0, |kappa| {
            12.0 * self.material.young * self.second_moment(0.5)
                / (kappa * self.material.shear * self.area(0.5) * self.length.powi(2))
        })
    }

    /// Mass with that of the layers \[kg\].
    pub fn mass(&self) -> f64 {
        let own = |e: &Self| e.length * e.material.density * quadrature(|xi| e.area(xi));
        self.with_layers().map(own).sum()
    }

    /// Polar moment of inertia about the shaft's axis of the part from ξ to the right end, with the layers \[kg m²\].
    pub fn polar_inertia_beyond(&self, xi: f64) -> f64 {
        let span = 1.0 - xi;
        let own = |e: &Self| {
            let density = 2.0 * e.material.density * e.length * span;
            density * quadrature(|t| e.second_moment(xi + t * span))
        };
        self.with_layers().map(own).sum()
    }
}

/// ∫₀¹ f dξ by five-point Gauss-Legendre quadrature, exact up to degree 9; the polynomials of a conical
/// element have degree 8 at most.
pub(super) fn quadrature(f: impl Fn(f64) -> f64) -> f64 {
    gauss(|xi, w| w * f(xi)).iter().sum()
}

/// Calls f(ξ, weight) at the five Gauss points of 0..1.
pub(super) fn gauss<T>(mut f: impl FnMut(f64, f64) -> T) -> [T; 5] {
    let (a, b) = (2.0 * (10.0_f64 / 7.0).sqrt(), 13.0 * 70.0_f64.sqrt());
    let (inner, outer) = ((5.0 - a).sqrt() / 3.0, (5.0 + a).sqrt() / 3.0);
    let (heavy, light) = ((322.0 + b) / 1800.0, (322.0 - b) / 1800.0);
    let points = [(-outer, light), (-inner, heavy), (0.0, 64.0 / 225.0), (inner, heavy), (outer, light)];
    points.map(|(x, w)| f(0.5 * (1.0 + x), w))
}
