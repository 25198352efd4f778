//! The effective matrix of a time step, inverted once for many steps.

use nalgebra::DMatrix;

use super::Scheme;
use crate::model::Spin;
use crate::transient::system::System;
use rotordyn_linalg::panel::Panel;
use serde::{Deserialize, Serialize};

/// Largest (Ω − Ω_f) h for which an inverse computed at Ω_f is reused, by its first-order expansion in Ω: the neglected
/// second-order term is the square of this, 1e-8 of the gyroscopic effect.
const LARGEST_SPEED_CHANGE: f64 = 1e-4;

/// Inverses by step length.
#[derive(Default)]
pub(super) struct EffectiveMatrices {
    matrices: Vec<EffectiveMatrix>,
    /// Number of inversions.
    pub inverted: u64,
}

/// Inverse of the effective matrix for one step length, near one speed.
///
/// S(Ω) = S₀ + κ S′, S′ = (γ h G + β h² K_c)(1−α_f), κ = Ω − Ω_f; to first order S⁻¹ ≈ S₀⁻¹ − κ S₀⁻¹ S′ S₀⁻¹, and
/// likewise for its products with the interface map W.
pub(super) struct EffectiveMatrix {
    step: f64,
    /// Speed Ω_f \[rad/s\] and acceleration \[rad/s²\] of the inversion.
    speed: f64,
    acceleration: f64,
    /// S₀⁻¹ and S₀⁻¹ S′ S₀⁻¹.
    inverse: Panel,
    /// The same of S⁻¹ Wᵀ, coordinates × rows.
    response: Panel,
    /// The same of the interface compliance Y = W S⁻¹ Wᵀ, row-major.
    compliance: [Vec<f64>; 2],
}

/// Step length, speed and acceleration of every inversion in use, and the number of inversions: they give the same
/// inverses again.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Inversions {
    in_use: Vec<[f64; 3]>,
    count: u64,
}

impl EffectiveMatrices {
    /// When the matrices were inverted.
    pub fn inversions(&self) -> Inversions {
        let of = |matrix: &EffectiveMatrix| [matrix.step, matrix.speed, matrix.acceleration];
        Inversions { in_use: self.matrices.iter().map(of).collect(), count: self.inverted }
    }

    /// The matrices of earlier inversions, inverted again.
    pub fn repeat(system: &System, scheme: Scheme, inversions: &Inversions) -> Self {
        let again = |[step, speed, acceleration]: &[f64; 3]| {
            let spin = Spin { angle: 0.0, speed: *speed, acceleration: *acceleration };
            EffectiveMatrix::new(system, scheme, *step, &spin)
        };
        Self { matrices: inversions.in_use.iter().map(again).collect(), inverted: inversions.count }
    }

    /// The matrix for a step length, inverted again if the speed has changed too much.
    pub fn at(&mut self, system: &System, scheme: Scheme, step: f64, spin: &Spin) -> &EffectiveMatrix {
        let known = self.matrices.iter().position(|matrix| matrix.step == step);
        let k = match known {
            Some(k) if self.matrices[k].is_valid(spin) => k,
            Some(k) => {
                self.inverted += 1;
                self.matrices[k] = EffectiveMatrix::new(system, scheme, step, spin);
                k
            }
            None => {
                self.inverted += 1;
                self.matrices.push(EffectiveMatrix::new(system, scheme, step, spin));
                self.matrices.len() - 1
            }
        };
        &self.matrices[k]
    }
}

impl EffectiveMatrix {
    /// S = (1−α_m) I + (1−α_f) (γ h (C + Ω G) + β h² (K + Ω̇ K_s + Ω K_c)), inverted.
    fn new(system: &System, scheme: Scheme, step: f64, spin: &Spin) -> Self {
        let Scheme { alpha_m, alpha_f, beta, gamma } = scheme;
        let n = system.structure();
        let weight = 1.0 - alpha_f;
        let by_speed =
            (&system.gyroscopic * (gamma * step) + &system.circulatory * (beta * step * step)) * weight;
        let effective = DMatrix::identity(n, n) * (1.0 - alpha_m)
            + (&system.damping * (gamma * step)
                + (&system.stiffness + &system.spin_up * spin.acceleration) * (beta * step * step))
                * weight
            + &by_speed * spin.speed;
        // The effective matrix is the identity plus terms of order h: invertible for any useful step length;
        // a singular one yields NaN, which the divergence check of the driver reports.
        let inverse = effective.try_inverse().unwrap_or_else(|| DMatrix::from_element(n, n, f64::NAN));
        let slope = &inverse * by_speed * &inverse;
        let map = &system.interface_map;
        let response = [&inverse * map.transpose(), &slope * map.transpose()];
        // Column-major of the transpose is row-major.
        let compliance = [0, 1].map(|k| (map * &response[k]).transpose().as_slice().to_vec());
        Self {
            step,
            speed: spin.speed,
            acceleration: spin.acceleration,
            inverse: Panel::new(&[&inverse, &slope]),
            response: Panel::new(&[&response[0], &response[1]]),
            compliance,
        }
    }

    fn is_valid(&self, spin: &Spin) -> bool {
        let limit = LARGEST_SPEED_CHANGE;
        ((self.speed - spin.speed) * self.step).abs() <= limit
            && ((self.acceleration - spin.acceleration) * self.step * self.step).abs() <= limit * limit
    }

    /// Adds S⁻¹ r at a speed \[rad/s\] to `out`.
    pub fn add_inverse(&self, speed: f64, right: &[f64], scratch: &mut Vec<f64>, out: &mut [f64]) {
        let change = speed - self.speed;
        scratch.clear();
        scratch.extend(right);
        scratch.extend(right.iter().map(|r| -change * r));
        self.inverse.mul_add(scratch, out);
    }

    /// Adds w S⁻¹ Wᵀ f at a speed \[rad/s\] to `out`, with a weight w.
    pub fn add_response(
        &self,
        speed: f64,
        weight: f64,
        force: &[f64],
        scratch: &mut Vec<f64>,
        out: &mut [f64],
    ) {
        let change = speed - self.speed;
        scratch.clear();
        scratch.extend(force.iter().map(|f| weight * f));
        scratch.extend(force.iter().map(|f| -change * weight * f));
        self.response.mul_add(scratch, out);
    }

    /// w Y at a speed \[rad/s\], written to `out`, with a weight w.
    pub fn compliance(&self, speed: f64, weight: f64, out: &mut [f64]) {
        let change = speed - self.speed;
        let [at_inversion, slope] = &self.compliance;
        for (y, (y0, y1)) in out.iter_mut().zip(at_inversion.iter().zip(slope)) {
            *y = weight * (y0 - change * y1);
        }
    }
}
