//! Generalised minimal residual method (GMRES) with right preconditioning.

use super::dot::dot_in_fours as dot;

/// Result of [`gmres`].
#[derive(Clone, Debug, PartialEq)]
pub struct GmresResult {
    /// Best x in the Krylov space.
    pub solution: Vec<f64>,
    /// ‖b − A x‖ / ‖b‖.
    pub residual: f64,
    /// Products with A.
    pub products: usize,
}

/// Solves A x = b from x = 0 to ‖b − A x‖ ≤ `tolerance` ‖b‖ in at most `max_products` matrix-vector products.
///
/// `apply(v, out)`: out = A v; `precondition(v)`: v ← M⁻¹ v in place, M ≈ A. Arnoldi by modified
/// Gram-Schmidt, least squares by Givens rotations; no restarts. Check `residual`: the tolerance may not be
/// reached.
///
/// Source: Saad & Schultz 1986.
pub fn gmres(
    mut apply: impl FnMut(&[f64], &mut [f64]),
    mut precondition: impl FnMut(&mut [f64]),
    b: &[f64],
    tolerance: f64,
    max_products: usize,
) -> GmresResult {
    let n = b.len();
    let norm = dot(b, b).sqrt();
    if norm == 0.0 {
        return GmresResult { solution: vec![0.0; n], residual: 0.0, products: 0 };
    }
    let mut basis = vec![b.iter().map(|v| v / norm).collect::<Vec<_>>()];
    // Columns of the triangular factor of the Hessenberg matrix, rotations, rotated right-hand side.
    let mut columns: Vec<Vec<f64>> = Vec::new();
    let mut rotations: Vec<[f64; 2]> = Vec::new();
    let mut right = vec![norm];
    let mut preconditioned = vec![0.0; n];
    while columns.len() < max_products && right[columns.len()].abs() > tolerance * norm {
        let k = columns.len();
        preconditioned.copy_from_slice(&basis[k]);
        precondition(&mut preconditioned);
        let mut w = vec![0.0; n];
        apply(&preconditioned, &mut w);
        let mut column = Vec::with_capacity(k + 2);
        for v in &basis {
            let h = dot(&w, v);
            w.iter_mut().zip(v).for_each(|(w, v)| *w -= h * v);
            column.push(h);
        }
        let length = dot(&w, &w).sqrt();
        for (i, [c, s]) in rotations.iter().enumerate() {
            (column[i], column[i + 1]) =
                (c * column[i] + s * column[i + 1], c * column[i + 1] - s * column[i]);
        }
        let r = column[k].hypot(length);
        if r == 0.0 || !r.is_finite() {
            break;
        }
        let [c, s] = [column[k] / r, length / r];
        column[k] = r;
        rotations.push([c, s]);
        columns.push(column);
        right.push(-s * right[k]);
        right[k] *= c;
        if length == 0.0 {
            break;
        }
        basis.push(w.iter().map(|w| w / length).collect());
    }
    let k = columns.len();
    let mut y = right[..k].to_vec();
    for i in (0..k).rev() {
        y[i] /= columns[i][i];
        for row in 0..i {
            y[row] -= columns[i][row] * y[i];
        }
    }
    let mut solution = vec![0.0; n];
    for (y, v) in y.iter().zip(&basis) {
        solution.iter_mut().zip(v).for_each(|(x, v)| *x += y * v);
    }
    precondition(&mut solution);
    GmresResult { solution, residual: right[k].abs() / norm, products: k }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn solves_and_reports_the_residual() {
        let n = 40;
        let apply = |x: &[f64], y: &mut [f64]| {
            for i in 0..n {
                y[i] = (3.0 + i as f64) * x[i] - if i > 0 { x[i - 1] } else { 0.0 } - 0.5 * x[(i + 7) % n];
            }
        };
        let precondition = |x: &mut [f64]| x.iter_mut().enumerate().for_each(|(i, x)| *x /= 3.0 + i as f64);
        let x: Vec<f64> = (0..n).map(|i| (i as f64).sin()).collect();
        let mut b = vec![0.0; n];
        apply(&x, &mut b);
        let found = gmres(apply, precondition, &b, 1e-12, n);
        assert!(found.residual < 1e-12 && found.products < 30, "{found:?}");
        assert!(found.solution.iter().zip(&x).all(|(u, v)| (u - v).abs() < 1e-10));
        let early = gmres(apply, precondition, &b, 1e-12, 2);
        let mut product = vec![0.0; n];
        apply(&early.solution, &mut product);
        let error: f64 = product.iter().zip(&b).map(|(u, v)| (u - v).powi(2)).sum::<f64>().sqrt();
        assert!((error / dot(&b, &b).sqrt() / early.residual - 1.0).abs() < 1e-10);
        assert_eq!(gmres(apply, precondition, &vec![0.0; n], 1e-12, 2).products, 0);
    }
}
