//! Scalar products of real vectors.

/// Σ aᵢ bᵢ, summed in order of the entries.
#[inline]
pub fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// Σ aᵢ bᵢ as four partial sums: vectorises, with the same rounding on every processor.
#[inline]
pub(super) fn dot_in_fours(a: &[f64], b: &[f64]) -> f64 {
    let (sums, rest) = partial_sums(a, b);
    (sums[0] + sums[1]) + (sums[2] + sums[3]) + rest
}

/// Sums of every fourth product, and the sum of the remaining products.
#[inline]
pub(super) fn partial_sums(a: &[f64], b: &[f64]) -> ([f64; 4], f64) {
    let (mut sums, whole) = ([0.0; 4], a.len() / 4 * 4);
    for (a, b) in a[..whole].chunks_exact(4).zip(b.chunks_exact(4)) {
        for (sum, (a, b)) in sums.iter_mut().zip(a.iter().zip(b)) {
            *sum += a * b;
        }
    }
    (sums, dot(&a[whole..], &b[whole..]))
}
