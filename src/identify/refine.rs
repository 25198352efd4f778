//! Poles and participations by nonlinear least squares, with their standard errors.
//!
//! Shapes and residual terms are linear and follow from poles and participations (variable projection, Golub & Pereyra
//! 1973, in Kaufman's form); the same matrix serves all outputs, so an iteration costs about as much as one LSFD.
//!
//! Covariance: (JᵀJ)⁻¹ (Σ g gᵀ) (JᵀJ)⁻¹, g being the score of the FRFs to one reference at one line. Noise that changes
//! over frequency, and noise that the responses to one blow share (that of the force), is thereby counted as it is.

use nalgebra::{Cholesky, DMatrix, DVector};
use rayon::prelude::*;

use super::data::Data;
use super::lsfd::{Basis, Change, Fit, back, fixed_input, thin_qr};
use super::plscf::Pole;
use crate::linalg::Complex64;

/// Poles at the minimum, and what goes with them.
pub(super) struct Refined {
    pub poles: Vec<Pole>,
    pub fit: Fit,
    /// Variances of Re λ, Im λ and their covariance.
    pub covariance: Vec<[f64; 3]>,
    /// Share of the FRFs' square sum that each mode explains alone, over that which nothing explains.
    pub significance: Vec<f64>,
}

/// One point of the iteration.
struct Point {
    poles: Vec<Pole>,
    q: DMatrix<f64>,
    r: DMatrix<f64>,
    sizes: Vec<f64>,
    x: DMatrix<f64>,
    /// What the fit leaves.
    rest: DMatrix<f64>,
    cost: f64,
}

impl Point {
    fn new(basis: &Basis, y: &DMatrix<f64>, poles: Vec<Pole>) -> Self {
        let (q, r, sizes) = thin_qr(basis.design(&poles));
        let z = q.transpose() * y;
        let rest = y - &q * &z;
        let x = back(&r, &sizes, z);
        let cost = rest.norm_squared();
        Self { poles, q, r, sizes, x, rest, cost }
    }

    fn shape(&self, mode: usize, output: usize) -> Complex64 {
        Complex64::new(self.x[(2 * mode, output)], self.x[(2 * mode + 1, output)])
    }
}

/// Normal equations in the poles and participations.
struct Step {
    list: Vec<Change>,
    /// Changes of the FRFs that the linear unknowns do not follow.
    free: DMatrix<f64>,
    square: DMatrix<f64>,
    gradient: DVector<f64>,
}

impl Step {
    fn new(basis: &Basis, at: &Point) -> Self {
        let (d, list) = basis.changes(&at.poles);
        let free = &d - &at.q * (at.q.transpose() * &d);
        let transposed = free.transpose();
        let gram = &transposed * &free;
        let slope = &transposed * &at.rest;
        let (n, outputs) = (list.len(), at.x.ncols());
        let mut square = DMatrix::zeros(2 * n, 2 * n);
        let mut gradient = DVector::zeros(2 * n);
        let psi: Vec<Vec<Complex64>> =
            list.iter().map(|c| (0..outputs).map(|o| at.shape(c.mode, o)).collect()).collect();
        for a in 0..n {
            // With c = ψ δ the real pair of c is [ψ', −ψ''; ψ'', ψ'] that of δ.
            let conj_slope: Complex64 = (0..outputs)
                .map(|o| psi[a][o].conj() * Complex64::new(slope[(2 * a, o)], slope[(2 * a + 1, o)]))
                .sum();
            (gradient[2 * a], gradient[2 * a + 1]) = (conj_slope.re, conj_slope.im);
            for b in 0..n {
                let (mut rr, mut ri, mut ir, mut ii) = (0.0, 0.0, 0.0, 0.0);
                for (p, q) in psi[a].iter().zip(&psi[b]) {
                    rr += p.re * q.re;
                    ri += p.re * q.im;
                    ir += p.im * q.re;
                    ii += p.im * q.im;
                }
                let g = |i: usize, j: usize| gram[(2 * a + i, 2 * b + j)];
                // Cᵀ(p) G C(q), C(p) = p' I + p'' [0, −1; 1, 0].
                square[(2 * a, 2 * b)] = rr * g(0, 0) + ri * g(0, 1) + ir * g(1, 0) + ii * g(1, 1);
                square[(2 * a, 2 * b + 1)] = rr * g(0, 1) - ri * g(0, 0) + ir * g(1, 1) - ii * g(1, 0);
                square[(2 * a + 1, 2 * b)] = rr * g(1, 0) + ri * g(1, 1) - ir * g(0, 0) - ii * g(0, 1);
                square[(2 * a + 1, 2 * b + 1)] = rr * g(1, 1) - ri * g(1, 0) - ir * g(0, 1) + ii * g(0, 0);
            }
        }
        Self { list, free, square, gradient }
    }

