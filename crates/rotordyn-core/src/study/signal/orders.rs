//! Order tracking and time-synchronous average.

use super::{DEFAULT_MAX_ORDER, Job, MIN_SPEED, characteristic_rates};
use crate::results::{OrderLine, ShaftAverage, ShaftOrders};
use rotordyn_signal::SignalError;
use rotordyn_signal::bearing_lines::BearingPart;
use rotordyn_signal::order::{OrderCut, OrderSettings, OrderTracker};
use rotordyn_signal::order_tracks::order_tracks;
use rotordyn_signal::resample::{AngleResampler, SAMPLES_PER_ORDER};
use rotordyn_signal::statistics::statistics;
use rotordyn_signal::synchronous::synchronous_average;
use rotordyn_signal::tacho_jitter::{JitterLeak, amplitude_kept};

/// Share of the sampling rate that the highest order uses.
const RATE_SHARE: f64 = 0.9;
/// Loss of an order by the jitter of the shaft angle at which it is named.
const JITTER_LOSS: f64 = 0.1;
/// Share of an order's amplitude above which the leak of another one matters: 1 dB.
const LEAK_SHARE: f64 = 0.12;

impl Job<'_> {
    /// Highest order: as given, else by bearing, the orders asked for and the sampling rate.
    pub(super) fn max_order(&self) -> f64 {
        let of_bearing = self.bearing.map_or(0.0, |b| 2.2 * b.orders.bpfi);
        let asked = self.settings.orders.iter().map(|line| 1.1 * line.order).fold(0.0, f64::max);
        let wanted = DEFAULT_MAX_ORDER.max(of_bearing).max(asked);
        let fastest = self.shaft.map_or(0.0, |s| s.summary.max);
        self.settings
            .max_order
            .unwrap_or_else(|| wanted.min(RATE_SHARE * self.rate / (SAMPLES_PER_ORDER * fastest)))
    }

    pub(super) fn orders(&self) -> Result<ShaftOrders, SignalError> {
        let theta = self.angle("order tracking")?;
        let resolution = self.settings.order_resolution;
        let settings =
            OrderSettings { min_speed: MIN_SPEED, ..OrderSettings::new(resolution, self.max_order()) };
        let mut tracker = OrderTracker::new(theta, self.rate, settings)?;
        let records = tracker.resample(&[self.x])?;
        let mut map = tracker.spectrogram(&records[0]);
        // On the channel's time axis; the shaft angle may cover a part of it only.
        let start = self.channel.start + self.first as f64 / self.rate;
        let shift = |times: &mut [f64]| times.iter_mut().for_each(|t| *t += start);
        shift(&mut map.times);
        let average = map.average(0.0, f64::INFINITY)?;
        let highest = map.orders.last().copied().unwrap_or(0.0);
        let asked = &self.settings.orders;
        let largest = asked.iter().max_by(|a, b| a.order.total_cmp(&b.order));
        if let Some(above) = largest.filter(|line| line.order >= highest) {
            return Err(match (self.settings.max_order, self.shaft) {
                (None, Some(shaft)) => SignalError::RateTooLow {
                    given: self.rate,
                    needed: SAMPLES_PER_ORDER * above.order * shaft.summary.max / RATE_SHARE,
                    purpose: "the highest order asked for at the highest speed",
                },
                _ => SignalError::OutOfRange {
                    name: "highest order",
                    expected: "above every order asked for",
                    given: highest,
                },
            });
        }
        let lines: Vec<OrderLine> =
            self.order_lines().into_iter().filter(|line| line.order < highest).collect();
        let orders: Vec<f64> = lines.iter().map(|line| line.order).collect();
        let track = |width| order_tracks(self.x, theta, self.rate, &orders, width);
        let mut tracks = self.settings.bandwidth.map(track).transpose()?;
        tracks.iter_mut().for_each(|found| shift(&mut found.times));
        let cut = |line: OrderLine| {
            let cut = map.cut(line.order, resolution)?;
            Ok((line, cut))
        };
        let cuts = lines.into_iter().map(cut).collect::<Result<Vec<_>, SignalError>>()?;
        map.smeared = tracker.smeared(&records[0], cuts.iter().map(|(_, cut)| cut));
        let jitter = self.shaft.and_then(|shaft| shaft.jitter);
        let leaks = tracks.as_ref().zip(jitter).map(|(found, jitter)| jitter.leaks(found, LEAK_SHARE));
        let mut leaks = leaks.unwrap_or_default();
        leaks.extend((0..cuts.len()).filter_map(|k| self.lost_by_jitter(k, &cuts[k].1)));
        Ok(ShaftOrders { cuts, average, map, tracks, jitter_leaks: leaks })
    }

    /// What the jitter of the shaft angle takes from a cut, if more than a tenth.
    fn lost_by_jitter(&self, place: usize, cut: &OrderCut) -> Option<JitterLeak> {
        let kept = amplitude_kept(cut.order, self.shaft?.angle_deviation);
        let amplitude = (cut.rms.iter().map(|v| v * v).sum::<f64>() / cut.rms.len().max(1) as f64).sqrt();
        let leak = amplitude * (1.0 / kept.max(f64::MIN_POSITIVE) - 1.0);
        (1.0 - kept > JITTER_LOSS).then_some(JitterLeak { track: place, neighbour: place, amplitude, leak })
    }

    /// The orders asked for, by default 1x, 2x and the bearing's characteristic orders.
    fn order_lines(&self) -> Vec<OrderLine> {
        if !self.settings.orders.is_empty() {
            return self.settings.orders.clone();
        }
        let shaft = |n: f64| OrderLine { label: format!("{n}x"), order: n, bearing: false };
        let mut lines = vec![shaft(1.0), shaft(2.0)];
        if let Some(bearing) = self.bearing {
            lines.extend(BearingPart::ALL.map(|part| OrderLine {
                label: part.line_name().into(),
                order: part.defect_frequency(&characteristic_rates(bearing, 1.0)),
                bearing: true,
            }));
        }
        lines
    }

    pub(super) fn average(&self) -> Result<ShaftAverage, SignalError> {
        let theta = self.angle("an average over the shaft's turns")?;
        let per_turn = (SAMPLES_PER_ORDER * self.max_order()).ceil().clamp(360.0, 4096.0) as usize;
        let resampler = AngleResampler::new(theta, self.rate, per_turn, MIN_SPEED)?;
        let parts = resampler.parts();
        let longest = (0..parts.len()).max_by_key(|&k| parts[k].times.len()).unwrap_or(0);
        let mut records = resampler.resample(&[self.x])?;
        let record = records.swap_remove(longest).swap_remove(0);
        // Revolutions begin at angle 0.
        let skipped = (-parts[longest].first).rem_euclid(per_turn as i64) as usize;
        let record = &record[skipped.min(record.len())..];
        let average = synchronous_average(record, per_turn)?;
        let rest = average.residual(record)?;
        let spread = |x: &[f64]| statistics(x).map(|s| s.standard_deviation);
        let rms = [spread(record)?, spread(&average.mean)?, spread(&rest)?];
        Ok(ShaftAverage { average, rms })
    }
}
