//! Whether a measured and a computed order line agree within their uncertainty.
//!
//! A level is uncertain by the background in its band and by the shaft angle: with an angle off by σ, the order ν is off by
//! ν σ of its amplitude at most. A computed one is uncertain by the time step as well. Where the maxima lie in different windows,
//! each is too low by what its window takes from it. The calibration of a sensor is not known here.

use super::order_tracking::CUT_HALF_WIDTH;
use crate::results::{Agreement, CutAgreement, CutPeak, OrderResult, StepError};
use crate::series::SeriesError;
use rotordyn_signal::order::OrderCut;
use rotordyn_signal::order::smear::Smear;
use rotordyn_signal::order_background::CutBackground;

/// Standard deviations of a 95 % interval.
const CONFIDENCE: f64 = 2.0;
/// Part of the distance between windows by which the place of a maximum between them is uncertain: of a maximum that spans
/// several windows, and of one that two or three windows hold.
const BETWEEN_WINDOWS: f64 = 0.1;
const WITHIN_A_WINDOW: f64 = 0.4;
/// Share of [`WITHIN_A_WINDOW`] over √(1 − correlation): levels that are proportional in all windows have maxima at the same place.
const BY_CORRELATION: f64 = 10.0;
/// Distance of two maxima over that of the windows from which the window takes another part of each.
const ELSEWHERE: f64 = 0.3;
/// Windows at half the power and above from which a maximum spans several.
const SPANNED_WINDOWS: usize = 6;

/// Uncertainties that the spectra do not show.
pub(super) struct KnownErrors<'a> {
    /// Standard deviation of the shaft angle \[rad\].
    pub angle: f64,
    pub step: Option<&'a StepError>,
}

/// The order cuts of a channel with their background.
pub(super) struct CutLevels<'a> {
    channel: &'a str,
    cuts: Vec<(&'a str, &'a OrderCut, Option<CutBackground>)>,
    smeared: &'a [Smear],
}

impl<'a> CutLevels<'a> {
    /// # Errors
    /// Amplitudes that cannot be read.
    pub fn new(found: &'a OrderResult) -> Result<Self, SeriesError> {
        let spectrogram = &found.spectrogram;
        let amplitude = spectrogram.amplitude.all()?;
        let lines: Vec<f64> = found.cuts.iter().map(|(line, _)| line.order).collect();
        let half_band = CUT_HALF_WIDTH * spectrogram.orders.get(1).copied().unwrap_or(1.0);
        let of = |(line, cut): &'a (crate::results::OrderLine, OrderCut)| {
            let background = spectrogram.cut_background(&amplitude, line.order, half_band, &lines);
            (line.label.as_str(), cut, background)
        };
        Ok(Self {
            channel: &found.channel,
            cuts: found.cuts.iter().map(of).collect(),
            smeared: &spectrogram.smeared,
        })
    }
}

impl CutLevels<'_> {
    /// Part of the maximum of an order that the window takes.
    fn smear_loss(&self, order: f64) -> f64 {
        self.smeared.iter().filter(|smear| smear.order == order).map(|smear| smear.loss).fold(0.0, f64::max)
    }
}

/// Maximum of an order cut with its standard deviations.
struct UncertainPeak {
    /// Of the level and of the speed, relative.
    level: f64,
    speed: f64,
    /// Distance of the windows there, relative to the speed.
    spacing: f64,
    noise_limit: Option<f64>,
}

