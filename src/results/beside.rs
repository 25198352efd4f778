//! A measured run and the model's own, channel by channel; of every pair the measured one stands first.

use super::{OrderLine, OrderResult, SpectrogramResult};

/// One channel, measured and computed.
#[derive(Clone, Debug)]
pub struct ChannelPair {
    pub channel: String,
    pub unit: String,
    /// RMS of what vibrates, over the whole run.
    pub rms: [f64; 2],
    pub spectrograms: [SpectrogramResult; 2],
    pub orders: [OrderResult; 2],
    pub cuts: Vec<CutPair>,
}

/// One order, measured and computed.
#[derive(Clone, Debug, PartialEq)]
pub struct CutPair {
    pub line: OrderLine,
    /// Where it is highest.
    pub peaks: [CutPeak; 2],
    /// (Σ m c)² / (Σ m² Σ c²) of the levels over time: 1 where one is a multiple of the other.
    pub likeness: f64,
}

/// Where an order is highest.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct CutPeak {
    /// \[rpm\].
    pub rpm: f64,
    /// RMS in the band of the order.
    pub rms: f64,
    /// At the lowest or highest speed of the run: where it is highest beyond is not known.
    pub at_end: bool,
}

/// Level of a computed value over a measured one \[dB\].
pub fn level_over([measured, computed]: [f64; 2]) -> f64 {
    20.0 * (computed / measured).log10()
}
