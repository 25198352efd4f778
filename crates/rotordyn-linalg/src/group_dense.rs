//! Symmetric matrices that are dense within groups of unknowns and zero between them.

use super::dot::dot_in_fours;
use super::{Complex64, SparseMatrix, Triplets};
use nalgebra::DMatrix;

/// A symmetric matrix of dense blocks; each unknown belongs to at most one block.
#[derive(Clone, Debug, PartialEq)]
pub struct GroupDense {
    size: usize,
    blocks: Vec<(Vec<usize>, DMatrix<f64>)>,
}

impl GroupDense {
    /// Matrix of order `size` with a symmetric block over each list of unknowns.
    pub fn new(size: usize, blocks: Vec<(Vec<usize>, DMatrix<f64>)>) -> Self {
        Self { size, blocks }
    }

    /// Number of rows.
    pub fn size(&self) -> usize {
        self.size
    }

    /// y ← y + factor A x.
    pub fn mul_add(&self, factor: f64, x: &[f64], y: &mut [f64]) {
        for (unknowns, block) in &self.blocks {
            let part: Vec<f64> = unknowns.iter().map(|&i| x[i]).collect();
            // By symmetry row i is column i, which is contiguous.
            for (row, &i) in block.as_slice().chunks_exact(part.len().max(1)).zip(unknowns) {
                y[i] += factor * dot_in_fours(row, &part);
            }
        }
    }

    /// A x for a complex vector.
    pub fn mul_complex(&self, x: &[Complex64]) -> Vec<Complex64> {
        let mut out = vec![Complex64::default(); self.size];
        for (unknowns, block) in &self.blocks {
            let re: Vec<f64> = unknowns.iter().map(|&i| x[i].re).collect();
            let im: Vec<f64> = unknowns.iter().map(|&i| x[i].im).collect();
            for (row, &i) in block.as_slice().chunks_exact(re.len().max(1)).zip(unknowns) {
                out[i] = Complex64::new(dot_in_fours(row, &re), dot_in_fours(row, &im));
            }
        }
        out
    }

    /// Rows and columns of `unknowns`, renumbered in their order; each block must be inside or outside.
    pub fn submatrix(&self, unknowns: &[usize]) -> Self {
        let mut place = vec![None; self.size];
        for (p, &i) in unknowns.iter().enumerate() {
            place[i] = Some(p);
        }
        let blocks = self.blocks.iter().filter_map(|(group, block)| {
            let local: Option<Vec<usize>> = group.iter().map(|&i| place[i]).collect();
            local.map(|local| (local, block.clone()))
        });
        Self { size: unknowns.len(), blocks: blocks.collect() }
    }

    /// Adds factor × this matrix to a dense one.
    pub fn add_to(&self, factor: f64, to: &mut DMatrix<f64>) {
        for (unknowns, block) in &self.blocks {
            for (q, &j) in unknowns.iter().enumerate() {
                for (p, &i) in unknowns.iter().enumerate() {
                    to[(i, j)] += factor * block[(p, q)];
                }
            }
        }
    }

    /// Sparse copy.
    pub fn to_sparse(&self) -> SparseMatrix {
        let mut out = Triplets::new(self.size, self.size);
        for (unknowns, block) in &self.blocks {
            for (q, &j) in unknowns.iter().enumerate() {
                for (p, &i) in unknowns.iter().enumerate() {
                    out.add(i, j, block[(p, q)]);
                }
            }
        }
        out.build()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn products_and_submatrices_equal_the_dense_ones() {
        let block = |n: usize, s: f64| DMatrix::from_fn(n, n, |i, j| s + (i * j) as f64 - (i + j) as f64);
        let a = GroupDense::new(7, vec![(vec![4, 0, 6], block(3, 2.0)), (vec![1, 5], block(2, -1.0))]);
        let dense = a.to_sparse().to_dense();
        assert_eq!(dense, dense.transpose());
        let x: Vec<f64> = (0..7).map(|i| (i as f64 + 0.3).sin()).collect();
        let mut y = vec![1.0; 7];
        a.mul_add(-2.0, &x, &mut y);
        let expected =
            nalgebra::DVector::from_element(7, 1.0) - 2.0 * &dense * nalgebra::DVector::from_vec(x.clone());
        assert!(y.iter().zip(expected.iter()).all(|(a, b)| (a - b).abs() < 1e-14));
        let z: Vec<Complex64> = x.iter().map(|&v| Complex64::new(v, -3.0 * v)).collect();
        for (v, w) in a.mul_complex(&z).iter().zip(a.to_sparse().mul_complex(&z)) {
            assert!((v - w).norm() < 1e-14);
        }
        let part = a.submatrix(&[6, 5, 0, 1, 4]);
        let mut to = DMatrix::zeros(5, 5);
        part.add_to(1.0, &mut to);
        for (p, i) in [6, 5, 0, 1, 4].into_iter().enumerate() {
            for (q, j) in [6, 5, 0, 1, 4].into_iter().enumerate() {
                assert_eq!(to[(p, q)], dense[(i, j)]);
            }
        }
    }
}
