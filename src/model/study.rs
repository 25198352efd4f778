//! What a model file asks to be computed.

pub use super::steady_study::*;
use super::{Probe, Quantity};
use crate::element::Anchor;
pub use crate::signal::WindowKind;

/// The studies a model file asks for, each with its settings; `None` means not asked for.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct Studies {
    pub equilibrium: Option<EquilibriumStudy>,
    pub modal: Option<ModalStudy>,
    pub campbell: Option<CampbellStudy>,
    pub critical: Option<CriticalStudy>,
    pub frf: Option<FrfStudy>,
    pub unbalance: Option<UnbalanceStudy>,
    pub run_up: Option<RunUpStudy>,
    pub spectrogram: Option<SpectrogramStudy>,
    pub orders: Option<OrderStudy>,
    pub poincare: Option<PoincareStudy>,
    pub lyapunov: Option<LyapunovStudy>,
    pub bifurcation: Option<BifurcationStudy>,
}

/// Static equilibrium.
#[derive(Clone, Debug, PartialEq)]
pub struct EquilibriumStudy {
    /// Speed \[rad/s\].
    pub speed: f64,
    /// Average bearing forces over one ball pitch of cage angles instead of the cage angle in the model.
    pub cage_average: bool,
}

/// Natural frequencies and mode shapes at given speeds.
#[derive(Clone, Debug, PartialEq)]
pub struct ModalStudy {
    /// Speeds \[rad/s\].
    pub speeds: Vec<f64>,
    /// Number of modes.
    pub modes: usize,
}

/// Linear Campbell diagram.
#[derive(Clone, Debug, PartialEq)]
pub struct CampbellStudy {
    /// Speeds \[rad/s\], increasing.
    pub speeds: Vec<f64>,
    pub modes: usize,
    /// Order lines to draw, and to intersect for critical speeds.
    pub orders: Vec<f64>,
    /// Recompute the equilibrium and bearing stiffness at every speed instead of once.
    pub follow_bearings: bool,
}

/// Critical speeds.
#[derive(Clone, Debug, PartialEq)]
pub struct CriticalStudy {
    /// Highest speed searched \[rad/s\].
    pub max_speed: f64,
    /// Orders whose crossings are listed; 1 is the synchronous one.
    pub orders: Vec<f64>,
}

/// Frequency response functions at a fixed speed.
#[derive(Clone, Debug, PartialEq)]
pub struct FrfStudy {
    /// Speed \[rad/s\].
    pub speed: f64,
    /// Frequencies \[Hz\].
    pub frequencies: Vec<f64>,
    pub excitations: Vec<Excitation>,
    pub responses: Vec<Probe>,
    /// Receptance, mobility or accelerance.
    pub quantity: Quantity,
}

/// A unit blow: where, and along which combination of force and moment.
#[derive(Clone, Debug, PartialEq)]
pub struct Excitation {
    pub name: String,
    pub at: Anchor,
    /// Force and moment at the anchor's point; a unit vector for a force.
    pub direction: [f64; 6],
}

/// Steady unbalance response over speed.
#[derive(Clone, Debug, PartialEq)]
pub struct UnbalanceStudy {
    /// Speeds \[rad/s\].
    pub speeds: Vec<f64>,
    pub responses: Vec<Probe>,
}

/// Time integrator.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Integrator {
    /// Generalised-α with spectral radius at infinity ρ∞.
    GeneralisedAlpha { rho_infinity: f64 },
    /// Newmark, γ = ½, β = ¼.
    Newmark,
    /// Classical Runge-Kutta of order 4, fixed step.
    RungeKutta4,
    /// Dormand-Prince 5(4), error-controlled.
    DormandPrince { relative_tolerance: f64, absolute_tolerance: f64 },
}

/// Nonlinear transient through the speed profile.
#[derive(Clone, Debug, PartialEq)]
pub struct RunUpStudy {
    pub integrator: Integrator,
    /// Time step \[s\] (first step for error control).
    pub step: f64,
    /// Sampling rate of the stored channels \[Hz\].
    pub sample_rate: f64,
    /// Modes of the linear parts are kept up to this frequency \[Hz\]; infinity keeps all.
    pub cutoff: f64,
    /// Start from static equilibrium (else at rest, undeformed).
    pub from_equilibrium: bool,
}

/// Spectrogram of a run-up over rpm.
#[derive(Clone, Debug, PartialEq)]
pub struct SpectrogramStudy {
    /// Channels (probe names); empty means all.
    pub channels: Vec<String>,
    pub window: WindowKind,
    /// Window length \[s\].
    pub length: f64,
    /// Overlap 0..1.
    pub overlap: f64,
    /// Highest frequency drawn \[Hz\].
    pub max_frequency: f64,
    /// dB range drawn below the maximum.
    pub dynamic_range_db: f64,
    pub orders: Vec<f64>,
}

/// Order spectra and order cuts of a run-up.
#[derive(Clone, Debug, PartialEq)]
pub struct OrderStudy {
    pub channels: Vec<String>,
    /// Order resolution; the window holds 1/resolution revolutions.
    pub resolution: f64,
    pub max_order: f64,
    pub overlap: f64,
    pub window: WindowKind,
    /// Orders whose level is cut out against rpm.
    pub cuts: Vec<f64>,
}
