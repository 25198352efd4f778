//! What is left of a response at the end of its block, frequency by frequency.
//!
//! A mode decays with its own rate: in an acceleration the high modes make the peak and are gone long before the lowest, whose
//! FRF the end of the block still spoils. Amplitudes at each frequency in the first and in the last quarter after the hit give
//! its decay, and this what is left at the end.

use crate::segment::SegmentTransform;
use crate::statistics::median;
use crate::window::WindowKind;

/// Least samples of a quarter.
const MIN_LENGTH: usize = 32;
/// Least power of a frequency over that of the strongest one, and over the median in the last quarter, which is noise.
const MIN_SHARE: f64 = 1e-3;
const STANDS_OUT: f64 = 20.0;

/// Largest amplitude at the end over that at the start, of all strong frequencies of a response from the end of the contact on;
/// 0 if nothing but noise is left.
pub(super) fn left_at_end(response: &[f64]) -> f64 {
    let (all, length) = (response.len(), response.len() / 4);
    if length < MIN_LENGTH {
        return 0.0;
    }
    let mut transform = SegmentTransform::new(WindowKind::Hann, length, length);
    let mut powers = |part: &[f64]| -> Vec<f64> {
        let mean = part.iter().sum::<f64>() / part.len() as f64;
        transform.transform(part, mean).iter().map(|x| x.norm_sqr()).collect()
    };
    let (first, last) = (powers(&response[..length]), powers(&response[all - length..]));
    // The first bins hold what is left of the mean.
    const LOWEST: usize = 2;
    let strongest = first.iter().skip(LOWEST).copied().fold(0.0, f64::max);
    let noise = median(last.clone());
    let peak = |k: &usize| {
        let around = |powers: &[f64]| powers[*k - 1].max(powers[*k + 1]).max(powers[*k]);
        last[*k] >= around(&last) && last[*k] > STANDS_OUT * noise && around(&first) > MIN_SHARE * strongest
    };
    let left = |k: usize| {
        let before = first[k - 1].max(first[k]).max(first[k + 1]);
        // The quarters are all − length samples apart.
        (last[k] / before).sqrt().min(1.0).powf(all as f64 / (all - length) as f64)
    };
    (LOWEST..last.len() - 1).filter(peak).map(left).fold(0.0, f64::max)
}
