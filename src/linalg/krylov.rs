//! The lowest eigenvalues of the quadratic problem by shift and invert.
//!
//! A block Arnoldi process in real arithmetic about a small real shift σ. Unknowns that nothing
//! couples are solved group by group, and blocks of two find the double eigenvalues of an
//! axisymmetric rotor at rest.

use super::eigen::{self, EigenError};
use super::{BandLayout, Complex64, SparseMatrix, Triplets};
use nalgebra::DMatrix;

/// Vectors per block: a double eigenvalue needs two.
const BLOCK: usize = 2;
/// Residual of an accepted Ritz pair relative to its value.
const TOLERANCE: f64 = 1e-11;
/// Below this many unknowns the dense solver is as fast.
const DENSE_BELOW: usize = 24;

/// An eigenpair of (λ² M + λ C + K) φ = 0.
#[derive(Clone, Debug, PartialEq)]
pub struct QuadraticPair {
    /// λ \[1/s\].
    pub value: Complex64,
    /// φ over all unknowns.
    pub vector: Vec<Complex64>,
    /// Group of coupled unknowns that it belongs to.
    pub group: usize,
}

/// The oscillatory eigenpairs (Im λ > 0) of lowest |λ|: at least `count` of every group of coupled
/// unknowns where it has so many, sorted by |λ|.
///
/// `shift` σ \[1/s\] > 0 should lie below the lowest frequency; eigenvalues with |λ| < 1e-3 σ are rigid-body
/// motion and left out, as are overdamped ones.
///
/// # Errors
/// A singular shifted matrix, no convergence, or entries that are not finite.
pub fn lowest(
    m: &SparseMatrix,
    c: &SparseMatrix,
    k: &SparseMatrix,
    count: usize,
    shift: f64,
) -> Result<Vec<QuadraticPair>, EigenError> {
    let layout = BandLayout::new(&[m, c, k]);
    let mut pairs = Vec::new();
    for (group, unknowns) in layout.groups().enumerate() {
        let [m, c, k] = [m, c, k].map(|a| restrict(a, unknowns));
        let found = if unknowns.len() <= DENSE_BELOW.max(2 * count) {
            eigen::quadratic(&m.to_dense(), &c.to_dense(), &k.to_dense())?
        } else {
            arnoldi(&m, &c, &k, count, shift)?
        };
        for (value, part) in found {
            if value.im > 1e-6 * value.norm() && value.norm() > 1e-3 * shift {
                let mut vector = vec![Complex64::default(); layout.size()];
                for (&i, v) in unknowns.iter().zip(part) {
                    vector[i] = v;
                }
                pairs.push(QuadraticPair { value, vector, group });
            }
        }
    }
    pairs.sort_by(|a, b| a.value.norm().total_cmp(&b.value.norm()).then(a.group.cmp(&b.group)));
    Ok(pairs)
}

/// The rows and columns of a group of unknowns.
fn restrict(a: &SparseMatrix, unknowns: &[usize]) -> SparseMatrix {
    let mut place = vec![None; a.rows()];
    for (p, &i) in unknowns.iter().enumerate() {
        place[i] = Some(p);
    }
    let mut out = Triplets::new(unknowns.len(), unknowns.len());
    for (q, &j) in unknowns.iter().enumerate() {
        for (i, v) in a.column(j) {
            if let Some(p) = place[i] {
                out.add(p, q, v);
            }
        }
    }
    out.build()
}

type Pairs = Vec<(Complex64, Vec<Complex64>)>;

/// Eigenpairs of lowest |λ − σ| of one group, at least `count` oscillatory ones.
fn arnoldi(
    m: &SparseMatrix,
    c: &SparseMatrix,
    k: &SparseMatrix,
    count: usize,
    shift: f64,
) -> Result<Pairs, EigenError> {
    let n = m.rows();
    let damp = SparseMatrix::sum(&[(1.0, c), (shift, m)]);
    let shifted = SparseMatrix::sum(&[(1.0, k), (shift, &damp)]);
    let layout = BandLayout::new(&[&shifted]);
    let lu = layout.factor(layout.scatter(&shifted)).map_err(|_| EigenError::SingularShift)?;

    // State (q, v/s) with v = λ q; s makes the halves of the wanted vectors alike in size.
    let s = shift;
    let apply = |x: &[f64]| {
        let (a, b) = x.split_at(n);
        let mut q = vec![0.0; n];
        m.mul_add(-s, b, &mut q);
        damp.mul_add(-1.0, a, &mut q);
        lu.solve(&mut q);
        let v: Vec<f64> = q.iter().zip(a).map(|(q, a)| (shift * q + a) / s).collect();
        q.extend(v);
        q
    };

    // Basis columns lie one after another; h holds the projection of the operator.
    let mut noise = Noise(0x9E37_79B9_7F4A_7C15);
    let mut basis: Vec<Vec<f64>> = Vec::new();
    for _ in 0..BLOCK {
        let start = apply(&(0..2 * n).map(|_| noise.next()).collect::<Vec<_>>());
        orthonormalise(start, &mut basis, &mut noise);
    }
    let mut columns: Vec<Vec<f64>> = Vec::new();
    let mut size = 4 * count + 12;
    loop {
        size = size.min(2 * n - BLOCK);
        while columns.len() < size {
            let image = apply(&basis[columns.len()]);
            columns.push(orthonormalise(image, &mut basis, &mut noise));
        }
        let ritz = ritz_pairs(&columns, &basis, size, shift)?;
        if size >= 2 * n - BLOCK {
            // The whole space is spanned but for a block: let the dense solver say the last word.
            return eigen::quadratic(&m.to_dense(), &c.to_dense(), &k.to_dense());
        }
        let good = ritz.iter().take_while(|r| r.residual < TOLERANCE);
        if good.filter(|r| r.value.im > 1e-6 * r.value.norm() && r.value.norm() > 1e-3 * shift).count()
            >= count
        {
            return Ok(ritz
                .into_iter()
                .take_while(|r| r.residual < TOLERANCE)
                .map(|r| (r.value, expand(&r.vector, &basis, n)))
                .collect());
        }
        size += 8;
    }
}

