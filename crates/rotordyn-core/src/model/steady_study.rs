//! Studies of steady motion at constant speed: Poincaré sections, Lyapunov exponents, bifurcation diagrams.

use super::Probe;
use super::study::Integrator;
use serde::{Deserialize, Serialize};

/// Sampling event of a stroboscopic Poincaré section: once per revolution of the shaft or of a cage, or per
/// ball passage.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SectionTrigger {
    Shaft,
    /// Cage of this bearing of the model.
    Cage {
        bearing: usize,
    },
    /// Ball passages of this bearing of the model, Z per revolution of its cage.
    BallPass {
        bearing: usize,
        balls: usize,
    },
}

/// A run at constant speed: transient discarded, then steady motion recorded.
#[derive(Clone, Debug, PartialEq)]
pub struct SteadyRunSettings {
    /// Speed Ω \[rad/s\], above zero.
    pub speed: f64,
    pub integrator: Integrator,
    /// Maximum time step \[s\]; the step used divides the section period.
    pub step: f64,
    /// Cut-off frequency of modal truncation of the linear parts \[Hz\]; infinity keeps all modes.
    pub cutoff: f64,
    pub trigger: SectionTrigger,
    /// Phase at which sections are taken \[rad\]: shaft or cage angle from +x towards +y, or for ball
    /// passages Z times the cage angle.
    pub phase: f64,
    /// Transient section periods discarded before recording.
    pub transient_periods: usize,
    /// Section periods recorded: number of points of a section.
    pub periods: usize,
    /// Section periods, transient and record, up to which a run goes on whose motion has not settled.
    pub transient_limit: usize,
}

/// Plane of an orbit plot and its Poincaré section: two probes, or a phase plane.
#[derive(Clone, Debug, PartialEq)]
pub struct Plane {
    pub name: String,
    pub x: Probe,
    pub y: Probe,
}

/// Orbits and Poincaré sections.
#[derive(Clone, Debug, PartialEq)]
pub struct PoincareStudy {
    pub steady: SteadyRunSettings,
    pub planes: Vec<Plane>,
    /// Tolerance of period detection: difference of sections one period apart, relative to the orbit's size.
    pub tolerance: f64,
    /// Longest period tested (period-n motion), in section periods.
    pub longest_period: usize,
}

/// Largest Lyapunov exponent.
#[derive(Clone, Debug, PartialEq)]
pub struct LyapunovStudy {
    pub steady: SteadyRunSettings,
    /// Size of the perturbation, to which it is renormalised: its largest displacement in a bearing \[m\].
    pub perturbation: f64,
}

/// Bifurcation parameter: any value of the model file, with its successive settings.
#[derive(Clone, Debug, PartialEq, Default, Serialize, Deserialize)]
pub struct Parameter {
    /// Paths set to the value, as for `--set`: one, or several changed together.
    pub paths: Vec<String>,
    /// Unit of `values` as written in the file; empty for plain numbers.
    pub unit: String,
    pub values: Vec<f64>,
    /// Settings: value and unit as text.
    pub texts: Vec<String>,
}

impl Parameter {
    /// Settings (path, value) of the k-th model.
    pub fn settings(&self, k: usize) -> Vec<(String, String)> {
        self.paths.iter().map(|path| (path.clone(), self.texts[k].clone())).collect()
    }

    /// Display name: "speed", "bearing.B.radial clearance", "radial clearance" of several.
    pub fn name(&self) -> String {
        let last = |path: &str| path.rsplit('.').next().unwrap_or(path).to_string();
        let name = match &self.paths[..] {
            [only] => only.strip_prefix("study.bifurcation.").unwrap_or(only).to_string(),
            [first, ..] => last(first),
            [] => String::new(),
        };
        name.replace('_', " ")
    }
}

/// Direction of a parameter sweep.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sweep {
    Up,
    Down,
    Both,
}

/// Initial state of the run at a parameter value.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Continuation {
    /// Static equilibrium, independent of the other values.
    Equilibrium,
    /// Final state of the previous value (continuation), so that a sweep stays on its branch. The sweep is
    /// split into chunks run in parallel, each starting with the last `overlap` values of the previous chunk.
    PreviousState { chunks: usize, overlap: usize },
}

/// Bifurcation diagram: Poincaré sections over a parameter.
#[derive(Clone, Debug, PartialEq)]
pub struct BifurcationStudy {
    pub steady: SteadyRunSettings,
    pub parameter: Parameter,
    pub channels: Vec<Probe>,
    pub tolerance: f64,
    pub longest_period: usize,
    pub sweep: Sweep,
    pub continuation: Continuation,
    /// Perturbation size \[m\] for the largest Lyapunov exponent at every value; `None`: not computed.
    pub perturbation: Option<f64>,
}
