//! Contest of the bearing parts with each other and with their rivals in one envelope spectrum.

use super::super::bearing_lines::{BearingPart, DefectFrequencies, LineSettings};
use super::features::{Contenders, features};
use super::grade::{FEATURES, Features};
use super::line_spectrum::{KnownLines, LinePeak, LineSpectrum};
use super::part_fit::{FittedLine, PRESENT, PartFit};
use super::rivals::{Rival, find_rivals};

/// Amplitude ratio from which a neighbouring line dominates another on its skirt.
const DOMINANT: f64 = 3.0;
/// Evidence of a ball's lines from which FTF counts as its modulation.
const BALL_EVIDENCE: f64 = 12.0;
/// Share of its evidence that a ball without any side band keeps in the contest: its impacts pass the load zone.
const WITHOUT_SIDE_BANDS: f64 = 0.5;

/// Rank that a cage without further harmonics loses among the bands.
const CAGE_WITHOUT_HARMONICS: f64 = 3.0;
/// Harmonics of FTF among the first eight that make a cage: a ball's load modulation gives up to five.
const CAGE_HARMONICS: usize = 6;
/// Evidence of a line that calls for an explanation.
const COINCIDENCE_EVIDENCE: f64 = 30.0;

/// ln(1 + evidence) above which bands do not differ.
const MOST: f64 = 12.0;

/// What one envelope spectrum says: the best part, what competes with it.
pub(super) struct Contest {
    pub winner: PartFit,
    /// Rivals of the winner: families among the lines that are not its own.
    pub rivals: Vec<Rival>,
    pub features: Features,
    /// Rank of the band: evidence, less if stronger lines remain unexplained.
    pub score: f64,
    /// A part whose line coincides with one of shaft or mains, and its frequency.
    pub unresolved: Option<(BearingPart, f64, Rival)>,
}

/// Compares the parts in a spectrum; `hz_per_unit` is the frequency unit \[Hz\], `None` for orders.
pub(super) fn contest(
    spectrum: &LineSpectrum,
    rates: &DefectFrequencies,
    settings: &LineSettings,
    hz_per_unit: Option<f64>,
) -> Contest {
    let step = spectrum.step;
    let known = KnownLines { shaft: rates.shaft, hz_per_unit, step };
    let mut fits = BearingPart::ALL.map(|part| PartFit::new(spectrum, part, rates, settings));
    let cage = fits[BearingPart::Cage as usize].clone();
    let rivals: Vec<Vec<Rival>> = fits
        .iter_mut()
        .map(|fit| {
            let rivals = rivals_of(fit, spectrum, rates, hz_per_unit);
            let owns: Vec<bool> = fit
                .lines
                .iter()
                .map(|line| {
                    !rivals.iter().any(|r| {
                        r.claims(line.frequency, line.amplitude, spectrum, |f| {
                            fit.explains(f, rates.shaft, step)
                        })
                    }) && !is_dominated(fit, line, spectrum, rates)
                        && !is_cage_harmonic(fit, line, &cage, spectrum, rates.shaft)
                        && (fit.part == BearingPart::Cage || !known.contains(line.frequency))
                })
                .collect();
            fit.lines.iter_mut().zip(owns).for_each(|(line, own)| line.own = own);
            rivals
        })
        .collect();
    let own = fits.each_ref().map(|fit| fit.own_evidence());
    let ball = own[BearingPart::Ball as usize];
    let strength = fits.each_ref().map(|fit| match fit.part {
        // FTF is the modulation of the ball's impacts: it counts for the ball, not against it.
        BearingPart::Ball if ball > BALL_EVIDENCE && side_bands(fit, 4) > 0 => {
            ball + own[BearingPart::Cage as usize]
        }
        BearingPart::Ball => WITHOUT_SIDE_BANDS * ball,
        part => own[part as usize],
    });
    let best = (0..fits.len()).max_by(|&a, &b| strength[a].total_cmp(&strength[b])).unwrap_or(0);
    let others = || (0..fits.len()).filter(|k| *k != best);
    let runner_up = others()
        .map(|k| match fits[best].part {
            // Every line near a multiple of FTF could be the cage's.
            BearingPart::Cage => own[k],
            _ => {
                let own = fits[k].lines.iter().filter(|l| l.own);
                let left = own.filter(|l| !fits[best].explains(l.frequency, rates.shaft, step));
                left.map(|l| l.evidence).sum::<f64>()
            }
        })
        .fold(0.0, f64::max);
    let ambiguity =
        others().filter(|k| fits[*k].part != BearingPart::Cage).map(|k| own[k]).fold(0.0, f64::max);
    let unresolved = unresolved(spectrum, rates, settings, &known);
    let cage_evidence = own[BearingPart::Cage as usize];
    let contenders =
        Contenders { best: &fits[best], rivals: &rivals[best], runner_up, ambiguity, cage_evidence };
    let features = features(&contenders, spectrum, &known);
    // FTF alone is in every band that a ball's impacts reach: a cage is to show its many harmonics.
    let few = match fits[best].part {
        BearingPart::Cage => CAGE_WITHOUT_HARMONICS * (1.0 - features[FEATURES.standing]),
        _ => 0.0,
    };
    let score = own[best].ln_1p().min(MOST) - (3.0 * features[FEATURES.unexplained] - 3.0).max(0.0) - few;
    let (winner, rivals) = (fits[best].clone(), rivals[best].clone());
    Contest { winner, rivals, features, score, unresolved }
}

