//! Isotropic linear-elastic material.

use serde::{Deserialize, Serialize};

/// Isotropic linear-elastic material of a shaft, disc or bearing part.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Material {
    pub name: String,
    /// Young's modulus E \[Pa\].
    pub young: f64,
    /// Shear modulus G \[Pa\]; E / (2 (1 + ν)) unless the file gives it.
    pub shear: f64,
    /// Poisson's ratio ν \[-\].
    pub poisson: f64,
    /// Density ρ \[kg/m³\].
    pub density: f64,
}
