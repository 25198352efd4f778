//! Fitted power law of a ball's contacts, smooth down to zero load, and its least-squares fit.

use super::ContactLoad;
use nalgebra::{DMatrix, DVector};
use serde::{Deserialize, Serialize};

/// Q = K δⁿ + ΔQ between the two races, fitted over a range of loads.
///
/// Source: Zhang 2016 eq. 2 and 11, after Nonato & Cavalca 2014. Below [`PowerLaw::smooth_below`] a softer
/// curve continues it to zero load (see [`PowerSpring`]).
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct PowerLaw {
    /// K \[N/mⁿ\].
    pub stiffness: f64,
    /// n.
    pub exponent: f64,
    /// ΔQ \[N\].
    pub offset: f64,
    /// Load range of the fit \[N\]; loads outside give a warning.
    pub range: [f64; 2],
}

impl PowerLaw {
    /// Whether a ball load is outside the range of the fit.
    pub fn is_outside_range(&self, load: f64) -> bool {
        load > 0.0 && (load < self.range[0] || load > self.range[1])
    }

    /// Load Q_s \[N\] down to which the law is used unchanged; below the range [Q_min, Q_max] of the fit.
    ///
    /// A quarter of Q_min; more where the law jumps (ΔQ > 0: 2 ΔQ, or midway to Q_min) or ends (ΔQ < 0: −ΔQ)
    /// at comparable loads. Zhang's laws of Table 2 (600 to 2000 N): 150 and 155 N; the smallest load of a
    /// loaded ball in the paper's cases is 547 N.
    pub fn smooth_below(&self) -> f64 {
        let [least, _] = self.range;
        let jump = if self.offset < least { 0.5 * (self.offset + least) } else { f64::INFINITY };
        (0.25 * least).max(jump.min(2.0 * self.offset)).max(least.min(-self.offset))
    }
}

/// A power law with a C¹ continuation to zero load.
///
/// For Q ≥ Q_s: Q = K δⁿ + ΔQ. Below: Q = Q_s ((δ − δ₀)/L)^{3/2}, L and δ₀ such that load and slope meet at Q_s:
/// L = (3/2) Q_s/Q′(δ_s), δ₀ = δ_s − L. A law with ΔQ > 0 thus carries load slightly before dry contact, as
/// with a film; pure K δ^{3/2} is unchanged.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PowerSpring {
    pub law: PowerLaw,
    /// δ_s, Q_s.
    knee: [f64; 2],
    /// L \[m\].
    length: f64,
}

impl PowerSpring {
    pub fn new(law: PowerLaw) -> Self {
        let load = law.smooth_below();
        let approach = ((load - law.offset) / law.stiffness).powf(1.0 / law.exponent);
        let slope = law.exponent * law.stiffness * approach.powf(law.exponent - 1.0);
        let length = if load > 0.0 { 1.5 * load / slope } else { 0.0 };
        Self { law, knee: [approach, load], length }
    }

    /// δ₀ \[m\]: zero load up to this approach.
    pub fn onset(&self) -> f64 {
        self.knee[0] - self.length
    }

    /// Load, slope and energy at the total approach δ of the races \[m\].
    pub fn load(&self, approach: f64) -> ContactLoad {
        let [knee, knee_load] = self.knee;
        if approach <= self.onset() {
            return ContactLoad::default();
        }
        if approach < knee {
            let x = (approach - self.onset()) / self.length;
            let load = knee_load * x * x.sqrt();
            return ContactLoad {
                load,
                slope: 1.5 * knee_load * x.sqrt() / self.length,
                energy: 0.4 * load * x * self.length,
            };
        }
        let PowerLaw { stiffness, exponent: n, offset, .. } = self.law;
        let secant = stiffness * approach.powf(n - 1.0);
        let work = |force: f64, x: f64| (force / (n + 1.0) + offset) * x;
        let below = 0.4 * knee_load * self.length - work(knee_load - offset, knee);
        ContactLoad {
            load: secant * approach + offset,
            slope: n * secant,
            energy: work(secant * approach, approach) + below,
        }
    }
}

/// Least-squares fit of Q = K δⁿ + ΔQ in the loads Q \[N\] over approaches δ > 0 \[m\].
///
/// Gauss-Newton from n = 3/2 with step halving. `None` unless at least three points are given, all finite,
/// with distinct positive approaches.
pub fn fit_power_law(loads: &[f64], approaches: &[f64]) -> Option<PowerLaw> {
    let points = loads.len();
    let valid = approaches.iter().chain(loads).all(|v| v.is_finite()) && approaches.iter().all(|v| *v > 0.0);
    let reference = approaches.iter().copied().fold(0.0, f64::max);
    if points < 3 || approaches.len() != points || !valid {
        return None;
    }
    let x: Vec<f64> = approaches.iter().map(|d| d / reference).collect();
    let q = DVector::from_column_slice(loads);
    let power = |n: f64| DVector::from_iterator(points, x.iter().map(|v| v.powf(n)));
    let residual = |[k, n, c]: [f64; 3]| &q - power(n) * k - DVector::from_element(points, c);
    let solve = |columns: &[DVector<f64>], right: &DVector<f64>| {
        DMatrix::from_columns(columns).svd(true, true).solve(right, 1e-14).ok()
    };
    let one = DVector::from_element(points, 1.0);
    let start = solve(&[power(1.5), one.clone()], &q)?;
    let mut p = [start[0], 1.5, start[1]];
    let mut norm = residual(p).norm();
    for _ in 0..100 {
        let curve = power(p[1]);
        let by_exponent =
            DVector::from_iterator(points, x.iter().zip(&curve).map(|(x, c)| p[0] * c * x.ln()));
        let step = solve(&[curve, by_exponent, one.clone()], &residual(p))?;
        let mut length = 1.0;
        let (next, next_norm) = loop {
            let next = [p[0] + length * step[0], p[1] + length * step[1], p[2] + length * step[2]];
            let next_norm = residual(next).norm();
            if next_norm <= norm || length < 1e-6 {
                break (next, next_norm);
            }
            length *= 0.5;
        };
        if next_norm > norm {
            break;
        }
        let converged = (next[1] - p[1]).abs() < 1e-14;
        (p, norm) = (next, next_norm);
        if converged {
            break;
        }
    }
    let [k, n, offset] = p;
    let range =
        [loads.iter().copied().fold(f64::INFINITY, f64::min), loads.iter().copied().fold(0.0, f64::max)];
    let law = PowerLaw { stiffness: k * reference.powf(-n), exponent: n, offset, range };
    (law.stiffness.is_finite() && law.stiffness > 0.0 && n > 0.0).then_some(law)
}
