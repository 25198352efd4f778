//! What is asked of a record.

use crate::signal::bearing_lines::LineSettings;
use crate::signal::diagnosis::BandRule;

/// Something that can be looked for in a record.
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
    /// Every analysis with its word.
    pub const ALL: [(Analysis, &'static str); 10] = [
        (Analysis::Spectrum, "spectrum"),
        (Analysis::Density, "psd"),
        (Analysis::Spectrogram, "spectrogram"),
        (Analysis::Envelope, "envelope"),
        (Analysis::Kurtogram, "kurtogram"),
        (Analysis::Cepstrum, "cepstrum"),
        (Analysis::Jerk, "jerk"),
        (Analysis::Orders, "orders"),
        (Analysis::Average, "average"),
        (Analysis::Cyclic, "cyclic"),
    ];

    /// Its word, "kurtogram".
    pub fn word(self) -> &'static str {
        Self::ALL[self as usize].1
    }
}

/// Which race jumps of the jerk are read for.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Race {
    #[default]
    Outer,
    Inner,
}

/// Which analyses are done.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum Wanted {
    /// What suits the record; what it does not allow is left out with a warning.
    #[default]
    Usual,
    /// All that the record allows.
    All,
    /// These, or an error.
    These(Vec<Analysis>),
}

/// What is looked for, and how.
#[derive(Clone, Debug, PartialEq)]
pub struct SignalSettings {
    pub analyses: Wanted,
    /// Band of the envelope; `None` takes the band that shows a bearing's lines best, without bearing that of the highest
    /// kurtosis.
    pub band: Option<BandRule>,
    /// Spacing of the density's lines \[Hz\]; `None` averages about fifteen segments.
    pub resolution: Option<f64>,
    /// Highest frequency of the spectrogram \[Hz\].
    pub max_frequency: Option<f64>,
    /// Spacing and highest of the orders; `None` goes to twice BPFI, or to 20.
    pub order_resolution: f64,
    pub max_order: Option<f64>,
    pub lines: LineSettings,
    pub race: Race,
    /// Time \[s\] on the channel's own axis at which a ball stands at angle 0 of the race and that angle lies along x.
    pub datum: f64,
}

impl Default for SignalSettings {
    fn default() -> Self {
        SignalSettings {
            analyses: Wanted::Usual,
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
