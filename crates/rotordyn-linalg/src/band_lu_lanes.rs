//! Banded LU factorisation of several complex matrices of one layout at once, such as dynamic stiffnesses at neighbouring
//! frequencies.
//!
//! The matrices lie side by side, number for number: one vector instruction does the same step in each. They exchange the
//! same rows, so the pivots are those that are large in all of them (threshold pivoting).

use super::band_lu::{BandLayout, Block};
use crate::{Complex64, SparseMatrix, SparseRow};
use pulp::{Arch, NullaryFnOnce};
use std::sync::Arc;

/// Matrices side by side.
pub const LANES: usize = 8;
/// Least size of a pivot relative to the largest candidate of its matrix: round-off grows at most by the inverse at a step.
const LEAST_PIVOT: f64 = 0.1;

/// A complex number of each matrix.
#[derive(Clone, Copy, Debug, Default)]
pub struct ComplexLanes {
    pub re: [f64; LANES],
    pub im: [f64; LANES],
}

impl ComplexLanes {
    /// The number of one matrix.
    pub fn lane(&self, lane: usize) -> Complex64 {
        Complex64::new(self.re[lane], self.im[lane])
    }

    /// Sets the number of one matrix.
    pub fn set_lane(&mut self, lane: usize, z: Complex64) {
        (self.re[lane], self.im[lane]) = (z.re, z.im);
    }

    /// Adds `factor` z.
    pub fn add_scaled(&mut self, factor: f64, z: &Self) {
        for k in 0..LANES {
            self.re[k] += factor * z.re[k];
            self.im[k] += factor * z.im[k];
        }
    }

    #[inline(always)]
    fn subtract_product(&mut self, a: &Self, b: &Self) {
        for k in 0..LANES {
            self.re[k] = self.re[k] - a.re[k] * b.re[k] + a.im[k] * b.im[k];
            self.im[k] = self.im[k] - a.re[k] * b.im[k] - a.im[k] * b.re[k];
        }
    }

    #[inline(always)]
    fn product(&self, by: &Self) -> Self {
        let mut out = Self::default();
        for k in 0..LANES {
            out.re[k] = self.re[k] * by.re[k] - self.im[k] * by.im[k];
            out.im[k] = self.re[k] * by.im[k] + self.im[k] * by.re[k];
        }
        out
    }

    #[inline(always)]
    fn inverse(&self) -> Self {
        let mut out = Self::default();
        for k in 0..LANES {
            let square = self.re[k] * self.re[k] + self.im[k] * self.im[k];
            out.re[k] = self.re[k] / square;
            out.im[k] = -self.im[k] / square;
        }
        out
    }

    #[inline(always)]
    fn is_zero(&self) -> bool {
        self.re == [0.0; LANES] && self.im == [0.0; LANES]
    }

    #[inline(always)]
    fn norm1(&self) -> [f64; LANES] {
        std::array::from_fn(
            #[inline(always)]
            |k| self.re[k].abs() + self.im[k].abs(),
        )
    }
}

/// Product of a sparse row with the vectors of all matrices.
pub fn dot_lanes(row: &SparseRow, x: &[ComplexLanes]) -> ComplexLanes {
    let mut sum = ComplexLanes::default();
    row.0.iter().for_each(|&(i, v)| sum.add_scaled(v, &x[i]));
    sum
}

/// LU factors of the dynamic stiffness S − ω² M + jω D of [`LANES`] systems or frequencies.
///
/// Compiled for the widest vectors of the processor, with the same rounding on every one.
pub struct BandLuLanes {
    layout: Arc<BandLayout>,
    values: Vec<ComplexLanes>,
    factors: Factors,
    arch: Arch,
}

/// What the elimination leaves beside the upper factor.
struct Factors {
    pivots: Vec<usize>,
    /// Those of every column, one after another: a solution runs along them.
    multipliers: Vec<ComplexLanes>,
    /// Inverses of the pivots.
    inverses: Vec<ComplexLanes>,
}

impl BandLuLanes {
    /// Memory for the factors of matrices of a layout.
    pub fn new(layout: Arc<BandLayout>) -> Self {
        let unknowns = layout.groups().map(<[usize]>::len).sum();
        let multipliers = layout.blocks.iter().map(|b| b.order.len() * b.half_bandwidth).sum();
        Self {
            values: vec![ComplexLanes::default(); layout.storage()],
            factors: Factors {
                pivots: vec![0; unknowns],
                multipliers: vec![ComplexLanes::default(); multipliers],
                inverses: vec![ComplexLanes::default(); unknowns],
            },
            layout,
            arch: Arch::new(),
        }
    }

