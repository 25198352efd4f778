//! Standard errors (covariance) of poles by a grouped jackknife.
//!
//! Covariance Σ δ δᵀ, δ being the change of the poles when the FRFs to one reference at one line are left
//! out: δ = (JᵀJ − G)⁻¹ g, with g and G the group's share of the gradient and of JᵀJ (jackknife by groups,
//! cluster-robust). This includes frequency-dependent noise and noise common to all responses of one hit
//! (that of the force). The leverage G matters: a lightly damped mode depends on few lines and fits the noise
//! of each, so that residuals there are much smaller than the noise.
//!
//! If few groups dominate, their sum is itself uncertain. It is then shrunk towards the covariance of a noise
//! model with two variances estimated over all lines: that of the responses, and that of the force,
//! proportional to the FRF and common to all.
//!
//! Source: Liang & Zeger, Biometrika 73 (1986); Bell & McCaffrey, Survey Methodology 28 (2002).

use std::f64::consts::TAU;

use nalgebra::{Cholesky, DMatrix};
use rayon::prelude::*;

use super::data::Data;
use super::plscf::Pole;
use super::refine::{FitPoint, GaussNewtonStep};
use rotordyn_linalg::Complex64;

/// Variances of Re λ and Im λ, and their covariance.
pub(super) type PoleCovariance = [f64; 3];

/// First parameter of each mode's pole, and rows of (JᵀJ)⁻¹ that belong to poles, two for each mode; `None` if JᵀJ is
/// singular (poles not distinguishable). A held pole has no parameter and rows of zeros.
fn pole_rows(at: &FitPoint, step: &GaussNewtonStep) -> Option<(Vec<Option<usize>>, DMatrix<f64>)> {
    let own: Vec<Option<usize>> = (0..at.poles.len())
        .map(|m| step.parameters.iter().position(|p| p.mode == m && p.input.is_none()).map(|k| 2 * k))
        .collect();
    if step.parameters.is_empty() {
        return Some((own, DMatrix::zeros(2 * at.poles.len(), 0)));
    }
    let mut square = step.normal_matrix.clone();
    let n = square.nrows();
    // Regularised: repeated poles leave the rotation of their participations undetermined.
    (0..n).for_each(|k| square[(k, k)] *= 1.0 + 1e-12);
    let inverse = Cholesky::new(square)?.inverse();
    let rows = DMatrix::from_fn(2 * own.len(), n, |i, j| own[i / 2].map_or(0.0, |k| inverse[(k + i % 2, j)]));
    Some((own, rows))
}

/// Covariances assuming white residuals of one variance: fast, for the selection.
pub(super) fn white_noise_covariance(at: &FitPoint, step: &GaussNewtonStep) -> Vec<PoleCovariance> {
    let Some((own, rows)) = pole_rows(at, step) else { return infinite_covariance(at) };
    let noise = at.residual_variance();
    (0..at.poles.len())
        .map(|m| {
            let (a, b) = (2 * m, 2 * m + 1);
            match own[m] {
                Some(k) => [noise * rows[(a, k)], noise * rows[(b, k + 1)], noise * rows[(a, k + 1)]],
                None => held_covariance(&at.poles[m]),
            }
        })
        .collect()
}

/// Covariance of a held pole: its scatter over the orders of the stabilisation diagram.
fn held_covariance(pole: &Pole) -> PoleCovariance {
    pole.stable.map_or([f64::INFINITY, f64::INFINITY, 0.0], |stable| {
        let [re, im] = stable.spread;
        [re * re, im * im, 0.0]
    })
}

fn infinite_covariance(at: &FitPoint) -> Vec<PoleCovariance> {
    vec![[f64::INFINITY, f64::INFINITY, 0.0]; at.poles.len()]
}

