//! Contest of the bearing parts with each other and with their rivals in one envelope spectrum.

use super::super::bearing_lines::{BearingPart, DefectFrequencies, LineSettings};
use super::features::{Contenders, features};
use super::grade::{FEATURES, Features};
use super::line_spectrum::{KnownLines, LinePeak, LineSpectrum};
use super::part_fit::{FittedLine, PRESENT, PartFit};
use super::rival_kind::RivalKind;
use super::rivals::{Rival, find_rivals, fraction_of_shaft};

/// Amplitude ratio from which a neighbouring line dominates another on its skirt.
const DOMINANT: f64 = 3.0;
/// Evidence of a ball's lines from which FTF counts as its modulation.
const BALL_EVIDENCE: f64 = 12.0;
/// Share of its evidence that a ball without any side band keeps in the contest: its impacts pass the load zone.
const WITHOUT_SIDE_BANDS: f64 = 0.5;

/// Rank that a cage without further harmonics loses among the bands.
const CAGE_WITHOUT_HARMONICS: f64 = 3.0;
/// Evidence of a line that calls for an explanation.
const COINCIDENCE_EVIDENCE: f64 = 30.0;

/// Evidence of a harmonic of a ball, and its amplitude over that of a multiple of FTF below, that tell it from a cage.
const FULL_LINE: f64 = 12.0;
const RISE: f64 = 1.6;

/// Share of FTF within which a second family is that of the cage, whose speed wanders.
const CAGE_WANDER: f64 = 0.013;

/// Orders beside a line of an inner race that its side bands do not reach with its own height.
const MODULATED_ORDERS: f64 = 3.0;

/// ln(1 + evidence) above which bands do not differ.
const MOST: f64 = 12.0;