/// Families that the peaks beside a part's own lines support.
fn rivals_of(
    fit: &PartFit,
    spectrum: &LineSpectrum,
    rates: &DefectFrequencies,
    hz_per_unit: Option<f64>,
) -> Vec<Rival> {
    let step = spectrum.step;
    // Without evidence there is nothing to contest.
    if fit.evidence() < PRESENT {
        return Vec::new();
    }
    let others: Vec<LinePeak> =
        spectrum.peaks.iter().filter(|p| !fit.explains(p.frequency, rates.shaft, step)).copied().collect();
    // The part's own rate, found again by lines of its family that wandered, is no rival.
    let excluded = |rate: f64| {
        fit.has_harmonic(rate, step) || fit.part == BearingPart::Ball && (rate / fit.cage - 1.0).abs() < 0.006
    };
    find_rivals(&others, rates.shaft, hz_per_unit, step, excluded)
}

/// Whether a line lies on the skirt of a higher one that is not of its family.
fn is_dominated(
    fit: &PartFit,
    line: &FittedLine,
    spectrum: &LineSpectrum,
    rates: &DefectFrequencies,
) -> bool {
    let reach = (4.0 * spectrum.step).max(0.008 * line.frequency);
    spectrum.highest(line.frequency, reach).is_some_and(|(frequency, amplitude)| {
        amplitude > DOMINANT * line.amplitude && !fit.explains(frequency, rates.shaft, spectrum.step)
    })
}

/// Whether a line is harmonic k of FTF and FTF's harmonics about k/2, or most of the first eight, stand as well.
///
/// BPFO is Z FTF: in a cage's family it is one harmonic of many. A ball's load modulation gives the first few
/// multiples of FTF and side bands about 2 BSF, but none half-way between.
fn is_cage_harmonic(
    fit: &PartFit,
    line: &FittedLine,
    cage: &PartFit,
    spectrum: &LineSpectrum,
    shaft: f64,
) -> bool {
    if fit.part == BearingPart::Cage {
        return false;
    }
    let number = (line.frequency / cage.base).round();
    let near = 1.2 * spectrum.step + 3e-3 * line.frequency;
    if number < 4.0 || (line.frequency - number * cage.base).abs() > near {
        return false;
    }
    let first = cage.main_lines().filter(|l| l.harmonic <= 8 && l.evidence > PRESENT);
    if first.count() >= CAGE_HARMONICS && fit.part == BearingPart::Ball {
        return true;
    }
    let middle = (0.5 * number).round();
    let stands = |n: &f64| {
        let place = n * cage.base;
        let amplitude = spectrum.highest(place, 1.05 * spectrum.step).map_or(0.0, |(_, a)| a);
        // Side bands of another harmonic of the part are low near it.
        let near = fit.main_lines().filter(|l| (l.frequency - place).abs() < 2.5 * cage.base);
        let reference = near.map(|l| l.amplitude).fold(line.amplitude, f64::max);
        !fit.has_harmonic(place, spectrum.step)
            && !fit.has_shaft_side_band(place, shaft, spectrum.step)
            && spectrum.evidence(place) > PRESENT
            && amplitude > 0.4 * reference
    };
    [middle - 1.0, middle, middle + 1.0].iter().filter(|n| stands(n)).count() >= 2
}

/// Number of side bands of the first `harmonics` that stand and are the part's own.
fn side_bands(fit: &PartFit, harmonics: usize) -> usize {
    let side = fit.lines.iter().filter(|l| l.modulation.is_some() && l.harmonic <= harmonics);
    side.filter(|l| l.own && l.evidence > PRESENT).count()
}

/// A strong line in the window of a part's first harmonic that coincides with one of shaft or mains.
///
/// It stands out of its neighbours in that family, so that the family alone is no sufficient explanation.
fn unresolved(
    spectrum: &LineSpectrum,
    rates: &DefectFrequencies,
    settings: &LineSettings,
    known: &KnownLines,
) -> Option<(BearingPart, f64, Rival)> {
    let strongest = spectrum.peaks.first()?.amplitude;
    let coincidence = |part: BearingPart| {
        let expected = part.defect_frequency(rates);
        let (frequency, amplitude) = spectrum.highest(expected, settings.slip * expected + spectrum.step)?;
        let (kind, rate) = known.origin(frequency)?;
        let neighbouring = |sign: f64| {
            let place = frequency + sign * rate;
            spectrum.highest(place, 1.05 * spectrum.step).map_or(0.0, |(_, a)| a)
        };
        let stands_out = spectrum.evidence(frequency) > COINCIDENCE_EVIDENCE
            && amplitude > 0.3 * strongest
            && neighbouring(-1.0).max(neighbouring(1.0)) < amplitude / 1.5;
        let highest = (frequency / rate).round() as usize;
        let rival = Rival { kind, rate, highest, lines: 1, amplitude, log_odds: 0.0 };
        stands_out.then_some((part, frequency, rival))
    };
    let mut found = BearingPart::ALL.into_iter().filter_map(coincidence).collect::<Vec<_>>();
    found.sort_by(|a, b| b.2.amplitude.total_cmp(&a.2.amplitude));
    found.into_iter().next()
}
