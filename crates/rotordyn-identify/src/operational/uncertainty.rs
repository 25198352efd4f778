//! Standard errors of poles and shapes by first-order propagation of the scatter of the block correlations.
//!
//! Cov(R) = Σ_b ΔR_b ΔR_bᵀ / (n_b (n_b − 1)), ΔR_b = R_b − R. The change of a pole by each ΔR_b is a directional
//! derivative, and the sum of their squares its variance; no covariance matrix is formed.
//!
//! Derivatives: of singular vectors outside the chosen subspace,
//! u_jᵀ δu_i = (s_i u_jᵀ ΔH v_i + s_j u_iᵀ ΔH v_j) / (s_i² − s_j²) (rotations inside only change the basis of A); of A,
//! δA = O↑⁺ (δO↓ − δO↑ A) + (O↑ᵀ O↑)⁻¹ δO↑ᵀ (O↓ − O↑ A); of an eigenvalue χᴴ δA φ with χᴴ φ = 1; and of its eigenvector.
//!
//! Source: Reynders, Pintelon & De Roeck, Mech. Syst. Signal Process. 22 (2008) 948; Döhler & Mevel, ibid. 38 (2013) 346.

use nalgebra::{DMatrix, DVector};
use rayon::prelude::*;
use rotordyn_linalg::Complex64;

use super::correlation::{Correlations, hankel};
use super::subspace::{Realisation, Subspace};

/// Variances of Re λ and Im λ with their covariance, and of the shape's entries.
pub(super) struct ModeVariance {
    pub pole: [f64; 3],
    pub shape: Vec<f64>,
}

/// A mode's place: state-space model and eigenvector.
pub(super) struct Place<'a> {
    pub model: &'a Realisation,
    pub vector: usize,
    /// Entry of the shape that is normalised to 1.
    pub largest: usize,
}

/// Variances of the modes at some places.
pub(super) fn variances(
    space: &Subspace,
    correlations: &Correlations,
    rows: usize,
    places: &[Place],
) -> Vec<ModeVariance> {
    let orders = places.iter().map(|p| p.model.mu.len()).max().unwrap_or(0);
    let of_block = |block: &Vec<DMatrix<f64>>| {
        let change: Vec<DMatrix<f64>> = block.iter().zip(&correlations.mean).map(|(b, m)| b - m).collect();
        let rotation = Rotation::new(space, &hankel(&change, rows), orders);
        places.iter().map(|place| derivative(space, &rotation, place)).collect::<Vec<_>>()
    };
    let changes: Vec<Vec<(Complex64, Vec<Complex64>)>> =
        correlations.blocks.par_iter().map(of_block).collect();
    let n = correlations.blocks.len() as f64;
    let scale = 1.0 / (n * (n - 1.0));
    (0..places.len())
        .map(|m| {
            let mut out = ModeVariance { pole: [0.0; 3], shape: vec![0.0; space.channels] };
            for block in &changes {
                let (pole, shape) = &block[m];
                let squares = [pole.re * pole.re, pole.im * pole.im, pole.re * pole.im];
                out.pole.iter_mut().zip(squares).for_each(|(sum, own)| *sum += scale * own);
                out.shape.iter_mut().zip(shape).for_each(|(sum, own)| *sum += scale * own.norm_sqr());
            }
            out
        })
        .collect()
}

/// Change of the singular vectors by a change of the Hankel matrix.
struct Rotation {
    /// u_jᵀ δu_i, all j by the first orders i.
    inside: DMatrix<f64>,
    /// Part of δu_i outside all singular vectors.
    outside: DMatrix<f64>,
}

impl Rotation {
    fn new(space: &Subspace, change: &DMatrix<f64>, orders: usize) -> Self {
        let (s, rank) = (&space.s, space.s.len());
        let right = change * space.v.columns(0, orders);
        let first = space.u.tr_mul(&right);
        let second = change.tr_mul(&space.u.columns(0, orders)).tr_mul(&space.v).transpose();
        let inside = DMatrix::from_fn(rank, orders, |j, i| {
            let gap = s[i] * s[i] - s[j] * s[j];
            if j == i || gap == 0.0 { 0.0 } else { (s[i] * first[(j, i)] + s[j] * second[(j, i)]) / gap }
        });
        let mut outside = right - &space.u * &first;
        for (mut column, s) in outside.column_iter_mut().zip(s) {
            column /= *s;
        }
        Self { inside, outside }
    }

