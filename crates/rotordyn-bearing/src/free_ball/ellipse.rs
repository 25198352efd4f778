//! Traction of a contact: local friction integrated over the contact ellipse.
//!
//! Axes of a contact: t along rolling, s across, n normal (t × s = n), from the contact's centre. The pressure is
//! p = p₀ √(1 − (x/b)² − (y/a)²), the deformed surface rises to z = y²/(2R) at the distance y from the centre. With the
//! slip v of ball against race at the centre and their relative rotation ω, the slip at a point is
//! v_x = v_t + ω_s z − ω_n y, v_y = v_s + ω_n x − ω_t z: sliding, spin and the slip of conforming surfaces (Heathcote)
//! together. Shear −p g v acts at (x, y, z) on the ball. The rise along rolling, x²/(2R), is (b/a)² times smaller and
//! left out.

use super::friction::SlipLaw;
use pulp::{Arch, NullaryFnOnce};

/// SIMD lane width.
const LANES: usize = 4;

type Lane = [f64; LANES];

/// Points and weights over the unit disc with the weight √(1 − r²), normalised to 1.
///
/// Gauss rules: y with the weight 1 − y², x/√(1 − y²) with √(1 − ξ²); exact for polynomials up to degree
/// 2 n − 1 in each.
#[derive(Clone, Debug)]
pub(super) struct EllipseRule {
    /// x/b, y/a, weight, p/p₀, padded by points without weight.
    points: Vec<[Lane; 4]>,
    arch: Arch,
}

/// Motion, size and load of a contact.
#[derive(Clone, Copy, Debug)]
pub(super) struct SlidingContact {
    /// Normal load Q \[N\] and maximum pressure p₀ \[Pa\].
    pub load: f64,
    pub pressure: f64,
    /// Semi-axes b along and a across rolling \[m\], and 1/(2R) of the deformed surface \[1/m\].
    pub semi_axes: [f64; 2],
    pub half_curvature: f64,
    /// Slip at the centre along t and s \[m/s\], rotation of the ball against the race about t, s and n \[rad/s\].
    pub slip: [f64; 2],
    pub rotation: [f64; 3],
}

/// Friction of a contact on the ball.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct TractionSum {
    /// Force along t and s \[N\].
    pub force: [f64; 2],
    /// Moment about the contact's centre along t, s and n \[N m\].
    pub moment: [f64; 3],
    /// Power lost \[W\].
    pub power: f64,
    /// Force over slip \[N s/m\], an upper bound of its slope.
    pub slope: f64,
}

impl EllipseRule {
    /// Rule with `along` points along rolling and `across` points across.
    pub fn new(along: usize, across: usize) -> Self {
        let mut points: Vec<[f64; 4]> = Vec::new();
        for [y, weight_y] in gauss_jacobi(across) {
            for k in 1..=along {
                // Chebyshev rule of the second kind.
                let (sin, cos) = (std::f64::consts::PI * k as f64 / (along + 1) as f64).sin_cos();
                let chord = (1.0 - y * y).sqrt();
                points.push([cos * chord, y, weight_y * sin * sin, sin * chord]);
            }
        }
        let sum: f64 = points.iter().map(|p| p[2]).sum();
        let lanes = points.chunks(LANES).map(|chunk| {
            // Padding lies at the centre; its pressure is positive, its weight zero.
            let mut lane = [[0.0; LANES], [0.0; LANES], [0.0; LANES], [1.0; LANES]];
            for (l, point) in chunk.iter().enumerate() {
                lane[0][l] = point[0];
                lane[1][l] = point[1];
                lane[2][l] = point[2] / sum;
                lane[3][l] = point[3];
            }
            lane
        });
        Self { points: lanes.collect(), arch: Arch::new() }
    }

    /// Friction over the ellipse.
    #[inline]
    pub fn traction<L: SlipLaw>(&self, law: &L, contact: &SlidingContact) -> TractionSum {
        self.arch.dispatch(EllipseSum { points: &self.points, law, contact })
    }
}

/// Friction with the slip at the centre: a force without moment.
#[inline(always)]
pub(super) fn traction_at_centre<L: SlipLaw>(law: &L, contact: &SlidingContact) -> TractionSum {
    let [along, across] = contact.slip;
    let slip_squared = along * along + across * across;
    let slope = contact.load * law.over_slip(slip_squared, contact.pressure * (2.0 / 3.0));
    TractionSum {
        force: [-slope * along, -slope * across],
        moment: [0.0; 3],
        power: slope * slip_squared,
        slope,
    }
}

struct EllipseSum<'a, L> {
    points: &'a [[Lane; 4]],
    law: &'a L,
    contact: &'a SlidingContact,
}