    /// Poles after a damped step; `None` where the equations cannot be solved.
    fn taken(&self, poles: &[Pole], damping: f64) -> Option<(Vec<Pole>, f64)> {
        let mut square = self.square.clone();
        for k in 0..square.nrows() {
            square[(k, k)] *= 1.0 + damping;
        }
        let step = Cholesky::new(square)?.solve(&self.gradient);
        let mut out = poles.to_vec();
        let mut largest: f64 = 0.0;
        for (k, change) in self.list.iter().enumerate() {
            let by = Complex64::new(step[2 * k], step[2 * k + 1]);
            let pole = &mut out[change.mode];
            match change.input {
                None => {
                    largest = largest.max(by.norm() / poles[change.mode].value.norm());
                    pole.value += by;
                }
                Some(i) => pole.participation[i] += by,
            }
        }
        Some((out, largest))
    }
}

const ITERATIONS: usize = 40;
/// Relative change of a pole that is none.
const SETTLED: f64 = 1e-13;

/// Minimises the square sum of what the modal model leaves of the FRFs.
pub(super) fn refine(data: &Data, weights: &[f64], poles: Vec<Pole>) -> Refined {
    let basis = Basis::new(data, weights);
    let y = basis.right_side(&data.values, weights);
    let mut at = Point::new(&basis, &y, poles);
    let mut damping = 1e-4;
    'steps: for _ in 0..ITERATIONS {
        let step = Step::new(&basis, &at);
        loop {
            let Some((poles, size)) = step.taken(&at.poles, damping) else {
                damping *= 10.0;
                if damping > 1e8 {
                    break 'steps;
                }
                continue;
            };
            let next = Point::new(&basis, &y, poles);
            if next.cost < at.cost {
                let gain = (at.cost - next.cost) / at.cost;
                at = next;
                damping = (0.1 * damping).max(1e-12);
                if size < SETTLED || gain < 1e-10 && size < 1e-9 {
                    break 'steps;
                }
                break;
            }
            damping *= 10.0;
            if size < SETTLED || damping > 1e8 {
                break 'steps;
            }
        }
    }
    renew(&mut at, &basis, &y);
    let step = Step::new(&basis, &at);
    let covariance = covariance(data, &at, &step);
    let significance = significance(&at);
    let fit = basis.fit(&at.x, at.poles.len());
    Refined { poles: at.poles, fit, covariance, significance }
}

/// Makes the largest participation 1 again.
fn renew(at: &mut Point, basis: &Basis, y: &DMatrix<f64>) {
    for pole in &mut at.poles {
        pole.participation = super::plscf::unit(std::mem::take(&mut pole.participation));
    }
    debug_assert!(at.poles.iter().all(|p| (p.participation[fixed_input(p)] - 1.0).norm() < 1e-9));
    *at = Point::new(basis, y, std::mem::take(&mut at.poles));
}

