//! Power of an FRF and of its noise.

use rotordyn_linalg::Complex64;

/// Root mean square of |H|.
pub(super) fn rms(frf: &[Complex64]) -> f64 {
    (frf.iter().map(|h| h.norm_sqr()).sum::<f64>() / frf.len() as f64).sqrt()
}

/// Noise RMS (scatter from line to line), by the median of third differences: E|n₃ − 3n₂ + 3n₁ − n₀|² = 20
/// σ², of which the median is ln 2. Robust to resonances, whether wide or sharp.
pub(super) fn noise_rms(frf: &[Complex64]) -> f64 {
    let third = |w: &[Complex64]| (w[3] - w[2] * 3.0 + w[1] * 3.0 - w[0]).norm_sqr();
    let mut all: Vec<f64> = frf.windows(4).map(third).collect();
    if all.is_empty() {
        return 0.0;
    }
    let middle = all.len() / 2;
    let median = *all.select_nth_unstable_by(middle, f64::total_cmp).1;
    (median / (20.0 * std::f64::consts::LN_2)).sqrt()
}
