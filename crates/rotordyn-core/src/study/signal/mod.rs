//! Signal analysis of a measured or computed record with the tools of [`rotordyn_signal`].

mod cyclic;
mod jerk;
mod orders;
mod shaft;

pub use shaft::ShaftMotion;

use crate::results::{
    BearingWithOrders, EnvelopeResult, KurtogramResult, OrderLine, SignalResult, SpectrogramWithSpeed,
};
use rotordyn_signal::bearing_lines::{DefectFrequencies, LineSettings};
use rotordyn_signal::cepstrum::real_cepstrum;
use rotordyn_signal::diagnosis::{BandRule, ShaftRotation, band_envelope, diagnose};
use rotordyn_signal::dropout::{Dropout, dropouts};
use rotordyn_signal::filter_bank::max_depth;
use rotordyn_signal::grading::{SpeedFinding, shaft_speed};
use rotordyn_signal::kurtogram::{fast_kurtogram, spectral_kurtosis};
use rotordyn_signal::spectrum::{Level, Welch, amplitude_spectrum, power_spectral_density};
use rotordyn_signal::statistics::statistics;
use rotordyn_signal::stft::{Stft, StftSettings};
use rotordyn_signal::{SignalError, WindowKind};

/// Deepest level of a kurtogram: 128 bands.
const MAX_LEVEL: usize = 7;
/// Default highest order.
const DEFAULT_MAX_ORDER: f64 = 20.0;
/// Speed below which the shaft counts as stationary \[rev/s\].
const MIN_SPEED: f64 = 0.1;

/// One kind of analysis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Analysis {
    Spectrum,
    Density,
    Spectrogram,
    Envelope,
    Kurtogram,
    Cepstrum,
    Jerk,
    Orders,
    Average,
    Cyclic,
}

impl Analysis {
    /// Every analysis with its keyword.
    pub const ALL: [(Analysis, &'static str); 10] = [
        (Analysis::Spectrum, "spectrum"),
        (Analysis::Density, "psd"),
        (Analysis::Spectrogram, "spectrogram"),
        (Analysis::Envelope, "envelope"),
        (Analysis::Kurtogram, "kurtogram"),
        (Analysis::Cepstrum, "cepstrum"),
        (Analysis::Jerk, "jerk"),
        (Analysis::Orders, "orders"),
        (Analysis::Average, "synchronous-average"),
        (Analysis::Cyclic, "cyclic-coherence"),
    ];

    /// Its keyword, such as "kurtogram".
    pub fn keyword(self) -> &'static str {
        Self::ALL[self as usize].1
    }
}

/// Race whose defects are located from the jerk.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Race {
    #[default]
    Outer,
    Inner,
}

/// Selection of analyses.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum AnalysisSelection {
    /// Those suited to the record (default); impossible ones are omitted with a warning.
    #[default]
    Suitable,
    /// All that are possible with the record.
    All,
    /// Exactly these; an impossible one is an error.
    Only(Vec<Analysis>),
}

/// Analyses and their settings.
#[derive(Clone, Debug, PartialEq)]
pub struct SignalSettings {
    pub analyses: AnalysisSelection,
    /// Rule for the demodulation band of the envelope; `None`: the band with the strongest bearing lines,
    /// without bearing that of the highest kurtosis.
    pub band: Option<BandRule>,
    /// Frequency resolution of the PSD \[Hz\]; `None` averages about fifteen segments.
    pub resolution: Option<f64>,
    /// Highest frequency of the spectrogram \[Hz\].
    pub max_frequency: Option<f64>,
    /// Resolution and highest order of order tracking; `None`: 2.2 BPFI, at least 20.
    pub order_resolution: f64,
    pub max_order: Option<f64>,
    /// Lines of the order cuts; none: 1x, 2x and the bearing's characteristic orders.
    pub orders: Vec<OrderLine>,
    /// −3 dB bandwidth \[orders\] in which the Vold-Kalman filter tracks them; `None`: not tracked.
    pub bandwidth: Option<f64>,
    pub lines: LineSettings,
    /// Range about a stated steady speed, relative, in which the record's own speed is searched; 0: not searched.
    pub speed_range: f64,
    pub race: Race,
    /// Time \[s\] on the channel's time axis at which a ball is at angle 0 of the race and that angle lies
    /// along x.
    pub datum: f64,
}