/// What one envelope spectrum says: the best part, what competes with it.
pub(super) struct Contest {
    pub winner: PartFit,
    /// The other parts.
    pub others: Vec<PartFit>,
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
    let known = &spectrum.known;
    let mut fits = BearingPart::ALL.map(|part| PartFit::new(spectrum, part, rates, settings));
    let cage = fits[BearingPart::Cage as usize].clone();
    let is_cage_foreign = cage.is_beside_foreign_line(spectrum, rates, settings.slip);
    if is_cage_foreign {
        // What stands near FTF is another rate, and so is what stands beside a ball's lines at its distance.
        fits[BearingPart::Ball as usize].leave_cage(rates);
    }
    let rises = rises_at_ball(&fits[BearingPart::Ball as usize], &cage, spectrum);
    let mut rivals: Vec<Vec<Rival>> = fits
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
                        && !(is_cage_harmonic(fit, line, &cage, spectrum, rates.shaft)
                            && !(rises && fit.part == BearingPart::Ball))
                        && (fit.part == BearingPart::Cage || !known.contains(line.frequency))
                })
                .collect();
            fit.lines.iter_mut().zip(owns).for_each(|(line, own)| line.own = own);
            rivals
        })
        .collect();
    let own = fits.each_ref().map(|fit| fit.own_evidence());
    let ball = own[BearingPart::Ball as usize];
    // Lines of a ball at higher multiples of FTF say another rate than FTF itself, which is its modulation all the same.
    let modulation = if is_cage_foreign { 0.0 } else { own[BearingPart::Cage as usize] };
    let strength = fits.each_ref().map(|fit| match fit.part {
        // FTF is the modulation of the ball's impacts: it counts for the ball, not against it.
        BearingPart::Ball if ball > BALL_EVIDENCE && side_bands(fit, 4) > 0 && (rises || !cage.is_comb()) => {
            ball + modulation
        }
        BearingPart::Ball => WITHOUT_SIDE_BANDS * ball,
        part => own[part as usize],
    });
    let best = (0..fits.len()).max_by(|&a, &b| strength[a].total_cmp(&strength[b])).unwrap_or(0);
    let count = fits.len();
    let others = || (0..count).filter(|k| *k != best);
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
    let unresolved = unresolved(spectrum, rates, settings, known);
    if fits[best].is_foreign {
        // It stood in the contest for its source, which others' lines may be of; none of its lines is the part's.
        fits[best].lines.iter_mut().for_each(|line| line.own = false);
        let free: Vec<LinePeak> = spectrum.free_peaks().copied().collect();
        rivals[best] = find_rivals(&free, rates.shaft, hz_per_unit, step, |_| false);
    }
    let contenders = Contenders {
        best: &fits[best],
        rivals: &rivals[best],
        runner_up,
        ambiguity,
        cage_evidence: modulation,
    };
    let features = features(&contenders, spectrum, known);
    // FTF alone is in every band that a ball's impacts reach: a cage is to show its many harmonics.
    let few = match fits[best].part {
        BearingPart::Cage => CAGE_WITHOUT_HARMONICS * (1.0 - features[FEATURES.standing]),
        _ => 0.0,
    };
    let score = own[best].ln_1p().min(MOST) - (3.0 * features[FEATURES.unexplained] - 3.0).max(0.0) - few;
    let (winner, rivals) = (fits[best].clone(), rivals[best].clone());
    let others = others().map(|k| fits[k].clone()).collect();
    Contest { winner, others, rivals, features, score, unresolved }
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
        spectrum.free_peaks().filter(|p| !fit.explains(p.frequency, rates.shaft, step)).copied().collect();
    // The part's own rate, found again by lines of its family that wandered, is no rival.
    let excluded = |rate: f64| {
        let near = |base: f64, reach: f64| (rate / base - 1.0).abs() < reach;
        fit.has_harmonic(rate, step)
            || fit.part == BearingPart::Ball && near(fit.cage, 0.006)
            || fit.part == BearingPart::Cage && near(fit.base, CAGE_WANDER)
    };
    let mut rivals = find_rivals(&others, rates.shaft, hz_per_unit, step, excluded);
    rivals.extend(fraction_of_shaft(fit.base, spectrum, rates.shaft));
    rivals
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
    if cage.is_comb() && fit.part == BearingPart::Ball {
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

/// Whether 2 BSF, and 4 BSF or 6 BSF, stand higher than a multiple of FTF below them: a ball's line among the lines of
/// its load modulation.
///
/// Where 2 BSF/FTF is nearly a whole number every line of a ball, h BSF ± k FTF, is near a multiple of FTF. Impacts at FTF
/// have lines that fall from one multiple to the next.
fn rises_at_ball(ball: &PartFit, cage: &PartFit, spectrum: &LineSpectrum) -> bool {
    let level = |place: f64| {
        let reach = 1.05 * spectrum.step + 3e-3 * place;
        spectrum.highest(place, reach).map_or(0.0, |(_, amplitude)| amplitude)
    };
    let rises = |h: f64| {
        let place = h * ball.base;
        let stands = spectrum.evidence(place) > FULL_LINE;
        let top = place / cage.base;
        // Half-way down to the harmonic before it.
        let below = ((top - 0.5 * top / h).ceil() as usize)..(top.round() as usize);
        let lowest = below.map(|n| level(n as f64 * cage.base)).fold(f64::INFINITY, f64::min);
        stands && lowest.is_finite() && level(place) > RISE * lowest
    };
    rises(1.0) && (rises(2.0) || rises(3.0))
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
        let level = |place: f64| spectrum.highest(place, 1.05 * spectrum.step).map_or(0.0, |(_, a)| a);
        let above = |place: f64, distance: f64| {
            let [before, after] = [-1.0, 1.0].map(|sign| level(place + sign * distance * rate));
            level(place) > 1.5 * before.max(after)
        };
        let highest = (frequency / rate).round() as usize;
        // The load modulates an inner race by the shaft: each of its harmonics is the middle of a few orders, and the
        // shaft's own are higher.
        let reach = ((highest / 2) as f64).min(MODULATED_ORDERS);
        let is_modulated = part == BearingPart::InnerRace
            && kind == RivalKind::Shaft
            && highest >= 4
            && amplitude > 0.1 * strongest
            && [1.0, 2.0].iter().all(|h| above(h * frequency, reach));
        let stands_out = spectrum.evidence(frequency) > COINCIDENCE_EVIDENCE
            && (amplitude > 0.3 * strongest && above(frequency, 1.0) || is_modulated);
        let rival = Rival { kind, rate, highest, lines: 1, amplitude, log_odds: 0.0 };
        stands_out.then_some((part, frequency, rival))
    };
    let mut found = BearingPart::ALL.into_iter().filter_map(coincidence).collect::<Vec<_>>();
    found.sort_by(|a, b| b.2.amplitude.total_cmp(&a.2.amplitude));
    found.into_iter().next()
}