    /// δO x for the model of an order n: S^{1/2} x combined with what leaves the subspace.
    fn observability(&self, space: &Subspace, x: &[Complex64]) -> DVector<Complex64> {
        let (n, rank) = (x.len(), space.s.len());
        let weighted: Vec<Complex64> = x.iter().zip(&space.s).map(|(x, s)| x * s.sqrt()).collect();
        let combine = |of: &DMatrix<f64>, from: usize, to: usize| {
            let part = of.view((from, 0), (to - from, n));
            let parts = |pick: &dyn Fn(&Complex64) -> f64| {
                part * DVector::from_iterator(n, weighted.iter().map(pick))
            };
            (parts(&|v| v.re), parts(&|v| v.im))
        };
        let (re, im) = combine(&self.inside, n, rank);
        let (more_re, more_im) = combine(&self.outside, 0, self.outside.nrows());
        let beyond = space.u.columns(n, rank - n);
        let (re, im) = (beyond * re + more_re, beyond * im + more_im);
        DVector::from_fn(re.len(), |i, _| Complex64::new(re[i], im[i]))
    }

    /// δOᵀ y for y over the rows of O.
    fn transposed(&self, space: &Subspace, n: usize, y: &DVector<Complex64>) -> DVector<Complex64> {
        let rank = space.s.len();
        let parts = |y: DVector<f64>| {
            let along = space.u.columns(n, rank - n).tr_mul(&y);
            let mut out = self.inside.view((n, 0), (rank - n, n)).tr_mul(&along);
            out += self.outside.columns(0, n).tr_mul(&y);
            out.iter_mut().zip(&space.s).for_each(|(v, s)| *v *= s.sqrt());
            out
        };
        let (re, im) = (parts(y.map(|v| v.re)), parts(y.map(|v| v.im)));
        DVector::from_fn(n, |i, _| Complex64::new(re[i], im[i]))
    }
}

/// A times a complex vector.
fn times(a: &DMatrix<f64>, x: &DVector<Complex64>) -> DVector<Complex64> {
    let (re, im) = (a * x.map(|v| v.re), a * x.map(|v| v.im));
    DVector::from_fn(re.len(), |i, _| Complex64::new(re[i], im[i]))
}

/// Change of a pole λ and of its shape, which is normalised to 1 at its largest entry.
fn derivative(space: &Subspace, rotation: &Rotation, place: &Place) -> (Complex64, Vec<Complex64>) {
    let Place { model, vector: k, largest } = place;
    let n = model.mu.len();
    let (l, rows) = (space.channels, model.up.nrows());
    let mu = model.mu[*k];
    let phi = model.right.column(*k).into_owned();
    let moved = rotation.observability(space, phi.as_slice());
    let shifted = DVector::from_fn(rows, |i, _| moved[i + l] - mu * moved[i]);
    let rest = times(&model.down, &phi) - times(&model.up, &phi).map(|v| v * mu);
    let mut padded = DVector::zeros(rows + l);
    padded.rows_mut(0, rows).copy_from(&rest);
    let right = times(&model.up.transpose(), &shifted) + rotation.transposed(space, n, &padded);
    // δA φ in the eigenvectors.
    let change = &model.left * times(&model.inverse_gram, &right);
    let pole = change[*k] / mu * space.rate;
    let mut phi_change = DVector::<Complex64>::zeros(n);
    for m in (0..n).filter(|m| m != k) {
        let gap = mu - model.mu[m];
        if gap.norm() > 0.0 {
            phi_change += model.right.column(m) * (change[m] / gap);
        }
    }
    let value = |o: usize, x: &DVector<Complex64>| -> Complex64 {
        model.o.row(o).iter().zip(x.iter()).map(|(c, x)| x * *c).sum()
    };
    let raw: Vec<Complex64> = (0..l).map(|o| value(o, &phi)).collect();
    let raw_change: Vec<Complex64> = (0..l).map(|o| moved[o] + value(o, &phi_change)).collect();
    let scale = raw[*largest];
    let shape = raw
        .iter()
        .zip(&raw_change)
        .map(|(v, d)| d / scale - v / scale * (raw_change[*largest] / scale))
        .collect();
    (pole, shape)
}
