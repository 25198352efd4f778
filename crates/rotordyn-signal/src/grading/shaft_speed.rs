//! The shaft speed that a record itself shows, near the stated one.

use serde::{Deserialize, Serialize};

use super::super::SignalError;
use super::super::error::{check, check_rate, check_record};
use super::super::ridge::interpolate_peak;
use super::super::spectrum::{Level, Spectrum, amplitude_spectrum};
use super::super::window::WindowKind;
use super::line_spectrum::LineSpectrum;

/// Harmonics of the shaft speed that are searched.
const HARMONICS: usize = 10;
/// Evidence from which a harmonic stands, and that one of them counts at most: no line alone decides.
const STANDS: f64 = 9.0;
const LIMIT: f64 = 40.0;
/// Harmonics that make a family: chance gives three within a bin of one comb in fewer than 1 of 1000 noise
/// records (each stands with probability 3 × 10⁻⁵ per trial, some thousand independent trials).
const FAMILY: usize = 3;
/// Ratios at which a family elsewhere suggests a wrong sampling rate.
const OTHER_RATIOS: [f64; 4] = [0.25, 0.5, 2.0, 4.0];

/// Speed of a family of shaft harmonics in a record.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct RecordSpeed {
    /// \[rev/s\].
    pub speed: f64,
    /// Standard deviation \[rev/s\].
    pub uncertainty: f64,
    /// Number of harmonics that stand.
    pub harmonics: usize,
}

/// Result of the search for a shaft speed.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum SpeedFinding {
    /// Near the stated speed.
    Found(RecordSpeed),
    /// Not there, but at a ratio of the stated speed that a wrong sampling rate gives.
    Elsewhere { speed: RecordSpeed, ratio: f64 },
    /// No family of harmonics.
    NotFound,
}

/// Shaft speed from the harmonics 1x to 10x in a record's spectrum, within ± `range` of the stated speed.
///
/// Maximises Σ min(evidence(n f), 40) over f; then f = Σ w f_n/n with the interpolated peaks f_n, w = (n/σ_n)²
/// and σ_n = Δf (0.02 + 0.55/√q_n), q_n the line's power over the noise. `record` \[any unit\], `sample_rate`
/// \[Hz\], `stated` \[rev/s\], `range` relative, 0 to 0.2. The uncertainty is the larger of that of the weights and
/// of the scatter of f_n/n. Errors: NaN, a speed or range out of range, fewer than ten revolutions.
/// Source for σ_n: Rife and Boorstyn, IEEE Trans. Inf. Theory 20 (1974), for a Hann window.
pub fn shaft_speed(
    record: &[f64],
    sample_rate: f64,
    stated: f64,
    range: f64,
) -> Result<SpeedFinding, SignalError> {
    check_record("record", record)?;
    check_rate(sample_rate)?;
    check(stated > 0.0 && stated.is_finite(), "shaft speed", "a positive number of rev/s", stated)?;
    check((0.0..=0.2).contains(&range), "range of the shaft speed", "0 to 0.2 of the speed", range)?;
    let turns = stated * record.len() as f64 / sample_rate;
    if turns < 10.0 {
        let purpose = "shaft harmonics in a spectrum";
        return Err(SignalError::TooFewRevolutions { needed: 10.0, given: turns, purpose });
    }
    let mean = record.iter().sum::<f64>() / record.len() as f64;
    let centred: Vec<f64> = record.iter().map(|x| x - mean).collect();
    let spectrum = amplitude_spectrum(&centred, sample_rate, WindowKind::Hann, Level::Peak)?;
    let near = |speed: f64| {
        let lines = LineSpectrum::new(&spectrum, speed, None);
        family(&spectrum, &lines, speed, range)
    };
    if let Some(speed) = near(stated) {
        return Ok(SpeedFinding::Found(speed));
    }
    let elsewhere = OTHER_RATIOS.iter().filter_map(|ratio| {
        let turns_enough = turns * ratio >= 10.0;
        Some((*ratio, turns_enough.then(|| near(stated * ratio)).flatten()?))
    });
    let most = elsewhere.max_by_key(|(_, speed)| speed.harmonics);
    Ok(most.map_or(SpeedFinding::NotFound, |(ratio, speed)| SpeedFinding::Elsewhere { speed, ratio }))
}

/// The family of harmonics within ± `range` of a speed, if enough of them stand.
fn family(spectrum: &Spectrum, lines: &LineSpectrum, stated: f64, range: f64) -> Option<RecordSpeed> {
    let step = lines.step;
    let harmonics = HARMONICS.min((lines.end() / (stated * (1.0 + range))) as usize);
    let trial_step = step / HARMONICS as f64;
    let trials = (range * stated / trial_step).ceil() as i64;
    let score =
        |speed: f64| (1..=harmonics).map(|n| lines.evidence(n as f64 * speed).min(LIMIT)).sum::<f64>();
    let mut best = (f64::NEG_INFINITY, stated);
    for trial in (0..=trials).flat_map(|t| [t, -t]) {
        let speed = stated + trial as f64 * trial_step;
        let value = score(speed);
        if value > best.0 {
            best = (value, speed);
        }
    }
    let (_, speed) = best;
    let standing = (1..=harmonics).filter_map(|n| {
        let place = n as f64 * speed;
        if lines.evidence(place) < STANDS {
            return None;
        }
        let (at, amplitude) = lines.highest(place, 1.5 * step)?;
        let bin = (at / step).round() as usize;
        let peak = interpolate_peak(&spectrum.frequencies, &spectrum.values, bin);
        let ratio = lines.power_ratio(bin, amplitude);
        let deviation = step * (0.02 + 0.55 / ratio.sqrt()) / n as f64;
        Some((n, peak.position / n as f64, deviation))
    });
    let standing: Vec<(usize, f64, f64)> = standing.collect();
    if standing.len() < FAMILY || standing.iter().all(|(n, ..)| *n > 2) {
        return None;
    }
    let weights: f64 = standing.iter().map(|(.., s)| 1.0 / (s * s)).sum();
    let mean = standing.iter().map(|(_, f, s)| f / (s * s)).sum::<f64>() / weights;
    let scatter = standing.iter().map(|(_, f, s)| ((f - mean) / s).powi(2)).sum::<f64>();
    // Lines that scatter more than their noise: the speed is not as constant as that.
    let excess = (scatter / (standing.len() - 1) as f64).max(1.0);
    Some(RecordSpeed { speed: mean, uncertainty: (excess / weights).sqrt(), harmonics: standing.len() })
}