impl Default for SignalSettings {
    fn default() -> Self {
        SignalSettings {
            analyses: AnalysisSelection::Suitable,
            band: None,
            resolution: None,
            max_frequency: None,
            order_resolution: 0.05,
            max_order: None,
            orders: Vec::new(),
            bandwidth: None,
            lines: LineSettings::default(),
            speed_range: 0.02,
            race: Race::Outer,
            datum: 0.0,
        }
    }
}

/// One channel of a record.
#[derive(Clone, Debug, PartialEq)]
pub struct SignalChannel {
    pub name: String,
    /// SI unit; empty if unknown.
    pub unit: String,
    /// \[Hz\].
    pub sample_rate: f64,
    /// Time of the first sample \[s\].
    pub start: f64,
    pub samples: Vec<f64>,
    /// Second channel at the same place, 90° from the first (x to y), to locate defects over the full race.
    pub orthogonal: Option<Vec<f64>>,
}

/// All requested analyses of one channel.
///
/// `shaft`: speeds and angles from the channel's first sample on; with an angle only the samples it covers
/// are used.
/// `bearing`: characteristic orders. Statistics are always computed. A default analysis that the record does
/// not allow becomes a warning; a requested one is an error. A dead channel has no diagnosis of a bearing, with a warning.
/// Errors: NaN; a record too short, too slowly sampled or without the shaft data for a requested analysis (or
/// the envelope of a bearing).
pub fn analyse(
    channel: &SignalChannel,
    shaft: Option<&ShaftMotion>,
    bearing: Option<&BearingWithOrders>,
    settings: &SignalSettings,
) -> Result<SignalResult, SignalError> {
    let mut job = Job::new(channel, shaft, bearing, settings);
    job.record_speed = job.search_speed()?;
    let mut out = SignalResult {
        channel: channel.name.clone(),
        unit: channel.unit.clone(),
        sample_rate: channel.sample_rate,
        start: channel.start + job.first as f64 / channel.sample_rate,
        samples: job.x.to_vec(),
        shaft: shaft.map(|s| s.summary.clone()),
        record_speed: job.record_speed,
        speed: shaft.map_or_else(Default::default, |s| s.speeds(channel.sample_rate, channel.start)),
        bearing: bearing.cloned(),
        statistics: statistics(job.x)?,
        ..SignalResult::default()
    };
    let dead = bearing.and_then(|_| dead_text(job.x));
    for analysis in job.selected_analyses() {
        if let Some(reason) = dead.as_ref().filter(|_| analysis == Analysis::Envelope) {
            out.warnings.push(format!("{}: no bearing diagnosis: {reason}", channel.name));
            continue;
        }
        let Err(error) = job.perform(analysis, &mut out) else { continue };
        // The envelope is the main analysis of a bearing: always required.
        let asked = matches!(settings.analyses, AnalysisSelection::Only(_))
            || (analysis == Analysis::Envelope && bearing.is_some());
        if asked {
            return Err(error);
        }
        out.warnings.push(format!("{}: {} omitted: {error}", channel.name, analysis.keyword()));
    }
    Ok(out)
}

/// Why a channel says nothing of a bearing: one value in all of its samples, or in most; `None` if it may.
pub fn dead_text(samples: &[f64]) -> Option<String> {
    dropouts(samples).into_iter().find_map(|found| match found {
        Dropout::Constant(value) => Some(format!("the channel is {value} throughout: the sensor is dead")),
        Dropout::Held { samples: held, value, .. } if 2 * held >= samples.len() => Some(format!(
            "{held} of its {} samples in succession are {value}: the sensor is dead",
            samples.len()
        )),
        _ => None,
    })
}

/// Data shared by all analyses of a channel.
struct Job<'a> {
    /// The analysed samples, and the index of the first in the channel.
    x: &'a [f64],
    first: usize,
    rate: f64,
    channel: &'a SignalChannel,
    shaft: Option<&'a ShaftMotion>,
    bearing: Option<&'a BearingWithOrders>,
    settings: &'a SignalSettings,
    /// Speed that the record shows, for the bearing's lines.
    record_speed: Option<SpeedFinding>,
}

impl<'a> Job<'a> {
    fn new(
        channel: &'a SignalChannel,
        shaft: Option<&'a ShaftMotion>,
        bearing: Option<&'a BearingWithOrders>,
        settings: &'a SignalSettings,
    ) -> Self {
        let whole = &channel.samples[..];
        let (first, x) = match shaft.filter(|s| !s.angle.is_empty()) {
            Some(s) => (s.first, &whole[s.first..(s.first + s.angle.len()).min(whole.len())]),
            None => (0, whole),
        };
        Job { x, first, rate: channel.sample_rate, channel, shaft, bearing, settings, record_speed: None }
    }