/// Covariances by the grouped jackknife (leave one group out).
pub(super) fn covariance(data: &Data, at: &FitPoint, step: &GaussNewtonStep) -> Vec<PoleCovariance> {
    let Some((_, lambda)) = pole_rows(at, step) else { return infinite_covariance(at) };
    let groups = JackknifeGroups::new(at, step, &lambda);
    let (lines, inputs, outputs) = (data.lines(), data.inputs(), data.outputs());
    let all: Vec<usize> = (0..outputs).collect();
    // Hits are at references: if these are the outputs, group the inputs of an output, else vice versa.
    let sizes = NoiseVariances::new(data, at);
    let of_line = |k: usize| {
        let mut sums = vec![JackknifeSums::default(); at.poles.len()];
        let rows = |i: usize| [2 * i * lines + k, (2 * i + 1) * lines + k];
        if data.swapped {
            let rows: Vec<usize> = (0..inputs).flat_map(rows).collect();
            all.iter().for_each(|o| groups.add(data, &rows, &[*o], &mut sums));
        } else {
            (0..inputs).for_each(|i| groups.add(data, &rows(i), &all, &mut sums));
        }
        sums
    };
    let by_line: Vec<Vec<JackknifeSums>> = (0..lines).into_par_iter().map(of_line).collect();
    let mut total = vec![JackknifeSums::default(); at.poles.len()];
    for line in &by_line {
        total.iter_mut().zip(line).for_each(|(sum, own)| sum.add(own));
    }
    let white = white_noise_covariance(at, step);
    let share = sizes.response / at.residual_variance().max(f64::MIN_POSITIVE);
    let of_mode = |m: usize| match at.poles[m].held {
        true => held_covariance(&at.poles[m]),
        false => total[m].covariance(white[m], share, sizes.force),
    };
    (0..at.poles.len()).map(of_mode).collect()
}

/// Weight of the noise model, as an equivalent number of groups.
const PRIOR_GROUPS: f64 = 10.0;

/// Sums over groups for one pole.
#[derive(Clone, Copy, Debug, Default)]
struct JackknifeSums {
    /// Of δ δᵀ from the residuals, and of its squared trace.
    jackknife: PoleCovariance,
    square: f64,
    /// Of δ δᵀ for force noise of mean square 1.
    force: PoleCovariance,
}

impl JackknifeSums {
    fn add(&mut self, other: &JackknifeSums) {
        for p in 0..3 {
            self.jackknife[p] += other.jackknife[p];
            self.force[p] += other.force[p];
        }
        self.square += other.square;
    }

    fn covariance(&self, white: PoleCovariance, response: f64, force: f64) -> PoleCovariance {
        let size = self.jackknife[0] + self.jackknife[1];
        let groups = if self.square > 0.0 { size * size / self.square } else { 0.0 };
        let part = groups / (groups + PRIOR_GROUPS);
        let model = |p: usize| response * white[p] + force * self.force[p];
        [0, 1, 2].map(|p| part * self.jackknife[p] + (1.0 - part) * model(p))
    }
}

/// Noise variances: of a response datum, and of the force relative to the force.
struct NoiseVariances {
    response: f64,
    force: f64,
}

impl NoiseVariances {
    /// Weighted regression of |e|² = 2a + b|H|² over all data except those of high leverage.
    fn new(data: &Data, at: &FitPoint) -> Self {
        let lines = data.lines();
        let (mut a, mut b) = (at.residual_variance(), 0.0);
        for _ in 0..4 {
            let mut sums = [0.0; 5];
            for i in 0..data.inputs() {
                for k in 0..lines {
                    let rows = [2 * i * lines + k, (2 * i + 1) * lines + k];
                    let left = rows.map(|row| 1.0 - at.q.row(row).norm_squared());
                    if left[0].min(left[1]) < 0.5 {
                        continue;
                    }
                    for (o, row) in data.values.iter().enumerate() {
                        let h = row[i][k].norm_sqr();
                        let e = at.residual[(rows[0], o)].powi(2) / left[0]
                            + at.residual[(rows[1], o)].powi(2) / left[1];
                        let weight = (2.0 * a + b * h).max(f64::MIN_POSITIVE).powi(-2);
                        sums[0] += weight;
                        sums[1] += weight * h;
                        sums[2] += weight * h * h;
                        sums[3] += weight * e;
                        sums[4] += weight * h * e;
                    }
                }
            }
            let [w, h, hh, e, he] = sums;
            let determinant = w * hh - h * h;
            if !(determinant > 0.0 && determinant.is_finite()) {
                break;
            }
            let (both, slope) = ((hh * e - h * he) / determinant, (w * he - h * e) / determinant);
            (a, b) = match (both > 0.0, slope > 0.0) {
                (true, true) => (0.5 * both, slope),
                (true, false) => (0.5 * e / w, 0.0),
                (false, _) => (0.0, he / hh),
            };
        }
        Self { response: a, force: b }
    }
}

