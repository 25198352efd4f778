//! Poles of frequency responses and of the unbalance response: where they peak, and how wide.

use super::campbell::Tangents;
use super::critical_speed::{self, CriticalSpeed, UnstableMode};
use super::modal::{self, Mode};
use super::mode::{ModeKind, inner};
use super::stability;
use crate::assembly::{Assembly, LinearSystem, PhysicsError};
use rayon::prelude::*;
use rotordyn_linalg::Complex64;

/// Damping ratio below which a mode counts as undamped: above the round-off of an undamped one.
const UNDAMPED: f64 = 1e-9;
/// Poles of FRFs are sought up to this multiple of the highest frequency.
const FRF_REACH: f64 = 1.1;
/// Fewest modes sought, of which the least stable may lie above the highest frequency.
const FEWEST_MODES: usize = 12;
/// Largest number of modes sought; above them a grid is refined by the curvature alone.
const MAX_MODES: usize = 160;
/// Poles this far beyond a range of speeds are included, as a fraction of the range.
const MARGIN: f64 = 0.05;
/// Smallest |1 − dω/dΩ|: a frequency nearly parallel to the line ω = Ω.
const SMALLEST_ANGLE: f64 = 0.05;

/// A pole of a response over frequency or speed.
#[derive(Clone, Debug, PartialEq)]
pub struct Pole {
    /// Frequency \[Hz\] or speed \[rad/s\] where the response peaks.
    pub at: f64,
    /// Distance from it to the half-power points, in the same unit.
    pub half_width: f64,
    /// Label of the mode.
    pub label: String,
    /// Kind of the mode; `None` without it.
    pub kind: Option<ModeKind>,
    /// Damping ratio ζ.
    pub damping_ratio: f64,
    /// Mode shape over the free DOFs.
    pub shape: Vec<Complex64>,
}

impl Pole {
    /// A pole without its mode.
    pub fn new(at: f64, half_width: f64) -> Self {
        let damping_ratio = half_width / at;
        Self { at, half_width, label: String::new(), kind: None, damping_ratio, shape: Vec::new() }
    }

    /// Whether the response at the pole is infinite.
    pub fn is_undamped(&self) -> bool {
        self.damping_ratio.abs() < UNDAMPED
    }

    /// Whether the mode of an FRF grows by more than round-off.
    pub fn is_unstable(&self) -> bool {
        let omega = std::f64::consts::TAU * self.at;
        let zeta = self.damping_ratio;
        stability::is_unstable(Complex64::new(-zeta * omega, omega))
    }

    /// Whether a force excites the mode: |φᴴ F| above round-off of |φ| |F|.
    pub fn is_excited_by(&self, force: &[Complex64]) -> bool {
        let size = |v: &[Complex64]| inner(v, v).re.sqrt();
        inner(&self.shape, force).norm() > 1e-6 * size(&self.shape) * size(force)
    }

    fn of(mode: &Mode, at: f64, half_width: f64) -> Self {
        let (label, shape) = (mode.label.clone(), mode.shape.clone());
        let (kind, damping_ratio) = (Some(mode.kind), mode.zeta());
        Self { at, half_width: half_width.abs(), label, kind, damping_ratio, shape }
    }
}

/// Poles of the FRFs of a system up to a frequency \[Hz\]: its damped natural frequencies, half-widths −Re λ.
///
/// # Errors
/// As [`modal::modes`].
pub fn frf_poles(assembly: &Assembly, system: &LinearSystem, max_hz: f64) -> Result<Vec<Pole>, PhysicsError> {
    use std::f64::consts::TAU;
    let highest = FRF_REACH * TAU * max_hz;
    let reach = |found: &[modal::Eigenpair]| match found.len() {
        ..MAX_MODES => highest,
        _ => 0.0,
    };
    // And the one beyond.
    let expected = modal::undamped_modes_below(system, highest) + 1;
    let pairs = modal::eigenpairs_up_to(assembly, system, expected.clamp(FEWEST_MODES, MAX_MODES), reach)?;
    let modes = modal::modes_of(assembly, system, pairs);
    Ok(modes.iter().map(|mode| Pole::of(mode, mode.frequency_hz(), mode.eigenvalue.re / TAU)).collect())
}

/// Poles of the unbalance response from one speed to another \[rad/s\] and a little beyond: the critical speeds of
/// order 1, λ(Ω) with Im λ = Ω; half-width |Re λ|/|1 − dω/dΩ|. And the unstable modes at speeds of the range. `nodes`: as
/// in [`critical_speeds`](critical_speed::critical_speeds).
///
/// # Errors
/// As [`critical_speeds`](critical_speed::critical_speeds).
pub fn synchronous_poles(
    assembly: &Assembly,
    [low, high]: [f64; 2],
    tangents: &impl Tangents,
    nodes: &[f64],
) -> Result<(Vec<Pole>, Vec<UnstableMode>), PhysicsError> {
    if high <= low || high <= 0.0 {
        return Ok((Vec::new(), Vec::new()));
    }
    let margin = MARGIN * (high - low);
    let range = [(low - margin).max(0.0), high + margin];
    let found = critical_speed::critical_speeds(assembly, range, &[1.0], tangents, nodes)?;
    let pole = |critical: &CriticalSpeed| {
        let slope = critical.frequency_slope(assembly, tangents)?;
        let half_width = critical.mode.eigenvalue.re / (1.0 - slope).abs().max(SMALLEST_ANGLE);
        Ok(Pole::of(&critical.mode, critical.speed, half_width))
    };
    let poles = found.list.par_iter().map(pole).collect::<Result<_, PhysicsError>>()?;
    let is_inside = |mode: &UnstableMode| (low..=high).contains(&mode.speed);
    Ok((poles, found.unstable.into_iter().filter(is_inside).collect()))
}
