//! Lowest eigenvalues of the quadratic eigenvalue problem by shift-and-invert Arnoldi.
//!
//! Real arithmetic about a small real shift σ. Uncoupled groups of unknowns are searched separately, always
//! extending the one with the lowest converged eigenvalue. Without gyroscopic effect the block size is two,
//! to find the double eigenvalues of an axisymmetric rotor at rest, which rotation splits.

use super::dot::partial_sums;
use super::eigen::{self, EigenError};
use super::refinement::{NEGLIGIBLE, PreciseResidual, refine, relative_size};
use super::{BandLayout, BandLu, Complex64, DenseLu, GroupDense, SparseMatrix, Triplets};
use nalgebra::DMatrix;

/// Residual of an accepted Ritz pair relative to its value.
const TOLERANCE: f64 = 1e-11;
/// Ritz pairs with a larger residual are spurious (the operator is highly non-normal); those converging to a
/// true eigenvalue fall below it long before higher ones have converged.
const MAX_RITZ_RESIDUAL: f64 = 1e-3;
/// Below this many unknowns the dense solver is as fast.
const DENSE_BELOW: usize = 24;

/// An eigenpair of (λ² M + λ C + K) φ = 0.
#[derive(Clone, Debug, PartialEq)]
pub struct QuadraticPair {
    /// λ \[1/s\].
    pub value: Complex64,
    /// φ over all unknowns.
    pub vector: Vec<Complex64>,
    /// Index of its group of coupled unknowns.
    pub group: usize,
}

/// The oscillatory eigenpairs (Im λ > 0) of lowest |λ|, sorted by |λ|: the first `count` without a gap, if
/// they exist, and any further converged ones.
///
/// `shift` σ \[1/s\] > 0 should lie below the lowest frequency; rigid-body modes, |λ| < 1e-3 σ, and
/// overdamped modes are omitted.
///
/// # Errors
/// A singular shifted matrix, no convergence, or entries that are not finite.
pub fn lowest_eigenpairs(
    m: &SparseMatrix,
    c: &SparseMatrix,
    k: &SparseMatrix,
    count: usize,
    shift: f64,
) -> Result<Vec<QuadraticPair>, EigenError> {
    search([m, c, k], &BandLayout::new(&[m, c, k]), None, count, shift)
}

/// As [`lowest_eigenpairs`] with the damping C + `dense`, whose blocks are coupled by the sparsity `pattern`.
///
/// # Errors
/// As [`lowest_eigenpairs`].
pub fn lowest_eigenpairs_with(
    [m, c, k]: [&SparseMatrix; 3],
    (dense, pattern): (&GroupDense, &SparseMatrix),
    count: usize,
    shift: f64,
) -> Result<Vec<QuadraticPair>, EigenError> {
    search([m, c, k], &BandLayout::new(&[m, c, k, pattern]), Some(dense), count, shift)
}

fn search(
    matrices: [&SparseMatrix; 3],
    layout: &BandLayout,
    dense: Option<&GroupDense>,
    count: usize,
    shift: f64,
) -> Result<Vec<QuadraticPair>, EigenError> {
    let groups: Vec<&[usize]> = layout.groups().collect();
    let parts: Vec<CoupledGroup> =
        groups.iter().map(|unknowns| CoupledGroup::new(matrices, dense, unknowns, shift)).collect();
    let mut searches: Vec<Search> = parts.iter().map(Search::new).collect::<Result<_, _>>()?;
    loop {
        let mut sizes: Vec<f64> =
            searches.iter().flat_map(|s| s.converged.iter().map(|(value, _)| value.norm())).collect();
        sizes.sort_by(f64::total_cmp);
        let limit = sizes.get(count.max(1) - 1).copied().unwrap_or(f64::INFINITY);
        // Extend the group with the lowest reach until all groups reach the last of the wanted pairs.
        let behind = searches.iter_mut().filter(|s| s.reach < limit);
        let Some(least) = behind.min_by(|a, b| a.reach.total_cmp(&b.reach)) else { break };
        // A group's share of the modes is taken proportional to its number of unknowns.
        least.extend((count * least.part.order()).div_ceil(layout.size()))?;
    }
    let mut pairs: Vec<QuadraticPair> = Vec::new();
    for (group, (unknowns, search)) in groups.iter().zip(&searches).enumerate() {
        for (value, coordinates) in &search.converged {
            let mut vector = vec![Complex64::default(); layout.size()];
            for (&i, v) in unknowns.iter().zip(search.expand(coordinates)) {
                vector[i] = v;
            }
            pairs.push(QuadraticPair { value: *value, vector, group });
        }
    }
    pairs.sort_by(|a, b| a.value.norm().total_cmp(&b.value.norm()).then(a.group.cmp(&b.group)));
    Ok(pairs)
}

