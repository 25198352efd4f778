//! From a record to a verdict: band, envelope spectrum, bearing lines.

use rayon::prelude::*;

use super::SignalError;
use super::bearing_lines::{
    BearingLines, BearingPart, BearingRates, LineSettings, bearing_lines, line_score,
};
use super::envelope::{analytic_signal, band_analytic_signal};
use super::error::{check_length, check_rate, check_record, check_same_length};
use super::filter_bank::{BankLevel, deepest};
use super::kurtogram::{BandChoice, Kurtogram, fast_kurtogram};
use super::resample::{AngleResampler, SAMPLES_PER_ORDER};
use super::spectrum::{Level, Spectrum, amplitude_spectrum};
use super::window::WindowKind;

/// Speed below which the shaft counts as standing \[rev/s\].
const LEAST_SPEED: f64 = 0.1;

/// Which band the envelope is taken of.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum BandRule {
    /// From low to high \[Hz\].
    Given(f64, f64),
    /// The whole record.
    Whole,
    /// The band of the highest kurtosis: where pulses stand out, of whatever source.
    Kurtosis,
    /// The band whose envelope shows the bearing's lines highest over their background.
    Lines,
}

/// How the shaft turned while the record was taken.
#[derive(Clone, Copy, Debug)]
pub enum Turning<'a> {
    /// At one speed: rates are in Hz.
    Steady,
    /// By a shaft angle sampled like the record \[rad\]: rates are in orders, that of the shaft is 1.
    Angle(&'a [f64]),
}

/// A band, the envelope spectrum in it, and what it shows.
#[derive(Clone, Debug, PartialEq)]
pub struct Diagnosis {
    /// Band \[Hz\].
    pub band: (f64, f64),
    /// Value of every band that was compared, kurtosis or line level \[dB\]; `None` for a given band.
    pub kurtogram: Option<Kurtogram>,
    /// Amplitude spectrum of the band's envelope \[unit\], over Hz or over orders.
    pub envelope: Spectrum,
    pub lines: BearingLines,
}

