//! Test-analysis correlation of a run-up: the model driven by the measured shaft angle, read at the sensors.

use super::order_agreement::{CutLevels, KnownErrors, agreement};
use super::record::probe_channel;
use super::signal::{ShaftMotion, SignalChannel};
use super::{Machine, StudyError};
use crate::model::study::{OrderStudy, SpectrogramStudy};
use crate::model::{Model, Probe, SpeedProfile};
use crate::results::{
    ChannelPair, CutPair, CutPeak, History, HistoryChannel, OrderResult, RunUpResult, SpectrogramResult,
};
use crate::series::SeriesError;
use rotordyn_linalg::{Outside, piecewise};
use rotordyn_signal::SignalError;
use rotordyn_signal::order::OrderCut;
use rotordyn_signal::resample::SAMPLES_PER_ORDER;

/// Spline points per second of the measured shaft angle that drives the model.
const POINTS_PER_SECOND: f64 = 100.0;
/// Fraction of the speed range within which a maximum counts as at its end.
const END_FRACTION: f64 = 5e-3;
/// Revolutions at mean speed, and least time \[s\], of the moving mean that counts as drift.
const DRIFT_REVOLUTIONS: f64 = 3.0;
const DRIFT_SECONDS: f64 = 1.0;
/// Default orders of the cuts, if the model gives none.
const DEFAULT_CUTS: [f64; 3] = [1.0, 2.0, 3.0];

/// A measured run mapped to the model.
#[derive(Clone, Debug)]
pub struct MeasuredRun {
    /// Channels over the time in which the shaft angle is known, starting at time 0.
    pub history: History,
    /// Location and quantity of each channel.
    pub probes: Vec<Probe>,
    /// Measured shaft rotation.
    pub profile: SpeedProfile,
    /// Standard deviation of the shaft angle \[rad\].
    pub angle_deviation: f64,
}

impl MeasuredRun {
    /// From channels of equal length and rate with their probes, and the shaft angle at the samples.
    ///
    /// # Errors
    /// An unknown shaft angle.
    pub fn new(
        channels: Vec<(Probe, SignalChannel)>,
        motion: &ShaftMotion,
        model: &Model,
    ) -> Result<Self, SignalError> {
        let purpose = "a comparison with the model's run-up";
        let Some((_, first)) = channels.first().filter(|_| motion.angle.len() > 1) else {
            return Err(SignalError::Unknown { what: "the shaft's angle", purpose });
        };
        let rate = first.sample_rate;
        let profile = speed_profile(&motion.angle, rate);
        let curve = profile.curve();
        let count = motion.angle.len();
        let time: Vec<f64> = (0..count).map(|k| k as f64 / rate).collect();
        let mut history = History {
            sample_rate: rate,
            angle: motion.angle.iter().map(|a| (a - motion.angle[0]).abs()).collect(),
            speed: time.iter().map(|t| curve.at(*t).speed).collect(),
            time: time.into(),
            channels: Vec::new(),
        };
        let mut probes = Vec::new();
        for (probe, channel) in channels {
            let mut described = probe_channel(model, &probe);
            described.values = channel.samples.iter().skip(motion.first).take(count).copied().collect();
            history.channels.push(described);
            probes.push(probe);
        }
        Ok(Self { history, probes, profile, angle_deviation: motion.angle_deviation })
    }

    /// The model with the measured shaft rotation as speed profile and the measured channels as probes.
    ///
    /// Sampled at the rate of the measurement, limited by the model's time step.
    pub fn driven_model(&self, model: &Model) -> Model {
        let mut model = model.clone();
        model.profile = self.profile.clone();
        model.probes = self.probes.clone();
        if let Some(study) = &mut model.studies.run_up {
            study.sample_rate = self.history.sample_rate.min(1.0 / study.step);
        }
        model
    }
}

/// Speed profile through angles evenly spaced in time, including the last.
fn speed_profile(angle: &[f64], rate: f64) -> SpeedProfile {
    let last = angle.len() - 1;
    let stride = ((rate / POINTS_PER_SECOND).round() as usize).clamp(1, last.div_ceil(4).max(1));
    // Points closer than half a stride would make the spline oscillate.
    let mut places: Vec<usize> = (0..last).step_by(stride).filter(|k| 2 * (last - k) >= stride).collect();
    places.push(last);
    // The direction of rotation is dropped: the model rotates forward.
    let points = places.iter().map(|&k| [k as f64 / rate, (angle[k] - angle[0]).abs()]).collect();
    SpeedProfile::Pulses { points, duration: last as f64 / rate }
}

