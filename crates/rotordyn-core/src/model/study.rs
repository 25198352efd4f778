//! Studies (analyses) requested by a model file, with their settings.

pub use super::integrator::Integrator;
pub use super::steady_study::*;
use super::{Probe, Quantity};
use crate::element::Anchor;
pub use rotordyn_signal::WindowKind;
use serde::{Deserialize, Serialize};

/// Studies requested by a model file, each with its settings; `None` means not requested.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct Studies {
    pub equilibrium: Option<EquilibriumStudy>,
    pub modal: Option<ModalStudy>,
    pub campbell: Option<CampbellStudy>,
    pub critical: Option<CriticalStudy>,
    pub critical_map: Option<CriticalMapStudy>,
    pub torsional: Option<TorsionalStudy>,
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
    /// Average bearing forces over one ball pitch of cage angles instead of using the model's cage angle.
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
    /// Order (excitation) lines drawn and intersected with the modes for critical speeds.
    pub orders: Vec<f64>,
    /// Speed-dependent ball bearings: linearised at every speed, with film and ball inertia, instead of at
    /// standstill.
    pub speed_dependent_bearings: bool,
}

/// Critical speeds.
#[derive(Clone, Debug, PartialEq)]
pub struct CriticalStudy {
    /// Upper limit of the searched speed range \[rad/s\].
    pub max_speed: f64,
    /// Orders whose crossings are listed; 1 is synchronous (unbalance) excitation.
    pub orders: Vec<f64>,
}

/// Undamped critical speeds over the radial stiffness of the bearings.
#[derive(Clone, Debug, PartialEq)]
pub struct CriticalMapStudy {
    /// Upper limit of the speeds \[rad/s\].
    pub max_speed: f64,
    /// Ends of the range of stiffness \[N/m\]; `None`: decades around that of the bearings.
    pub lowest_stiffness: Option<f64>,
    pub highest_stiffness: Option<f64>,
    /// Number of stiffnesses.
    pub points: usize,
}

/// Torsional modes and the orders that excite them.
#[derive(Clone, Debug, PartialEq)]
pub struct TorsionalStudy {
    /// Highest speed of the interference diagram \[rad/s\].
    pub max_speed: f64,
    /// Orders of excitation.
    pub orders: Vec<f64>,
    /// Number of modes.
    pub modes: usize,
    /// Lowest and highest operating speed \[rad/s\]; `None`: the highest of the speed profile.
    pub operating_speeds: Option<[f64; 2]>,
}

/// Frequency response functions at a fixed speed.
#[derive(Clone, Debug, PartialEq)]
pub struct FrfStudy {
    /// Speed \[rad/s\].
    pub speed: f64,
    /// Frequencies \[Hz\].
    pub frequencies: Vec<f64>,
    /// Add frequencies around the natural frequencies.
    pub refine: bool,
    pub excitations: Vec<Excitation>,
    pub responses: Vec<Probe>,
    /// Receptance, mobility or accelerance.
    pub quantity: Quantity,
}

/// Unit excitation of an FRF: point and direction of force and moment.
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
    /// Add speeds around the critical speeds.
    pub refine: bool,
    pub responses: Vec<Probe>,
    /// Lowest and highest operating speed for the separation margins \[rad/s\]; `None`: the highest of the speed profile.
    pub operating_speeds: Option<[f64; 2]>,
}

/// Nonlinear transient through the speed profile.
#[derive(Clone, Debug, PartialEq)]
pub struct RunUpStudy {
    pub integrator: Integrator,
    /// Time step \[s\] (first step for error control).
    pub step: f64,
    /// Largest step while a rolling element is on a local defect, and shortly after \[s\].
    pub defect_step: f64,
    /// Sampling rate of the stored channels \[Hz\].
    pub sample_rate: f64,
    /// Cut-off frequency of modal truncation of the linear parts \[Hz\]; infinity keeps all modes.
    pub cutoff: f64,
    /// Start from static equilibrium; otherwise at rest and undeformed.
    pub from_equilibrium: bool,
    /// Number of initial cage phases over which the order cuts are computed; 0 for that of the model alone.
    pub cage_phases: usize,
    /// Motion of all parts, for animations; `None`: not recorded.
    pub motion: Option<MotionSettings>,
}

