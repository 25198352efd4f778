//! Family of one bearing part fitted to an envelope spectrum: rate within the slip, lines and side bands.

use super::super::bearing_lines::{BearingPart, DefectFrequencies, LineSettings, Modulation};
use super::line_spectrum::LineSpectrum;

/// Harmonics of a family; those of the cage are more, because FTF is low.
const HARMONICS: usize = 5;
const CAGE_HARMONICS: usize = 12;
/// Evidence of one line that counts fully in the fit of the rate: no line alone decides it. More counts by its
/// logarithm, so that the top of a line is preferred to its skirts.
const FIT_LIMIT: f64 = 60.0;
const FIT_EXCESS: f64 = 10.0;
/// Evidence that noise reaches at one place (highest of two bins over four widths): not counted.
const NOISE_EVIDENCE: f64 = 4.0;
/// Evidence from which a line of a family at a known place counts as present.
pub(super) const PRESENT: f64 = 7.0;

/// Harmonics of FTF among the first eight that make a cage: a ball's load modulation gives up to five.
const COMB: usize = 6;

/// A line of a fitted family.
#[derive(Clone, Copy, Debug)]
pub(super) struct FittedLine {
    pub harmonic: usize,
    pub modulation: Option<Modulation>,
    pub frequency: f64,
    pub amplitude: f64,
    /// Evidence above that of noise.
    pub evidence: f64,
    /// Whether nothing else explains the line.
    pub own: bool,
}

impl FittedLine {
    /// Whether it counts as present.
    pub fn stands(&self) -> bool {
        self.evidence + NOISE_EVIDENCE > PRESENT
    }
}

/// A part's family at the rate that fits best.
#[derive(Clone, Debug)]
pub(super) struct PartFit {
    pub part: BearingPart,
    /// Fitted defect frequency.
    pub base: f64,
    /// Fitted FTF (balls), else the nominal.
    pub cage: f64,
    pub lines: Vec<FittedLine>,
}

/// Offsets of the side bands that a part's load modulation gives.
fn side_bands(part: BearingPart) -> &'static [Modulation] {
    use Modulation::{Cage, Shaft};
    match part {
        BearingPart::InnerRace => &[Shaft(-2), Shaft(-1), Shaft(1), Shaft(2)],
        BearingPart::Ball => &[Cage(-2), Cage(-1), Cage(1), Cage(2)],
        BearingPart::OuterRace | BearingPart::Cage => &[],
    }
}

/// Distance of a side band from its harmonic.
pub(super) fn offset(modulation: Modulation, shaft: f64, cage: f64) -> f64 {
    match modulation {
        Modulation::Shaft(n) => f64::from(n) * shaft,
        Modulation::Cage(n) => f64::from(n) * cage,
    }
}

impl PartFit {
    /// Fits the rate within ± slip; for balls FTF within ± slip and a bin as well.
    pub fn new(
        spectrum: &LineSpectrum,
        part: BearingPart,
        rates: &DefectFrequencies,
        settings: &LineSettings,
    ) -> Self {
        let expected = part.defect_frequency(rates);
        let harmonics = harmonics(part, spectrum, expected);
        let trial_step = spectrum.step / harmonics as f64;
        let trials = ((settings.slip * expected + 0.5 * spectrum.step) / trial_step).ceil() as i64;
        let cage_trials = match part {
            BearingPart::Ball => {
                ((settings.slip * rates.cage + 0.5 * spectrum.step) / spectrum.step).ceil() as i64
            }
            _ => 0,
        };
        let side = side_bands(part);
        // FTF is so low that shaft and mains cover much of its comb; lines of the others stand clear of them.
        let at = |place: f64| match part {
            BearingPart::Cage => spectrum.evidence(place),
            _ => spectrum.foreign_evidence(place),
        };
        let fit = |base: f64, cage: f64| {
            let mut total = 0.0;
            for h in 1..=harmonics {
                let main = limited(at(h as f64 * base));
                total += main;
                for modulation in side {
                    let place = h as f64 * base + offset(*modulation, rates.shaft, cage);
                    // A load modulation is never stronger than what it modulates.
                    total += 0.5 * (at(place).min(main) - NOISE_EVIDENCE).max(0.0);
                }
            }
            if part == BearingPart::Ball {
                total += (1..=2).map(|n| 0.5 * limited(at(f64::from(n) * cage))).sum::<f64>();
            }
            total
        };
        let mut best = (f64::NEG_INFINITY, expected, rates.cage);
        // From the nominal rate outwards: of equal fits the nearest to it stays.
        for trial in (0..=trials).flat_map(|t| [t, -t]) {
            let base = expected + trial as f64 * trial_step;
            for cage_trial in -cage_trials..=cage_trials {
                let cage = rates.cage + cage_trial as f64 * spectrum.step;
                let value = fit(base, cage);
                if value > best.0 {
                    best = (value, base, cage);
                }
            }
        }
        let (_, base, cage) = best;
        let lines = (1..=harmonics)
            .flat_map(|harmonic| {
                let modulations = std::iter::once(None).chain(side.iter().map(|m| Some(*m)));
                modulations.filter_map(move |modulation| {
                    let shift = modulation.map_or(0.0, |m| offset(m, rates.shaft, cage));
                    let place = harmonic as f64 * base + shift;
                    let (frequency, amplitude) =
                        spectrum.highest(place, 1.05 * spectrum.step + 5e-4 * place)?;
                    let limit =
                        modulation.map_or(f64::INFINITY, |_| spectrum.evidence(harmonic as f64 * base));
                    let evidence = (spectrum.evidence(place).min(limit) - NOISE_EVIDENCE).max(0.0);
                    Some(FittedLine { harmonic, modulation, frequency, amplitude, evidence, own: true })
                })
            })
            .collect();
        PartFit { part, base, cage, lines }
    }