fn covariance(data: &Data, at: &Point, step: &Step) -> Vec<[f64; 3]> {
    let modes = at.poles.len();
    let n = step.square.nrows();
    let mut square = step.square.clone();
    (0..n).for_each(|k| square[(k, k)] *= 1.0 + 1e-12);
    let Some(inverse) = Cholesky::new(square).map(|c| c.inverse()) else {
        return vec![[f64::INFINITY, f64::INFINITY, 0.0]; modes];
    };
    let own: Vec<usize> =
        (0..step.list.len()).filter(|&k| step.list[k].input.is_none()).flat_map(|k| [2 * k, 2 * k + 1]).collect();
    let lambda = DMatrix::from_fn(own.len(), n, |i, j| inverse[(own[i], j)]);
    let (lines, inputs, outputs) = (data.lines(), data.inputs(), data.outputs());
    // Residuals are smaller than the noise by what the unknowns take of it: 1 − leverage.
    let leverage: Vec<f64> = at.q.row_iter().map(|row| row.norm_squared()).collect();
    let share = n as f64 / (2.0 * (lines * inputs * outputs) as f64);
    let influence = |o: usize| {
        let mut w = DMatrix::zeros(own.len(), n);
        for (k, change) in step.list.iter().enumerate() {
            let psi = at.shape(change.mode, o);
            for row in 0..own.len() {
                let (a, b) = (lambda[(row, 2 * k)], lambda[(row, 2 * k + 1)]);
                w[(row, 2 * k)] = a * psi.re - b * psi.im;
                w[(row, 2 * k + 1)] = a * psi.im + b * psi.re;
            }
        }
        // Scores of λ by input and line.
        let rows = &step.free * w.transpose();
        let mut scores = DMatrix::zeros(own.len(), inputs * lines);
        for i in 0..inputs {
            for k in 0..lines {
                for part in [k, lines + k] {
                    let row = 2 * lines * i + part;
                    let left = (1.0 - leverage[row] - share).max(0.05).sqrt();
                    let error = at.rest[(row, o)] / left;
                    for p in 0..own.len() {
                        scores[(p, i * lines + k)] += rows[(row, p)] * error;
                    }
                }
            }
        }
        scores
    };
    let mut sums = vec![[0.0; 3]; modes];
    let mut add = |scores: &DMatrix<f64>, group: &dyn Fn(usize, &DMatrix<f64>, usize) -> f64, groups: usize| {
        for g in 0..groups {
            for (m, sum) in sums.iter_mut().enumerate() {
                let (re, im) = (group(2 * m, scores, g), group(2 * m + 1, scores, g));
                sum[0] += re * re;
                sum[1] += im * im;
                sum[2] += re * im;
            }
        }
    };
    if data.swapped {
        // Outputs are references: each is a group with its inputs.
        let all: Vec<DMatrix<f64>> = (0..outputs).into_par_iter().map(influence).collect();
        let over_inputs = |row: usize, scores: &DMatrix<f64>, k: usize| {
            (0..inputs).map(|i| scores[(row, i * lines + k)]).sum::<f64>()
        };
        all.iter().for_each(|scores| add(scores, &over_inputs, lines));
    } else {
        let all: Vec<DMatrix<f64>> = (0..outputs).into_par_iter().map(influence).collect();
        let total = all.iter().fold(DMatrix::zeros(own.len(), inputs * lines), |sum, own| sum + own);
        add(&total, &|row, scores, g| scores[(row, g)], inputs * lines);
    }
    sums
}

/// F of leaving a mode out: what it alone explains, an unknown, over what is left, a datum.
fn significance(at: &Point) -> Vec<f64> {
    let n = at.r.nrows();
    let freedom = (at.rest.len() as f64 - (n * at.x.ncols()) as f64).max(1.0);
    let noise = at.cost / freedom;
    // Cov(x) = (RᵀR)⁻¹ for columns of unit length.
    let inverse = at.r.clone().try_inverse().unwrap_or_else(|| DMatrix::identity(n, n));
    let cov = &inverse * inverse.transpose();
    (0..at.poles.len())
        .map(|m| {
            let block = cov.view((2 * m, 2 * m), (2, 2)).into_owned();
            let Some(weight) = block.try_inverse() else { return 0.0 };
            let scaled = |k: usize, o: usize| at.x[(2 * m + k, o)] * at.sizes[2 * m + k];
            let explained: f64 = (0..at.x.ncols())
                .map(|o| {
                    let (a, b) = (scaled(0, o), scaled(1, o));
                    weight[(0, 0)] * a * a + 2.0 * weight[(0, 1)] * a * b + weight[(1, 1)] * b * b
                })
                .sum();
            explained / (2 * at.x.ncols()) as f64 / noise.max(f64::MIN_POSITIVE)
        })
        .collect()
}
