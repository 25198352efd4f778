//! Logistic regression with coefficients of given signs.

use nalgebra::{DMatrix, DVector};
use rotordyn_signal::grading::{FEATURE_COUNT, Features, MOST_CERTAIN};

/// Penalty on the squares of the coefficients: as much as a tenth of a record.
const RIDGE: f64 = 0.1;

/// Signs of the coefficients, 0 for either: what speaks for a part never lowers its grade, what speaks against it
/// never raises it, whatever chance there is in the records.
const SIGNS: [i8; FEATURE_COUNT] =
    [0, 1, -1, -1, -1, -1, 1, 0, 1, 1, -1, -1, -1, -1, -1, 1, 1, -1, -1, -1, 0, -1, 1, 1, 1, 1, 1];

/// Log-likelihood of right and wrong less the penalty, its gradient, and Fisher's information with the penalty's.
fn likelihood(x: &DMatrix<f64>, right: &[bool], beta: &DVector<f64>) -> (f64, DVector<f64>, DMatrix<f64>) {
    let (mut value, mut slope) = (-0.5 * RIDGE * beta.norm_squared(), DVector::zeros(right.len()));
    let mut weighted = x.clone();
    for (r, right) in right.iter().enumerate() {
        let odds = (x.row(r) * beta)[0];
        let share = 1.0 / (1.0 + (-odds).exp());
        let p = MOST_CERTAIN * share;
        let change = p * (1.0 - share);
        let of_truth = if *right { p } else { 1.0 - p };
        value += of_truth.max(f64::MIN_POSITIVE).ln();
        slope[r] = if *right { 1.0 - share } else { -change / (1.0 - p) };
        weighted.row_mut(r).scale_mut(change * (1.0 - share) / (1.0 - p));
    }
    let information = x.transpose() * weighted + RIDGE * DMatrix::identity(FEATURE_COUNT, FEATURE_COUNT);
    (value, x.transpose() * slope - RIDGE * beta, information)
}

/// Coefficients β of the probability 0.995/(1 + e^(−β·x)) of being right, of the most likelihood with these signs.
///
/// Projected Newton steps: coefficients at a bound that the gradient drives outwards stay there, the others take a
/// scoring step, halved until the likelihood rises. Source: Bertsekas, SIAM J. Control Optim. 20 (1982).
pub fn fitted(rows: &[(&Features, bool)]) -> Features {
    let x = DMatrix::from_fn(rows.len(), FEATURE_COUNT, |r, c| rows[r].0[c]);
    let right: Vec<bool> = rows.iter().map(|(_, right)| *right).collect();
    let admitted = |k: usize, value: f64| match SIGNS[k] {
        1 => value.max(0.0),
        -1 => value.min(0.0),
        _ => value,
    };
    let mut beta = DVector::zeros(FEATURE_COUNT);
    let (mut value, mut gradient, mut information) = likelihood(&x, &right, &beta);
    for _ in 0..500 {
        let free: Vec<usize> =
            (0..FEATURE_COUNT).filter(|&k| beta[k] != 0.0 || admitted(k, gradient[k]) != 0.0).collect();
        let matrix = information.select_rows(&free).select_columns(&free);
        let step = matrix.lu().solve(&gradient.select_rows(&free)).unwrap();
        let moved = |share: f64| {
            let mut next = beta.clone();
            free.iter().zip(step.iter()).for_each(|(&k, s)| next[k] = admitted(k, beta[k] + share * s));
            next
        };
        let better = (0..40).map(|halvings| moved(0.5f64.powi(halvings))).find_map(|next| {
            let found = likelihood(&x, &right, &next);
            (found.0 > value).then_some((next, found))
        });
        let Some((next, found)) = better else { break };
        let change = (&next - &beta).norm();
        beta = next;
        (value, gradient, information) = found;
        if change < 1e-9 * beta.norm() {
            break;
        }
    }
    std::array::from_fn(|k| beta[k])
}
