//! Spectrograms and order tracking of a recorded run.

use super::Machine;
use crate::model::study::{OrderStudy, SpectrogramStudy};
use crate::results::{History, HistoryChannel, OrderResult, SpectrogramResult};
use rotordyn_signal::SignalError;
use rotordyn_signal::order::{OrderSettings, OrderTracker};
use rotordyn_signal::stft::{Stft, StftSettings};

/// Half width of an order cut's band in bins: three bins contain the level of a Hann-windowed line to 0.2 dB,
/// and at a resolution of 0.05 they separate 7x from 2 BPFO = 7.14x.
const CUT_HALF_WIDTH: f64 = 1.0;

impl Machine {
    /// Spectrograms (STFT) of the requested channels up to a frequency, with the speed at every frame.
    ///
    /// The mean of each channel (static deflection) is removed.
    ///
    /// # Errors
    /// A record too short for the window, or invalid settings.
    pub fn spectrograms(
        &self,
        study: &SpectrogramStudy,
        history: &History,
    ) -> Result<Vec<SpectrogramResult>, SignalError> {
        let rate = history.sample_rate;
        let length = (study.length * rate).round() as usize;
        let settings = StftSettings::new(study.window, length, study.overlap)?;
        let mut stft = Stft::new(settings, rate)?;
        let orders = self.order_lines(&study.orders);
        selected_channels(&study.channels, history)
            .map(|channel| {
                let mut spectrogram = stft.spectrogram(&without_mean(&channel.values))?;
                let speed = spectrogram.speed_at_frames(&history.speed, rate)?;
                crop(&mut spectrogram.amplitude, &mut spectrogram.frequencies, study.max_frequency);
                Ok(SpectrogramResult {
                    channel: channel.name.clone(),
                    unit: channel.unit.clone(),
                    spectrogram,
                    speed,
                    orders: orders.clone(),
                })
            })
            .collect()
    }

    /// Order spectrograms and order cuts of the requested channels, their means removed.
    ///
    /// # Errors
    /// A run of too few revolutions for the resolution, a sampling rate too low for the highest order.
    pub fn orders(&self, study: &OrderStudy, history: &History) -> Result<Vec<OrderResult>, SignalError> {
        let settings = OrderSettings {
            overlap: study.overlap,
            window: study.window,
            ..OrderSettings::new(study.resolution, study.max_order)
        };
        let mut tracker = OrderTracker::new(&history.angle, history.sample_rate, settings)?;
        let lines = self.order_lines(&study.cuts);
        selected_channels(&study.channels, history)
            .map(|channel| {
                let records = tracker.resample(&[&without_mean(&channel.values)])?;
                let spectrogram = tracker.spectrogram(&records[0]);
                let cut = |line: &crate::results::OrderLine| {
                    let cut = spectrogram.cut(line.order, CUT_HALF_WIDTH * study.resolution)?;
                    Ok((line.clone(), cut))
                };
                let cuts = lines.iter().map(cut).collect::<Result<_, SignalError>>()?;
                Ok(OrderResult {
                    channel: channel.name.clone(),
                    unit: channel.unit.clone(),
                    spectrogram,
                    cuts,
                })
            })
            .collect()
    }
}

/// Values less their mean.
pub(super) fn without_mean(values: &[f64]) -> Vec<f64> {
    let mean = values.iter().sum::<f64>() / values.len().max(1) as f64;
    values.iter().map(|v| v - mean).collect()
}

/// The named channels; without names all displacements, velocities and accelerations.
fn selected_channels<'a>(
    names: &'a [String],
    history: &'a History,
) -> impl Iterator<Item = &'a HistoryChannel> {
    history.channels.iter().filter(move |c| {
        if names.is_empty() {
            ["displacement", "velocity", "acceleration"].contains(&c.quantity.as_str())
        } else {
            names.contains(&c.name)
        }
    })
}

/// Removes the columns above a frequency.
fn crop(amplitude: &mut Vec<f64>, frequencies: &mut Vec<f64>, limit: f64) {
    let bins = frequencies.len();
    let kept = frequencies.partition_point(|f| *f <= limit).max(1);
    *amplitude = amplitude.chunks_exact(bins).flat_map(|row| row[..kept].iter().copied()).collect();
    frequencies.truncate(kept);
}
