//! Sparse matrices: triplets (COO) for assembly, compressed sparse columns (CSC) for computation.

use nalgebra::DMatrix;

/// Matrix under assembly: entries at the same position are summed.
#[derive(Clone, Debug, Default)]
pub struct Triplets {
    rows: usize,
    cols: usize,
    entries: Vec<(usize, usize, f64)>,
}

impl Triplets {
    /// Empty matrix of the given size.
    pub fn new(rows: usize, cols: usize) -> Self {
        Self { rows, cols, entries: Vec::new() }
    }

    /// Adds `value` at (row, col).
    pub fn add(&mut self, row: usize, col: usize, value: f64) {
        debug_assert!(row < self.rows && col < self.cols);
        self.entries.push((row, col, value));
    }

    /// Adds factor × `matrix` with its top left corner at (row, col).
    pub fn add_sparse(&mut self, row: usize, col: usize, matrix: &SparseMatrix, factor: f64) {
        self.entries.extend(matrix.iter().map(|(i, j, v)| (row + i, col + j, factor * v)));
    }

    /// Adds Rᵀ S R, S a small dense matrix.
    pub fn add_between_rows<const N: usize>(&mut self, rows: &[SparseRow; N], block: &[[f64; N]; N]) {
        self.add_between(rows, block, rows);
    }

    /// Adds Lᵀ S R, S a small dense matrix.
    pub fn add_between<const N: usize>(
        &mut self,
        left: &[SparseRow; N],
        block: &[[f64; N]; N],
        right: &[SparseRow; N],
    ) {
        for (l, line) in left.iter().zip(block) {
            for (r, &s) in right.iter().zip(line) {
                if s != 0.0 {
                    for &(i, a) in &l.0 {
                        for &(j, b) in &r.0 {
                            self.entries.push((i, j, a * s * b));
                        }
                    }
                }
            }
        }
    }

    /// The compressed matrix; entries that sum to exactly zero are dropped.
    pub fn build(mut self) -> SparseMatrix {
        // A stable sort keeps the order of addition, so that sums are reproducible.
        self.entries.sort_by_key(|&(i, j, _)| (j, i));
        let mut matrix = SparseMatrix::zeros(self.rows, self.cols);
        let mut place = None;
        let mut columns = Vec::with_capacity(self.entries.len());
        for (i, j, v) in self.entries {
            if place == Some((i, j)) {
                *matrix.values.last_mut().expect("an entry exists at `place`") += v;
            } else {
                place = Some((i, j));
                columns.push(j);
                matrix.row_index.push(i);
                matrix.values.push(v);
            }
        }
        matrix.compress(&columns);
        matrix
    }
}

/// Sparse matrix in compressed sparse column (CSC) format.
#[derive(Clone, Debug, PartialEq)]
pub struct SparseMatrix {
    rows: usize,
    /// Entries of column j are `start[j]..start[j + 1]`.
    start: Vec<usize>,
    row_index: Vec<usize>,
    values: Vec<f64>,
}

impl SparseMatrix {
    /// Matrix without entries.
    pub fn zeros(rows: usize, cols: usize) -> Self {
        Self { rows, start: vec![0; cols + 1], row_index: Vec::new(), values: Vec::new() }
    }

    /// Drops zeros and sets the column starts from the column of every entry.
    fn compress(&mut self, columns: &[usize]) {
        let mut kept = 0;
        let mut count = vec![0; self.cols() + 1];
        for (k, &j) in columns.iter().enumerate() {
            if self.values[k] != 0.0 {
                self.values[kept] = self.values[k];
                self.row_index[kept] = self.row_index[k];
                count[j + 1] += 1;
                kept += 1;
            }
        }
        self.values.truncate(kept);
        self.row_index.truncate(kept);
        for j in 0..self.cols() {
            count[j + 1] += count[j];
        }
        self.start = count;
    }

    /// Sparse copy of a dense matrix.
    pub fn from_dense(dense: &DMatrix<f64>) -> Self {
        let mut triplets = Triplets::new(dense.nrows(), dense.ncols());
        for j in 0..dense.ncols() {
            for i in 0..dense.nrows() {
                if dense[(i, j)] != 0.0 {
                    triplets.add(i, j, dense[(i, j)]);
                }
            }
        }
        triplets.build()
    }

    pub fn rows(&self) -> usize {
        self.rows
    }

    pub fn cols(&self) -> usize {
        self.start.len() - 1
    }

