//! Reliability of a run-up: error of its time step, dependence on the initial cage phase.

use super::OrderLine;
use rotordyn_signal::order::OrderCut;

/// Estimated error of a run-up's order levels by its time step, from a rerun of a stretch with another step.
///
/// By Richardson extrapolation, the error of a level L(h) of second order is (L(2h) − L(h))/3.
#[derive(Clone, Debug, PartialEq)]
pub struct StepError {
    /// Start and end of the comparison \[s\], around the largest response; the rerun begins earlier.
    pub stretch: [f64; 2],
    /// Step of the rerun \[s\].
    pub other_step: f64,
    /// Mean speed in the stretch \[rad/s\].
    pub speed: f64,
    pub lines: Vec<StepErrorLine>,
    /// Steps of the rerun, and their share of the run's.
    pub steps: u64,
    pub cost: f64,
}

/// One order line of one channel in the stretch.
#[derive(Clone, Debug, PartialEq)]
pub struct StepErrorLine {
    pub channel: String,
    pub line: OrderLine,
    /// RMS level with the step of the run and with that of the rerun.
    pub level: f64,
    pub other_level: f64,
    /// Estimated relative error of the level.
    pub error: f64,
}

impl StepError {
    /// The line with the largest error.
    pub fn worst(&self) -> Option<&StepErrorLine> {
        self.lines.iter().max_by(|a, b| a.error.abs().total_cmp(&b.error.abs()))
    }
}

/// Order cuts of run-ups that differ in the initial cage angles only.
#[derive(Clone, Debug, PartialEq)]
pub struct CagePhaseBand {
    /// Bearings whose cage angle is varied.
    pub bearings: Vec<String>,
    /// Initial cage angle of every one of them in every run \[rad\]; the first run is that of the model.
    pub angles: Vec<Vec<f64>>,
    pub channels: Vec<CagePhaseChannel>,
}

/// Range of one channel's order cuts over the cage phases.
#[derive(Clone, Debug, PartialEq)]
pub struct CagePhaseChannel {
    pub channel: String,
    pub unit: String,
    pub lines: Vec<CagePhaseLine>,
}

/// Range of one order cut.
#[derive(Clone, Debug, PartialEq)]
pub struct CagePhaseLine {
    pub line: OrderLine,
    /// Speed of every window \[rpm\] and level in the run of the model \[RMS\].
    pub cut: OrderCut,
    /// Smallest and largest level over all runs in every window.
    pub minimum: Vec<f64>,
    pub maximum: Vec<f64>,
    /// Largest level of every run over all windows.
    pub peaks: Vec<f64>,
}
