//! Spectrograms whose window is too long for the change of speed within it.

use super::order_tracks::smeared_maxima;
use crate::document::number;
use crate::model::Model;
use crate::model::study::WindowKind;
use crate::results::{History, SpectrogramResult};
use crate::study::Results;
use crate::warning::{Code, Warning};
use std::f64::consts::{PI, TAU};

/// Samples of a window for its shape.
const SAMPLES: usize = 256;
/// Width of an order line over that in the best window, above which a window is too long.
const WIDTH_RATIO: f64 = 2.0;

/// Order lines that a window of the spectrogram, of the cuts or of the tracks smears.
pub(super) fn smeared_orders(model: &Model, results: &Results) -> Vec<Warning> {
    let mut found: Vec<Warning> = smeared_line(model, results).into_iter().collect();
    found.extend(smeared_maxima(&results.orders));
    found
}

/// The highest order line shown, if a window is too long for it.
///
/// Within a window of length T an order n sweeps over β = n ḟ T² lines of 1/T, ḟ the rate of the rotational frequency. A
/// steady line is b lines wide at half its height; a sweep leaves the window's own shape, the share c of it above one half,
/// so that the width is B(T) ≈ √((b/T)² + (c n ḟ T)²) in Hz. It is least at β₀ = b/c (Hann: 2/0.5 = 4 lines, 1 dB below the
/// steady level): shorter windows resolve less, longer ones smear. B/B₀ = √(½ (β₀/β + β/β₀)) reaches 2 at
/// β = (4 + √15) β₀ = 7.9 β₀ (Hann: 31 lines, 9 dB low). Below it a window is a matter of taste: the usual 1 s in a ramp
/// to 3000 rpm within 5 s sweeps 10 lines, 1.2 times the least width.
fn smeared_line(model: &Model, results: &Results) -> Option<Warning> {
    let study = model.studies.spectrogram.as_ref()?;
    let rate = match &results.run_up {
        Some(run) => fastest(&run.history, study.length),
        None => results.spectrograms.iter().map(fastest_of_frames).fold(0.0, f64::max),
    };
    let shown = results.spectrograms.iter().flat_map(|found| &found.orders);
    let line = shown.max_by(|a, b| a.order.total_cmp(&b.order))?;
    let best = best_sweep(study.window);
    let swept = line.order * rate * study.length.powi(2);
    let relative = swept / best;
    if 0.5 * (relative + 1.0 / relative) <= WIDTH_RATIO.powi(2) || relative <= 1.0 {
        return None;
    }
    let text = format!(
        "spectrogram: within a window of {} s the speed changes by up to {:.0} rpm: the order line {} sweeps over {} lines of \
         {} Hz and is shown {:.0} dB too low",
        number(study.length, 3),
        60.0 * rate * study.length,
        line.label,
        number(swept, 3),
        number(1.0 / study.length, 3),
        -20.0 * sweep_level(study.window, swept).log10()
    );
    let sharpest = (best / (line.order * rate)).sqrt();
    let advice =
        format!("a window of {} s shows it sharpest (study.spectrogram.length)", number(sharpest, 2));
    Some(Warning::new(Code::OrderSmear, "study.spectrogram", text).advise(advice))
}

/// Largest mean rate of the rotational frequency over a window \[Hz/s\].
fn fastest(history: &History, window: f64) -> f64 {
    // A speed that cannot be read any more fails where it is shown.
    let Ok(speed) = history.speed.all() else { return 0.0 };
    let samples = ((window * history.sample_rate).round() as usize).clamp(1, speed.len().max(2) - 1);
    let change =
        speed.iter().zip(speed.iter().skip(samples)).map(|(from, to)| (to - from).abs()).fold(0.0, f64::max);
    change * history.sample_rate / (samples as f64 * TAU)
}