    /// Whether a frequency is a line of the family, with the side bands that its kind may have.
    ///
    /// Outer race ± 4 f_r (unbalance, misalignment), inner race ± 6 f_r, both ± 2 FTF (unequal balls), ball ± 5 FTF,
    /// ± 2 f_r. The ball's family has FTF itself, which
    /// its load modulation gives, and odd multiples of BSF, which unequal impacts on the two races give.
    pub fn explains(&self, frequency: f64, shaft: f64, step: f64) -> bool {
        let near = self.tolerance(frequency, step);
        let (base, side, count) = match self.part {
            BearingPart::OuterRace => (self.base, shaft, 4),
            BearingPart::InnerRace => (self.base, shaft, 6),
            BearingPart::Ball => (0.5 * self.base, self.cage, 5),
            BearingPart::Cage => return near_multiple(frequency, self.base, 40, near),
        };
        if self.part == BearingPart::Ball && near_multiple(frequency, self.cage, 6, near) {
            return true;
        }
        let carries = |offset: f64| near_multiple(frequency - offset, base, 3 * HARMONICS, near);
        let other = if self.part == BearingPart::Ball { shaft } else { self.cage };
        let by_other = |n: i32| carries(f64::from(n) * other);
        (-count..=count).any(|n| carries(f64::from(n) * side)) || (-2..=2).any(by_other)
    }

    /// Half-width of its lines: resolution, and slip from impact to impact, which widens harmonic h with h².
    fn tolerance(&self, frequency: f64, step: f64) -> f64 {
        1.5 * step + (1.5e-3 + 5e-4 * frequency / self.base) * frequency
    }

    /// Whether a frequency is one of its harmonics, side bands aside.
    pub fn has_harmonic(&self, frequency: f64, step: f64) -> bool {
        near_multiple(frequency, self.base, 3 * HARMONICS, self.tolerance(frequency, step) + 1e-3 * frequency)
    }

    /// Whether a frequency is one of its harmonics ± 1 or 2 f_r.
    pub fn has_shaft_side_band(&self, frequency: f64, shaft: f64, step: f64) -> bool {
        let near = self.tolerance(frequency, step);
        [-2.0, -1.0, 1.0, 2.0]
            .iter()
            .any(|n| near_multiple(frequency - n * shaft, self.base, HARMONICS, near))
    }

    /// Evidence of the lines that nothing else explains; 0 without one of the first two harmonics.
    pub fn own_evidence(&self) -> f64 {
        let first = self.main_lines().any(|l| l.own && l.harmonic <= 2 && l.stands());
        let stands = |l: &&FittedLine| l.own && l.modulation.is_some() && l.stands();
        if first || self.lines.iter().filter(stands).count() >= 3 {
            self.lines.iter().filter(|l| l.own).map(|l| l.evidence).sum()
        } else {
            0.0
        }
    }

    pub fn evidence(&self) -> f64 {
        self.lines.iter().map(|l| l.evidence).sum()
    }

    /// Whether most of its first eight harmonics stand, as those of a cage do.
    pub fn is_comb(&self) -> bool {
        self.main_lines().filter(|l| l.harmonic <= 8 && l.evidence > PRESENT).count() >= COMB
    }

    pub fn main_lines(&self) -> impl Iterator<Item = &FittedLine> {
        self.lines.iter().filter(|l| l.modulation.is_none())
    }

    /// Amplitude of its highest line that nothing else explains.
    pub fn own_amplitude(&self) -> f64 {
        let own = self.lines.iter().filter(|l| l.own && l.evidence > 0.0);
        own.map(|l| l.amplitude).fold(0.0, f64::max)
    }
}

/// Evidence that counts in the fit of the rate.
fn limited(evidence: f64) -> f64 {
    if evidence <= FIT_LIMIT { evidence } else { FIT_LIMIT + FIT_EXCESS * (evidence / FIT_LIMIT).ln() }
}

/// Harmonics inside the spectrum.
fn harmonics(part: BearingPart, spectrum: &LineSpectrum, expected: f64) -> usize {
    let wanted = if part == BearingPart::Cage { CAGE_HARMONICS } else { HARMONICS };
    wanted.min((spectrum.end() / (1.03 * expected)) as usize).max(1)
}

/// Whether `frequency` is within `near` of one of the first `count` multiples of `base`.
fn near_multiple(frequency: f64, base: f64, count: usize, near: f64) -> bool {
    let number = (frequency / base).round();
    number >= 1.0 && number <= count as f64 && (frequency - number * base).abs() <= near
}
