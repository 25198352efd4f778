//! Arnoldi iteration with the inverted operator (A − σ)⁻¹ of the quadratic eigenvalue problem.

use super::Complex64;
use super::coupled_group::{CoupledGroup, Factors};
use super::dot::dot_in_sixteens;
use super::eigen::{self, EigenError};
use super::hessenberg;
use super::refinement::{NEGLIGIBLE, PreciseResidual, refine, relative_size};
use nalgebra::DMatrix;
use pulp::{Arch, NullaryFnOnce};

/// Fraction of its length that a vector may lose in orthogonalisation before that is repeated (Daniel et al. 1976).
const MAX_CANCELLATION: f64 = 0.5;
/// Images between two looks at the residuals of pairs that are to converge.
const CHECKED_EVERY: usize = 4;

/// Orthonormal basis of the Krylov space of (A − σ)⁻¹ over the states (q, v/σ), v = λ q.
///
/// The factor 1/σ balances the two halves of the wanted vectors.
pub(super) struct Arnoldi<'a> {
    group: &'a CoupledGroup,
    lu: Factors<'a>,
    /// Whether round-off of the direct solution would show.
    refined: bool,
    /// Block size: number of start vectors.
    pub block: usize,
    basis: Vec<Vec<f64>>,
    /// Hessenberg matrix: column j is the image of basis vector j in the basis.
    columns: Vec<Vec<f64>>,
    /// Whether the space became invariant, so that it went on from another vector.
    restarted: bool,
    noise: PseudoRandom,
}

impl<'a> Arnoldi<'a> {
    pub fn new(group: &'a CoupledGroup) -> Result<Self, EigenError> {
        let lu = Factors::new(group)?;
        let mut new = Self {
            group,
            lu,
            refined: false,
            block: if group.is_gyroscopic() { 1 } else { 2 },
            basis: Vec::new(),
            columns: Vec::new(),
            restarted: false,
            noise: PseudoRandom(0x9E37_79B9_7F4A_7C15),
        };
        new.refined = new.shows_round_off();
        Ok(new)
    }

    /// Whether the direct solution under inertia of equal accelerations has errors that show.
    fn shows_round_off(&self) -> bool {
        let load = self.group.m.mul(&vec![1.0; self.group.order()]);
        let mut x = load.clone();
        self.lu.solve(&mut x);
        relative_size(&self.correction(&load, &x), &x) > NEGLIGIBLE
    }

    /// (K + σ C + σ² M)⁻¹ (b − (K + σ C + σ² M) x).
    fn correction(&self, b: &[f64], x: &[f64]) -> Vec<f64> {
        let mut residual = PreciseResidual::of(b);
        // Their sum is rounded, so that its rows no longer cancel for rigid-body motion.
        residual.subtract(1.0, &self.group.k, x);
        residual.subtract(self.group.shift, &self.group.damp, x);
        let mut out = residual.values();
        if let Some(dense) = &self.group.dense {
            // Damping acts on what the motion is, not on small differences of it: its products need no more digits.
            dense.mul_add(-self.group.shift, x, &mut out);
        }
        self.lu.solve(&mut out);
        out
    }

