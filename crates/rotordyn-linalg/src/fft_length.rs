//! Efficient lengths for fast Fourier transforms.

/// Smallest multiple of `step` ≥ `least` without prime factors above 5 (5-smooth); `step` must be 5-smooth.
pub fn fft_length(least: usize, step: usize) -> usize {
    let smooth = |n: usize| {
        let mut rest = n;
        for p in [2, 3, 5] {
            while rest.is_multiple_of(p) {
                rest /= p;
            }
        }
        rest == 1
    };
    let start = least.max(1).next_multiple_of(step);
    (start..).step_by(step).find(|n| smooth(*n)).expect("powers of two are smooth and unbounded")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn least_smooth_multiple() {
        assert_eq!([0, 1, 7, 11, 13, 31].map(|n| fft_length(n, 1)), [1, 1, 8, 12, 15, 32]);
        assert_eq!([1, 9, 13, 25].map(|n| fft_length(n, 2)), [2, 10, 16, 30]);
    }
}
