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

/// Σ aᵢ bᵢ as sixteen partial sums: several of the widest vectors at once, with the same rounding on every processor.
#[inline(always)]
pub fn dot_in_sixteens(a: &[f64], b: &[f64]) -> f64 {
    let (sixteens, rest) = a.as_chunks::<16>();
    let (others, other_rest) = b[..a.len()].as_chunks::<16>();
    let mut sums = [0.0; 16];
    for (a, b) in sixteens.iter().zip(others) {
        for k in 0..16 {
            sums[k] += a[k] * b[k];
        }
    }
    let fours: [f64; 4] = std::array::from_fn(|k| (sums[k] + sums[k + 4]) + (sums[k + 8] + sums[k + 12]));
    (fours[0] + fours[1]) + (fours[2] + fours[3]) + dot(rest, other_rest)
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
