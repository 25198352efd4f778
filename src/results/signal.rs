//! What the analyses of one channel of a record give.

use crate::bearing::CharacteristicOrders;
use crate::signal::bearing_lines::{BearingLines, BearingPart};
use crate::signal::cepstrum::Cepstrum;
use crate::signal::cyclic::CyclicCoherence;
use crate::signal::diagnosis::BandRule;
use crate::signal::jerk::JerkJump;
use crate::signal::kurtogram::Kurtogram;
use crate::signal::order::{OrderCut, OrderSpectrogram};
use crate::signal::race_defects::{FoldedJerk, RaceDefect};
use crate::signal::spectrum::Spectrum;
use crate::signal::statistics::Statistics;
use crate::signal::stft::Spectrogram;
use crate::signal::synchronous::SynchronousAverage;

/// One channel, and what was found in it; a part that was not asked for is empty.
#[derive(Clone, Debug)]
pub struct SignalResult {
    pub channel: String,
    /// SI unit; empty where it is not known.
    pub unit: String,
    /// \[Hz\].
    pub sample_rate: f64,
    /// Time of the first sample \[s\].
    pub start: f64,
    /// The samples that were analysed.
    pub samples: Vec<f64>,
    pub shaft: Option<ShaftSummary>,
    /// Times \[s\] and speeds \[rpm\] at a few hundred places; empty where only the mean is known.
    pub speed: [Vec<f64>; 2],
    pub bearing: Option<RatedBearing>,
    pub statistics: Statistics,
    /// Amplitude spectrum of the whole record (Hann, peak).
    pub spectrum: Option<Spectrum>,
    /// Power spectral density \[unit²/Hz\].
    pub density: Option<Spectrum>,
    pub spectrogram: Option<SpectrogramOverTime>,
    pub envelope: Option<EnvelopeResult>,
    pub kurtogram: Option<KurtogramResult>,
    /// Real cepstrum.
    pub cepstrum: Option<Cepstrum>,
    pub jerk: Option<JerkResult>,
    pub orders: Option<ShaftOrders>,
    pub average: Option<ShaftAverage>,
    pub cyclic: Option<CyclicResult>,
    /// What the user should know, once each.
    pub warnings: Vec<String>,
}

/// How the shaft turned during a record.
#[derive(Clone, Debug, PartialEq)]
pub struct ShaftSummary {
    /// Where the speed comes from, in words.
    pub source: String,
    /// Speeds \[rev/s\].
    pub mean: f64,
    pub least: f64,
    pub most: f64,
    /// Whether rates are lines in Hz.
    pub steady: bool,
}

/// A bearing with its rates per turn of the shaft.
#[derive(Clone, Debug, PartialEq)]
pub struct RatedBearing {
    pub name: String,
    /// Where the rates come from, in words.
    pub source: String,
    pub orders: CharacteristicOrders,
    /// Number of balls Z.
    pub balls: usize,
    /// Radii of the raceways, inner and outer, (D_pw ∓ D_w cos α)/2 \[m\]; `None` where only rates are known.
    pub raceway_radii: Option<[f64; 2]>,
}

/// Amplitudes over time and frequency, with the speed at each time where it is known.
#[derive(Clone, Debug, PartialEq)]
pub struct SpectrogramOverTime {
    pub map: Spectrogram,
    /// \[rpm\]; empty where it is not known.
    pub rpm: Vec<f64>,
}

/// The envelope of a band, its spectrum, and the bearing's lines in it.
#[derive(Clone, Debug, PartialEq)]
pub struct EnvelopeResult {
    pub rule: BandRule,
    /// Band \[Hz\].
    pub band: (f64, f64),
    /// Amplitude spectrum \[unit\], over Hz, or over orders if the speed changes.
    pub spectrum: Spectrum,
    pub over_orders: bool,
    /// Value of every band that was compared.
    pub compared: Option<Kurtogram>,
    /// Lines and verdict where a bearing is known.
    pub lines: Option<BearingLines>,
}

/// Where in frequency the record is impulsive.
#[derive(Clone, Debug, PartialEq)]
pub struct KurtogramResult {
    pub kurtogram: Kurtogram,
    /// Spectral kurtosis over segments.
    pub spectral: Spectrum,
}

/// Jerk, and what its jumps say about a race.
#[derive(Clone, Debug)]
pub struct JerkResult {
    /// \[unit/s\].
    pub jerk: Vec<f64>,
    /// Jumps in the record as it is.
    pub jumps: Vec<JerkJump>,
    /// The jumps of all balls' passages laid over each other, and the defects read from them.
    pub race: Option<RaceResult>,
}

/// Defects of a race as its jerk jumps show them.
#[derive(Clone, Debug)]
pub struct RaceResult {
    /// "outer race" or "inner race".
    pub race: &'static str,
    /// Radius of the raceway \[m\].
    pub radius: Option<f64>,
    /// Whether two directions were given, so that angles are known all round.
    pub all_round: bool,
    pub fold: FoldedJerk,
    pub defects: Vec<RaceDefect>,
}

/// Orders of the shaft.
#[derive(Clone, Debug)]
pub struct ShaftOrders {
    pub map: OrderSpectrogram,
    /// Mean in power over all speeds.
    pub average: Vec<f64>,
    pub cuts: Vec<(super::OrderLine, OrderCut)>,
}

/// What repeats with the shaft's turn.
#[derive(Clone, Debug, PartialEq)]
pub struct ShaftAverage {
    pub average: SynchronousAverage,
    /// RMS of the record in angle, its mean taken away, of the average, and of what is left.
    pub rms: [f64; 3],
}

/// Which carriers are modulated at which rates.
#[derive(Clone, Debug)]
pub struct CyclicResult {
    pub coherence: CyclicCoherence,
    /// Mean coherence over the carriers, against the rate of modulation.
    pub enhanced: Spectrum,
    /// The bearing's first two harmonics in it; none without a bearing.
    pub lines: Vec<CyclicLine>,
    /// Seconds of the record that were used.
    pub duration: f64,
}

/// A rate of modulation near one that a bearing's part has.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CyclicLine {
    pub part: BearingPart,
    pub harmonic: usize,
    /// Rate by the catalogue, and of the highest coherence near it \[Hz\].
    pub expected: f64,
    pub rate: f64,
    /// Mean |γ| over the carriers there, and its median round about.
    pub coherence: f64,
    pub background: f64,
    /// Robust standard deviations of the background by which it stands out.
    pub deviations: f64,
}
