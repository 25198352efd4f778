//! Error of a run-up's order levels by its time step, from a rerun of a stretch with another step.
//!
//! With about twice the step a stretch costs half its steps, so that it can begin well before the largest response and the
//! differences build up as in the whole run. Both steps divide the sampling interval, since at half the sampling rate contacts
//! would fold into the lines; a single step to a sample is doubled and every second sample taken. Explicit steps of that
//! length may be unstable: half the step there.

use std::borrow::Cow;
use std::f64::consts::{PI, TAU};
use std::ops::{ControlFlow, Range};

use serde::{Deserialize, Serialize};

use super::Machine;
use super::cage_turns::CageTurns;
use super::order_tracking::is_selected;
use super::probe_filter::ProbeFilter;
use super::strongest_orders::strongest_orders;
use crate::model::Quantity;
use crate::model::study::{Integrator, RunUpStudy};
use crate::results::{History, HistoryChannel, OrderLine, StepError, StepErrorLine};
use crate::series::SeriesError;
use crate::transient::reduction::Reduction;
use crate::transient::run::{End, Report, Sample, Settings, run};
use crate::transient::system::{State, System};

/// Intervals of a run at whose beginnings the state is kept.
const INTERVALS: usize = 64;
/// Intervals rerun before the largest response, and from there on, in which the levels are compared: with twice the step
/// 9.4 % of the run's steps.
const LEAD: usize = 8;
const COMPARED: usize = 4;
/// The same with half the step.
const SHORT_LEAD: usize = 1;
const SHORT_COMPARED: usize = 2;
/// Samples of a channel read at a time.
const VALUES_AT_ONCE: usize = 1 << 16;
/// Fewest samples of an interval, and fewest cycles of an order in the stretch.
const FEWEST_SAMPLES: usize = 16;
const FEWEST_CYCLES: f64 = 4.0;
/// Highest line looked for, as a share of the sampling rate.
const HIGHEST_SHARE: f64 = 0.125;
/// Lines below this share of their channel's largest level, or of the RMS value of its vibration, are left out.
const SMALLEST_SHARE: f64 = 0.01;
const SMALLEST_SHARE_OF_VIBRATION: f64 = 1e-3;
/// Vibration of a probe below this share of the largest RMS value of a probe with its unit, offset included, is round-off: a
/// direction that nothing excites. What two steps make of it says nothing.
const ROUND_OFF: f64 = 1e-10;
/// Motion below which it is round-off where nothing vibrates \[m, rad\]: the size of a nucleus.
const SMALLEST_MOTION: f64 = 1e-15;

/// States of a run at regular intervals, from which a stretch can be rerun: at most 65 of them, whatever its duration.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Checkpoints {
    every: usize,
    states: Vec<State>,
}

impl Checkpoints {
    /// For a run of a given duration \[s\].
    pub fn new(study: &RunUpStudy, duration: f64) -> Self {
        let samples = (duration * study.sample_rate + 1e-9).floor();
        Self { every: (samples / INTERVALS as f64).ceil().max(1.0) as usize, states: Vec::new() }
    }

    /// Keeps the state of a sample if an interval begins.
    pub fn observe(&mut self, sample: &Sample) {
        if sample.index.is_multiple_of(self.every) {
            self.states.push(sample.state.clone());
        }
    }

    /// Bound of the displacement of a channel in all states, whatever its quantity: |row| |x|.
    fn largest_displacement(&self, system: &System, channel: usize) -> f64 {
        let n = system.structure();
        let largest = self.states.iter().map(|state| state.x.rows(0, n).norm()).fold(0.0, f64::max);
        system.channels.list()[channel].row.rows(0, n).norm() * largest
    }
}

/// Length of a run that [`Machine::step_error`] needs: time \[s\], and turns of the shaft at about constant speed.
pub fn run_for_step_error(sample_rate: f64, orders: &[f64], integrator: Integrator) -> (f64, f64) {
    let compared = if integrator == Integrator::RungeKutta4 { SHORT_COMPARED } else { COMPARED };
    let highest = orders.iter().copied().fold(1.0, f64::max);
    let samples = (INTERVALS * (FEWEST_SAMPLES - 1) + 1) as f64;
    (samples / sample_rate, FEWEST_CYCLES / highest * INTERVALS as f64 / compared as f64)
}

