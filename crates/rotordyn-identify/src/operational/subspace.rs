//! Covariance-driven stochastic subspace identification (SSI-cov).
//!
//! With x_{k+1} = A x_k + w_k, y_k = C x_k + v_k the correlations are R(i) = C A^{i−1} G, and the block Hankel matrix
//! H_ab = R(a + b + 1) = O Γ of observability and controllability. H = U S Vᵀ gives O = U_n S_n^{1/2}, and the shift of O by
//! one block row A: O↑ A = O↓. Poles λ = f_s ln μ(A), shapes ψ = C φ.
//!
//! Source: Peeters & De Roeck, Mech. Syst. Signal Process. 13 (1999) 855.

use nalgebra::DMatrix;
use rayon::prelude::*;
use rotordyn_linalg::{Complex64, eigen};

use crate::IdentifyError;
use crate::plscf::{Pole, normalise_largest};
use crate::stabilisation::Candidate;

/// Singular value over the largest below which a direction is taken for round-off of the Gram matrix.
const RANK_TOLERANCE: f64 = 1e-7;

/// Decomposition of the Hankel matrix.
pub(super) struct Subspace {
    /// Left singular vectors, rank r of them.
    pub u: DMatrix<f64>,
    pub s: Vec<f64>,
    /// Right singular vectors.
    pub v: DMatrix<f64>,
    pub channels: usize,
    pub references: usize,
    /// \[Hz\].
    pub rate: f64,
}

/// The state matrix of one order with its eigenvectors.
pub(super) struct Realisation {
    /// O without its last, without its first block row.
    pub up: DMatrix<f64>,
    pub down: DMatrix<f64>,
    /// (O↑ᵀ O↑)⁻¹.
    pub inverse_gram: DMatrix<f64>,
    /// Eigenvalues μ of A, right eigenvectors, and the inverse of their matrix (left eigenvectors as rows).
    pub mu: Vec<Complex64>,
    pub right: DMatrix<Complex64>,
    pub left: DMatrix<Complex64>,
    /// Observability.
    pub o: DMatrix<f64>,
}

impl Subspace {
    /// H = U S Vᵀ, by the eigenvalues of HᵀH: statistical errors of correlations are far above the squared round-off.
    pub fn new(
        h: &DMatrix<f64>,
        channels: usize,
        references: usize,
        rate: f64,
    ) -> Result<Self, IdentifyError> {
        let gram = h.tr_mul(h);
        let (values, vectors) = eigen::symmetric(&gram)?;
        let n = values.len();
        let largest = values[n - 1].max(0.0).sqrt();
        let kept: Vec<usize> =
            (0..n).rev().filter(|&k| values[k].max(0.0).sqrt() > RANK_TOLERANCE * largest).collect();
        let s: Vec<f64> = kept.iter().map(|&k| values[k].sqrt()).collect();
        let v = vectors.select_columns(&kept);
        let mut u = h * &v;
        for (mut column, s) in u.column_iter_mut().zip(&s) {
            column /= *s;
        }
        Ok(Self { u, s, v, channels, references, rate })
    }

    /// A of an order; `None` if its eigenvectors are defective.
    pub fn realisation(&self, order: usize) -> Result<Option<Realisation>, IdentifyError> {
        let rows = self.u.nrows() - self.channels;
        let mut o = self.u.columns(0, order).into_owned();
        for (mut column, s) in o.column_iter_mut().zip(&self.s) {
            column *= s.sqrt();
        }
        let up = o.rows(0, rows).into_owned();
        let down = o.rows(self.channels, rows).into_owned();
        let Some(inverse_gram) = up.tr_mul(&up).cholesky().map(|c| c.inverse()) else { return Ok(None) };
        let a = &inverse_gram * up.tr_mul(&down);
        let (mu, right) = eigen::general(&a)?;
        let Some(left) = right.clone().try_inverse() else { return Ok(None) };
        Ok(Some(Realisation { up, down, inverse_gram, mu, right, left, o }))
    }

    /// λ = f_s ln μ.
    pub fn pole(&self, mu: Complex64) -> Complex64 {
        mu.ln() * self.rate
    }

    /// C φ of one eigenvector.
    pub fn shape(&self, model: &Realisation, k: usize) -> Vec<Complex64> {
        let phi = model.right.column(k);
        (0..self.channels).map(|c| model.o.row(c).iter().zip(phi.iter()).map(|(o, p)| p * *o).sum()).collect()
    }

    /// Poles of all orders in a band with their shapes.
    pub fn candidates(
        &self,
        orders: &[usize],
        band: [f64; 2],
        largest_damping: f64,
    ) -> Result<Vec<Candidate>, IdentifyError> {
        let of_order = |(index, &order): (usize, &usize)| -> Result<Vec<Candidate>, IdentifyError> {
            let Some(model) = self.realisation(order)? else { return Ok(Vec::new()) };
            let mut list = Vec::new();
            for k in 0..order {
                let value = self.pole(model.mu[k]);
                let hz = value.im / std::f64::consts::TAU;
                let damping = -value.re / value.norm();
                let inside = value.im > 0.0 && hz >= band[0] && hz <= band[1];
                if !inside || damping <= 0.0 || damping >= largest_damping {
                    continue;
                }
                let shape = normalise_largest(self.shape(&model, k));
                let pole = Pole::new(value, vec![1.0.into()]);
                list.push(Candidate { order: index, pole, shape, double: false });
            }
            list.sort_by(|a, b| a.pole.value.im.total_cmp(&b.pole.value.im));
            Ok(list)
        };
        let lists: Result<Vec<Vec<Candidate>>, IdentifyError> =
            orders.par_iter().enumerate().map(of_order).collect();
        Ok(lists?.into_iter().flatten().collect())
    }

    /// Part of the energy of all correlations that the eigenvector k carries with its conjugate.
    pub fn contribution(&self, model: &Realisation, k: usize, lags: usize, energy: f64) -> f64 {
        let shape = self.shape(model, k);
        let size: f64 = shape.iter().map(|v| v.norm_sqr()).sum();
        // χᴴ G over the references, G the first block column of S^{1/2} Vᵀ.
        let g: Vec<Complex64> = (0..self.references)
            .map(|r| {
                (0..model.mu.len()).map(|i| model.left[(k, i)] * (self.s[i].sqrt() * self.v[(r, i)])).sum()
            })
            .collect();
        let size = size * g.iter().map(|v| v.norm_sqr()).sum::<f64>();
        let decay = model.mu[k].norm_sqr();
        // Σ |c μ^i + conj.|² is 2 |c|² |μ|^{2i} over whole cycles.
        let sum: f64 = (0..lags).map(|i| decay.powi(i as i32)).sum();
        2.0 * size * sum / energy
    }
}
