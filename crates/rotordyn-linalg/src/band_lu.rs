//! Banded LU factorisation, real and complex, of block diagonal matrices.
//!
//! A shaft's equations couple neighbouring nodes only. Uncoupled groups of unknowns (axial, torsional and
//! lateral motion of a simple rotor) form separate blocks, each in reverse Cuthill-McKee order.

use super::sparse::SparseMatrix;
use nalgebra::ComplexField;
use pulp::{Arch, NullaryFnOnce};

/// Numbering of the unknowns in blocks, with the corresponding band storage.
#[derive(Clone, Debug)]
pub struct BandLayout {
    size: usize,
    pub(super) blocks: Vec<Block>,
    /// Block of every unknown and its place in the block; `None` outside a restricted layout.
    slots: Vec<Option<(usize, usize)>>,
}

#[derive(Clone, Debug)]
pub(super) struct Block {
    /// Unknowns in elimination order.
    pub order: Vec<usize>,
    /// Half bandwidth.
    pub half_bandwidth: usize,
    /// Offset of the block's first value in the storage.
    pub start: usize,
}

impl Block {
    /// Row length: the band plus the fill-in by row exchanges on the right.
    pub fn width(&self) -> usize {
        3 * self.half_bandwidth + 1
    }
}

/// A zero pivot: the matrix is singular, and this unknown takes part in its null space (a rigid-body mode).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ZeroPivot {
    pub unknown: usize,
}

impl BandLayout {
    fn of(size: usize, blocks: Vec<Block>) -> Self {
        let mut slots = vec![None; size];
        for (b, block) in blocks.iter().enumerate() {
            block.order.iter().enumerate().for_each(|(place, &i)| slots[i] = Some((b, place)));
        }
        Self { size, blocks, slots }
    }

    /// Layout for matrices with the union of the sparsity `patterns` and their transposes.
    pub fn new(patterns: &[&SparseMatrix]) -> Self {
        let size = patterns.first().map_or(0, |p| p.rows());
        let mut neighbours = vec![Vec::new(); size];
        for (i, j, _) in patterns.iter().flat_map(|p| p.iter()) {
            if i != j {
                neighbours[i].push(j);
                neighbours[j].push(i);
            }
        }
        for list in &mut neighbours {
            list.sort_unstable();
            list.dedup();
        }
        let mut place = vec![0; size];
        let mut start = 0;
        let mut blocks = Vec::new();
        for order in reverse_cuthill_mckee(&neighbours) {
            for (p, &i) in order.iter().enumerate() {
                place[i] = p;
            }
            let reach = |i: usize| neighbours[i].iter().map(|&j| place[i].abs_diff(place[j])).max();
            let half = order.iter().filter_map(|&i| reach(i)).max().unwrap_or(0);
            let block = Block { order, half_bandwidth: half, start };
            start += block.order.len() * block.width();
            blocks.push(block);
        }
        Self::of(size, blocks)
    }

    /// Layout of one block in the order of the unknowns, which is the elimination order already.
    pub(super) fn in_order(matrix: &SparseMatrix) -> Self {
        let size = matrix.rows();
        let half_bandwidth = matrix.iter().map(|(i, j, _)| i.abs_diff(j)).max().unwrap_or(0);
        Self::of(size, vec![Block { order: (0..size).collect(), half_bandwidth, start: 0 }])
    }

    /// The layout of only those groups that contain one of `unknowns`; solving leaves the others unchanged.
    pub fn restricted_to(&self, unknowns: &[usize]) -> Self {
        let mut start = 0;
        let mut blocks = Vec::new();
        for block in self.blocks.iter().filter(|b| b.order.iter().any(|i| unknowns.contains(i))) {
            blocks.push(Block { start, ..block.clone() });
            start += block.order.len() * block.width();
        }
        Self::of(self.size, blocks)
    }

    /// Number of unknowns.
    pub fn size(&self) -> usize {
        self.size
    }

    /// Number of stored values.
    pub fn storage(&self) -> usize {
        self.blocks.last().map_or(0, |b| b.start + b.order.len() * b.width())
    }

