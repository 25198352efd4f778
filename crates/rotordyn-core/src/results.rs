//! Results of the studies of a model: plain data in SI.

mod bearing;
mod order_line;
mod run_up;
mod run_up_correlation;
mod signal;

pub use bearing::{
    BallState, BearingLife, BearingPoint, BearingResult, BearingSweepResult, Column, ContactState, EhlFilm,
    PickContact,
};
pub use order_line::OrderLine;
pub use run_up::{CagePhaseBand, CagePhaseChannel, CagePhaseLine, StepError, StepErrorLine};
pub use run_up_correlation::{ChannelPair, CutPair, CutPeak, level_difference_db};
pub use signal::{
    BearingWithOrders, CyclicLine, CyclicResult, EnvelopeResult, JerkResult, KurtogramResult, RaceResult,
    ShaftAverage, ShaftOrders, ShaftSummary, SignalResult, SpectrogramWithSpeed,
};

use crate::analysis::Mode;
use crate::analysis::ball_inertia::InertiaUse;
use crate::analysis::campbell::Campbell;
use crate::analysis::critical_speed::CrossingList;
use crate::analysis::equilibrium::Equilibrium;
use crate::analysis::frf::Frf;
use crate::analysis::peaks::Peak;
use crate::analysis::stability::Threshold;
use crate::analysis::unbalance::UnbalanceResponse;
use crate::model::study::Parameter;
use crate::model::{Probe, Quantity};
use crate::transient::run::Report;
use rotordyn_linalg::Complex64;
use rotordyn_signal::lyapunov::LyapunovExponent;
use rotordyn_signal::motion_classification::Classification;
use rotordyn_signal::orbit::FilteredOrbit;
use rotordyn_signal::order::{OrderCut, OrderSpectrogram};
use rotordyn_signal::stft::Spectrogram;

/// Everything computed from one model; studies not requested are empty.
#[derive(Clone, Debug, Default)]
pub struct Results {
    pub equilibrium: Option<Equilibrium>,
    pub modal: Vec<ModalResult>,
    pub campbell: Option<CampbellResult>,
    pub critical: Option<CriticalResult>,
    pub frf: Option<FrfResult>,
    pub unbalance: Option<UnbalanceResult>,
    pub run_up: Option<RunUpResult>,
    pub spectrograms: Vec<SpectrogramResult>,
    pub orders: Vec<OrderResult>,
    pub cage_phases: Option<CagePhaseBand>,
    pub poincare: Option<PoincareResult>,
    pub lyapunov: Option<LyapunovResult>,
    pub bifurcation: Option<BifurcationResult>,
    pub bearings: Vec<BearingResult>,
    /// Ball inertia used in every study, by its name.
    pub ball_inertia: Vec<(&'static str, Vec<InertiaUse>)>,
    /// Warnings for the user, once each.
    pub warnings: Vec<String>,
}

/// Modes at one speed.
#[derive(Clone, Debug)]
pub struct ModalResult {
    /// Ω \[rad/s\].
    pub speed: f64,
    pub modes: Vec<Mode>,
}

/// Campbell diagram with order lines and their crossings (critical speeds).
#[derive(Clone, Debug)]
pub struct CampbellResult {
    pub diagram: Campbell,
    pub orders: Vec<OrderLine>,
    pub crossings: CrossingList,
    /// Stability thresholds: speeds at which a mode's damping changes sign.
    pub thresholds: Vec<Threshold>,
}

/// Critical speeds up to a speed.
#[derive(Clone, Debug)]
pub struct CriticalResult {
    pub max_speed: f64,
    pub crossings: CrossingList,
}

/// FRFs with the names of excitations and responses.
#[derive(Clone, Debug)]
pub struct FrfResult {
    /// Ω \[rad/s\].
    pub speed: f64,
    pub excitations: Vec<String>,
    pub responses: Vec<String>,
    /// Unit of every response per excitation, `units[response][excitation]`, such as "(m/s^2)/N".
    pub units: Vec<Vec<String>>,
    /// At the requested frequencies and those added around the natural frequencies.
    pub frf: Frf,
    /// Index of every requested frequency.
    pub requested: Vec<usize>,
    /// Undamped modes, at which the FRFs are infinite, by frequency \[Hz\].
    pub undamped: Vec<UndampedPeak>,
}

/// An undamped mode that is excited: the response there is infinite.
#[derive(Clone, Debug, PartialEq)]
pub struct UndampedPeak {
    /// Frequency \[Hz\] or speed \[rad/s\].
    pub at: f64,
    /// Label of the mode.
    pub label: String,
    /// Responses in which it appears; of an FRF "RESPONSE/EXCITATION".
    pub responses: Vec<String>,
}

impl UndampedPeak {
    /// Largest distance, as a fraction of the frequency or speed, at which a response counts as infinite.
    pub const WIDTH: f64 = 1e-6;

    /// Whether a response is infinite at a frequency or speed.
    pub fn covers(&self, at: f64) -> bool {
        (at - self.at).abs() <= Self::WIDTH * self.at
    }
}

impl FrfResult {
    /// Receptance, mobility or accelerance.
    pub fn name(&self) -> &'static str {
        match self.frf.quantity {
            Quantity::Displacement => "receptance",
            Quantity::Velocity => "mobility",
            Quantity::Acceleration => "accelerance",
        }
    }
}