    /// Takes one system, M, D, S in band storage of the layout, at the angular frequencies ω \[rad/s\].
    pub fn set_frequencies(&mut self, [mass, damping, stiffness]: [&[f64]; 3], omega: &[f64; LANES]) {
        let square = omega.map(|w| w * w);
        let matrices = mass.iter().zip(damping).zip(stiffness);
        for (value, ((m, d), s)) in self.values.iter_mut().zip(matrices) {
            for k in 0..LANES {
                value.re[k] = s - square[k] * m;
                value.im[k] = omega[k] * d;
            }
        }
    }

    /// Takes up to [`LANES`] systems M, D, S, each at its angular frequency ω \[rad/s\]; the last one in all lanes left.
    pub fn set_systems<'m>(&mut self, systems: impl Iterator<Item = ([&'m SparseMatrix; 3], f64)>) {
        self.values.fill(ComplexLanes::default());
        let mut lanes = 0;
        for (lane, ([mass, damping, stiffness], omega)) in systems.take(LANES).enumerate() {
            for (i, j, s) in stiffness.iter() {
                if let Some(at) = self.layout.slot(i, j) {
                    self.values[at].re[lane] += s;
                }
            }
            for (i, j, m) in mass.iter() {
                if let Some(at) = self.layout.slot(i, j) {
                    self.values[at].re[lane] -= omega * omega * m;
                }
            }
            for (i, j, d) in damping.iter() {
                if let Some(at) = self.layout.slot(i, j) {
                    self.values[at].im[lane] += omega * d;
                }
            }
            lanes = lane + 1;
        }
        if (1..LANES).contains(&lanes) {
            for value in &mut self.values {
                let last = value.lane(lanes - 1);
                value.re[lanes..].fill(last.re);
                value.im[lanes..].fill(last.im);
            }
        }
    }

    /// Factorises the matrices.
    ///
    /// False if one is singular, or if no exchange of rows suits all of them: they are to be factorised one by one.
    pub fn factor(&mut self) -> bool {
        let Self { layout, values, factors, arch } = self;
        arch.dispatch(Factorisation { layout, values, factors })
    }

    /// Solves for the right sides of all matrices in place.
    pub fn solve(&self, b: &mut [ComplexLanes]) {
        self.arch.dispatch(Solution { of: self, b });
    }
}

// Structs in place of closures, which would not be inlined into the code for each set of vector instructions.

struct Factorisation<'a> {
    layout: &'a BandLayout,
    values: &'a mut [ComplexLanes],
    factors: &'a mut Factors,
}

impl NullaryFnOnce for Factorisation<'_> {
    type Output = bool;

    #[inline(always)]
    fn call(self) -> bool {
        let Factors { pivots, multipliers, inverses } = self.factors;
        let (mut unknown, mut multiplier) = (0, 0);
        for block in &self.layout.blocks {
            let (n, m) = (block.order.len(), block.order.len() * block.half_bandwidth);
            let whole = factor_block(
                &mut self.values[block.start..block.start + n * block.width()],
                &mut pivots[unknown..unknown + n],
                &mut multipliers[multiplier..multiplier + m],
                &mut inverses[unknown..unknown + n],
                block.half_bandwidth,
            );
            if !whole {
                return false;
            }
            unknown += n;
            multiplier += m;
        }
        true
    }
}

struct Solution<'a> {
    of: &'a BandLuLanes,
    b: &'a mut [ComplexLanes],
}

impl NullaryFnOnce for Solution<'_> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        let BandLuLanes { layout, values, factors, .. } = self.of;
        let (mut unknown, mut multiplier) = (0, 0);
        for block in &layout.blocks {
            let (n, m) = (block.order.len(), block.order.len() * block.half_bandwidth);
            let factors = BlockFactors {
                block,
                values: &values[block.start..block.start + n * block.width()],
                pivots: &factors.pivots[unknown..unknown + n],
                multipliers: &factors.multipliers[multiplier..multiplier + m],
                inverses: &factors.inverses[unknown..unknown + n],
            };
            factors.solve(self.b);
            unknown += n;
            multiplier += m;
        }
    }
}

