//! LU factorisation of a square band matrix in its natural order, without pivoting.

use pulp::Arch;

use super::ZeroPivot;
use super::dot::dot_in_fours;

/// Square band matrix; after factorisation, its LU factors in the same memory.
///
/// No row exchanges: for diagonally dominant matrices, such as preconditioners of a Krylov method.
#[derive(Clone, Debug)]
pub struct BandMatrix {
    size: usize,
    lower: usize,
    upper: usize,
    /// Row r contains columns r − lower ..= r + upper.
    values: Vec<f64>,
    arch: Arch,
}

impl BandMatrix {
    /// Zero matrix with `lower` diagonals below and `upper` above the main one.
    pub fn zeros(size: usize, lower: usize, upper: usize) -> Self {
        Self { size, lower, upper, values: vec![0.0; size * (lower + upper + 1)], arch: Arch::new() }
    }

    /// Sets every entry to zero.
    pub fn clear(&mut self) {
        self.values.fill(0.0);
    }

    /// The entries of row `row` in the columns `row` − lower ..= `row` + upper; those outside the matrix unused.
    pub fn row_mut(&mut self, row: usize) -> &mut [f64] {
        let width = self.lower + self.upper + 1;
        &mut self.values[row * width..(row + 1) * width]
    }

    /// Replaces the matrix by its factors L (unit diagonal) and U.
    ///
    /// # Errors
    /// A zero or non-finite pivot, with its row.
    pub fn factor(&mut self) -> Result<(), ZeroPivot> {
        let (n, lower, upper) = (self.size, self.lower, self.upper);
        let width = lower + upper + 1;
        let values = &mut self.values[..];
        self.arch.dispatch(
            #[inline(always)]
            || {
                for j in 0..n {
                    let (head, tail) = values.split_at_mut((j + 1) * width);
                    let pivot = head[j * width + lower];
                    if pivot == 0.0 || !pivot.is_finite() {
                        return Err(ZeroPivot { unknown: j });
                    }
                    let reach = upper.min(n - 1 - j);
                    let from = &head[j * width + lower + 1..][..reach];
                    for r in j + 1..=(j + lower).min(n - 1) {
                        let row = &mut tail[(r - j - 1) * width + lower + j - r..];
                        if row[0] != 0.0 {
                            let factor = row[0] / pivot;
                            row[0] = factor;
                            for (x, u) in row[1..=reach].iter_mut().zip(from) {
                                *x -= factor * u;
                            }
                        }
                    }
                }
                Ok(())
            },
        )
    }

    /// Solves A x = b in place with the factors.
    pub fn solve(&self, b: &mut [f64]) {
        let (n, lower, width) = (self.size, self.lower, self.lower + self.upper + 1);
        debug_assert_eq!(b.len(), n);
        for r in 0..n {
            let first = r.saturating_sub(lower);
            let row = &self.values[r * width + lower + first - r..][..r - first];
            b[r] -= dot_in_fours(row, &b[first..r]);
        }
        for r in (0..n).rev() {
            let reach = self.upper.min(n - 1 - r);
            let row = &self.values[r * width + lower..][..=reach];
            b[r] = (b[r] - dot_in_fours(&row[1..], &b[r + 1..=r + reach])) / row[0];
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn solves_an_unsymmetric_band() {
        let (n, lower, upper) = (30, 5, 2);
        let entry = |r: usize, c: usize| if r == c { 9.0 } else { ((3 * r + 5 * c) % 7) as f64 * 0.3 - 1.0 };
        let mut a = BandMatrix::zeros(n, lower, upper);
        let x: Vec<f64> = (0..n).map(|k| (k as f64).cos()).collect();
        let mut b = vec![0.0; n];
        for (r, sum) in b.iter_mut().enumerate() {
            for (c, x) in x.iter().enumerate().filter(|(c, _)| c + lower >= r && *c <= r + upper) {
                a.row_mut(r)[c + lower - r] = entry(r, c);
                *sum += entry(r, c) * x;
            }
        }
        a.factor().unwrap();
        a.solve(&mut b);
        assert!(b.iter().zip(&x).all(|(u, v)| (u - v).abs() < 1e-12));
        assert_eq!(BandMatrix::zeros(2, 1, 1).factor(), Err(ZeroPivot { unknown: 0 }));
    }
}
