//! The equilibria over speed: tangents of bearings at many speeds from those at some.

use super::equilibrium::{CageTreatment, equilibrium};
use crate::assembly::{Assembly, PhysicsError};
use crate::model::Model;
use rayon::prelude::*;
use rotordyn_bearing::SiteTangent;
use std::f64::consts::PI;

/// Degree of the polynomials in the speed. Every other of their points are those of half the degree, every fourth those of a
/// quarter.
const DEGREE: usize = 32;
/// Expected error of the polynomials, relative to the entries of the tangents, up to which these are taken from them: of the size
/// that Newton's method leaves.
const TOLERANCE: f64 = 1e-10;
/// Part of the evaluations of a study that may go into the polynomials.
const LARGEST_PART: f64 = 0.25;

/// Displacements and tangents of the equilibrium as polynomials of the speed, through Chebyshev points of the second kind, in
/// parts of the range of speeds:
/// q(Ω) ≈ Σ_k w_k/(Ω − Ω_k) q_k / Σ_k w_k/(Ω − Ω_k), Ω_k = ½(Ω₀ + Ω₁) − ½(Ω₁ − Ω₀) cos(kπ/n), w_k = (−1)^k, halved at the
/// ends (barycentric formula; Berrut and Trefethen 2004, eq. 4.2 and 5.4).
///
/// The errors e₈ and e₁₆ of the polynomials of a quarter and half the degree are known at the points that they do not pass
/// through; that of the whole one is expected to be e₁₆ (e₁₆/e₈)², as the errors of smooth functions decrease by equal factors
/// (Trefethen 2013, theorem 8.2). Where balls enter and leave the load zone the tangents may have bends: a part with larger
/// errors is halved, as far as that pays. What is left there is a start from which Newton's method takes one step, where it takes
/// some three from standstill.
#[derive(Clone, Debug)]
pub struct EquilibriumPath {
    /// By speed.
    parts: Vec<Part>,
}

#[derive(Clone, Debug)]
struct Part {
    speeds: Vec<f64>,
    displacements: Vec<Vec<f64>>,
    tangents: Vec<Vec<SiteTangent>>,
    /// Whether its tangents are those of the equilibrium.
    is_exact: bool,
}

impl EquilibriumPath {
    /// Speeds from which a path pays: several times those it is made of.
    pub const LEAST_SPEEDS: usize = 3 * (DEGREE + 1);

    /// The path over a range of speeds \[rad/s\] of which a study evaluates some `count`; `start`: displacements \[m, rad\] near
    /// those at any speed.
    ///
    /// # Errors
    /// No equilibrium at one of its points.
    pub fn new(
        model: &Model,
        assembly: &Assembly,
        [low, high]: [f64; 2],
        cage: CageTreatment,
        start: &[f64],
        count: usize,
    ) -> Result<Self, PhysicsError> {
        let part = |&[low, high]: &[f64; 2]| {
            Part::new([low, high], |speed| {
                let found = equilibrium(model, assembly, speed, cage, Some(start))?;
                let tangents = found.tangents();
                Ok((found.q, tangents))
            })
        };
        let mut parts = Vec::new();
        let mut ranges = vec![[low, high]];
        let mut left = LARGEST_PART * count as f64;
        while !ranges.is_empty() {
            left -= (ranges.len() * (DEGREE + 1)) as f64;
            let found: Vec<Part> = ranges.par_iter().map(part).collect::<Result<_, PhysicsError>>()?;
            let (exact, others): (Vec<_>, Vec<_>) = found.into_iter().partition(|part| part.is_exact);
            parts.extend(exact);
            if (2 * others.len() * (DEGREE + 1)) as f64 > left {
                parts.extend(others);
                break;
            }
            ranges = others.iter().flat_map(Part::halves).collect();
        }
        parts.sort_by(|a, b| a.speeds[0].total_cmp(&b.speeds[0]));
        Ok(Self { parts })
    }

    /// Displacements of the free DOFs at a speed \[rad/s\].
    pub fn at(&self, speed: f64) -> Vec<f64> {
        let part = self.part(speed);
        let mut out = vec![0.0; part.displacements[0].len()];
        for (weight, q) in part.weights(speed).into_iter().zip(&part.displacements) {
            out.iter_mut().zip(q).for_each(|(out, q)| *out += weight * q);
        }
        out
    }

    /// Tangents of all bearings at a speed \[rad/s\]; `None` where they are to be found by Newton's method.
    pub fn tangents(&self, speed: f64) -> Option<Vec<SiteTangent>> {
        let part = self.part(speed);
        part.is_exact.then(|| sum(&part.weights(speed), &part.tangents))
    }

