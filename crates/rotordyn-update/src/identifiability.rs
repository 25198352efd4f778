//! Identifiability of the parameters: standard errors, correlation, and the share of prior knowledge.

use nalgebra::DMatrix;

use super::data_kind::{DataKind, KindFit};
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
    /// Standard error of every coordinate.
    pub errors: Vec<f64>,
    /// Ratio of posterior to prior variance, 0 (determined by the data) to 1 (determined by the prior).
    pub prior_share: Vec<f64>,
    /// Correlation of the errors.
    pub correlation: Vec<Vec<f64>>,
    /// χ² = |r|² of the data, and the degrees of freedom ν: data minus the effective number of parameters.
    pub chi_squared: f64,
    pub degrees_of_freedom: f64,
    /// The same for every kind of data.
    pub by_kind: Vec<KindFit>,
    /// Factor of every standard error by the misfit, at least 1.
    pub scale: Vec<f64>,
}

/// Standard errors and identifiability at a solution with sensitivities J and prior weights P.
///
/// The covariance is C = (JᵀJ + P)⁻¹ if every kind of data k has its stated deviations. Those of a kind that fits worse are
/// larger by s_k = √(χ²_k/ν_k), and the errors have the covariance C (Σ s_k² J_kᵀJ_k + P) C; a kind with less than one degree
/// of freedom takes the factor of all data. Source: White, Econometrica 50 (1982), theorem 3.2, with a variance for each kind.
pub fn identifiability(at: &Evaluation, prior: &Prior) -> Identifiability {
    let n = prior.deviation.len();
    // In coordinates over their prior deviations, P = 1.
    let scaled = DMatrix::from_fn(at.jacobian.nrows(), n, |i, j| at.jacobian[(i, j)] * prior.deviation[j]);
    let (values, directions) = principal_axes(&scaled);
    let stated = DMatrix::from_fn(n, n, |i, j| -> f64 {
        values.iter().zip(&directions).map(|(s, v)| v[i] * v[j] / (1.0 + s)).sum()
    });
    let effective_parameters: f64 = values.iter().map(|s| s / (1.0 + s)).sum();
    let chi_squared = at.residual.norm_squared();
    let degrees_of_freedom = at.data.iter().sum::<f64>() - effective_parameters;
    let of_all = if degrees_of_freedom > 0.5 { (chi_squared / degrees_of_freedom).max(1.0) } else { 1.0 };
    let mut by_kind = Vec::new();
    let mut spread = DMatrix::identity(n, n);
    for kind in DataKind::ALL {
        let rows: Vec<usize> = (0..at.kinds.len()).filter(|&i| at.kinds[i] == kind).collect();
        if rows.is_empty() {
            continue;
        }
        let own = scaled.select_rows(&rows);
        let square = own.tr_mul(&own);
        let data = at.data[kind as usize];
        let fit = KindFit {
            kind,
            data,
            chi_squared: rows.iter().map(|&i| at.residual[i].powi(2)).sum(),
            degrees_of_freedom: data - stated.component_mul(&square).sum(),
        };
        let worse = match fit.is_tested() {
            true => (fit.chi_squared / fit.degrees_of_freedom).max(1.0),
            false => of_all,
        };
        spread += square * worse;
        by_kind.push(fit);
    }
    let covariance = &stated * spread * &stated;
    let prior_share: Vec<f64> = (0..n).map(|i| stated[(i, i)]).collect();
    let deviation: Vec<f64> = (0..n).map(|i| covariance[(i, i)].sqrt()).collect();
    Identifiability {
        singular_values: values.iter().map(|s| s.sqrt()).collect(),
        errors: (0..n).map(|i| prior.deviation[i] * deviation[i]).collect(),
        scale: (0..n).map(|i| deviation[i] / prior_share[i].sqrt()).collect(),
        correlation: (0..n)
            .map(|i| (0..n).map(|j| covariance[(i, j)] / (deviation[i] * deviation[j])).collect())
            .collect(),
        directions,
        prior_share,
        chi_squared,
        degrees_of_freedom,
        by_kind,
    }
}

/// Eigenvalues of JᵀJ, the largest first, and their unit vectors.
fn principal_axes(jacobian: &DMatrix<f64>) -> (Vec<f64>, Vec<Vec<f64>>) {
    // The decomposition refuses an empty matrix.
    if jacobian.ncols() == 0 {
        return (Vec::new(), Vec::new());
    }
    let square = jacobian.tr_mul(jacobian).symmetric_eigen();
    let mut order: Vec<usize> = (0..jacobian.ncols()).collect();
    order.sort_by(|&a, &b| square.eigenvalues[b].total_cmp(&square.eigenvalues[a]));
    let vector = |k: usize| square.eigenvectors.column(k).iter().copied().collect();
    (
        order.iter().map(|&k| square.eigenvalues[k].max(0.0)).collect(),
        order.iter().map(|&k| vector(k)).collect(),
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sum_is_identifiable_difference_is_not() {
        // One datum determines x + y to 0.01; none determines x − y.
        let at = Evaluation::of_frequencies(vec![0.0], DMatrix::from_row_slice(1, 2, &[100.0, 100.0]));
        let prior =
            Prior { mean: vec![0.0; 2], deviation: vec![1.0; 2], lower: vec![-9.0; 2], upper: vec![9.0; 2] };
        let found = identifiability(&at, &prior);
        assert!((found.singular_values[0] - 2f64.sqrt() * 100.0).abs() < 1e-9);
        assert!(found.singular_values[1] < 1e-6);
        // Half of each prior's variance is in the difference.
        assert!((found.prior_share[0] - 0.5).abs() < 1e-4, "{:?}", found.prior_share);
        assert!(found.correlation[0][1] < -0.999);
    }

    #[test]
    fn misfit_of_one_kind_does_not_widen_what_the_other_determines() {
        // x from 9 frequencies off by 3 deviations each, in turns; y from 9 shapes without a misfit.
        let jacobian = DMatrix::from_fn(18, 2, |i, j| if (i < 9) == (j == 0) { 100.0 } else { 0.0 });
        let residual: Vec<f64> = (0..18).map(|i| if i < 8 { 3.0 * (-1f64).powi(i) } else { 0.0 }).collect();
        let mut at = Evaluation::of_frequencies(residual, jacobian);
        at.kinds[9..].fill(DataKind::Shape);
        at.data = [9.0, 0.0, 9.0, 0.0];
        let prior =
            Prior { mean: vec![0.0; 2], deviation: vec![1.0; 2], lower: vec![-9.0; 2], upper: vec![9.0; 2] };
        let found = identifiability(&at, &prior);
        // Each kind has 9 data and one parameter, that of all data 18 and two: 72/8 and 72/16.
        let [frequencies, shapes] = [found.by_kind[0], found.by_kind[1]];
        assert!((frequencies.degrees_of_freedom - 8.0).abs() < 1e-4 && frequencies.chi_squared == 72.0);
        assert!((shapes.degrees_of_freedom - 8.0).abs() < 1e-4 && shapes.chi_squared == 0.0);
        let plain = 1.0 / 300.0;
        assert!((found.errors[0] / (3.0 * plain) - 1.0).abs() < 1e-4, "{:?}", found.errors);
        assert!((found.errors[1] / plain - 1.0).abs() < 1e-4, "{:?}", found.errors);
        assert!((found.scale[0] - 3.0).abs() < 1e-4 && (found.scale[1] - 1.0).abs() < 1e-4);
    }
}
