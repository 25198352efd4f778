//! The record in the band: checked, limited to the band, decimated, every channel over its RMS.

use rayon::prelude::*;
use rotordyn_linalg::{Complex64, fft_length};
use rustfft::FftPlanner;

use super::settings::{OperationalSettings, OutputRecord};
use crate::IdentifyError;
use crate::data::derivatives;

/// Responses in the band.
#[derive(Clone)]
pub(super) struct Prepared {
    /// `samples[channel][sample]`, over `scale`.
    pub samples: Vec<Vec<f64>>,
    /// \[Hz\].
    pub rate: f64,
    pub band: [f64; 2],
    /// RMS of every channel in the band.
    pub scale: Vec<f64>,
    /// Time derivatives of every channel beyond the channel with the fewest.
    derivatives: Vec<i32>,
    /// Samples of the record per sample here.
    pub step: f64,
    /// Samples left out at the start.
    pub first: usize,
}

/// Fewest samples of a record.
const MIN_SAMPLES: usize = 512;
/// New sampling rate over the upper end of the band, and the start of the transition to zero below.
const RATE_OVER_BAND: f64 = 2.6;
/// Parts of the record whose powers are compared.
const PARTS: usize = 100;
/// Power over the median of the parts at the start and at the end of a transient. The power of a mode in a part has at least two
/// degrees of freedom: random forces give a value above 20 in one of 10⁶ parts.
const TRANSIENT_START: f64 = 20.0;
const TRANSIENT_END: f64 = 3.0;
/// Response of a filter to the end of the record, over the inverse of its transition's width.
const EDGE: f64 = 4.0;
/// Width of the transition beyond an end of the band, relative to it.
const TRANSITION: f64 = 0.2;

impl Prepared {
    pub fn new(record: &OutputRecord, settings: &OperationalSettings) -> Result<Self, IdentifyError> {
        check(record, settings)?;
        let samples = record.samples[0].len();
        let nyquist = 0.5 * record.sample_rate;
        let duration = samples as f64 / record.sample_rate;
        let [from, to] = settings.band.unwrap_or([0.0, nyquist]);
        // Some hundred cycles of the lowest mode are the least that a correlation needs.
        let band = [if settings.band.is_some() { from } else { 100.0 / duration }, to.min(0.98 * nyquist)];
        // A power-law length of the padded record, and the length of the decimated one with an even number of samples.
        let padded = fft_length(samples, 1);
        let ratio = (RATE_OVER_BAND * band[1] / record.sample_rate).min(1.0);
        let length = ((0.5 * padded as f64 * ratio).ceil() as usize * 2).min(padded);
        let kept = (samples as f64 * length as f64 / padded as f64).floor() as usize;
        let mut planner = FftPlanner::<f64>::new();
        let (forward, inverse) = (planner.plan_fft_forward(padded), planner.plan_fft_inverse(length));
        let weight = |k: usize| {
            let hz = k as f64 * record.sample_rate / padded as f64;
            let low = if settings.band.is_some() && from > 0.0 {
                ramp((hz - (1.0 - TRANSITION) * from) / (TRANSITION * from))
            } else {
                1.0
            };
            let high =
                if length < padded { ramp(((1.0 + TRANSITION) * to - hz) / (TRANSITION * to)) } else { 1.0 };
            low * high
        };
        let one = |channel: &Vec<f64>| -> Vec<f64> {
            let mean = channel.iter().sum::<f64>() / samples as f64;
            let mut buffer = vec![Complex64::default(); padded];
            buffer.iter_mut().zip(channel).for_each(|(slot, x)| slot.re = x - mean);
            forward.process(&mut buffer);
            let mut out = vec![Complex64::default(); length];
            for k in 1..length / 2 {
                out[k] = buffer[k] * weight(k);
                out[length - k] = out[k].conj();
            }
            inverse.process(&mut out);
            out[..kept].iter().map(|v| v.re / padded as f64).collect()
        };
        // At its ends the record is cut off, which the filters answer with a spike.
        let transitions =
            [(length < padded).then_some(to), (settings.band.is_some() && from > 0.0).then_some(from)];
        let narrowest = transitions.into_iter().flatten().fold(f64::INFINITY, f64::min);
        let rate = record.sample_rate * length as f64 / padded as f64;
        let edge = ((EDGE / (TRANSITION * narrowest) * rate) as usize).min(kept / 20);
        let cut = |channel: Vec<f64>| channel[edge..kept - edge].to_vec();
        let kept = kept - 2 * edge;
        let mut out: Vec<Vec<f64>> = record.samples.par_iter().map(|channel| cut(one(channel))).collect();
        let mut scale = Vec::with_capacity(out.len());
        for (channel, dof) in out.iter_mut().zip(&record.dofs) {
            let rms = (channel.iter().map(|x| x * x).sum::<f64>() / kept as f64).sqrt();
            if rms.is_nan() || rms <= 0.0 {
                return Err(IdentifyError::DeadResponse { response: dof.to_string() });
            }
            channel.iter_mut().for_each(|x| *x /= rms);
            scale.push(rms);
        }
        let step = padded as f64 / length as f64;
        let derivatives = record.quantities.iter().map(|quantity| derivatives(*quantity));
        let fewest = derivatives.clone().min().unwrap_or(0);
        let derivatives = derivatives.map(|d| d - fewest).collect();
        Ok(Self {
            samples: out,
            rate: record.sample_rate / step,
            band,
            scale,
            derivatives,
            step,
            first: edge,
        })
    }

