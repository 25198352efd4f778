//! Bearing defect frequencies (FTF, BPFO, BPFI, 2 BSF) in an envelope spectrum: level over background,
//! and significance.

use serde::{Deserialize, Serialize};
use std::f64::consts::LN_2;

use super::SignalError;
use super::background::running_median;
use super::error::{check, check_record, check_same_length};
use super::ridge::interpolate_peak;
use super::spectrum::{Spectrum, decibel};

/// Half-width of the peak search about an expected frequency in bins: the resolution.
const SEARCH_HALF_WIDTH: usize = 1;
/// Highest side band orders (shaft, cage) of the strongest family that are not attributed to another part.
const MAX_SHAFT_SIDE_BANDS: i32 = 6;
const MAX_CAGE_SIDE_BANDS: i32 = 3;
/// Highest shaft harmonic that is excluded from the bearing lines.
const MAX_SHAFT_HARMONIC: usize = 100;

/// Bearing defect frequencies (characteristic frequencies) at one shaft speed \[Hz\].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DefectFrequencies {
    /// Shaft speed.
    pub shaft: f64,
    /// FTF, fundamental train (cage) frequency.
    pub cage: f64,
    /// BPFO, ball pass frequency of the outer race.
    pub outer: f64,
    /// BPFI, ball pass frequency of the inner race.
    pub inner: f64,
    /// BSF, ball spin frequency; a ball defect strikes both races once per revolution: lines at 2 BSF.
    pub ball: f64,
}

/// The damaged part.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
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

    /// Name of its defect frequency: BPFO, BPFI, 2 BSF, FTF.
    pub fn line_name(self) -> &'static str {
        match self {
            BearingPart::OuterRace => "BPFO",
            BearingPart::InnerRace => "BPFI",
            BearingPart::Ball => "2 BSF",
            BearingPart::Cage => "FTF",
        }
    }

    /// Its defect frequency: repetition rate of the impulses \[Hz\].
    pub fn defect_frequency(self, rates: &DefectFrequencies) -> f64 {
        match self {
            BearingPart::OuterRace => rates.outer,
            BearingPart::InnerRace => rates.inner,
            BearingPart::Ball => 2.0 * rates.ball,
            BearingPart::Cage => rates.cage,
        }
    }
}

/// Side band: offset of a line from its harmonic.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Modulation {
    /// ± multiple of the shaft speed: load-zone modulation of an inner race defect, unbalance.
    Shaft(i32),
    /// ± multiple of the cage speed: load-zone modulation of a ball defect.
    Cage(i32),
}

/// An expected bearing line (harmonic or side band) and the peak measured there.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct BearingLine {
    pub part: BearingPart,
    pub harmonic: usize,
    /// Side band, `None` for the harmonic itself.
    pub modulation: Option<Modulation>,
    /// Nominal frequency from the given defect frequencies \[Hz\].
    pub expected: f64,
    /// Frequency of the peak \[Hz\].
    pub frequency: f64,
    pub amplitude: f64,
    /// Background: median amplitude of the surrounding bins.
    pub background: f64,
    /// Amplitude over background \[dB\].
    pub level_db: f64,
    /// False-alarm probability: chance that noise alone gives as high a peak anywhere in the search range.
    pub probability: f64,
    pub significant: bool,
    /// Whether a shaft harmonic or a stronger family has a line at this frequency; it is not counted then.
    pub shared: bool,
}

/// Lines of one damaged part: harmonics of its defect frequency with side bands.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct LineFamily {
    pub part: BearingPart,
    /// Nominal (catalogue) defect frequency \[Hz\].
    pub expected: f64,
    /// Defect frequency that fits the harmonics best \[Hz\].
    pub frequency: f64,
    /// Harmonics and side bands.
    pub lines: Vec<BearingLine>,
    /// Root sum of squares of its significant harmonics that are not shared.
    pub strength: f64,
    /// Whether its first or second harmonic is significant and not shared.
    pub detected: bool,
}

/// All lines of a bearing, the strongest family first.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct BearingLines {
    pub families: Vec<LineFamily>,
    /// Damaged part, as the graded diagnosis of the record says; `None`: none is named.
    pub diagnosis: Option<BearingPart>,
}