impl Machine {
    /// Estimates the step's error in the levels of the given orders, of all probes.
    ///
    /// `None` for error-controlled steps, for those that free balls choose (whose collisions make lines below the noise of
    /// the run differ at any step), for a run that ended early, and for one too short: an order needs four cycles
    /// within the stretch. Of the samples only parts are read.
    ///
    /// # Errors
    /// Samples that cannot be read.
    pub fn step_error(
        &self,
        study: &RunUpStudy,
        reduction: &Reduction,
        orders: &[f64],
        (checkpoints, history, report): (&Checkpoints, &History, &Report),
    ) -> Result<Option<StepError>, SeriesError> {
        let Some(step) = report.step.filter(|_| report.end == End::Complete) else { return Ok(None) };
        let every = checkpoints.every;
        if every < FEWEST_SAMPLES || reduction.system.has_bodies() || history.time.is_empty() {
            return Ok(None);
        }
        let probes = self.model.probes.len();
        let last = (history.time.len() - 1) / every;
        let Some(centre) = largest_response(history, probes, every, last)? else { return Ok(None) };
        let substeps = (1.0 / (step * study.sample_rate)).round().max(1.0);
        let explicit = study.integrator == Integrator::RungeKutta4;
        let (ratio, thinning) = match substeps {
            _ if explicit => (0.5, 1),
            n if n < 2.0 => (2.0, 2),
            n => (n / (0.5 * n).ceil(), 1),
        };
        let (lead, compared) = if explicit { (SHORT_LEAD, SHORT_COMPARED) } else { (LEAD, COMPARED) };
        let compared_from = centre.saturating_sub(1).min(last.saturating_sub(compared));
        let begin = compared_from.saturating_sub(lead) * every;
        let [first, end] = [compared_from * every, (compared_from + compared).min(last) * every];
        let stretch_angle = history.angle.read(first..end + 1)?;
        let turned = stretch_angle[end - first] - stretch_angle[0];
        let revolutions = turned.abs() / TAU;
        let cages = CageTurns::of(self, history, first..end + 1)?.ratios();
        let named = self.order_lines_of_cages(orders, &cages, 0.5 / revolutions.max(1.0));
        let mut named: Vec<OrderLine> = named.into_iter().map(|found| found.line).collect();
        let is_long_enough = |line: &OrderLine| line.order * revolutions >= FEWEST_CYCLES;
        named.retain(is_long_enough);
        let channels = &history.channels[..probes];
        let shown = self.shown_channels(channels);
        if self.model.studies.orders.is_none() {
            let known: Vec<f64> = named.iter().map(|line| line.order).collect();
            let strongest =
                self.strongest_orders(&stretch_angle, &known, channels, &shown, first..end + 1)?;
            named.extend(self.order_lines(&strongest));
            named.retain(is_long_enough);
        }
        if named.is_empty() {
            return Ok(None);
        }

        let Some(state) = checkpoints.states.get(begin / every).cloned() else { return Ok(None) };
        let time_at = |index: usize| Ok(history.time.at(index)?.unwrap_or(f64::NAN));
        let [time_begin, time_first, time_end] = [time_at(begin)?, time_at(first)?, time_at(end)?];
        let settings = Settings {
            integrator: study.integrator,
            step: step * ratio,
            defect_step: study.defect_step * ratio,
            sample_rate: study.sample_rate / thinning as f64,
            duration: time_end - time_begin,
            energy_balance: false,
        };
        let skipped = first - begin;
        let (mut angle, mut values) = (Vec::new(), vec![Vec::new(); probes]);
        let mut filter = ProbeFilter::default();
        let rerun = run(&reduction.system, state, &settings, |sample| {
            filter.push(sample);
            angle.push(sample.state.spin.angle);
            while let Some(filtered) = filter.pop(sample.is_last()) {
                values.iter_mut().zip(filtered).for_each(|(to, value)| to.push(*value));
            }
            ControlFlow::Continue(())
        });
        if rerun.end != End::Complete {
            return Ok(None);
        }
        let before = skipped.div_ceil(thinning);
        angle.drain(..before);
        values.iter_mut().for_each(|values| drop(values.drain(..before)));
        // The record of the run at the samples of the rerun.
        let from = first + (thinning - skipped % thinning) % thinning;
        let at_samples = |stretch: &[f64]| -> Vec<f64> {
            stretch[from - first..].iter().copied().step_by(thinning).collect()
        };
        let own_angle = at_samples(&stretch_angle);
        // L(h) − L(0) = (L(r h) − L(h))/(r^p − 1) for a method of order p.
        let order = if explicit { 4 } else { 2 };
        let factor = 1.0 / (ratio.powi(order) - 1.0);
        let record = |channel: &HistoryChannel| Ok(at_samples(&channel.values.read(first..end + 1)?));
        let records = channels.iter().map(record).collect::<Result<Vec<_>, SeriesError>>()?;
        let largest_with = |unit: &str| {
            let of_unit = channels.iter().zip(&records).filter(|(channel, _)| channel.unit == unit);
            of_unit.map(|(_, record)| mean_square(record).sqrt()).fold(0.0, f64::max)
        };
        let levels = |angle: &[f64], records: &[Vec<f64>]| -> Vec<Vec<f64>> {
            let window = AngleWindow::new(angle);
            named.iter().map(|line| window.line_levels(records, line.order)).collect()
        };
        let (own_levels, other_levels) = (levels(&own_angle, &records), levels(&angle, &values));
        let mean_speed = turned.abs() / (time_end - time_first);
        let mut lines = Vec::new();
        for (k, (channel, record)) in channels.iter().zip(&records).enumerate().filter(|(k, _)| shown[*k]) {
            let vibration = variance(record).sqrt();
            let displacement = checkpoints.largest_displacement(&reduction.system, k);
            if vibration <= ROUND_OFF * largest_with(&channel.unit) {
                continue;
            }
            let largest = own_levels.iter().map(|levels| levels[k]).fold(0.0, f64::max);
            let least = (SMALLEST_SHARE * largest).max(SMALLEST_SHARE_OF_VIBRATION * vibration);
            for (line, (own, other)) in named.iter().zip(own_levels.iter().zip(&other_levels)) {
                let (level, other_level) = (own[k], other[k]);
                let rate =
                    (line.order * mean_speed).powi(derivatives(reduction.system.channels.list()[k].quantity));
                if level > least.max((ROUND_OFF * displacement).max(SMALLEST_MOTION) * rate) {
                    let error = (other_level - level) / level * factor;
                    let channel = channel.name.clone();
                    lines.push(StepErrorLine { channel, line: line.clone(), level, other_level, error });
                }
            }
        }
        Ok(Some(StepError {
            stretch: [time_first, time_end],
            speed: turned / (time_end - time_first),
            other_step: settings.step,
            lines,
            steps: rerun.steps,
            cost: rerun.steps as f64 / report.steps.max(1) as f64,
        }))
    }

