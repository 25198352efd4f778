//! Window functions of a finite Fourier transform.

use std::f64::consts::TAU;

/// Window function.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum WindowKind {
    Rectangular,
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
