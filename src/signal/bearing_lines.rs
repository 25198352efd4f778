//! Lines of a bearing in an envelope spectrum: level over background, significance, and what is damaged.

use std::f64::consts::LN_2;

use super::SignalError;
use super::error::{check, check_record, check_same_length};
use super::jerk::median;
use super::ridge::interpolate_peak;
use super::spectrum::{Spectrum, decibel};

/// Bins on either side of an expected place in which its peak is sought, and that belong to a line once found.
const REACH: usize = 2;
/// Turns of the shaft and of the cage by which a line of the strongest family may be displaced and still be its own.
const SHAFT_TURNS: i32 = 6;
const CAGE_TURNS: i32 = 3;
/// Highest multiple of the shaft's speed whose line is no bearing's.
const SHAFT_HARMONICS: usize = 100;

/// Rates at which a bearing's parts meet, at one shaft speed \[Hz\].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BearingRates {
    /// Shaft speed.
    pub shaft: f64,
    /// FTF, the cage's turns.
    pub cage: f64,
    /// BPFO, balls past a point of the outer race.
    pub outer: f64,
    /// BPFI, balls past a point of the inner race.
    pub inner: f64,
    /// BSF, turns of a ball; a place on it strikes a race twice a turn, so that lines are at 2 BSF.
    pub ball: f64,
}

/// The damaged part.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BearingPart {
    OuterRace,
    InnerRace,
    Ball,
    Cage,
}

impl BearingPart {
    pub const ALL: [BearingPart; 4] =
        [BearingPart::OuterRace, BearingPart::InnerRace, BearingPart::Ball, BearingPart::Cage];

    /// "outer race", "inner race", "ball", "cage".
    pub fn name(self) -> &'static str {
        match self {
            BearingPart::OuterRace => "outer race",
            BearingPart::InnerRace => "inner race",
            BearingPart::Ball => "ball",
            BearingPart::Cage => "cage",
        }
    }

    /// Name of its line: BPFO, BPFI, 2 BSF, FTF.
    pub fn line_name(self) -> &'static str {
        match self {
            BearingPart::OuterRace => "BPFO",
            BearingPart::InnerRace => "BPFI",
            BearingPart::Ball => "2 BSF",
            BearingPart::Cage => "FTF",
        }
    }

    /// Rate of its impulses \[Hz\].
    pub fn rate(self, rates: &BearingRates) -> f64 {
        match self {
            BearingPart::OuterRace => rates.outer,
            BearingPart::InnerRace => rates.inner,
            BearingPart::Ball => 2.0 * rates.ball,
            BearingPart::Cage => rates.cage,
        }
    }
}

/// What a line is displaced by from its harmonic.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Modulation {
    /// ± times the shaft speed: the load zone seen from the inner race, unbalance.
    Shaft(i32),
    /// ± times the cage speed: the load zone seen from a ball.
    Cage(i32),
}

/// A place at which a bearing line is expected, and what is there.
#[derive(Clone, Debug, PartialEq)]
pub struct BearingLine {
    pub part: BearingPart,
    pub harmonic: usize,
    /// Side band, `None` for the harmonic itself.
    pub modulation: Option<Modulation>,
    /// Place by the rates given \[Hz\].
    pub expected: f64,
    /// Place of the peak \[Hz\].
    pub frequency: f64,
    pub amplitude: f64,
    /// Median amplitude round about.
    pub background: f64,
    /// Amplitude over background \[dB\].
    pub level_db: f64,
    /// Chance that noise alone gives as high a peak anywhere in the range of search.
    pub probability: f64,
    pub significant: bool,
    /// Whether the shaft or a stronger part of the bearing has a line at the same place, which then is not this part's.
    pub shared: bool,
}

/// One part's lines.
#[derive(Clone, Debug, PartialEq)]
pub struct LineFamily {
    pub part: BearingPart,
    /// Rate by the catalogue \[Hz\].
    pub expected: f64,
    /// Rate that fits the harmonics best \[Hz\].
    pub frequency: f64,
    /// Harmonics and side bands.
    pub lines: Vec<BearingLine>,
    /// Root of the sum of squares of the amplitudes of its significant harmonics that are its own.
    pub strength: f64,
    /// Whether its first or second harmonic is its own and significant.
    pub found: bool,
}

/// All lines of a bearing, the strongest family first, and what they say.
#[derive(Clone, Debug, PartialEq)]
pub struct BearingLines {
    pub families: Vec<LineFamily>,
    /// The part of the strongest family that was found; `None`: no bearing line.
    pub verdict: Option<BearingPart>,
}