/// Frames of the recorded motion of all parts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MotionSettings {
    /// Frames per second of the run \[Hz\]; the nearest whole part of the sampling rate is taken.
    pub rate: f64,
    /// First and last time \[s\].
    pub from: f64,
    pub to: f64,
}

impl MotionSettings {
    /// Sampling intervals from frame to frame.
    pub fn stride(&self, sample_rate: f64) -> usize {
        (sample_rate / self.rate).round().max(1.0) as usize
    }
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
    /// Maximum frequency shown \[Hz\].
    pub max_frequency: f64,
    /// Dynamic range shown below the maximum \[dB\].
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
    /// Whether `max_order` may be lowered to what the sampling rate allows at the highest speed.
    pub max_order_is_default: bool,
    pub overlap: f64,
    pub window: WindowKind,
    /// Orders of the order cuts (order tracking): level over rpm.
    pub cuts: Vec<f64>,
    /// −3 dB bandwidth \[orders\] in which the Vold-Kalman filter tracks the cuts' orders; `None`: not tracked.
    pub bandwidth: Option<f64>,
}

/// Single ball bearings, without the machine: loads, contacts, stiffness, film and life, at an operating
/// point and in sweeps.
#[derive(Clone, Debug, PartialEq)]
pub struct BearingStudy {
    /// Names of the bearings; empty means all ball bearings of the file.
    pub bearings: Vec<String>,
    /// Load of the shaft on the bearing F_x F_y F_z \[N\]; `None`: its load in the machine's equilibrium, or
    /// a tenth of its dynamic load rating in a bearing-only file.
    pub force: Option<[f64; 3]>,
    /// M_x M_y \[N m\].
    pub moment: Option<[f64; 2]>,
    /// DOFs u_x u_y u_z θ_x θ_y constrained to zero (bearing centred and aligned); `None`: with a given force
    /// the tilts unless a moment is given, and u_z of a preloaded single row unless an axial force is given.
    pub constrained: Option<[bool; 5]>,
    /// Speed of the operating point \[rad/s\]; `None`: the highest of the speed profile.
    pub speed: Option<f64>,
    /// Average over one ball pitch of cage angles instead of using the model's cage angle.
    pub cage_average: bool,
    /// Composite roughness of ball and race √(R_q1² + R_q2²) \[m\], for the film ratio λ.
    pub roughness: f64,
    /// Direction of the sweeps of load and of displacement.
    pub sweep_direction: SweepDirection,
    /// The sweeps; if none is given those of load, of speed if it has an effect, and of cage angle, over
    /// default ranges.
    pub sweeps: Vec<BearingSweep>,
    /// Skidding map of bearings with free balls, if wanted.
    pub skidding: Option<SkiddingRange>,
}

/// Loads \[N\] and speeds \[rad/s\] of a skidding map; empty: shares of those of the operating point.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SkiddingRange {
    pub loads: Vec<f64>,
    pub speeds: Vec<f64>,
}

/// Default composite roughness \[m\]: ground races of normal precision; that of the balls is negligible.
pub const ROUGHNESS: f64 = 1e-7;

impl Default for BearingStudy {
    fn default() -> Self {
        Self {
            bearings: Vec::new(),
            force: None,
            moment: None,
            constrained: None,
            speed: None,
            cage_average: false,
            roughness: ROUGHNESS,
            sweep_direction: SweepDirection::default(),
            sweeps: Vec::new(),
            skidding: None,
        }
    }
}

/// One sweep of a bearing.
#[derive(Clone, Debug, PartialEq)]
pub struct BearingSweep {
    pub variable: SweepVariable,
    /// Loads \[N, N m\], displacements \[m, rad\], speeds \[rad/s\] or cage angles \[rad\], increasing; empty means a
    /// default range for the bearing.
    pub values: Vec<f64>,
}

/// Quantity varied in a sweep.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum SweepVariable {
    Load,
    Displacement,
    Speed,
    CageAngle,
}

impl SweepVariable {
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
pub enum SweepDirection {
    /// Along the operating load, all its components in proportion; a displacement along its largest force.
    #[default]
    Load,
    /// One component of u_x u_y u_z θ_x θ_y, the others as at the operating point.
    Axis(usize),
}

/// Names of a bearing's five degrees of freedom.
pub const DOF_NAMES: [&str; 5] = ["x", "y", "z", "theta_x", "theta_y"];
