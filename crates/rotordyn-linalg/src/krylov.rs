//! Lowest eigenvalues of the quadratic eigenvalue problem by shift-and-invert Arnoldi.
//!
//! Real arithmetic about a small real shift σ. Uncoupled groups of unknowns are searched separately, always
//! extending the one with the lowest converged eigenvalue, until the wanted ones have converged. Without gyroscopic effect the block size is two,
//! to find the double eigenvalues of an axisymmetric rotor at rest, which rotation splits.

use super::arnoldi::{Arnoldi, Ritz};
use super::coupled_group::CoupledGroup;
use super::eigen::{self, EigenError};
use super::rayleigh::RayleighFunctional;
use super::{BandLayout, Complex64, GroupDense, SparseMatrix};
use nalgebra::DMatrix;

/// Residual of an accepted Ritz pair relative to its value.
const TOLERANCE: f64 = 1e-11;
/// Ritz pairs with a larger residual are spurious (the operator is highly non-normal); those converging to a
/// true eigenvalue fall below it long before higher ones have converged.
const MAX_RITZ_RESIDUAL: f64 = 1e-3;
/// Values up to this multiple of another may be its double, split by round-off.
const DOUBLE: f64 = 1.0 + 1e-4;

/// Smallest Im λ/|λ| of an oscillatory mode: ζ < 0.9999995; and of one that grows.
const LEAST_IMAGINARY: f64 = 1e-3;
const ROUND_OFF: f64 = 1e-6;

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
/// overdamped modes, ζ > 0.9999995, are omitted.
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
    lowest_eigenpairs_with([m, c, k], None, &BandLayout::new(&[m, c, k]), count, shift)
}

/// As [`lowest_eigenpairs`], with a known layout for the matrices and the damping C + `dense`, whose groups are those of the
/// layout.
///
/// # Errors
/// As [`lowest_eigenpairs`].
pub fn lowest_eigenpairs_with(
    matrices: [&SparseMatrix; 3],
    dense: Option<&GroupDense>,
    layout: &BandLayout,
    count: usize,
    shift: f64,
) -> Result<Vec<QuadraticPair>, EigenError> {
    let groups: Vec<&[usize]> = layout.groups().collect();
    let parts: Vec<CoupledGroup> =
        groups.iter().map(|unknowns| CoupledGroup::new(matrices, dense, unknowns, shift)).collect();
    let mut searches: Vec<Search> = parts.iter().map(Search::new).collect::<Result<_, _>>()?;
    loop {
        let converged = searches.iter().flat_map(|s| s.converged.iter().map(|(value, _)| *value));
        let limit = nth_size(converged.clone(), count);
        let expected = nth_size(converged.chain(searches.iter().flat_map(Search::expected)), count);
        // Extend the group with the lowest reach until all groups reach the last of the wanted pairs.
        let behind = searches.iter_mut().filter(|s| s.is_behind(limit));
        let Some(least) = behind.min_by(|a, b| a.reach.total_cmp(&b.reach)) else { break };
        // A group's share of the modes is taken proportional to its number of unknowns.
        least.extend((count * least.part.order()).div_ceil(layout.size()), count, expected)?;
    }
    let functional = RayleighFunctional::new(matrices, dense);
    let mut pairs: Vec<QuadraticPair> = Vec::new();
    for (group, (unknowns, search)) in groups.iter().zip(&searches).enumerate() {
        for (value, coordinates) in &search.converged {
            let mut vector = vec![Complex64::default(); layout.size()];
            for (&i, v) in unknowns.iter().zip(search.expand(coordinates)) {
                vector[i] = v;
            }
            pairs.push(QuadraticPair { value: functional.corrected(*value, &vector), vector, group });
        }
    }
    pairs.sort_by(|a, b| a.value.norm().total_cmp(&b.value.norm()).then(a.group.cmp(&b.group)));
    Ok(pairs)
}

/// Vectors of the basis with which a search for `count` eigenpairs begins, each of the size of a complex shape; `block`: two
/// without gyroscopic effect, else one.
pub fn first_basis(count: usize, block: usize) -> usize {
    8 + (3 + block) * count
}