    /// (A − σ)⁻¹ x.
    pub fn apply(&self, x: &[f64]) -> Vec<f64> {
        let (n, shift) = (self.group.order(), self.group.shift);
        let (a, b) = x.split_at(n);
        let mut q = vec![0.0; n];
        self.group.m.mul_add(-shift, b, &mut q);
        self.group.damp.mul_add(-1.0, a, &mut q);
        if let Some(dense) = &self.group.dense {
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

    /// Number of images in the basis.
    pub fn size(&self) -> usize {
        self.columns.len()
    }

    /// Continues to `size` images.
    pub fn grow(&mut self, size: usize) {
        while self.basis.len() < self.block {
            let random: Vec<f64> = (0..2 * self.group.order()).map(|_| self.noise.next()).collect();
            self.add_to_basis(self.apply(&random));
        }
        while self.columns.len() < size {
            let image = self.apply(&self.basis[self.columns.len()]);
            let column = self.add_to_basis(image);
            self.columns.push(column);
        }
    }

    /// Continues until all these Ritz pairs have residuals below a limit, or to `size` images.
    pub fn grow_until(&mut self, size: usize, pairs: &mut [Ritz], limit: f64) {
        let mut open = if self.block == 1 { pairs.len() } else { 0 };
        if open == 0 {
            return self.grow(size);
        }
        while open > 0 && self.size() < size {
            self.grow((self.size() + CHECKED_EVERY).min(size));
            if self.restarted {
                return self.grow(size);
            }
            let h = self.hessenberg();
            // The last one converges last.
            while open > 0 && self.follow(&h, &mut pairs[open - 1]) < limit {
                open -= 1;
            }
        }
    }

    /// Moves a Ritz pair to the nearest one of the present basis; its residual.
    fn follow(&self, h: &DMatrix<f64>, ritz: &mut Ritz) -> f64 {
        let theta = (ritz.value - self.group.shift).inv();
        let vector = hessenberg::nearest_eigenvector(h, theta);
        let image = hessenberg::image(h, &vector);
        let theta: Complex64 = vector.iter().zip(&image).map(|(v, i)| v.conj() * i).sum();
        ritz.value = theta.inv() + self.group.shift;
        self.last_subdiagonal() * vector.last().map_or(0.0, |v| v.norm()) / theta.norm()
    }

    fn hessenberg(&self) -> DMatrix<f64> {
        let size = self.size();
        DMatrix::from_fn(size, size, |i, j| self.columns[j].get(i).copied().unwrap_or(0.0))
    }

    fn last_subdiagonal(&self) -> f64 {
        self.columns.last().and_then(|column| column.last()).copied().unwrap_or(0.0)
    }

    /// Appends x, orthonormalised against the basis; returns its coordinates (the last is its remaining length).
    fn add_to_basis(&mut self, mut x: Vec<f64>) -> Vec<f64> {
        let mut h = vec![0.0; self.basis.len()];
        let before = norm(&x);
        let mut length = project_out(&mut x, &self.basis, &mut h);
        if length < MAX_CANCELLATION * before {
            // Twice is enough (Parlett & Kahan).
            length = project_out(&mut x, &self.basis, &mut h);
        }
        if length > 1e-13 * before && length > 0.0 {
            h.push(length);
        } else {
            // Invariant subspace (breakdown): continue with a random direction.
            self.restarted = !self.columns.is_empty() || self.restarted;
            h.push(0.0);
            x = (0..x.len()).map(|_| self.noise.next()).collect();
            for _ in 0..2 {
                length = project_out(&mut x, &self.basis, &mut vec![0.0; h.len() - 1]);
            }
        }
        x.iter_mut().for_each(|v| *v /= length);
        self.basis.push(x);
        h
    }

    /// Oscillatory Ritz pairs, lowest |λ| first.
    pub fn ritz_pairs(&self) -> Result<Box<dyn Iterator<Item = Ritz> + '_>, EigenError> {
        let (size, shift) = (self.columns.len(), self.group.shift);
        let h = self.hessenberg();
        if self.block == 1 && !self.restarted {
            let thetas = hessenberg::eigenvalues(&h)?.into_iter().filter(|theta| theta.im < 0.0);
            // θ = 1/(λ − σ) has Im θ < 0 where Im λ > 0.
            let mut values: Vec<(Complex64, Complex64)> = thetas.map(|t| (t.inv() + shift, t)).collect();
            values.sort_by(|a, b| a.0.norm().total_cmp(&b.0.norm()).then(a.0.im.total_cmp(&b.0.im)));
            let next = self.last_subdiagonal();
            return Ok(Box::new(values.into_iter().map(move |(value, theta)| {
                let vector = hessenberg::eigenvector(&h, theta);
                let last = vector.last().map_or(0.0, |v| v.norm());
                Ritz { value, residual: next * last / theta.norm(), vector }
            })));
        }
        let rest = DMatrix::from_fn(self.basis.len() - size, size, |i, j| {
            self.columns[j].get(size + i).copied().unwrap_or(0.0)
        });
        let mut ritz = Vec::new();
        for (theta, y) in eigen::general_small(&h)?.into_iter().filter(|(theta, _)| theta.norm() > 0.0) {
            let image =
                |r: nalgebra::RowDVector<f64>| r.iter().zip(&y).map(|(h, y)| y * *h).sum::<Complex64>();
            let left: f64 = rest.row_iter().map(|r| image(r.into_owned()).norm_sqr()).sum();
            let length: f64 = y.iter().map(|v| v.norm_sqr()).sum();
            // Of a conjugate pair the one with Im θ > 0 is given.
            ritz.push(Ritz {
                value: theta.conj().inv() + shift,
                residual: (left / length).sqrt() / theta.norm(),
                vector: y.into_iter().map(|v| v.conj()).collect(),
            });
        }
        ritz.sort_by(|a, b| {
            a.value.norm().total_cmp(&b.value.norm()).then(a.value.im.total_cmp(&b.value.im))
        });
        Ok(Box::new(ritz.into_iter()))
    }

    /// The first half (q) of the state vector with these coordinates in the basis.
    pub fn expand(&self, y: &[Complex64]) -> Vec<Complex64> {
        let mut q = vec![Complex64::default(); self.group.order()];
        for (&y, b) in y.iter().zip(&self.basis) {
            for (q, &b) in q.iter_mut().zip(b) {
                *q += y * b;
            }
        }
        q
    }
}

/// An approximate eigenpair from the basis, Im λ > 0 of a conjugate pair.
pub(super) struct Ritz {
    pub value: Complex64,
    /// Coordinates in the basis.
    pub vector: Vec<Complex64>,
    /// ‖A x − θ x‖ / |θ|.
    pub residual: f64,
}

/// Takes the parts along the basis from x and adds them to h (classical Gram-Schmidt); what remains of the length.
fn project_out(x: &mut [f64], basis: &[Vec<f64>], h: &mut [f64]) -> f64 {
    // Compiled for the widest vectors; sums have one order on every processor.
    Arch::new().dispatch(Projection { x, basis, h })
}

/// In place of a closure, which would not be inlined into the code for each set of vector instructions.
struct Projection<'a> {
    x: &'a mut [f64],
    basis: &'a [Vec<f64>],
    h: &'a mut [f64],
}

