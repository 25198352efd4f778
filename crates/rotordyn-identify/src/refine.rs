//! Refinement of poles and participations by nonlinear least squares (Levenberg-Marquardt).
//!
//! Shapes and residual terms are linear unknowns, eliminated by variable projection (Golub & Pereyra 1973,
//! Kaufman's approximation); the matrix is the same for all outputs, so an iteration costs about as much as
//! one LSFD.

use std::f64::consts::TAU;

use nalgebra::{Cholesky, DMatrix, DVector};

use super::data::Data;
use super::dense::{back_substitute, mul, thin_qr, tr_mul};
use super::lsfd::{Basis, Fit, FitParameter};
use super::plscf::{Pole, normalise_largest};
use rotordyn_linalg::Complex64;

/// A fit for given poles and participations.
pub(super) struct FitPoint {
    pub poles: Vec<Pole>,
    pub q: DMatrix<f64>,
    pub r: DMatrix<f64>,
    /// Lengths of the columns of the design: A = Q R diag(sizes).
    pub sizes: Vec<f64>,
    pub x: DMatrix<f64>,
    /// Residuals of the fit.
    pub residual: DMatrix<f64>,
    pub cost: f64,
}

impl FitPoint {
    fn new(basis: &Basis, y: &DMatrix<f64>, poles: Vec<Pole>) -> Self {
        let (q, r, sizes) = thin_qr(basis.design(&poles));
        let z = tr_mul(&q, y);
        let rest = y - mul(&q, &z);
        let x = back_substitute(&r, &sizes, z);
        let cost = rest.norm_squared();
        Self { poles, q, r, sizes, x, residual: rest, cost }
    }

    pub fn shape(&self, mode: usize, output: usize) -> Complex64 {
        Complex64::new(self.x[(2 * mode, output)], self.x[(2 * mode + 1, output)])
    }

    /// Residual variance: squared residuals over the degrees of freedom (data minus unknowns).
    pub fn residual_variance(&self) -> f64 {
        let unknowns = self.x.len() + 2 * self.poles.iter().map(|p| p.participation.len()).sum::<usize>();
        self.cost / (self.residual.len() as f64 - unknowns as f64).max(1.0)
    }
}

/// Gauss-Newton normal equations in the poles and participations.
pub(super) struct GaussNewtonStep {
    pub parameters: Vec<FitParameter>,
    /// Projected Jacobian: derivatives of the FRFs orthogonal to the linear unknowns.
    pub projected_jacobian: DMatrix<f64>,
    pub normal_matrix: DMatrix<f64>,
    gradient: DVector<f64>,
}

impl GaussNewtonStep {
    fn new(basis: &Basis, at: &FitPoint) -> Self {
        let (d, list) = basis.derivative_columns(&at.poles);
        let free = &d - mul(&at.q, &tr_mul(&at.q, &d));
        let gram = tr_mul(&free, &free);
        let slope = tr_mul(&free, &at.residual);
        let (n, outputs) = (list.len(), at.x.ncols());
        let mut square = DMatrix::zeros(2 * n, 2 * n);
        let mut gradient = DVector::zeros(2 * n);
        let modes = at.poles.len();
        let psi: Vec<Vec<Complex64>> =
            (0..modes).map(|m| (0..outputs).map(|o| at.shape(m, o)).collect()).collect();
        // Σ over outputs of products of the shapes' real and imaginary parts.
        let products = |a: usize, b: usize| {
            let mut sum = [0.0; 4];
            for (p, q) in psi[a].iter().zip(&psi[b]) {
                sum[0] += p.re * q.re;
                sum[1] += p.re * q.im;
                sum[2] += p.im * q.re;
                sum[3] += p.im * q.im;
            }
            sum
        };
        let all: Vec<Vec<[f64; 4]>> =
            (0..modes).map(|a| (0..modes).map(|b| products(a, b)).collect()).collect();
        for a in 0..n {
            // With c = ψ δ the real pair of c is [ψ', −ψ''; ψ'', ψ'] that of δ.
            let pairs = psi[list[a].mode].iter().enumerate();
            let sum: Complex64 = pairs
                .map(|(o, psi)| psi.conj() * Complex64::new(slope[(2 * a, o)], slope[(2 * a + 1, o)]))
                .sum();
            (gradient[2 * a], gradient[2 * a + 1]) = (sum.re, sum.im);
            for b in 0..n {
                let [rr, ri, ir, ii] = all[list[a].mode][list[b].mode];
                let g = |i: usize, j: usize| gram[(2 * a + i, 2 * b + j)];
                // Cᵀ(p) G C(q), C(p) = p' I + p'' [0, −1; 1, 0].
                square[(2 * a, 2 * b)] = rr * g(0, 0) + ri * g(0, 1) + ir * g(1, 0) + ii * g(1, 1);
                square[(2 * a, 2 * b + 1)] = rr * g(0, 1) - ri * g(0, 0) + ir * g(1, 1) - ii * g(1, 0);
                square[(2 * a + 1, 2 * b)] = rr * g(1, 0) + ri * g(1, 1) - ir * g(0, 0) - ii * g(0, 1);
                square[(2 * a + 1, 2 * b + 1)] = rr * g(1, 1) - ri * g(1, 0) - ir * g(0, 1) + ii * g(0, 0);
            }
        }
        Self { parameters: list, projected_jacobian: free, normal_matrix: square, gradient }
    }

