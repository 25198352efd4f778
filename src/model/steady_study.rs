//! Studies of steady speed: Poincaré sections, Lyapunov exponents, bifurcation diagrams.

use super::Probe;
use super::study::Integrator;

/// What a Poincaré section is taken by: once per turn of the shaft or of a cage, or per ball passing a fixed place.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Clock {
    Shaft,
    /// Cage of this bearing of the model.
    Cage {
        bearing: usize,
    },
    /// Balls of this bearing of the model, Z to a turn of its cage.
    BallPass {
        bearing: usize,
        balls: usize,
    },
}

/// A run at constant speed until its motion has settled, and what is recorded then.
#[derive(Clone, Debug, PartialEq)]
pub struct Steady {
    /// Speed Ω \[rad/s\], above zero.
    pub speed: f64,
    pub integrator: Integrator,
    /// Largest time step \[s\]; the step taken divides the period of the clock.
    pub step: f64,
    /// Modes of the linear parts are kept up to this frequency \[Hz\]; infinity keeps all.
    pub cutoff: f64,
    pub clock: Clock,
    /// Phase of the clock at which sections are taken \[rad\]: shaft or cage angle from +x towards +y, or for ball
    /// passages Z times the cage angle.
    pub phase: f64,
    /// Periods of the clock before anything is recorded.
    pub settle: usize,
    /// Periods recorded: as many points of a section.
    pub periods: usize,
}

/// A plane that an orbit and its section are seen in.
#[derive(Clone, Debug, PartialEq)]
pub struct Plane {
    pub name: String,
    pub x: Probe,
    pub y: Probe,
}

/// Orbits and Poincaré sections.
#[derive(Clone, Debug, PartialEq)]
pub struct PoincareStudy {
    pub steady: Steady,
    pub planes: Vec<Plane>,
    /// Change over a period that still counts as none, relative to the orbit's size.
    pub tolerance: f64,
    /// Longest period looked for, in periods of the clock.
    pub longest_period: usize,
}

/// Largest Lyapunov exponent.
#[derive(Clone, Debug, PartialEq)]
pub struct LyapunovStudy {
    pub steady: Steady,
    /// Largest displacement in a bearing by the perturbation that is followed \[m\].
    pub perturbation: f64,
}

/// Any value of the model file, and what it is set to one after the other.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct Parameter {
    /// Paths that are set to the value, as for `--set`: one, or several that change together.
    pub paths: Vec<String>,
    /// Unit of `values` as written in the file; empty for plain numbers.
    pub unit: String,
    pub values: Vec<f64>,
    /// What is set: value and unit as text.
    pub texts: Vec<String>,
}

impl Parameter {
    /// What is set to get the k-th model of the family.
    pub fn settings(&self, k: usize) -> Vec<(String, String)> {
        self.paths.iter().map(|path| (path.clone(), self.texts[k].clone())).collect()
    }

    /// Name for people: "speed", "bearing.B.radial clearance", "radial clearance" of several.
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

/// Which way a parameter is swept.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sweep {
    Up,
    Down,
    Both,
}

/// Where the run at a value starts from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Continuation {
    /// Each from static equilibrium, whatever the others did.
    Equilibrium,
    /// Each from where the one before ended, so that a sweep stays on its branch. The sweep is cut into chunks that run
    /// side by side, each warming up on the last `overlap` values of the chunk before.
    Carried { chunks: usize, overlap: usize },
}

/// Bifurcation diagram: sections over a parameter.
#[derive(Clone, Debug, PartialEq)]
pub struct BifurcationStudy {
    pub steady: Steady,
    pub parameter: Parameter,
    pub channels: Vec<Probe>,
    pub tolerance: f64,
    pub longest_period: usize,
    pub sweep: Sweep,
    pub continuation: Continuation,
    /// Follow a perturbation of this size \[m\] too, for the largest Lyapunov exponent at every value.
    pub perturbation: Option<f64>,
}
