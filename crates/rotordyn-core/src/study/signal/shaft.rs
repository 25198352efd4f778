//! Shaft speed and angle during a record: constant, sampled, from tacho pulses, or from an order line.

use std::f64::consts::TAU;

use crate::results::ShaftSummary;
use rotordyn_signal::SignalError;
use rotordyn_signal::resample::integrate_speed;
use rotordyn_signal::tacho::PulseTrain;
use rotordyn_signal::tacho_jitter::Jitter;
use rotordyn_signal::tacholess::{SpeedLineSettings, speed_from_line};

/// Relative speed variation up to which the speed counts as constant.
const STEADY_TOLERANCE: f64 = 0.01;
/// Amplitude of a tracked line over its background.
const LEAST_LINE: f64 = 4.0;
/// Ratio of frequencies of a jump of the tracked line that is one to another order.
const MOST_JUMP: f64 = 1.4;
/// Number of sections of a record over which speeds are compared.
const SPEED_SECTIONS: usize = 200;

/// Speed of a shaft, and its angle if known.
#[derive(Clone, Debug, PartialEq)]
pub struct ShaftMotion {
    pub summary: ShaftSummary,
    /// Shaft angle \[rad\] at the record's samples from `first` on; empty if only the mean speed is known.
    pub angle: Vec<f64>,
    pub first: usize,
    /// Jitter of an angle from tacho pulses.
    pub jitter: Option<Jitter>,
    /// Standard deviation of the angle \[rad\]: what smoothing leaves of the jitter; 0 if unknown.
    pub angle_deviation: f64,
}

impl ShaftMotion {
    /// Constant speed \[rev/s\], the direction ignored; `source`: description.
    pub fn constant(speed: f64, source: String) -> Self {
        let speed = speed.abs();
        let summary = ShaftSummary { source, mean: speed, min: speed, max: speed, steady: true };
        ShaftMotion { summary, angle: Vec::new(), first: 0, jitter: None, angle_deviation: 0.0 }
    }

    /// An angle \[rad\] sampled at `sample_rate` \[Hz\] from sample `first` of the record on.
    ///
    /// Lowest and highest speed are means over one revolution or a 200th of the record, if that is longer.
    pub fn from_angle(angle: Vec<f64>, first: usize, sample_rate: f64, source: String) -> Self {
        let last = angle.len() - 1;
        let turns = |a: usize, b: usize| (angle[b] - angle[a]).abs() / TAU;
        let mean = turns(0, last) * sample_rate / last.max(1) as f64;
        let one_turn = if mean > 0.0 { (sample_rate / mean).ceil() as usize } else { last };
        let stride = one_turn.max(last / SPEED_SECTIONS).clamp(1, last.max(1));
        let (mut least, mut most) = (f64::INFINITY, 0.0f64);
        for start in (0..=last.saturating_sub(stride)).step_by(stride) {
            let speed = turns(start, (start + stride).min(last)) * sample_rate / stride as f64;
            (least, most) = (least.min(speed), most.max(speed));
        }
        let steady = most - least <= STEADY_TOLERANCE * mean;
        ShaftMotion {
            summary: ShaftSummary { source, mean, min: least, max: most, steady },
            angle,
            first,
            jitter: None,
            angle_deviation: 0.0,
        }
    }

    /// A speed \[rad/s\] sampled like the record, integrated. Errors: NaN.
    pub fn from_speed(speed: &[f64], sample_rate: f64, source: String) -> Result<Self, SignalError> {
        Ok(Self::from_angle(integrate_speed(speed, sample_rate, 0.0)?, 0, sample_rate, source))
    }

    /// From tacho pulses at times \[s\] from the record's first sample.
    ///
    /// `smoothing`: pulses on either side of the cubics that reduce their jitter, fewer in a short train.
    /// Errors: too few pulses, no sample between the first and the last.
    pub fn from_pulses(
        train: &PulseTrain,
        sample_rate: f64,
        samples: usize,
        smoothing: Option<usize>,
        source: String,
    ) -> Result<Self, SignalError> {
        // Smoothing over nine pulses leaves the slow part of the jitter, which comes close to an order.
        let jitter = Jitter::of_pulses(train);
        let mut angle_deviation = jitter.map_or(0.0, |jitter| jitter.angle);
        let smoothed;
        let train = match smoothing.map(|width| width.min(train.times.len().saturating_sub(1) / 2)) {
            Some(width) => {
                angle_deviation = jitter.map_or(0.0, |jitter| jitter.smoothed_angle(width));
                smoothed = train.smoothed(width)?;
                &smoothed
            }
            None => train,
        };
        let (angle, first) = train.angle(sample_rate, samples)?;
        let motion = Self::from_angle(angle, first, sample_rate, source);
        Ok(ShaftMotion { jitter, angle_deviation, ..motion })
    }

    /// Tacholess: from the line of one order in the record itself, between two frequencies \[Hz\].
    ///
    /// Frames contain 24 periods at the geometric mean of the two; the line may cross the range in an eighth
    /// of the record.
    /// Errors: as [`speed_from_line`]; no line that stands out of the noise.
    pub fn from_order_line(
        record: &[f64],
        sample_rate: f64,
        order: f64,
        range: (f64, f64),
        source: String,
    ) -> Result<Self, SignalError> {
        let (low, high) = range;
        let frame = (24.0 * sample_rate / (low * high).max(f64::MIN_POSITIVE).sqrt()).round();
        let settings = SpeedLineSettings {
            order,
            low,
            high,
            max_sweep_rate: 8.0 * (high - low) * sample_rate / record.len() as f64,
            frame: (frame as usize).clamp(16, record.len().max(16)),
        };
        let found = speed_from_line(record, sample_rate, &settings)?;
        if found.over_background < LEAST_LINE {
            return Err(SignalError::OutOfRange {
                name: "amplitude of the tracked line over the noise around it",
                expected: "4 or more, as noise alone has up to 3: there is no line to follow in this range",
                given: (100.0 * found.over_background).round() / 100.0,
            });
        }
        if found.jump > MOST_JUMP {
            return Err(SignalError::OutOfRange {
                name: "ratio of frequencies between which the tracked line jumps",
                expected: "up to 1.4: the strongest line in the range is that of another order for a time; narrow the range, or \
                           track the strongest order",
                given: (100.0 * found.jump).round() / 100.0,
            });
        }
        Ok(Self::from_angle(found.theta, 0, sample_rate, source))
    }

    /// Times \[s\] (`start`: that of the channel's first sample) and mean speeds \[rpm\] over every 200th of
    /// the record.
    pub fn speeds(&self, sample_rate: f64, start: f64) -> [Vec<f64>; 2] {
        let last = self.angle.len().saturating_sub(1);
        let stride = (last / SPEED_SECTIONS).max(1);
        let at = |k: usize| {
            let (a, b) = (k * stride, (k + 1) * stride);
            let turns = (self.angle[b] - self.angle[a]).abs() / TAU;
            let middle = self.first as f64 + 0.5 * (a + b) as f64;
            (start + middle / sample_rate, 60.0 * turns * sample_rate / stride as f64)
        };
        let (times, speeds) = (0..last / stride).map(at).unzip();
        [times, speeds]
    }
}