impl BearingLines {
    /// "inner race", "outer race", "ball", "cage" or "no bearing fault".
    pub fn diagnosis_name(&self) -> &'static str {
        self.diagnosis.map_or("no bearing fault", BearingPart::name)
    }

    /// One part's lines.
    pub fn family(&self, part: BearingPart) -> &LineFamily {
        self.families.iter().find(|f| f.part == part).expect("there is a family for each part")
    }

    /// The highest significant harmonic that is not shared; `None` if there is none.
    pub fn strongest_line(&self) -> Option<&BearingLine> {
        let own = self.families.iter().flat_map(|f| &f.lines);
        own.filter(|l| l.modulation.is_none() && l.significant && !l.shared)
            .max_by(|a, b| a.amplitude.total_cmp(&b.amplitude))
    }
}

/// Settings of the search for bearing lines.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LineSettings {
    /// Maximum relative deviation from the nominal defect frequency, due to slip and contact angle.
    pub slip: f64,
    /// Number of harmonics.
    pub harmonics: usize,
    /// Side bands on each side of a harmonic.
    pub side_bands: usize,
    /// False-alarm probability below which a line counts as significant.
    pub significance: f64,
}

impl Default for LineSettings {
    /// 2 %, five harmonics, one side band on each side, false-alarm probability 1e-6.
    fn default() -> Self {
        LineSettings { slip: 0.02, harmonics: 5, side_bands: 1, significance: 1e-6 }
    }
}

/// Detects bearing defect frequencies in an envelope spectrum (amplitudes); names no damaged part (see `grading`).
///
/// For each part: the frequency within ± slip that fits its harmonics best (largest Σ_h ln(1 + A²/m²)), then
/// the peak at each harmonic h f and side band h f ± n f_s, h f ± n FTF. Levels are relative to the local
/// median amplitude m; noise has A² exponential with mean m²/ln 2, so that a peak A over n bins has the
/// false-alarm probability 1 − (1 − 2^{−A²/m²})ⁿ. A line that coincides with a shaft harmonic, or with a
/// harmonic of a stronger family or its side bands up to ± 6 f_s or ± 3 FTF, does not count for another part.
/// `spectrum`: up to the highest harmonic of BPFI, eight bins per FTF. Errors: NaN, frequencies that are not
/// positive, a spectrum too short or too coarse, settings out of range.
pub fn bearing_lines(
    spectrum: &Spectrum,
    rates: &DefectFrequencies,
    settings: &LineSettings,
) -> Result<BearingLines, SignalError> {
    let search = LineSearch::new(spectrum, rates, settings)?;
    let mut open: Vec<LineFamily> = BearingPart::ALL.map(|part| search.family(part)).into();
    let mut families: Vec<LineFamily> = Vec::new();
    // Greedy: the strongest family claims its lines, then the next strongest of those left, and so on.
    while !open.is_empty() {
        for family in &mut open {
            search.mark_shared_lines(family, families.iter().filter(|f| f.detected));
        }
        let strongest = (0..open.len())
            .max_by(|&a, &b| {
                let rank = |f: &LineFamily| (f.detected, f.strength);
                let ((found_a, a), (found_b, b)) = (rank(&open[a]), rank(&open[b]));
                found_a.cmp(&found_b).then(a.total_cmp(&b))
            })
            .expect("at least one family remains");
        families.push(open.remove(strongest));
    }
    Ok(BearingLines { families, diagnosis: None })
}

struct LineSearch<'a> {
    spectrum: &'a Spectrum,
    rates: &'a DefectFrequencies,
    settings: &'a LineSettings,
    /// Spacing of the bins \[Hz\].
    step: f64,
    /// Running median of the amplitude at each bin.
    background: Vec<f64>,
}

impl<'a> LineSearch<'a> {
    fn new(
        spectrum: &'a Spectrum,
        rates: &'a DefectFrequencies,
        settings: &'a LineSettings,
    ) -> Result<Self, SignalError> {
        check_record("spectrum", &spectrum.values)?;
        check_same_length("frequencies", spectrum.frequencies.len(), "spectrum", spectrum.values.len())?;
        let DefectFrequencies { shaft, cage, outer, inner, ball } = *rates;
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
        check(highest < end, "end of the spectrum [Hz]", "above the highest harmonic requested", end)?;
        // Wide enough that a few lines do not raise the median, narrow enough for a sloping noise floor.
        let half_width = ((0.75 * shaft / step).round() as usize).max(24);
        let background = running_median(&spectrum.values, half_width);
        Ok(LineSearch { spectrum, rates, settings, step, background })
    }