impl FrfResult {
    /// The FRFs at the requested frequencies only, for formats and programs that need equal spacing.
    pub fn at_requested(&self) -> Self {
        let pick = |h: &Vec<Complex64>| self.requested.iter().map(|&k| h[k]).collect();
        let values = self.frf.values.iter().map(|row| row.iter().map(pick).collect()).collect();
        let frequencies: Vec<f64> = self.requested.iter().map(|&k| self.frf.frequencies[k]).collect();
        let requested = (0..frequencies.len()).collect();
        Self { frf: Frf { frequencies, values, quantity: self.frf.quantity }, requested, ..self.clone() }
    }

    /// Whether the FRF is non-zero at any frequency; uncoupled responses have no curve and no peak.
    pub fn is_coupled(&self, response: usize, excitation: usize) -> bool {
        self.frf.values[response][excitation].iter().any(|h| h.norm_sqr() > 0.0)
    }
}

/// Whether a direction (weights on u_x u_y u_z θ_x θ_y θ_z) is a rotation or a moment.
pub fn is_rotation(direction: &[f64; 6]) -> bool {
    direction[..3].iter().all(|d| *d == 0.0)
}

/// Unbalance response at every requested probe, and the orbit of every disc.
#[derive(Clone, Debug)]
pub struct UnbalanceResult {
    /// At the requested speeds and those added around the critical speeds.
    pub response: UnbalanceResponse,
    /// Index of every requested speed.
    pub requested: Vec<usize>,
    pub channels: Vec<UnbalanceChannel>,
    pub orbits: Vec<DiscOrbit>,
    /// Peaks of every channel and orbit, by speed \[rad/s\].
    pub peaks: Vec<ResponsePeak>,
    /// Operating speed \[rad/s\] for the separation margins: the highest of the speed profile.
    pub operating_speed: Option<f64>,
    /// Undamped modes excited by the unbalance, at which the response is infinite, by speed \[rad/s\].
    pub undamped: Vec<UndampedPeak>,
}

/// A peak of the unbalance response.
#[derive(Clone, Debug, PartialEq)]
pub struct ResponsePeak {
    /// Name of the probe, or "orbit of disc.NAME" for its semi-major axis.
    pub response: String,
    pub unit: &'static str,
    pub peak: Peak,
}

/// One response: complex amplitude of the probe's quantity over speed.
#[derive(Clone, Debug)]
pub struct UnbalanceChannel {
    pub probe: Probe,
    /// Re and Im per speed; x(t) = Re(X e^{jΩt}).
    pub amplitude: Vec<[f64; 2]>,
}

/// The orbit of a disc's centre over speed: complex u_x and u_y as Re and Im.
#[derive(Clone, Debug)]
pub struct DiscOrbit {
    pub name: String,
    pub x: Vec<[f64; 2]>,
    pub y: Vec<[f64; 2]>,
}

/// A channel of a transient run.
#[derive(Clone, Debug, PartialEq)]
pub struct HistoryChannel {
    pub name: String,
    /// Unit, such as "m/s^2".
    pub unit: String,
    /// Name of the quantity: displacement, velocity, acceleration, force, angle, energy.
    pub quantity: String,
    /// Station or body, and direction.
    pub station: String,
    pub direction: String,
    pub values: Vec<f64>,
}

/// Samples of a transient run at a constant rate.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct History {
    pub sample_rate: f64,
    pub time: Vec<f64>,
    /// Shaft angle θ \[rad\] and speed Ω \[rad/s\].
    pub angle: Vec<f64>,
    pub speed: Vec<f64>,
    pub channels: Vec<HistoryChannel>,
}

/// A run-up: size and accuracy of the reduced model, recorded samples, report of the integration.
#[derive(Clone, Debug)]
pub struct RunUpResult {
    /// Numbers of vibration modes and static correction modes of the reduced model.
    pub modes: usize,
    pub corrections: usize,
    /// Largest relative error of the reduced static equilibrium.
    pub static_error: f64,
    /// Largest relative error of the reduced model's damped frequencies up to half the cutoff, at top speed.
    pub frequency_error: f64,
    pub history: History,
    pub report: Report,
    /// Requested step \[s\]; the step used divides the sampling interval.
    pub requested_step: f64,
    /// Bearings with balls and their cage angle at the start \[rad\].
    pub cage_angles: Vec<(String, f64)>,
    /// Estimated error of the order levels by the step.
    pub step_error: Option<StepError>,
}

/// Spectrogram of one channel with the speed at every frame.
#[derive(Clone, Debug)]
pub struct SpectrogramResult {
    pub channel: String,
    pub unit: String,
    pub spectrogram: Spectrogram,
    /// Speed at every frame \[rad/s\].
    pub speed: Vec<f64>,
    pub orders: Vec<OrderLine>,
}

/// Order spectrogram and cuts of one channel.
#[derive(Clone, Debug)]
pub struct OrderResult {
    pub channel: String,
    pub unit: String,
    pub spectrogram: OrderSpectrogram,
    pub cuts: Vec<(OrderLine, OrderCut)>,
}

