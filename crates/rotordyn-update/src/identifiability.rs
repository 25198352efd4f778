//! Identifiability of the parameters: standard errors, correlation, and the share of prior knowledge.

use nalgebra::DMatrix;

use super::least_squares::{Evaluation, Prior};

/// Maximum ratio of posterior to prior variance of an identifiable parameter.
pub const MAX_PRIOR_SHARE: f64 = 0.1;
/// Maximum relative standard error of an identifiable parameter (additive: over the prior's deviation).
pub const MAX_RELATIVE_ERROR: f64 = 0.1;
/// Ratio of posterior to prior variance above which a parameter is not identifiable (dominated by the prior).
pub const PRIOR_DOMINATED_SHARE: f64 = 0.5;

/// Standard errors and their correlation, from the Gauss-Newton Hessian at the solution.
#[derive(Clone, Debug, PartialEq)]
pub struct Identifiability {
    /// Singular values of the weighted sensitivity matrix, parameters scaled by their prior deviation,
    /// largest first: a direction with σ < 1 is determined by the prior more than by the data.
    pub singular_values: Vec<f64>,
    /// Right singular vectors `directions[k][parameter]`, of unit length.
    pub directions: Vec<Vec<f64>>,
    /// Posterior standard error of every coordinate, times √(χ²/ν) if the fit is worse than its weights.
    pub errors: Vec<f64>,
    /// Ratio of posterior to prior variance, 0 (determined by the data) to 1 (determined by the prior).
    pub prior_share: Vec<f64>,
    /// Correlation of the errors.
    pub correlation: Vec<Vec<f64>>,
    /// χ² = |r|² of the data, and the degrees of freedom ν: data minus the effective number of parameters.
    pub chi_squared: f64,
    pub degrees_of_freedom: f64,
    /// Scale factor of the standard errors, √(χ²/ν), at least 1.
    pub inflation: f64,
}

/// Posterior covariance (JᵀJ + P)⁻¹, in coordinates over their prior deviations: (Σ σ_k² v_k v_kᵀ + 1)⁻¹.
pub fn identifiability(at: &Evaluation, prior: &Prior) -> Identifiability {
    let n = prior.deviation.len();
    let scaled = DMatrix::from_fn(at.jacobian.nrows(), n, |i, j| at.jacobian[(i, j)] * prior.deviation[j]);
    let square = scaled.tr_mul(&scaled).symmetric_eigen();
    let mut order: Vec<usize> = (0..n).collect();
    order.sort_by(|&a, &b| square.eigenvalues[b].total_cmp(&square.eigenvalues[a]));
    let values: Vec<f64> = order.iter().map(|&k| square.eigenvalues[k].max(0.0)).collect();
    let directions: Vec<Vec<f64>> =
        order.iter().map(|&k| square.eigenvectors.column(k).iter().copied().collect()).collect();
    let covariance = |i: usize, j: usize| -> f64 {
        values.iter().zip(&directions).map(|(s, v)| v[i] * v[j] / (1.0 + s)).sum()
    };
    let effective_parameters: f64 = values.iter().map(|s| s / (1.0 + s)).sum();
    let chi_squared = at.residual.norm_squared();
    let degrees = at.data - effective_parameters;
    let inflation = if degrees > 0.5 { (chi_squared / degrees).sqrt().max(1.0) } else { 1.0 };
    let prior_share: Vec<f64> = (0..n).map(|i| covariance(i, i)).collect();
    Identifiability {
        singular_values: values.iter().map(|s| s.sqrt()).collect(),
        errors: (0..n).map(|i| inflation * prior.deviation[i] * prior_share[i].sqrt()).collect(),
        correlation: (0..n)
            .map(|i| (0..n).map(|j| covariance(i, j) / (prior_share[i] * prior_share[j]).sqrt()).collect())
            .collect(),
        directions,
        prior_share,
        chi_squared,
        degrees_of_freedom: degrees,
        inflation,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::DVector;

    #[test]
    fn sum_is_identifiable_difference_is_not() {
        // One datum determines x + y to 0.01; none determines x − y.
        let at = Evaluation {
            residual: DVector::from_vec(vec![0.0]),
            jacobian: DMatrix::from_row_slice(1, 2, &[100.0, 100.0]),
            data: 1.0,
        };
        let prior =
            Prior { mean: vec![0.0; 2], deviation: vec![1.0; 2], lower: vec![-9.0; 2], upper: vec![9.0; 2] };
        let found = identifiability(&at, &prior);
        assert!((found.singular_values[0] - 2f64.sqrt() * 100.0).abs() < 1e-9);
        assert!(found.singular_values[1] < 1e-6);
        // Half of each prior's variance is in the difference.
        assert!((found.prior_share[0] - 0.5).abs() < 1e-4, "{:?}", found.prior_share);
        assert!(found.correlation[0][1] < -0.999);
    }
}