    fn selected_analyses(&self) -> Vec<Analysis> {
        use Analysis::*;
        match &self.settings.analyses {
            AnalysisSelection::Only(asked) => return asked.clone(),
            AnalysisSelection::All => return Analysis::ALL.iter().map(|(analysis, _)| *analysis).collect(),
            AnalysisSelection::Suitable => {}
        }
        let mut wanted = vec![Spectrum, Density, Envelope, Kurtogram, Cepstrum];
        if let Some(shaft) = self.shaft.filter(|s| !s.angle.is_empty()) {
            if !shaft.summary.steady {
                wanted.push(Spectrogram);
            }
            wanted.extend([Orders, Average]);
        }
        wanted
    }

    /// Shaft angle at the analysed samples.
    fn angle(&self, purpose: &'static str) -> Result<&'a [f64], SignalError> {
        let angle = self.shaft.map_or(&[][..], |s| &s.angle);
        match angle.is_empty() {
            true => Err(SignalError::Unknown { what: "the shaft's angle", purpose }),
            false => Ok(&angle[..self.x.len()]),
        }
    }

    /// Mean speed \[rev/s\], if constant.
    fn steady_speed(&self, purpose: &'static str) -> Result<f64, SignalError> {
        match self.shaft {
            Some(s) if s.summary.steady => Ok(s.summary.mean),
            _ => Err(SignalError::Unknown { what: "a steady speed of the shaft", purpose }),
        }
    }

    /// Speed of the record's own shaft harmonics: a bearing at a stated speed, without a shaft angle.
    fn search_speed(&self) -> Result<Option<SpeedFinding>, SignalError> {
        let stated = self.shaft.filter(|s| s.summary.steady && s.angle.is_empty());
        let (Some(shaft), Some(bearing), true) = (stated, self.bearing, self.settings.speed_range > 0.0)
        else {
            return Ok(None);
        };
        let (stated, range) = (shaft.summary.mean, self.settings.speed_range);
        let rates = characteristic_rates(bearing, stated);
        match shaft_speed(self.x, self.rate, stated, range, Some(&rates)) {
            // Too short for the search: the stated speed stands.
            Err(SignalError::TooFewRevolutions { .. }) => Ok(None),
            found => found.map(Some),
        }
    }

    /// Characteristic frequencies of the bearing at constant speed, else orders; with the shaft rotation.
    fn rates(&self) -> Option<(DefectFrequencies, ShaftRotation<'a>)> {
        let bearing = self.bearing?;
        let (unit, turning) = self.rate_reference()?;
        Some((characteristic_rates(bearing, unit), turning))
    }

    /// Reference of the characteristic rates: shaft speed \[Hz\] at constant speed, else order 1 over the
    /// shaft angle.
    fn rate_reference(&self) -> Option<(f64, ShaftRotation<'a>)> {
        let shaft = self.shaft?;
        Some(match shaft.summary.steady {
            true => match self.record_speed {
                Some(SpeedFinding::Found(found)) => (found.speed, ShaftRotation::ConstantSpeed),
                _ => (shaft.summary.mean, ShaftRotation::ConstantSpeed),
            },
            false => (1.0, ShaftRotation::Angle(&shaft.angle[..self.x.len()])),
        })
    }

    fn perform(&self, analysis: Analysis, out: &mut SignalResult) -> Result<(), SignalError> {
        match analysis {
            Analysis::Spectrum => {
                out.spectrum = Some(amplitude_spectrum(self.x, self.rate, WindowKind::Hann, Level::Peak)?);
            }
            Analysis::Density => {
                out.density = Some(power_spectral_density(self.x, self.rate, &self.welch()?)?);
            }
            Analysis::Spectrogram => out.spectrogram = Some(self.spectrogram()?),
            Analysis::Envelope => out.envelope = Some(self.envelope()?),
            Analysis::Kurtogram => out.kurtogram = Some(self.kurtogram()?),
            Analysis::Cepstrum => out.cepstrum = Some(real_cepstrum(self.x, self.rate)?),
            Analysis::Jerk => out.jerk = Some(self.jerk()?),
            Analysis::Orders => {
                let found = self.orders()?;
                out.orders = Some(found);
            }
            Analysis::Average => out.average = Some(self.average()?),
            Analysis::Cyclic => out.cyclic = Some(self.cyclic()?),
        }
        Ok(())
    }

    fn welch(&self) -> Result<Welch, SignalError> {
        let samples = self.x.len();
        let segment = match self.settings.resolution {
            Some(resolution) => (self.rate / resolution).round() as usize,
            // Half overlap: fifteen segments.
            None => 1 << (samples / 8).max(16).ilog2(),
        };
        if segment > samples {
            let purpose = "one segment of this resolution";
            return Err(SignalError::TooShort { name: "record", needed: segment, given: samples, purpose });
        }
        Ok(Welch::hann(segment.max(2)))
    }

    fn spectrogram(&self) -> Result<SpectrogramWithSpeed, SignalError> {
        let frame = 1 << (self.x.len() / 64).clamp(256, 8192).ilog2();
        let settings = StftSettings::new(WindowKind::Hann, frame, 0.75)?;
        let mut map = Stft::new(settings, self.rate)?.spectrogram(self.x)?;
        // At varying speed up to the highest order.
        let changing = self.shaft.filter(|s| !s.summary.steady);
        let orders = changing.map(|s| 1.1 * self.max_order() * s.summary.max);
        if let Some(limit) = self.settings.max_frequency.or(orders) {
            let bins = map.frequencies.len();
            let kept = map.frequencies.partition_point(|f| *f <= limit).max(2);
            map.amplitude =
                map.amplitude.chunks_exact(bins).flat_map(|row| row[..kept].iter().copied()).collect();
            map.frequencies.truncate(kept);
        }
        let rpm = match self.shaft {
            Some(shaft) if !shaft.angle.is_empty() => {
                // The mean over a frame.
                let turns = |k: usize| shaft.angle[k.min(self.x.len() - 1)] / std::f64::consts::TAU;
                let hop = settings.hop;
                let speed = |k: usize| (turns(k * hop + frame) - turns(k * hop)) * self.rate / frame as f64;
                (0..map.times.len()).map(|k| 60.0 * speed(k).abs()).collect()
            }
            _ => Vec::new(),
        };
        map.times.iter_mut().for_each(|t| *t += self.channel.start + self.first as f64 / self.rate);
        Ok(SpectrogramWithSpeed { map, rpm })
    }

    fn envelope(&self) -> Result<EnvelopeResult, SignalError> {
        let over_orders = self.shaft.is_some_and(|s| !s.summary.steady);
        let Some((rates, turning)) = self.rates() else {
            let rule = self.settings.band.unwrap_or(BandRule::Kurtosis);
            let (_, turning) = self.rate_reference().unwrap_or((1.0, ShaftRotation::ConstantSpeed));
            let found = band_envelope(self.x, self.rate, turning, rule, DEFAULT_MAX_ORDER)?;
            return Ok(EnvelopeResult {
                rule,
                band: found.band,
                spectrum: found.envelope,
                over_orders,
                band_scores: found.kurtogram,
                lines: None,
                graded: None,
            });
        };
        let rule = self.settings.band.unwrap_or(BandRule::Lines);
        let found = diagnose(self.x, self.rate, turning, &rates, rule, &self.settings.lines)?;
        Ok(EnvelopeResult {
            rule,
            band: found.band,
            spectrum: found.envelope,
            over_orders,
            band_scores: found.kurtogram,
            lines: Some(found.lines),
            graded: Some(found.graded),
        })
    }

    fn kurtogram(&self) -> Result<KurtogramResult, SignalError> {
        let depth = max_depth(self.x.len()).clamp(1, MAX_LEVEL);
        // Segments shorter than the time between pulses.
        let fastest = self.rates().filter(|_| self.shaft.is_some_and(|s| s.summary.steady));
        let segment = fastest.map_or(128.0, |(rates, _)| 0.5 * self.rate / rates.inner);
        let segment = 2 * (0.5 * segment.clamp(32.0, 1024.0)) as usize;
        let welch = Welch { overlap: segment - segment / 4, ..Welch::hann(segment) };
        Ok(KurtogramResult {
            kurtogram: fast_kurtogram(self.x, self.rate, depth)?,
            spectral: spectral_kurtosis(self.x, self.rate, &welch)?,
        })
    }
}

/// Characteristic rates of a bearing at shaft rate `unit`.
fn characteristic_rates(bearing: &BearingWithOrders, unit: f64) -> DefectFrequencies {
    let orders = bearing.orders;
    DefectFrequencies {
        shaft: unit,
        cage: unit * orders.ftf,
        outer: unit * orders.bpfo,
        inner: unit * orders.bpfi,
        ball: unit * orders.bsf,
    }
}