/// The `count`-th |λ| in ascending order, or infinity.
fn nth_size(values: impl Iterator<Item = Complex64>, count: usize) -> f64 {
    let mut sizes: Vec<f64> = values.map(|value| value.norm()).collect();
    sizes.sort_by(f64::total_cmp);
    sizes.get(count.max(1) - 1).copied().unwrap_or(f64::INFINITY)
}

/// Whether λ is oscillatory with Im λ > 0, and not a rigid-body mode.
///
/// Gyroscopic coupling and round-off give overdamped modes a small imaginary part, in clusters at −1/β under damping β K.
/// Modes that grow are kept.
fn oscillatory(value: Complex64, shift: f64) -> bool {
    let least = if value.re < 0.0 { LEAST_IMAGINARY } else { ROUND_OFF };
    value.im > least * value.norm() && value.norm() > 1e-3 * shift
}

/// Eigenpairs over the unknowns of a group.
type GroupPairs = Vec<(Complex64, Vec<Complex64>)>;

/// All oscillatory eigenpairs of a group, each from the form of the problem that has it more accurately.
///
/// With ω the largest |λ| and ε the round-off, the state matrix A gives λ within ε (ω/|λ|)², which loses the low modes
/// beside a stiff spring, and (A − σ)⁻¹ within ε (|λ|/σ)². Both are equal at |λ|² = σ ω.
fn all_eigenpairs(group: &CoupledGroup) -> Result<GroupPairs, EigenError> {
    let mut c = group.c.to_dense();
    if let Some(dense) = &group.dense {
        dense.add_to(1.0, &mut c);
    }
    let direct = eigen::quadratic(&group.m.to_dense(), &c, &group.k.to_dense())?;
    let fastest = direct.iter().map(|(value, _)| value.norm()).fold(group.shift, f64::max);
    let inverted = inverted_eigenpairs(group)?;
    let sizes = inverted.iter().map(|(value, _)| value.norm()).collect();
    let limit = widest_gap(sizes, (group.shift * fastest).sqrt());
    let low = inverted.into_iter().filter(|(value, _)| value.norm() < limit);
    let high = direct.into_iter().filter(|(value, _)| value.norm() >= limit);
    Ok(low.chain(high).filter(|(value, _)| oscillatory(*value, group.shift)).collect())
}

/// The eigenpairs of (A − σ)⁻¹ with Im λ ≥ 0, as pairs of the quadratic problem.
fn inverted_eigenpairs(group: &CoupledGroup) -> Result<GroupPairs, EigenError> {
    let operator = Arnoldi::new(group)?;
    let size = 2 * group.order();
    let mut inverse = DMatrix::zeros(size, size);
    let mut unit = vec![0.0; size];
    for j in 0..size {
        unit[j] = 1.0;
        inverse.column_mut(j).copy_from_slice(&operator.apply(&unit));
        unit[j] = 0.0;
    }
    let pairs = eigen::general_small(&inverse)?.into_iter().filter(|(theta, _)| theta.norm() > 0.0);
    // θ = 1/(λ − σ) of a pair has Im θ > 0 where Im λ < 0.
    let pair = |(theta, state): (Complex64, Vec<Complex64>)| {
        let shape = state[..group.order()].iter().map(Complex64::conj).collect();
        (theta.conj().inv() + group.shift, shape)
    };
    Ok(pairs.map(pair).collect())
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
    /// Oscillatory Ritz pairs that are near an eigenvalue and have not converged, lowest |λ| first.
    near: Vec<Ritz>,
    /// All oscillatory eigenvalues up to this |λ| have converged.
    reach: f64,
    arnoldi: Option<Arnoldi<'a>>,
}

impl<'a> Search<'a> {
    fn new(part: &'a CoupledGroup) -> Result<Self, EigenError> {
        Ok(Self {
            part,
            converged: Vec::new(),
            near: Vec::new(),
            reach: 0.0,
            arnoldi: Some(Arnoldi::new(part)?),
        })
    }

    fn dense(part: &'a CoupledGroup) -> Result<Self, EigenError> {
        Ok(Self {
            part,
            converged: all_eigenpairs(part)?,
            near: Vec::new(),
            reach: f64::INFINITY,
            arnoldi: None,
        })
    }

