//! Speed over time: constant, or rising or falling.

use std::f64::consts::TAU;

use super::random::Random;
use super::{RATE, SAMPLES, SECONDS};

/// Time that a machine at its mean speed would need for the angle it has turned by.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Clock {
    /// Change of speed over the record, relative to the mean speed.
    pub change: f64,
}

impl Clock {
    pub const STEADY: Clock = Clock { change: 0.0 };

    /// A run-up or run-down by 10 to 30 %.
    pub fn draw(random: &mut Random) -> Self {
        Clock { change: random.sign() * random.range(0.1, 0.3) }
    }

    /// τ(t) = (1 − c/2) t + c t²/(2 T), the integral of the relative speed 1 − c/2 + c t/T.
    pub fn machine(&self, time: f64) -> f64 {
        time * (1.0 - 0.5 * self.change * (1.0 - time / SECONDS))
    }

    /// t(τ).
    pub fn real(&self, machine: f64) -> f64 {
        let start = 1.0 - 0.5 * self.change;
        // The root of the quadratic in the form without cancellation for small changes.
        2.0 * machine / (start + (start * start + 2.0 * self.change * machine / SECONDS).sqrt())
    }

    /// Shaft angle at every sample \[rad\]; `shaft`: mean speed \[rev/s\].
    pub fn angle(&self, shaft: f64) -> Vec<f64> {
        (0..SAMPLES).map(|n| TAU * shaft * self.machine(n as f64 / RATE)).collect()
    }
}

#[test]
fn clock_and_its_inverse() {
    for change in [-0.3, 0.0, 0.2] {
        let clock = Clock { change };
        for time in [0.0, 0.7, 3.1, SECONDS] {
            // Rounding.
            assert!((clock.real(clock.machine(time)) - time).abs() < 1e-12);
        }
        assert!((clock.machine(SECONDS) - SECONDS).abs() < 1e-12);
    }
}