    /// Entries (row, column, value) in order of columns.
    pub fn iter(&self) -> impl Iterator<Item = (usize, usize, f64)> + '_ {
        (0..self.cols()).flat_map(move |j| self.column(j).map(move |(i, v)| (i, j, v)))
    }

    /// Entries (row, value) of a column.
    pub fn column(&self, j: usize) -> impl Iterator<Item = (usize, f64)> + '_ {
        let range = self.start[j]..self.start[j + 1];
        self.row_index[range.clone()].iter().copied().zip(self.values[range].iter().copied())
    }

    /// Entry at (i, j); zero if not stored.
    pub fn get(&self, i: usize, j: usize) -> f64 {
        let range = self.start[j]..self.start[j + 1];
        self.row_index[range.clone()].binary_search(&i).map_or(0.0, |k| self.values[range.start + k])
    }

    /// Dense copy.
    pub fn to_dense(&self) -> DMatrix<f64> {
        let mut dense = DMatrix::zeros(self.rows(), self.cols());
        for (i, j, v) in self.iter() {
            dense[(i, j)] = v;
        }
        dense
    }

    /// y = A x.
    pub fn mul(&self, x: &[f64]) -> Vec<f64> {
        let mut y = vec![0.0; self.rows];
        self.mul_add(1.0, x, &mut y);
        y
    }

    /// y ← y + factor A x.
    pub fn mul_add(&self, factor: f64, x: &[f64], y: &mut [f64]) {
        for (j, &xj) in x.iter().enumerate() {
            let s = factor * xj;
            for k in self.start[j]..self.start[j + 1] {
                y[self.row_index[k]] += self.values[k] * s;
            }
        }
    }

    /// y = A x for a complex vector.
    pub fn mul_complex(&self, x: &[super::Complex64]) -> Vec<super::Complex64> {
        let mut y = vec![super::Complex64::default(); self.rows];
        for (i, j, v) in self.iter() {
            y[i] += x[j] * v;
        }
        y
    }

    /// xᴴ A x.
    pub fn form(&self, x: &[super::Complex64]) -> super::Complex64 {
        let mut sum = super::Complex64::default();
        for (j, x_j) in x.iter().enumerate().filter(|(_, x)| x.re != 0.0 || x.im != 0.0) {
            let (mut re, mut im) = (0.0, 0.0);
            for k in self.start[j]..self.start[j + 1] {
                let x_i = x[self.row_index[k]];
                re += self.values[k] * x_i.re;
                im += self.values[k] * x_i.im;
            }
            sum += super::Complex64::new(re, -im) * x_j;
        }
        sum
    }

    /// |x|ᵀ |A| |x|, the size of the terms of [`Self::form`].
    pub fn form_of_sizes(&self, x: &[super::Complex64]) -> f64 {
        let sizes: Vec<f64> = x.iter().map(|x| x.norm_sqr().sqrt()).collect();
        let column = |j: usize| {
            let entries = self.start[j]..self.start[j + 1];
            entries.map(|k| self.values[k].abs() * sizes[self.row_index[k]]).sum::<f64>()
        };
        (0..sizes.len()).filter(|&j| sizes[j] != 0.0).map(|j| sizes[j] * column(j)).sum()
    }

    /// ½ (A − Aᵀ); without entries for a symmetric matrix.
    pub fn skew_part(&self) -> SparseMatrix {
        let mut out = Triplets::new(self.rows, self.cols());
        for (i, j, v) in self.iter() {
            let half = 0.5 * (v - self.get(j, i));
            if half != 0.0 {
                out.add(i, j, half);
                if self.get(j, i) == 0.0 {
                    out.add(j, i, -half);
                }
            }
        }
        out.build()
    }

    /// Whether |a_ij − a_ji| is at most this fraction of √|a_ii a_jj| everywhere.
    pub fn is_symmetric(&self, tolerance: f64) -> bool {
        let near = |(i, j, v): (usize, usize, f64)| {
            (v - self.get(j, i)).abs() <= tolerance * (self.get(i, i) * self.get(j, j)).abs().sqrt()
        };
        self.rows == self.cols() && self.iter().all(near)
    }

    /// Aᵀ.
    pub fn transposed(&self) -> SparseMatrix {
        let mut out = Triplets::new(self.cols(), self.rows);
        for (i, j, v) in self.iter() {
            out.add(j, i, v);
        }
        out.build()
    }

    /// Σ factor × matrix over matrices of one size; entries that sum to exactly zero are dropped.
    pub fn sum(terms: &[(f64, &SparseMatrix)]) -> SparseMatrix {
        let (rows, cols) = terms.first().map_or((0, 0), |(_, a)| (a.rows(), a.cols()));
        let terms: Vec<&(f64, &SparseMatrix)> =
            terms.iter().filter(|(factor, a)| *factor != 0.0 && !a.values.is_empty()).collect();
        let most = terms.iter().map(|(_, a)| a.values.len()).sum();
        let mut out = SparseMatrix {
            rows,
            start: Vec::with_capacity(cols + 1),
            row_index: Vec::with_capacity(most),
            values: Vec::with_capacity(most),
        };
        out.start.push(0);
        // Factor, rows and values of a column that are not taken yet.
        let mut parts: Vec<(f64, &[usize], &[f64])> = Vec::with_capacity(terms.len());
        for j in 0..cols {
            parts.clear();
            parts.extend(terms.iter().filter_map(|(factor, a)| {
                let range = a.start[j]..a.start[j + 1];
                (!range.is_empty()).then(|| (*factor, &a.row_index[range.clone()], &a.values[range]))
            }));
            // The columns are merged, each sorted by rows; the last one left is copied.
            while parts.len() > 1 {
                let lowest = parts.iter().map(|(_, rows, _)| rows[0]).min().unwrap_or(rows);
                let mut sum = 0.0;
                parts.retain_mut(|(factor, rows, values)| {
                    if rows[0] == lowest {
                        sum += *factor * values[0];
                        (*rows, *values) = (&rows[1..], &values[1..]);
                    }
                    !rows.is_empty()
                });
                out.push_entry(lowest, sum);
            }
            if let Some((factor, rows, values)) = parts.first() {
                rows.iter().zip(*values).for_each(|(&i, v)| out.push_entry(i, factor * v));
            }
            out.start.push(out.values.len());
        }
        out
    }

    /// Adds an entry to the last column, unless it is zero.
    fn push_entry(&mut self, row: usize, value: f64) {
        if value != 0.0 {
            self.row_index.push(row);
            self.values.push(value);
        }
    }

    /// Whether both matrices have entries at the same positions.
    pub fn same_pattern(&self, other: &SparseMatrix) -> bool {
        self.rows == other.rows && self.start == other.start && self.row_index == other.row_index
    }

    /// Congruence transformation Tᵀ A T, `basis[i]` being row i of T.
    pub fn congruence(&self, basis: &[SparseRow], reduced: usize) -> SparseMatrix {
        let mut out = Triplets::new(reduced, reduced);
        for (i, j, v) in self.iter() {
            for &(a, ta) in &basis[i].0 {
                for &(b, tb) in &basis[j].0 {
                    out.add(a, b, ta * v * tb);
                }
            }
        }
        out.build()
    }

    /// Rows and columns `unknowns`, in this order; `place` has the position of every unknown in it.
    pub(super) fn submatrix(&self, unknowns: &[usize], place: &[Option<usize>]) -> SparseMatrix {
        let mut out =
            SparseMatrix { rows: unknowns.len(), start: vec![0], row_index: vec![], values: vec![] };
        let mut column: Vec<(usize, f64)> = Vec::new();
        for &j in unknowns {
            column.clear();
            column.extend(self.column(j).filter_map(|(i, v)| Some((place[i]?, v))));
            column.sort_unstable_by_key(|(i, _)| *i);
            out.row_index.extend(column.iter().map(|(i, _)| i));
            out.values.extend(column.iter().map(|(_, v)| v));
            out.start.push(out.values.len());
        }
        out
    }

    /// Largest magnitude of an entry.
    pub fn max_abs(&self) -> f64 {
        self.values.iter().fold(0.0, |m, v| m.max(v.abs()))
    }
}

