//! Allocation-free dense solver for small linear systems inside a time step.

/// Solves A x = b in place by Gaussian elimination with partial pivoting; `b` becomes x.
///
/// `a`: row-major n × n, destroyed; `b`: n. Returns false for a zero or non-finite pivot.
pub fn solve_in_place(a: &mut [f64], b: &mut [f64]) -> bool {
    let n = b.len();
    debug_assert_eq!(a.len(), n * n);
    for k in 0..n {
        let mut pivot = k;
        for row in k + 1..n {
            if a[row * n + k].abs() > a[pivot * n + k].abs() {
                pivot = row;
            }
        }
        let value = a[pivot * n + k];
        if value == 0.0 || !value.is_finite() {
            return false;
        }
        if pivot != k {
            for column in k..n {
                a.swap(k * n + column, pivot * n + column);
            }
            b.swap(k, pivot);
        }
        let (top, below) = a.split_at_mut((k + 1) * n);
        let pivot_row = &top[k * n..];
        let inverse = 1.0 / value;
        for (offset, row) in below.chunks_exact_mut(n).enumerate() {
            let factor = row[k] * inverse;
            if factor != 0.0 {
                for column in k + 1..n {
                    row[column] -= factor * pivot_row[column];
                }
                b[k + 1 + offset] -= factor * b[k];
            }
        }
    }
    for k in (0..n).rev() {
        let sum: f64 = (k + 1..n).map(|c| a[k * n + c] * b[c]).sum();
        b[k] = (b[k] - sum) / a[k * n + k];
    }
    true
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn solves_and_rejects_singular_matrices() {
        // Needs a row exchange at the first pivot.
        let a = [0.0, 2.0, 1.0, 1.0, -1.0, 3.0, 4.0, 0.5, -2.0];
        let x = [1.5, -2.0, 0.25];
        let mut b = [0.0; 3];
        for i in 0..3 {
            b[i] = (0..3).map(|j| a[3 * i + j] * x[j]).sum();
        }
        assert!(solve_in_place(&mut a.clone(), &mut b));
        assert!(b.iter().zip(&x).all(|(p, q)| (p - q).abs() < 1e-14));
        assert!(!solve_in_place(&mut [1.0, 2.0, 2.0, 4.0], &mut [1.0, 1.0]));
        assert!(!solve_in_place(&mut [f64::NAN], &mut [1.0]));
    }
}
