//! Waviness of a race, summed fast for every ball.

use super::Wave;

/// Waviness of a race as cosine and sine coefficients by order, summed by a rotation recurrence.
#[derive(Clone, Debug, Default)]
pub(super) struct Waviness {
    /// (Re, Im) of a e^{iϕ₀} for orders 0, 1, 2, ...
    coefficients: Vec<[f64; 2]>,
}

impl Waviness {
    pub fn new(waves: &[Wave]) -> Self {
        let highest = waves.iter().map(|w| w.order as usize + 1).max().unwrap_or(0);
        let mut coefficients = vec![[0.0; 2]; highest];
        for wave in waves {
            coefficients[wave.order as usize][0] += wave.amplitude * wave.phase.cos();
            coefficients[wave.order as usize][1] += wave.amplitude * wave.phase.sin();
        }
        Self { coefficients }
    }

    pub fn is_empty(&self) -> bool {
        self.coefficients.is_empty()
    }

    /// Deviation Σ a cos(n φ + ϕ₀) and its slope with φ, from cos φ and sin φ.
    pub fn at(&self, cos: f64, sin: f64) -> [f64; 2] {
        let (mut c, mut s) = (1.0, 0.0);
        let (mut value, mut slope) = (0.0, 0.0);
        for (n, [re, im]) in self.coefficients.iter().enumerate() {
            value += re * c - im * s;
            slope -= n as f64 * (re * s + im * c);
            (c, s) = (c * cos - s * sin, s * cos + c * sin);
        }
        [value, slope]
    }
}