    /// Orders of the strongest line of each checked channel in a stretch, beside those known; up to an eighth of the sampling
    /// rate.
    fn strongest_orders(
        &self,
        angle: &[f64],
        known: &[f64],
        channels: &[HistoryChannel],
        shown: &[bool],
        stretch: Range<usize>,
    ) -> Result<Vec<f64>, SeriesError> {
        let read = channels.iter().zip(shown).filter(|(_, shown)| **shown);
        let records: Vec<Cow<'_, [f64]>> =
            read.map(|(channel, _)| channel.values.read(stretch.clone())).collect::<Result<_, _>>()?;
        let turns = (angle[angle.len() - 1] - angle[0]).abs() / TAU;
        let highest = HIGHEST_SHARE * (angle.len() - 1) as f64 / turns;
        let mut bases = vec![1.0];
        for ball in self.model.bearings.iter().filter_map(|site| site.bearing.ball()) {
            let orders = ball.geometry.characteristic_orders(ball.geometry.contact_angle);
            bases.extend([orders.bpfo, orders.bpfi, orders.bsf]);
        }
        Ok(strongest_orders(angle, records.iter().map(|record| &**record), known, &bases, highest))
    }

    /// Which channels are checked: those of the order cuts, if there are probes among them.
    fn shown_channels(&self, channels: &[HistoryChannel]) -> Vec<bool> {
        let names = self.model.studies.orders.as_ref().map_or(&[][..], |study| &study.channels);
        let shown: Vec<bool> = channels.iter().map(|channel| is_selected(channel, names)).collect();
        if shown.contains(&true) { shown } else { vec![true; channels.len()] }
    }

    /// Orders whose levels are checked: those of the order cuts, or 1x, 2x and the outer race of every bearing, to which the
    /// estimate adds the strongest line of each channel.
    pub fn checked_orders(&self) -> Vec<f64> {
        if let Some(study) = &self.model.studies.orders {
            return study.cuts.clone();
        }
        let mut orders = vec![1.0, 2.0];
        for ball in self.model.bearings.iter().filter_map(|site| site.bearing.ball()) {
            let outer = ball.geometry.characteristic_orders(ball.geometry.contact_angle).bpfo;
            if orders.iter().all(|order| (order - outer).abs() > 1e-9) {
                orders.push(outer);
            }
        }
        orders
    }
}

