//! A mode: eigenvalue, shape, kind, energies.

use rotordyn_linalg::Complex64;
use serde::{Deserialize, Serialize};
use std::f64::consts::TAU;

/// One oscillatory mode, q(t) = Re(φ e^{λt}).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Mode {
    /// λ \[1/s\].
    pub eigenvalue: Complex64,
    /// φ over the free DOFs, φᴴ M φ = 1, its largest translation real and positive.
    pub shape: Vec<Complex64>,
    /// φ over all DOFs, six per node.
    pub full_shape: Vec<Complex64>,
    pub kind: ModeKind,
    /// For example "1st bending forward"; numbered by frequency within its kind.
    pub label: String,
    /// Whirl index of every shaft node: −1 backward circle, 0 straight line, 1 forward circle.
    pub whirl: Vec<f64>,
    /// Kinetic energy distribution.
    pub energy: Energy,
    /// Effective modal mass for base excitation along x, y, z, as a fraction of the total mass.
    pub effective_mass: [f64; 3],
}

impl Mode {
    /// Damped angular frequency ω_d = Im λ \[rad/s\].
    pub fn omega(&self) -> f64 {
        self.eigenvalue.im
    }

    /// Damped frequency \[Hz\].
    pub fn frequency_hz(&self) -> f64 {
        self.eigenvalue.im / TAU
    }

    /// Natural angular frequency |λ| \[rad/s\].
    pub fn natural_omega(&self) -> f64 {
        self.eigenvalue.norm()
    }

    /// Damping ratio ζ = −Re λ / |λ|.
    pub fn zeta(&self) -> f64 {
        -self.eigenvalue.re / self.eigenvalue.norm()
    }

    /// Log decrement (logarithmic decrement) δ = 2π ζ / √(1 − ζ²).
    pub fn log_dec(&self) -> f64 {
        log_decrement(self.eigenvalue)
    }
}

/// δ = −2π Re λ / Im λ.
pub(crate) fn log_decrement(eigenvalue: Complex64) -> f64 {
    -TAU * eigenvalue.re / eigenvalue.im
}

/// aᴴ b.
pub(super) fn inner(a: &[Complex64], b: &[Complex64]) -> Complex64 {
    a.iter().zip(b).map(|(a, b)| a.conj() * b).sum()
}

/// Kind of a mode, by kinetic energy and whirl direction.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum ModeKind {
    /// Bending, forward whirl (in the direction of spin, x towards y) of at least 95 % of the orbit area.
    Forward,
    /// Bending, backward whirl (against the spin), likewise.
    Backward,
    /// Bending, forward and backward whirl along the shaft.
    Mixed,
    /// Bending in a plane, mostly along x.
    PlaneX,
    /// Bending in a plane, mostly along y.
    PlaneY,
    Torsional,
    Axial,
    /// Most of the energy is in a body (housing, block).
    Body,
}

impl ModeKind {
    /// Name of the kind.
    pub fn name(self) -> &'static str {
        match self {
            Self::Forward => "bending forward",
            Self::Backward => "bending backward",
            Self::Mixed => "bending mixed",
            Self::PlaneX => "bending x",
            Self::PlaneY => "bending y",
            Self::Torsional => "torsional",
            Self::Axial => "axial",
            Self::Body => "body",
        }
    }

    /// Whether the kind is shaft bending.
    pub fn is_bending(self) -> bool {
        !matches!(self, Self::Torsional | Self::Axial | Self::Body)
    }
}

/// Kinetic energy distribution of a mode; the fractions sum to 1.
#[derive(Clone, Debug, PartialEq, Default, Serialize, Deserialize)]
pub struct Energy {
    /// Shaft, along u_x and θ_y.
    pub bending_x: f64,
    /// Shaft, along u_y and θ_x.
    pub bending_y: f64,
    /// Shaft, along u_z.
    pub axial: f64,
    /// Shaft, along θ_z.
    pub torsion: f64,
    /// Every body, by direction.
    pub bodies: Vec<[f64; 6]>,
}

impl Energy {
    /// Share of all bodies.
    pub fn body_total(&self) -> f64 {
        self.bodies.iter().flatten().sum()
    }
}