/// RMS of a channel less its moving mean over three revolutions at mean speed, at least a second: the drift of a sensor,
/// or the place of the shaft in its clearance, is no vibration.
pub(super) fn vibration_rms(run: &History, channel: &HistoryChannel) -> Result<f64, SeriesError> {
    let values = channel.values.all()?;
    let seconds = values.len() as f64 / run.sample_rate;
    let turns = run.angle.ends()?.map_or(0.0, |[from, to]| (to - from).abs()) / std::f64::consts::TAU;
    let over = (DRIFT_REVOLUTIONS * seconds / turns.max(f64::MIN_POSITIVE)).max(DRIFT_SECONDS);
    let half = ((0.5 * over * run.sample_rate) as usize).min(values.len());
    let mut sums = vec![0.0; values.len() + 1];
    for (k, v) in values.iter().enumerate() {
        sums[k + 1] = sums[k] + v;
    }
    let deviation = |k: usize| {
        // Symmetric also at the ends: a straight drift has no deviation.
        let reach = half.min(k).min(values.len() - 1 - k);
        values[k] - (sums[k + reach + 1] - sums[k - reach]) / (2 * reach + 1) as f64
    };
    let power: f64 = (0..values.len()).map(|k| deviation(k).powi(2)).sum();
    Ok((power / values.len().max(1) as f64).sqrt())
}

impl Machine {
    /// Spectrograms, order spectra and order cuts of measured and computed channels of the same name, by the
    /// settings of the model's studies within the range of both sampling rates, and which orders agree.
    ///
    /// # Errors
    /// A run too short for the window or for the order resolution, invalid settings, samples that cannot be read.
    pub fn correlate_run_up(
        &self,
        run: &MeasuredRun,
        computed: &RunUpResult,
    ) -> Result<Vec<ChannelPair>, StudyError> {
        let (measured, step_error) = (&run.history, computed.step_error.as_ref());
        let computed = &computed.history;
        let runs = [measured, computed];
        let rate = measured.sample_rate.min(computed.sample_rate);
        let Some((spectra, orders)) = self.spectra_within(measured, rate)? else { return Ok(Vec::new()) };
        let mut maps = Vec::new();
        let mut tracked = Vec::new();
        for run in runs {
            maps.push(self.spectrograms(&spectra, run)?);
            // The measured run has no record of the cages: they are taken to turn as the computed ones.
            let lines = self.cut_lines(&orders, computed)?;
            tracked.push(self.orders_of_lines(&orders, &lines, run, &mut |amplitude| Ok(amplitude.into()))?);
        }
        let mut pairs = Vec::new();
        for channel in &runs[0].channels {
            let of = |run: usize| {
                let place = maps[run].iter().position(|m| m.channel == channel.name)?;
                let own = runs[run].channel(&channel.name)?;
                Some((own, maps[run][place].clone(), tracked[run][place].clone()))
            };
            let (Some((own_m, map_m, orders_m)), Some((own_c, map_c, orders_c))) = (of(0), of(1)) else {
                continue;
            };
            let errors = KnownErrors { angle: run.angle_deviation, step: step_error };
            let rms = |run: &History, of: &HistoryChannel| vibration_rms(run, of);
            pairs.push(ChannelPair {
                channel: channel.name.clone(),
                unit: channel.unit.clone(),
                rms: [rms(measured, own_m)?, rms(computed, own_c)?],
                cuts: cut_pairs([&orders_m, &orders_c], &errors)?,
                spectrograms: [map_m, map_c],
                orders: [orders_m, orders_c],
            });
        }
        Ok(pairs)
    }

    /// Spectrograms and order tracking of every channel of a run, by the settings of the model's studies within the range
    /// of its sampling rate.
    ///
    /// # Errors
    /// As [`Self::correlate_run_up`].
    pub fn spectra_of_run(
        &self,
        run: &History,
    ) -> Result<(Vec<SpectrogramResult>, Vec<OrderResult>), StudyError> {
        match self.spectra_within(run, run.sample_rate)? {
            Some((spectra, orders)) => Ok((self.spectrograms(&spectra, run)?, self.orders(&orders, run)?)),
            None => Ok((Vec::new(), Vec::new())),
        }
    }

    /// Settings of the studies for every channel at a sampling rate; `None` if the model lacks one of the two.
    fn spectra_within(
        &self,
        run: &History,
        rate: f64,
    ) -> Result<Option<(SpectrogramStudy, OrderStudy)>, StudyError> {
        let studies = &self.model.studies;
        let (Some(spectra), Some(orders)) = (&studies.spectrogram, &studies.orders) else { return Ok(None) };
        let fastest = run.speed.fold(0.0, f64::max)? / std::f64::consts::TAU;
        let spectra = SpectrogramStudy {
            channels: Vec::new(),
            max_frequency: spectra.max_frequency.min(0.5 * rate),
            ..spectra.clone()
        };
        let max_order = orders.max_order.min(0.95 * rate / (SAMPLES_PER_ORDER * fastest));
        let cuts: Vec<f64> = if orders.cuts.is_empty() { DEFAULT_CUTS.to_vec() } else { orders.cuts.clone() };
        let orders = OrderStudy {
            channels: Vec::new(),
            max_order,
            cuts: cuts.into_iter().filter(|order| *order < max_order).collect(),
            bandwidth: None,
            ..orders.clone()
        };
        Ok(Some((spectra, orders)))
    }
}