/// Influence of groups of rows on the poles.
struct JackknifeGroups<'a> {
    at: &'a FitPoint,
    step: &'a GaussNewtonStep,
    /// Rows of (JᵀJ)⁻¹ of the poles.
    pole_rows: &'a DMatrix<f64>,
    /// Diagonal block of (JᵀJ)⁻¹ of each mode, its first parameter and their number.
    blocks: Vec<(DMatrix<f64>, usize, usize)>,
    /// Leverage correction: 1 over the fraction of a row's noise that is not absorbed by the linear unknowns.
    leverage_correction: Vec<f64>,
}

/// Leverage of a group on a mode below which the correction for leaving it out is skipped.
const MIN_LEVERAGE: f64 = 0.01;

impl<'a> JackknifeGroups<'a> {
    fn new(at: &'a FitPoint, step: &'a GaussNewtonStep, lambda: &'a DMatrix<f64>) -> Self {
        let enlarge = at.q.row_iter().map(|row| 1.0 / (1.0 - row.norm_squared()).max(0.05)).collect();
        let block = |m: usize| {
            let first = step.parameters.iter().position(|c| c.mode == m).unwrap_or(0);
            let count = step.parameters.iter().filter(|c| c.mode == m).count();
            let own = step.inverse_block(2 * first, 2 * count);
            (own, first, count)
        };
        Self {
            at,
            step,
            pole_rows: lambda,
            blocks: (0..at.poles.len()).map(block).collect(),
            leverage_correction: enlarge,
        }
    }

    /// Adds δ δᵀ of a group of rows of some outputs.
    fn add(&self, data: &Data, rows: &[usize], outputs: &[usize], sums: &mut [JackknifeSums]) {
        let lines = data.lines();
        let mut left = self
            .gradient(rows, outputs, &|row, o| self.at.residual[(row, o)] * self.leverage_correction[row]);
        for m in 0..self.at.poles.len() {
            self.leave_out(m, rows, outputs, &mut left);
        }
        // Force noise n changes an FRF by −H n: once for the real, once for the imaginary part of n.
        let force = [0, 1].map(|part| {
            self.gradient(rows, outputs, &|row, o| {
                let (block, k) = (row / lines, row % lines);
                let h = data.values[o][block / 2][k];
                match (block % 2, part) {
                    (0, 0) => h.re,
                    (0, _) => -h.im,
                    (_, 0) => h.im,
                    (_, _) => h.re,
                }
            })
        });
        let change = |row: usize, gradient: &[f64]| {
            gradient.iter().enumerate().map(|(k, g)| self.pole_rows[(row, k)] * g).sum::<f64>()
        };
        for (m, sum) in sums.iter_mut().enumerate() {
            let pair = |gradient: &[f64]| {
                let (re, im) = (change(2 * m, gradient), change(2 * m + 1, gradient));
                [re * re, im * im, re * im]
            };
            let own = pair(&left);
            sum.jackknife.iter_mut().zip(own).for_each(|(sum, own)| *sum += own);
            sum.square += (own[0] + own[1]).powi(2);
            for gradient in &force {
                sum.force.iter_mut().zip(pair(gradient)).for_each(|(sum, own)| *sum += 0.5 * own);
            }
        }
    }