/// As `band_lu::factor_block`: row p contains columns p − half ..= p + 2 half at p·width.
#[inline(always)]
fn factor_block(
    a: &mut [ComplexLanes],
    pivots: &mut [usize],
    multipliers: &mut [ComplexLanes],
    inverses: &mut [ComplexLanes],
    half: usize,
) -> bool {
    let (n, w) = (pivots.len(), 3 * half + 1);
    for j in 0..n {
        let last = (j + half).min(n - 1);
        let at = |r: usize| r * w + half + j - r;
        let Some(pivot) = common_pivot(a, j..=last, at) else { return false };
        pivots[j] = pivot;
        let reach = (2 * half).min(n - 1 - j);
        if pivot != j {
            let (up, down) = (at(j), at(pivot));
            for c in 0..=reach {
                a.swap(up + c, down + c);
            }
        }
        let inverse = a[at(j)].inverse();
        inverses[j] = inverse;
        for r in j + 1..=last {
            let (head, tail) = a.split_at_mut(r * w);
            let row = &mut tail[half + j - r..][..=reach];
            if row[0].is_zero() {
                multipliers[j * half + r - j - 1] = ComplexLanes::default();
                continue;
            }
            let factor = row[0].product(&inverse);
            multipliers[j * half + r - j - 1] = factor;
            let from = &head[j * w + half + 1..][..reach];
            for (x, u) in row[1..].iter_mut().zip(from) {
                x.subtract_product(&factor, u);
            }
        }
    }
    true
}

/// The row whose entry is nearest to the largest of every matrix, if it is near enough.
#[inline(always)]
fn common_pivot(
    a: &[ComplexLanes],
    rows: std::ops::RangeInclusive<usize>,
    at: impl Fn(usize) -> usize,
) -> Option<usize> {
    let mut largest = [0.0; LANES];
    for r in rows.clone() {
        let size = a[at(r)].norm1();
        for k in 0..LANES {
            // Written so that not-a-number stays.
            largest[k] = if size[k] <= largest[k] { largest[k] } else { size[k] };
        }
    }
    if !largest.iter().all(|size| *size > 0.0 && size.is_finite()) {
        return None;
    }
    let (mut pivot, mut best) = (None, LEAST_PIVOT);
    for r in rows {
        let size = a[at(r)].norm1();
        let mut least = f64::INFINITY;
        for k in 0..LANES {
            least = least.min(size[k] / largest[k]);
        }
        if least > best {
            (pivot, best) = (Some(r), least);
        }
    }
    pivot
}

/// The factors of one block.
struct BlockFactors<'a> {
    block: &'a Block,
    values: &'a [ComplexLanes],
    pivots: &'a [usize],
    multipliers: &'a [ComplexLanes],
    inverses: &'a [ComplexLanes],
}