    /// A diagonal block of (JᵀJ)⁻¹.
    pub fn inverse_block(&self, first: usize, count: usize) -> DMatrix<f64> {
        if count == 0 {
            return DMatrix::zeros(0, 0);
        }
        let mut square = self.normal_matrix.clone();
        // Regularised: repeated poles leave the rotation of their participations undetermined.
        (0..square.nrows()).for_each(|k| square[(k, k)] *= 1.0 + 1e-12);
        let unit = DMatrix::from_fn(square.nrows(), count, |i, j| f64::from(u8::from(i == first + j)));
        match Cholesky::new(square) {
            Some(factor) => factor.solve(&unit).rows(first, count).into_owned(),
            None => DMatrix::zeros(count, count),
        }
    }

    /// Poles after a damped (Levenberg-Marquardt) step, and the cost reduction predicted by the linear model.
    pub fn damped_step(&self, poles: &[Pole], damping: f64) -> Option<(Vec<Pole>, f64)> {
        let mut square = self.normal_matrix.clone();
        for k in 0..square.nrows() {
            square[(k, k)] *= 1.0 + damping;
        }
        let step = Cholesky::new(square)?.solve(&self.gradient);
        let mut out = poles.to_vec();
        for (k, change) in self.parameters.iter().enumerate() {
            let by = Complex64::new(step[2 * k], step[2 * k + 1]);
            match change.input {
                None => out[change.mode].value += by,
                Some(i) => out[change.mode].participation[i] += by,
            }
        }
        Some((out, step.dot(&self.gradient)))
    }
}

/// Convergence: predicted cost reduction over the residual variance (a hundredth of the standard errors).
const CONVERGENCE_TOLERANCE: f64 = 1e-4;
/// Round-off level of the cost over the FRFs' sum of squares.
const ROUND_OFF: f64 = 1e-28;

/// Local gain of a mode from which it is one.
pub(super) const MIN_LOCAL_GAIN: f64 = 1.5;
/// Least half width, in lines, of what is near a mode.
const MIN_LINES: f64 = 3.0;

/// Fit problem: FRFs with basis functions and right-hand side.
pub(super) struct Problem<'a> {
    data: &'a Data,
    basis: Basis,
    y: DMatrix<f64>,
}

impl<'a> Problem<'a> {
    pub fn new(data: &'a Data) -> Self {
        let basis = Basis::new(data);
        let y = basis.right_side(&data.values);
        Self { data, basis, y }
    }

    pub fn data(&self) -> &Data {
        self.data
    }

    /// Derivatives of the FRFs by poles and participations, as of [`Basis::derivative_columns`].
    pub fn derivative_columns(&self, poles: &[Pole]) -> (DMatrix<f64>, Vec<FitParameter>) {
        self.basis.derivative_columns(poles)
    }

    /// Sum of squares of the FRFs.
    pub fn energy(&self) -> f64 {
        self.y.norm_squared()
    }