    /// Jᵀ e over a group.
    fn gradient(&self, rows: &[usize], outputs: &[usize], error: &dyn Fn(usize, usize) -> f64) -> Vec<f64> {
        let mut gradient = vec![0.0; 2 * self.step.parameters.len()];
        for (m, (_, first, count)) in self.blocks.iter().enumerate() {
            for &row in rows {
                let sum: Complex64 =
                    outputs.iter().map(|&o| self.at.shape(m, o).conj() * error(row, o)).sum();
                for a in *first..first + count {
                    let d = Complex64::new(
                        self.step.projected_jacobian[(row, 2 * a)],
                        self.step.projected_jacobian[(row, 2 * a + 1)],
                    );
                    let g = d * sum;
                    gradient[2 * a] += g.re;
                    gradient[2 * a + 1] += g.im;
                }
            }
        }
        gradient
    }

    /// Leave-one-out correction (I − G B)⁻¹ of a mode's part of the gradient, B being its block of (JᵀJ)⁻¹.
    fn leave_out(&self, m: usize, rows: &[usize], outputs: &[usize], gradient: &mut [f64]) {
        let (inverse, first, count) = &self.blocks[m];
        let (mut rr, mut ri, mut ii) = (0.0, 0.0, 0.0);
        for &o in outputs {
            let psi = self.at.shape(m, o);
            rr += psi.re * psi.re;
            ri += psi.re * psi.im;
            ii += psi.im * psi.im;
        }
        let size = 2 * count;
        // Skip the correction if the leverage on the pole is negligible.
        let reach = |a: usize| {
            let own = rows.iter().map(|&row| {
                let free = |k: usize| self.step.projected_jacobian[(row, 2 * (first + a) + k)];
                self.leverage_correction[row] * (free(0).powi(2) + free(1).powi(2))
            });
            own.sum::<f64>() * (rr + ii) * inverse[(2 * a, 2 * a)].max(inverse[(2 * a + 1, 2 * a + 1)])
        };
        if (0..*count).map(reach).sum::<f64>() < MIN_LEVERAGE {
            return;
        }
        let mut share = DMatrix::zeros(size, size);
        for a in 0..*count {
            for b in 0..*count {
                for &row in rows {
                    let d = |c: usize, k: usize| self.step.projected_jacobian[(row, 2 * (first + c) + k)];
                    let g = |i: usize, j: usize| self.leverage_correction[row] * d(a, i) * d(b, j);
                    share[(2 * a, 2 * b)] += rr * g(0, 0) + ri * (g(0, 1) + g(1, 0)) + ii * g(1, 1);
                    share[(2 * a, 2 * b + 1)] += rr * g(0, 1) + ri * (g(1, 1) - g(0, 0)) - ii * g(1, 0);
                    share[(2 * a + 1, 2 * b)] += rr * g(1, 0) + ri * (g(1, 1) - g(0, 0)) - ii * g(0, 1);
                    share[(2 * a + 1, 2 * b + 1)] += rr * g(1, 1) - ri * (g(1, 0) + g(0, 1)) + ii * g(0, 0);
                }
            }
        }
        let left = DMatrix::identity(size, size) - share * inverse;
        let own = DMatrix::from_fn(size, 1, |k, _| gradient[2 * first + k]);
        if let Some(solved) = left.lu().solve(&own) {
            gradient[2 * first..2 * first + size].copy_from_slice(solved.as_slice());
        }
    }
}

/// Standard errors of damped frequency \[Hz\] and damping ratio from the pole's covariance.
pub(super) fn standard_errors(pole: Complex64, [re, im, both]: PoleCovariance) -> (f64, f64) {
    // ζ = −a/|λ|, λ = a + jb: ∂ζ/∂a = −b²/|λ|³, ∂ζ/∂b = ab/|λ|³.
    let cube = pole.norm().powi(3);
    let (da, db) = (-pole.im * pole.im / cube, pole.re * pole.im / cube);
    (im.sqrt() / TAU, (da * da * re + db * db * im + 2.0 * da * db * both).max(0.0).sqrt())
}
