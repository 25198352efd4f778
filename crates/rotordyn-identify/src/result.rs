//! Result of a modal identification.

use super::frf_power::{noise_rms, rms};
use rotordyn_linalg::Complex64;
use rotordyn_signal::Quantity;
use rotordyn_signal::record::Dof;
use std::f64::consts::TAU;
use std::fmt::{self, Display, Formatter};

/// One identified mode.
#[derive(Clone, Debug, PartialEq)]
pub struct Mode {
    /// λ \[1/s\], Im λ > 0.
    pub pole: Complex64,
    /// ψ over [`ModalIdentification::responses`]; ψ lᵀ is the residue of the receptance
    /// \[m/(N s) for a displacement under a force\].
    pub shape: Vec<Complex64>,
    /// l over [`ModalIdentification::references`].
    pub participation: Vec<Complex64>,
    /// Standard error of the damped frequency \[Hz\].
    pub frequency_error: f64,
    /// Standard error of the damping ratio.
    pub damping_error: f64,
    /// Standard deviation of √(1 − MAC) of the vector over the side with more DOFs, by its error; at most 1.
    /// Of an uncertain shape of low phase collinearity the out-of-phase part counts as error; of a doubtful mode, the distance to
    /// what it may be instead, and √½ of a pole that is not refined.
    pub shape_error: f64,
    /// Modal phase collinearity (MPC) of the side with more DOFs, 1 for a real mode.
    pub collinearity: f64,
    /// Whirl at the points measured along x and y: 1 forward circular (x towards y), 0 planar, −1 backward
    /// circular; `None` if no point has both.
    pub whirl: Option<f64>,
    /// F statistic of the mode: variance that it explains over residual variance.
    pub significance: f64,
    /// What makes the mode doubtful; empty for a mode beyond doubt.
    pub quality_warnings: Vec<QualityWarning>,
}

/// What makes a mode doubtful.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum QualityWarning {
    /// Two close modes fit the FRFs better than this one: two modes, or one that differs between the FRFs.
    MaybeTwo,
    /// With its close neighbour it may be one mode that differs between the FRFs.
    MaybeOne,
    /// Refinement leads away from the stable pole of the stabilisation diagram, which was kept.
    Held,
    /// Phase collinearity (MPC) below 0.7 without whirl.
    LowCollinearity,
}

impl QualityWarning {
    /// Label.
    pub fn label(self) -> &'static str {
        match self {
            QualityWarning::MaybeTwo => "maybe two modes",
            QualityWarning::MaybeOne => "maybe one with its neighbour",
            QualityWarning::Held => "stable pole, not refined",
            QualityWarning::LowCollinearity => "low phase collinearity",
        }
    }
}

/// A stable pole that is no mode, with the reason.
#[derive(Clone, Debug, PartialEq)]
pub struct DroppedPole {
    /// λ \[1/s\], without correction for an exponential window.
    pub value: Complex64,
    pub reason: String,
}

impl Display for DroppedPole {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let (hz, damping) = (self.value.im / TAU, -100.0 * self.value.re / self.value.norm());
        write!(f, "{hz:.3} Hz, damping {damping:.3} %: {}", self.reason)
    }
}

impl Mode {
    /// Damped frequency Im λ / 2π \[Hz\].
    pub fn frequency_hz(&self) -> f64 {
        self.pole.im / TAU
    }

    /// Natural (undamped) frequency |λ| / 2π \[Hz\].
    pub fn natural_frequency_hz(&self) -> f64 {
        self.pole.norm() / TAU
    }

    /// Damping ratio ζ = −Re λ / |λ|.
    pub fn damping_ratio(&self) -> f64 {
        -self.pole.re / self.pole.norm()
    }
}

/// Stability of a pole relative to the next lower order.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stability {
    /// No pole within 1 % of its frequency.
    New,
    /// Within 1 % in frequency.
    Frequency,
    /// In frequency, and within 5 % in damping.
    Damping,
    /// In frequency, and MAC above 0.95.
    Shape,
    /// In frequency, damping and shape.
    Stable,
}

impl Stability {
    /// Label.
    pub fn label(self) -> &'static str {
        match self {
            Stability::New => "new",
            Stability::Frequency => "frequency",
            Stability::Damping => "frequency and damping",
            Stability::Shape => "frequency and shape",
            Stability::Stable => "stable",
        }
    }
}

