//! Background of a spectrum: its running median.

use super::statistics::median;

/// Running median over ± `half_width` bins, truncated at the ends; the bin at 0 Hz is excluded.
///
/// A median of zero (a mostly empty spectrum) is replaced by the rounding error of the largest value.
pub(crate) fn running_median(values: &[f64], half_width: usize) -> Vec<f64> {
    let largest = values.iter().copied().fold(0.0, f64::max);
    let floor = (f64::EPSILON * largest).max(f64::MIN_POSITIVE);
    // One median per eighth of the half-width, shared by the bins around it.
    let stride = (half_width / 8).max(1);
    let at = |middle: usize| {
        let range = middle.saturating_sub(half_width).max(1)..(middle + half_width + 1).min(values.len());
        median(values[range].to_vec()).max(floor)
    };
    let mut out = vec![0.0; values.len()];
    for (chunk, part) in out.chunks_mut(stride).enumerate() {
        part.fill(at((chunk * stride + stride / 2).min(values.len() - 1)));
    }
    out
}
