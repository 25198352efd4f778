//! Result of an output-only identification.

use std::f64::consts::TAU;

use rotordyn_linalg::Complex64;
use rotordyn_signal::record::Dof;

use crate::DiagramPole;
use crate::mac::mac_matrix;

/// A mode identified from responses alone; its modal mass is not known.
#[derive(Clone, Debug, PartialEq)]
pub struct OperationalMode {
    /// λ \[1/s\], Im λ > 0.
    pub pole: Complex64,
    /// ψ over the channels, its largest entry 1.
    pub shape: Vec<Complex64>,
    /// Standard error of the damped frequency \[Hz\].
    pub frequency_error: f64,
    /// Standard error of the damping ratio.
    pub damping_error: f64,
    /// Standard error of |ψ| along and across the shape's phase, as the root of their sum of squares.
    pub shape_error: Vec<f64>,
    /// Modal phase collinearity (MPC), 1 for a real mode.
    pub collinearity: f64,
    /// Whirl as of [`crate::Mode::whirl`].
    pub whirl: Option<f64>,
    /// Part of the energy of the correlations in the band; parts of close modes do not add up to 1.
    pub contribution: f64,
    /// Part of the model orders in which the pole is found.
    pub support: f64,
    /// State-space order at which the mode is taken.
    pub order: usize,
    /// What makes the mode doubtful.
    pub notes: Vec<String>,
}

impl OperationalMode {
    /// Damped frequency Im λ / 2π \[Hz\].
    pub fn frequency_hz(&self) -> f64 {
        self.pole.im / TAU
    }

    /// Damping ratio ζ = −Re λ / |λ|.
    pub fn damping_ratio(&self) -> f64 {
        -self.pole.re / self.pole.norm()
    }
}

/// Singular values of the spectral matrix over the frequency: frequency-domain decomposition (FDD).
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SpectralDecomposition {
    /// \[Hz\].
    pub frequencies: Vec<f64>,
    /// `values[k][line]`, largest first; channels in units of their RMS in the band \[1/Hz\].
    pub values: Vec<Vec<f64>>,
    pub peaks: Vec<SpectralPeak>,
}

/// A peak of the first singular value: a mode, a harmonic or a peak of the force.
#[derive(Clone, Debug, PartialEq)]
pub struct SpectralPeak {
    /// \[Hz\].
    pub frequency: f64,
    /// First singular vector there over the channels, its largest entry 1.
    pub shape: Vec<Complex64>,
    /// Height over the median of the surrounding lines \[dB\].
    pub height_db: f64,
    /// Whether a recognised harmonic is there.
    pub harmonic: bool,
}

/// A sine in the record.
#[derive(Clone, Debug, PartialEq)]
pub struct Harmonic {
    /// \[Hz\], the mean over the record.
    pub frequency: f64,
    /// Half the width of the line \[Hz\]: resolution, or wander of the speed.
    pub half_width: f64,
    /// Order of the shaft, if its motion is known.
    pub order: Option<f64>,
    /// Excess kurtosis of the record in the band of the line, −1.5 for a sine and 0 for noise.
    pub kurtosis: f64,
    /// Whether it was subtracted from the record.
    pub removed: bool,
}

/// Modes of a machine in operation, from responses alone.
#[derive(Clone, Debug, PartialEq)]
pub struct OperationalModes {
    /// In order of frequency.
    pub modes: Vec<OperationalMode>,
    pub dofs: Vec<Dof>,
    /// Indices of the reference channels.
    pub references: Vec<usize>,
    /// Band in which modes are taken \[Hz\].
    pub band: [f64; 2],
    /// Rate of the correlations \[Hz\], after decimation.
    pub sample_rate: f64,
    /// Duration of the record \[s\], without what is left out.
    pub duration: f64,
    /// Transient at the start that is left out \[s\].
    pub left_out: f64,
    /// Blocks of the standard errors, and their length \[s\].
    pub blocks: usize,
    pub block_length: f64,
    /// Longest lag of the correlations \[s\].
    pub longest_lag: f64,
    /// Mean shaft speed \[rev/s\], if known.
    pub shaft_speed: Option<f64>,
    pub spectrum: SpectralDecomposition,
    pub diagram: Vec<DiagramPole>,
    pub orders: Vec<usize>,
    pub harmonics: Vec<Harmonic>,
    /// Stable poles that are no modes, with the reason.
    pub dropped: Vec<String>,
    pub warnings: Vec<String>,
}

impl OperationalModes {
    /// AutoMAC: MAC of every mode with every other.
    pub fn auto_mac(&self) -> Vec<Vec<f64>> {
        let shapes: Vec<&[Complex64]> = self.modes.iter().map(|m| &m.shape[..]).collect();
        mac_matrix(&shapes, &shapes)
    }
}
