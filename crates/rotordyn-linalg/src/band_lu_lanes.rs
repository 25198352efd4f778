//! Banded LU factorisation of several complex matrices of one layout at once, such as dynamic stiffnesses at neighbouring
//! frequencies.
//!
//! The matrices lie side by side, number for number: one vector instruction does the same step in each. They exchange the
//! same rows, so the pivots are those that are large enough in all of them (threshold pivoting), compared by rows of equal
//! largest entries, and on the diagonal where they can be: exchanges widen the band.

use super::band_lu::{BandLayout, Block};
use super::complex_lanes::{ComplexLanes, LANES};
use pulp::{Arch, NullaryFnOnce};
use std::sync::Arc;

/// Least size of a pivot relative to the largest candidate of its matrix, in rows of equal largest entries: round-off grows
/// at most by the inverse at a step.
const LEAST_PIVOT: f64 = 0.1;

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
    /// Number of entries of every row of the upper factor right of the diagonal.
    reaches: Vec<usize>,
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
                reaches: vec![0; unknowns],
                multipliers: vec![ComplexLanes::default(); multipliers],
                inverses: vec![ComplexLanes::default(); unknowns],
            },
            layout,
            arch: Arch::new(),
        }
    }

    /// Takes one system, M, D, S in band storage of the layout, at the angular frequencies ω \[rad/s\].
    pub fn set_frequencies(&mut self, [mass, damping, stiffness]: [&[f64]; 3], omega: &[f64; LANES]) {
        let terms = Terms { stiffness: [stiffness, &[]], mass, damping: [damping, &[]] };
        self.arch.dispatch(Sums { layout: &self.layout, of: terms, omega, values: &mut self.values });
    }

    /// Takes a machine, M, G, C, S, K_c in band storage of the layout, at the speeds Ω \[rad/s\] of synchronous motion:
    /// S + Ω K_c − Ω² M + jΩ (C + Ω G).
    pub fn set_speeds(
        &mut self,
        [mass, gyroscopic, damping, stiffness, circulatory]: [&[f64]; 5],
        speeds: &[f64; LANES],
    ) {
        let terms = Terms { stiffness: [stiffness, circulatory], mass, damping: [damping, gyroscopic] };
        self.arch.dispatch(Sums { layout: &self.layout, of: terms, omega: speeds, values: &mut self.values });
    }

    /// The matrices in band storage of the layout, until they are factorised. Only entries within the half bandwidth count.
    pub fn values_mut(&mut self) -> &mut [ComplexLanes] {
        &mut self.values
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

/// S − ω² M + jω D with S and D linear in ω: constant terms and slopes, none of the latter where empty.
#[derive(Clone, Copy)]
struct Terms<'a> {
    stiffness: [&'a [f64]; 2],
    mass: &'a [f64],
    damping: [&'a [f64]; 2],
}

struct Sums<'a> {
    layout: &'a BandLayout,
    of: Terms<'a>,
    omega: &'a [f64; LANES],
    values: &'a mut [ComplexLanes],
}

impl NullaryFnOnce for Sums<'_> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        let Self { layout, of: Terms { stiffness, mass, damping }, omega, values } = self;
        let square = omega.map(
            #[inline(always)]
            |w| w * w,
        );
        let with_slopes = !stiffness[1].is_empty();
        for block in &layout.blocks {
            let (w, band) = (block.width(), 2 * block.half_bandwidth + 1);
            for row in (0..block.order.len()).map(|p| block.start + p * w..block.start + p * w + band) {
                let constant = stiffness[0][row.clone()].iter().zip(&mass[row.clone()]);
                let constant = constant.zip(&damping[0][row.clone()]);
                let values = &mut values[row.clone()];
                for (value, ((s, m), d)) in values.iter_mut().zip(constant) {
                    for k in 0..LANES {
                        value.re[k] = s - square[k] * m;
                        value.im[k] = omega[k] * d;
                    }
                }
                if with_slopes {
                    let slopes = stiffness[1][row.clone()].iter().zip(&damping[1][row]);
                    for (value, (s, d)) in values.iter_mut().zip(slopes) {
                        for k in 0..LANES {
                            value.re[k] += omega[k] * s;
                            value.im[k] += square[k] * d;
                        }
                    }
                }
            }
        }
    }
}

struct Factorisation<'a> {
    layout: &'a BandLayout,
    values: &'a mut [ComplexLanes],
    factors: &'a mut Factors,
}

