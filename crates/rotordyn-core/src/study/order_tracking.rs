//! Spectrograms and order tracking of a recorded run.

use super::cage_turns::CageTurns;
use super::order_lines::LineOfRun;
use super::{Machine, StudyError};
use crate::model::study::{OrderStudy, SpectrogramStudy};
use crate::results::{History, HistoryChannel, OrderLine, OrderResult, SpectrogramPeak, SpectrogramResult};
use crate::series::{Keep, Series, SeriesError};
use rotordyn_signal::SignalError;
use rotordyn_signal::order::{OrderSettings, OrderTracker};
use rotordyn_signal::order_tracks::order_tracks;
use rotordyn_signal::stft::{Spectrogram, Stft, StftSettings};

/// Half width of an order cut's band in bins: a line of Hann that slips by half a bin keeps its level in three bins to 1 %,
/// and at a resolution of 0.05 they separate 7x from 2 BPFO = 7.14x.
pub(super) const CUT_HALF_WIDTH: f64 = 1.0;
/// Lines of bearings with the same name are apart from this part of a bin on, and on a map from this part of its highest order.
const APART_BINS: f64 = 0.5;
const SHOWN_APART: f64 = 2e-3;
/// Part of the highest order that a sampling rate allows, as lowered by default.
const ALLOWED_SHARE: f64 = 0.99;
/// Part of a window's turns that its Hann weights count most.
const WEIGHTED_SHARE: f64 = 0.5;
/// Most samples of channels that are resampled together (16 MB, and as many over the angle).
const GROUP_VALUES: usize = 1 << 21;

impl Machine {
    /// Spectrograms (STFT) of the requested channels up to a frequency, with the speed at every frame.
    ///
    /// The mean of each channel (static deflection) is removed.
    ///
    /// # Errors
    /// A record too short for the window, invalid settings, or samples that cannot be read.
    pub fn spectrograms(
        &self,
        study: &SpectrogramStudy,
        history: &History,
    ) -> Result<Vec<SpectrogramResult>, StudyError> {
        self.spectrograms_kept(study, history, &mut |amplitude| Ok(amplitude.into()))
    }

    /// As [`Self::spectrograms`], one channel after another, its amplitudes kept by `keep`.
    ///
    /// # Errors
    /// As [`Self::spectrograms`], and those of `keep`.
    pub fn spectrograms_kept(
        &self,
        study: &SpectrogramStudy,
        history: &History,
        keep: Keep,
    ) -> Result<Vec<SpectrogramResult>, StudyError> {
        let rate = history.sample_rate;
        let length = (study.length * rate).round() as usize;
        let settings = StftSettings::new(study.window, length, study.overlap)?;
        let mut stft = Stft::new(settings, rate)?;
        let cages = CageTurns::of(self, history, 0..history.angle.len())?.ratios();
        let lines = self.order_lines_of_cages(&study.orders, &cages, SHOWN_APART * highest(&study.orders));
        let orders: Vec<OrderLine> = lines.into_iter().map(|found| found.line).collect();
        let speed_of_run = history.speed.all()?;
        let mut found = Vec::new();
        for channel in selected_channels(&study.channels, history) {
            let spectrogram = stft.spectrogram_up_to(&without_mean(&channel.values)?, study.max_frequency)?;
            let speed = spectrogram.speed_at_frames(&speed_of_run, rate)?;
            let peak = peak(&spectrogram, &speed);
            found.push(SpectrogramResult {
                channel: channel.name.clone(),
                unit: channel.unit.clone(),
                spectrogram: spectrogram.try_map_amplitude(&mut *keep)?,
                peak,
                speed,
                orders: orders.clone(),
            });
        }
        Ok(found)
    }

    /// Order spectrograms and order cuts of the requested channels, their means removed.
    ///
    /// # Errors
    /// A run of too few revolutions for the resolution, a sampling rate too low for the highest order, samples that
    /// cannot be read.
    pub fn orders(&self, study: &OrderStudy, history: &History) -> Result<Vec<OrderResult>, StudyError> {
        self.orders_kept(study, history, &mut |amplitude| Ok(amplitude.into()))
    }

    /// As [`Self::orders`], one channel after another, its amplitudes kept by `keep`.
    ///
    /// # Errors
    /// As [`Self::orders`], and those of `keep`.
    pub fn orders_kept(
        &self,
        study: &OrderStudy,
        history: &History,
        keep: Keep,
    ) -> Result<Vec<OrderResult>, StudyError> {
        self.orders_of_lines(study, &self.cut_lines(study, history)?, history, keep)
    }

    /// Lines of the order cuts with the orders that they have in a run.
    pub(super) fn cut_lines(
        &self,
        study: &OrderStudy,
        history: &History,
    ) -> Result<Vec<LineOfRun>, StudyError> {
        let cages = CageTurns::of(self, history, 0..history.angle.len())?.ratios();
        Ok(self.order_lines_of_cages(&study.cuts, &cages, APART_BINS * study.resolution))
    }

