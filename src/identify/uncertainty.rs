//! Standard errors of poles.
//!
//! Σ δ δᵀ, δ being the change of the poles when the FRFs to one reference at one line are left out:
//! δ = (JᵀJ − G)⁻¹ g, with g and G the group's share of the gradient and of JᵀJ (jackknife by groups). Noise that changes
//! over frequency, and noise that the responses to one hit share (that of the force), is thereby counted as it is. The
//! share G matters: a lightly damped mode rests on few lines, bends to the noise of each, and what the fit leaves there
//! is far less than the noise was.
//!
//! Where few groups decide, their sum is itself uncertain. It is then drawn towards what two sizes of noise, found over
//! all lines, would give: that of the responses, and that of the force, in proportion to the FRF and common to all.
//!
//! Source: Liang & Zeger, Biometrika 73 (1986); Bell & McCaffrey, Survey Methodology 28 (2002).

use std::f64::consts::TAU;

use nalgebra::{Cholesky, DMatrix};
use rayon::prelude::*;

use super::data::Data;
use super::refine::{Point, Step};
use crate::linalg::Complex64;

/// Variances of Re λ and Im λ, and their covariance.
pub(super) type PoleCovariance = [f64; 3];

/// Rows of (JᵀJ)⁻¹ that belong to poles; `None` where poles cannot be told apart.
fn pole_rows(step: &Step) -> Option<(Vec<usize>, DMatrix<f64>)> {
    let mut square = step.square.clone();
    let n = square.nrows();
    // Repeated poles leave the turn of their participations free.
    (0..n).for_each(|k| square[(k, k)] *= 1.0 + 1e-12);
    let inverse = Cholesky::new(square)?.inverse();
    let own: Vec<usize> = (0..step.list.len())
        .filter(|&k| step.list[k].input.is_none())
        .flat_map(|k| [2 * k, 2 * k + 1])
        .collect();
    let rows = DMatrix::from_fn(own.len(), n, |i, j| inverse[(own[i], j)]);
    Some((own, rows))
}

/// Covariances as if all that is left were noise of one size: quick, to judge by.
pub(super) fn rough(at: &Point, step: &Step) -> Vec<PoleCovariance> {
    let Some((own, rows)) = pole_rows(step) else { return unknown(at) };
    let noise = at.noise();
    (0..at.poles.len())
        .map(|m| {
            let (a, b) = (2 * m, 2 * m + 1);
            [noise * rows[(a, own[a])], noise * rows[(b, own[b])], noise * rows[(a, own[b])]]
        })
        .collect()
}

fn unknown(at: &Point) -> Vec<PoleCovariance> {
    vec![[f64::INFINITY, f64::INFINITY, 0.0]; at.poles.len()]
}

/// Covariances by leaving groups out.
pub(super) fn covariance(data: &Data, at: &Point, step: &Step) -> Vec<PoleCovariance> {
    let Some((_, lambda)) = pole_rows(step) else { return unknown(at) };
    let groups = Groups::new(at, step, &lambda);
    let (lines, inputs, outputs) = (data.lines(), data.inputs(), data.outputs());
    let all: Vec<usize> = (0..outputs).collect();
    // Hits are to references: outputs where they are those (then inputs answer together), else inputs.
    let sizes = NoiseSizes::new(data, at);
    let of_line = |k: usize| {
        let mut sums = vec![Sums::default(); at.poles.len()];
        let rows = |i: usize| [2 * i * lines + k, (2 * i + 1) * lines + k];
        if data.swapped {
            let rows: Vec<usize> = (0..inputs).flat_map(rows).collect();
            all.iter().for_each(|o| groups.add(data, &rows, &[*o], &mut sums));
        } else {
            (0..inputs).for_each(|i| groups.add(data, &rows(i), &all, &mut sums));
        }
        sums
    };
    let by_line: Vec<Vec<Sums>> = (0..lines).into_par_iter().map(of_line).collect();
    let mut total = vec![Sums::default(); at.poles.len()];
    for line in &by_line {
        total.iter_mut().zip(line).for_each(|(sum, own)| sum.add(own));
    }
    let white = rough(at, step);
    let share = sizes.response / at.noise().max(f64::MIN_POSITIVE);
    total.iter().zip(white).map(|(sum, white)| sum.covariance(white, share, sizes.force)).collect()
}

/// Groups that the two sizes of noise count for.
const PRIOR: f64 = 10.0;

/// Sums over groups for one pole.
#[derive(Clone, Copy, Debug, Default)]
struct Sums {
    /// Of δ δᵀ as measured, and of its square.
    found: PoleCovariance,
    square: f64,
    /// Of δ δᵀ for force noise of mean square 1.
    force: PoleCovariance,
}

impl Sums {
    fn add(&mut self, other: &Sums) {
        for p in 0..3 {
            self.found[p] += other.found[p];
            self.force[p] += other.force[p];
        }
        self.square += other.square;
    }

    fn covariance(&self, white: PoleCovariance, response: f64, force: f64) -> PoleCovariance {
        let size = self.found[0] + self.found[1];
        let groups = if self.square > 0.0 { size * size / self.square } else { 0.0 };
        let part = groups / (groups + PRIOR);
        let model = |p: usize| response * white[p] + force * self.force[p];
        [0, 1, 2].map(|p| part * self.found[p] + (1.0 - part) * model(p))
    }
}

/// Mean squares of the noise: of a datum of the responses, and of the force over the force.
struct NoiseSizes {
    response: f64,
    force: f64,
}

