//! From a record to a verdict: band, envelope spectrum, bearing lines.

use super::SignalError;
use super::bearing_lines::{
    BearingLines, BearingPart, BearingRates, LineSettings, bearing_lines, line_score,
};
use super::envelope::{analytic_signal, band_analytic_signal};
use super::error::{check_length, check_rate, check_record};
use super::filter_bank::{SubBand, deepest};
use super::kurtogram::{BandChoice, Kurtogram, fast_kurtogram, scored_bands};
use super::spectrum::{Level, Spectrum, amplitude_spectrum};
use super::window::WindowKind;

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

/// A band, the envelope spectrum in it, and what it shows.
#[derive(Clone, Debug, PartialEq)]
pub struct Diagnosis {
    /// Band \[Hz\].
    pub band: (f64, f64),
    /// Value of every band that was compared, kurtosis or line level; `None` for a given band.
    pub kurtogram: Option<Kurtogram>,
    /// Amplitude spectrum of the band's envelope \[unit\].
    pub envelope: Spectrum,
    pub lines: BearingLines,
}

/// Chooses a band, takes its envelope's spectrum and reads the bearing's lines in it.
///
/// `record` \[any unit\] at constant speed (else resample it in shaft angle first, with f_s in samples per revolution and
/// rates in orders), `sample_rate` \[Hz\], `rates` \[Hz\]. Bands are those of the binary-ternary bank that are wide enough
/// for the second harmonic of the highest rate; a line found by choosing among B bands has its probability times B.
/// Errors: NaN; a record of less than ten turns of the cage; a sampling rate below twice the highest harmonic asked for.
pub fn diagnose(
    record: &[f64],
    sample_rate: f64,
    rates: &BearingRates,
    rule: BandRule,
    settings: &LineSettings,
) -> Result<Diagnosis, SignalError> {
    check_record("record", record)?;
    check_rate(sample_rate)?;
    let highest = BearingPart::ALL.map(|part| part.rate(rates)).into_iter().fold(0.0, f64::max);
    let needed = 2.0 * settings.harmonics as f64 * highest * (1.0 + settings.slip) * 1.01;
    if sample_rate < needed {
        let purpose = "the highest bearing line asked for";
        return Err(SignalError::RateTooLow { given: sample_rate, needed, purpose });
    }
    if rates.cage > 0.0 {
        let needed = (10.0 * sample_rate / rates.cage).ceil() as usize;
        check_length("record", record.len(), needed, "ten turns of the cage, to tell its lines apart")?;
    }
    // A band of width B shows modulation up to B.
    let by_width = (0.5 * sample_rate / (2.5 * highest)).log2().floor();
    let depth = (by_width.max(0.0) as usize).min(deepest(record.len()));
    let kurtogram = match rule {
        BandRule::Given(..) | BandRule::Whole => None,
        _ if depth == 0 => None,
        BandRule::Kurtosis => Some(fast_kurtogram(record, sample_rate, depth)?),
        BandRule::Lines => {
            // As many harmonics as the narrowest band shows.
            let settings = LineSettings { harmonics: settings.harmonics.min(2), ..*settings };
            let score = |band: SubBand| band_score(&band, rates, &settings);
            Some(scored_bands(record, sample_rate, depth, score)?)
        }
    };
    let half = 0.5 * sample_rate;
    let band = match (rule, kurtogram.as_ref().map(Kurtogram::best)) {
        (BandRule::Given(low, high), _) => (low, high),
        (_, Some(BandChoice { low, high, .. })) => (low, high),
        (_, None) => (0.0, half),
    };
    let tried = kurtogram.as_ref().map_or(1, |k| k.bands().count());
    let envelope = envelope_of(record, sample_rate, band)?;
    let strict = LineSettings { significance: settings.significance / tried as f64, ..*settings };
    let lines = bearing_lines(&envelope, rates, &strict)?;
    Ok(Diagnosis { band, kurtogram, envelope, lines })
}

fn envelope_of(record: &[f64], sample_rate: f64, band: (f64, f64)) -> Result<Spectrum, SignalError> {
    let whole = band.0 <= 0.0 && band.1 >= 0.5 * sample_rate;
    let signal =
        if whole { analytic_signal(record)? } else { band_analytic_signal(record, sample_rate, band)? };
    let mut envelope: Vec<f64> = signal.iter().map(|z| z.norm()).collect();
    let mean = envelope.iter().sum::<f64>() / envelope.len() as f64;
    envelope.iter_mut().for_each(|e| *e -= mean);
    amplitude_spectrum(&envelope, sample_rate, WindowKind::Hann, Level::Peak)
}

/// Line level in one band's own envelope; a band that cannot show the lines scores nothing.
fn band_score(band: &SubBand, rates: &BearingRates, settings: &LineSettings) -> f64 {
    let mut envelope: Vec<f64> = band.signal.iter().map(|z| z.norm()).collect();
    let mean = envelope.iter().sum::<f64>() / envelope.len() as f64;
    envelope.iter_mut().for_each(|e| *e -= mean);
    amplitude_spectrum(&envelope, band.rate, WindowKind::Hann, Level::Peak)
        .and_then(|spectrum| line_score(&spectrum, rates, settings))
        .unwrap_or(0.0)
}