    /// The defect frequency within ± slip that fits a part's harmonics best.
    fn fitted_frequency(&self, part: BearingPart) -> f64 {
        let expected = part.defect_frequency(self.rates);
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
            // Ties: the one nearest to the nominal frequency.
            .max_by(|a, b| a.0.total_cmp(&b.0).then(b.1.abs().cmp(&a.1.abs())))
            .expect("there is a trial at the nominal frequency");
        expected + best as f64 * trial_step
    }

    /// Interpolated frequency, amplitude and background of the highest bin near a frequency.
    fn peak(&self, frequency: f64) -> (f64, f64, f64) {
        let values = &self.spectrum.values;
        let middle = (frequency / self.step).round() as usize;
        let first = middle.saturating_sub(SEARCH_HALF_WIDTH).max(1).min(values.len() - 1);
        let bins = first..(middle + SEARCH_HALF_WIDTH + 1).clamp(first + 1, values.len());
        let bin = bins.max_by(|&a, &b| values[a].total_cmp(&values[b])).expect("the range contains a bin");
        let peak = interpolate_peak(&self.spectrum.frequencies, values, bin);
        (peak.position, peak.amplitude, self.background[bin])
    }

    fn family(&self, part: BearingPart) -> LineFamily {
        let base = self.fitted_frequency(part);
        let expected = part.defect_frequency(self.rates);
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
                if place <= self.step * SEARCH_HALF_WIDTH as f64 || place >= end {
                    continue;
                }
                let (frequency, amplitude, background) = self.peak(place);
                let ratio = amplitude / background;
                // Bins searched at this harmonic by the fit of the defect frequency.
                let range = 2.0 * self.settings.slip * harmonic as f64 * expected / self.step;
                let bins = range + (2 * SEARCH_HALF_WIDTH + 1) as f64;
                let probability = false_alarm_probability(ratio, bins);
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
        LineFamily { part, expected, frequency: base, lines, strength: 0.0, detected: false }
    }

    /// Marks lines shared with shaft harmonics or with families already ranked; strength of the others.
    fn mark_shared_lines<'f>(
        &self,
        family: &mut LineFamily,
        ranked: impl Iterator<Item = &'f LineFamily> + Clone,
    ) {
        for line in &mut family.lines {
            line.shared = self.is_shaft_harmonic(line.frequency)
                || ranked.clone().any(|f| self.belongs_to_family(f, line.frequency));
        }
        let own = family.lines.iter().filter(|l| l.modulation.is_none() && l.significant && !l.shared);
        // From 0, for a sum of no values is −0.
        family.strength = own.clone().fold(0.0, |sum, l| sum + l.amplitude * l.amplitude).sqrt();
        family.detected = own.clone().any(|l| l.harmonic <= 2);
    }

    /// Whether a line is a multiple of the shaft speed, with a tolerance of 0.1 % on the stated speed.
    fn is_shaft_harmonic(&self, frequency: f64) -> bool {
        let multiple = (frequency / self.rates.shaft).round();
        let tolerance = 1.5 * self.step + 1e-3 * frequency;
        multiple >= 1.0
            && multiple <= MAX_SHAFT_HARMONIC as f64
            && (frequency - multiple * self.rates.shaft).abs() < tolerance
    }

    /// Whether a line is a harmonic of another family or one of its side bands.
    fn belongs_to_family(&self, family: &LineFamily, frequency: f64) -> bool {
        let tolerance = 1.5 * self.step + 2e-4 * frequency;
        let harmonics = 1..=2 * self.settings.harmonics as i32;
        harmonics.flat_map(|h| (-MAX_SHAFT_SIDE_BANDS..=MAX_SHAFT_SIDE_BANDS).map(move |m| (h, m))).any(
            |(h, m)| {
                (-MAX_CAGE_SIDE_BANDS..=MAX_CAGE_SIDE_BANDS).any(|c| {
                    // Combined shaft and cage side bands are too weak to be mistaken for lines of another part.
                    let place = f64::from(h) * family.frequency
                        + f64::from(m) * self.rates.shaft
                        + f64::from(c) * self.rates.cage;
                    (m == 0 || c == 0) && (frequency - place).abs() < tolerance
                })
            },
        )
    }
}

/// False-alarm probability: the maximum of n noise bins is ≥ r times the median, 1 − (1 − 2^{−r²})ⁿ.
fn false_alarm_probability(ratio: f64, bins: f64) -> f64 {
    let single_bin = (-LN_2 * ratio * ratio).exp();
    -(bins * (-single_bin).ln_1p()).exp_m1()
}