impl BearingLines {
    /// "inner race", "outer race", "ball", "cage" or "no bearing line".
    pub fn verdict_name(&self) -> &'static str {
        self.verdict.map_or("no bearing line", BearingPart::name)
    }

    /// One part's lines.
    pub fn family(&self, part: BearingPart) -> &LineFamily {
        self.families.iter().find(|f| f.part == part).expect("there is a family for each part")
    }

    /// The highest of all harmonics that is its family's own; `None` when none stands out.
    pub fn strongest_line(&self) -> Option<&BearingLine> {
        let own = self.families.iter().flat_map(|f| &f.lines);
        own.filter(|l| l.modulation.is_none() && l.significant && !l.shared)
            .max_by(|a, b| a.amplitude.total_cmp(&b.amplitude))
    }
}

/// How bearing lines are sought.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LineSettings {
    /// Most that a rate may differ from the catalogue's, by slip and contact angle, relative.
    pub slip: f64,
    /// Number of harmonics.
    pub harmonics: usize,
    /// Side bands on each side of a harmonic.
    pub side_bands: usize,
    /// Probability of a false line below which a line counts as found.
    pub significance: f64,
}

impl Default for LineSettings {
    /// 1.5 %, five harmonics, one side band on each side, one false line in a million.
    fn default() -> Self {
        LineSettings { slip: 0.015, harmonics: 5, side_bands: 1, significance: 1e-6 }
    }
}

/// Finds the lines of a bearing in an amplitude spectrum of an envelope and says which part they come from.
///
/// For each part the rate within ± slip that fits its harmonics best, Σ_h ln(1 + A²/m²) largest; then the peak at each
/// harmonic h f and side band h f ± n f_s, h f ± n FTF. A line's level is over the median m of the amplitudes round about;
/// noise has A² exponential with mean m²/ln 2, so that a peak A over n bins has the probability 1 − (1 − 2^{−A²/m²})ⁿ.
/// The strongest family takes its harmonics with all side bands up to ± 6 f_s ± 3 FTF; a line that falls on those, or on a
/// multiple of the shaft speed, does not count for another part. `spectrum` to the highest harmonic of BPFI, eight bins per
/// FTF. Errors: NaN, rates that are not positive, a spectrum too short or too coarse, settings out of range.
pub fn bearing_lines(
    spectrum: &Spectrum,
    rates: &BearingRates,
    settings: &LineSettings,
) -> Result<BearingLines, SignalError> {
    let search = Search::new(spectrum, rates, settings)?;
    let mut open: Vec<LineFamily> = BearingPart::ALL.map(|part| search.family(part)).into();
    let mut families: Vec<LineFamily> = Vec::new();
    // The strongest takes its lines, the next strongest of what is left its own, and so on.
    while !open.is_empty() {
        for family in &mut open {
            search.settle(family, families.iter().filter(|f| f.found));
        }
        let strongest = (0..open.len())
            .max_by(|&a, &b| {
                let rank = |f: &LineFamily| (f.found, f.strength);
                let ((found_a, a), (found_b, b)) = (rank(&open[a]), rank(&open[b]));
                found_a.cmp(&found_b).then(a.total_cmp(&b))
            })
            .expect("a family is left");
        families.push(open.remove(strongest));
    }
    let verdict = families.first().filter(|f| f.found).map(|f| f.part);
    Ok(BearingLines { families, verdict })
}

/// Level of the best fitting part's harmonics over the background \[dB\]: the score of a band by the lines it shows.
///
/// 10 log₁₀ of the mean over the first `harmonics` of A²/m², the highest of the four parts. Arguments and errors as
/// [`bearing_lines`].
pub fn line_score(
    spectrum: &Spectrum,
    rates: &BearingRates,
    settings: &LineSettings,
) -> Result<f64, SignalError> {
    let search = Search::new(spectrum, rates, settings)?;
    let score = |part: BearingPart| {
        let base = search.base(part);
        let ratios = (1..=settings.harmonics).map(|h| {
            let (_, amplitude, background) = search.peak(h as f64 * base);
            (amplitude / background).powi(2)
        });
        10.0 * (ratios.sum::<f64>() / settings.harmonics as f64).log10()
    };
    Ok(BearingPart::ALL.map(score).into_iter().fold(f64::NEG_INFINITY, f64::max))
}

struct Search<'a> {
    spectrum: &'a Spectrum,
    rates: &'a BearingRates,
    settings: &'a LineSettings,
    /// Spacing of the bins \[Hz\].
    step: f64,
    /// Median amplitude about each bin.
    background: Vec<f64>,
}

