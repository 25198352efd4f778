//! Window functions of a finite Fourier transform.

use serde::{Deserialize, Serialize};
use std::f64::consts::{PI, TAU};

/// Window function.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum WindowKind {
    Rectangular,
    #[default]
    Hann,
    Hamming,
    Blackman,
    FlatTop,
}

impl WindowKind {
    /// Coefficients a_k of w_n = Σ_k (−1)ᵏ a_k cos(2πkn/N).
    fn coefficients(self) -> &'static [f64] {
        match self {
            WindowKind::Rectangular => &[1.0],
            WindowKind::Hann => &[0.5, 0.5],
            WindowKind::Hamming => &[0.54, 0.46],
            WindowKind::Blackman => &[0.42, 0.50, 0.08],
            WindowKind::FlatTop => &[0.21557895, 0.41663158, 0.277263158, 0.083578947, 0.006947368],
        }
    }

    /// Samples w_n of the periodic window of N points, n = 0..N, symmetric about n = N/2 and about 1 there.
    ///
    /// w_n = Σ_k (−1)ᵏ a_k cos(2πkn/N); one point is 1. Source: Harris, Proc. IEEE 66 (1978); the flat top is
    /// D'Antona and Ferrero's.
    pub fn samples(self, length: usize) -> Vec<f64> {
        if length == 1 {
            return vec![1.0];
        }
        let value = |n: usize| {
            let mut sum = 0.0;
            for (k, a) in self.coefficients().iter().enumerate() {
                let sign = if k % 2 == 0 { 1.0 } else { -1.0 };
                // The product is reduced modulo N in integers, so that the cosine is exact for any length.
                sum += sign * a * (TAU * ((k * n) % length) as f64 / length as f64).cos();
            }
            sum
        };
        (0..length).map(value).collect()
    }

    /// Line shape: the level of a tone at a distance of `offset` bins of 1/T, over that at the bin.
    ///
    /// W(δ)/W(0) = sinc δ Σ_k (−1)ᵏ a_k/a₀ δ²/(δ² − k²), sinc δ = sin πδ/πδ, the limit of many samples (error of order 1/N²); at
    /// δ = ±k it is a_k/2a₀.
    pub fn line_shape(self, offset: f64) -> f64 {
        let coefficients = self.coefficients();
        let nearest = offset.round();
        // A zero of the sine meets a pole, or is a zero.
        if (offset - nearest).abs() < 1e-7 {
            return match nearest.abs() as usize {
                0 => 1.0,
                k => coefficients.get(k).map_or(0.0, |a| 0.5 * a / coefficients[0]),
            };
        }
        let square = offset * offset;
        let term = |(k, a): (usize, &f64)| {
            let sign = if k % 2 == 0 { 1.0 } else { -1.0 };
            sign * a * square / (square - (k * k) as f64)
        };
        let sum: f64 = coefficients.iter().enumerate().map(term).sum();
        (PI * offset).sin() / (PI * offset) * sum / coefficients[0]
    }

    /// Half the width of the main lobe, in bins of 1/T: the smallest resolvable spacing of two tones.
    pub fn main_lobe_half_width(self) -> f64 {
        self.coefficients().len() as f64
    }
}

/// Coherent gain of a window, Σw/N: its factor on the amplitude of a tone.
pub fn coherent_gain(window: &[f64]) -> f64 {
    window.iter().sum::<f64>() / window.len() as f64
}

/// Equivalent noise bandwidth in bins of 1/T, N Σw² / (Σw)²: 1 for rectangular, 1.5 for Hann.
pub fn noise_bandwidth(window: &[f64]) -> f64 {
    let sum: f64 = window.iter().sum();
    let power: f64 = window.iter().map(|w| w * w).sum();
    window.len() as f64 * power / (sum * sum)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The line shape against the sum over the samples of a long window.
    #[test]
    fn line_shape_is_the_transform_of_the_samples() {
        use WindowKind::*;
        for kind in [Rectangular, Hann, Hamming, Blackman, FlatTop] {
            let samples = kind.samples(4096);
            let total: f64 = samples.iter().sum();
            for step in -36..=36 {
                let offset = f64::from(step) / 8.0;
                // Symmetric about N/2: the transform is real there.
                let at = |(n, w): (usize, &f64)| w * (TAU * offset * (n as f64 / 4096.0 - 0.5)).cos();
                let sum: f64 = samples.iter().enumerate().map(at).sum();
                let shape = kind.line_shape(offset);
                // One end of an odd number of points stands for both: an error of w_0/N.
                assert!((shape - sum / total).abs() < 2.5e-4, "{kind:?} {offset}: {shape} {}", sum / total);
            }
            let energy: f64 = (-4..=4).map(|k| kind.line_shape(f64::from(k)).powi(2)).sum();
            assert!((energy - noise_bandwidth(&samples)).abs() < 1e-9, "{kind:?}");
        }
    }
}