/// A pole of the stabilisation diagram.
#[derive(Clone, Debug, PartialEq)]
pub struct DiagramPole {
    pub order: usize,
    /// λ \[1/s\], without correction for an exponential window.
    pub value: Complex64,
    pub stability: Stability,
}

/// Result of modal identification: identified modes, synthesised FRFs, stabilisation diagram.
#[derive(Clone, Debug)]
pub struct ModalIdentification {
    /// In order of frequency.
    pub modes: Vec<Mode>,
    pub responses: Vec<Dof>,
    pub references: Vec<Dof>,
    /// Quantity assumed for the measured FRFs.
    pub quantity: Quantity,
    /// Lines in the band \[Hz\].
    pub frequencies: Vec<f64>,
    /// `measured[response][reference][line]` in the band, converted to one quantity.
    pub measured: Vec<Vec<Vec<Complex64>>>,
    /// FRFs synthesised from the modal model, with the same indices.
    pub synthesised: Vec<Vec<Vec<Complex64>>>,
    /// ‖measured − synthesised‖ / ‖measured‖ of every FRF.
    pub errors: Vec<Vec<f64>>,
    /// Root mean square of the errors of all FRFs that are above noise ([`Self::noise_only`]); of all if none is.
    pub total_error: f64,
    /// Upper residual U (stiffness of modes above), lower residual V (mass of modes below) of receptances.
    pub upper: Vec<Vec<f64>>,
    pub lower: Vec<Vec<f64>>,
    pub diagram: Vec<DiagramPole>,
    pub orders: Vec<usize>,
    /// Stable poles that were rejected afterwards.
    pub dropped: Vec<DroppedPole>,
    /// Bands that were identified one by one \[Hz\]; one band unless the record holds too much for one.
    pub bands: Vec<[f64; 2]>,
}

impl ModalIdentification {
    /// The side of the test with more DOFs, and a mode's vector over it, for display and comparison.
    ///
    /// In a roving-hammer test these are the references.
    pub fn larger_side_shape<'a>(&'a self, mode: &'a Mode) -> (&'a [Dof], &'a [Complex64]) {
        if self.references.len() > self.responses.len() {
            (&self.references, &mode.participation)
        } else {
            (&self.responses, &mode.shape)
        }
    }

    /// FRFs of noise alone, by response and reference: their noise has more power than all else in them.
    pub fn noise_only(&self) -> Vec<(usize, usize)> {
        let all = self.measured.iter().enumerate();
        let frfs = all.flat_map(|(r, row)| row.iter().enumerate().map(move |(e, frf)| ((r, e), frf)));
        frfs.filter(|(_, frf)| is_noise(frf)).map(|(place, _)| place).collect()
    }

    /// AutoMAC: MAC of every mode with every other, over the side with more DOFs.
    pub fn auto_mac(&self) -> Vec<Vec<f64>> {
        let shapes: Vec<&[Complex64]> = self.modes.iter().map(|m| self.larger_side_shape(m).1).collect();
        super::mac::mac_matrix(&shapes, &shapes)
    }
}

/// Relative fit error of an FRF: RMS of measured minus model, over that of the measured one; 0 for an FRF of zeros.
pub(super) fn fit_error(measured: &[Complex64], model: &[Complex64]) -> f64 {
    let (mut rest, mut all) = (0.0, 0.0);
    for (h, m) in measured.iter().zip(model) {
        rest += (h - m).norm_sqr();
        all += h.norm_sqr();
    }
    if all > 0.0 { (rest / all).sqrt() } else { 0.0 }
}

/// Whether an FRF is noise for more than half of its power, by its scatter from line to line.
fn is_noise(frf: &[Complex64]) -> bool {
    let all = rms(frf);
    all > 0.0 && 2.0 * noise_rms(frf).powi(2) > all * all
}

/// RMS of the fit errors of the FRFs that are above noise, of all if none is.
pub(super) fn total_error(errors: &[Vec<f64>], measured: &[Vec<Vec<Complex64>>]) -> f64 {
    let mean_square = |of: &dyn Fn(&[Complex64]) -> bool| {
        let frfs = errors.iter().flatten().zip(measured.iter().flatten()).filter(|(_, frf)| of(frf));
        let (sum, count) = frfs.fold((0.0, 0), |(sum, count), (e, _)| (sum + e * e, count + 1));
        (count > 0).then(|| sum / f64::from(count))
    };
    let above = mean_square(&|frf| !is_noise(frf)).or_else(|| mean_square(&|_| true));
    above.unwrap_or(0.0).sqrt()
}
