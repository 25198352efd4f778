//! Bearing diagnosis of a record: band selection, envelope analysis, bearing defect frequencies.

use std::collections::HashMap;
use std::sync::{Arc, Mutex, PoisonError};

use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use super::SignalError;
use super::bearing_lines::{BearingLines, BearingPart, DefectFrequencies, LineSettings, bearing_lines};
use super::demodulator::Demodulator;
use super::envelope::{analytic_signal, band_analytic_signal};
use super::error::{check_length, check_rate, check_record, check_same_length};
use super::filter_bank::{BankLevel, max_depth};
use super::grading::{BandGrading, Finding, GradedDiagnosis, machine_tones};
use super::kurtogram::{BandChoice, Kurtogram, fast_kurtogram};
use super::resample::{AngleResampler, SAMPLES_PER_ORDER};
use super::spectrum::{Level, Spectrum, amplitude_spectrum};
use super::statistics::statistics;
use super::window::WindowKind;

/// Speed below which the shaft counts as at standstill \[rev/s\].
const MIN_SPEED: f64 = 0.1;

/// Demodulation band: how the band of the envelope is chosen.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum BandRule {
    /// From low to high \[Hz\].
    Given(f64, f64),
    /// The whole record.
    Whole,
    /// The band of highest kurtosis (fast kurtogram): the most impulsive one, whatever the source.
    Kurtosis,
    /// The band in whose envelope spectrum the most speaks for a damaged part.
    Lines,
}

/// 10/ln 10: evidence, a power ratio, in dB.
const DB_PER_NEPER_OF_EVIDENCE: f64 = 4.342944819032518;

/// Bands that are judged if none is named in that of the most evidence, the probability from which one of them names a
/// part, and the common share of two bands from which they say the same.
const MORE_BANDS: usize = 4;
const SURE_ELSEWHERE: f64 = 0.97;
const SAME_BAND: f64 = 0.5;

/// Kurtosis of Gaussian noise, below which a record is smooth, and harmonics of the ball passage that make it so.
const SMOOTH_KURTOSIS: f64 = 3.0;
const PASSAGE_HARMONICS: usize = 10;

/// Shaft rotation during the record.
#[derive(Clone, Copy, Debug)]
pub enum ShaftRotation<'a> {
    /// Constant speed: defect frequencies are in Hz.
    ConstantSpeed,
    /// Shaft angle sampled like the record \[rad\]: defect frequencies are in orders (shaft 1).
    Angle(&'a [f64]),
}

/// Bearing diagnosis: the demodulation band, its envelope spectrum and the bearing lines in it.
#[derive(Clone, Debug, PartialEq)]
pub struct Diagnosis {
    /// Band \[Hz\].
    pub band: (f64, f64),
    /// Score of every band compared, kurtosis or evidence of bearing lines \[dB\]; `None` for a given band.
    pub kurtogram: Option<Kurtogram>,
    /// Amplitude spectrum of the band's envelope \[unit\], over Hz or over orders.
    pub envelope: Spectrum,
    /// Lines expected of each part; the damaged part is that of the graded diagnosis.
    pub lines: BearingLines,
    pub graded: GradedDiagnosis,
}