/// A sparse row vector r: (index, value) pairs, sorted by index.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SparseRow(pub Vec<(usize, f64)>);

impl SparseRow {
    /// Unit row.
    pub fn unit(index: usize) -> Self {
        Self(vec![(index, 1.0)])
    }

    /// Adds factor × `other`.
    pub fn add_scaled(&mut self, factor: f64, other: &SparseRow) {
        for &(i, v) in &other.0 {
            match self.0.binary_search_by_key(&i, |&(k, _)| k) {
                Ok(at) => self.0[at].1 += factor * v,
                Err(at) => self.0.insert(at, (i, factor * v)),
            }
        }
        self.0.retain(|&(_, v)| v != 0.0);
    }

    /// The row of absolute values.
    pub fn abs(mut self) -> Self {
        self.0.iter_mut().for_each(|(_, v)| *v = v.abs());
        self
    }

    /// r · x.
    pub fn dot(&self, x: &[f64]) -> f64 {
        self.0.iter().map(|&(i, v)| v * x[i]).sum()
    }

    /// r · x for a complex vector.
    pub fn dot_complex(&self, x: &[super::Complex64]) -> super::Complex64 {
        self.0.iter().map(|&(i, v)| x[i] * v).sum()
    }

    /// y ← y + factor rᵀ: the load vector of a force in the row's direction.
    pub fn add_to(&self, factor: f64, y: &mut [f64]) {
        for &(i, v) in &self.0 {
            y[i] += factor * v;
        }
    }
}
