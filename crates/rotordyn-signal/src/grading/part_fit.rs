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

/// Evidence of one line that counts fully in the measured rate.
const RATE_EVIDENCE: f64 = 12.0;
/// Bins between a fitted place and the top of its line, and bins by which a top may be off.
const TOP_REACH: usize = 2;
const TOP_ERROR: f64 = 0.5;
/// The same of a clear line, to which noise adds by the root of its evidence; share of a rate times 1 + h by which
/// wander moves what harmonic h says.
const SHARP_ERROR: f64 = 0.15;
const INCONSISTENT: f64 = 2e-3;
/// Bins beyond the slip in which a line is looked for that may be taken for the first harmonic.
const BESIDE: f64 = 3.0;
/// Relative error of a mean rate whose intervals jitter by 2 %, over two hundred of them.
const RATE_WANDER: f64 = 1.5e-3;

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

    /// How far off the rate is that the top of this harmonic says: noise moves it the less the more the line stands.
    fn rate_error(&self, step: f64) -> f64 {
        step * (SHARP_ERROR + self.evidence.sqrt().recip()) / self.harmonic as f64
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
    /// Whether its lines are at a rate that slip does not explain: those of another source.
    pub is_foreign: bool,
    /// Whether the lines beside its harmonics are not at the distance of FTF.
    pub without_cage: bool,
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
        let lines: Vec<FittedLine> = (1..=harmonics)
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
        let mut fit = PartFit { part, base, cage, lines, is_foreign: false, without_cage: false };
        fit.is_foreign = fit.is_beyond_slip(spectrum, rates, settings.slip)
            || part == BearingPart::Cage && fit.has_inconsistent_first_lines(spectrum);
        fit
    }

    /// Counts nothing beside its harmonics: what stands there is not at the distance of FTF.
    pub fn leave_cage(&mut self, rates: &DefectFrequencies) {
        self.without_cage = true;
        self.cage = rates.cage;
        self.lines.iter_mut().filter(|l| l.modulation.is_some()).for_each(|l| l.evidence = 0.0);
    }

    /// Whether the first two of its harmonics, those that stand, each say another rate than most of its lines do.
    ///
    /// For the cage: where a bin is some percent of the rate, lines of several origins fit one comb.
    fn has_inconsistent_first_lines(&self, spectrum: &LineSpectrum) -> bool {
        let Some(rate) = weighted_median(self.measured_rates(spectrum)) else { return false };
        self.first_lines_all(spectrum, |measured, line| {
            let allowed = line.rate_error(spectrum.step) + INCONSISTENT * (1.0 + line.harmonic as f64) * rate;
            (measured - rate).abs() > allowed
        })
    }

    /// Whether the highest line near its rate is beyond the slip.
    ///
    /// Of a cage beside a ball, whose lines may be near higher multiples of FTF: what modulates them then is no cage.
    pub fn is_beside_foreign_line(
        &self,
        spectrum: &LineSpectrum,
        rates: &DefectFrequencies,
        slip: f64,
    ) -> bool {
        let expected = self.part.defect_frequency(rates);
        let step = spectrum.step;
        let Some((near, _)) = spectrum.highest(expected, slip * expected + BESIDE * step) else {
            return false;
        };
        let evidence = spectrum.evidence(near) - NOISE_EVIDENCE;
        let Some(top) = spectrum.top_near(near, 1).filter(|_| evidence > PRESENT) else { return false };
        let allowed = (slip + RATE_WANDER) * expected + step * (SHARP_ERROR + evidence.sqrt().recip());
        (top - expected).abs() > allowed && !spectrum.known.contains(near)
    }

    /// Whether what the first two harmonics that stand say of the rate is so of each; not without any.
    fn first_lines_all(&self, spectrum: &LineSpectrum, is_so: impl Fn(f64, &FittedLine) -> bool) -> bool {
        let first: Vec<&FittedLine> = self.standing(spectrum).filter(|l| l.harmonic <= 2).collect();
        let so = |l: &&FittedLine| {
            let order = l.harmonic as f64;
            let top = spectrum.top_near(order * self.base, TOP_REACH);
            top.is_some_and(|top| is_so(top / order, l))
        };
        !first.is_empty() && first.iter().all(so)
    }

    /// Rates that the tops of its standing harmonics say, with their weights.
    fn measured_rates(&self, spectrum: &LineSpectrum) -> Vec<(f64, f64)> {
        let rate = |l: &FittedLine| {
            let order = l.harmonic as f64;
            let top = spectrum.top_near(order * self.base, TOP_REACH)?;
            Some((top / order, l.evidence.min(RATE_EVIDENCE)))
        };
        self.standing(spectrum).filter_map(rate).collect()
    }

    /// Its standing harmonics that are none of shaft or mains.
    fn standing<'a>(&'a self, spectrum: &'a LineSpectrum) -> impl Iterator<Item = &'a FittedLine> {
        let main = self.main_lines().filter(|l| l.evidence > PRESENT);
        main.filter(|l| spectrum.known.origin(l.frequency).is_none())
    }

    /// Whether the rate that its lines show is farther from the expected one than slip, and what their highest harmonic
    /// resolves, explain.
    ///
    /// The search goes half a bin beyond the slip, which is much of a slow rate: FTF over 4 s is known to 1 % by its first
    /// harmonic and to 0.1 % by the twelfth.
    fn is_beyond_slip(&self, spectrum: &LineSpectrum, rates: &DefectFrequencies, slip: f64) -> bool {
        let expected = self.part.defect_frequency(rates);
        let Some(measured) = weighted_median(self.measured_rates(spectrum)) else { return false };
        let highest = self.standing(spectrum).map(|l| l.harmonic).max().unwrap_or(1) as f64;
        let allowed = (slip + RATE_WANDER) * expected + TOP_ERROR * spectrum.step / highest;
        (measured - expected).abs() > allowed
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
        let carries = |offset: f64| near_multiple(frequency - offset, base, 3 * HARMONICS, near);
        if self.without_cage {
            return carries(0.0);
        }
        if self.part == BearingPart::Ball && near_multiple(frequency, self.cage, 6, near) {
            return true;
        }
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

/// The value that half of the weight lies on either side of; `None` of none.
fn weighted_median(mut values: Vec<(f64, f64)>) -> Option<f64> {
    values.sort_by(|a, b| a.0.total_cmp(&b.0));
    let half = 0.5 * values.iter().map(|(_, weight)| weight).sum::<f64>();
    let mut sum = 0.0;
    values
        .into_iter()
        .find(|(_, weight)| {
            sum += weight;
            sum >= half
        })
        .map(|(value, _)| value)
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