/// Chooses a band, computes its envelope spectrum and detects the bearing lines in it (envelope analysis).
///
/// With a shaft angle the envelope, not the record, is resampled in angle: resonances stay in their band and
/// lines do not smear; the longest segment without standstill is used. `record` \[any unit\], `sample_rate`
/// \[Hz\], `rates` in the unit given by [`ShaftRotation`]. Bands are those of the binary-ternary filter bank, at
/// least 2.5 times the highest defect frequency wide; the significance level is divided by the number of
/// bands compared (Bonferroni correction).
/// Errors: NaN; less than ten revolutions of the cage; a sampling rate below twice the highest harmonic
/// requested; a band outside 0..f_s/2; an angle of different length.
pub fn diagnose(
    record: &[f64],
    sample_rate: f64,
    rotation: ShaftRotation,
    rates: &DefectFrequencies,
    rule: BandRule,
    settings: &LineSettings,
) -> Result<Diagnosis, SignalError> {
    check_record("record", record)?;
    check_rate(sample_rate)?;
    let highest = BearingPart::ALL.map(|part| part.defect_frequency(rates)).into_iter().fold(0.0, f64::max);
    let top = settings.harmonics as f64 * highest * (1.0 + settings.slip) * 1.01;
    let clock = SpectrumDomain::new(record.len(), sample_rate, rotation, top)?;
    let fastest = clock.max_hz_per_unit();
    if sample_rate < 2.0 * top * fastest {
        let (needed, purpose) = (2.0 * top * fastest, "the highest bearing line requested");
        return Err(SignalError::RateTooLow { given: sample_rate, needed, purpose });
    }
    clock.check_cage_revolutions(record.len(), rates.cage)?;
    // A band of width B contains modulation frequencies up to B.
    let by_width = (0.5 * sample_rate / (2.5 * highest * fastest)).log2().floor();
    let depth = (by_width.max(0.0) as usize).min(max_depth(record.len()));
    let half = 0.5 * sample_rate;
    let demodulator = Demodulator::new(record, sample_rate);
    let tones = match rotation {
        ShaftRotation::ConstantSpeed => {
            let spectrum = amplitude_spectrum(record, sample_rate, WindowKind::Hann, Level::Peak)?;
            machine_tones(&spectrum, rates.shaft)
        }
        // Lines of the mains smear over the shaft's angle.
        ShaftRotation::Angle(_) => Vec::new(),
    };
    let end = BandGrading::needed_range(rates, settings);
    let without_tones = |band: (f64, f64)| demodulator.spectrum_without(&tones, band, end);
    let kurtogram = match rule {
        BandRule::Given(..) | BandRule::Whole => None,
        _ if depth == 0 => None,
        BandRule::Kurtosis => Some(fast_kurtogram(record, sample_rate, depth)?),
        BandRule::Lines => {
            let score = |band: (f64, f64)| {
                let spectrum = match rotation {
                    ShaftRotation::ConstantSpeed => demodulator.envelope_spectrum(band, end),
                    ShaftRotation::Angle(_) => {
                        let (envelope, rate) = demodulator.envelope(band);
                        clock.spectrum_at(&envelope, rate)?
                    }
                };
                let unit = clock.hz_per_unit();
                let found = BandGrading::new(&spectrum, rates, settings, unit, without_tones(band).as_ref());
                Ok(DB_PER_NEPER_OF_EVIDENCE * found.score())
            };
            Some(Kurtogram { levels: score_bank(depth, half, score)?, max_frequency: half })
        }
    };
    let band = match (rule, kurtogram.as_ref().map(Kurtogram::best)) {
        (BandRule::Given(low, high), _) => (low, high),
        (_, Some(BandChoice { low, high, .. })) => (low, high),
        (_, None) => (0.0, half),
    };
    let tried = kurtogram.as_ref().map_or(1, |k| k.bands().count());
    let chosen = rule == BandRule::Lines && kurtogram.is_some();
    let graded_in = |band: (f64, f64)| -> Result<(Spectrum, GradedDiagnosis), SignalError> {
        let envelope = envelope(record, sample_rate, band)?;
        let spectrum = clock.spectrum(&envelope)?;
        let squared = clock.spectrum(&envelope.iter().map(|e| e * e).collect::<Vec<_>>())?;
        let unit = clock.hz_per_unit();
        let grading = BandGrading::new(&spectrum, rates, settings, unit, without_tones(band).as_ref());
        let graded = grading.diagnosis(&squared, rates, chosen);
        Ok((spectrum, graded))
    };
    let (mut spectrum, mut graded) = graded_in(band)?;
    let mut band = band;
    if let Some(scores) = kurtogram.as_ref().filter(|_| chosen && graded.part().is_none()) {
        // What explains the best band by something else does not hide a fault in another, but what explains its lines there
        // explains them everywhere.
        let mut rivals = graded.rivals.clone();
        for other in next_best(scores, band) {
            let (other_spectrum, found) = graded_in(other)?;
            let step = other_spectrum.frequencies[1];
            let is_rivals = rivals.iter().any(|rival| rival.is_family_of(found.frequency, step));
            rivals.extend(&found.rivals);
            if found.probability >= SURE_ELSEWHERE && graded.probability < found.probability && !is_rivals {
                (band, spectrum, graded) = (other, other_spectrum, found);
            }
        }
    }
    if chosen && graded.finding == Finding::NoFault {
        // No band has lines of the bearing: the whole record shows what else repeats.
        let (whole, other) = graded_in((0.0, half))?;
        if matches!(other.finding, Finding::Periodic(_)) {
            (band, spectrum) = ((0.0, half), whole);
            graded = GradedDiagnosis {
                finding: other.finding,
                rivals: other.rivals,
                strong_lines: other.strong_lines,
                ..graded
            };
        }
    }
    if graded.part() == Some(BearingPart::OuterRace) && matches!(rotation, ShaftRotation::ConstantSpeed) {
        graded.smooth_ball_pass = is_smooth_ball_pass(record, sample_rate, graded.frequency)?;
    }
    let strict = LineSettings { significance: settings.significance / tried as f64, ..*settings };
    let mut lines = bearing_lines(&spectrum, rates, &strict)?;
    lines.diagnosis = graded.part();
    Ok(Diagnosis { band, kurtogram, envelope: spectrum, lines, graded })
}