impl NullaryFnOnce for Factorisation<'_> {
    type Output = bool;

    #[inline(always)]
    fn call(self) -> bool {
        let Factors { pivots, reaches, multipliers, inverses } = self.factors;
        let (mut unknown, mut multiplier) = (0, 0);
        for block in &self.layout.blocks {
            let (n, m) = (block.order.len(), block.order.len() * block.half_bandwidth);
            let whole = factor_block(
                &mut self.values[block.start..block.start + n * block.width()],
                &mut pivots[unknown..unknown + n],
                &mut reaches[unknown..unknown + n],
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
                reaches: &factors.reaches[unknown..unknown + n],
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
    reaches: &mut [usize],
    multipliers: &mut [ComplexLanes],
    inverses: &mut [ComplexLanes],
    half: usize,
) -> bool {
    let (n, w) = (pivots.len(), 3 * half + 1);
    let scale = |row: &[ComplexLanes]| {
        let mut largest = [f64::MIN_POSITIVE; LANES];
        for z in &row[..=2 * half] {
            let size = z.norm1();
            for k in 0..LANES {
                largest[k] = largest[k].max(size[k]);
            }
        }
        1.0 / largest.into_iter().fold(0.0, f64::max)
    };
    let mut scales: Vec<f64> = a.chunks_exact(w).map(scale).collect();
    // Last column that the rows so far reach.
    let mut end = 0;
    for j in 0..n {
        let last = (j + half).min(n - 1);
        let at = |r: usize| r * w + half + j - r;
        let Some(pivot) = common_pivot(a, &scales, j..=last, at) else { return false };
        let before = end;
        end = end.max((pivot + half).min(n - 1));
        // Where exchanges let the rows reach further there is nothing yet.
        for r in j..=last {
            let known = before.max(r + half);
            if known < end {
                a[r * w + half + known + 1 - r..=r * w + half + end - r].fill(ComplexLanes::default());
            }
        }
        let reach = end - j;
        (pivots[j], reaches[j]) = (pivot, reach);
        if pivot != j {
            scales.swap(j, pivot);
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

/// The first row, the diagonal one, if its entry is large enough in every matrix; else the row whose entry is nearest to the
/// largest of every matrix, if that is.
#[inline(always)]
fn common_pivot(
    a: &[ComplexLanes],
    scales: &[f64],
    rows: std::ops::RangeInclusive<usize>,
    at: impl Fn(usize) -> usize,
) -> Option<usize> {
    let mut largest = [0.0; LANES];
    for r in rows.clone() {
        let size = a[at(r)].norm1();
        for k in 0..LANES {
            // Written so that not-a-number stays.
            let size = scales[r] * size[k];
            largest[k] = if size <= largest[k] { largest[k] } else { size };
        }
    }
    if !largest.iter().all(|size| *size > 0.0 && size.is_finite()) {
        return None;
    }
    let diagonal = *rows.start();
    let (mut pivot, mut best) = (None, LEAST_PIVOT);
    for r in rows {
        let size = a[at(r)].norm1();
        let mut least = f64::INFINITY;
        for k in 0..LANES {
            least = least.min(scales[r] * size[k] / largest[k]);
        }
        if least > best {
            (pivot, best) = (Some(r), least);
            if r == diagonal {
                break;
            }
        }
    }
    pivot
}

/// The factors of one block.
struct BlockFactors<'a> {
    block: &'a Block,
    values: &'a [ComplexLanes],
    pivots: &'a [usize],
    reaches: &'a [usize],
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
            let row = &self.values[j * w + half + 1..][..self.reaches[j]];
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
    use crate::{Complex64, SparseMatrix, Triplets};

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

    #[test]
    fn matrices_that_grow_with_speed_are_their_sums_at_that_speed() {
        let [m, d, s] = matrices(40);
        let speeds: [f64; LANES] = std::array::from_fn(|k| 1.0 + 0.01 * k as f64);
        let layout = Arc::new(BandLayout::new(&[&m, &d, &s]));
        let [mass, damping, stiffness] = [&m, &d, &s].map(|a| layout.scatter(a));
        let mut lu = BandLuLanes::new(layout);
        // G of the pattern of S, K_c of that of D.
        let [gyroscopic, circulatory] =
            [(0.03, &s), (0.2, &d)].map(|(factor, a)| lu.layout.scatter(&SparseMatrix::sum(&[(factor, a)])));
        lu.set_speeds([&mass, &gyroscopic, &damping, &stiffness, &circulatory], &speeds);
        let found = solved(&mut lu).unwrap();
        for (k, w) in speeds.into_iter().enumerate() {
            let at = [
                m.clone(),
                SparseMatrix::sum(&[(1.0, &d), (0.03 * w, &s)]),
                SparseMatrix::sum(&[(1.0, &s), (0.2 * w, &d)]),
            ];
            let own = solution(&at, [w; LANES]).unwrap();
            let near = |(a, b): (&ComplexLanes, &ComplexLanes)| {
                (a.lane(k) - b.lane(0)).norm() < 1e-11 * b.lane(0).norm()
            };
            assert!(found.iter().zip(&own).all(near));
        }
    }

    /// Rows of very different sizes, small on the diagonal: rows are compared by their own size, wherever exchanges put them.
    #[test]
    fn rows_of_any_size_are_solved() {
        let n = 40;
        let mut t = Triplets::new(n, n);
        for i in 0..n {
            let size = [1.0, 1e8, 1e-6][i % 3];
            for j in i.saturating_sub(3)..(i + 4).min(n) {
                let v = if i == j { 1e-3 } else { ((3 * i + 7 * j) % 11) as f64 - 5.0 };
                t.add(i, j, size * v);
            }
        }
        let (zero, a) = (Triplets::new(n, n).build(), t.build());
        let layout = Arc::new(BandLayout::new(&[&a]));
        let mut lu = BandLuLanes::new(layout.clone());
        lu.set_frequencies(
            [&zero, &zero, &a].map(|a| layout.scatter(a)).each_ref().map(Vec::as_slice),
            &[0.0; LANES],
        );
        assert!(lu.factor());
        let x: Vec<f64> = (0..n).map(|i| (i as f64).sin() + 2.0).collect();
        let mut b: Vec<ComplexLanes> =
            a.mul(&x).into_iter().map(|b| ComplexLanes { re: [b; LANES], im: [0.0; LANES] }).collect();
        lu.solve(&mut b);
        assert!(b.iter().zip(&x).all(|(b, x)| (b.lane(3) - x).norm() < 1e-11), "{b:?}");
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