/// The same of a stored run, from one frame to the next.
fn fastest_of_frames(found: &SpectrogramResult) -> f64 {
    let steps = found.spectrogram.times.windows(2).zip(found.speed.windows(2));
    steps.map(|(t, speed)| (speed[1] - speed[0]).abs() / (t[1] - t[0]) / TAU).fold(0.0, f64::max)
}

/// Sweep β₀ \[lines\] of the least width: width of a steady line over the share of the window, both at half height.
fn best_sweep(window: WindowKind) -> f64 {
    let samples = window.samples(SAMPLES);
    let above = samples.iter().filter(|sample| **sample >= 0.5).count() as f64 / SAMPLES as f64;
    let mut offset = 0.0;
    while line_level(&samples, offset, 0.0) > 0.5 {
        offset += 0.01;
    }
    2.0 * offset / above
}

/// Level at the middle of a line that sweeps over β lines, over that of a steady line.
fn sweep_level(window: WindowKind, swept: f64) -> f64 {
    line_level(&window.samples(SAMPLES), 0.0, swept)
}

/// |Σ w e^{jπ(β u² − 2 δ u)}|/Σ w at δ lines from the middle of a line, u from −½ to ½.
fn line_level(samples: &[f64], offset: f64, swept: f64) -> f64 {
    let count = samples.len() as f64;
    let [mut re, mut im] = [0.0; 2];
    for (n, sample) in samples.iter().enumerate() {
        let u = n as f64 / count - 0.5;
        let (sin, cos) = (PI * (swept * u * u - 2.0 * offset * u)).sin_cos();
        re += sample * cos;
        im += sample * sin;
    }
    re.hypot(im) / samples.iter().sum::<f64>()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Distance of the points of a spectrum \[lines\].
    const STEP: f64 = 0.05;

    /// Width of a line at half its height \[lines\], from its spectrum.
    fn width(samples: &[f64], swept: f64) -> f64 {
        let levels: Vec<f64> = (0..=1200).map(|k| line_level(samples, STEP * f64::from(k), swept)).collect();
        let largest = levels.iter().copied().fold(0.0, f64::max);
        2.0 * STEP * levels.iter().rposition(|level| *level >= 0.5 * largest).unwrap() as f64
    }

    /// Widths in Hz for a sweep of 1 Hz/s, in which a window of √β s sweeps over β lines: least near β₀, at 7.9 β₀ 2.0 to 2.4
    /// times that. The sum of squares overstates the least width by up to a fifth, not the wide ones.
    #[test]
    fn a_line_is_narrowest_at_the_best_sweep() {
        for window in [WindowKind::Hann, WindowKind::Hamming, WindowKind::Blackman] {
            let samples = window.samples(256);
            let hertz = |swept: f64| width(&samples, swept) / swept.sqrt();
            let best = best_sweep(window);
            let least = (1..100).map(|k| hertz(0.4 * f64::from(k))).fold(f64::INFINITY, f64::min);
            assert!(hertz(best) / least < 1.1, "{window:?} {best}: {} {least}", hertz(best));
            let limit = (4.0 + 15f64.sqrt()) * best;
            let ratio = hertz(limit) / least;
            assert!((2.0..2.4).contains(&ratio), "{window:?} {best}: {ratio}");
        }
        assert!((best_sweep(WindowKind::Hann) - 4.0).abs() < 0.1);
    }

    /// Stationary phase: far from β = 0 a sweep is as high as w(0)/√β over the mean of the window.
    #[test]
    fn a_long_sweep_has_the_level_of_stationary_phase() {
        for (window, mean) in [(WindowKind::Hann, 0.5), (WindowKind::Blackman, 0.42)] {
            let expected = 1.0 / (mean * 40f64.sqrt());
            assert!((sweep_level(window, 40.0) / expected - 1.0).abs() < 0.02, "{window:?}");
            assert!((sweep_level(window, 0.0) - 1.0).abs() < 1e-12);
        }
    }
}