/// The bands of the next highest scores that have less than half in common with the best and with each other.
fn next_best(scores: &Kurtogram, best: (f64, f64)) -> Vec<(f64, f64)> {
    let mut ranked: Vec<BandChoice> = scores.bands().collect();
    ranked.sort_by(|a, b| b.value.total_cmp(&a.value));
    let same = |a: &(f64, f64), b: (f64, f64)| {
        let common = (a.1.min(b.1) - a.0.max(b.0)).max(0.0);
        common >= SAME_BAND * (a.1.max(b.1) - a.0.min(b.0))
    };
    let mut taken = vec![best];
    for choice in ranked {
        let band = (choice.low, choice.high);
        if taken.len() <= MORE_BANDS && !taken.iter().any(|t| same(t, band)) {
            taken.push(band);
        }
    }
    taken.split_off(1)
}

/// Demodulation band, kurtogram it was chosen by, and envelope spectrum.
#[derive(Clone, Debug, PartialEq)]
pub struct BandEnvelope {
    /// Band \[Hz\].
    pub band: (f64, f64),
    /// Kurtosis of every band compared; `None` for a given band.
    pub kurtogram: Option<Kurtogram>,
    /// Amplitude spectrum of the band's envelope \[unit\], over Hz or over orders.
    pub envelope: Spectrum,
}

/// Filter bank depth when the pulse rate is unknown: bands of a 128th of the sampling rate and wider.
const DEFAULT_DEPTH: usize = 6;

/// Band by `rule` and its envelope spectrum, without bearing data.
///
/// [`BandRule::Lines`] falls back to [`BandRule::Kurtosis`]. `top_order` is the highest order kept with a
/// shaft angle. Other arguments and errors as [`diagnose`].
pub fn band_envelope(
    record: &[f64],
    sample_rate: f64,
    rotation: ShaftRotation,
    rule: BandRule,
    top_order: f64,
) -> Result<BandEnvelope, SignalError> {
    check_record("record", record)?;
    check_rate(sample_rate)?;
    let clock = SpectrumDomain::new(record.len(), sample_rate, rotation, top_order)?;
    let depth = max_depth(record.len()).min(DEFAULT_DEPTH);
    let (band, kurtogram) = match rule {
        BandRule::Given(low, high) => ((low, high), None),
        BandRule::Kurtosis | BandRule::Lines if depth > 0 => {
            let kurtogram = fast_kurtogram(record, sample_rate, depth)?;
            let BandChoice { low, high, .. } = kurtogram.best();
            ((low, high), Some(kurtogram))
        }
        _ => ((0.0, 0.5 * sample_rate), None),
    };
    let envelope = clock.spectrum(&envelope(record, sample_rate, band)?)?;
    Ok(BandEnvelope { band, kurtogram, envelope })
}

/// Envelope: magnitude of a band's analytic signal.
fn envelope(record: &[f64], sample_rate: f64, band: (f64, f64)) -> Result<Vec<f64>, SignalError> {
    let whole = band.0 <= 0.0 && band.1 >= 0.5 * sample_rate;
    let signal =
        if whole { analytic_signal(record)? } else { band_analytic_signal(record, sample_rate, band)? };
    Ok(signal.iter().map(|z| z.norm()).collect())
}

