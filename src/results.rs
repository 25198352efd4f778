//! What the studies of a model give: plain data, as computed, in SI.

mod bearing;
mod beside;
mod signal;

pub use bearing::{
    BallState, BearingLife, BearingPoint, BearingResult, BearingSweepResult, Column, ContactState,
    PickContact, SolvedFilm,
};
pub use beside::{ChannelPair, CutPair, CutPeak, level_over};
pub use signal::{
    CyclicLine, CyclicResult, EnvelopeResult, JerkResult, KurtogramResult, RaceResult, RatedBearing,
    ShaftAverage, ShaftOrders, ShaftSummary, SignalResult, SpectrogramOverTime,
};

use crate::analysis::Mode;
use crate::analysis::campbell::Campbell;
use crate::analysis::critical_speed::CriticalSpeed;
use crate::analysis::equilibrium::Equilibrium;
use crate::analysis::frf::Frf;
use crate::analysis::stability::Threshold;
use crate::analysis::unbalance::UnbalanceResponse;
use crate::model::study::Parameter;
use crate::model::{Probe, Quantity};
use crate::signal::lyapunov::Exponent;
use crate::signal::orbit::FilteredOrbit;
use crate::signal::order::{OrderCut, OrderSpectrogram};
use crate::signal::period::Classified;
use crate::signal::stft::Spectrogram;
use crate::transient::run::Report;

/// Everything computed from one model; a study that was not asked for is empty.
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
    pub poincare: Option<PoincareResult>,
    pub lyapunov: Option<LyapunovResult>,
    pub bifurcation: Option<BifurcationResult>,
    pub bearings: Vec<BearingResult>,
    /// What the user should know, once each.
    pub warnings: Vec<String>,
}

/// Modes at one speed.
#[derive(Clone, Debug)]
pub struct ModalResult {
    /// Ω \[rad/s\].
    pub speed: f64,
    pub modes: Vec<Mode>,
}

/// A line of constant order, with the name a user would give it ("1x", "BPFO").
#[derive(Clone, Debug, PartialEq)]
pub struct OrderLine {
    pub label: String,
    pub order: f64,
    /// Whether it belongs to a bearing rather than to the shaft.
    pub bearing: bool,
}

/// Campbell diagram with its order lines and the crossings on it.
#[derive(Clone, Debug)]
pub struct CampbellResult {
    pub diagram: Campbell,
    pub orders: Vec<OrderLine>,
    pub crossings: Vec<CriticalSpeed>,
    /// Speeds at which a mode loses or regains its damping.
    pub thresholds: Vec<Threshold>,
}

/// Critical speeds up to a speed.
#[derive(Clone, Debug)]
pub struct CriticalResult {
    pub max_speed: f64,
    pub speeds: Vec<CriticalSpeed>,
}

/// FRFs with the names of their ends.
#[derive(Clone, Debug)]
pub struct FrfResult {
    /// Ω \[rad/s\].
    pub speed: f64,
    pub excitations: Vec<String>,
    pub responses: Vec<String>,
    /// Unit of every response per excitation, `units[response][excitation]`, such as "(m/s^2)/N".
    pub units: Vec<Vec<String>>,
    pub frf: Frf,
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
    /// Whether an excitation moves a response at any frequency; what it cannot reach has no curve and no peak.
    pub fn moves(&self, response: usize, excitation: usize) -> bool {
        self.frf.values[response][excitation].iter().any(|h| h.norm_sqr() > 0.0)
    }
}

/// Whether a direction (weights on u_x u_y u_z θ_x θ_y θ_z) is a rotation or a moment.
pub fn is_rotation(direction: &[f64; 6]) -> bool {
    direction[..3].iter().all(|d| *d == 0.0)
}

/// Unbalance response of every asked response, and of the orbits of every disc.
#[derive(Clone, Debug)]
pub struct UnbalanceResult {
    pub response: UnbalanceResponse,
    pub channels: Vec<UnbalanceChannel>,
    pub orbits: Vec<DiscOrbit>,
}

/// One response: complex amplitude over speed, per its quantity.
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
    /// Quantity in words: displacement, velocity, acceleration, force, angle, energy.
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

/// A run-up: what was kept of the model, what was sampled, how it went.
#[derive(Clone, Debug)]
pub struct RunUpResult {
    /// Vibration modes and static-correction vectors of the reduced model.
    pub modes: usize,
    pub corrections: usize,
    /// Largest relative error of the reduced static equilibrium.
    pub static_error: f64,
    /// Largest relative error of the reduced model's damped frequencies up to half the cutoff, at top speed.
    pub frequency_error: f64,
    pub history: History,
    pub report: Report,
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

/// A signal that a section shows.
#[derive(Clone, Debug, PartialEq)]
pub struct SectionChannel {
    pub name: String,
    pub unit: String,
}

/// What a section was taken by.
#[derive(Clone, Debug, PartialEq)]
pub struct SectionClock {
    /// In words: "shaft turn", "cage turn of B", "ball passage of B".
    pub name: String,
    /// Phase at which the section is taken \[rad\].
    pub phase: f64,
    /// Sections a second, mean over the recorded periods \[Hz\].
    pub frequency: f64,
}

/// Orbits at steady speed with their Poincaré sections.
#[derive(Clone, Debug)]
pub struct PoincareResult {
    /// Ω \[rad/s\].
    pub speed: f64,
    pub clock: SectionClock,
    pub motion: Classified,
    /// Groups that the section points fall into, all planes together.
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
    /// Of an orbit proper, x and y of one point.
    pub whirl: Option<Whirl>,
    /// Radius that the bearing at this point leaves its shaft \[m\], where its housing stands still.
    pub clearance: Option<f64>,
}

/// How an orbit in x and y is run through.
#[derive(Clone, Debug, PartialEq)]
pub struct Whirl {
    /// Area swept forward (from x towards y, as the shaft spins) less that swept backward, over both: 1 is all forward.
    pub forwardness: f64,
    /// The 1x part, by least squares over the orbit.
    pub once: FilteredOrbit,
}

impl Whirl {
    /// "forward", "backward", or "mixed" where neither sweeps a twentieth more.
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
    pub exponent: Exponent,
}

/// Poincaré sections over a parameter.
#[derive(Clone, Debug)]
pub struct BifurcationResult {
    pub parameter: Parameter,
    /// Name of the clock.
    pub clock: String,
    pub channels: Vec<SectionChannel>,
    /// The sweeps done: up, down, or one from equilibrium.
    pub sweeps: Vec<BifurcationSweep>,
    /// Seams between chunks, and how many of the chunks had to be run again because they had met another branch.
    pub seams: usize,
    pub repaired: usize,
    /// Whether every value was come to; what was not says "stopped".
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
    pub found: Result<SteadyMotion, String>,
}

/// What a steady motion looks like.
#[derive(Clone, Debug)]
pub struct SteadyMotion {
    /// Per channel its section.
    pub sections: Vec<Vec<f64>>,
    /// Per channel the least and largest value of the whole orbit.
    pub extremes: Vec<[f64; 2]>,
    /// Sections a second \[Hz\].
    pub frequency: f64,
    pub motion: Classified,
    /// Largest Lyapunov exponent, where it was asked for.
    pub exponent: Option<Exponent>,
}

/// Unit of a quantity of a translation, or of a rotation.
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