impl UncertainPeak {
    /// `relative`: what is uncertain beside the background; `apart`: how far measured and computed levels are from proportional, 0 to 1.
    fn new(
        cut: &OrderCut,
        background: Option<&CutBackground>,
        peak: CutPeak,
        relative: f64,
        apart: f64,
    ) -> Self {
        let nearest = |a: &usize, b: &usize| {
            let distance = |k: usize| (cut.rpm[k] - peak.rpm).abs();
            distance(*a).total_cmp(&distance(*b)).then(cut.rms[*b].total_cmp(&cut.rms[*a]))
        };
        let Some(window) = (0..cut.rpm.len()).min_by(nearest) else {
            return Self { level: f64::INFINITY, speed: f64::INFINITY, spacing: 0.0, noise_limit: None };
        };
        let deviation = |level: f64, window: usize| {
            background.map_or(0.0, |b| b.deviation(level, window)).hypot(relative * level)
        };
        let own = deviation(peak.rms, window);
        let level = own / peak.rms.max(f64::MIN_POSITIVE);
        // Speeds at which the level is that of the maximum within the uncertainty of both.
        let is_as_high =
            |k: &usize| peak.rms - cut.rms[*k] <= CONFIDENCE * own.hypot(deviation(cut.rms[*k], *k));
        let as_high = (0..cut.rpm.len()).filter(is_as_high).map(|k| cut.rpm[k]);
        let (low, high) =
            as_high.fold((peak.rpm, peak.rpm), |(low, high), rpm| (low.min(rpm), high.max(rpm)));
        let neighbours = [window.saturating_sub(1), (window + 1).min(cut.rpm.len() - 1)];
        let spacing = 0.5 * (cut.rpm[neighbours[1]] - cut.rpm[neighbours[0]]).abs();
        let half_power = |k: &usize| cut.rms[*k] >= std::f64::consts::FRAC_1_SQRT_2 * peak.rms;
        let spanned = (0..window).rev().take_while(half_power).count()
            + (window..cut.rpm.len()).take_while(half_power).count();
        let few = if spanned >= SPANNED_WINDOWS { 0.0 } else { apart * WITHIN_A_WINDOW };
        let between = BETWEEN_WINDOWS.max(few);
        let speed = (0.5 * (high - low) / CONFIDENCE).max(between * spacing);
        let noise_limit = background.map(|b| b.limit(window));
        let rpm = peak.rpm.max(f64::MIN_POSITIVE);
        Self { level, speed: speed / rpm, spacing: spacing / rpm, noise_limit }
    }
}

/// Compares the maxima `peaks` \[measured, computed\] of cut `k`.
pub(super) fn agreement(
    runs: &[CutLevels; 2],
    k: usize,
    peaks: [CutPeak; 2],
    correlation: f64,
    errors: &KnownErrors,
) -> CutAgreement {
    let (label, cut, _) = runs[0].cuts[k];
    let step = errors.step.map_or(0.0, |found| {
        let own = found.lines.iter().find(|l| l.channel == runs[1].channel && l.line.label == label);
        own.or_else(|| found.worst()).map_or(0.0, |line| line.error.abs())
    });
    // The angle counts once: it drives the model, and measured and computed orders are read over it.
    let relative = [cut.order * errors.angle, step];
    let apart = (BY_CORRELATION * (1.0 - correlation).max(0.0).sqrt()).min(1.0);
    let uncertain = [0, 1].map(|run| {
        let (_, cut, background) = &runs[run].cuts[k];
        UncertainPeak::new(cut, background.as_ref(), peaks[run], relative[run], apart)
    });
    // Maxima at the same place lose the same by the window.
    let elsewhere = (peaks[1].rpm / peaks[0].rpm).ln().abs() > ELSEWHERE * uncertain[0].spacing;
    let smear = [0, 1].map(|run| if elsewhere { runs[run].smear_loss(cut.order) } else { 0.0 });
    let level = (CONFIDENCE * uncertain[0].level.hypot(uncertain[1].level)).hypot(smear[0].max(smear[1]));
    let speed = CONFIDENCE * uncertain[0].speed.hypot(uncertain[1].speed);
    let [measured, computed] = peaks;
    let finding = if let Some(limit) = uncertain[0].noise_limit.filter(|limit| measured.rms <= *limit) {
        // What is measured is a bound.
        match computed.rms > limit && (computed.rms / measured.rms).ln() > level {
            true => Agreement::LevelDiffers,
            false => Agreement::BelowBackground,
        }
    } else {
        let at_end = measured.at_end || computed.at_end;
        let level_agrees = (computed.rms / measured.rms).ln().abs() <= level;
        let speed_agrees = at_end || (computed.rpm / measured.rpm).ln().abs() <= speed;
        match (level_agrees, speed_agrees) {
            (true, true) => Agreement::Agrees,
            (false, true) => Agreement::LevelDiffers,
            (true, false) => Agreement::SpeedDiffers,
            (false, false) => Agreement::BothDiffer,
        }
    };
    CutAgreement { finding, noise_limit: uncertain.map(|u| u.noise_limit), level, speed }
}
