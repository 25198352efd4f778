//! What FRFs and unbalance responses share: refined axes, undamped modes, units.

use crate::document::{Array, Rows};
use crate::model::Quantity;
use serde::{Deserialize, Serialize};

/// An undamped mode that is excited: the response there is infinite.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct UndampedPeak {
    /// Frequency \[Hz\] or speed \[rad/s\].
    pub at: f64,
    /// Label of the mode.
    pub label: String,
    /// Responses in which it appears; of an FRF "RESPONSE/EXCITATION".
    pub responses: Vec<String>,
}

impl UndampedPeak {
    /// Largest distance, as a fraction of the frequency or speed, at which a response counts as infinite.
    pub const WIDTH: f64 = 1e-6;

    /// Whether a response is infinite at a frequency or speed.
    pub fn covers(&self, at: f64) -> bool {
        (at - self.at).abs() <= Self::WIDTH * self.at
    }

    /// Frequencies or speeds where a response is infinite.
    pub fn of(found: &[Self], response: &str) -> impl Iterator<Item = f64> {
        found
            .iter()
            .filter(move |peak| peak.responses.iter().any(|name| name == response))
            .map(|peak| peak.at)
    }

    /// What is written to files: frequency or speed times `factor` under the name `at`.
    pub(super) fn columns<'a, 'r>(found: &'r [Self], at: &str, factor: f64) -> Rows<'a, 'r, Self> {
        Rows::of(found)
            .number(at, "", |peak| peak.at * factor)
            .text("label", |peak| &peak.label)
            .lists("responses", |peak| peak.responses.clone())
    }
}

/// 1 for every requested point of a refined axis, 0 for those added.
pub(super) fn requested_mask<'a>(requested: &[usize], points: usize) -> Array<'a> {
    let mut mask = vec![0.0; points];
    requested.iter().for_each(|&k| mask[k] = 1.0);
    Array::real(&[points], "1", mask)
}

/// Whether a direction (weights on u_x u_y u_z θ_x θ_y θ_z) is a rotation or a moment.
pub fn is_rotation(direction: &[f64; 6]) -> bool {
    direction[..3].iter().all(|d| *d == 0.0)
}

/// SI unit of a quantity of a translation or rotation.
pub fn unit_of(quantity: Quantity, rotation: bool) -> &'static str {
    match (quantity, rotation) {
        (Quantity::Displacement, false) => "m",
        (Quantity::Velocity, false) => "m/s",
        (Quantity::Acceleration, false) => "m/s^2",
        (Quantity::Displacement, true) => "rad",
        (Quantity::Velocity, true) => "rad/s",
        (Quantity::Acceleration, true) => "rad/s^2",
    }
}