struct Ritz {
    value: Complex64,
    vector: Vec<Complex64>,
    /// ‖A x − θ x‖ / |θ|.
    residual: f64,
}

/// Ritz pairs of the projected operator, lowest |λ| first.
fn ritz_pairs(
    columns: &[Vec<f64>],
    basis: &[Vec<f64>],
    size: usize,
    shift: f64,
) -> Result<Vec<Ritz>, EigenError> {
    let h = DMatrix::from_fn(basis.len(), size, |i, j| columns[j].get(i).copied().unwrap_or(0.0));
    let (values, vectors) = eigen::general(&h.rows(0, size).into_owned())?;
    let rest = h.rows(size, basis.len() - size);
    let mut ritz: Vec<Ritz> = values
        .iter()
        .enumerate()
        .filter(|(_, theta)| theta.norm() > 0.0)
        .map(|(j, theta)| {
            let y = vectors.column(j);
            let left: f64 = rest
                .row_iter()
                .map(|r| r.iter().zip(y.iter()).map(|(h, y)| y * *h).sum::<Complex64>().norm_sqr())
                .sum();
            let size: f64 = y.iter().map(|v| v.norm_sqr()).sum();
            Ritz {
                value: theta.inv() + shift,
                vector: y.iter().copied().collect(),
                residual: (left / size).sqrt() / theta.norm(),
            }
        })
        .collect();
    ritz.sort_by(|a, b| a.value.norm().total_cmp(&b.value.norm()).then(a.value.im.total_cmp(&b.value.im)));
    Ok(ritz)
}

/// The first half (q) of the state vector with these coordinates in the basis.
fn expand(y: &[Complex64], basis: &[Vec<f64>], n: usize) -> Vec<Complex64> {
    let mut q = vec![Complex64::default(); n];
    for (&y, b) in y.iter().zip(basis) {
        for (q, &b) in q.iter_mut().zip(b) {
            *q += y * b;
        }
    }
    q
}

/// Appends x, made orthonormal to the basis; returns its coordinates (the last is its remaining length).
fn orthonormalise(mut x: Vec<f64>, basis: &mut Vec<Vec<f64>>, noise: &mut Noise) -> Vec<f64> {
    let mut h = vec![0.0; basis.len() + 1];
    let before = norm(&x);
    // Twice is enough (Parlett & Kahan).
    for _ in 0..2 {
        project_out(&mut x, basis, &mut h);
    }
    let length = norm(&x);
    if length > 1e-13 * before && length > 0.0 {
        h[basis.len()] = length;
        x.iter_mut().for_each(|v| *v /= length);
    } else {
        // An invariant subspace: go on with a fresh direction that nothing maps to.
        x = (0..x.len()).map(|_| noise.next()).collect();
        for _ in 0..2 {
            project_out(&mut x, basis, &mut vec![0.0; basis.len()]);
        }
        let length = norm(&x);
        x.iter_mut().for_each(|v| *v /= length);
    }
    basis.push(x);
    h
}

fn project_out(x: &mut [f64], basis: &[Vec<f64>], h: &mut [f64]) {
    for (b, h) in basis.iter().zip(h) {
        let part = dot(b, x);
        *h += part;
        for (x, b) in x.iter_mut().zip(b) {
            *x -= part * b;
        }
    }
}

/// Dot product in four partial sums, which the compiler can lay side by side.
fn dot(a: &[f64], b: &[f64]) -> f64 {
    let mut sums = [0.0; 4];
    let (a4, b4) = (a.chunks_exact(4), b.chunks_exact(4));
    let tail: f64 = a4.remainder().iter().zip(b4.remainder()).map(|(a, b)| a * b).sum();
    for (a, b) in a4.zip(b4) {
        for i in 0..4 {
            sums[i] += a[i] * b[i];
        }
    }
    sums.iter().sum::<f64>() + tail
}

fn norm(x: &[f64]) -> f64 {
    dot(x, x).sqrt()
}

/// Fixed pseudo-random numbers in (−1, 1) (xorshift64), so that a run repeats bit for bit.
struct Noise(u64);

impl Noise {
    fn next(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }
}
