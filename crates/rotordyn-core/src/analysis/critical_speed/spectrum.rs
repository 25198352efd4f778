//! The modes at one speed that take part in a search for crossings.

use rotordyn_linalg::Complex64;

/// Modes with |λ| up to this multiple of a damped frequency are those with damping ratios up to 0.94 below it; others do not take
/// part.
pub const HEAVY_REACH: f64 = 3.0;
/// Damping ratio of a heavily damped mode.
const HEAVY_DAMPING: f64 = 0.3;
/// Relative distance of two eigenvalues from which each has a shape of its own.
const LEAST_GAP: f64 = 1e-5;

/// Whether a mode is so little damped that all others up to its damped frequency are found.
pub fn takes_part(value: Complex64) -> bool {
    HEAVY_REACH * value.im > value.norm()
}

/// Whether a mode is so much damped that others may have lower damped frequencies with larger |λ|.
pub fn is_heavily_damped(value: Complex64) -> bool {
    -value.re > HEAVY_DAMPING * value.norm()
}

/// Eigenvalues at one speed, by damped frequency, and labels of their modes. Without their shapes, which would be most of the
/// memory of a search.
#[derive(Clone, Debug)]
pub struct Spectrum {
    pub speed: f64,
    pub values: Vec<Complex64>,
    pub labels: Vec<String>,
}

impl Spectrum {
    pub fn new(speed: f64, modes: impl IntoIterator<Item = (Complex64, String)>) -> Self {
        let mut modes: Vec<(Complex64, String)> =
            modes.into_iter().filter(|(value, _)| takes_part(*value)).collect();
        modes.sort_by(|a, b| a.0.im.total_cmp(&b.0.im));
        let (values, labels) = modes.into_iter().unzip();
        Self { speed, values, labels }
    }

    /// Number of modes below an order line.
    pub fn below(&self, order: f64) -> usize {
        self.values.partition_point(|value| value.im < order * self.speed)
    }

    /// The eigenvalue at an index, unless another one is so near that both have a shape in common.
    pub fn isolated(&self, index: usize) -> Option<Complex64> {
        let value = *self.values.get(index)?;
        let near = |other: &Complex64| (other - value).norm() < LEAST_GAP * value.norm();
        (self.values.iter().filter(|other| near(other)).count() == 1).then_some(value)
    }

    /// ω_d − n Ω of the mode at an index.
    pub fn gap(&self, index: usize, order: f64) -> Option<f64> {
        self.values.get(index).map(|value| value.im - order * self.speed)
    }
}