    /// [`Self::orders_kept`] with these lines instead of the cuts of the study.
    pub(super) fn orders_of_lines(
        &self,
        study: &OrderStudy,
        lines: &[LineOfRun],
        history: &History,
        keep: Keep,
    ) -> Result<Vec<OrderResult>, StudyError> {
        let turns = CageTurns::of(self, history, 0..history.angle.len())?;
        let orders: Vec<f64> = lines.iter().map(|found| found.line.order).collect();
        let theta = history.angle.all()?;
        let tracker = |max_order: f64| {
            let settings = OrderSettings {
                overlap: study.overlap,
                window: study.window,
                ..OrderSettings::new(study.resolution, max_order)
            };
            OrderTracker::new(&theta, history.sample_rate, settings)
        };
        let (wanted, least) = (study.max_order.max(highest(&orders)), highest(&orders) + study.resolution);
        let mut tracker = match tracker(wanted) {
            // Of a torque drive the highest speed is not known before the run.
            Err(SignalError::RateTooLow { given, needed, .. })
                if study.max_order_is_default && wanted * given / needed > least =>
            {
                tracker(ALLOWED_SHARE * wanted * given / needed)?
            }
            found => found?,
        };
        let mut found = Vec::new();
        let channels: Vec<_> = selected_channels(&study.channels, history).collect();
        // The kernel of the resampling is evaluated once for all channels of a group.
        let size = (GROUP_VALUES / theta.len().max(1)).max(1);
        for group in channels.chunks(size) {
            let records = group.iter().map(|channel| without_mean(&channel.values));
            let records = records.collect::<Result<Vec<_>, _>>()?;
            let over_angle = tracker.resample(&records.iter().map(Vec::as_slice).collect::<Vec<_>>())?;
            for ((channel, record), over_angle) in group.iter().zip(&records).zip(&over_angle) {
                let mut spectrogram = tracker.spectrogram(over_angle);
                let half_width = CUT_HALF_WIDTH * study.resolution;
                let cut = |found: &LineOfRun| {
                    let line = &found.line;
                    let Some(of) = &found.of else {
                        return Ok((line.clone(), spectrogram.cut(line.order, half_width)?));
                    };
                    // The cage's turns change with speed and load.
                    let bearing = &self.model.bearings[of.site].bearing;
                    let order_at = |time: &f64| {
                        let sample = (time * history.sample_rate).round() as usize;
                        let cage = turns.ratio_about(of.site, sample, WEIGHTED_SHARE / study.resolution);
                        cage.map_or(line.order, |cage| of.at(cage, bearing)).min(highest(&spectrogram.orders))
                    };
                    let orders: Vec<f64> = spectrogram.times.iter().map(order_at).collect();
                    Ok((line.clone(), spectrogram.cut_along(line.order, &orders, half_width)?))
                };
                let cuts = lines.iter().map(cut).collect::<Result<Vec<_>, SignalError>>()?;
                spectrogram.smeared = tracker.smeared(over_angle, cuts.iter().map(|(_, cut)| cut));
                let tracks = study
                    .bandwidth
                    .map(|width| order_tracks(record, &theta, history.sample_rate, &orders, width));
                found.push(OrderResult {
                    channel: channel.name.clone(),
                    unit: channel.unit.clone(),
                    spectrogram: spectrogram.try_map_amplitude(&mut *keep)?,
                    cuts,
                    tracks: tracks.transpose()?,
                });
            }
        }
        Ok(found)
    }
}

/// The highest order, or 0.
fn highest(orders: &[f64]) -> f64 {
    orders.iter().copied().fold(0.0, f64::max)
}

/// The highest amplitude of a spectrogram.
fn peak(found: &Spectrogram, speed: &[f64]) -> Option<SpectrogramPeak> {
    let bins = found.frequencies.len();
    let (k, amplitude) = found.amplitude.iter().enumerate().max_by(|a, b| a.1.total_cmp(b.1))?;
    Some(SpectrogramPeak {
        speed: speed[k / bins],
        frequency: found.frequencies[k % bins],
        amplitude: *amplitude,
    })
}

/// Values less their mean.
pub(super) fn without_mean(values: &Series) -> Result<Vec<f64>, SeriesError> {
    let mut values = values.all()?.into_owned();
    let mean = values.iter().sum::<f64>() / values.len().max(1) as f64;
    values.iter_mut().for_each(|v| *v -= mean);
    Ok(values)
}

/// The named channels; without names all displacements, velocities and accelerations.
fn selected_channels<'a>(
    names: &'a [String],
    history: &'a History,
) -> impl Iterator<Item = &'a HistoryChannel> {
    history.channels.iter().filter(move |channel| is_selected(channel, names))
}

/// Whether a channel is named; without names every displacement, velocity and acceleration is.
pub(super) fn is_selected(channel: &HistoryChannel, names: &[String]) -> bool {
    match names {
        [] => ["displacement", "velocity", "acceleration"].contains(&channel.quantity.as_str()),
        names => names.contains(&channel.name),
    }
}