/// Whether a record is a smooth vibration at the rate of the ball passage: kurtosis below that of noise, and most of its
/// power in the first harmonics of that rate \[Hz\].
///
/// Balls that pass through the load change the stiffness at BPFO (variable compliance) and shake a sound bearing so;
/// impacts of a damaged race have their power at the resonances that they excite.
fn is_smooth_ball_pass(record: &[f64], sample_rate: f64, rate: f64) -> Result<bool, SignalError> {
    let spectrum = amplitude_spectrum(record, sample_rate, WindowKind::Hann, Level::Peak)?;
    let step = spectrum.frequencies[1];
    // The first two bins hold the mean.
    let power = |bins: std::ops::Range<usize>| {
        let inside = bins.start.max(2)..bins.end.min(spectrum.values.len());
        spectrum.values.get(inside).unwrap_or(&[]).iter().map(|a| a * a).sum::<f64>()
    };
    let about = |harmonic: usize| {
        let place = harmonic as f64 * rate / step;
        let reach = 3.0 + 1e-3 * place;
        power((place - reach).max(1.0) as usize..(place + reach) as usize + 1)
    };
    let of_passage = (1..=PASSAGE_HARMONICS).map(about).sum::<f64>();
    let smooth = statistics(record)?.kurtosis.is_some_and(|kurtosis| kurtosis < SMOOTH_KURTOSIS);
    Ok(smooth && of_passage > 0.5 * power(2..spectrum.values.len()))
}

/// Score of each band of 1, 2, 3, 4, 6, 8 … 2^depth equal parts of 0..half.
fn score_bank(
    depth: usize,
    half: f64,
    score: impl Fn((f64, f64)) -> Result<f64, SignalError> + Sync,
) -> Result<Vec<BankLevel>, SignalError> {
    let counts = (0..=depth).flat_map(|k| {
        let thirds = (k > 0 && k < depth).then_some(3 << (k.max(1) - 1));
        std::iter::once(1usize << k).chain(thirds)
    });
    let level = |count: usize| {
        let edge = |i: usize| half * i as f64 / count as f64;
        let values: Result<Vec<f64>, SignalError> =
            (0..count).into_par_iter().map(|i| score((edge(i), edge(i + 1)))).collect();
        Ok(BankLevel { level: (count as f64).log2(), values: values? })
    };
    counts.map(level).collect()
}

/// Domain of the envelope spectrum: time (Hz) or shaft angle (orders).
enum SpectrumDomain<'a> {
    Time {
        rate: f64,
    },
    Angle {
        theta: &'a [f64],
        turns: TurningPart,
        fastest: f64,
        slower: Mutex<HashMap<usize, Arc<TurningPart>>>,
    },
}

/// The longest stretch of a record in which the shaft turns.
struct TurningPart {
    resampler: AngleResampler,
    index: usize,
}

impl TurningPart {
    fn new(theta: &[f64], rate: f64, per_turn: usize) -> Result<Self, SignalError> {
        let resampler = AngleResampler::new(theta, rate, per_turn, MIN_SPEED)?;
        let parts = resampler.parts();
        let index = (0..parts.len()).max_by_key(|&k| parts[k].times.len()).expect("at least one part");
        Ok(Self { resampler, index })
    }

    fn per_turn(&self) -> usize {
        self.resampler.samples_per_revolution()
    }

    /// Times of the outputs \[s\].
    fn times(&self) -> &[f64] {
        &self.resampler.parts()[self.index].times
    }

    /// Amplitude spectrum of an envelope minus its mean over orders.
    fn spectrum(&self, envelope: &[f64]) -> Result<Spectrum, SignalError> {
        let mut parts = self.resampler.resample(&[envelope])?;
        deviation_spectrum(parts.swap_remove(self.index).swap_remove(0), self.per_turn() as f64)
    }
}

impl<'a> SpectrumDomain<'a> {
    fn new(
        samples: usize,
        rate: f64,
        rotation: ShaftRotation<'a>,
        top_order: f64,
    ) -> Result<Self, SignalError> {
        let ShaftRotation::Angle(theta) = rotation else { return Ok(SpectrumDomain::Time { rate }) };
        check_same_length("shaft angle", theta.len(), "the record", samples)?;
        let per_turn = (SAMPLES_PER_ORDER * top_order).ceil().clamp(16.0, 1e5) as usize;
        let turns = TurningPart::new(theta, rate, per_turn)?;
        // Averaged over whole revolutions, so that jitter of the angle does not raise the speed.
        let revolutions = turns.times().windows(per_turn + 1).step_by(per_turn);
        let fastest = revolutions.map(|w| 1.0 / (w[per_turn] - w[0])).fold(0.0, f64::max);
        Ok(SpectrumDomain::Angle { theta, turns, fastest, slower: Mutex::default() })
    }

