//! Groups of parameters that the data cannot separate: the combination that they determine, and the one they do not.

use nalgebra::DMatrix;

use super::identifiability::Identifiability;
use super::parameter::FreeParameter;

/// Correlation of a parameter with the others together above which it belongs to a group.
const MIN_CORRELATION: f64 = 0.95;
/// Partial correlation of two parameters above which they are in the same group.
const MIN_PARTIAL: f64 = 0.5;

/// Parameters that the data determine together but not each.
#[derive(Clone, Debug, PartialEq)]
pub struct Group {
    /// Parameters, in their order.
    pub members: Vec<usize>,
    /// Combination of the smallest standard error.
    pub determined: Combination,
    /// Combination of the largest standard error.
    pub undetermined: Combination,
}

/// A linear combination of the relative changes of parameters, Σ w_j d ln p_j with |w| = 1; of an additive parameter the
/// change over its prior's standard deviation.
#[derive(Clone, Debug, PartialEq)]
pub struct Combination {
    /// Weight of every member; the largest is positive.
    pub weights: Vec<f64>,
    /// Its standard error.
    pub error: f64,
}

/// Groups of a fit, by the covariance C of its parameters.
///
/// A parameter belongs to a group if the correlation R with the best combination of all others exceeds 0.95,
/// R² = 1 − 1/(C_jj (C⁻¹)_jj); two of them are in the same group if their partial correlation exceeds 0.5,
/// ρ_ij = −(C⁻¹)_ij / √((C⁻¹)_ii (C⁻¹)_jj). For two parameters both are their correlation. Source: Anderson, *An
/// Introduction to Multivariate Statistical Analysis* (2003), section 2.5.
pub fn groups(found: &Identifiability, parameters: &[FreeParameter]) -> Vec<Group> {
    let n = parameters.len();
    let unit = |j: usize| if parameters[j].logarithmic { 1.0 } else { parameters[j].deviation };
    let error = |j: usize| found.errors[j] / unit(j);
    let covariance = DMatrix::from_fn(n, n, |i, j| found.correlation[i][j] * error(i) * error(j));
    let Some(inverse) = DMatrix::from_fn(n, n, |i, j| found.correlation[i][j]).try_inverse() else {
        return Vec::new();
    };
    let inseparable = |j: usize| 1.0 - inverse[(j, j)].recip() > MIN_CORRELATION.powi(2);
    let partial = |i: usize, j: usize| (inverse[(i, j)] / (inverse[(i, i)] * inverse[(j, j)]).sqrt()).abs();
    let mut left: Vec<usize> = (0..n).filter(|&j| inseparable(j)).collect();
    let mut out = Vec::new();
    while let Some(first) = left.first().copied() {
        left.remove(0);
        let mut members = vec![first];
        let mut next = 0;
        while next < members.len() {
            let here = members[next];
            let (joined, others): (Vec<usize>, Vec<usize>) =
                left.iter().copied().partition(|&j| partial(here, j) > MIN_PARTIAL);
            members.extend(joined);
            left = others;
            next += 1;
        }
        if members.len() > 1 {
            members.sort_unstable();
            out.push(group(&covariance, members));
        }
    }
    out
}

fn group(covariance: &DMatrix<f64>, members: Vec<usize>) -> Group {
    let n = members.len();
    let own = DMatrix::from_fn(n, n, |i, j| covariance[(members[i], members[j])]).symmetric_eigen();
    let mut order: Vec<usize> = (0..n).collect();
    order.sort_by(|&a, &b| own.eigenvalues[a].total_cmp(&own.eigenvalues[b]));
    let combination = |k: usize| {
        let weights: Vec<f64> = own.eigenvectors.column(k).iter().copied().collect();
        let largest = weights.iter().copied().max_by(|a, b| a.abs().total_cmp(&b.abs())).unwrap_or(1.0);
        Combination {
            weights: weights.iter().map(|w| w * largest.signum()).collect(),
            error: own.eigenvalues[k].max(0.0).sqrt(),
        }
    };
    // A group has at least two members.
    let (determined, undetermined) = (combination(order[0]), combination(order[n - 1]));
    Group { members, determined, undetermined }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::identifiability::identifiability;
    use crate::least_squares::{Evaluation, Prior};
    use crate::parameter::ModelNumber;

    /// Groups of a fit with these sensitivities (rows: data of unit deviation) and priors of a factor of two.
    fn of(jacobian: &[&[f64]]) -> Vec<Group> {
        let n = jacobian[0].len();
        let parameters: Vec<FreeParameter> = (0..n)
            .map(|j| {
                let path = format!("p{j}");
                let place = ModelNumber { path, value: 2.0, unit: "N/m".into(), quoted: true };
                FreeParameter::new("p", vec![place], true, None).unwrap()
            })
            .collect();
        let rows = jacobian.len();
        let jacobian = DMatrix::from_fn(rows, n, |i, j| jacobian[i][j]);
        let at = Evaluation::of_frequencies(vec![0.0; rows], jacobian);
        let prior = Prior {
            mean: vec![0.0; n],
            deviation: vec![std::f64::consts::LN_2; n],
            lower: vec![-9.0; n],
            upper: vec![9.0; n],
        };
        groups(&identifiability(&at, &prior), &parameters)
    }

    #[test]
    fn sum_of_two_is_determined_and_a_third_is_apart() {
        let found = of(&[&[100.0, 100.0, 0.0], &[0.0, 0.0, 100.0]]);
        assert_eq!(found.len(), 1);
        let group = &found[0];
        assert_eq!(group.members, [0, 1]);
        let half = 0.5_f64.sqrt();
        for (weights, expected) in
            [(&group.determined.weights, [half, half]), (&group.undetermined.weights, [half, -half])]
        {
            // Signs of equal weights are those of the first or the second.
            let same = |sign: f64| weights.iter().zip(expected).all(|(w, e)| (w - sign * e).abs() < 1e-3);
            assert!(same(1.0) || same(-1.0), "{weights:?}");
        }
        // The sum is known to 1/(100 √2), the difference as before.
        assert!((group.determined.error * 100.0 * 2f64.sqrt() - 1.0).abs() < 1e-3, "{group:?}");
        assert!((group.undetermined.error - std::f64::consts::LN_2).abs() < 1e-6, "{group:?}");
    }

    #[test]
    fn sum_of_three_is_a_group_although_no_pair_is_correlated() {
        let found = of(&[&[100.0, 100.0, 100.0]]);
        assert_eq!(found.len(), 1);
        assert_eq!(found[0].members, [0, 1, 2]);
        assert!(found[0].determined.weights.iter().all(|w| (w - 3f64.sqrt().recip()).abs() < 1e-3));
    }

    #[test]
    fn two_groups_and_none() {
        let found = of(&[&[100.0, 100.0, 0.0, 0.0], &[0.0, 0.0, 100.0, -50.0]]);
        let members: Vec<_> = found.iter().map(|group| group.members.clone()).collect();
        assert_eq!(members, [vec![0, 1], vec![2, 3]]);
        assert_eq!(of(&[&[100.0, 0.0], &[0.0, 100.0]]), []);
        assert_eq!(of(&[&[100.0]]), []);
        assert_eq!(of(&[&[100.0, 40.0], &[30.0, -100.0]]), []);
    }
}
