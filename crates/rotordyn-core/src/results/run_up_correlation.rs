//! Correlation of a measured and a computed run, channel by channel; arrays are \[measured, computed\].

use super::{OrderLine, OrderResult, SpectrogramResult};
use crate::document::Rows;
use serde::{Deserialize, Serialize};

/// One channel, measured and computed.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct ChannelPair {
    pub channel: String,
    pub unit: String,
    /// RMS of the vibration (mean and drift removed) over the whole run.
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
    pub agreement: CutAgreement,
}

/// Whether the maxima of an order's levels agree within their uncertainty.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct CutAgreement {
    pub finding: Agreement,
    /// Level that noise of the background does not exceed, at the maximum of each; `None` if there is nothing to read it from.
    pub noise_limit: [Option<f64>; 2],
    /// Half-width of the 95 % interval of ln(computed/measured), of the level and of the speed.
    pub level: f64,
    pub speed: f64,
}

/// What is said of an order line, measured and computed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Agreement {
    Agrees,
    LevelDiffers,
    SpeedDiffers,
    BothDiffer,
    /// Neither stands out of the background, or the computed one is too low to be seen in that of the measurement.
    BelowBackground,
}

impl Agreement {
    /// "agrees", "level differs", ….
    pub fn name(self) -> &'static str {
        match self {
            Agreement::Agrees => "agrees",
            Agreement::LevelDiffers => "level differs",
            Agreement::SpeedDiffers => "speed differs",
            Agreement::BothDiffer => "level and speed differ",
            Agreement::BelowBackground => "below background",
        }
    }
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

impl ChannelPair {
    /// What is written of the channels beside the runs and their spectra.
    pub fn columns<'a>(rows: &[Self]) -> Rows<'a, '_, Self> {
        Rows::of(rows)
            .text("channel", |p| &p.channel)
            .text("unit", |p| &p.unit)
            .number("measured_rms", "", |p| p.rms[0])
            .number("computed_rms", "", |p| p.rms[1])
            .nested(
                "orders",
                |p| &p.cuts,
                |cuts| {
                    cuts.number("order", "1/revolution", |c| c.line.order)
                        .text("label", |c| &c.line.label)
                        .number("measured_rpm", "rpm", |c| c.peaks[0].rpm)
                        .number("computed_rpm", "rpm", |c| c.peaks[1].rpm)
                        .number("measured_rms", "", |c| c.peaks[0].rms)
                        .number("computed_rms", "", |c| c.peaks[1].rms)
                        .flag("at_end", |c| c.peaks.iter().any(|peak| peak.at_end))
                        .number("correlation", "1", |c| c.correlation)
                        .number("level_uncertainty_db", "dB", |c| c.agreement.level_db())
                        .number("speed_uncertainty", "1", |c| c.agreement.speed)
                        .optional("measured_noise_limit", "", |c| c.agreement.noise_limit[0])
                        .optional("computed_noise_limit", "", |c| c.agreement.noise_limit[1])
                        .text("agreement", |c| c.agreement.finding.name())
                },
            )
    }
}

impl CutAgreement {
    /// Half-width of the level's 95 % interval \[dB\].
    pub fn level_db(&self) -> f64 {
        20.0 * self.level * std::f64::consts::LOG10_E
    }
}

/// Level of a computed value relative to a measured one \[dB\].
pub fn level_difference_db([measured, computed]: [f64; 2]) -> f64 {
    20.0 * (computed / measured).log10()
}