    /// The mutually uncoupled groups of unknowns.
    pub fn groups(&self) -> impl Iterator<Item = &[usize]> {
        self.blocks.iter().map(|b| b.order.as_slice())
    }

    /// Place of an entry in the band storage; `None` outside a restricted layout, and where the layout's patterns have none.
    pub fn slot(&self, i: usize, j: usize) -> Option<usize> {
        let ((b, p), (other, q)) = (self.slots[i]?, self.slots[j]?);
        let block = &self.blocks[b];
        let within = b == other && p.abs_diff(q) <= block.half_bandwidth;
        within.then(|| block.start + p * block.width() + block.half_bandwidth + q - p)
    }

    /// Band storage of a matrix; add such arrays entry by entry to combine matrices of one layout.
    pub fn scatter(&self, matrix: &SparseMatrix) -> Vec<f64> {
        let mut values = vec![0.0; self.storage()];
        for (i, j, v) in matrix.iter() {
            if let Some(at) = self.slot(i, j) {
                values[at] = v;
            }
        }
        values
    }

    /// LU factors of the matrix in `values` (band storage of this layout), with partial pivoting.
    ///
    /// # Errors
    /// A column without a pivot, with its unknown.
    pub fn factor<T>(&self, values: Vec<T>) -> Result<BandLu<'_, T>, ZeroPivot>
    where
        T: ComplexField<RealField = f64> + Copy,
    {
        let mut lu = self.lu_of(values);
        lu.factor_all()?;
        Ok(lu)
    }

    /// Memory for LU factors, to be computed by [`BandLu::refactor`].
    pub fn workspace<T>(&self) -> BandLu<'_, T>
    where
        T: ComplexField<RealField = f64> + Copy,
    {
        self.lu_of(vec![T::zero(); self.storage()])
    }

    fn lu_of<T>(&self, values: Vec<T>) -> BandLu<'_, T>
    where
        T: ComplexField<RealField = f64> + Copy,
    {
        let multipliers = self.blocks.iter().map(|b| b.order.len() * b.half_bandwidth).sum();
        let (pivots, reaches) = (vec![0; self.size], vec![0; self.size]);
        BandLu { layout: self, values, pivots, reaches, multipliers: vec![T::zero(); multipliers] }
    }
}

/// LU factors of a banded matrix.
#[derive(Clone, Debug)]
pub struct BandLu<'a, T> {
    layout: &'a BandLayout,
    values: Vec<T>,
    pivots: Vec<usize>,
    /// Number of entries of every row of the upper factor right of the diagonal.
    reaches: Vec<usize>,
    /// Those of every column, one after another: a solution runs along them.
    multipliers: Vec<T>,
}

impl<T> BandLu<'_, T>
where
    T: ComplexField<RealField = f64> + Copy,
{
    /// Factorises another matrix of the same layout in the same memory: `fill(k)` gives its value k.
    ///
    /// # Errors
    /// As [`BandLayout::factor`].
    pub fn refactor(&mut self, fill: impl Fn(usize) -> T) -> Result<(), ZeroPivot> {
        for (k, v) in self.values.iter_mut().enumerate() {
            *v = fill(k);
        }
        self.factor_all()
    }

    fn factor_all(&mut self) -> Result<(), ZeroPivot> {
        let arch = Arch::new();
        let (mut pivots, mut multipliers) = (self.pivots.as_mut_slice(), self.multipliers.as_mut_slice());
        let mut reaches = self.reaches.as_mut_slice();
        for block in &self.layout.blocks {
            let n = block.order.len();
            let values = &mut self.values[block.start..block.start + n * block.width()];
            let (own_pivots, rest) = pivots.split_at_mut(n);
            let (own_reaches, later) = reaches.split_at_mut(n);
            let (own_multipliers, other) = multipliers.split_at_mut(n * block.half_bandwidth);
            let elimination = Elimination {
                a: values,
                pivots: own_pivots,
                reaches: own_reaches,
                multipliers: own_multipliers,
                half: block.half_bandwidth,
            };
            arch.dispatch(elimination).map_err(|at| ZeroPivot { unknown: block.order[at] })?;
            (pivots, reaches, multipliers) = (rest, later, other);
        }
        Ok(())
    }

    /// Solves A x = b in place.
    pub fn solve(&self, b: &mut [T]) {
        let (mut pivots, mut multipliers) = (self.pivots.as_slice(), self.multipliers.as_slice());
        let mut reaches = self.reaches.as_slice();
        let (mut x, arch) = (Vec::new(), Arch::new());
        for block in &self.layout.blocks {
            let n = block.order.len();
            let (own_pivots, rest) = pivots.split_at(n);
            let (own_reaches, later) = reaches.split_at(n);
            let (own_multipliers, other) = multipliers.split_at(n * block.half_bandwidth);
            if block.order.iter().any(|&i| b[i] != T::zero()) {
                x.clear();
                x.extend(block.order.iter().map(|&i| b[i]));
                let values = &self.values[block.start..block.start + n * block.width()];
                let factors = BlockFactors {
                    a: values,
                    pivots: own_pivots,
                    reaches: own_reaches,
                    multipliers: own_multipliers,
                    half: block.half_bandwidth,
                };
                arch.dispatch(Substitution { factors, x: &mut x });
                for (&i, &v) in block.order.iter().zip(&x) {
                    b[i] = v;
                }
            }
            (pivots, reaches, multipliers) = (rest, later, other);
        }
    }
}