/// Vectors of the basis with which a search for `count` eigenpairs begins, each of the size of a complex shape; `block`: two
/// without gyroscopic effect, else one.
pub fn first_basis(count: usize, block: usize) -> usize {
    12 + (2 + block) * count
}

/// Whether λ is oscillatory with Im λ > 0, and not a rigid-body mode.
fn oscillatory(value: Complex64, shift: f64) -> bool {
    value.im > 1e-6 * value.norm() && value.norm() > 1e-3 * shift
}

/// Submatrix of a group of unknowns.
fn submatrix(a: &SparseMatrix, unknowns: &[usize]) -> SparseMatrix {
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

/// One group of coupled unknowns.
struct CoupledGroup {
    m: SparseMatrix,
    c: SparseMatrix,
    k: SparseMatrix,
    /// Further part of C, dense within groups.
    dense: Option<GroupDense>,
    /// C + σ M without the dense part.
    damp: SparseMatrix,
    /// K + σ C + σ² M without the dense part.
    shifted: SparseMatrix,
    layout: BandLayout,
    shift: f64,
}

impl CoupledGroup {
    fn new(matrices: [&SparseMatrix; 3], dense: Option<&GroupDense>, unknowns: &[usize], shift: f64) -> Self {
        let [m, c, k] = matrices.map(|a| submatrix(a, unknowns));
        let damp = SparseMatrix::sum(&[(1.0, &c), (shift, &m)]);
        let shifted = SparseMatrix::sum(&[(1.0, &k), (shift, &damp)]);
        let layout = BandLayout::new(&[&shifted]);
        let dense = dense.map(|dense| dense.submatrix(unknowns));
        Self { m, c, k, dense, damp, shifted, layout, shift }
    }

    fn order(&self) -> usize {
        self.m.rows()
    }

    /// All its oscillatory eigenpairs, each from the form of the problem that has it more accurately.
    ///
    /// With ω the largest |λ| and ε the round-off, the state matrix A gives λ within ε (ω/|λ|)², which loses the
    /// low modes beside a stiff spring, and (A − σ)⁻¹ within ε (|λ|/σ)². Both are equal at |λ|² = σ ω.
    fn solve_dense(&self) -> Result<Vec<(Complex64, Vec<Complex64>)>, EigenError> {
        let mut c = self.c.to_dense();
        if let Some(dense) = &self.dense {
            dense.add_to(1.0, &mut c);
        }
        let direct = eigen::quadratic(&self.m.to_dense(), &c, &self.k.to_dense())?;
        let fastest = direct.iter().map(|(value, _)| value.norm()).fold(self.shift, f64::max);
        let inverted = self.solve_inverted()?;
        let sizes = inverted.iter().map(|(value, _)| value.norm()).collect();
        let limit = widest_gap(sizes, (self.shift * fastest).sqrt());
        let low = inverted.into_iter().filter(|(value, _)| value.norm() < limit);
        let high = direct.into_iter().filter(|(value, _)| value.norm() >= limit);
        Ok(low.chain(high).filter(|(value, _)| oscillatory(*value, self.shift)).collect())
    }

    /// The eigenpairs of (A − σ)⁻¹ with Im λ ≥ 0, as pairs of the quadratic problem.
    fn solve_inverted(&self) -> Result<Vec<(Complex64, Vec<Complex64>)>, EigenError> {
        let operator = Arnoldi::new(self)?;
        let size = 2 * self.order();
        let unit = |j: usize| (0..size).map(|i| f64::from(u8::from(i == j))).collect::<Vec<_>>();
        let basis: Vec<Vec<f64>> = (0..size).map(unit).collect();
        let columns: Vec<Vec<f64>> = basis.iter().map(|x| operator.apply(x)).collect();
        let pairs = ritz_pairs(&columns, &basis, size, self.shift)?;
        Ok(pairs.into_iter().map(|r| (r.value, expand(&r.vector, &basis, self.order()))).collect())
    }
}

/// The middle of the widest gap between these values in the two decades about `centre`, on a logarithmic scale.
fn widest_gap(mut values: Vec<f64>, centre: f64) -> f64 {
    let (low, high) = (0.1 * centre, 10.0 * centre);
    values.retain(|v| (low..high).contains(v));
    values.extend([low, high]);
    values.sort_by(f64::total_cmp);
    let gaps = values.windows(2).map(|ends| (ends[1] / ends[0], (ends[0] * ends[1]).sqrt()));
    gaps.max_by(|a, b| a.0.total_cmp(&b.0)).map_or(centre, |(_, middle)| middle)
}

/// The eigenvalue search in one group.
struct Search<'a> {
    part: &'a CoupledGroup,
    /// Converged oscillatory eigenpairs; vectors in the Arnoldi basis, if any.
    converged: Vec<(Complex64, Vec<Complex64>)>,
    /// All oscillatory eigenvalues up to this |λ| have converged.
    reach: f64,
    arnoldi: Option<Arnoldi<'a>>,
}

