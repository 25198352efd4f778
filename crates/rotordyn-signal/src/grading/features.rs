//! Features of the best family of a spectrum, from which its grade is computed.

use super::super::bearing_lines::BearingPart;
use super::grade::{FEATURES, Features};
use super::line_spectrum::{KnownLines, LineSpectrum};
use super::part_fit::{FittedLine, PRESENT, PartFit};
use super::rival_kind::RivalKind;
use super::rivals::Rival;

/// Evidence above noise from which a line stands fully.
const FULL: f64 = 12.0;
/// ln(1 + evidence) up to which more of it says that there is a family at all, and by how much above it is counted.
const CLEAR: f64 = 3.5;
const CLEAR_RANGE: f64 = 4.0;
/// ln of an unexplained line over the own from which it is comparable to it.
const COMPARABLE: f64 = -0.7;
/// Amplitude of a line between a part's harmonics, over the highest of these, that counts fully for a slower family.
const FRACTION_SHARE: f64 = 0.25;

/// Part of the frequency of a line on either side of it over which power is summed, and the least and most bins of it.
const ABOUT: f64 = 0.012;
const ABOUT_BINS: (usize, usize) = (2, 40);
/// Σ A² over the bins of a pure line behind a Hann window, over its highest A².
const PURE_LINE: f64 = 1.5;
/// ln of the power about a line over that of a pure one up to which slip may have widened it, and by how much above it
/// is counted.
const WIDENED: f64 = 1.0;
const SURROUNDINGS_RANGE: f64 = 2.0;

/// Mean of how fully lines stand up to which it says more.
const FIRST: f64 = 0.5;

/// Amplitude of a shaft order, over the part's highest line, that counts fully.
const ORDER_SHARE: f64 = 1.0 / 3.0;

/// The best part with its rivals, and what the other parts have.
pub(super) struct Contenders<'a> {
    pub best: &'a PartFit,
    pub rivals: &'a [Rival],
    /// Evidence of the next best part, without and with the lines that the best explains too.
    pub runner_up: f64,
    pub ambiguity: f64,
    /// Own evidence of the cage.
    pub cage_evidence: f64,
}

/// Mean of how fully lines stand that are distinct from those of shaft and mains, and the share of lines that are.
fn standing<'a>(lines: impl Iterator<Item = &'a FittedLine>, known: &KnownLines) -> (f64, f64) {
    let (mut sum, mut distinct, mut all) = (0.0, 0.0, 0.0);
    for line in lines {
        all += 1.0;
        if !known.contains(line.frequency) {
            distinct += 1.0;
            sum += if line.own { (line.evidence / FULL).min(1.0) } else { 0.0 };
        }
    }
    if distinct > 0.0 { (sum / distinct, distinct / all) } else { (0.0, 0.0) }
}

/// The quantities the grade depends on, see [`FEATURES`].
pub(super) fn features(of: &Contenders, spectrum: &LineSpectrum, known: &KnownLines) -> Features {
    let fit = of.best;
    let step = spectrum.step;
    let own = fit.own_evidence();
    let amplitude = fit.own_amplitude();
    let level = |a: f64| if amplitude > 0.0 { (a / amplitude).ln().clamp(-3.0, 3.0) } else { 3.0 };
    let unexplained = spectrum
        .peaks
        .iter()
        .find(|p| !fit.explains(p.frequency, known.shaft, step) && !known.contains(p.frequency));
    let unexplained = level(unexplained.map_or(0.0, |p| p.amplitude));
    let free = of.rivals.iter().filter(|r| r.kind == RivalKind::Periodic);
    let strongest_rival = free.map(|r| r.amplitude).fold(0.0, f64::max);
    // Impacts of the cage have many harmonics, a modulation at FTF few.
    let counted = if fit.part == BearingPart::Cage { 8 } else { 4 };
    let (harmonics, distinct) = standing(fit.main_lines().filter(|l| l.harmonic <= counted), known);
    let side = fit.lines.iter().filter(|l| l.modulation.is_some() && l.harmonic <= 2);
    let (side_bands, _) = standing(side, known);
    let first = fit.main_lines().find(|l| l.harmonic == 1).map_or(0.0, |l| l.amplitude);
    let highest = fit.main_lines().map(|l| l.amplitude).fold(f64::MIN_POSITIVE, f64::max);
    let evidence = own.ln_1p();
    let mut out = [0.0; FEATURES.count];
    out[FEATURES.constant] = 1.0;
    out[FEATURES.evidence] = evidence.min(CLEAR);
    out[FEATURES.unexplained] = (unexplained + 3.0) / 3.0;
    out[FEATURES.comparable] = (unexplained - COMPARABLE).max(0.0);
    out[FEATURES.rival] = (level(strongest_rival) + 3.0) / 3.0;
    out[FEATURES.shared] = if fit.evidence() > 0.0 { 1.0 - own / fit.evidence() } else { 1.0 };
    out[FEATURES.harmonics] = harmonics;
    out[FEATURES.distinct] = distinct;
    out[FEATURES.fundamental] = (first / highest).max(1e-9).ln().max(-3.0);
    out[FEATURES.side_bands] = side_bands;
    out[FEATURES.runner_up] = (of.runner_up.ln_1p() - evidence).clamp(-6.0, 2.0);
    out[FEATURES.ambiguity] = (of.ambiguity.ln_1p() - evidence).clamp(-6.0, 2.0);
    out[FEATURES.fraction] = fraction_evidence(fit, spectrum, known);
    let near_known = known.nearness(fit.base);
    out[FEATURES.near_known] = near_known;
    out[FEATURES.near_and_shared] = near_known * out[FEATURES.shared];
    let modulation = match fit.part {
        BearingPart::Ball => (of.cage_evidence / FULL).min(1.0),
        _ => 0.0,
    };
    out[FEATURES.modulation] = modulation;
    let clear = (evidence - CLEAR).clamp(0.0, CLEAR_RANGE);
    out[FEATURES.missing_side_bands] = match fit.part {
        BearingPart::InnerRace | BearingPart::Ball => clear * (1.0 - side_bands.max(modulation)),
        BearingPart::OuterRace | BearingPart::Cage => 0.0,
    };
    out[FEATURES.missing_harmonics] = clear * (1.0 - harmonics);
    out[FEATURES.shaft_orders] = shaft_orders(fit, spectrum, known);
    let stands = |l: &&FittedLine| l.harmonic <= counted && l.own && l.evidence > PRESENT;
    out[FEATURES.standing] = fit.main_lines().filter(stands).count() as f64 / counted as f64;
    out[FEATURES.surroundings] = surroundings(fit, spectrum);
    out[FEATURES.first_harmonics] = harmonics.min(FIRST);
    out[FEATURES.first_side_bands] = side_bands.min(FIRST);
    out
}

