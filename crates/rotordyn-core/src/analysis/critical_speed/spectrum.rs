//! The modes at one speed that take part in a search for crossings.

use super::UnstableMode;
use crate::analysis::stability::is_unstable;
use rotordyn_linalg::Complex64;

/// Modes with |λ| up to this multiple of a damped frequency are those with damping ratios up to 0.94 below it; others do not take
/// part.
pub const HEAVY_REACH: f64 = 3.0;
/// Damping ratio of a heavily damped mode.
const HEAVY_DAMPING: f64 = 0.3;
/// Range of Im λ/|λ| about 1/[`HEAVY_REACH`]: ζ from 0.85 to 0.99.
const LIMIT_RANGE: [f64; 2] = [0.14, 0.53];
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
    /// The least stable mode, if it is unstable, whether it takes part or not.
    pub unstable: Option<UnstableMode>,
    /// Whether the damping of a mode is near the limit from which on it does not take part: it may do so at the next speed.
    has_mode_at_limit: bool,
}

impl Spectrum {
    pub fn new(speed: f64, modes: impl IntoIterator<Item = (Complex64, String)>) -> Self {
        let mut modes: Vec<(Complex64, String)> = modes.into_iter().collect();
        let is_at_limit = |value: &Complex64| {
            let ratio = value.im / value.norm();
            LIMIT_RANGE[0] < ratio && ratio < LIMIT_RANGE[1]
        };
        let has_mode_at_limit = modes.iter().any(|(value, _)| is_at_limit(value));
        let zeta = |value: &Complex64| -value.re / value.norm();
        let growing = modes.iter().filter(|(value, _)| is_unstable(*value));
        let least = growing.min_by(|a, b| zeta(&a.0).total_cmp(&zeta(&b.0)));
        let unstable = least.map(|(value, label)| UnstableMode {
            speed,
            label: label.clone(),
            damping_ratio: zeta(value),
        });
        modes.retain(|(value, _)| takes_part(*value));
        modes.sort_by(|a, b| a.0.im.total_cmp(&b.0.im));
        let (values, labels) = modes.into_iter().unzip();
        Self { speed, values, labels, unstable, has_mode_at_limit }
    }

    /// Whether a mode lies below an order line here and above it at another speed, or the other way round, while modes may come to
    /// take part or cease to: the number of those below the line may then be the same at both.
    pub fn hides_crossing(&self, other: &Self, order: f64) -> bool {
        let crosses = |value: &Complex64| {
            let distance = |b: &Complex64| (b - value).norm();
            let same = other.values.iter().min_by(|a, b| distance(a).total_cmp(&distance(b)));
            same.is_some_and(|same| {
                let is_below = [(value, self.speed), (same, other.speed)].map(|(v, w)| v.im < order * w);
                is_below[0] != is_below[1]
            })
        };
        (self.has_mode_at_limit || other.has_mode_at_limit) && self.values.iter().any(crosses)
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
