//! Resampling: uniform in shaft angle with an anti-aliasing filter that follows the speed, and uniform in time.

use std::f64::consts::{PI, TAU};
use std::ops::Range;

use super::SignalError;
use super::error::{check, check_length, check_rate, check_record, check_same_length};
use super::kaiser::kaiser;
use super::stft::interpolate_at;
use rotordyn_linalg::dot::dot_in_sixteens;
use rotordyn_linalg::spline::Spline;
use rotordyn_linalg::with_widest_vectors;

/// Zero crossings of the interpolating sinc on each side.
const ZERO_CROSSINGS: usize = 32;
/// Points of the kernel's table between zero crossings; linear interpolation errs by π²/(8·512²) = 5e-6.
const TABLE_STEPS: usize = 512;
/// Kaiser window shape for −100 dB in the stop band.
const KAISER_BETA: f64 = 10.06;
/// The sinc's cut-off over Nyquist: the transition band ends at Nyquist.
const CUTOFF: f64 = 0.9;
/// Highest order passed unchanged is the samples per revolution over this.
pub const SAMPLES_PER_ORDER: f64 = 2.56;

/// Why a stretch of the record is not in the angle-uniform result.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SkipReason {
    /// The shaft stands, turns slower than the least speed, or turns back by less than a revolution.
    Standstill,
    /// The shaft turns, but for less than one revolution.
    LessThanOneRevolution,
}

/// A stretch of the record that was left out.
#[derive(Clone, Debug, PartialEq)]
pub struct Skipped {
    /// Its samples.
    pub samples: Range<usize>,
    pub reason: SkipReason,
}

/// A stretch with the shaft turning one way; output k is at shaft angle 2π (first + k) / S, counted in the sense in which
/// it turns there.
#[derive(Clone, Debug)]
pub struct AnglePart {
    /// Index of the first output on the angle grid that begins at θ = 0.
    pub first: i64,
    /// Time of each output \[s\].
    pub times: Vec<f64>,
    /// Samples of the record.
    samples: Range<usize>,
    /// Clock u of each sample: it runs with the record's samples or with the outputs, whichever is slower.
    clock: Vec<f64>,
    /// Clock of each output.
    positions: Vec<f64>,
}

/// Turns records into samples uniform in shaft angle; planned once for a shaft angle, used for all channels.
///
/// y(θ_k) = Σ_n h(u_k − u_n) x_n Δu_n / Σ_n h(u_k − u_n) Δu_n, h a Kaiser-windowed sinc of 32 zero crossings a side,
/// on the clock du = min(1, S dθ/2π) per sample: an exact band-limited interpolation in time where the outputs are
/// denser than the samples, an anti-aliasing filter in shaft angle where they are sparser.
///
/// Error: orders up to S/2.56 (and frequencies up to 0.39 f_s) within 1e-4 of their amplitude, orders above S/2
/// suppressed by 90 dB or more; within 36 outputs or samples of the ends of a part the filter is one-sided and
/// errs by some per cent near the upper limit. The angle between samples is taken as linear, which errs by
/// Δt² max|θ̈|/8. Cost: 70 multiplications per sample or output, whichever are more.
pub struct AngleResampler {
    samples_per_revolution: usize,
    length: usize,
    parts: Vec<AnglePart>,
    skipped: Vec<Skipped>,
    kernel: Vec<f64>,
}

impl AngleResampler {
    /// Plans the resampling from a shaft angle sampled like the record.
    ///
    /// `theta` (N) \[rad\] (a shaft turning to negative angles is allowed), `sample_rate` \[Hz\],
    /// `samples_per_revolution` S ≥ 2, `least_speed` \[rev/s\] below which a stretch counts as standstill.
    /// Errors: NaN, and a shaft that nowhere turns one revolution.
    pub fn new(
        theta: &[f64],
        sample_rate: f64,
        samples_per_revolution: usize,
        least_speed: f64,
    ) -> Result<Self, SignalError> {
        check_record("shaft angle", theta)?;
        check_rate(sample_rate)?;
        check_length("shaft angle", theta.len(), 2, "a speed")?;
        let per_revolution = samples_per_revolution as f64;
        check(samples_per_revolution >= 2, "samples per revolution", "two or more", per_revolution)?;
        check(least_speed > 0.0 && least_speed.is_finite(), "least speed", "a positive number", least_speed)?;
        let direction = if theta[theta.len() - 1] < theta[0] { -1.0 } else { 1.0 };
        let turns: Vec<f64> = theta.iter().map(|a| direction * a / TAU).collect();
        let least_step = least_speed / sample_rate;
        let (mut parts, mut skipped) = (Vec::new(), Vec::<Skipped>::new());
        let mut longest: f64 = 0.0;
        let mut start = 0;
        while start + 1 < turns.len() {
            let turning = turns[start + 1] - turns[start] >= least_step;
            let more =
                turns[start..].windows(2).take_while(|w| (w[1] - w[0] >= least_step) == turning).count();
            let samples = start..start + more + 1;
            let revolutions = turns[start + more] - turns[start];
            if turning {
                longest = longest.max(revolutions);
            }
            if turning && revolutions >= 1.0 {
                parts.push(AnglePart::new(&turns, samples, sample_rate, per_revolution));
            } else if turning {
                skipped.push(Skipped { samples, reason: SkipReason::LessThanOneRevolution });
            } else {
                let mut rest = samples.start;
                for turned in turning_back(&turns, samples.clone(), least_step) {
                    if turned.start > rest {
                        let samples = rest..turned.start + 1;
                        skipped.push(Skipped { samples, reason: SkipReason::Standstill });
                    }
                    rest = turned.end - 1;
                    let back: Vec<f64> = turns[..turned.end].iter().map(|turn| -turn).collect();
                    parts.push(AnglePart::new(&back, turned, sample_rate, per_revolution));
                }
                if rest + 1 < samples.end {
                    skipped.push(Skipped { samples: rest..samples.end, reason: SkipReason::Standstill });
                }
            }
            start += more;
        }
        if parts.is_empty() {
            return Err(SignalError::TooFewRevolutions {
                needed: 1.0,
                given: longest,
                purpose: "samples uniform in shaft angle",
            });
        }
        Ok(AngleResampler { samples_per_revolution, length: theta.len(), parts, skipped, kernel: kernel() })
    }

