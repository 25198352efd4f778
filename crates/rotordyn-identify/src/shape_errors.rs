//! Errors of mode shapes: noise of the FRFs, and shapes of other modes mixed in by the errors of their poles.
//!
//! Shapes are the linear unknowns x of H = A(λ) x. At fixed poles the noise σ of an output gives them the covariance
//! σ² (AᵀA)⁻¹: large for a mode that the references hardly excite. A change δλ of another mode's pole changes them by
//! −A⁺ D ψ δλ, with D = ∂A/∂λ: it mixes that mode's shape ψ into this one. The mode's own pole only scales its shape.

use nalgebra::DMatrix;

use super::dense::tr_mul;
use super::refine::{FitPoint, Problem};
use super::uncertainty::PoleCovariance;

/// E|δψ|² `[mode][output]` in the scales of the data; infinite if the modes are not distinguishable.
pub(super) fn shape_variances(
    problem: &Problem,
    at: &FitPoint,
    covariance: &[PoleCovariance],
) -> Vec<Vec<f64>> {
    let (modes, outputs, unknowns) = (at.poles.len(), at.x.ncols(), at.x.nrows());
    let Some(inverse) = at.r.solve_upper_triangular(&DMatrix::identity(unknowns, unknowns)) else {
        return vec![vec![f64::INFINITY; outputs]; modes];
    };
    let freedom = at.residual.nrows().saturating_sub(unknowns).max(1) as f64;
    let noise: Vec<f64> = at.residual.column_iter().map(|own| own.norm_squared() / freedom).collect();
    let (columns, parameters) = problem.derivative_columns(&at.poles);
    // A⁺ D, in the scaled columns of A = Q R diag(sizes).
    let mixed = &inverse * tr_mul(&at.q, &columns);
    let one = |m: usize, o: usize| {
        let rows = [2 * m, 2 * m + 1];
        let own: f64 = rows.iter().map(|&row| inverse.row(row).norm_squared() / at.sizes[row].powi(2)).sum();
        let mut sum = noise[o] * own;
        let others = parameters.iter().enumerate().filter(|(_, p)| p.input.is_none() && p.mode != m);
        for (k, other) in others {
            let psi = at.shape(other.mode, o);
            let [re, im, both] = covariance[other.mode];
            for row in rows {
                let [p, q] = [mixed[(row, 2 * k)], mixed[(row, 2 * k + 1)]].map(|v| v / at.sizes[row]);
                // For ψ δλ = (ψ' a − ψ'' b) + j (ψ'' a + ψ' b).
                let (a, b) = (p * psi.re + q * psi.im, q * psi.re - p * psi.im);
                sum += (a * a * re + b * b * im + 2.0 * a * b * both).max(0.0);
            }
        }
        sum
    };
    (0..modes).map(|m| (0..outputs).map(|o| one(m, o)).collect()).collect()
}