impl<L: SlipLaw> NullaryFnOnce for EllipseSum<'_, L> {
    type Output = TractionSum;

    #[inline(always)]
    fn call(self) -> TractionSum {
        let SlidingContact { load, pressure, semi_axes, half_curvature, slip, rotation } = *self.contact;
        let [b, a] = semi_axes;
        let mut sums = [[0.0; LANES]; 7];
        for [xs, ys, weights, pressures] in self.points {
            for l in 0..LANES {
                let (x, y) = (b * xs[l], a * ys[l]);
                let z = half_curvature * y * y;
                let along = slip[0] + rotation[1] * z - rotation[2] * y;
                let across = slip[1] + rotation[2] * x - rotation[0] * z;
                let slip_squared = along * along + across * across;
                let slope = weights[l] * self.law.over_slip(slip_squared, pressure * pressures[l]);
                let (ft, fs) = (slope * along, slope * across);
                sums[0][l] += ft;
                sums[1][l] += fs;
                sums[2][l] += z * fs;
                sums[3][l] += z * ft;
                sums[4][l] += x * fs - y * ft;
                sums[5][l] += slope * slip_squared;
                sums[6][l] += slope;
            }
        }
        let [ft, fs, mt, ms, mn, power, slope] = sums.map(|lane| load * lane.iter().sum::<f64>());
        TractionSum { force: [-ft, -fs], moment: [mt, -ms, -mn], power, slope }
    }
}

/// Points and weights of the Gauss rule with the weight 1 − y² on \[−1, 1\]: zeros of P′_{n+1}, weights
/// 2 (1 − y²)/((n + 1)(n + 2) P_{n+1}²), those of the Lobatto rule times 1 − y².
fn gauss_jacobi(n: usize) -> Vec<[f64; 2]> {
    let degree = (n + 1) as f64;
    // Legendre polynomials of degree n + 1 and n.
    let legendre = |y: f64| {
        let (mut before, mut value) = (1.0, y);
        for k in 1..=n {
            let k = k as f64;
            (before, value) = (value, ((2.0 * k + 1.0) * y * value - k * before) / (k + 1.0));
        }
        [value, before]
    };
    let point = |k: usize| {
        // Interior Lobatto points lie near cos(k π/(n + 1)).
        let mut y = (std::f64::consts::PI * k as f64 / degree).cos();
        for _ in 0..100 {
            let [value, before] = legendre(y);
            // Newton on (1 − y²) P′ = (n + 1)(P_n − y P_{n+1}), whose derivative is −(n + 1)(n + 2) P_{n+1}.
            let step = (before - y * value) / ((degree + 1.0) * value);
            y += step;
            if step.abs() < 1e-16 {
                break;
            }
        }
        let [value, _] = legendre(y);
        [y, 2.0 * (1.0 - y * y) / (degree * (degree + 1.0) * value * value)]
    };
    (1..=n).map(point).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Mean of x^2m y^2n under the pressure: Γ(m + ½) Γ(n + ½) Γ(5/2)/(π Γ(m + n + 5/2)).
    #[test]
    fn rule_integrates_polynomials_exactly() {
        let rule = EllipseRule::new(4, 6);
        let mean = |m: i32, n: i32| -> f64 {
            let point =
                |lane: &[Lane; 4], l: usize| lane[2][l] * lane[0][l].powi(2 * m) * lane[1][l].powi(2 * n);
            rule.points.iter().map(|lane| (0..LANES).map(|l| point(lane, l)).sum::<f64>()).sum()
        };
        // (2m − 1)!! (2n − 1)!! 3/((2m + 2n + 3)!!).
        let double = |k: i32| (1..=k).rev().step_by(2).map(f64::from).product::<f64>();
        for (m, n) in [(0, 0), (1, 0), (0, 1), (1, 1), (2, 1), (3, 0), (0, 3), (3, 2)] {
            let expected = 3.0 * double(2 * m - 1) * double(2 * n - 1) / double(2 * m + 2 * n + 3);
            assert!((mean(m, n) / expected - 1.0).abs() < 1e-13, "{m} {n}: {} {expected}", mean(m, n));
        }
    }

    #[test]
    fn pressure_of_each_point_is_that_of_the_semi_ellipsoid() {
        for lane in &EllipseRule::new(3, 5).points {
            for l in (0..LANES).filter(|&l| lane[2][l] > 0.0) {
                let expected = (1.0 - lane[0][l].powi(2) - lane[1][l].powi(2)).sqrt();
                assert!((lane[3][l] - expected).abs() < 1e-14);
            }
        }
    }
}
