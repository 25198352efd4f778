//! Samples of a transient run.

use crate::document::Rows;
use serde::{Deserialize, Serialize};

/// A channel of a transient run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct HistoryChannel {
    pub name: String,
    /// Unit, such as "m/s^2".
    pub unit: String,
    /// Name of the quantity: displacement, velocity, acceleration, force, angle, energy.
    pub quantity: String,
    /// Station or body, and direction.
    pub station: String,
    pub direction: String,
    pub values: Vec<f64>,
}

/// Samples of a transient run at a constant rate.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct History {
    pub sample_rate: f64,
    pub time: Vec<f64>,
    /// Shaft angle θ \[rad\] and speed Ω \[rad/s\].
    pub angle: Vec<f64>,
    pub speed: Vec<f64>,
    pub channels: Vec<HistoryChannel>,
}

impl HistoryChannel {
    /// What is written beside the streamed samples.
    pub(super) fn columns<'a>(rows: &[Self]) -> Rows<'a, '_, Self> {
        let rms = |c: &Self| {
            let square = c.values.iter().map(|v| v * v).sum::<f64>() / c.values.len() as f64;
            square.sqrt()
        };
        Rows::of(rows)
            .text("name", |c| &c.name)
            .text("unit", |c| &c.unit)
            .text("quantity", |c| &c.quantity)
            .text("station", |c| &c.station)
            .text("direction", |c| &c.direction)
            .number("minimum", "", |c| c.values.iter().copied().fold(f64::INFINITY, f64::min))
            .number("maximum", "", |c| c.values.iter().copied().fold(f64::NEG_INFINITY, f64::max))
            .number("rms", "", rms)
    }
}