// Compiled for the widest vectors, with the same rounding on every processor; structs in place of closures, which would not be
// inlined into that code.

/// Row p of `a` contains columns p − half ..= p + 2 half at p·width.
struct Elimination<'a, T> {
    a: &'a mut [T],
    pivots: &'a mut [usize],
    reaches: &'a mut [usize],
    multipliers: &'a mut [T],
    half: usize,
}

impl<T> NullaryFnOnce for Elimination<'_, T>
where
    T: ComplexField<RealField = f64> + Copy,
{
    type Output = Result<(), usize>;

    #[inline(always)]
    fn call(self) -> Result<(), usize> {
        let Self { a, pivots, reaches, multipliers, half } = self;
        let (n, w) = (pivots.len(), 3 * half + 1);
        // Last column that the rows so far reach.
        let mut end = 0;
        for j in 0..n {
            let last = (j + half).min(n - 1);
            let at = |r: usize| r * w + half + j - r;
            let mut pivot = j;
            for r in j + 1..=last {
                if a[at(r)].norm1() > a[at(pivot)].norm1() {
                    pivot = r;
                }
            }
            let value = a[at(pivot)];
            if value == T::zero() || !value.is_finite() {
                return Err(j);
            }
            end = end.max((pivot + half).min(n - 1));
            let reach = end - j;
            (pivots[j], reaches[j]) = (pivot, reach);
            if pivot != j {
                let (up, down) = (at(j), at(pivot));
                for c in 0..=reach {
                    a.swap(up + c, down + c);
                }
            }
            for r in j + 1..=last {
                let (head, tail) = a.split_at_mut(r * w);
                let row = &mut tail[half + j - r..];
                let multiplier = &mut multipliers[j * half + r - j - 1];
                if row[0] == T::zero() {
                    *multiplier = T::zero();
                    continue;
                }
                let factor = row[0] / value;
                *multiplier = factor;
                let from = &head[j * w + half + 1..][..reach];
                for (x, &u) in row[1..=reach].iter_mut().zip(from) {
                    *x -= factor * u;
                }
            }
        }
        Ok(())
    }
}

struct BlockFactors<'a, T> {
    a: &'a [T],
    pivots: &'a [usize],
    reaches: &'a [usize],
    multipliers: &'a [T],
    half: usize,
}

struct Substitution<'a, T> {
    factors: BlockFactors<'a, T>,
    x: &'a mut [T],
}