    /// Values that the unconverged Ritz pairs approximate.
    fn expected(&self) -> impl Iterator<Item = Complex64> + Clone + '_ {
        self.near.iter().map(|ritz| ritz.value)
    }

    /// Whether a pair up to this |λ|, or the other one of a double eigenvalue there, may not have converged.
    fn is_behind(&self, limit: f64) -> bool {
        self.reach < limit || self.near.iter().any(|ritz| ritz.value.norm() < DOUBLE * limit)
    }

    /// Extends the basis; the first one is sized for `share` pairs, later ones so that those up to |λ| = `limit`, or all near
    /// ones if there is none beyond, converge. More than `most` pairs are not looked at.
    fn extend(&mut self, share: usize, most: usize, limit: f64) -> Result<(), EigenError> {
        let Some(arnoldi) = &mut self.arnoldi else { return Ok(()) };
        let size = match arnoldi.size() {
            0 => first_basis(share, arnoldi.block),
            size if self.near.is_empty() || arnoldi.block > 1 => size + 8 + size / 8,
            // At most: it ends where the near ones have converged.
            size => size + 16 + size / 4,
        };
        if size >= 2 * self.part.order() - arnoldi.block {
            // Nearly the full space: the dense solver is as fast.
            *self = Self::dense(self.part)?;
            return Ok(());
        }
        let wanted = self.near.iter().take_while(|ritz| ritz.value.norm() <= limit).count() + 1;
        self.near.truncate(wanted);
        arnoldi.grow_until(size, &mut self.near, TOLERANCE);
        self.converged.clear();
        self.near.clear();
        self.reach = 0.0;
        // Overdamped eigenvalues accumulate at −1/β under damping β K and converge slowly: they are ignored.
        let shift = self.part.shift;
        let found = arnoldi.ritz_pairs()?.filter(|r| oscillatory(r.value, shift));
        for ritz in found.filter(|r| r.residual < MAX_RITZ_RESIDUAL) {
            if ritz.residual < TOLERANCE && self.near.is_empty() {
                self.reach = ritz.value.norm();
                self.converged.push((ritz.value, ritz.vector));
            } else {
                self.near.push(ritz);
            }
            if self.converged.len() + self.near.len() > most {
                break;
            }
        }
        if let Some(first) = self.near.first() {
            // Accurate enough to exclude any other below half of it.
            self.reach = self.reach.max(0.5 * first.value.norm());
        }
        Ok(())
    }

    /// The eigenvector over the group's unknowns.
    fn expand(&self, vector: &[Complex64]) -> Vec<Complex64> {
        self.arnoldi.as_ref().map_or_else(|| vector.to_vec(), |arnoldi| arnoldi.expand(vector))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    /// Mass, stiffness and gyroscopic matrices of a shaft of Euler beams in both planes with a disc in the middle, on springs
    /// at its ends; unknowns u_x, θ_y, u_y, −θ_x of each node.
    fn rotor(elements: usize, length: f64, spring: f64) -> [DMatrix<f64>; 3] {
        let (l, d, e, rho) = (length / elements as f64, 0.04_f64, 210e9, 7850.0);
        let (area, inertia) = (PI * d * d / 4.0, PI * d.powi(4) / 64.0);
        let n = 4 * (elements + 1);
        let [mut m, mut k, mut g] = [(); 3].map(|()| DMatrix::zeros(n, n));
        let stiff = [
            [12.0, 6.0 * l, -12.0, 6.0 * l],
            [6.0 * l, 4.0 * l * l, -6.0 * l, 2.0 * l * l],
            [-12.0, -6.0 * l, 12.0, -6.0 * l],
            [6.0 * l, 2.0 * l * l, -6.0 * l, 4.0 * l * l],
        ];
        let mass = [
            [156.0, 22.0 * l, 54.0, -13.0 * l],
            [22.0 * l, 4.0 * l * l, 13.0 * l, -3.0 * l * l],
            [54.0, 13.0 * l, 156.0, -22.0 * l],
            [-13.0 * l, -3.0 * l * l, -22.0 * l, 4.0 * l * l],
        ];
        for element in 0..elements {
            for plane in [0, 2] {
                let at = |i: usize| 4 * (element + i / 2) + plane + i % 2;
                for (i, j) in (0..4).flat_map(|i| (0..4).map(move |j| (i, j))) {
                    k[(at(i), at(j))] += e * inertia / l.powi(3) * stiff[i][j];
                    m[(at(i), at(j))] += rho * area * l / 420.0 * mass[i][j];
                }
            }
        }
        let disc = 4 * (elements / 2);
        for (i, added) in [(0, 16.0), (1, 0.09), (2, 16.0), (3, 0.09)] {
            m[(disc + i, disc + i)] += added;
        }
        (g[(disc + 1, disc + 3)], g[(disc + 3, disc + 1)]) = (0.18, -0.18);
        for i in [0, 2, n - 4, n - 2] {
            k[(i, i)] += spring;
        }
        [m, k, g]
    }

    /// Rotors with much damping of the shaft, whose overdamped modes crowd at −1/β, or with stiff dampers at its ends: the
    /// lowest modes are found whatever the number asked for. With β K alone they are those of the closed form
    /// λ = −β ω²/2 ± j ω √(1 − (β ω/2)²).
    #[test]
    fn strong_damping_does_not_stop_the_search() {
        let shaft = |beta| (beta, 0.0);
        let damped =
            [1e-5, 1e-4, 5e-4, 1e-3, 1e-2].map(shaft).into_iter().chain([(0.0, 1e6), (0.0, 1e8), (0.0, 1e9)]);
        for (beta, damper) in damped {
            for (elements, speed, count) in
                [(16, 1e-7, 8), (16, 1e-7, 16), (16, 39.0, 12), (16, 39.0, 16), (20, 314.0, 16)]
            {
                let [m, k, g] = rotor(elements, 0.8, 2e7);
                let mut c = &k * beta + &g * speed;
                let n = c.nrows();
                [0, 2, n - 4, n - 2].iter().for_each(|&i| c[(i, i)] += damper);
                let [ms, cs, ks] = [&m, &c, &k].map(SparseMatrix::from_dense);
                let case = format!("β = {beta} s, {damper} N s/m, {speed} rad/s, {count} modes");
                let found = lowest_eigenpairs(&ms, &cs, &ks, count, 30.0).expect(&case);
                let (squares, _) = eigen::undamped(&k, &m, 1.0).unwrap();
                let ratio = |square: &f64| 0.5 * beta * square.sqrt();
                let clearly =
                    squares.iter().take(count).filter(|square| damper == 0.0 && ratio(square) < 0.9);
                assert!(found.len() >= clearly.count(), "{case}: {}", found.len());
                for pair in &found {
                    assert!(
                        rest([&m, &c, &k], pair) < 1e-7,
                        "{case}: {} {:e}",
                        pair.value,
                        rest([&m, &c, &k], pair)
                    );
                }
                if speed > 1.0 || damper > 0.0 {
                    continue;
                }
                let oscillating = squares.iter().filter(|square| ratio(square) < 0.9999).take(count);
                for (square, found) in oscillating.zip(&found) {
                    let zeta = ratio(square);
                    let expected = square.sqrt() * Complex64::new(-zeta, (1.0 - zeta * zeta).sqrt());
                    assert!(
                        (expected - found.value).norm() < 1e-7 * expected.norm(),
                        "{case}: {expected} {}",
                        found.value
                    );
                }
            }
        }
    }

    /// ‖(λ² M + λ C + K) φ‖ over ‖|K| |φ|‖, which round-off is of.
    fn rest(matrices: [&DMatrix<f64>; 3], pair: &QuadraticPair) -> f64 {
        let shape = nalgebra::DVector::from_vec(pair.vector.clone());
        let products = matrices
            .into_iter()
            .zip([2, 1, 0])
            .map(|(a, power)| a.map(Complex64::from) * &shape * pair.value.powi(power));
        let size = (matrices[2].abs() * shape.map(|v| v.norm())).norm();
        products.sum::<nalgebra::DVector<Complex64>>().norm() / size
    }
}