    fn part(&self, speed: f64) -> &Part {
        let after = self.parts.partition_point(|part| part.speeds[0] <= speed);
        &self.parts[after.saturating_sub(1)]
    }
}

impl Part {
    fn new(
        [low, high]: [f64; 2],
        equilibrium: impl Fn(f64) -> Result<(Vec<f64>, Vec<SiteTangent>), PhysicsError> + Sync,
    ) -> Result<Self, PhysicsError> {
        let speeds: Vec<f64> = (0..=DEGREE)
            .map(|k| 0.5 * (low + high) - 0.5 * (high - low) * (PI * k as f64 / DEGREE as f64).cos())
            .collect();
        let found: Vec<_> = speeds.par_iter().map(|&speed| equilibrium(speed)).collect::<Result<_, _>>()?;
        let (displacements, tangents): (_, Vec<_>) = found.into_iter().unzip();
        let [coarse, fine] = [4, 2].map(|every| error(&speeds, &tangents, every));
        let is_exact = fine * (fine / coarse).min(1.0).powi(2) <= TOLERANCE || fine == 0.0;
        Ok(Self { speeds, displacements, tangents, is_exact })
    }

    fn halves(&self) -> [[f64; 2]; 2] {
        let (low, high) = (self.speeds[0], self.speeds[DEGREE]);
        let middle = 0.5 * (low + high);
        [[low, middle], [middle, high]]
    }

    fn weights(&self, speed: f64) -> Vec<f64> {
        weights(&self.speeds, speed)
    }
}

/// Weights of the values at Chebyshev points in the value at a speed.
fn weights(points: &[f64], speed: f64) -> Vec<f64> {
    if let Some(at) = points.iter().position(|&point| point == speed) {
        return (0..points.len()).map(|k| if k == at { 1.0 } else { 0.0 }).collect();
    }
    let weight = |(k, point): (usize, &f64)| {
        let sign = if k.is_multiple_of(2) { 1.0 } else { -1.0 };
        let end = if k == 0 || k + 1 == points.len() { 0.5 } else { 1.0 };
        sign * end / (speed - point)
    };
    let weights: Vec<f64> = points.iter().enumerate().map(weight).collect();
    let sum: f64 = weights.iter().sum();
    weights.into_iter().map(|weight| weight / sum).collect()
}

fn sum(weights: &[f64], of: &[Vec<SiteTangent>]) -> Vec<SiteTangent> {
    let mut out = vec![SiteTangent::default(); of[0].len()];
    for (weight, tangents) in weights.iter().zip(of) {
        for (out, tangent) in out.iter_mut().zip(tangents) {
            let pairs = [(&mut out.stiffness, &tangent.stiffness), (&mut out.damping, &tangent.damping)];
            for (out, tangent) in pairs {
                let entries = out.as_flattened_mut().iter_mut().zip(tangent.as_flattened());
                entries.for_each(|(out, entry)| *out += weight * entry);
            }
        }
    }
    out
}

/// Error of the polynomials through every so many points at those between them, relative to √(K_ii K_jj) of each matrix.
fn error(speeds: &[f64], tangents: &[Vec<SiteTangent>], every: usize) -> f64 {
    let points: Vec<f64> = speeds.iter().copied().step_by(every).collect();
    let through: Vec<Vec<SiteTangent>> = tangents.iter().step_by(every).cloned().collect();
    let at = |k: usize| {
        let near = sum(&weights(&points, speeds[k]), &through);
        let pairs = near.iter().zip(&tangents[k]);
        let errors = pairs
            .flat_map(|(a, b)| [difference(&a.stiffness, &b.stiffness), difference(&a.damping, &b.damping)]);
        errors.fold(0.0, f64::max)
    };
    (every / 2..speeds.len()).step_by(every).map(at).fold(0.0, f64::max)
}

/// Largest difference of two matrices, relative to √(b_ii b_jj).
fn difference(a: &[[f64; 6]; 6], b: &[[f64; 6]; 6]) -> f64 {
    let relative = |k: usize| {
        let (i, j) = (k / 6, k % 6);
        let size = (b[i][i] * b[j][j]).abs().sqrt().max(b[i][j].abs());
        if a[i][j] == b[i][j] { 0.0 } else { (a[i][j] - b[i][j]).abs() / size }
    };
    (0..36).map(relative).fold(0.0, f64::max)
}