impl<'a> Search<'a> {
    fn new(
        spectrum: &'a Spectrum,
        rates: &'a BearingRates,
        settings: &'a LineSettings,
    ) -> Result<Self, SignalError> {
        check_record("spectrum", &spectrum.values)?;
        check_same_length("frequencies", spectrum.frequencies.len(), "spectrum", spectrum.values.len())?;
        let BearingRates { shaft, cage, outer, inner, ball } = *rates;
        for (name, rate) in
            [("shaft speed", shaft), ("FTF", cage), ("BPFO", outer), ("BPFI", inner), ("BSF", ball)]
        {
            check(rate > 0.0 && rate.is_finite(), name, "a positive number of Hz", rate)?;
        }
        let LineSettings { slip, harmonics, significance, .. } = *settings;
        check((0.0..0.1).contains(&slip), "slip", "0 to below 0.1", slip)?;
        check((1..=50).contains(&harmonics), "number of harmonics", "1 to 50", harmonics as f64)?;
        check(significance > 0.0 && significance < 1.0, "significance", "between 0 and 1", significance)?;
        check(
            spectrum.values.len() > 16,
            "bins of the spectrum",
            "more than 16",
            spectrum.values.len() as f64,
        )?;
        let step = spectrum.frequencies[1] - spectrum.frequencies[0];
        check(step * 8.0 <= cage, "spacing of the spectrum's bins [Hz]", "an eighth of FTF or less", step)?;
        let highest = harmonics as f64 * inner.max(outer).max(2.0 * ball) * (1.0 + slip);
        let end = spectrum.frequencies[spectrum.frequencies.len() - 1];
        check(highest < end, "end of the spectrum [Hz]", "above the highest harmonic asked for", end)?;
        // Wide enough for a median that a few lines do not lift, narrow enough to follow the slope.
        let half_width = ((0.75 * shaft / step).round() as usize).max(24);
        let background = running_median(&spectrum.values, half_width);
        Ok(Search { spectrum, rates, settings, step, background })
    }

    /// The rate within ± slip that fits a part's harmonics best.
    fn base(&self, part: BearingPart) -> f64 {
        let expected = part.rate(self.rates);
        let LineSettings { slip, harmonics, .. } = *self.settings;
        // Half a bin of the highest harmonic from trial to trial.
        let trial_step = 0.5 * self.step / harmonics as f64;
        let trials = (slip * expected / trial_step).ceil() as i64;
        let fit = |trial: i64| {
            let base = expected + trial as f64 * trial_step;
            let ratio = |h: usize| {
                let place = h as f64 * base / self.step;
                let bin = (place as usize).min(self.spectrum.values.len() - 2);
                let part = place - bin as f64;
                let amplitude =
                    (1.0 - part) * self.spectrum.values[bin] + part * self.spectrum.values[bin + 1];
                (1.0 + (amplitude / self.background[bin]).powi(2)).ln()
            };
            (1..=harmonics).map(ratio).sum::<f64>()
        };
        let (_, best) = (-trials..=trials)
            .map(|trial| (fit(trial), trial))
            // Of equal fits the one nearest to the catalogue.
            .max_by(|a, b| a.0.total_cmp(&b.0).then(b.1.abs().cmp(&a.1.abs())))
            .expect("there is a trial at the catalogue's rate");
        expected + best as f64 * trial_step
    }

    /// Place, amplitude and background of the highest bin near a frequency.
    fn peak(&self, frequency: f64) -> (f64, f64, f64) {
        let values = &self.spectrum.values;
        let middle = (frequency / self.step).round() as usize;
        let first = middle.saturating_sub(REACH).max(1).min(values.len() - 1);
        let bins = first..(middle + REACH + 1).clamp(first + 1, values.len());
        let bin = bins.max_by(|&a, &b| values[a].total_cmp(&values[b])).expect("the range holds a bin");
        let peak = interpolate_peak(&self.spectrum.frequencies, values, bin);
        (peak.position, peak.amplitude, self.background[bin])
    }