/// Chooses a band, takes its envelope's spectrum and reads the bearing's lines in it.
///
/// With a shaft angle the envelope, not the record, is resampled in angle: resonances stay in their band and lines stand
/// still; the longest stretch in which the shaft turns is used. `record` \[any unit\], `sample_rate` \[Hz\], `rates` as
/// [`Turning`] says. Bands are those of the binary-ternary bank, wide enough for the highest rate 2.5 times over; a line
/// found by choosing among B bands must be B times less probable.
/// Errors: NaN; less than ten turns of the cage; a sampling rate below twice the highest harmonic asked for; a band that
/// is not in 0..f_s/2; an angle of another length.
pub fn diagnose(
    record: &[f64],
    sample_rate: f64,
    turning: Turning,
    rates: &BearingRates,
    rule: BandRule,
    settings: &LineSettings,
) -> Result<Diagnosis, SignalError> {
    check_record("record", record)?;
    check_rate(sample_rate)?;
    let highest = BearingPart::ALL.map(|part| part.rate(rates)).into_iter().fold(0.0, f64::max);
    let top = settings.harmonics as f64 * highest * (1.0 + settings.slip) * 1.01;
    let clock = Clock::new(record.len(), sample_rate, turning, top)?;
    let fastest = clock.fastest();
    if sample_rate < 2.0 * top * fastest {
        let (needed, purpose) = (2.0 * top * fastest, "the highest bearing line asked for");
        return Err(SignalError::RateTooLow { given: sample_rate, needed, purpose });
    }
    clock.check_cage_turns(record.len(), rates.cage)?;
    // A band of width B shows modulation up to B.
    let by_width = (0.5 * sample_rate / (2.5 * highest * fastest)).log2().floor();
    let depth = (by_width.max(0.0) as usize).min(deepest(record.len()));
    let half = 0.5 * sample_rate;
    let kurtogram = match rule {
        BandRule::Given(..) | BandRule::Whole => None,
        _ if depth == 0 => None,
        BandRule::Kurtosis => Some(fast_kurtogram(record, sample_rate, depth)?),
        BandRule::Lines => {
            // The first two harmonics: as much as the narrowest band shows.
            let settings = LineSettings { harmonics: settings.harmonics.min(2), ..*settings };
            let score = |band: (f64, f64)| {
                line_score(&clock.spectrum(&envelope(record, sample_rate, band)?)?, rates, &settings)
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
    let spectrum = clock.spectrum(&envelope(record, sample_rate, band)?)?;
    let strict = LineSettings { significance: settings.significance / tried as f64, ..*settings };
    let lines = bearing_lines(&spectrum, rates, &strict)?;
    Ok(Diagnosis { band, kurtogram, envelope: spectrum, lines })
}

/// A band, how it was chosen, and its envelope's spectrum.
#[derive(Clone, Debug, PartialEq)]
pub struct BandEnvelope {
    /// Band \[Hz\].
    pub band: (f64, f64),
    /// Kurtosis of every band that was compared; `None` for a given band.
    pub kurtogram: Option<Kurtogram>,
    /// Amplitude spectrum of the band's envelope \[unit\], over Hz or over orders.
    pub envelope: Spectrum,
}

/// Levels compared where nothing tells how fast pulses come: bands of a 128th of the sampling rate and wider.
const PLAIN_DEPTH: usize = 6;

/// Band by `rule` and its envelope's spectrum, where no bearing is known.
///
/// [`BandRule::Lines`] chooses as [`BandRule::Kurtosis`]. `top_order` is the highest order kept with a shaft angle. Other
/// arguments and errors as [`diagnose`].
pub fn band_envelope(
    record: &[f64],
    sample_rate: f64,
    turning: Turning,
    rule: BandRule,
    top_order: f64,
) -> Result<BandEnvelope, SignalError> {
    check_record("record", record)?;
    check_rate(sample_rate)?;
    let clock = Clock::new(record.len(), sample_rate, turning, top_order)?;
    let depth = deepest(record.len()).min(PLAIN_DEPTH);
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

/// Magnitude of a band's analytic signal.
fn envelope(record: &[f64], sample_rate: f64, band: (f64, f64)) -> Result<Vec<f64>, SignalError> {
    let whole = band.0 <= 0.0 && band.1 >= 0.5 * sample_rate;
    let signal =
        if whole { analytic_signal(record)? } else { band_analytic_signal(record, sample_rate, band)? };
    Ok(signal.iter().map(|z| z.norm()).collect())
}

/// A value of each band of 1, 2, 3, 4, 6, 8 … 2^depth equal parts of 0..half.
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

/// What the envelope's spectrum is over: seconds, or turns of the shaft.
enum Clock {
    Time { rate: f64 },
    Shaft { resampler: AngleResampler, longest: usize, fastest: f64 },
}

impl Clock {
    fn new(samples: usize, rate: f64, turning: Turning, top_order: f64) -> Result<Self, SignalError> {
        let Turning::Angle(theta) = turning else { return Ok(Clock::Time { rate }) };
        check_same_length("shaft angle", theta.len(), "the record", samples)?;
        let per_turn = (SAMPLES_PER_ORDER * top_order).ceil().clamp(16.0, 1e5) as usize;
        let resampler = AngleResampler::new(theta, rate, per_turn, LEAST_SPEED)?;
        let parts = resampler.parts();
        let longest = (0..parts.len()).max_by_key(|&k| parts[k].times.len()).expect("a part turns");
        // Over whole turns, so that a jittering angle does not count as speed.
        let turns = parts[longest].times.windows(per_turn + 1).step_by(per_turn);
        let fastest = turns.map(|w| 1.0 / (w[per_turn] - w[0])).fold(0.0, f64::max);
        Ok(Clock::Shaft { resampler, longest, fastest })
    }

    /// Hz per unit of the rates, at most.
    fn fastest(&self) -> f64 {
        match self {
            Clock::Time { .. } => 1.0,
            Clock::Shaft { fastest, .. } => *fastest,
        }
    }

    /// Refuses a record that does not part side bands of the cage.
    fn check_cage_turns(&self, samples: usize, cage: f64) -> Result<(), SignalError> {
        const TURNS: f64 = 10.0;
        match self {
            Clock::Time { rate } if cage > 0.0 => {
                let needed = (TURNS * rate / cage).ceil() as usize;
                check_length("record", samples, needed, "ten turns of the cage, to tell its lines apart")
            }
            Clock::Shaft { resampler, longest, .. } => {
                let given = resampler.parts()[*longest].times.len() as f64
                    / resampler.samples_per_revolution() as f64;
                let needed = TURNS / cage;
                if given < needed {
                    let purpose = "ten turns of the cage, to tell its lines apart";
                    return Err(SignalError::TooFewRevolutions { needed, given, purpose });
                }
                Ok(())
            }
            Clock::Time { .. } => Ok(()),
        }
    }

    /// Amplitude spectrum of an envelope less its mean (Hann, peak).
    fn spectrum(&self, envelope: &[f64]) -> Result<Spectrum, SignalError> {
        let (mut values, rate) = match self {
            Clock::Time { rate } => (envelope.to_vec(), *rate),
            Clock::Shaft { resampler, longest, .. } => {
                let mut parts = resampler.resample(&[envelope])?;
                let channel = parts.swap_remove(*longest).swap_remove(0);
                (channel, resampler.samples_per_revolution() as f64)
            }
        };
        let mean = values.iter().sum::<f64>() / values.len() as f64;
        values.iter_mut().for_each(|e| *e -= mean);
        amplitude_spectrum(&values, rate, WindowKind::Hann, Level::Peak)
    }
}
