//! The equilibria over speed: tangents of bearings at many speeds from those at some.

use super::equilibrium::{CageTreatment, equilibrium};
use crate::assembly::{Assembly, PhysicsError};
use crate::model::{BearingSite, Model};
use rayon::prelude::*;
use rotordyn_bearing::SiteTangent;
use rotordyn_linalg::StopRequest;
use std::f64::consts::PI;

/// Degree of the polynomials in the speed. Every other of their points are those of half the degree, every fourth those of a
/// quarter.
const DEGREE: usize = 32;
/// Expected error of the polynomials, relative to the entries of the tangents, up to which these are taken from them.
const TOLERANCE: f64 = 1e-10;
/// Error of the polynomials of half the degree beyond which nothing is expected.
const LARGEST_ERROR: f64 = 1e-6;
/// Error of the polynomials at the equilibria between their points.
const ALLOWED: f64 = 3e-9;
/// These equilibria, as fractions of a part.
const BETWEEN: [f64; 4] = [0.0713, 0.3219, 0.6171, 0.8987];
/// Smallest part that is halved, as a fraction of the range.
const LEAST_WIDTH: f64 = 1e-3;
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
/// some three from standstill. The tangents of each part taken are compared with those of equilibria between its points.
///
/// With tabulated bearings nothing is taken: a table may change between any two points.
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
    /// Speeds from which a path pays: several times those of its first part.
    pub const LEAST_SPEEDS: usize = 3 * (DEGREE + 1);

    /// The path over a range of speeds \[rad/s\] of which a study evaluates some `count`; `start`: displacements \[m, rad\] near
    /// those at any speed.
    ///
    /// # Errors
    /// No equilibrium at one of its points, or a request to stop.
    pub fn new(
        model: &Model,
        assembly: &Assembly,
        [low, high]: [f64; 2],
        cage: CageTreatment,
        start: &[f64],
        count: usize,
        stop: &StopRequest,
    ) -> Result<Self, PhysicsError> {
        let tabulated =
            |site: &BearingSite| site.bearing.element().is_linear() && site.bearing.depends_on_speed();
        let is_smooth = !model.bearings.iter().any(tabulated);
        let part = |&[low, high]: &[f64; 2]| {
            Part::new([low, high], is_smooth, |speed| {
                if stop.is_requested() {
                    return Err(PhysicsError::Stopped);
                }
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
            let widest = others.iter().map(Part::width).fold(0.0, f64::max);
            let is_small = widest < LEAST_WIDTH * (high - low);
            if !is_smooth || is_small || (2 * others.len() * (DEGREE + 1)) as f64 > left {
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
        // Beyond its ends a polynomial is no start.
        let speed = speed.clamp(part.speeds[0], part.speeds[DEGREE]);
        let mut out = vec![0.0; part.displacements[0].len()];
        for (weight, q) in part.weights(speed).into_iter().zip(&part.displacements) {
            out.iter_mut().zip(q).for_each(|(out, q)| *out += weight * q);
        }
        out
    }

    /// Tangents of all bearings at a speed \[rad/s\]; `None` where they are to be found by Newton's method.
    pub fn tangents(&self, speed: f64) -> Option<Vec<SiteTangent>> {
        let part = self.part(speed);
        (part.is_exact && (part.speeds[0]..=part.speeds[DEGREE]).contains(&speed))
            .then(|| sum(&part.weights(speed), &part.tangents))
    }

    fn part(&self, speed: f64) -> &Part {
        let after = self.parts.partition_point(|part| part.speeds[0] <= speed);
        &self.parts[after.saturating_sub(1)]
    }
}

impl Part {
    fn new(
        [low, high]: [f64; 2],
        is_smooth: bool,
        equilibrium: impl Fn(f64) -> Result<(Vec<f64>, Vec<SiteTangent>), PhysicsError> + Sync,
    ) -> Result<Self, PhysicsError> {
        let speeds: Vec<f64> = (0..=DEGREE)
            .map(|k| 0.5 * (low + high) - 0.5 * (high - low) * (PI * k as f64 / DEGREE as f64).cos())
            .collect();
        let found: Vec<_> = speeds.par_iter().map(|&speed| equilibrium(speed)).collect::<Result<_, _>>()?;
        let (displacements, tangents): (_, Vec<_>) = found.into_iter().unzip();
        let mut part = Self { speeds, displacements, tangents, is_exact: false };
        part.is_exact = is_smooth && part.expected_error() <= TOLERANCE;
        if part.is_exact {
            let at = |between: &f64| {
                let speed = low + between * (high - low);
                let found = sum(&part.weights(speed), &part.tangents);
                let (_, exact) = equilibrium(speed)?;
                let errors = entries(&found).zip(entries(&exact)).zip(part.sizes());
                Ok(errors.map(|((a, b), size)| (a - b).abs() / size).fold(0.0, larger))
            };
            let errors: Vec<f64> = BETWEEN.par_iter().map(at).collect::<Result<_, PhysicsError>>()?;
            part.is_exact = errors.into_iter().fold(0.0, larger) <= ALLOWED;
        }
        Ok(part)
    }

    /// Largest error expected of an entry, relative to its size; infinite where nothing can be expected.
    fn expected_error(&self) -> f64 {
        let [coarse, fine] = [4, 2].map(|every| self.errors(every));
        let expected = |(coarse, fine): (f64, f64)| {
            // Written so that not-a-number is no small error.
            let is_known = fine <= LARGEST_ERROR && coarse.is_finite();
            if is_known {
                fine * if fine < coarse { (fine / coarse).powi(2) } else { 1.0 }
            } else {
                f64::INFINITY
            }
        };
        coarse.into_iter().zip(fine).map(expected).fold(0.0, larger)
    }

    /// Error of every entry of the polynomials through every so many points at those between them, relative to its size.
    fn errors(&self, every: usize) -> Vec<f64> {
        let points: Vec<f64> = self.speeds.iter().copied().step_by(every).collect();
        let through: Vec<Vec<SiteTangent>> = self.tangents.iter().step_by(every).cloned().collect();
        let sizes = self.sizes();
        let mut errors = vec![0.0; sizes.len()];
        for k in (every / 2..self.speeds.len()).step_by(every) {
            let near = sum(&weights(&points, self.speeds[k]), &through);
            let pairs = entries(&near).zip(entries(&self.tangents[k])).zip(&sizes);
            for (error, ((a, b), size)) in errors.iter_mut().zip(pairs) {
                *error = larger(*error, (a - b).abs() / size);
            }
        }
        errors
    }

    /// Size of every entry over all points, √(K_ii K_jj) of the largest ones or its own.
    fn sizes(&self) -> Vec<f64> {
        let mut largest = vec![0.0_f64; 72 * self.tangents[0].len()];
        for tangents in &self.tangents {
            largest.iter_mut().zip(entries(tangents)).for_each(|(size, entry)| *size = size.max(entry.abs()));
        }
        let of = |k: usize| {
            let (matrix, i, j) = (k / 36 * 36, k % 36 / 6, k % 6);
            let mean = (largest[matrix + 7 * i] * largest[matrix + 7 * j]).sqrt();
            mean.max(largest[k]).max(f64::MIN_POSITIVE)
        };
        (0..largest.len()).map(of).collect()
    }

    fn width(&self) -> f64 {
        self.speeds[DEGREE] - self.speeds[0]
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

/// Entries of K and C of all bearings.
fn entries(of: &[SiteTangent]) -> impl Iterator<Item = f64> {
    of.iter().flat_map(|t| t.stiffness.as_flattened().iter().chain(t.damping.as_flattened()).copied())
}

/// The larger of two errors; not-a-number is larger than any.
fn larger(a: f64, b: f64) -> f64 {
    if a.is_nan() || b <= a { a } else { b }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A part of one bearing with its K_xx and K_yy over −1 to 1.
    fn part(k: impl Fn(f64) -> [f64; 2] + Sync) -> Part {
        let at = |speed: f64| {
            let mut tangent = SiteTangent::default();
            [tangent.stiffness[0][0], tangent.stiffness[1][1]] = k(speed);
            Ok((Vec::new(), vec![tangent]))
        };
        Part::new([-1.0, 1.0], true, at).unwrap()
    }

    #[test]
    fn smooth_tangents_are_taken_and_others_are_not() {
        assert!(part(|x| [1.0 + 0.1 * x.sin(), 3.0]).is_exact);
        let smooth = |x: f64| 1.0 + 0.8 * (-4.0 * x * x).exp();
        assert!(part(|x| [smooth(x), 1.0]).is_exact);
        // A bend beside an entry that converges fast, a jump, and what is not a number at some or all points.
        assert!(!part(|x| [smooth(x), 1.0 + 1e-4 * (x - 0.13).max(0.0)]).is_exact);
        assert!(!part(|x| [1.0, if x > 0.4 { 1.01 } else { 1.0 }]).is_exact);
        assert!(!part(|x| [1.0, if x < -0.9 { f64::NAN } else { 1.0 }]).is_exact);
        assert!(!part(|_| [1.0, f64::NAN]).is_exact);
        assert!(larger(f64::NAN, 1.0).is_nan() && larger(1.0, f64::NAN).is_nan() && larger(1.0, 2.0) == 2.0);
    }
}
