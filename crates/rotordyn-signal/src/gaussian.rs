//! Seeded Gaussian random numbers.

use crate::Complex;
use std::f64::consts::TAU;

/// Complex Gaussian random numbers of mean square 1 (splitmix64, Box-Muller).
pub(crate) struct GaussianStream(u64);

impl GaussianStream {
    /// An independent stream for every triple of numbers.
    pub fn new(seed: u64, first: u64, second: u64) -> Self {
        // Each number of the key is mixed into the state in turn.
        let mut stream = GaussianStream(seed);
        for key in [first, second] {
            stream.0 = stream.bits() ^ key.wrapping_mul(0xd134_2543_de82_ef95);
        }
        stream
    }

    fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// In (0, 1].
    fn uniform(&mut self) -> f64 {
        ((self.bits() >> 11) + 1) as f64 / (1u64 << 53) as f64
    }

    pub fn next(&mut self) -> Complex<f64> {
        let size = (-self.uniform().ln()).sqrt();
        Complex::from_polar(size, TAU * self.uniform())
    }
}
