//! Results of a signal analysis of one channel.

use rotordyn_bearing::CharacteristicOrders;
use rotordyn_signal::bearing_lines::{BearingLines, BearingPart};
use rotordyn_signal::cepstrum::Cepstrum;
use rotordyn_signal::cyclic::CyclicCoherence;
use rotordyn_signal::diagnosis::BandRule;
use rotordyn_signal::jerk::JerkJump;
use rotordyn_signal::kurtogram::Kurtogram;
use rotordyn_signal::order::{OrderCut, OrderSpectrogram};
use rotordyn_signal::race_defects::{FoldedJerk, RaceDefect};
use rotordyn_signal::spectrum::Spectrum;
use rotordyn_signal::statistics::Statistics;
use rotordyn_signal::stft::Spectrogram;
use rotordyn_signal::synchronous::SynchronousAverage;

/// Results of one channel; analyses not requested are empty.
#[derive(Clone, Debug)]
pub struct SignalResult {
    pub channel: String,
    /// SI unit; empty if unknown.
    pub unit: String,
    /// \[Hz\].
    pub sample_rate: f64,
    /// Time of the first sample \[s\].
    pub start: f64,
    /// The analysed samples.
    pub samples: Vec<f64>,
    pub shaft: Option<ShaftSummary>,
    /// Times \[s\] and speeds \[rpm\] at some 200 instants; empty if only the mean is known.
    pub speed: [Vec<f64>; 2],
    pub bearing: Option<BearingWithOrders>,
    pub statistics: Statistics,
    /// Amplitude spectrum of the whole record (Hann, peak).
    pub spectrum: Option<Spectrum>,
    /// Power spectral density \[unit²/Hz\].
    pub density: Option<Spectrum>,
    pub spectrogram: Option<SpectrogramWithSpeed>,
    pub envelope: Option<EnvelopeResult>,
    pub kurtogram: Option<KurtogramResult>,
    /// Real cepstrum.
    pub cepstrum: Option<Cepstrum>,
    pub jerk: Option<JerkResult>,
    pub orders: Option<ShaftOrders>,
    pub average: Option<ShaftAverage>,
    pub cyclic: Option<CyclicResult>,
    /// Warnings for the user, once each.
    pub warnings: Vec<String>,
}

/// Shaft speed during a record.
#[derive(Clone, Debug, PartialEq)]
pub struct ShaftSummary {
    /// Description of the speed's source.
    pub source: String,
    /// Speeds \[rev/s\].
    pub mean: f64,
    pub min: f64,
    pub max: f64,
    /// Whether the speed is constant within the tolerance: frequencies in Hz instead of orders.
    pub steady: bool,
}

/// A bearing with its characteristic orders (per shaft revolution).
#[derive(Clone, Debug, PartialEq)]
pub struct BearingWithOrders {
    pub name: String,
    /// Description of the orders' source.
    pub source: String,
    pub orders: CharacteristicOrders,
    /// Number of balls Z.
    pub balls: usize,
    /// Radii of the raceways, inner and outer, (D_pw ∓ D_w cos α)/2 \[m\]; `None` if only orders are known.
    pub raceway_radii: Option<[f64; 2]>,
}

/// Amplitudes over time and frequency, with the speed at each time if known.
#[derive(Clone, Debug, PartialEq)]
pub struct SpectrogramWithSpeed {
    pub map: Spectrogram,
    /// \[rpm\]; empty if unknown.
    pub rpm: Vec<f64>,
}

/// Envelope (demodulated) spectrum of a band, and the bearing's lines in it.
#[derive(Clone, Debug, PartialEq)]
pub struct EnvelopeResult {
    pub rule: BandRule,
    /// Band \[Hz\].
    pub band: (f64, f64),
    /// Amplitude spectrum \[unit\], over Hz, or over orders at varying speed.
    pub spectrum: Spectrum,
    pub over_orders: bool,
    /// Score of every candidate band.
    pub band_scores: Option<Kurtogram>,
    /// Lines and diagnosis if a bearing is known.
    pub lines: Option<BearingLines>,
}

/// Impulsiveness over frequency: kurtogram and spectral kurtosis.
#[derive(Clone, Debug, PartialEq)]
pub struct KurtogramResult {
    pub kurtogram: Kurtogram,
    /// Spectral kurtosis over segments.
    pub spectral: Spectrum,
}

/// Jerk, its jumps, and the race defects located from them.
#[derive(Clone, Debug)]
pub struct JerkResult {
    /// \[unit/s\].
    pub jerk: Vec<f64>,
    /// Jumps in the unfolded record.
    pub jumps: Vec<JerkJump>,
    /// The jerk folded over the ball passages, and the defects located from it.
    pub race: Option<RaceResult>,
}

/// Defects of a race located from jerk jumps.
#[derive(Clone, Debug)]
pub struct RaceResult {
    /// "outer race" or "inner race".
    pub race: &'static str,
    /// Radius of the raceway \[m\].
    pub radius: Option<f64>,
    /// Whether two directions were given, so that angles are known over the full circumference.
    pub full_circumference: bool,
    pub fold: FoldedJerk,
    pub defects: Vec<RaceDefect>,
}

/// Order tracking: map, mean order spectrum and cuts.
#[derive(Clone, Debug)]
pub struct ShaftOrders {
    pub map: OrderSpectrogram,
    /// Power average over all speeds.
    pub average: Vec<f64>,
    pub cuts: Vec<(super::OrderLine, OrderCut)>,
}

/// Time synchronous average (TSA) over shaft revolutions.
#[derive(Clone, Debug, PartialEq)]
pub struct ShaftAverage {
    pub average: SynchronousAverage,
    /// RMS (means removed) of the record resampled in angle, of the average, and of the residual.
    pub rms: [f64; 3],
}

/// Cyclic spectral coherence over carrier and modulation frequency.
#[derive(Clone, Debug)]
pub struct CyclicResult {
    pub coherence: CyclicCoherence,
    /// Enhanced envelope spectrum: mean coherence over the carriers, over modulation frequency.
    pub enhanced: Spectrum,
    /// The bearing's first two harmonics in it; none without a bearing.
    pub lines: Vec<CyclicLine>,
    /// Duration of the analysed part \[s\].
    pub duration: f64,
}

/// A peak of the enhanced envelope spectrum near a characteristic frequency.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CyclicLine {
    pub part: BearingPart,
    pub harmonic: usize,
    /// Nominal characteristic frequency, and frequency of the highest coherence near it \[Hz\].
    pub expected: f64,
    pub rate: f64,
    /// Mean |γ| over the carriers there, and its median in the neighbourhood.
    pub coherence: f64,
    pub background: f64,
    /// Excess over the background in robust standard deviations.
    pub deviations: f64,
}
