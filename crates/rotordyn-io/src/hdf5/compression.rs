//! Which data sets are worth compressing: the digits of a vibration hardly repeat.

use std::cell::RefCell;

use crate::inflate::CompressionTrial;

/// Deflate (gzip) level, 1 to 9: levels above 1 hardly reduce shuffled samples further.
pub const DEFLATE_LEVEL: u8 = 1;
/// Most values that are tried, in the middle of the data: a run may begin at rest.
pub const TRIED_VALUES: usize = 1024;
/// Data are compressed if what is tried shrinks to this share: samples of a vibration keep three quarters, and compressing
/// them takes longer than all else that writes them.
const WORTHWHILE: f64 = 0.6;

thread_local! {
    static TRIAL: RefCell<CompressionTrial> = RefCell::new(CompressionTrial::new(DEFLATE_LEVEL));
}

/// Whether numbers like the given ones are worth compressing, shuffled as HDF5 does.
pub fn is_worthwhile(values: impl ExactSizeIterator<Item = f64>) -> bool {
    let skipped = values.len().saturating_sub(TRIED_VALUES) / 2;
    let bytes: Vec<[u8; 8]> = values.skip(skipped).take(TRIED_VALUES).map(f64::to_le_bytes).collect();
    let shuffled: Vec<u8> = (0..8).flat_map(|k| bytes.iter().map(move |bytes| bytes[k])).collect();
    let size = TRIAL.with_borrow_mut(|trial| trial.size(&shuffled));
    (size as f64) < WORTHWHILE * shuffled.len() as f64
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn time_axes_and_zeros_are_compressed_and_vibrations_are_not() {
        let count = 0..50_000_usize;
        assert!(is_worthwhile(count.clone().map(|k| 2.5e-4 * k as f64)));
        assert!(is_worthwhile(count.clone().map(|_| 0.0)));
        let vibration = |k: usize| 0.3 * (0.031 * k as f64).sin() + 0.02 * (1.7 * k as f64).cos();
        assert!(!is_worthwhile(count.map(vibration)));
        assert!(!is_worthwhile(std::iter::empty::<f64>()));
    }
}
