//! What a run's samples amount to: ends, extremes and levels, from one pass over every channel.

use super::history::{History, HistoryChannel};
use crate::document::{Rows, Table};
use crate::series::{Series, SeriesError};
use serde::{Deserialize, Serialize};

/// Extremes and levels of the samples of a run.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct RunSummary {
    pub samples: usize,
    /// Time \[s\] and speed \[rad/s\] of the last sample.
    pub end_time: f64,
    pub end_speed: f64,
    /// Lowest and highest speed \[rad/s\]; `None` without samples.
    pub speed_range: Option<[f64; 2]>,
    /// Of every channel, in their order.
    pub channels: Vec<ChannelSummary>,
}

/// Extremes and levels of a channel.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct ChannelSummary {
    pub minimum: f64,
    pub maximum: f64,
    pub mean: f64,
    pub rms: f64,
    /// RMS and largest magnitude of the difference from the mean.
    pub rms_about_mean: f64,
    pub peak_about_mean: f64,
}

impl RunSummary {
    /// Reads every channel once, one at a time.
    ///
    /// # Errors
    /// Stored samples that cannot be read.
    pub fn of(history: &History) -> Result<Self, SeriesError> {
        let widen = |range: Option<[f64; 2]>, speed: f64| {
            Some(range.map_or([speed; 2], |[low, high]: [f64; 2]| [low.min(speed), high.max(speed)]))
        };
        Ok(Self {
            samples: history.time.len(),
            end_time: history.time.ends()?.map_or(0.0, |[_, end]| end),
            end_speed: history.speed.ends()?.map_or(0.0, |[_, end]| end),
            speed_range: history.speed.fold(None, widen)?,
            channels: history
                .channels
                .iter()
                .map(|c| ChannelSummary::of(&c.values))
                .collect::<Result<_, _>>()?,
        })
    }

    /// Highest magnitude of the speed \[rad/s\].
    pub fn top_speed(&self) -> f64 {
        self.fastest().abs()
    }

    /// The speed of highest magnitude \[rad/s\], negative of a shaft that turns backward.
    pub fn fastest(&self) -> f64 {
        self.speed_range.map_or(0.0, |[low, high]| if low.abs() > high.abs() { low } else { high })
    }

    /// What is written beside the streamed samples.
    pub(super) fn columns<'a>(&self, channels: &[HistoryChannel]) -> Table<'a> {
        let rows: Vec<(&HistoryChannel, &ChannelSummary)> = channels.iter().zip(&self.channels).collect();
        Rows::of(&rows)
            .text("name", |(c, _)| &c.name)
            .text("unit", |(c, _)| &c.unit)
            .text("quantity", |(c, _)| &c.quantity)
            .text("station", |(c, _)| &c.station)
            .text("direction", |(c, _)| &c.direction)
            .number("minimum", "", |(_, s)| s.minimum)
            .number("maximum", "", |(_, s)| s.maximum)
            .number("rms", "", |(_, s)| s.rms)
            .table()
    }
}

impl ChannelSummary {
    /// Of all values.
    ///
    /// # Errors
    /// Stored values that cannot be read.
    pub fn of(values: &Series) -> Result<Self, SeriesError> {
        let values = values.all()?;
        let count = values.len() as f64;
        // An empty channel has a mean of zero, no level.
        let mean = values.iter().sum::<f64>() / count.max(1.0);
        let from_mean = || values.iter().map(|v| v - mean);
        Ok(Self {
            minimum: values.iter().copied().fold(f64::INFINITY, f64::min),
            maximum: values.iter().copied().fold(f64::NEG_INFINITY, f64::max),
            mean,
            rms: (values.iter().map(|v| v * v).sum::<f64>() / count).sqrt(),
            rms_about_mean: (from_mean().map(|v| v.powi(2)).sum::<f64>() / count.max(1.0)).sqrt(),
            peak_about_mean: from_mean().fold(0.0, |peak: f64, v| peak.max(v.abs())),
        })
    }
}
