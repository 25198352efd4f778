//! The strong lines of an envelope spectrum, each with what explains it.

use serde::{Deserialize, Serialize};

use super::super::bearing_lines::BearingPart;
use super::super::spectrum::decibel;
use super::line_spectrum::LineSpectrum;
use super::part_fit::PartFit;
use super::rival_kind::RivalKind;
use super::rivals::Rival;

/// Lines below this share of the highest are not listed.
const LISTED: f64 = 0.1;
/// Shaft harmonics that count as explained without a family: 1x, 2x, 3x.
const SHAFT_ORDERS: f64 = 3.0;

/// What a line belongs to.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum Explanation {
    Bearing(BearingPart),
    /// Harmonic of the shaft speed.
    Shaft(usize),
    Mains,
    /// Difference of lines of shaft and mains in the record itself, which beat in the demodulated band.
    Beat,
    /// Family of another rate \[Hz, or order\].
    Periodic(f64),
    /// Nothing known.
    Unexplained,
}

/// A strong line of the envelope spectrum.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct StrongLine {
    /// \[Hz\], or order.
    pub frequency: f64,
    pub amplitude: f64,
    /// Amplitude over background \[dB\].
    pub level_db: f64,
    pub explanation: Explanation,
}

/// Peaks down to a tenth of the highest, with the family that explains each; `parts`: those named, the first foremost.
pub(super) fn strong_lines(
    spectrum: &LineSpectrum,
    parts: &[&PartFit],
    rivals: &[Rival],
    shaft: f64,
) -> Vec<StrongLine> {
    let step = spectrum.step;
    let highest = spectrum.peaks.first().map_or(0.0, |p| p.amplitude);
    let explain = |frequency: f64| {
        if let Some(fit) = parts.iter().find(|fit| fit.explains(frequency, shaft, step)) {
            return Explanation::Bearing(fit.part);
        }
        let order = (frequency / shaft).round();
        if (1.0..=SHAFT_ORDERS).contains(&order)
            && (frequency - order * shaft).abs() <= step + 7e-4 * frequency
        {
            return Explanation::Shaft(order as usize);
        }
        match rivals.iter().find(|r| r.explains(frequency, step)) {
            Some(r) if r.kind == RivalKind::Shaft => Explanation::Shaft(order as usize),
            Some(r) if r.kind == RivalKind::Mains => Explanation::Mains,
            Some(r) => Explanation::Periodic(r.rate),
            None if spectrum.known.is_beat(frequency) => Explanation::Beat,
            None => Explanation::Unexplained,
        }
    };
    let listed = spectrum.peaks.iter().filter(|p| p.amplitude >= LISTED * highest);
    listed
        .map(|p| StrongLine {
            frequency: p.frequency,
            amplitude: p.amplitude,
            level_db: decibel(p.amplitude, p.background),
            explanation: explain(p.frequency),
        })
        .collect()
}