impl<'a> Search<'a> {
    fn new(part: &'a CoupledGroup) -> Result<Self, EigenError> {
        if part.order() <= DENSE_BELOW {
            return Self::dense(part);
        }
        Ok(Self { part, converged: Vec::new(), reach: 0.0, arnoldi: Some(Arnoldi::new(part)?) })
    }

    fn dense(part: &'a CoupledGroup) -> Result<Self, EigenError> {
        Ok(Self { part, converged: part.solve_dense()?, reach: f64::INFINITY, arnoldi: None })
    }

    /// Extends the basis; the first one is sized for `share` pairs.
    fn extend(&mut self, share: usize) -> Result<(), EigenError> {
        let Some(arnoldi) = &mut self.arnoldi else { return Ok(()) };
        let size = match arnoldi.columns.len() {
            0 => first_basis(share, arnoldi.block),
            size => size + 8 + size / 8,
        };
        if size >= 2 * self.part.order() - arnoldi.block {
            // Nearly the full space: the dense solver is as fast.
            *self = Self::dense(self.part)?;
            return Ok(());
        }
        arnoldi.grow(size);
        let mut ritz = ritz_pairs(&arnoldi.columns, &arnoldi.basis, size, self.part.shift)?;
        // Overdamped eigenvalues accumulate at −1/β under damping β K and converge slowly: they are ignored.
        ritz.retain(|r| r.residual < MAX_RITZ_RESIDUAL && oscillatory(r.value, self.part.shift));
        let converged = ritz.iter().take_while(|r| r.residual < TOLERANCE).count();
        let last = ritz[..converged].last().map_or(0.0, |r| r.value.norm());
        // The next one is accurate enough to exclude any other below half of it.
        let next = ritz.get(converged).map_or(0.0, |r| 0.5 * r.value.norm());
        self.reach = last.max(next);
        ritz.truncate(converged);
        self.converged = ritz.into_iter().map(|r| (r.value, r.vector)).collect();
        Ok(())
    }

    /// The eigenvector over the group's unknowns.
    fn expand(&self, vector: &[Complex64]) -> Vec<Complex64> {
        match &self.arnoldi {
            Some(arnoldi) => expand(vector, &arnoldi.basis, self.part.order()),
            None => vector.to_vec(),
        }
    }
}

/// Factors of K + σ C + σ² M: banded, or dense if C has a dense part.
enum Factors<'a> {
    Band(BandLu<'a, f64>),
    Dense(DenseLu),
}

impl<'a> Factors<'a> {
    fn new(part: &'a CoupledGroup) -> Result<Self, EigenError> {
        let factors = match &part.dense {
            None => part.layout.factor(part.layout.scatter(&part.shifted)).ok().map(Self::Band),
            Some(dense) => {
                let mut matrix = part.shifted.to_dense();
                dense.add_to(part.shift, &mut matrix);
                DenseLu::new(&matrix).map(Self::Dense)
            }
        };
        factors.ok_or(EigenError::SingularShift)
    }

    fn solve(&self, b: &mut [f64]) {
        match self {
            Self::Band(lu) => lu.solve(b),
            Self::Dense(lu) => lu.solve(b),
        }
    }
}

