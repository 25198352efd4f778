//! Two-node Timoshenko shaft element.

use super::material::Material;

/// How the shear coefficient κ of a section is found.
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
    /// Damping C = α M + β K: α \[1/s\], β \[s\] (non-rotating, of the element).
    pub proportional: [f64; 2],
    /// Internal (rotating) viscous damping coefficient η_v \[s\]: C_i = η_v K_e, with circulatory stiffness Ω η_v K_c.
    pub internal_viscous: f64,
}