    /// The record without its first `count` samples.
    pub fn without_start(mut self, count: usize) -> Self {
        self.samples.iter_mut().for_each(|channel| *channel = channel.split_off(count));
        self.first += count;
        self
    }

    /// Length of the transient at the start, such as that of a machine switched on: a hundredth of the record with over
    /// [`TRANSIENT_START`] times the usual power, up to the first with less than [`TRANSIENT_END`] times. 0 for none, and for one
    /// that fills a fifth of the record.
    pub fn transient(&self) -> usize {
        let length = self.len() / PARTS;
        let mut over = [0.0f64; PARTS];
        for samples in &self.samples {
            let mut powers: Vec<f64> = samples
                .chunks_exact(length.max(1))
                .take(PARTS)
                .map(|part| part.iter().map(|x| x * x).sum())
                .collect();
            let own = powers.clone();
            let usual = *powers.select_nth_unstable_by(PARTS / 2, f64::total_cmp).1;
            over.iter_mut()
                .zip(own)
                .for_each(|(over, power)| *over = over.max(power / usual.max(f64::MIN_POSITIVE)));
        }
        let end = over.iter().position(|over| *over < TRANSIENT_END).unwrap_or(PARTS);
        if over[0] > TRANSIENT_START && end <= PARTS / 5 { end * length } else { 0 }
    }

    /// Factors that turn a shape of the samples into one of a single quantity in SI units: scale_c λ^(−d_c) for the d_c-th
    /// derivative of a motion e^{λt}.
    pub fn to_one_quantity(&self, pole: Complex64) -> Vec<Complex64> {
        self.scale.iter().zip(&self.derivatives).map(|(s, d)| pole.powi(-d) * *s).collect()
    }

    pub fn channels(&self) -> usize {
        self.samples.len()
    }

    pub fn len(&self) -> usize {
        self.samples[0].len()
    }

    /// \[s\].
    pub fn duration(&self) -> f64 {
        self.len() as f64 / self.rate
    }
}

/// 0 below 0, 1 above 1, a raised cosine between.
fn ramp(x: f64) -> f64 {
    0.5 - 0.5 * (std::f64::consts::PI * x.clamp(0.0, 1.0)).cos()
}

fn check(record: &OutputRecord, settings: &OperationalSettings) -> Result<(), IdentifyError> {
    let fault = |what: &'static str, reason: String| Err(IdentifyError::Setting { what, reason });
    let channels = record.samples.len();
    if channels == 0 || record.dofs.len() != channels || record.quantities.len() != channels {
        let (points, quantities) = (record.dofs.len(), record.quantities.len());
        return fault(
            "channels",
            format!("{channels} records for {points} points and {quantities} quantities"),
        );
    }
    let samples = record.samples[0].len();
    if let Some(other) = record.samples.iter().find(|c| c.len() != samples) {
        return fault(
            "channels",
            format!("{samples} and {} samples; all must be recorded together", other.len()),
        );
    }
    if !(record.sample_rate > 0.0 && record.sample_rate.is_finite()) {
        return fault("sampling rate", format!("{} Hz is not positive", record.sample_rate));
    }
    if samples < MIN_SAMPLES {
        return fault("record", format!("{samples} samples are too few; {MIN_SAMPLES} or more are needed"));
    }
    for (channel, dof) in record.samples.iter().zip(&record.dofs) {
        if let Some(k) = channel.iter().position(|x| !x.is_finite()) {
            return Err(IdentifyError::NotFiniteSample {
                response: dof.to_string(),
                time: k as f64 / record.sample_rate,
            });
        }
        if channel.iter().all(|x| *x == channel[0]) {
            return Err(IdentifyError::DeadResponse { response: dof.to_string() });
        }
    }
    if let Some([from, to]) = settings.band {
        let nyquist = 0.5 * record.sample_rate;
        if !(from >= 0.0 && to > from && from < nyquist) {
            return fault(
                "band",
                format!(
                    "{from:.3} .. {to:.3} Hz is not a range below half the sampling rate, {nyquist:.3} Hz"
                ),
            );
        }
    }
    if let Some(list) = &settings.references
        && (list.is_empty() || list.iter().any(|k| *k >= channels))
    {
        return fault("reference channels", format!("{list:?} of {channels} channels"));
    }
    if let Some(order) = settings.max_order
        && order < 4
    {
        return fault("highest order", format!("{order} is too low; stable poles need 4 or more"));
    }
    if let super::settings::Shaft::Angle(angle) = &settings.shaft
        && (angle.len() != samples || angle.iter().any(|a| !a.is_finite()))
    {
        return fault("shaft angle", format!("{} values for {samples} samples, all finite", angle.len()));
    }
    if let super::settings::Shaft::Steady(speed) = settings.shaft
        && !(speed > 0.0 && speed.is_finite())
    {
        return fault("shaft speed", format!("{speed} rev/s is not positive"));
    }
    Ok(())
}
