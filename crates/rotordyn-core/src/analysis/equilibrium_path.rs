//! The equilibrium path over speed: where Newton's method starts for each of many speeds.

use super::equilibrium::{CageTreatment, equilibrium};
use crate::assembly::{Assembly, PhysicsError};
use crate::model::Model;
use rayon::prelude::*;
use std::f64::consts::PI;

/// Degree of the polynomial in the speed.
const DEGREE: usize = 24;

/// Displacements of the equilibrium as a polynomial of the speed, through Chebyshev points of the second kind.
///
/// q(Ω) ≈ Σ_k w_k/(Ω − Ω_k) q_k / Σ_k w_k/(Ω − Ω_k), Ω_k = ½(Ω₀ + Ω₁) − ½(Ω₁ − Ω₀) cos(kπ/n), w_k = (−1)^k, halved at the
/// ends (barycentric formula; Berrut and Trefethen 2004, eq. 4.2 and 5.4).
///
/// From it Newton's method takes one step, where it takes some three from standstill.
#[derive(Clone, Debug)]
pub struct EquilibriumPath {
    speeds: Vec<f64>,
    displacements: Vec<Vec<f64>>,
}

impl EquilibriumPath {
    /// Speeds from which a path pays: several times those it is made of.
    pub const LEAST_SPEEDS: usize = 4 * (DEGREE + 1);

    /// The path over a range of speeds \[rad/s\]; `start`: displacements \[m, rad\] near those at any speed.
    ///
    /// # Errors
    /// No equilibrium at one of its points.
    pub fn new(
        model: &Model,
        assembly: &Assembly,
        [low, high]: [f64; 2],
        cage: CageTreatment,
        start: &[f64],
    ) -> Result<Self, PhysicsError> {
        let speeds: Vec<f64> = (0..=DEGREE)
            .map(|k| 0.5 * (low + high) - 0.5 * (high - low) * (PI * k as f64 / DEGREE as f64).cos())
            .collect();
        let at = |&speed: &f64| Ok(equilibrium(model, assembly, speed, cage, Some(start))?.q);
        let displacements = speeds.par_iter().map(at).collect::<Result<_, PhysicsError>>()?;
        Ok(Self { speeds, displacements })
    }

    /// Displacements of the free DOFs at a speed \[rad/s\].
    pub fn at(&self, speed: f64) -> Vec<f64> {
        if let Some(k) = self.speeds.iter().position(|&at| at == speed) {
            return self.displacements[k].clone();
        }
        let weight = |k: usize| {
            let sign = if k.is_multiple_of(2) { 1.0 } else { -1.0 };
            let end = if k == 0 || k == DEGREE { 0.5 } else { 1.0 };
            sign * end / (speed - self.speeds[k])
        };
        let weights: Vec<f64> = (0..=DEGREE).map(weight).collect();
        let sum: f64 = weights.iter().sum();
        let mut out = vec![0.0; self.displacements[0].len()];
        for (weight, q) in weights.iter().zip(&self.displacements) {
            out.iter_mut().zip(q).for_each(|(out, q)| *out += weight / sum * q);
        }
        out
    }
}