fn cut_pairs(runs: [&OrderResult; 2], errors: &KnownErrors) -> Result<Vec<CutPair>, SeriesError> {
    let found = [CutLevels::new(runs[0])?, CutLevels::new(runs[1])?];
    let pair = |k: usize| {
        let [(line, m), (_, c)] = runs.map(|run| &run.cuts[k]);
        let peaks = [peak(m), peak(c)];
        let correlation = correlation(m, c);
        let agreement = agreement(&found, k, peaks, correlation, errors);
        CutPair { line: line.clone(), peaks, correlation, agreement }
    };
    Ok((0..runs[0].cuts.len().min(runs[1].cuts.len())).map(pair).collect())
}

pub(super) fn peak(cut: &OrderCut) -> CutPeak {
    let Some(k) = (0..cut.rms.len()).max_by(|a, b| cut.rms[*a].total_cmp(&cut.rms[*b])) else {
        return CutPeak::default();
    };
    let (low, high) = cut.rpm.iter().fold((f64::INFINITY, 0.0f64), |(l, h), v| (l.min(*v), h.max(*v)));
    let near = END_FRACTION * (high - low);
    let at_end = cut.rpm[k] - low < near || high - cut.rpm[k] < near;
    let inside = (k > 0 && k + 1 < cut.rms.len() && !at_end).then(|| vertex(cut, k)).flatten();
    let (rpm, rms) = inside.unwrap_or((cut.rpm[k], cut.rms[k]));
    CutPeak { rpm, rms, at_end }
}

/// Vertex of the parabola through window k and its neighbours (peak interpolation), if these are high enough.
fn vertex(cut: &OrderCut, k: usize) -> Option<(f64, f64)> {
    const MIN_NEIGHBOUR_RATIO: f64 = 0.7;
    let (x, y) = (&cut.rpm[k - 1..=k + 1], &cut.rms[k - 1..=k + 1]);
    if y[0].min(y[2]) < MIN_NEIGHBOUR_RATIO * y[1] {
        return None;
    }
    let (before, after) = ((y[1] - y[0]) / (x[1] - x[0]), (y[2] - y[1]) / (x[2] - x[1]));
    let curvature = (after - before) / (x[2] - x[0]);
    let step = 0.5 * (x[0] + x[1]) - before / (2.0 * curvature);
    let height = y[1] + before * (step - x[1]) + curvature * (step - x[0]) * (step - x[1]);
    let between = step > x[0].min(x[2]) && step < x[0].max(x[2]);
    (between && curvature < 0.0).then_some((step, height))
}

/// Correlation (MAC-like, (Σ m c)² / (Σ m² Σ c²)) over the measured windows, computed levels interpolated
/// linearly.
pub(super) fn correlation(measured: &OrderCut, computed: &OrderCut) -> f64 {
    let levels: Vec<[f64; 2]> =
        computed.times.iter().zip(&computed.rms).map(|(t, level)| [*t, *level]).collect();
    let (mut both, mut own, mut other) = (0.0, 0.0, 0.0);
    for (t, m) in measured.times.iter().zip(&measured.rms) {
        let [_, c] = piecewise(&levels, *t, Outside::Constant);
        both += m * c;
        own += m * m;
        other += c * c;
    }
    if own * other > 0.0 { both * both / (own * other) } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn peak_of_a_parabola_is_its_vertex() {
        let rpm = vec![100.0, 130.0, 160.0, 200.0];
        let height = |x: f64| 5.0 - 5e-4 * (x - 141.0).powi(2);
        let cut = OrderCut {
            order: 1.0,
            times: (0..4).map(f64::from).collect(),
            rms: rpm.iter().map(|x| height(*x)).collect(),
            rpm,
        };
        let found = peak(&cut);
        assert!((found.rpm - 141.0).abs() < 1e-9 && (found.rms - 5.0).abs() < 1e-12, "{found:?}");
        assert!(!found.at_end && (correlation(&cut, &cut) - 1.0).abs() < 1e-12);
        let mut doubled = cut.clone();
        doubled.rms.iter_mut().for_each(|v| *v *= 2.0);
        assert!((correlation(&cut, &doubled) - 1.0).abs() < 1e-12);
        let rising = OrderCut { rms: vec![1.0, 2.0, 3.0, 4.0], ..cut };
        assert!(peak(&rising).at_end);
    }
}