    fn family(&self, part: BearingPart) -> LineFamily {
        let base = self.base(part);
        let expected = part.rate(self.rates);
        let mut lines = Vec::new();
        let end = self.spectrum.frequencies[self.spectrum.frequencies.len() - 1];
        for harmonic in 1..=self.settings.harmonics {
            let mut modulations = vec![None];
            for n in 1..=self.settings.side_bands as i32 {
                if matches!(part, BearingPart::OuterRace | BearingPart::InnerRace) {
                    modulations.extend([Some(Modulation::Shaft(-n)), Some(Modulation::Shaft(n))]);
                }
                if part != BearingPart::Cage {
                    modulations.extend([Some(Modulation::Cage(-n)), Some(Modulation::Cage(n))]);
                }
            }
            for modulation in modulations {
                let shift = match modulation {
                    None => 0.0,
                    Some(Modulation::Shaft(n)) => f64::from(n) * self.rates.shaft,
                    Some(Modulation::Cage(n)) => f64::from(n) * self.rates.cage,
                };
                let place = harmonic as f64 * base + shift;
                if place <= self.step * REACH as f64 || place >= end {
                    continue;
                }
                let (frequency, amplitude, background) = self.peak(place);
                let ratio = amplitude / background;
                // The range that the choice of the base has searched through at this harmonic.
                let range = 2.0 * self.settings.slip * harmonic as f64 * expected / self.step;
                let bins = range + (2 * REACH + 1) as f64;
                let probability = chance_of_peak(ratio, bins);
                lines.push(BearingLine {
                    part,
                    harmonic,
                    modulation,
                    expected: harmonic as f64 * expected + shift,
                    frequency,
                    amplitude,
                    background,
                    level_db: decibel(amplitude, background),
                    probability,
                    significant: probability < self.settings.significance,
                    shared: false,
                });
            }
        }
        LineFamily { part, expected, frequency: base, lines, strength: 0.0, found: false }
    }

    /// Marks the lines that belong to the shaft or to a family already settled, and sums up the others.
    fn settle<'f>(&self, family: &mut LineFamily, settled: impl Iterator<Item = &'f LineFamily> + Clone) {
        for line in &mut family.lines {
            line.shared =
                self.is_of_shaft(line.frequency) || settled.clone().any(|f| self.is_of(f, line.frequency));
        }
        let own = family.lines.iter().filter(|l| l.modulation.is_none() && l.significant && !l.shared);
        family.strength = own.clone().map(|l| l.amplitude * l.amplitude).sum::<f64>().sqrt();
        family.found = own.clone().any(|l| l.harmonic <= 2);
    }

    /// Whether a line is a multiple of the shaft speed, which may be stated 0.1 % wrong.
    fn is_of_shaft(&self, frequency: f64) -> bool {
        let multiple = (frequency / self.rates.shaft).round();
        let tolerance = 1.5 * self.step + 1e-3 * frequency;
        multiple >= 1.0
            && multiple <= SHAFT_HARMONICS as f64
            && (frequency - multiple * self.rates.shaft).abs() < tolerance
    }

    /// Whether a line is a harmonic of another family or one of its side bands.
    fn is_of(&self, family: &LineFamily, frequency: f64) -> bool {
        let tolerance = 1.5 * self.step + 2e-4 * frequency;
        let harmonics = 1..=2 * self.settings.harmonics as i32;
        harmonics.flat_map(|h| (-SHAFT_TURNS..=SHAFT_TURNS).map(move |m| (h, m))).any(|(h, m)| {
            (-CAGE_TURNS..=CAGE_TURNS).any(|c| {
                // Side bands of both kinds at once are too weak to be taken for lines of another part.
                let place = f64::from(h) * family.frequency
                    + f64::from(m) * self.rates.shaft
                    + f64::from(c) * self.rates.cage;
                (m == 0 || c == 0) && (frequency - place).abs() < tolerance
            })
        })
    }
}

/// Chance that the highest of `bins` of noise stands a `ratio` over the median or higher, 1 − (1 − 2^{−r²})ⁿ.
fn chance_of_peak(ratio: f64, bins: f64) -> f64 {
    let one = (-LN_2 * ratio * ratio).exp();
    -(bins * (-one).ln_1p()).exp_m1()
}

/// Median over ± `half_width` bins about each bin, over as many as there are at the ends; the bin at 0 is left out.
///
/// A median of zero, in a spectrum that is mostly empty, counts as the rounding of the largest value.
fn running_median(values: &[f64], half_width: usize) -> Vec<f64> {
    let largest = values.iter().copied().fold(0.0, f64::max);
    let floor = (f64::EPSILON * largest).max(f64::MIN_POSITIVE);
    // One median per eighth of a width serves the bins about its middle.
    let stride = (half_width / 8).max(1);
    let at = |middle: usize| {
        let range = middle.saturating_sub(half_width).max(1)..(middle + half_width + 1).min(values.len());
        median(values[range].to_vec()).max(floor)
    };
    let mut out = vec![0.0; values.len()];
    for (chunk, part) in out.chunks_mut(stride).enumerate() {
        part.fill(at((chunk * stride + stride / 2).min(values.len() - 1)));
    }
    out
}