    /// S, the outputs in a revolution.
    pub fn samples_per_revolution(&self) -> usize {
        self.samples_per_revolution
    }

    /// The stretches in which the shaft turns.
    pub fn parts(&self) -> &[AnglePart] {
        &self.parts
    }

    /// The stretches that were left out, and why.
    pub fn skipped(&self) -> &[Skipped] {
        &self.skipped
    }

    /// Samples uniform in shaft angle: for each part, for each channel, a record.
    ///
    /// The kernel is evaluated once for all channels. Errors: NaN, a channel as long as the angle is not.
    pub fn resample(&self, channels: &[&[f64]]) -> Result<Vec<Vec<Vec<f64>>>, SignalError> {
        for channel in channels {
            check_record("channel", channel)?;
            check_same_length("channel", channel.len(), "the shaft angle", self.length)?;
        }
        Ok(self.parts.iter().map(|part| part.resample(channels, &self.kernel)).collect())
    }
}

impl AnglePart {
    /// Lays the grid of outputs and the clock over the samples; `turns` is the angle in revolutions.
    fn new(turns: &[f64], samples: Range<usize>, sample_rate: f64, per_revolution: f64) -> Self {
        let inside = &turns[samples.clone()];
        let mut clock = Vec::with_capacity(inside.len());
        let mut u = 0.0;
        clock.push(u);
        for pair in inside.windows(2) {
            u += (per_revolution * (pair[1] - pair[0])).min(1.0);
            clock.push(u);
        }
        let first = (inside[0] * per_revolution).ceil() as i64;
        let last = (inside[inside.len() - 1] * per_revolution).floor() as i64;
        let (mut times, mut positions) = (Vec::new(), Vec::new());
        let mut n = 0;
        for k in first..=last {
            let turn = k as f64 / per_revolution;
            while n + 2 < inside.len() && inside[n + 1] <= turn {
                n += 1;
            }
            let fraction = (turn - inside[n]) / (inside[n + 1] - inside[n]);
            times.push((samples.start + n) as f64 / sample_rate + fraction / sample_rate);
            positions.push(clock[n] + fraction * (clock[n + 1] - clock[n]));
        }
        AnglePart { first, times, samples, clock, positions }
    }

    fn resample(&self, channels: &[&[f64]], kernel: &[f64]) -> Vec<Vec<f64>> {
        with_widest_vectors(
            #[inline(always)]
            || self.sums(channels, kernel),
        )
    }

    #[inline(always)]
    fn sums(&self, channels: &[&[f64]], kernel: &[f64]) -> Vec<Vec<f64>> {
        let reach = ZERO_CROSSINGS as f64 / CUTOFF;
        let scale = CUTOFF * TABLE_STEPS as f64;
        let clock = &self.clock;
        let end = clock.len() - 1;
        // Trapezoidal weights Δu of the sum over samples.
        let width: Vec<f64> =
            (0..=end).map(|n| 0.5 * (clock[(n + 1).min(end)] - clock[n.saturating_sub(1)])).collect();
        let mut out = vec![Vec::with_capacity(self.positions.len()); channels.len()];
        let mut weights = Vec::new();
        let (mut low, mut high) = (0, 0);
        for &u in &self.positions {
            while clock[low] <= u - reach {
                low += 1;
            }
            while high <= end && clock[high] < u + reach {
                high += 1;
            }
            weights.clear();
            let mut sum = 0.0;
            for (place, du) in clock[low..high].iter().zip(&width[low..high]) {
                let at = (u - place).abs() * scale;
                let index = at as usize;
                let h = kernel[index] + (at - index as f64) * (kernel[index + 1] - kernel[index]);
                sum += h * du;
                weights.push(h * du);
            }
            let range = self.samples.start + low..self.samples.start + high;
            for (out, channel) in out.iter_mut().zip(channels) {
                out.push(dot_in_sixteens(&channel[range.clone()], &weights) / sum);
            }
        }
        out
    }
}