    /// Minimises the sum of squared residuals of the FRFs, in at most `steps` steps.
    pub fn refine(&self, poles: Vec<Pole>, steps: usize) -> FitPoint {
        let mut at = FitPoint::new(&self.basis, &self.y, poles);
        if at.poles.iter().all(|pole| pole.held) {
            return at;
        }
        let least = ROUND_OFF * self.y.norm_squared();
        let mut damping = 1e-3;
        'steps: for _ in 0..steps {
            if self.data.stop.is_requested() {
                break;
            }
            let step = GaussNewtonStep::new(&self.basis, &at);
            while damping < 1e8 {
                if let Some((poles, expected)) = step.damped_step(&at.poles, damping) {
                    let next = FitPoint::new(&self.basis, &self.y, poles);
                    if next.cost < at.cost {
                        at = next;
                        damping = (0.1 * damping).max(1e-12);
                        if at.cost < least || expected < CONVERGENCE_TOLERANCE * at.residual_variance() {
                            break 'steps;
                        }
                        continue 'steps;
                    }
                    if expected < CONVERGENCE_TOLERANCE * at.residual_variance() {
                        break 'steps;
                    }
                }
                damping *= 10.0;
            }
            break;
        }
        // Renormalise the largest participation to 1.
        for pole in &mut at.poles {
            pole.participation = normalise_largest(std::mem::take(&mut pole.participation));
        }
        let poles = std::mem::take(&mut at.poles);
        FitPoint::new(&self.basis, &self.y, poles)
    }

    /// Squared residuals near a mode, within its half-power bandwidth on either side, over those with it, if it is left out and
    /// the other poles stay.
    pub fn local_gain(&self, at: &FitPoint, mode: usize) -> f64 {
        let mut poles = at.poles.clone();
        let own = poles.remove(mode).value;
        let without = FitPoint::new(&self.basis, &self.y, poles);
        let lines = self.data.lines();
        let near = |line: usize| {
            (TAU * self.data.frequencies[line] - own.im).abs()
                <= (2.0 * own.re.abs()).max(MIN_LINES * TAU * self.data.step)
        };
        let sum = |residual: &DMatrix<f64>| -> f64 {
            let column = |o: usize| residual.column(o).into_iter().enumerate();
            (0..residual.ncols())
                .flat_map(column)
                .filter(|(row, _)| near(row % lines))
                .map(|(_, e)| e * e)
                .sum()
        };
        sum(&without.residual) / sum(&at.residual).max(f64::MIN_POSITIVE)
    }

    /// The fit with free residues of poles outside the band besides, and where a step takes its poles; `None` if they are not
    /// distinguishable.
    pub fn with_outside(&self, at: &FitPoint, outside: &[Complex64]) -> Option<(FitPoint, Vec<Pole>)> {
        let basis = self.basis.with_free(outside);
        let unknowns = at.x.nrows() + 2 * outside.len() * self.data.inputs();
        if self.basis.rows() < 2 * unknowns {
            return None;
        }
        let with = FitPoint::new(&basis, &self.y, at.poles.clone());
        let (poles, _) = GaussNewtonStep::new(&basis, &with).damped_step(&with.poles, 1e-12)?;
        let is_finite = poles.iter().all(|pole| pole.value.re.is_finite() && pole.value.im.is_finite());
        is_finite.then(|| (FitPoint::new(&basis, &self.y, poles.clone()), poles))
    }

    pub fn step(&self, at: &FitPoint) -> GaussNewtonStep {
        GaussNewtonStep::new(&self.basis, at)
    }

    /// Derivatives of the FRFs by a pole, for the real and imaginary part of ψ δλ: two columns.
    pub fn pole_derivative(&self, pole: &Pole) -> DMatrix<f64> {
        let free = Pole::new(pole.value, pole.participation.clone());
        self.basis.derivative_columns(&[free]).0.columns(0, 2).into_owned()
    }

    pub fn fit(&self, at: &FitPoint) -> Fit {
        self.basis.fit(&at.x, at.poles.len())
    }
}

/// Lower limit of the residual variance over the FRFs' mean square.
const MIN_NOISE: f64 = 1e-24;

/// F statistic of leaving a mode out: explained variance per unknown over the residual variance.
pub(super) fn significance(at: &FitPoint) -> Vec<f64> {
    let n = at.r.nrows();
    let fitted = DMatrix::from_fn(n, at.x.ncols(), |k, o| at.sizes[k] * at.x[(k, o)]);
    let all = at.cost + (&at.r * fitted).norm_squared();
    // Noise floor, so that a mode fitted to round-off is not significant.
    let noise = at.residual_variance().max(MIN_NOISE * all / at.residual.len() as f64).max(f64::MIN_POSITIVE);
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
            explained / (2 * at.x.ncols()) as f64 / noise
        })
        .collect()
}
