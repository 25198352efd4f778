//! Correlation of a measured and a computed run, channel by channel; arrays are \[measured, computed\].

use super::{OrderLine, OrderResult, SpectrogramResult};
use serde::{Deserialize, Serialize};

/// One channel, measured and computed.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct ChannelPair {
    pub channel: String,
    pub unit: String,
    /// RMS of the vibration (mean removed) over the whole run.
    pub rms: [f64; 2],
    pub spectrograms: [SpectrogramResult; 2],
    pub orders: [OrderResult; 2],
    pub cuts: Vec<CutPair>,
}

/// One order, measured and computed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct CutPair {
    pub line: OrderLine,
    /// Maximum of each.
    pub peaks: [CutPeak; 2],
    /// Correlation (Σ m c)² / (Σ m² Σ c²) of the levels over time: 1 if one is a multiple of the other.
    pub correlation: f64,
}

/// Maximum of an order cut.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct CutPeak {
    /// \[rpm\].
    pub rpm: f64,
    /// RMS in the band of the order.
    pub rms: f64,
    /// At the lowest or highest speed of the run: the true maximum may lie outside.
    pub at_end: bool,
}

/// Level of a computed value relative to a measured one \[dB\].
pub fn level_difference_db([measured, computed]: [f64; 2]) -> f64 {
    20.0 * (computed / measured).log10()
}