/// ln of Σ (A² − noise) over ± 1.2 % of the strongest own harmonic over 3/2 of its A², less 1, 0 to 2; 0 without one.
fn surroundings(fit: &PartFit, spectrum: &LineSpectrum) -> f64 {
    let own = fit.main_lines().filter(|l| l.own && l.stands());
    let Some(line) = own.max_by(|a, b| a.evidence.total_cmp(&b.evidence)) else { return 0.0 };
    let middle = (line.frequency / spectrum.step).round() as usize;
    let reach = ((ABOUT * line.frequency / spectrum.step) as usize).clamp(ABOUT_BINS.0, ABOUT_BINS.1);
    let bins = middle.saturating_sub(reach).max(1)..(middle + reach + 1).min(spectrum.amplitude.len());
    let power: f64 = bins.map(|k| spectrum.amplitude[k].powi(2) - spectrum.noise_power(k)).sum();
    let ratio = power / (PURE_LINE * line.amplitude.powi(2));
    (ratio.max(1.0).ln() - WIDENED).clamp(0.0, SURROUNDINGS_RANGE)
}

/// Mean of w² over shaft orders 4 to 16 that are no side bands of the part: a shaft's own impacts have them all.
///
/// w is the line's amplitude over a third of the part's highest, at most 1.
fn shaft_orders(fit: &PartFit, spectrum: &LineSpectrum, known: &KnownLines) -> f64 {
    let highest = ORDER_SHARE * fit.own_amplitude();
    let apart = |f: &f64| {
        let number = (f / fit.base).round().max(1.0);
        (f - number * fit.base).abs() > 2.5 * known.shaft
    };
    let orders = (4..=16).map(|n| f64::from(n) * known.shaft).filter(|f| apart(f) && *f < spectrum.end());
    let level = |f: f64| {
        let (_, amplitude) =
            spectrum.highest(f, 1.05 * spectrum.step).filter(|_| spectrum.evidence(f) > PRESENT)?;
        Some(if amplitude < highest { (amplitude / highest).powi(2) } else { 1.0 })
    };
    let levels: Vec<f64> = orders.map(|f| level(f).unwrap_or(0.0)).collect();
    if levels.is_empty() { 0.0 } else { levels.iter().sum::<f64>() / levels.len() as f64 }
}

/// Mean of w² ln(1 + evidence) at fractions j f/n of the defect frequency: a slower family has them, the bearing not.
///
/// w is the line's amplitude over a quarter of the part's highest, at most 1: harmonics of a slower family differ
/// little in height, while a record with little noise has weak lines of many origins everywhere.
fn fraction_evidence(fit: &PartFit, spectrum: &LineSpectrum, known: &KnownLines) -> f64 {
    let highest = FRACTION_SHARE * fit.own_amplitude();
    let relative = |f: f64| {
        let amplitude = spectrum.highest(f, 1.05 * spectrum.step).map_or(0.0, |(_, a)| a);
        if amplitude < highest { (amplitude / highest).powi(2) } else { 1.0 }
    };
    let mean = |n: usize| {
        let places = (1..2 * n).filter(|j| j % n != 0).map(|j| j as f64 * fit.base / n as f64);
        let own = |f: &f64| fit.explains(*f, known.shaft, spectrum.step) || known.contains(*f);
        let values: Vec<f64> = places
            .filter(|f| !own(f))
            .map(|f| relative(f) * (spectrum.evidence(f) - 1.0).max(0.0).ln_1p())
            .collect();
        if values.is_empty() { 0.0 } else { values.iter().sum::<f64>() / values.len() as f64 }
    };
    // Half of 2 BSF is BSF itself: unequal impacts on the two races.
    let from = if fit.part == BearingPart::Ball { 3 } else { 2 };
    (from..=6).map(mean).fold(0.0, f64::max)
}
