//! The pole of the linear structure, that of no motion, where a pole follows the square of the motion along the resonance.
//!
//! λ + κ|σ/(s − λ)|² for a mode: κ by linear least squares on the residuals, together with the poles and participations of all
//! modes: of those of its own mode alone, overlapping modes would leave too little or too much.

use std::f64::consts::TAU;

use nalgebra::{Cholesky, DMatrix, Dyn};
use rayon::prelude::*;

use super::dense::{mul, tr_mul};
use super::refine::{FitPoint, GaussNewtonStep, Problem};
use rotordyn_linalg::Complex64;

/// The pole of the linear structure, that of no motion.
pub(super) struct LinearPole {
    /// From the pole of the mode \[1/s\].
    pub distance: Complex64,
    /// F statistic of the change of the pole along the resonance.
    pub significance: f64,
}

/// Share of κ's information that the other parameters must leave.
const MIN_LEFT: f64 = 1e-4;

/// The pole of no motion of every mode; `None` if the FRFs do not determine it.
pub(super) fn linear_poles(
    problem: &Problem,
    at: &FitPoint,
    step: &GaussNewtonStep,
) -> Vec<Option<LinearPole>> {
    let mut square = step.normal_matrix.clone();
    // Regularised: repeated poles leave the rotation of their participations undetermined.
    (0..square.nrows()).for_each(|k| square[(k, k)] *= 1.0 + 1e-12);
    let factor = Cholesky::new(square);
    let (outputs, modes) = (at.x.ncols(), at.poles.len());
    let shapes: Vec<Vec<Complex64>> =
        (0..modes).map(|m| (0..outputs).map(|o| at.shape(m, o)).collect()).collect();
    // Residuals along the shape of every mode, `[row][mode]`.
    let along = |row: usize| -> Vec<Complex64> {
        let of = |shape: &Vec<Complex64>| {
            shape.iter().enumerate().map(|(o, p)| p.conj() * at.residual[(row, o)]).sum::<Complex64>()
        };
        shapes.iter().map(of).collect()
    };
    let errors: Vec<Vec<Complex64>> = (0..at.residual.nrows()).into_par_iter().map(along).collect();
    let fits = Fits { problem, at, step, shapes, errors };
    let of = |m: usize| fits.of_mode(m, factor.as_ref()?);
    (0..modes).into_par_iter().map(of).collect()
}

struct Fits<'a> {
    problem: &'a Problem<'a>,
    at: &'a FitPoint,
    step: &'a GaussNewtonStep,
    shapes: Vec<Vec<Complex64>>,
    errors: Vec<Vec<Complex64>>,
}

impl Fits<'_> {
    fn of_mode(&self, m: usize, factor: &Cholesky<f64, Dyn>) -> Option<LinearPole> {
        let parameters = &self.step.parameters;
        let own = parameters.iter().position(|p| p.mode == m && p.input.is_none())?;
        let data = self.problem.data();
        let (lines, pole) = (data.lines(), &self.at.poles[m]);
        // Derivatives by the pole, times the square of the motion over its largest.
        let mut columns = self.problem.pole_derivative(pole);
        for (k, hz) in data.frequencies.iter().enumerate() {
            let motion = pole.value.re.powi(2) / (Complex64::new(0.0, TAU * hz) - pole.value).norm_sqr();
            for block in 0..2 * data.inputs() {
                columns.row_mut(block * lines + k).iter_mut().for_each(|value| *value *= motion);
            }
        }
        let columns = &columns - mul(&self.at.q, &tr_mul(&self.at.q, &columns));
        let jacobian = &self.step.projected_jacobian;
        let products = tr_mul(&columns, &columns);
        let information = self.block(m, m, &|i, j| products[(i, j)]);
        let products = tr_mul(&columns, jacobian);
        let mut cross = DMatrix::<f64>::zeros(2, 2 * parameters.len());
        for (b, parameter) in parameters.iter().enumerate() {
            let block = self.block(m, parameter.mode, &|i, j| products[(i, 2 * b + j)]);
            cross.columns_mut(2 * b, 2).copy_from(&block);
        }
        // Without the part that the parameters of all modes take up.
        let taken = factor.solve(&cross.transpose()).transpose();
        let rest = &information - &taken * cross.transpose();
        if rest.determinant() < MIN_LEFT * MIN_LEFT * information.determinant() {
            return None;
        }
        let score_of = |row: usize| -> DMatrix<f64> {
            let pair = |re: f64, im: f64, mode: usize| Complex64::new(re, im) * self.errors[row][mode];
            let own = pair(columns[(row, 0)], columns[(row, 1)], m);
            let mut score = DMatrix::from_column_slice(2, 1, &[own.re, own.im]);
            for (b, parameter) in parameters.iter().enumerate() {
                let g = pair(jacobian[(row, 2 * b)], jacobian[(row, 2 * b + 1)], parameter.mode);
                for k in 0..2 {
                    score[k] -= taken[(k, 2 * b)] * g.re + taken[(k, 2 * b + 1)] * g.im;
                }
            }
            score
        };
        // Scatter of the gradient from line to line: noise of the force is strong at the resonance, and common to all outputs.
        let (mut gradient, mut scatter) = (DMatrix::<f64>::zeros(2, 1), DMatrix::<f64>::zeros(2, 2));
        for line in 0..lines {
            for input in 0..data.inputs() {
                let score = score_of(2 * input * lines + line) + score_of((2 * input + 1) * lines + line);
                scatter += &score * score.transpose();
                gradient += score;
            }
        }
        let change = rest.lu().solve(&gradient)?;
        let significance = 0.5 * (gradient.transpose() * scatter.lu().solve(&gradient)?)[0];
        let pole = -(taken.columns(2 * own, 2).transpose() * change);
        let distance = Complex64::new(pole[0], pole[1]);
        // The pole moves little over the resonance, or it is no small change.
        let small = distance.norm() < self.at.poles[m].value.re.abs();
        (significance.is_finite() && small).then_some(LinearPole { distance, significance })
    }

    /// Cᵀ(ψ_a) G C(ψ_b) summed over the outputs, C(ψ) = ψ' I + ψ'' \[0, −1; 1, 0\].
    fn block(&self, a: usize, b: usize, g: &dyn Fn(usize, usize) -> f64) -> DMatrix<f64> {
        let mut sum = [0.0; 4];
        for (p, q) in self.shapes[a].iter().zip(&self.shapes[b]) {
            sum[0] += p.re * q.re;
            sum[1] += p.re * q.im;
            sum[2] += p.im * q.re;
            sum[3] += p.im * q.im;
        }
        let [rr, ri, ir, ii] = sum;
        DMatrix::from_row_slice(
            2,
            2,
            &[
                rr * g(0, 0) + ri * g(0, 1) + ir * g(1, 0) + ii * g(1, 1),
                rr * g(0, 1) - ri * g(0, 0) + ir * g(1, 1) - ii * g(1, 0),
                rr * g(1, 0) + ri * g(1, 1) - ir * g(0, 0) - ii * g(0, 1),
                rr * g(1, 1) - ri * g(1, 0) - ir * g(0, 1) + ii * g(0, 0),
            ],
        )
    }
}