impl NoiseSizes {
    /// |e|² = 2a + b|H|² over all data but those that the fit follows, weighted by what they scatter.
    fn new(data: &Data, at: &Point) -> Self {
        let lines = data.lines();
        let (mut a, mut b) = (at.noise(), 0.0);
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
                        let e =
                            at.rest[(rows[0], o)].powi(2) / left[0] + at.rest[(rows[1], o)].powi(2) / left[1];
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

/// What groups of rows have to do with the poles.
struct Groups<'a> {
    at: &'a Point,
    step: &'a Step,
    /// Rows of (JᵀJ)⁻¹ of the poles.
    lambda: &'a DMatrix<f64>,
    /// Diagonal block of (JᵀJ)⁻¹ of each mode, its first parameter and their number.
    blocks: Vec<(DMatrix<f64>, usize, usize)>,
    /// 1 over what the linear unknowns leave of a row's noise.
    enlarge: Vec<f64>,
}

/// Share of a mode's knowledge below which leaving a group out changes nothing else.
const NO_SHARE: f64 = 0.01;

impl<'a> Groups<'a> {
    fn new(at: &'a Point, step: &'a Step, lambda: &'a DMatrix<f64>) -> Self {
        let enlarge = at.q.row_iter().map(|row| 1.0 / (1.0 - row.norm_squared()).max(0.05)).collect();
        let block = |m: usize| {
            let first = step.list.iter().position(|c| c.mode == m).unwrap_or(0);
            let count = step.list.iter().filter(|c| c.mode == m).count();
            let own = step.inverse_block(2 * first, 2 * count);
            (own, first, count)
        };
        Self { at, step, lambda, blocks: (0..at.poles.len()).map(block).collect(), enlarge }
    }

    /// Adds δ δᵀ of a group of rows of some outputs.
    fn add(&self, data: &Data, rows: &[usize], outputs: &[usize], sums: &mut [Sums]) {
        let lines = data.lines();
        let mut left = self.gradient(rows, outputs, &|row, o| self.at.rest[(row, o)] * self.enlarge[row]);
        for m in 0..self.at.poles.len() {
            self.without(m, rows, outputs, &mut left);
        }
        // Noise n of the force changes an FRF by −H n: once for its real, once for its imaginary part.
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
            gradient.iter().enumerate().map(|(k, g)| self.lambda[(row, k)] * g).sum::<f64>()
        };
        for (m, sum) in sums.iter_mut().enumerate() {
            let pair = |gradient: &[f64]| {
                let (re, im) = (change(2 * m, gradient), change(2 * m + 1, gradient));
                [re * re, im * im, re * im]
            };
            let own = pair(&left);
            sum.found.iter_mut().zip(own).for_each(|(sum, own)| *sum += own);
            sum.square += (own[0] + own[1]).powi(2);
            for gradient in &force {
                sum.force.iter_mut().zip(pair(gradient)).for_each(|(sum, own)| *sum += 0.5 * own);
            }
        }
    }

    /// Jᵀ e over a group.
    fn gradient(&self, rows: &[usize], outputs: &[usize], error: &dyn Fn(usize, usize) -> f64) -> Vec<f64> {
        let mut gradient = vec![0.0; 2 * self.step.list.len()];
        for (m, (_, first, count)) in self.blocks.iter().enumerate() {
            for &row in rows {
                let sum: Complex64 =
                    outputs.iter().map(|&o| self.at.shape(m, o).conj() * error(row, o)).sum();
                for a in *first..first + count {
                    let d = Complex64::new(self.step.free[(row, 2 * a)], self.step.free[(row, 2 * a + 1)]);
                    let g = d * sum;
                    gradient[2 * a] += g.re;
                    gradient[2 * a + 1] += g.im;
                }
            }
        }
        gradient
    }

    /// (I − G B)⁻¹ on a mode's part of the gradient, B being its block of (JᵀJ)⁻¹: as if the group were not there.
    fn without(&self, m: usize, rows: &[usize], outputs: &[usize], gradient: &mut [f64]) {
        let (inverse, first, count) = &self.blocks[m];
        let (mut rr, mut ri, mut ii) = (0.0, 0.0, 0.0);
        for &o in outputs {
            let psi = self.at.shape(m, o);
            rr += psi.re * psi.re;
            ri += psi.re * psi.im;
            ii += psi.im * psi.im;
        }
        let size = 2 * count;
        // The pole's own share tells whether the rest is worth it.
        let reach = |a: usize| {
            let own = rows.iter().map(|&row| {
                let free = |k: usize| self.step.free[(row, 2 * (first + a) + k)];
                self.enlarge[row] * (free(0).powi(2) + free(1).powi(2))
            });
            own.sum::<f64>() * (rr + ii) * inverse[(2 * a, 2 * a)].max(inverse[(2 * a + 1, 2 * a + 1)])
        };
        if (0..*count).map(reach).sum::<f64>() < NO_SHARE {
            return;
        }
        let mut share = DMatrix::zeros(size, size);
        for a in 0..*count {
            for b in 0..*count {
                for &row in rows {
                    let d = |c: usize, k: usize| self.step.free[(row, 2 * (first + c) + k)];
                    let g = |i: usize, j: usize| self.enlarge[row] * d(a, i) * d(b, j);
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
pub(super) fn errors(pole: Complex64, [re, im, both]: PoleCovariance) -> (f64, f64) {
    // ζ = −a/|λ|, λ = a + jb: ∂ζ/∂a = −b²/|λ|³, ∂ζ/∂b = ab/|λ|³.
    let cube = pole.norm().powi(3);
    let (da, db) = (-pole.im * pole.im / cube, pole.re * pole.im / cube);
    (im.sqrt() / TAU, (da * da * re + db * db * im + 2.0 * da * db * both).max(0.0).sqrt())
}
