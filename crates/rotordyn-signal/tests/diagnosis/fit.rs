//! Two logistic regressions of which either suffices, with coefficients of given signs.

use nalgebra::{DMatrix, DVector};
use rotordyn_signal::grading::{FEATURE_COUNT, Features, MOST_CERTAIN, PartCoefficients, REGRESSIONS};

use super::random::Random;

/// Penalty on the squares of the coefficients: as much as a tenth of a record.
const RIDGE: f64 = 0.1;
/// The likelihood has several maxima: the highest of those from so many starts.
const STARTS: u64 = 4;

/// Signs of the coefficients, 0 for either: what speaks for a part never lowers its grade, what speaks against it
/// never raises it, whatever chance there is in the records.
const SIGNS: [i8; FEATURE_COUNT] =
    [0, 1, -1, -1, -1, -1, 1, 0, 1, 1, -1, -1, -1, -1, -1, 1, 1, -1, -1, -1, 0, -1, 1, 1, 1, 1, 1];

/// Log-likelihood of right and wrong less the penalty, its gradient, and Fisher's information with the penalty's; the
/// coefficients of the regressions follow each other in `beta`.
fn likelihood(x: &DMatrix<f64>, right: &[bool], beta: &DVector<f64>) -> (f64, DVector<f64>, DMatrix<f64>) {
    let (features, count) = (x.ncols(), beta.len());
    let by_regression = DMatrix::from_column_slice(features, count / features, beta.as_slice());
    let log_odds = x * by_regression;
    let mut value = -0.5 * RIDGE * beta.norm_squared();
    let mut slope = DVector::zeros(right.len());
    let mut weight = DVector::zeros(right.len());
    // Derivatives of the logarithm of the odds by the coefficients.
    let mut jacobian = DMatrix::zeros(right.len(), count);
    for (r, right) in right.iter().enumerate() {
        let highest = log_odds.row(r).max();
        let sum: f64 = log_odds.row(r).iter().map(|z| (z - highest).exp()).sum();
        let share = 1.0 / (1.0 + (-highest).exp() / sum);
        let p = MOST_CERTAIN * share;
        let change = p * (1.0 - share);
        let of_truth = if *right { p } else { 1.0 - p };
        value += of_truth.max(f64::MIN_POSITIVE).ln();
        slope[r] = if *right { 1.0 - share } else { -change / (1.0 - p) };
        weight[r] = change * (1.0 - share) / (1.0 - p);
        for (k, z) in log_odds.row(r).iter().enumerate() {
            let part = (z - highest).exp() / sum;
            jacobian.view_mut((r, k * features), (1, features)).copy_from(&(part * x.row(r)));
        }
    }
    let gradient = jacobian.tr_mul(&slope) - RIDGE * beta;
    let weighted = DMatrix::from_fn(right.len(), count, |r, c| weight[r] * jacobian[(r, c)]);
    let information = jacobian.tr_mul(&weighted) + RIDGE * DMatrix::identity(count, count);
    (value, gradient, information)
}

/// Coefficients β of the probability 0.995 s/(1 + s), s = Σ e^(β·x), of being right, of the most likelihood with these
/// signs.
pub fn fitted(rows: &[(&Features, bool)]) -> PartCoefficients {
    let x = DMatrix::from_fn(rows.len(), FEATURE_COUNT, |r, c| rows[r].0[c]);
    let right: Vec<bool> = rows.iter().map(|(_, right)| *right).collect();
    let (_, single) = most_likely(&x, &right, DVector::zeros(FEATURE_COUNT));
    let start = |seed: u64| {
        let mut random = Random::of_record(seed, 0);
        let near = |k: usize| {
            let (own, sign) = (single[k % FEATURE_COUNT], SIGNS[k % FEATURE_COUNT]);
            let moved = own * (1.0 + 0.5 * random.normal());
            admitted(k, moved + 0.2 * f64::from(sign) * random.unit())
        };
        let indices = 0..REGRESSIONS * FEATURE_COUNT;
        DVector::from_vec(indices.map(near).collect())
    };
    let found = (0..STARTS).map(|seed| most_likely(&x, &right, start(seed)));
    let (_, beta) = found.max_by(|a, b| a.0.total_cmp(&b.0)).unwrap();
    std::array::from_fn(|k| std::array::from_fn(|i| beta[k * FEATURE_COUNT + i]))
}

/// A coefficient of the right sign.
fn admitted(k: usize, value: f64) -> f64 {
    match SIGNS[k % FEATURE_COUNT] {
        1 => value.max(0.0),
        -1 => value.min(0.0),
        _ => value,
    }
}

/// Maximum of the likelihood from a start, and its coefficients.
///
/// Projected Newton steps: coefficients at a bound that the gradient drives outwards stay there, the others take a
/// scoring step, halved until the likelihood rises. Source: Bertsekas, SIAM J. Control Optim. 20 (1982).
fn most_likely(x: &DMatrix<f64>, right: &[bool], start: DVector<f64>) -> (f64, DVector<f64>) {
    let mut beta = start;
    let (mut value, mut gradient, mut information) = likelihood(x, right, &beta);
    for _ in 0..1000 {
        let free: Vec<usize> =
            (0..beta.len()).filter(|&k| beta[k] != 0.0 || admitted(k, gradient[k]) != 0.0).collect();
        let matrix = information.select_rows(&free).select_columns(&free);
        let step = matrix.lu().solve(&gradient.select_rows(&free)).unwrap();
        let moved = |share: f64| {
            let mut next = beta.clone();
            free.iter().zip(step.iter()).for_each(|(&k, s)| next[k] = admitted(k, beta[k] + share * s));
            next
        };
        let better = (0..40).map(|halvings| moved(0.5f64.powi(halvings))).find_map(|next| {
            let found = likelihood(x, right, &next);
            (found.0 > value).then_some((next, found))
        });
        let Some((next, found)) = better else { break };
        let change = (&next - &beta).norm();
        beta = next;
        (value, gradient, information) = found;
        if change < 1e-8 * beta.norm() {
            break;
        }
    }
    (value, beta)
}