/// Orthonormal basis of the Krylov space of (A − σ)⁻¹ over the states (q, v/σ), v = λ q.
///
/// The factor 1/σ balances the two halves of the wanted vectors.
struct Arnoldi<'a> {
    part: &'a CoupledGroup,
    lu: Factors<'a>,
    /// Whether round-off of the direct solution would show.
    refined: bool,
    /// Block size: number of start vectors.
    block: usize,
    basis: Vec<Vec<f64>>,
    /// Hessenberg matrix: column j is the image of basis vector j in the basis.
    columns: Vec<Vec<f64>>,
    noise: PseudoRandom,
}

impl<'a> Arnoldi<'a> {
    fn new(part: &'a CoupledGroup) -> Result<Self, EigenError> {
        let lu = Factors::new(part)?;
        let largest = part.c.iter().map(|(_, _, v)| v.abs()).fold(0.0, f64::max);
        let rotating = part.c.iter().any(|(i, j, v)| (v - part.c.get(j, i)).abs() > 1e-9 * largest);
        let block = if rotating { 1 } else { 2 };
        let noise = PseudoRandom(0x9E37_79B9_7F4A_7C15);
        let mut new = Self { part, lu, refined: false, block, basis: Vec::new(), columns: Vec::new(), noise };
        new.refined = new.shows_round_off();
        for _ in 0..block {
            let random: Vec<f64> = (0..2 * part.order()).map(|_| new.noise.next()).collect();
            let start = new.apply(&random);
            orthonormalise(start, &mut new.basis, &mut new.noise);
        }
        Ok(new)
    }

    /// Whether the direct solution under inertia of equal accelerations has errors that show.
    fn shows_round_off(&self) -> bool {
        let load = self.part.m.mul(&vec![1.0; self.part.order()]);
        let mut x = load.clone();
        self.lu.solve(&mut x);
        relative_size(&self.correction(&load, &x), &x) > NEGLIGIBLE
    }

    /// (K + σ C + σ² M)⁻¹ (b − (K + σ C + σ² M) x).
    fn correction(&self, b: &[f64], x: &[f64]) -> Vec<f64> {
        let mut residual = PreciseResidual::of(b);
        // Their sum is rounded, so that its rows no longer cancel for rigid-body motion.
        residual.subtract(1.0, &self.part.k, x);
        residual.subtract(self.part.shift, &self.part.damp, x);
        let mut out = residual.values();
        if let Some(dense) = &self.part.dense {
            // Damping acts on what the motion is, not on small differences of it: its products need no more digits.
            dense.mul_add(-self.part.shift, x, &mut out);
        }
        self.lu.solve(&mut out);
        out
    }

    /// (A − σ)⁻¹ x.
    fn apply(&self, x: &[f64]) -> Vec<f64> {
        let (n, shift) = (self.part.order(), self.part.shift);
        let (a, b) = x.split_at(n);
        let mut q = vec![0.0; n];
        self.part.m.mul_add(-shift, b, &mut q);
        self.part.damp.mul_add(-1.0, a, &mut q);
        if let Some(dense) = &self.part.dense {
            dense.mul_add(-1.0, a, &mut q);
        }
        if self.refined {
            let load = q.clone();
            self.lu.solve(&mut q);
            refine(&mut q, |q| self.correction(&load, q));
        } else {
            self.lu.solve(&mut q);
        }
        let v: Vec<f64> = q.iter().zip(a).map(|(q, a)| q + a / shift).collect();
        q.extend(v);
        q
    }

    /// Continues to `size` columns.
    fn grow(&mut self, size: usize) {
        while self.columns.len() < size {
            let image = self.apply(&self.basis[self.columns.len()]);
            self.columns.push(orthonormalise(image, &mut self.basis, &mut self.noise));
        }
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

/// Appends x, orthonormalised against the basis (Gram-Schmidt); returns its coordinates (the last is its
/// remaining length).
fn orthonormalise(mut x: Vec<f64>, basis: &mut Vec<Vec<f64>>, noise: &mut PseudoRandom) -> Vec<f64> {
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
        // Invariant subspace (breakdown): continue with a random direction.
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

/// Dot product in four partial sums, which the compiler can vectorise.
fn dot(a: &[f64], b: &[f64]) -> f64 {
    let (sums, tail) = partial_sums(a, b);
    sums.iter().sum::<f64>() + tail
}

fn norm(x: &[f64]) -> f64 {
    dot(x, x).sqrt()
}

/// Fixed pseudo-random numbers in (−1, 1) (xorshift64), for bitwise reproducible runs.
struct PseudoRandom(u64);

impl PseudoRandom {
    fn next(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }
}