/// The interval with the largest response: variance of every probe relative to its largest, summed over the probes.
/// Intervals at standstill do not count.
fn largest_response(
    history: &History,
    probes: usize,
    every: usize,
    intervals: usize,
) -> Result<Option<usize>, SeriesError> {
    let angles = (0..=intervals).map(|k| history.angle.at(k * every)).collect::<Result<Vec<_>, _>>()?;
    let moves = |k: &usize| angles[k + 1] != angles[*k];
    let at_once = (VALUES_AT_ONCE / every).max(1);
    let mut sums = vec![0.0; intervals];
    for channel in &history.channels[..probes] {
        let mut variances = Vec::with_capacity(intervals);
        for first in (0..intervals).step_by(at_once) {
            let end = (first + at_once).min(intervals);
            let values = channel.values.read(first * every..end * every)?;
            variances.extend(values.chunks_exact(every).map(variance));
        }
        let largest = variances.iter().copied().fold(0.0, f64::max);
        if largest > 0.0 {
            sums.iter_mut().zip(&variances).for_each(|(sum, v)| *sum += v / largest);
        }
    }
    Ok((0..intervals).filter(moves).max_by(|a, b| sums[*a].total_cmp(&sums[*b])))
}

/// Number of time derivatives from the displacement.
fn derivatives(quantity: Quantity) -> i32 {
    match quantity {
        Quantity::Displacement => 0,
        Quantity::Velocity => 1,
        Quantity::Acceleration => 2,
    }
}

fn variance(values: &[f64]) -> f64 {
    let mean = values.iter().sum::<f64>() / values.len().max(1) as f64;
    values.iter().map(|v| (v - mean).powi(2)).sum::<f64>() / values.len().max(1) as f64
}

fn mean_square(values: &[f64]) -> f64 {
    values.iter().map(|v| v * v).sum::<f64>() / values.len().max(1) as f64
}

/// RMS level of an order in a record over the shaft angle, with a Hann window over the whole angle.
pub(super) fn line_level(angle: &[f64], values: &[f64], order: f64) -> f64 {
    AngleWindow::new(angle).line_levels(&[values], order)[0]
}

/// A Hann window over the shaft angle of some records.
struct AngleWindow<'a> {
    angle: &'a [f64],
    /// Weights of the trapezoidal rule over the angle times the window; none if the shaft does not turn.
    weights: Vec<f64>,
}

impl<'a> AngleWindow<'a> {
    fn new(angle: &'a [f64]) -> Self {
        let (start, span) = match angle {
            [first, .., last] if last != first => (*first, last - first),
            _ => return Self { angle, weights: Vec::new() },
        };
        let weight = |k: usize| {
            let before = if k == 0 { 0.0 } else { angle[k] - angle[k - 1] };
            let after = angle.get(k + 1).map_or(0.0, |next| next - angle[k]);
            (PI * (angle[k] - start) / span).sin().powi(2) * 0.5 * (before + after)
        };
        Self { angle, weights: (0..angle.len()).map(weight).collect() }
    }

    /// RMS level of an order in every record; 0 if the shaft does not turn.
    fn line_levels<R: AsRef<[f64]>>(&self, records: &[R], order: f64) -> Vec<f64> {
        if self.weights.is_empty() {
            return vec![0.0; records.len()];
        }
        let wave = |angle: &f64| (order * (angle - self.angle[0])).sin_cos();
        let waves: Vec<(f64, f64)> = self.angle.iter().map(wave).collect();
        let total: f64 = self.weights.iter().sum();
        let level = |values: &[f64]| {
            let mean = self.weights.iter().zip(values).map(|(w, v)| w * v).sum::<f64>() / total;
            let (mut re, mut im) = (0.0, 0.0);
            for ((w, v), (sin, cos)) in self.weights.iter().zip(values).zip(&waves) {
                re += w * (v - mean) * cos;
                im -= w * (v - mean) * sin;
            }
            std::f64::consts::SQRT_2 * re.hypot(im) / total.abs()
        };
        records.iter().map(|record| level(record.as_ref())).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn level_of_a_line_over_a_varying_speed() {
        // 12 to 24 rad/s in 5 s; 3 cos(2.5 θ) beside a constant and another order five bins away.
        let angle: Vec<f64> =
            (0..5000).map(|k| f64::from(k) * 1e-3).map(|t| 12.0 * t + 1.2 * t * t).collect();
        let values: Vec<f64> =
            angle.iter().map(|a| 7.0 + 3.0 * (2.5 * a + 0.4).cos() + 0.5 * (3.0 * a).sin()).collect();
        let level = line_level(&angle, &values, 2.5);
        assert!((level - 3.0 / std::f64::consts::SQRT_2).abs() < 2e-3, "{level}");
    }
}
