//! The lowest eigenvalues of the quadratic problem by shift and invert.
//!
//! An Arnoldi process in real arithmetic about a small real shift σ. Unknowns that nothing couples are
//! solved group by group. Without gyroscopic effect it works on blocks of two, which find the double eigenvalues
//! of an axisymmetric rotor at rest; rotation parts them.

use super::eigen::{self, EigenError};
use super::{BandLayout, Complex64, SparseMatrix, Triplets};
use nalgebra::DMatrix;

/// Residual of an accepted Ritz pair relative to its value.
const TOLERANCE: f64 = 1e-11;
/// Ritz pairs that are no nearer than this stand for nothing (the operator is far from normal); those on their way
/// to a true eigenvalue are nearer long before higher ones have converged.
const SPURIOUS: f64 = 1e-3;
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

/// The oscillatory eigenpairs (Im λ > 0) of lowest |λ|, sorted by |λ|: the first `count` without a gap, if there
/// are so many, and what was found beyond.
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
    let mut groups: Vec<(usize, &[usize])> = layout.groups().enumerate().collect();
    groups.sort_by_key(|(_, unknowns)| std::cmp::Reverse(unknowns.len()));
    let mut pairs: Vec<QuadraticPair> = Vec::new();
    for (group, unknowns) in groups {
        // Of a further group only what lies below the best so far is of use.
        let limit = pairs.get(count.max(1) - 1).map_or(f64::INFINITY, |p| p.value.norm());
        let [m, c, k] = [m, c, k].map(|a| restrict(a, unknowns));
        let found = if unknowns.len() <= DENSE_BELOW {
            eigen::quadratic(&m.to_dense(), &c.to_dense(), &k.to_dense())?
        } else {
            arnoldi(&m, &c, &k, Wanted { count, limit, shift })?
        };
        for (value, part) in found.into_iter().filter(|(value, _)| oscillatory(*value, shift)) {
            let mut vector = vec![Complex64::default(); layout.size()];
            for (&i, v) in unknowns.iter().zip(part) {
                vector[i] = v;
            }
            pairs.push(QuadraticPair { value, vector, group });
        }
        pairs.sort_by(|a, b| a.value.norm().total_cmp(&b.value.norm()).then(a.group.cmp(&b.group)));
    }
    Ok(pairs)
}

/// Whether λ is an oscillation, one of the conjugate pair, and no rigid-body motion.
fn oscillatory(value: Complex64, shift: f64) -> bool {
    value.im > 1e-6 * value.norm() && value.norm() > 1e-3 * shift
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

/// What is asked of a group: `count` oscillatory pairs, or all up to |λ| = `limit`.
#[derive(Clone, Copy)]
struct Wanted {
    count: usize,
    limit: f64,
    shift: f64,
}

/// Oscillatory eigenpairs of lowest |λ| of one group.
fn arnoldi(
    m: &SparseMatrix,
    c: &SparseMatrix,
    k: &SparseMatrix,
    wanted: Wanted,
) -> Result<Pairs, EigenError> {
    let n = m.rows();
    let shift = wanted.shift;
    let damp = SparseMatrix::sum(&[(1.0, c), (shift, m)]);
    let shifted = SparseMatrix::sum(&[(1.0, k), (shift, &damp)]);
    let layout = BandLayout::new(&[&shifted]);
    let lu = layout.factor(layout.scatter(&shifted)).map_err(|_| EigenError::SingularShift)?;

    // State (q, v/σ) with v = λ q, which brings the halves of the wanted vectors nearer in size.
    let apply = |x: &[f64]| {
        let (a, b) = x.split_at(n);
        let mut q = vec![0.0; n];
        m.mul_add(-shift, b, &mut q);
        damp.mul_add(-1.0, a, &mut q);
        lu.solve(&mut q);
        let v: Vec<f64> = q.iter().zip(a).map(|(q, a)| q + a / shift).collect();
        q.extend(v);
        q
    };

    // Column j of `columns` holds the image of basis vector j in the basis.
    let rotating = c.iter().any(|(i, j, v)| i != j && v != c.get(j, i));
    let block = if rotating { 1 } else { 2 };
    let mut noise = Noise(0x9E37_79B9_7F4A_7C15);
    let mut basis: Vec<Vec<f64>> = Vec::new();
    for _ in 0..block {
        let start = apply(&(0..2 * n).map(|_| noise.next()).collect::<Vec<_>>());
        orthonormalise(start, &mut basis, &mut noise);
    }
    let mut columns: Vec<Vec<f64>> = Vec::new();
    let mut size = if wanted.limit.is_finite() { 12 } else { 12 + (2 + block) * wanted.count };
    loop {
        if size >= 2 * n - block {
            // Nearly the whole space: the dense solver is as fast.
            return eigen::quadratic(&m.to_dense(), &c.to_dense(), &k.to_dense());
        }
        while columns.len() < size {
            let image = apply(&basis[columns.len()]);
            columns.push(orthonormalise(image, &mut basis, &mut noise));
        }
        let mut ritz = ritz_pairs(&columns, &basis, size, shift)?;
        ritz.retain(|r| r.residual < SPURIOUS);
        let converged = ritz.iter().take_while(|r| r.residual < TOLERANCE).count();
        let enough = ritz[..converged].iter().filter(|r| oscillatory(r.value, shift)).count() >= wanted.count;
        // What comes next is known well enough to say that it lies beyond the limit.
        let beyond = ritz.get(converged).is_some_and(|r| r.value.norm() > 2.0 * wanted.limit);
        if enough || beyond {
            ritz.truncate(converged);
            ritz.retain(|r| oscillatory(r.value, shift));
            return Ok(ritz.into_iter().map(|r| (r.value, expand(&r.vector, &basis, n))).collect());
        }
        size += 8 + size / 8;
    }
}

struct Ritz {
    value: Complex64,
    vector: Vec<Complex64>,
    /// ‖A x − θ x‖ / |θ|.
    residual: f64,
}

/// Ritz pairs of the projected operator with Im λ ≥ 0, lowest |λ| first.
fn ritz_pairs(
    columns: &[Vec<f64>],
    basis: &[Vec<f64>],
    size: usize,
    shift: f64,
) -> Result<Vec<Ritz>, EigenError> {
    let h = DMatrix::from_fn(basis.len(), size, |i, j| columns[j].get(i).copied().unwrap_or(0.0));
    let rest = h.rows(size, basis.len() - size);
    let mut ritz: Vec<Ritz> = eigen::general_small(&h.rows(0, size).into_owned())?
        .into_iter()
        .filter(|(theta, _)| theta.norm() > 0.0)
        .map(|(theta, y)| {
            let image =
                |r: nalgebra::RowDVector<f64>| r.iter().zip(&y).map(|(h, y)| y * *h).sum::<Complex64>();
            let left: f64 = rest.row_iter().map(|r| image(r.into_owned()).norm_sqr()).sum();
            let size: f64 = y.iter().map(|v| v.norm_sqr()).sum();
            // θ = 1/(λ − σ) has Im θ < 0 where Im λ > 0; of a conjugate pair the one with Im θ > 0 is given.
            Ritz {
                value: theta.conj().inv() + shift,
                residual: (left / size).sqrt() / theta.norm(),
                vector: y.into_iter().map(|v| v.conj()).collect(),
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