impl<T> NullaryFnOnce for Substitution<'_, T>
where
    T: ComplexField<RealField = f64> + Copy,
{
    type Output = ();

    #[inline(always)]
    fn call(self) {
        let BlockFactors { a, pivots, reaches, multipliers, half } = self.factors;
        let x = self.x;
        let (n, w) = (pivots.len(), 3 * half + 1);
        for j in 0..n {
            x.swap(j, pivots[j]);
            let xj = x[j];
            for (x, &factor) in x[j + 1..].iter_mut().zip(&multipliers[j * half..(j + 1) * half]) {
                *x -= factor * xj;
            }
        }
        for j in (0..n).rev() {
            let reach = reaches[j];
            let row = &a[j * w + half..][..=reach];
            // Two sums, neither of which waits for the other.
            let (pairs, rest) = row[1..].as_chunks::<2>();
            let (known, known_rest) = x[j + 1..=j + reach].as_chunks::<2>();
            let (mut s, mut other) = (x[j], T::zero());
            for ([u, v], [y, z]) in pairs.iter().zip(known) {
                s -= *u * *y;
                other -= *v * *z;
            }
            for (&u, &y) in rest.iter().zip(known_rest) {
                s -= u * y;
            }
            x[j] = (s + other) / row[0];
        }
    }
}

/// Connected groups of unknowns, each in bandwidth-reducing order (Cuthill & McKee 1969, reversed).
fn reverse_cuthill_mckee(neighbours: &[Vec<usize>]) -> Vec<Vec<usize>> {
    let mut seen = vec![false; neighbours.len()];
    let mut groups = Vec::new();
    for root in 0..neighbours.len() {
        if seen[root] {
            continue;
        }
        // Start from a pseudo-peripheral unknown: the last one of a breadth-first search.
        let mut start = root;
        for _ in 0..2 {
            let mut visited = vec![false; neighbours.len()];
            start = *breadth_first(start, neighbours, &mut visited).last().expect("holds the start");
        }
        let mut order = breadth_first(start, neighbours, &mut seen);
        order.reverse();
        groups.push(order);
    }
    groups
}

fn breadth_first(start: usize, neighbours: &[Vec<usize>], seen: &mut [bool]) -> Vec<usize> {
    let mut order = vec![start];
    seen[start] = true;
    let mut next = 0;
    while next < order.len() {
        let mut fresh: Vec<usize> = neighbours[order[next]].iter().copied().filter(|&j| !seen[j]).collect();
        fresh.sort_by_key(|&j| (neighbours[j].len(), j));
        for &j in &fresh {
            seen[j] = true;
        }
        order.extend(fresh);
        next += 1;
    }
    order
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Complex64, Triplets};

    #[test]
    fn solves_a_shuffled_indefinite_band_real_and_complex() {
        let n = 40;
        let shuffle = |i: usize| (i * 17 + 5) % n;
        let mut t = Triplets::new(n, n);
        for i in 0..n {
            for j in i.saturating_sub(3)..(i + 4).min(n) {
                // Small diagonal, so that rows must be exchanged.
                let v = if i == j { 1e-3 } else { ((3 * i + 7 * j) % 11) as f64 - 5.0 };
                t.add(shuffle(i), shuffle(j), v);
            }
        }
        let a = t.build();
        let layout = BandLayout::new(&[&a]);
        let x: Vec<f64> = (0..n).map(|i| (i as f64).sin() + 2.0).collect();
        let mut b = a.mul(&x);
        let values = layout.scatter(&a);
        layout.factor(values.clone()).unwrap().solve(&mut b);
        assert!(b.iter().zip(&x).all(|(u, v)| (u - v).abs() < 1e-10));

        let z = Complex64::new(0.3, -1.0);
        let mut b: Vec<Complex64> = a.mul(&x).iter().map(|&v| z * v).collect();
        let scaled: Vec<Complex64> = values.iter().map(|&v| z * v).collect();
        layout.factor(scaled).unwrap().solve(&mut b);
        assert!(b.iter().zip(&x).all(|(u, v)| (u - v).norm() < 1e-10));
    }

    #[test]
    fn zero_pivot_reports_its_unknown() {
        let mut t = Triplets::new(3, 3);
        t.add(0, 0, 1.0);
        t.add(2, 2, 1.0);
        let a = t.build();
        let layout = BandLayout::new(&[&a]);
        assert_eq!(layout.factor(layout.scatter(&a)).unwrap_err(), ZeroPivot { unknown: 1 });
    }
}
