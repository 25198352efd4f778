//! Samples of a transient run.

use crate::series::Series;
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
    pub values: Series,
}

/// Samples of a transient run at a constant rate, in memory or in the file to which they were streamed.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct History {
    pub sample_rate: f64,
    pub time: Series,
    /// Shaft angle θ \[rad\] and speed Ω \[rad/s\].
    pub angle: Series,
    pub speed: Series,
    pub channels: Vec<HistoryChannel>,
}

impl History {
    /// The channel of a name.
    pub fn channel(&self, name: &str) -> Option<&HistoryChannel> {
        self.channels.iter().find(|channel| channel.name == name)
    }
}