    /// Hz per unit of the frequency axis; `None` for orders.
    fn hz_per_unit(&self) -> Option<f64> {
        match self {
            SpectrumDomain::Time { .. } => Some(1.0),
            SpectrumDomain::Angle { .. } => None,
        }
    }

    /// Maximum Hz per unit of the defect frequencies: 1, or the highest shaft speed \[rev/s\].
    fn max_hz_per_unit(&self) -> f64 {
        match self {
            SpectrumDomain::Time { .. } => 1.0,
            SpectrumDomain::Angle { fastest, .. } => *fastest,
        }
    }

    /// Error for a record too short to resolve cage side bands.
    fn check_cage_revolutions(&self, samples: usize, cage: f64) -> Result<(), SignalError> {
        const TURNS: f64 = 10.0;
        match self {
            SpectrumDomain::Time { rate } if cage > 0.0 => {
                let needed = (TURNS * rate / cage).ceil() as usize;
                check_length("record", samples, needed, "ten revolutions of the cage, to resolve its lines")
            }
            SpectrumDomain::Angle { turns, .. } => {
                let given = turns.times().len() as f64 / turns.per_turn() as f64;
                let needed = TURNS / cage;
                if given < needed {
                    let purpose = "ten revolutions of the cage, to resolve its lines";
                    return Err(SignalError::TooFewRevolutions { needed, given, purpose });
                }
                Ok(())
            }
            SpectrumDomain::Time { .. } => Ok(()),
        }
    }

    /// Amplitude spectrum of an envelope at the record's rate, minus its mean (Hann, peak).
    fn spectrum(&self, envelope: &[f64]) -> Result<Spectrum, SignalError> {
        match self {
            SpectrumDomain::Time { rate } => deviation_spectrum(envelope.to_vec(), *rate),
            SpectrumDomain::Angle { turns, .. } => turns.spectrum(envelope),
        }
    }

    /// The same of an envelope of the record's duration at another rate \[Hz\].
    fn spectrum_at(&self, envelope: &[f64], rate: f64) -> Result<Spectrum, SignalError> {
        match self {
            SpectrumDomain::Time { .. } => deviation_spectrum(envelope.to_vec(), rate),
            SpectrumDomain::Angle { theta, turns, .. } if theta.len() == envelope.len() => {
                turns.spectrum(envelope)
            }
            SpectrumDomain::Angle { theta, turns, slower, .. } => {
                let count = envelope.len();
                let known = slower.lock().unwrap_or_else(PoisonError::into_inner).get(&count).cloned();
                let part = match known {
                    Some(part) => part,
                    None => {
                        let part = TurningPart::new(&at_rate_of(theta, count), rate, turns.per_turn())?;
                        let mut all = slower.lock().unwrap_or_else(PoisonError::into_inner);
                        all.entry(count).or_insert_with(|| Arc::new(part)).clone()
                    }
                };
                part.spectrum(envelope)
            }
        }
    }
}

/// Shaft angle at `count` equal steps over its duration, linear in between.
fn at_rate_of(theta: &[f64], count: usize) -> Vec<f64> {
    let ratio = theta.len() as f64 / count as f64;
    let value = |k: usize| {
        let at = (k as f64 * ratio).min((theta.len() - 1) as f64);
        let before = (at as usize).min(theta.len().saturating_sub(2));
        let [a, b] = [theta[before], theta[(before + 1).min(theta.len() - 1)]];
        a + (at - before as f64) * (b - a)
    };
    (0..count).map(value).collect()
}

/// Amplitude spectrum of an envelope minus its mean (Hann, peak).
fn deviation_spectrum(mut values: Vec<f64>, rate: f64) -> Result<Spectrum, SignalError> {
    let mean = values.iter().sum::<f64>() / values.len() as f64;
    values.iter_mut().for_each(|e| *e -= mean);
    amplitude_spectrum(&values, rate, WindowKind::Hann, Level::Peak)
}
