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
    pub bearing: Option<BearingStudy>,
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
    /// Take ball bearings at every speed, with their film and ball inertia there, instead of at standstill.
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

/// A unit force: where, and along which combination of force and moment.
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

/// Ball bearings each on its own: loads, contacts, stiffness, film and life, at an operating point and in sweeps.
#[derive(Clone, Debug, PartialEq)]
pub struct BearingStudy {
    /// Names of the bearings; empty means every ball bearing of the file.
    pub bearings: Vec<String>,
    /// Load of the shaft on the bearing F_x F_y F_z \[N\]; `None`: what it carries in the machine's equilibrium,
    /// or a tenth of its dynamic load rating where the file is no machine.
    pub force: Option<[f64; 3]>,
    /// M_x M_y \[N m\].
    pub moment: Option<[f64; 2]>,
    /// Motions u_x u_y u_z θ_x θ_y held where the bearing is centred and aligned; `None`: with a given force the
    /// tilts unless a moment is given, and u_z of a preloaded single row unless an axial force is given.
    pub held: Option<[bool; 5]>,
    /// Speed of the operating point \[rad/s\]; `None`: the highest of the speed profile.
    pub speed: Option<f64>,
    /// Average over one ball pitch of cage angles instead of the cage angle in the model.
    pub cage_average: bool,
    /// Composite roughness of ball and race √(R_q1² + R_q2²) \[m\], for the film ratio λ.
    pub roughness: f64,
    /// What the sweeps of load and of displacement go along.
    pub along: Along,
    /// The sweeps; with none given those of load, of speed where it matters, and of cage angle, over ranges of their
    /// own.
    pub sweeps: Vec<BearingSweep>,
}

impl Default for BearingStudy {
    fn default() -> Self {
        Self {
            bearings: Vec::new(),
            force: None,
            moment: None,
            held: None,
            speed: None,
            cage_average: false,
            // ground races of a bearing of normal precision, balls far smoother
            roughness: 0.1e-6,
            along: Along::default(),
            sweeps: Vec::new(),
        }
    }
}

/// One sweep of a bearing.
#[derive(Clone, Debug, PartialEq)]
pub struct BearingSweep {
    pub of: Swept,
    /// Loads \[N, N m\], displacements \[m, rad\], speeds \[rad/s\] or cage angles \[rad\], increasing; empty means a
    /// range that suits the bearing.
    pub values: Vec<f64>,
}

/// What a sweep varies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Swept {
    Load,
    Displacement,
    Speed,
    CageAngle,
}

impl Swept {
    /// Every kind, with the key of its values in the model file.
    pub const ALL: [(Self, &'static str); 4] = [
        (Self::Load, "loads"),
        (Self::Displacement, "displacements"),
        (Self::Speed, "speeds"),
        (Self::CageAngle, "cage_angles"),
    ];

    /// Name in results and figures.
    pub fn name(self) -> &'static str {
        match self {
            Self::Load => "load",
            Self::Displacement => "displacement",
            Self::Speed => "speed",
            Self::CageAngle => "cage_angle",
        }
    }
}

/// Direction of a sweep of load or displacement.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Along {
    /// Along the operating load, all its components in proportion; a displacement along its largest force.
    #[default]
    Load,
    /// One component of u_x u_y u_z θ_x θ_y, the others as at the operating point.
    Axis(usize),
}

/// Names of a bearing's five motions.
pub const MOTIONS: [&str; 5] = ["x", "y", "z", "theta_x", "theta_y"];