/// Stretches of a range in which the shaft turns back by a revolution or more.
fn turning_back(turns: &[f64], samples: Range<usize>, least_step: f64) -> Vec<Range<usize>> {
    let mut found = Vec::new();
    let mut start = samples.start;
    while start + 1 < samples.end {
        let steps = turns[start..samples.end].windows(2);
        let steps = steps.take_while(|pair| pair[0] - pair[1] >= least_step).count();
        if turns[start] - turns[start + steps] >= 1.0 {
            found.push(start..start + steps + 1);
        }
        start += steps.max(1);
    }
    found
}

/// One side of the Kaiser-windowed sinc, with two zeros behind its end.
fn kernel() -> Vec<f64> {
    let points = ZERO_CROSSINGS * TABLE_STEPS;
    let mut table = Vec::with_capacity(points + 2);
    for i in 0..points {
        let v = PI * i as f64 / TABLE_STEPS as f64;
        let sinc = if i == 0 { 1.0 } else { v.sin() / v };
        table.push(sinc * kaiser(KAISER_BETA, i as f64 / points as f64));
    }
    table.extend([0.0, 0.0]);
    table
}

/// Shaft angle \[rad\] from speed \[rad/s\], θ_n = θ₀ + Σ (Ω_{n−1} + Ω_n)/(2f_s); errors: NaN.
pub fn integrate_speed(speed: &[f64], sample_rate: f64, start: f64) -> Result<Vec<f64>, SignalError> {
    check_record("speed", speed)?;
    check_rate(sample_rate)?;
    let mut theta = start;
    let mut before = speed[0];
    Ok(speed
        .iter()
        .map(|&now| {
            theta += 0.5 * (before + now) / sample_rate;
            before = now;
            theta
        })
        .collect())
}

/// Sampling rate \[Hz\] of a uniform time axis \[s\]; a step off the mean by more than 1e-3 of it is an error.
///
/// Errors: NaN, fewer than two times, not increasing, not uniform.
pub fn uniform_rate(time: &[f64]) -> Result<f64, SignalError> {
    check_record("time", time)?;
    check_length("time", time.len(), 2, "a sampling rate")?;
    let step = (time[time.len() - 1] - time[0]) / (time.len() - 1) as f64;
    for (index, pair) in time.windows(2).enumerate() {
        let given = pair[1] - pair[0];
        if given <= 0.0 || (given - step).abs() > 1e-3 * step {
            return Err(SignalError::NonUniform { index, expected: step, given });
        }
    }
    Ok(1.0 / step)
}

/// Values at t₀ + k/f_s by a natural cubic spline through irregular samples; fourth order inside, second at the ends.
///
/// `time` (N) \[s\] increasing, `record` (N); no anti-aliasing: choose f_s no lower than the samples' own.
/// Errors: NaN, unequal lengths, times that do not increase.
pub fn to_uniform_time(time: &[f64], record: &[f64], sample_rate: f64) -> Result<Vec<f64>, SignalError> {
    check_record("time", time)?;
    check_record("record", record)?;
    check_same_length("record", record.len(), "time", time.len())?;
    check_rate(sample_rate)?;
    check_length("time", time.len(), 2, "interpolation")?;
    let n = time.len();
    let Some(spline) = Spline::natural(time, record) else {
        let index = time.windows(2).position(|w| w[1] <= w[0]).unwrap_or(0);
        let expected = (time[n - 1] - time[0]) / (n - 1) as f64;
        return Err(SignalError::NonUniform { index, expected, given: time[index + 1] - time[index] });
    };
    let count = ((time[n - 1] - time[0]) * sample_rate * (1.0 + 1e-12)).floor() as usize + 1;
    Ok((0..count).map(|k| spline.evaluate(time[0] + k as f64 / sample_rate)[0]).collect())
}

/// Speed \[rpm\] at the centre of a stretch of outputs, over the revolution (or what there is) about it.
pub(crate) fn speed_rpm(part: &AnglePart, centre: f64, samples_per_revolution: usize) -> f64 {
    let last = (part.times.len() - 1) as f64;
    let half = 0.5 * samples_per_revolution as f64;
    let (from, to) = ((centre - half).max(0.0), (centre + half).min(last));
    let seconds = interpolate_at(&part.times, to) - interpolate_at(&part.times, from);
    60.0 * (to - from) / (samples_per_revolution as f64 * seconds)
}