impl NullaryFnOnce for Projection<'_> {
    type Output = f64;

    #[inline(always)]
    fn call(self) -> f64 {
        let Self { x, basis, h } = self;
        let mut parts = Vec::with_capacity(basis.len());
        for b in basis {
            parts.push(dot_in_sixteens(b, x));
        }
        for (b, part) in basis.iter().zip(&parts) {
            for (x, b) in x.iter_mut().zip(b) {
                *x -= part * b;
            }
        }
        h.iter_mut().zip(&parts).for_each(|(h, part)| *h += part);
        dot_in_sixteens(x, x).sqrt()
    }
}

fn norm(x: &[f64]) -> f64 {
    dot_in_sixteens(x, x).sqrt()
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{SparseMatrix, Triplets};

    /// M, C, K of a whirling chain of masses with springs, in two directions: gyroscopic coupling, damping of the springs and
    /// its circulatory part.
    fn chain(masses: usize, [stiffness, speed, damping, circulatory]: [f64; 4]) -> [SparseMatrix; 3] {
        let n = 2 * masses;
        let [mut m, mut c, mut k] = [(); 3].map(|()| Triplets::new(n, n));
        for axis in 0..2 {
            let sign = if axis == 0 { 1.0 } else { -1.0 };
            for i in 0..masses {
                let [own, other] = [2 * i + axis, 2 * i + 1 - axis];
                m.add(own, own, if i == masses / 2 { 11.0 } else { 1.0 });
                c.add(own, other, sign * 0.3 * speed);
                let neighbours = [(i, 2.0), (i.wrapping_sub(1), -1.0), (i + 1, -1.0)];
                for (j, part) in neighbours.into_iter().filter(|(j, _)| *j < masses) {
                    k.add(own, 2 * j + axis, part * stiffness);
                    c.add(own, 2 * j + axis, part * stiffness * damping);
                    k.add(own, 2 * j + 1 - axis, part * sign * stiffness * circulatory);
                }
            }
        }
        [m, c, k].map(Triplets::build)
    }

    #[test]
    fn the_lowest_ritz_value_is_an_eigenvalue_whatever_the_damping_and_speed() {
        let mut random = PseudoRandom(12345);
        for case in 0..400 {
            let masses = 15 + case % 20;
            let [speed, zeta, stiffness] = [(0.0, 3.0), (-7.0, 2.0), (6.0, 2.0)]
                .map(|(mean, range)| 10f64.powf(mean + range * random.next()));
            let damping = if case % 3 == 0 { 0.0 } else { zeta };
            let circulatory = if case % 2 == 0 { 0.0 } else { damping * speed };
            let matrices = chain(masses, [stiffness, speed, damping, circulatory]);
            let [m, c, k] = [&matrices[0], &matrices[1], &matrices[2]];
            let all: Vec<usize> = (0..2 * masses).collect();
            let group = CoupledGroup::new([m, c, k], None, &all, 30.0);
            let mut arnoldi = Arnoldi::new(&group).unwrap();
            for size in [12, 18, 27, 44] {
                arnoldi.grow(size);
                let found = arnoldi.ritz_pairs();
                assert!(found.is_ok(), "case {case}, {size} vectors");
            }
            let lowest = arnoldi.ritz_pairs().unwrap().find(|ritz| ritz.residual < 1e-3).unwrap();
            assert!(lowest.residual < 1e-8, "case {case}: {:e}", lowest.residual);
            // ‖(λ² M + λ C + K) φ‖ against the size of its terms.
            let (lambda, shape) = (lowest.value, arnoldi.expand(&lowest.vector));
            let [inertia, damper, spring] = [m, c, k].map(|a| a.mul_complex(&shape));
            let size = spring.iter().map(|v| v.norm()).fold(0.0, f64::max);
            for i in 0..shape.len() {
                let rest = lambda * lambda * inertia[i] + lambda * damper[i] + spring[i];
                assert!(rest.norm() < 1e-6 * size, "case {case}, row {i}: {rest} of {size}");
            }
        }
    }
}