impl BlockFactors<'_> {
    #[inline(always)]
    fn solve(&self, b: &mut [ComplexLanes]) {
        let half = self.block.half_bandwidth;
        let (n, w) = (self.pivots.len(), self.block.width());
        if self.block.order.iter().all(|&i| b[i].is_zero()) {
            return;
        }
        let mut x: Vec<ComplexLanes> = self.block.order.iter().map(|&i| b[i]).collect();
        for j in 0..n {
            x.swap(j, self.pivots[j]);
            let xj = x[j];
            for (x, factor) in x[j + 1..].iter_mut().zip(&self.multipliers[j * half..(j + 1) * half]) {
                x.subtract_product(factor, &xj);
            }
        }
        for j in (0..n).rev() {
            let reach = (2 * half).min(n - 1 - j);
            let row = &self.values[j * w + half + 1..][..reach];
            let mut sum = x[j];
            for (u, y) in row.iter().zip(&x[j + 1..]) {
                sum.subtract_product(u, y);
            }
            x[j] = sum.product(&self.inverses[j]);
        }
        for (&i, &v) in self.block.order.iter().zip(&x) {
            b[i] = v;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Triplets;

    /// M, D, S of a shuffled band, indefinite with small diagonal, so that rows must be exchanged.
    fn matrices(n: usize) -> [SparseMatrix; 3] {
        let shuffle = |i: usize| (i * 17 + 5) % n;
        let [mut m, mut d, mut s] = std::array::from_fn(|_| Triplets::new(n, n));
        for i in 0..n {
            for j in i.saturating_sub(3)..(i + 4).min(n) {
                let v = if i == j { 1e-3 } else { ((3 * i + 7 * j) % 11) as f64 - 5.0 };
                s.add(shuffle(i), shuffle(j), v);
                m.add(shuffle(i), shuffle(j), if i == j { 1.0 } else { 0.1 });
                d.add(shuffle(i), shuffle(j), if i == j { 0.2 } else { -0.01 });
            }
        }
        [m.build(), d.build(), s.build()]
    }

    fn solution(matrices: &[SparseMatrix; 3], omega: [f64; LANES]) -> Option<Vec<ComplexLanes>> {
        let layout = Arc::new(BandLayout::new(&matrices.each_ref()));
        let [m, d, s] = matrices.each_ref().map(|a| layout.scatter(a));
        let mut lu = BandLuLanes::new(layout);
        lu.set_frequencies([&m, &d, &s], &omega);
        solved(&mut lu)
    }

    fn solved(lu: &mut BandLuLanes) -> Option<Vec<ComplexLanes>> {
        let mut b: Vec<ComplexLanes> = (0..lu.layout.size())
            .map(|i| ComplexLanes { re: [(i as f64).sin() + 2.0; LANES], im: [0.5; LANES] })
            .collect();
        lu.factor().then(|| lu.solve(&mut b))?;
        Some(b)
    }

    #[test]
    fn every_matrix_is_solved_as_by_itself() {
        let matrices = matrices(40);
        let omega = std::array::from_fn(|k| 1.0 + 0.01 * k as f64);
        let x = solution(&matrices, omega).unwrap();
        for (lane, &w) in omega.iter().enumerate() {
            let x: Vec<Complex64> = x.iter().map(|x| x.lane(lane)).collect();
            let [mx, dx, sx] = matrices.each_ref().map(|a| a.mul_complex(&x));
            for i in 0..x.len() {
                let load = sx[i] - w * w * mx[i] + Complex64::new(0.0, w) * dx[i];
                assert!((load - Complex64::new((i as f64).sin() + 2.0, 0.5)).norm() < 1e-11, "{i}: {load}");
            }
        }
    }

    /// Systems of their own, fewer than lanes, after others in the same memory.
    #[test]
    fn systems_are_taken_one_by_one() {
        let matrices = matrices(40);
        let systems: Vec<[SparseMatrix; 3]> = (0..LANES - 3)
            .map(|k| matrices.each_ref().map(|a| SparseMatrix::sum(&[(1.0 + 1e-3 * k as f64, a)])))
            .collect();
        let mut lu = BandLuLanes::new(Arc::new(BandLayout::new(&matrices.each_ref())));
        lu.set_systems([(matrices.each_ref(), 3.0)].into_iter());
        assert!(solved(&mut lu).is_some());
        let omega = |k: usize| 1.0 + 0.01 * k as f64;
        lu.set_systems(systems.iter().enumerate().map(|(k, system)| (system.each_ref(), omega(k))));
        let found = solved(&mut lu).unwrap();
        for (k, system) in systems.iter().enumerate() {
            let own = solution(system, [omega(k); LANES]).unwrap();
            assert!(
                found
                    .iter()
                    .zip(&own)
                    .all(|(a, b)| (a.lane(k) - b.lane(0)).norm() < 1e-11 * b.lane(0).norm())
            );
        }
        let last = systems.len() - 1;
        assert!(found.iter().all(|x| x.lane(LANES - 1) == x.lane(last)));
    }

    #[test]
    fn matrices_without_common_pivots_or_without_any_are_refused() {
        let two = |values: [f64; 4]| {
            let mut t = Triplets::new(2, 2);
            (0..4).for_each(|k| t.add(k / 2, k % 2, values[k]));
            t.build()
        };
        // At ω = 0 the rows must be exchanged, at ω = 100 not.
        let matrices = [two([1.0, 0.0, 0.0, 1.0]), two([0.0; 4]), two([1e-3, 1.0, 1.0, 1e-3])];
        assert!(solution(&matrices, [0.0; LANES]).is_some());
        assert!(solution(&matrices, [100.0; LANES]).is_some());
        let mut mixed = [0.0; LANES];
        mixed[LANES - 1] = 100.0;
        assert!(solution(&matrices, mixed).is_none());
        assert!(solution(&[two([0.0; 4]), two([0.0; 4]), two([1.0; 4])], mixed).is_none());
        mixed[2] = f64::NAN;
        assert!(solution(&matrices, mixed).is_none());
    }
}
