//! Settings of a signal analysis.

use rotordyn_signal::bearing_lines::LineSettings;
use rotordyn_signal::diagnosis::BandRule;

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
    pub lines: LineSettings,
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
            lines: LineSettings::default(),
            race: Race::Outer,
            datum: 0.0,
        }
    }
}