/// A signal shown in a Poincaré section.
#[derive(Clone, Debug, PartialEq)]
pub struct SectionChannel {
    pub name: String,
    pub unit: String,
}

/// The clock (stroboscopic phase) of a Poincaré section.
#[derive(Clone, Debug, PartialEq)]
pub struct SectionClock {
    /// "shaft revolution", "cage revolution of B" or "ball passage of B".
    pub name: String,
    /// Phase of the section \[rad\].
    pub phase: f64,
    /// Mean frequency of the sections over the recorded periods \[Hz\].
    pub frequency: f64,
}

/// Orbits at steady speed with their Poincaré sections.
#[derive(Clone, Debug)]
pub struct PoincareResult {
    /// Ω \[rad/s\].
    pub speed: f64,
    pub clock: SectionClock,
    pub motion: Classification,
    /// Periods discarded as transient: more than requested if the motion had not settled.
    pub transient_periods: usize,
    /// Number of clusters of section points, all planes together.
    pub groups: usize,
    /// Shaft angle at every sample of the orbits \[rad\].
    pub shaft_angle: Vec<f64>,
    pub planes: Vec<PlaneSection>,
}

/// One plane of an orbit.
#[derive(Clone, Debug)]
pub struct PlaneSection {
    pub name: String,
    pub axes: [SectionChannel; 2],
    /// The orbit over its last periods, evenly sampled in time.
    pub orbit: [Vec<f64>; 2],
    /// Sampling rate of the orbit \[Hz\].
    pub sample_rate: f64,
    /// Section points, one per period of the clock.
    pub section: [Vec<f64>; 2],
    /// Only for a shaft orbit, x and y of one point.
    pub whirl: Option<Whirl>,
    /// Radius of the bearing's clearance circle \[m\], for a fixed housing.
    pub clearance: Option<f64>,
}

/// Whirl direction and 1x component of an orbit in x and y.
#[derive(Clone, Debug, PartialEq)]
pub struct Whirl {
    /// Area swept forward (from x towards y, with the spin) minus backward, over their sum: 1 is all forward.
    pub forwardness: f64,
    /// The 1x (synchronous) component, by least squares over the orbit.
    pub synchronous: FilteredOrbit,
}

impl Whirl {
    /// "forward", "backward", or "mixed" for |forwardness| ≤ 0.05.
    pub fn name(&self) -> &'static str {
        match self.forwardness {
            f if f > 0.05 => "forward",
            f if f < -0.05 => "backward",
            _ => "mixed",
        }
    }
}

/// Largest Lyapunov exponent at steady speed.
#[derive(Clone, Debug)]
pub struct LyapunovResult {
    /// Ω \[rad/s\].
    pub speed: f64,
    pub clock: SectionClock,
    pub exponent: LyapunovExponent,
}

/// Poincaré sections over a parameter.
#[derive(Clone, Debug)]
pub struct BifurcationResult {
    pub parameter: Parameter,
    /// Name of the clock.
    pub clock: String,
    pub channels: Vec<SectionChannel>,
    /// The computed sweeps: up, down, or one from equilibrium.
    pub sweeps: Vec<BifurcationSweep>,
    /// Number of seams between chunks, and number of chunks rerun because they started on another branch.
    pub seams: usize,
    pub rerun_chunks: usize,
    /// Whether every value was computed; the others have the reason "stopped".
    pub complete: bool,
}

/// One sweep of a bifurcation diagram, in the order of its values.
#[derive(Clone, Debug)]
pub struct BifurcationSweep {
    /// "up", "down", or "from equilibrium".
    pub name: &'static str,
    pub points: Vec<BifurcationPoint>,
}

/// The motion at one value of the parameter.
#[derive(Clone, Debug)]
pub struct BifurcationPoint {
    /// In the parameter's unit.
    pub value: f64,
    pub motion: Result<SteadyMotion, String>,
}

/// A steady motion: Poincaré sections, extremes and classification.
#[derive(Clone, Debug)]
pub struct SteadyMotion {
    /// Section of every channel.
    pub sections: Vec<Vec<f64>>,
    /// Minimum and maximum of every channel over the whole orbit.
    pub extremes: Vec<[f64; 2]>,
    /// Frequency of the sections \[Hz\].
    pub frequency: f64,
    pub motion: Classification,
    /// Periods discarded as transient: more than requested if the motion had not settled.
    pub transient_periods: usize,
    /// Largest Lyapunov exponent, if requested.
    pub exponent: Option<LyapunovExponent>,
}

/// SI unit of a quantity of a translation or rotation.
pub fn unit_of(quantity: Quantity, rotation: bool) -> &'static str {
    match (quantity, rotation) {
        (Quantity::Displacement, false) => "m",
        (Quantity::Velocity, false) => "m/s",
        (Quantity::Acceleration, false) => "m/s^2",
        (Quantity::Displacement, true) => "rad",
        (Quantity::Velocity, true) => "rad/s",
        (Quantity::Acceleration, true) => "rad/s^2",
    }
}
